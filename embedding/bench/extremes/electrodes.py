"""Shells that a voltage pulls to an electrode: scenes for several families, and the pull-in they are held against.

``part`` is that of the pull-in voltage, a gap that over the size of the shell.
"""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from embedding.bench.extremes.cell import Numbers
from embedding.bench.extremes.fields import CLOSED, SPHERE
from embedding.bench.extremes.tables import Table, rubber
from embedding.scene import Scene
from embedding.scene.scales import EPSILON_0

if TYPE_CHECKING:
    from embedding.solving import Solution

MODULUS, THIN = 1e5, 1e-5
"""Of the balloon, in Pa, and its thickness over the radius of 1 m: less than any gap."""


class PullIn(NamedTuple):
    """The largest load eps0 V^2 L^2 / (2 N g^3) of a tensioned membrane of size L a gap g << L over a plane, and how
    far its middle has come there, in gaps (J. A. Pelesko, D. H. Bernstein, Modeling MEMS and NEMS, CRC 2002)."""

    load: float
    centre: float


STRIP, DISC = PullIn(1.400016477, 0.388346719), PullIn(0.789229268, 0.444292284)
PELESKO = "the thin gap of Pelesko and Bernstein (2002)"
LENGTH, STIFF = 0.1, 1e-5
"""Size of strip and disc, in m; thickness."""


def of_fringes(gap: float) -> float:
    """What the fringes of the field, g^2 ln(1/g) of the load, make of a voltage; no less than what the mesh does."""
    return max(0.5 * gap**2 * math.log(1.0 / gap), 2e-5)


# -- a balloon in a grounded sphere


def balloon(gap: float, part: float, path: list[Table]) -> Scene:
    """A balloon in a grounded sphere, which has the radius 1 + ``gap``."""
    return Scene.from_table(
        {
            "shell": {"shape": SPHERE, "thickness": THIN, "material": rubber(MODULUS)},
            "ambient": {"field": "electric", "outer": "grounded", "radius": 1.0 + gap},
            "faces": {"both": {"voltage": part * balloon_pull_in(gap)["voltage"]}},
            "model": CLOSED,
            "path": path,
            "solver": {"min_step": 1e-3},
        }
    )


def _pull(strain: float, gap: float) -> float:
    """w = eps0 V^2 / (4 mu T R) = (l - l^-5) (1 - l/b)^2 of a neo-Hookean membrane at the stretch l in a sphere of b
    radii: the field eps0 E^2 / 2, E = V b / (l (b - l)), against the pressure of an inflated balloon."""
    stretching = strain - math.expm1(-5.0 * math.log1p(strain))
    return stretching * ((gap - strain) / (1.0 + gap)) ** 2


@cache
def balloon_pull_in(gap: float) -> Numbers:
    """Voltage and displacement of the limit point, where (l - l^-5)' (b - l) = 2 (l - l^-5)."""
    from scipy.optimize import brentq

    def slope(strain: float) -> float:
        stretching = strain - math.expm1(-5.0 * math.log1p(strain))
        return (1.0 + 5.0 * (1.0 + strain) ** -6) * (gap - strain) - 2.0 * stretching

    strain = brentq(slope, 1e-3 * gap, gap, xtol=1e-17, rtol=1e-14)
    return {"voltage": math.sqrt(_pull(strain, gap) * 4.0 * MODULUS * THIN / EPSILON_0), "displacement": strain}


def balloon_at(gap: float, part: float) -> Numbers:
    """Displacement below the pull-in."""
    from scipy.optimize import brentq

    limit = balloon_pull_in(gap)["displacement"]
    wanted = part**2 * _pull(limit, gap)
    return {"displacement": brentq(lambda s: _pull(s, gap) - wanted, 0.0, limit, xtol=1e-17, rtol=1e-14)}


# -- a strip and a disc over a plane


def strip(gap: float, part: float, path: list[Table]) -> Scene:
    """A strip whose end slides under a dead tension, which stretches it by a thousandth, in a stage before ``path``."""
    modulus, stretch = 1e7, 1.001
    tension = modulus * STIFF * (stretch - stretch**-3)
    supports: list[Table] = [{"where": "x0", "kind": "pinned"}, {"where": "x1", "fix": ["y"]}]
    pull = {"edge": "x1", "traction": [tension, 0.0, 0.0]}
    return _membrane(
        {"kind": "strip", "length": LENGTH}, modulus, supports, pull, gap * LENGTH,
        part * _voltage(STRIP, tension, stretch * LENGTH, gap * LENGTH), ["x0", "x1"], [LENGTH / 2, 0.0, 0.0], path,
    )  # fmt: skip


def disc(gap: float, part: float, path: list[Table]) -> Scene:
    """A disc whose rim slides under a dead tension, which stretches it by a twentieth, in a stage before ``path``."""
    modulus, stretch = 1e5, 1.05
    traction = modulus * STIFF * (stretch - stretch**-5)
    pull = {"edge": "rim", "traction": [traction, 0.0, 0.0], "frame": "edge"}
    return _membrane(
        {"kind": "disc", "radius": LENGTH}, modulus, [{"where": "rim", "fix": ["z"]}], pull, gap * LENGTH,
        part * _voltage(DISC, traction / stretch, stretch * LENGTH, gap * LENGTH), ["rim"], [0.0, 0.0, 0.0], path,
    )  # fmt: skip


