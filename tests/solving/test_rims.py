"""A thick conductor with rims in a field: off by its sides, which a shell has not, and stated so.

The reference is a rectangle in the plane by boundary elements: the charge on panels of its outline that makes the
potential of a uniform field the same all around (the logarithmic kernel integrated over each panel in closed form).
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
import pytest

from embedding import Scene, Solution, solve

pytestmark = pytest.mark.usefixtures("unestimated")

LENGTH, STRENGTH, ANGLE, EPSILON_0 = 0.1, 1e5, math.radians(30.0), 8.8541878128e-12
Array = npt.NDArray[np.float64]


def outline(ratio: float, panels: int) -> Array:
    """Corners (n, 2) of panels around a rectangle 1 x ``ratio``, finer towards its corners."""

    def along(count: int) -> Array:
        at = np.linspace(-1.0, 1.0, count + 1)[:-1]
        return 0.5 * (np.sign(at) * (1.0 - (1.0 - np.abs(at)) ** 4))

    long, short = along(4 * panels), along(panels)
    sides = [
        (long, np.full_like(long, -0.5 * ratio)), (np.full_like(short, 0.5), ratio * short),
        (-long, np.full_like(long, 0.5 * ratio)), (np.full_like(short, -0.5), -ratio * short),
    ]  # fmt: skip
    return np.concatenate([np.stack(side, axis=1) for side in sides])


def polarisability(ratio: float, panels: int = 100) -> tuple[float, float]:
    """Dipole moment over eps0 E of a conducting rectangle 1 x ``ratio``, in a field along and across it."""
    start = outline(ratio, panels)
    edge = np.roll(start, -1, axis=0) - start
    length = np.hypot(*edge.T)
    middle, tangent = start + 0.5 * edge, edge / length[:, None]
    apart = middle[:, None] - start[None]
    u, v = (apart * tangent).sum(-1), (apart * np.stack([-tangent[:, 1], tangent[:, 0]], 1)).sum(-1)

    def logarithm(a: Array) -> Array:
        far = np.where(np.abs(v) < 1e-14, 1.0, v)
        aside = np.where(np.abs(v) < 1e-14, 0.0, v * np.arctan(a / far))
        return np.asarray(0.5 * a * np.log(a * a + v * v) - a + aside)

    count = len(length)
    matrix = np.zeros((count + 1, count + 1))
    matrix[:count, :count] = -(logarithm(u) - logarithm(u - length)) / (2.0 * math.pi)
    matrix[:count, count], matrix[count, :count] = -1.0, length
    charge = np.linalg.solve(matrix, np.vstack([middle, [0.0, 0.0]]))[:count]
    along, across = ((charge[:, axis] * length * middle[:, axis]).sum() for axis in (0, 1))
    return float(along), float(across)


def turned(ratio: float, *changes: str) -> Solution:
    """A neutral strip, held askew in a field."""
    scene = Scene.model_validate({
        "shell": {"shape": {"kind": "strip", "length": LENGTH}, "thickness": ratio * LENGTH,
                  "material": {"law": "neo-hookean", "shear_modulus": 2e7}},
        "supports": [{"where": "surface", "fix": ["x", "y", "z"]}],
        "ambient": {"field": "electric",
                    "applied_field": [STRENGTH * math.cos(ANGLE), STRENGTH * math.sin(ANGLE), 0.0]},
        "faces": {"both": {"charge": 0.0}}, "path": [{"steps": 1}],
    })  # fmt: skip
    return solve(scene.with_overrides(changes), throw=False)


def test_the_reference() -> None:
    """Of a strip without thickness, pi / 4; of a square 2 pi c^2, c = Gamma(1/4)^2 / (4 pi^(3/2)) its logarithmic
    capacity (G. Polya, G. Szego, Isoperimetric Inequalities in Mathematical Physics, 1951), as the map from the outside
    of a circle has no term 1 / w by symmetry."""
    assert polarisability(1e-4)[0] == pytest.approx(math.pi / 4, rel=1e-3)
    square = math.gamma(0.25) ** 4 / (8.0 * math.pi**2)
    assert polarisability(1.0) == pytest.approx((square, square), rel=1e-5)


@pytest.mark.estimated
@pytest.mark.parametrize("ratio", [0.01, 0.03, 0.05])
@pytest.mark.parametrize("interface", ["opened", "closed"])
def test_a_thick_strip(ratio: float, interface: str) -> None:
    along, across = polarisability(ratio)
    exact = EPSILON_0 * (along - across) * LENGTH**2 * STRENGTH**2 * math.sin(ANGLE) * math.cos(ANGLE)
    solution = turned(ratio, f"model.interface={interface}", "discretisation.shell_size='5 mm'")
    error = solution.errors["torque_z"]
    true = abs(solution["torque_z"][-1] / exact - 1.0)
    assert error.parts["rims"] == pytest.approx(ratio)
    assert 0.8 * true <= error.value <= 5.0 * true


@pytest.mark.estimated
def test_an_accuracy_that_the_sides_do_not_allow() -> None:
    solution = turned(0.03, 'accuracy={relative=1e-2, of=["torque_z"]}')
    assert solution.result.name == "BEYOND_THE_MODEL"
    assert "rims" in solution.message
