"""What the tests of the worked problems share."""

from __future__ import annotations

import math
from collections.abc import Sequence

NEO_HOOKEAN = "shell.material={law = 'neo-hookean', shear_modulus = '100 kPa'}"
MOONEY_RIVLIN = "shell.material={law = 'mooney-rivlin', c1 = '40 kPa', c2 = '10 kPa'}"
LAWS = (NEO_HOOKEAN, MOONEY_RIVLIN)


def orders(sizes: Sequence[float], errors: Sequence[float]) -> list[float]:
    """Observed orders of convergence between successive sizes."""
    pairs = zip(sizes, sizes[1:], errors, errors[1:], strict=False)
    return [math.log(e / f) / math.log(a / b) for a, b, e, f in pairs]


def as_field(name: str, pressure: float) -> str:
    """Override that states a uniform pressure as a field over the surface: assembled as if it varied."""
    return f"loads.{name}={{expression = '{pressure!r}'}}"
