"""Following a path, finding what is on it and leaving it, on a truss whose paths are known in closed form."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from embedding.solving.branches import onto_branch
from embedding.solving.continuation import Condition, Corrector, Direction, Metric, at_parameter
from embedding.solving.critical import Critical, Search, nearest_mode
from embedding.solving.curve import Curve, Point, basis
from embedding.solving.result import Result
from embedding.solving.walk import Stride, Walk, start
from tests.solving.truss import HEIGHT, LIMIT, SIDEWAYS, Truss, force

STRIDE = Stride(0.1, 0.25, 1e-4)
PEAK = force(float(LIMIT))


def unwatched(number: int, size: float, decrement: float) -> None:
    """Nobody listens."""


def walker(truss: Truss, goal: Condition) -> tuple[Walk, Corrector, Metric]:
    corrector = Corrector(truss, 1e-12, 12)
    begun = start(corrector, goal, unwatched)
    assert not isinstance(begun, Result)
    metric, here = begun
    return Walk(corrector, metric, here, goal, STRIDE, unwatched, lambda length, reason: None), corrector, metric


def walked(truss: Truss, goal: Condition, most: int = 200) -> tuple[list[Point], list[Critical]]:
    """The points of a walk to its goal, and the critical points on it."""
    walk, corrector, metric = walker(truss, goal)
    points, critical = [walk.here], list[Critical]()
    while not walk.done:
        assert len(points) < most
        assert walk.advance() is None
        found = Search(corrector, metric, unwatched).between(points[-1], walk.here)
        assert found is not None
        critical += found
        truss.restore(walk.here.saved)
        points.append(walk.here)
    return points, critical


@pytest.mark.parametrize("target", [0.3, 0.9, 0.9999])
def test_a_goal_before_the_limit_point(target: float) -> None:
    """On the first branch, exactly, without having gone beyond."""
    points, critical = walked(Truss(PEAK), at_parameter(target))
    z = HEIGHT - points[-1].values[1]
    assert points[-1].parameter == pytest.approx(target, abs=1e-13)
    assert force(z) / PEAK == pytest.approx(target, rel=1e-9) and z > LIMIT
    assert max(p.parameter for p in points) <= target + 1e-12
    assert all(one.kind == "bifurcation" for one in critical)


@pytest.mark.parametrize("target", [1.0001, 1.5, 20.0])
def test_a_goal_behind_two_limit_points(target: float) -> None:
    """The first state with this force lies on the other side, upside down; every state on the way is an equilibrium."""
    points, critical = walked(Truss(PEAK), at_parameter(target))
    z = np.array([HEIGHT - p.values[1] for p in points])
    assert [force(float(one)) / PEAK for one in z] == pytest.approx([p.parameter for p in points], abs=1e-9)
    assert np.all(np.diff(z) < 0) and z[-1] < -HEIGHT
    assert [one.kind for one in critical] == ["bifurcation", "limit", "limit", "bifurcation"]
    assert [one.unstable for one in critical] == [(0, 1), (1, 2), (2, 1), (1, 0)]
    heights = [HEIGHT - one.point.values[1] for one in critical]
    assert heights == pytest.approx([SIDEWAYS, LIMIT, -LIMIT, -SIDEWAYS], abs=1e-7)
    forces = [force(float(one)) / PEAK for one in (SIDEWAYS, LIMIT, -LIMIT, -SIDEWAYS)]
    assert [one.parameter for one in critical] == pytest.approx(forces, rel=1e-7)


def test_critical_modes() -> None:
    """Sideways where branches cross, along the path where the force turns."""
    _, critical = walked(Truss(PEAK), at_parameter(1.5))
    for one in critical:
        expected = [1.0, 0.0] if one.kind == "bifurcation" else [0.0, 1.0]
        assert np.abs(one.mode) == pytest.approx(expected, abs=1e-6)


def test_a_goal_in_displacement() -> None:
    """Between the limit points, where no force leads: v = 2, the bars flat."""
    goal = Condition(np.array([0.0, 1.0]), 0.0, 2.0)
    points, _ = walked(Truss(PEAK), goal)
    assert points[-1].values == pytest.approx([0.0, 2.0], abs=1e-12)
    assert points[-1].parameter == pytest.approx(0.0, abs=1e-9)


def test_back_down_the_falling_branch() -> None:
    """From there to a force again: towards it, whichever way that is."""
    truss = Truss(PEAK)
    walked(truss, Condition(np.array([0.0, 1.0]), 0.0, 2.0))
    points, _ = walked(truss, at_parameter(-0.5))
    z = HEIGHT - points[-1].values[1]
    assert force(z) / PEAK == pytest.approx(-0.5, abs=1e-9) and -LIMIT < z < 0


@pytest.mark.parametrize("amplitude", [1e-3, -1e-3, 0.2])
def test_onto_the_branch(amplitude: float) -> None:
    """The first state on it has the amplitude asked for, on the side asked for; and the walk keeps to the circle."""
    truss = Truss(PEAK)
    walk, corrector, metric = walker(truss, at_parameter(1.5))
    _, critical = walked(truss, at_parameter(1.5))
    point = onto_branch(corrector, metric, critical[0], amplitude, unwatched)
    assert point is not None
    side = np.sign(critical[0].mode[0])
    assert side * point.values[0] == pytest.approx(amplitude, rel=1e-9)
    walk.goal = Condition(np.array([1.0, 0.0]), 0.0, side * np.sign(amplitude) * 0.8 * SIDEWAYS)
    walk.go_on_from(point, 2 * abs(amplitude))
    while not walk.done:
        assert walk.advance() is None
        u, v = walk.here.values
        assert u**2 + (HEIGHT - v) ** 2 == pytest.approx(HEIGHT**2 - 2.0, rel=1e-9)
        assert walk.here.unstable == 1
    assert abs(walk.here.values[0]) == pytest.approx(0.8 * SIDEWAYS)


def test_what_no_step_reaches_is_given_up() -> None:
    """A corrector that may not iterate."""
    truss = Truss(PEAK)
    walk, corrector, _ = walker(truss, at_parameter(1.5))
    cuts: list[float] = []
    walk._told_cut = lambda length, reason: cuts.append(length)
    corrector.max_iterations = 1
    assert walk.advance() is Result.STEP_BELOW_MINIMUM
    assert cuts[-1] < 2.1 * STRIDE.smallest
    assert truss.values() == pytest.approx([0.0, 0.0]) and truss.parameter == 0.0


def test_a_step_can_be_given_up() -> None:
    truss = Truss(PEAK)
    walk, *_ = walker(truss, at_parameter(1.5))
    walk.advance()
    first = walk.here
    walk.advance()
    walk.retract()
    assert walk.here is first and not walk.done
    assert walk.shorten(Result.COMPRESSIVE_MEMBRANE)
    assert truss.values() == pytest.approx(first.values)


def test_cubics_are_interpolated_exactly() -> None:
    """p(s) = s^3 - 2 s on [1, 3], inside and beyond."""
    for at in (1.0, 1.7, 3.0, 4.2):
        weights = basis(1.0, 3.0, at)
        assert np.dot(weights, [-1.0, 1.0, 21.0, 25.0]) == pytest.approx(at**3 - 2 * at)


def test_the_first_crossing_of_several() -> None:
    """A cubic with the roots 0.25, 0.5 and 0.75 on [0, 1]."""
    polynomial = np.polynomial.Polynomial.fromroots([0.25, 0.5, 0.75])
    slope = polynomial.deriv()
    values = (float(polynomial(0.0)), float(slope(0.0)), float(polynomial(1.0)), float(slope(1.0)))
    ends: list[Any] = [Point(np.zeros(1), 0.0, place, Direction(np.zeros(1), 1.0), None, None) for place in (0.0, 1.0)]
    assert Curve(*ends).first_crossing((0.0, 1.0), values) == pytest.approx(0.25)
    assert Curve(*ends).first_crossing((0.3, 1.0), values) == pytest.approx(0.5)
    assert Curve(*ends).first_crossing((0.8, 1.0), values) is None


def test_the_mode_next_to_zero() -> None:
    """Of a matrix with a mass: the smallest of the eigenvalues by size, with its sign."""
    truss = Truss()
    truss.matrix = np.array([[-0.5, 0.2], [0.2, 3.0]])
    value, modes = nearest_mode(truss)
    eigenvalues, vectors = np.linalg.eigh(truss.matrix)
    nearest = int(np.argmin(np.abs(eigenvalues)))
    assert value == pytest.approx(eigenvalues[nearest], rel=1e-6)
    cosine = modes[:, 0] @ vectors[:, nearest] / np.linalg.norm(modes[:, 0])
    assert abs(cosine) == pytest.approx(1.0, abs=1e-6)
