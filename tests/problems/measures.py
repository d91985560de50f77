"""What the tests of the worked problems share."""

from __future__ import annotations

import math
from collections.abc import Sequence

NEO_HOOKEAN = "shell.material={law = 'neo-hookean', shear_modulus = '100 kPa'}"
MOONEY_RIVLIN = "shell.material={law = 'mooney-rivlin', c1 = '40 kPa', c2 = '10 kPa'}"
LAWS = (NEO_HOOKEAN, MOONEY_RIVLIN)
EVERY_LAW = {
    "neo-hookean": "{law = 'neo-hookean', shear_modulus = '100 kPa'}",
    "mooney-rivlin": "{law = 'mooney-rivlin', c1 = '40 kPa', c2 = '10 kPa'}",
    "yeoh": "{law = 'yeoh', c1 = '50 kPa', c2 = '-0.5 kPa', c3 = '20 Pa'}",
    "gent": "{law = 'gent', shear_modulus = '100 kPa', limit = 97.2}",
    "ogden": "{law = 'ogden', moduli = ['0.63 MPa', '1.2 kPa', '-10 kPa'], exponents = [1.3, 5, -2]}",
}
"""The incompressible laws, as tables of a scene file."""


def orders(sizes: Sequence[float], errors: Sequence[float]) -> list[float]:
    """Observed orders of convergence between successive sizes."""
    pairs = zip(sizes, sizes[1:], errors, errors[1:], strict=False)
    return [math.log(e / f) / math.log(a / b) for a, b, e, f in pairs]


def as_field(name: str, pressure: float) -> str:
    """Override that states a uniform pressure as a field over the surface: assembled as if it varied."""
    return f"loads.{name}={{expression = '{pressure!r}'}}"
