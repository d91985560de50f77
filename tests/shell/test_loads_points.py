"""Forces at points: their work is the force times the displacement there, in every reduction, for the whole body."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from ngsolve import CF, x, y, z

from embedding.geometry.places import locate
from embedding.geometry.spaces import TraceSpace
from embedding.shell.loads import MechanicalLoads
from embedding.shell.point_loads import point_load_vector
from tests.forms import Array, body
from tests.shell.rigid import NodalForces

NONE = MechanicalLoads(0.0, 0.0, (), (), True, "embedding-aware")
PLACES = {
    "plate": ((0.0, 0.0, 0.0), (1.0, 0.37, 0.0), (0.413, 0.222, 0.0)),
    "disc": ((0.0, 0.0, 0.0), (0.3, -0.5, 0.0)),
    "sphere": ((0.0, 0.0, 1.0), (0.6, -0.8, 0.0), (-0.48, 0.6, 0.64)),
    "ring": ((1.0, 0.0), (-0.6, 0.8)),
}


def points(*entries: tuple[tuple[float, ...], tuple[float, ...]]) -> MechanicalLoads:
    return replace(NONE, point_forces=entries)


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("name", PLACES)
def test_force_and_moment(name: str, order: int) -> None:
    """The sum of the nodal forces is F, to rounding; their moment is x cross F with x on the curved mesh."""
    domain = body(name, order=order)
    d = domain.mesh.dim
    rest = CF((0, 0, 0)[:d])
    for place in PLACES[name]:
        force = np.array([2.0, -3.0, 5.0])[:d]
        at = locate(domain, place).position
        forces = NodalForces(domain, points((place, tuple(force))))
        assert forces.force(rest) == pytest.approx(force, abs=1e-12)
        moment = np.cross(at, force) if d == 3 else np.array([at[0] * force[1] - at[1] * force[0]])
        assert forces.moment(rest) == pytest.approx(moment, abs=1e-12)


def test_the_work_on_a_cubic_field() -> None:
    """On a flat mesh of order 3 any cubic is represented: the work is its value, to rounding."""

    def cubic(a: float, b: float) -> Array:
        return np.array([1 + a * b * b, a**3 - 2 * b, a * a * b + b**3 - 0.5])

    domain = body("plate", order=3)
    field = CF((1 + x * y * y, x**3 - 2 * y, x * x * y + y**3 - 0.5))
    for place in ((0.413, 0.222, 0.0), (0.77, 0.6, 0.0), (1.0, 0.0, 0.0)):
        forces = NodalForces(domain, points((place, (2.0, -3.0, 5.0))))
        expected = np.dot((2.0, -3.0, 5.0), cubic(*place[:2]))
        assert forces.work(CF((0, 0, 0)), field) == pytest.approx(expected, abs=1e-12)


def test_forces_of_the_whole_body_act_on_its_part() -> None:
    """Four forces about the mirror planes of an octant, and one in two planes: their work on a symmetric motion."""
    domain = body("octant", order=3)
    loads = points(
        *(((0.6 * a, 0.0, 0.8 * b), (1.0 * a, 0.0, 2.0 * b)) for a in (1, -1) for b in (1, -1)),
        ((0.0, 0.0, 1.0), (0.0, 0.0, 3.0)),
        ((0.0, 0.0, -1.0), (0.0, 0.0, -3.0)),
    )
    work = NodalForces(domain, loads).work(CF((0, 0, 0)), CF((x, y, z)))
    a, _, b = locate(domain, (0.6, 0.0, 0.8)).position
    assert work == pytest.approx(4 * (a + 2 * b) + 6, abs=1e-10)


def test_on_the_axis_the_force_is_the_total() -> None:
    domain = body("axisymmetric sphere", order=3)
    forces = NodalForces(domain, points(((0.0, 1.0), (0.0, 4.0))))
    assert forces.work(CF((0, 0)), CF((0, 1))) == pytest.approx(4.0, abs=1e-12)
    assert forces.work(CF((0, 0)), CF((x, y))) == pytest.approx(4.0, abs=1e-12)


def test_the_numbering_is_that_of_the_shell_in_its_ambient() -> None:
    """The same nodal forces on a shell that is an interface, where the space reaches into the volume."""
    domain = body("sphere", order=2, radius=3.0)
    trace = TraceSpace(domain.mesh, 2)
    place = (0.0, -0.6, 0.8)
    vector = point_load_vector(domain, trace, points((place, (2.0, 0.0, 1.0))))
    assert vector.shape == (trace.space.ndof,)
    forces = NodalForces(domain, points((place, (2.0, 0.0, 1.0))))
    at = locate(domain, place).position
    assert forces.moment(CF((0, 0, 0))) == pytest.approx(np.cross(at, (2.0, 0.0, 1.0)), abs=1e-10)
