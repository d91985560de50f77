"""How far simple shells go under a load, and how their stretch answers to a change of it, in closed form.

Loads are numbers: ``pressure`` is (p_b - p_t) R / (mu T), a pressure that follows the surface, and ``pull`` the same of
a force per reference area, as a conductor at a given voltage in free space feels it. For neo-Hooke, R. W. Ogden,
Non-linear Elastic Deformations (1984), section 5.3:

* sphere      pressure l^2 + pull = 2 (l - l^-5)
* cylinder    pressure l^2 + pull = l^2 - l^-2, its length being held
* flat disc   held along its rim, Hencky's membrane with Y = 3 mu: strain 0.2 (q / 3)^(2/3), q = pressure + pull
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, NamedTuple

Form = Literal["sphere", "cylinder", "flat"]
LARGEST, STEP = 20.0, 1.01
"""How far and how finely an equilibrium is looked for; one closer to a limit point counts as beyond it."""
LEAST = 0.02
"""The least that bending counts as, over (T/R)^2: about what is left of it at large stretches."""
FLAT_STRAIN, FLAT_TENSION = 0.2, 0.45
"""Of Hencky's membrane under q = p a / (Y T): mean stretch less 1, and tension at the apex over Y T, over q^(2/3). From
his series: 0.189 and 0.461 for a Poisson ratio of 0.5, 0.233 and 0.431 for 0.3."""


class Answer(NamedTuple):
    """The mean stretch under a load, and |d ln(stretch) / d ln(load)|."""

    stretch: float
    response: float


BEYOND = Answer(2.0, 1.0)
"""Of a shell whose path goes on behind a limit point: a guess, its stretch answering like a deflection."""


def answer(form: Form, pressure: float, pull: float) -> Answer:
    """The first equilibrium of a shell under rising load; ``BEYOND`` where a limit point comes before. Under a load
    that compresses it, as linear as at rest."""
    net = pressure + pull
    if form == "flat":
        strain = FLAT_STRAIN * (abs(net) / 3) ** (2 / 3)
        return Answer(1.0 + strain, 2 / 3 * strain)
    stiffness = {"sphere": 12.0, "cylinder": 4.0}[form]
    if net <= 0.0:
        return Answer(1.0 + net / stiffness, abs(net) / stiffness)

    def excess(stretch: float) -> float:
        held = 2 * (stretch - stretch**-5) if form == "sphere" else stretch**2 - stretch**-2
        return held - pressure * stretch**2 - pull

    stretch = _first_root(excess)
    if stretch is None:
        return BEYOND
    step = 1e-6 * stretch
    slope = (excess(stretch + step) - excess(stretch - step)) / (2 * step)
    load = pressure * stretch**2 + pull
    return Answer(stretch, abs(load / (stretch * slope)))


def bending_share(form: Form, stretch: float) -> float:
    """What bending adds to the load of a stretched sphere or tube of neo-Hooke, over (T/R)^2: the derivative of its
    bending energy by that of the membrane's, of the theory page "Bending",

    * sphere    W_b = mu T^3 / (2 R^2) l^-4 (1 - l^-3)^2,   W_s = mu T / 2 (2 l^2 + l^-4 - 3)
    * cylinder  W_b = mu T^3 / (6 R^2) l^-2 (1 - l^-2)^2,   W_s = mu T / 2 (l^2 + l^-2 - 2)

    3/4 and 1/3 at rest. It changes its sign on the way, where it counts as ``LEAST``.
    """
    sphere = form == "sphere"
    if abs(stretch - 1.0) < 1e-4:
        return 3 / 4 if sphere else 1 / 3
    n = 3 if sphere else 2
    turned = 1 - stretch**-n
    power = -4 if sphere else -2
    slope = power * stretch ** (power - 1) * turned**2 + stretch**power * 2 * turned * n * stretch ** (-n - 1)
    bent = slope / (2 if sphere else 6)
    stretched = 2 * (stretch - stretch**-5) if sphere else stretch - stretch**-3
    return max(abs(bent / stretched), LEAST)


def _first_root(function: Callable[[float], float]) -> float | None:
    """Where a function that is negative at 1 first becomes positive."""
    low = 1.0
    while function(low * STEP) < 0.0:
        low *= STEP
        if low > LARGEST:
            return None
    high = low * STEP
    while high - low > 1e-12 * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) < 0.0 else (low, middle)
    return 0.5 * (low + high)