def _voltage(limit: PullIn, tension: float, size: float, gap: float) -> float:
    return math.sqrt(limit.load * 2.0 * tension * gap**3 / (EPSILON_0 * size**2))


def _membrane(
    shape: Table, modulus: float, supports: list[Table], pull: Table, gap: float, voltage: float, edges: list[str],
    middle: list[float], path: list[Table],
) -> Scene:  # fmt: skip
    fine = min(gap / 8.0, LENGTH / 20.0)  # the field is singular at the edges
    return Scene.from_table(
        {
            "shell": {"shape": shape, "thickness": STIFF, "material": rubber(modulus)},
            "supports": supports,
            "loads": {"edge_tractions": [pull]},
            "ambient": {"field": "electric", "bodies": [{"kind": "half-space", "level": -gap, "voltage": 0.0}]},
            "faces": {"both": {"voltage": voltage}},
            "model": CLOSED,
            "discretisation": {"edge_size": dict.fromkeys(edges, fine)},
            "output": {"points": {"middle": middle}},
            "path": [{"steps": 2, "field": 0.0}, *path],
            "solver": {"min_step": 1e-3, "max_steps": 12},
        }
    )


SHEETS = {"strip": (strip, STRIP, "y"), "disc": (disc, DISC, "z")}
"""Scene, pull-in and the axis across, of each."""


def at_pull_in(row: str, gap: float) -> Numbers:
    """Voltage and middle of the strip or disc at its pull-in across a thin ``gap``."""
    scene, limit, axis = SHEETS[row]
    faces = scene(gap, 1.0, []).faces.both
    assert faces is not None and faces.voltage is not None
    return {"voltage": faces.voltage, f"u_middle_{axis}": -limit.centre * gap * LENGTH}


def until(axis: str, way: float) -> list[Table]:
    """A stage by arc length until the middle of the strip (axis y) or the disc (z) has gone down by ``way``."""
    middle = [LENGTH / 2 if axis == "y" else 0.0, 0.0, 0.0]
    return [{"until": {"where": middle, "axis": axis, "value": -way}}]


def strip_at(gap: float, part: float) -> Numbers:
    """Where the middle of the strip is below the pull-in: load = 2 I^2, I = (1 - c)^(1/2) [c^(1/2) + (1 - c)
    artanh(c^(1/2))] at its deflection c in gaps, the first integral of u'' = load / (1 + u)^2."""
    from scipy.optimize import brentq

    def off(c: float) -> float:
        half = math.sqrt(1.0 - c) * (math.sqrt(c) + (1.0 - c) * math.atanh(math.sqrt(c)))
        return 2.0 * half**2 - part**2 * STRIP.load

    return {"u_middle_y": -gap * LENGTH * brentq(off, 0.0, STRIP.centre, xtol=1e-15)}


def limit_of(solution: Solution) -> Numbers:
    """The scalars of the first limit point."""
    points = [point.scalars for point in solution.critical_points if point.kind == "limit"]
    return {} if not points else points[0]


def reached(solution: Solution) -> Numbers:
    """The last state that was an equilibrium."""
    return solution.steps[-1].scalars if solution.steps else {}


# -- a plate on a film


PLATE, FRINGES = 4.0 / 27.0, 8.0 / (3.0 * math.pi)
"""Load eps0 A V^2 / (2 k g^3) at which a rigid plate on a spring k pulls in (H. C. Nathanson et al., IEEE Trans.
Electron Devices 14 (1967) 117); the part of it that the fringes of an electrode of radius a take, over g / a."""
ELECTRODE, GAP = 0.05, 0.0025


def plate(voltage: float, path: list[Table]) -> Scene:
    """The thick middle of a disc hangs on the film around it over a smaller electrode."""
    film = "0.005 + 10 * (1 - tanh((sqrt(x**2 + y**2) - 0.06) / 0.002))"
    below: Any = [0.0, 0.0, -GAP - 0.005]
    return Scene.from_table(
        {
            "shell": {
                "shape": {"kind": "disc", "radius": 0.08},
                "thickness": {"expression": film, "unit": "mm"},
                "material": rubber(1e5),
            },
            "supports": [{"where": "rim", "fix": ["z"]}],
            "loads": {"edge_tractions": [{"edge": "rim", "traction": [0.109, 0.0, 0.0], "frame": "edge"}]},
            "ambient": {
                "field": "electric",
                "bodies": [
                    {"kind": "cylinder", "centre": below, "radius": ELECTRODE, "length": 0.01, "voltage": 0.0}
                ],
            },
            "faces": {"both": {"voltage": voltage}},
            "model": {"theory": "bending", "interface": "closed"},
            "discretisation": {"shell_size": GAP / 2.0},
            "output": {"points": {"plate": [ELECTRODE / math.sqrt(2.0), 0.0, 0.0]}},
            "path": [{"steps": 2, "field": 0.0}, *path],
            "solver": {"min_step": 1e-3, "max_steps": 12},
        }
    )


def plate_load(solution: Solution) -> Numbers:
    """Load of the first limit point, or else of the last equilibrium; the spring is that of the first charged state."""
    charged = [step.scalars for step in solution.steps if step.scalars["voltage"] > 0.0]
    if not charged:
        return {}
    spring = charged[0]["force_z"] / charged[0]["u_plate_z"]
    last = limit_of(solution) or charged[-1]
    return {"load": EPSILON_0 * math.pi * ELECTRODE**2 * last["voltage"] ** 2 / (2.0 * spring * GAP**3)}
