"""Plate under edge traction: t / (mu T) = l - l^-2 to rounding, on any mesh."""

from __future__ import annotations

import pytest

from problems import plate_traction
from problems.common import law_of
from problems.exact import plate
from tests.problems.measures import LAWS

MESHES = ((1, 60), (2, 35), (3, 25), (4, 40))  # order, mm


def pull_to(stretch: float, law: str) -> tuple[str, ...]:
    """Overrides: a material, and the traction that stretches it so far."""
    scene = plate_traction.scene(law)
    force = scene.shell.thickness * plate.traction(stretch, law_of(scene))
    return (law, f"loads.edge_tractions.0.traction=[{force!r}, 0, 0]")


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(("order", "size"), MESHES)
def test_exact_up_to_stretch_eight(law: str, order: int, size: int) -> None:
    mesh = (f"discretisation.order={order}", f"discretisation.shell_size={size} mm")
    solution = plate_traction.run(*pull_to(8.0, law), *mesh)
    stretch = solution["stretch_max"]
    assert stretch[-1] == pytest.approx(8.0, abs=1e-10)
    assert plate_traction.error(solution) < 1e-10
    assert solution["stretch_min"] == pytest.approx(stretch**-0.5, abs=1e-10)
    assert solution["stretch"] == pytest.approx(stretch**0.25, abs=1e-10)


@pytest.mark.parametrize("law", LAWS)
def test_the_deformation_is_homogeneous(law: str) -> None:
    """The energy is that of the mean stretches: by convexity it would be larger if they varied."""
    solution = plate_traction.run(*pull_to(3.0, law))
    exact, stretch = law_of(solution.scene), solution["stretch_max"]
    density = exact.c1 * (stretch**2 + 2 / stretch - 3) + exact.c2 * (stretch**-2 + 2 * stretch - 3)
    volume = 0.1 * 0.08 * 1e-3
    assert solution["elastic_energy"] == pytest.approx(volume * density, rel=1e-12)


def test_other_sides_and_thickness() -> None:
    """A long thin strip: the same stretch at the same t / T."""
    strip = ("shell.shape.width=10 mm", "shell.thickness=0.1 mm", "discretisation.shell_size=10 mm")
    solution = plate_traction.run("loads.edge_tractions.0.traction=[79.84375, 0, 0]", *strip)
    assert plate_traction.pull(solution)[-1] == pytest.approx(8.0 - 1 / 64, abs=1e-12)
    assert plate_traction.error(solution) < 1e-10


@pytest.mark.estimated
def test_the_error_estimate_is_zero_for_what_is_exact() -> None:
    solution = plate_traction.run()
    assert solution.error is not None and solution.error.value < 1e-12
