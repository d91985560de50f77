"""Every law in a sheet: uniaxial tension, equibiaxial tension and pure shear, homogeneous and so exact to rounding."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from problems import plate_traction
from problems.common import law_of
from problems.exact import plate
from problems.exact.material import Law
from tests.problems.measures import EVERY_LAW

Traction = Callable[[float, Law], float]
THICKNESS = 1e-3
WIDTH_HELD = "{where = 'y0', fix = ['y']}, {where = 'y1', fix = ['y']}"
MODES: dict[str, tuple[Traction, bool, bool]] = {
    "uniaxial": (plate.traction, False, False),
    "equibiaxial": (plate.equibiaxial_traction, True, False),
    "pure shear": (plate.pure_shear_traction, False, True),
}
"""Exact nominal stress, whether both edges are pulled, whether the width is held."""


def pulled(material: str, stress: float, both: bool, held: bool) -> tuple[float, float]:
    """Largest and smallest in-plane stretch at a nominal stress in Pa."""
    force = stress * THICKNESS
    loads = [f"{{edge = 'x1', traction = [{force!r}, 0, 0]}}"]
    loads += [f"{{edge = 'y1', traction = [0, {force!r}, 0]}}"] if both else []
    sides = WIDTH_HELD if held else "{where = 'y0', fix = ['y']}"
    solution = plate_traction.run(
        f"shell.material={material}",
        f"loads.edge_tractions=[{', '.join(loads)}]",
        f"supports=[{{where = 'x0', fix = ['x']}}, {sides}, {{where = 'surface', fix = ['z']}}]",
        "path=[{steps = 6}]",
    )
    return float(solution["stretch_max"][-1]), float(solution["stretch_min"][-1])


def check(found: tuple[float, float], stretch: float, width: float) -> None:
    """The area to rounding; each stretch too, but for equal ones, which are told apart by the root of rounding."""
    assert found[0] * found[1] == pytest.approx(stretch * width, rel=1e-10)
    expected = (max(stretch, width), min(stretch, width))
    assert found == pytest.approx(expected, rel=1e-10 if stretch != width else 1e-7)


@pytest.mark.parametrize("stretch", [1.1, 2.0])
@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("material", EVERY_LAW.values(), ids=EVERY_LAW)
def test_incompressible_laws(material: str, mode: str, stretch: float) -> None:
    traction, both, held = MODES[mode]
    law = law_of(plate_traction.scene(f"shell.material={material}"))
    width = {"uniaxial": stretch**-0.5, "equibiaxial": stretch, "pure shear": 1.0}[mode]
    check(pulled(material, traction(stretch, law), both, held), stretch, width)


@pytest.mark.parametrize("poisson", [-0.3, 0.0, 0.3, 0.5])
@pytest.mark.parametrize("mode", MODES)
def test_st_venant_and_kirchhoff(mode: str, poisson: float) -> None:
    """Nominal stress l S, with S = Y e, Y e / (1 - nu) and Y e / (1 - nu^2) at the strain e = (l^2 - 1) / 2."""
    _, both, held = MODES[mode]
    stretch, youngs = 1.1, 2e5
    strain = (stretch**2 - 1) / 2
    free = 1 - 2 * poisson * strain
    stress, width = {
        "uniaxial": (youngs * strain, free**0.5),
        "equibiaxial": (youngs * strain / (1 - poisson), stretch),
        "pure shear": (youngs * strain / (1 - poisson**2), 1.0),
    }[mode]
    material = f"{{law = 'st-venant-kirchhoff', youngs_modulus = {youngs}, poisson_ratio = {poisson}}}"
    check(pulled(material, stretch * stress, both, held), stretch, width)
