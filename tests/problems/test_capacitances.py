"""Capacitances and forces of conductors at default accuracy."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from problems import capacitances
from problems.capacitances import RIMMED, SMOOTH, SQUARE, R, at_edges, beyond_order


@pytest.mark.parametrize("name", SMOOTH)
def test_smooth_conductors(name: str) -> None:
    assert abs(capacitances.error(SMOOTH[name])) < 1e-4


@pytest.mark.parametrize("name", RIMMED)
def test_conductors_with_a_rim(name: str) -> None:
    assert abs(capacitances.error(RIMMED[name])) < 1e-3


def test_a_square() -> None:
    """In 3D: elements of a tenth of the side along the edges, around which the field is singular."""
    low, high = (capacitances.error(SQUARE, f"discretisation.order={order}") for order in (1, 2))
    assert 0.0 < high < 1.5e-2
    assert abs(beyond_order(low, high, 2)) < 4e-3


@pytest.mark.slow
def test_a_square_by_default() -> None:
    """Potentials of order 3 and 4: the error falls as order^-2."""
    low, high = capacitances.error(SQUARE, "discretisation.order=2"), capacitances.error(SQUARE)
    assert 0.0 < high < 1e-2
    assert high / low == pytest.approx((3.0 / 4.0) ** 2, rel=0.1)
    assert abs(beyond_order(low, high, 3)) < 1.5e-3


@pytest.mark.slow
def test_a_square_with_smaller_elements_at_its_edges() -> None:
    """Of first order in their size."""
    coarse, fine = (capacitances.error(SQUARE, at_edges(size), "discretisation.order=2") for size in (2e-3, 1e-3))
    assert 0.0 < fine < 4e-3
    assert fine / coarse == pytest.approx(0.5, rel=0.05)
    assert abs(2.0 * fine - coarse) < 3e-4


@pytest.mark.slow
def test_a_cube_with_larger_elements_at_its_edges(tmp_path: Path) -> None:
    """The potential goes like r^(2/3) there: the error falls at least as the power 4/3 of the elements' size."""
    cube = capacitances.cube(tmp_path / "cube.brep")
    changes = [f"discretisation.edge_size={{sharp = {size!r}}}" for size in (0.7 * R, 0.35 * R)]
    coarse, fine = (capacitances.error(cube, change, "discretisation.order=1") for change in changes)
    assert 0.0 < fine < 1e-2
    assert math.log2(coarse / fine) > 4 / 3


@pytest.mark.estimated
@pytest.mark.slow
def test_a_cube_by_default(tmp_path: Path) -> None:
    """From a file, whose sharp edges are found."""
    cube = capacitances.cube(tmp_path / "cube.brep")
    solution = capacitances.run(f"shell.shape={cube.shape}")
    error = float(solution["charge"][-1] / solution["voltage"][-1] / cube.known - 1.0)
    assert abs(error) < 1e-3
    assert solution.error is not None
    assert 0.5 * abs(error) < solution.error.value < 2.0 * abs(error)


@pytest.mark.parametrize("name", ["sphere", "prolate spheroid 2:1", "torus"])
def test_a_higher_order_is_better(name: str) -> None:
    assert abs(capacitances.error(SMOOTH[name], "discretisation.order=4")) < 0.5 * abs(capacitances.error(SMOOTH[name]))


@pytest.mark.parametrize("distance", [0.032, 0.044, 0.06])
def test_two_spheres(distance: float) -> None:
    """The gap is a tenth of a radius at the smallest distance; the force that pushes them apart is that on either."""
    errors = capacitances.pair_errors(distance)
    assert abs(errors["c11"]) < 1e-4
    assert abs(errors["c12"]) < 1e-4
    assert abs(errors["force"]) < 5e-4
    assert abs(errors["balance"]) < 1e-4


@pytest.mark.parametrize("far_field", ["infinite", "robin"])
@pytest.mark.parametrize("height", [0.025, 0.04])
def test_a_sphere_over_a_plane(height: float, far_field: str) -> None:
    """The plane has no end, however far below the sphere it is."""
    errors = capacitances.plane_errors(height, f"model.far_field={far_field}")
    assert abs(errors["capacitance"]) < 3e-5
    assert abs(errors["force"]) < 2e-4


@pytest.mark.parametrize("far_field", ["infinite", "robin"])
def test_only_the_voltage_between_sphere_and_plane_matters(far_field: str) -> None:
    """Far away the potential is that of the plane."""
    at = "faces.both.voltage=0", f"model.far_field={far_field}"
    errors = capacitances.plane_errors(0.025, *at, voltage=-1e4)
    assert abs(errors["capacitance"]) < 3e-5
    assert abs(errors["force"]) < 2e-4


def test_charges_held_instead() -> None:
    """A shell with a charge beside a neutral sphere: the voltages follow from the inverse of the coefficients."""
    distance, charge = 0.044, 1e-8
    neutral = capacitances.second_sphere(distance).replace("voltage=0.0", "charge=0.0")
    solution = capacitances.run(neutral, f"faces.both={{charge = {charge}}}")
    known = capacitances.conducting_spheres.two_spheres(R, capacitances.OTHER, distance, capacitances.EPSILON_0)
    determinant = known.c11 * known.c22 - known.c12**2
    assert solution["voltage"][-1] == pytest.approx(charge * known.c22 / determinant, rel=1e-4)
    assert solution["voltage_body0"][-1] == pytest.approx(-charge * known.c12 / determinant, rel=1e-4)
