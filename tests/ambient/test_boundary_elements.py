"""Boundary elements, which verify the far field, against capacitances in closed form."""

from __future__ import annotations

import pytest
from netgen.occ import Axes, Dir, Ellipsoid, Pnt, Sphere, WorkPlane

from problems.exact.capacitance import disc, sphere, spheroid

boundary_elements = pytest.importorskip("benchmarks.boundary_elements")


@pytest.mark.slow
def test_sphere() -> None:
    """The error falls with the order."""
    surface = Sphere(Pnt(0, 0, 0), 1.0).faces[0]
    errors = [abs(boundary_elements.capacitance(surface, 0.8, order)[0] / sphere(1.0) - 1) for order in (1, 2, 3)]
    assert errors[0] > 5 * errors[1] > 25 * errors[2]
    assert errors[2] < 5e-6


@pytest.mark.slow
def test_spheroid() -> None:
    """Half axes 1, 1, 1/2."""
    surface = Ellipsoid(Axes(Pnt(0, 0, 0), Dir(0, 0, 1), Dir(1, 0, 0)), 1.0, 1.0, 0.5).faces[0]
    assert boundary_elements.capacitance(surface, 0.8, 1)[0] == pytest.approx(spheroid(1.0, 0.5), rel=2e-4)


def test_disc() -> None:
    """The density is infinite at the rim: the error falls with the element size there, from below."""
    surface = WorkPlane().Circle(0, 0, 1.0).Face()
    coarse, fine = (boundary_elements.capacitance(surface, size, 2)[0] / disc(1.0) - 1 for size in (0.3, 0.15))
    assert coarse < fine < 0.0
    assert 2 * fine - coarse == pytest.approx(0.0, abs=5e-4)
