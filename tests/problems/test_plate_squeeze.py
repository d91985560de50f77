"""Plate squeezed by p_t = p_b: p / mu = l^2 - l^-4 to rounding, on any mesh; and what does not squeeze."""

from __future__ import annotations

import pytest

from problems import plate_squeeze
from problems.common import law_of
from problems.exact import plate
from tests.problems.measures import LAWS

MESHES = ((1, 60), (2, 35), (3, 25), (4, 40))  # order, mm
DISC = ("shell.shape={kind = 'disc', radius = '50 mm'}", "supports=[{where = 'surface', fix = ['z']}]")


def squeeze_to(stretch: float, law: str) -> tuple[str, ...]:
    """Overrides: a material, and the pressure on both faces that spreads it so far."""
    pressure = plate.squeeze(stretch, law_of(plate_squeeze.scene(law)))
    return (law, f"loads.pressure_top={pressure!r}", f"loads.pressure_bottom={pressure!r}")


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(("order", "size"), MESHES)
def test_exact_up_to_stretch_eight(law: str, order: int, size: int) -> None:
    mesh = (f"discretisation.order={order}", f"discretisation.shell_size={size} mm")
    solution = plate_squeeze.run(*squeeze_to(8.0, law), *mesh)
    assert solution["stretch"][-1] == pytest.approx(8.0, abs=1e-10)
    assert plate_squeeze.error(solution) < 1e-10
    assert solution.pressures[0] == pytest.approx(solution.pressures[1], rel=1e-12)
    spread = solution["stretch_max"] - solution["stretch_min"]
    assert spread == pytest.approx(0.0, abs=1e-6), "a square root of rounding"


@pytest.mark.parametrize("law", LAWS)
def test_the_deformation_is_homogeneous(law: str) -> None:
    """The energy is that of the mean stretch: by convexity it would be larger if the stretch varied."""
    solution = plate_squeeze.run(*squeeze_to(3.0, law))
    exact, stretch = law_of(solution.scene), solution["stretch"]
    density = exact.c1 * (2 * stretch**2 + stretch**-4 - 3) + exact.c2 * (2 * stretch**-2 + stretch**4 - 3)
    volume = 0.1 * 0.08 * 1e-3
    assert solution["elastic_energy"] == pytest.approx(volume * density, rel=1e-12)


def test_only_the_mean_pressure_counts_where_the_sheet_is_held_flat() -> None:
    solution = plate_squeeze.run("loads.pressure_top=12799951.171875", "loads.pressure_bottom=0")
    assert plate_squeeze.error(solution) < 1e-10
    assert solution["stretch"][-1] == pytest.approx(8.0, abs=1e-10)


@pytest.mark.parametrize("change", ["loads.variant=net", "loads.rim=pressurised"])
def test_no_squeeze_without_the_faces_or_with_a_pressed_rim(change: str) -> None:
    """A net pressure of zero on the mid-surface does nothing, and pressure all around is hydrostatic."""
    assert plate_squeeze.run(change)["stretch"] == pytest.approx(1.0, abs=1e-10)


@pytest.mark.parametrize("variant", ["embedding-aware", "as-published"])
def test_the_published_load_is_right_on_a_flat_plate(variant: str) -> None:
    assert plate_squeeze.error(plate_squeeze.run(f"loads.variant={variant}")) < 1e-10


@pytest.mark.parametrize("order", [1, 3])
@pytest.mark.parametrize("reduction", ["3d", "axisymmetric"])
def test_a_disc_is_squeezed_alike(reduction: str, order: int) -> None:
    """Another rim, curved and in every reduction."""
    reduced = (f"model.reduction={reduction}", f"discretisation.order={order}")
    solution = plate_squeeze.run(*DISC, *reduced)
    assert solution["stretch"][-1] == pytest.approx(8.0, abs=1e-10)
    assert plate_squeeze.error(solution) < 1e-10
