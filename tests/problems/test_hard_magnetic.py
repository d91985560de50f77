"""Hard-magnetic beam and ring: exact elastica, experiment, own field, closed form of small deflections."""

from __future__ import annotations

import numpy as np
import pytest

from problems import hard_magnetic_cantilever, hard_magnetic_ring
from problems.hard_magnetic_cantilever import SCATTER, elastica_error, own_field, own_field_of_poles
from tests.problems.measures import orders


def test_thin_strip_is_the_elastica() -> None:
    """At a = 5 the tip stands at 70 degrees; the error is the strip's stretch, of second order in T/L."""
    ratios = (0.02, 0.01, 0.005)
    errors = [elastica_error(ratio, 5.0) for ratio in ratios]
    assert min(orders(ratios, errors)) > 1.95
    assert errors[1] < 4e-4
    assert elastica_error(0.005, 29.8) < 3e-4, "the largest measured field"


def test_experiment() -> None:
    """A plate of the beam's width, every measured point within its scatter; stiffer than a beam, as it is held wide."""
    found = hard_magnetic_cantilever.measured()
    away = found["found"] - found["measured"]
    assert np.abs(away).max() < SCATTER
    assert np.sqrt(np.mean(away**2)) < 0.03
    softer = found["elastica"] - found["found"]
    assert np.all((softer > 0.0) & (softer < 0.027))


@pytest.mark.parametrize(("size", "tolerance"), [("1.7 mm", 0.15), ("0.86 mm", 0.05)])
def test_own_field(size: str, tolerance: float) -> None:
    """Two poles that attract each other, each spread over a thickness, 5 % of the length; such elements resolve it."""
    known = own_field_of_poles() - 1.0
    assert known > 0.04
    found = own_field(300.0, f"discretisation.shell_size={size}") - 1.0
    assert found == pytest.approx(known, rel=tolerance)


def test_ring() -> None:
    """Both modes of the clover, of second order in T/R; no other."""
    ratios = (0.02, 0.01)
    errors = []
    for ratio in ratios:
        changes = hard_magnetic_ring.SMALL, f"shell.thickness={ratio * 1e-2!r}", "discretisation.shell_size=1 mm"
        # A thinner ring is softer: the same deflection.
        changes = (*changes, f"ambient.applied_field=[{10.0 * (ratio / 0.02) ** 2!r}, 0.0, 0.0]")
        solution, found = hard_magnetic_ring.run(*changes)
        exact = hard_magnetic_ring.exact(solution.scene)
        errors.append(max(abs(found[m] / known - 1.0) for m, known in exact.items()))
        others = [abs(value) for m, value in found.items() if m not in exact]
        assert max(others) < 1e-6 * exact[2]
    assert errors[0] < 3e-4
    assert errors[1] < 0.35 * errors[0]


def test_a_ring_bent_far() -> None:
    """A tenth of the radius: the modes still have their signs and sizes, the larger is a per cent short."""
    solution, found = hard_magnetic_ring.run()
    exact = hard_magnetic_ring.exact(solution.scene)
    assert found[2] == pytest.approx(exact[2], rel=1.5e-2)
    assert solution["held_force"][-1] < 1e-3
