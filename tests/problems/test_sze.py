"""Published nonlinear shells with default settings: end values within half a per cent, and what they cost.

Where finer meshes lead to other values than the published four-node elements, both are asserted: the published value at
its distance, and the converged one.
"""

from __future__ import annotations

import pytest

from problems import half_cylinder, hemisphere_with_hole, pinched_cylinder, pulled_cylinder, slit_annulus, t_cantilever
from problems.common import LoadPath
from problems.published.case import Case
from tests.problems.measures import orders
from tests.unestimated import unestimated

HALF_A_PER_CENT = 5e-3
MOST = 150


def off(path: LoadPath, case: Case) -> float:
    """Largest relative difference from the published end values."""
    return max(abs(path.end(name) / case.end(name) - 1.0) for name in path.values)


@pytest.mark.parametrize("problem", [
    hemisphere_with_hole, t_cantilever, pytest.param(half_cylinder, marks=pytest.mark.slow), pulled_cylinder,
])  # fmt: skip
def test_published_end_values(problem: object) -> None:
    path = problem.run()  # type: ignore[attr-defined]
    assert off(path, problem.CASE) < HALF_A_PER_CENT  # type: ignore[attr-defined]
    assert path.solution.iterations <= MOST


@pytest.mark.slow
def test_slit_annulus() -> None:
    """Finer than the scene: 0.34 and 0.27 % below the published values; another code ends 0.8 and 0.6 % below."""
    coarse, fine = slit_annulus.run(), slit_annulus.run("discretisation.shell_size=1.5 m")
    assert off(fine, slit_annulus.CASE) < HALF_A_PER_CENT
    assert max(coarse.solution.iterations, fine.solution.iterations) <= MOST
    for name in fine.values:
        assert coarse.end(name) < fine.end(name) < slit_annulus.CASE.end(name)


@pytest.mark.slow
def test_hemisphere_converges() -> None:
    """Orders 3 and 4 on fine meshes end at 4.0745 and 8.1489, Kratos' triangles 64 x 64 at 4.0716 and 8.1484."""
    path = hemisphere_with_hole.run("discretisation.shell_size=2 m")
    assert path.end("outward") == pytest.approx(4.0745, rel=5e-4)
    assert path.end("inward") == pytest.approx(8.1489, rel=5e-4)
    assert path.solution.iterations <= MOST


@pytest.mark.slow
def test_pinched_cylinder() -> None:
    """Converged 83.84 and 35.7; published are 83.10 and 34.27, and 83.79 and 35.12 by another code on the same mesh.

    Its creases run through many small snaps; following all of them by arc length takes more than ``MOST`` iterations.
    """
    path = pinched_cylinder.run("discretisation.shell_size=9 m")
    assert path.end("pinched") == pytest.approx(83.84, rel=2e-3)
    assert path.end("side") == pytest.approx(35.7, rel=1e-2)
    assert abs(path.end("pinched") / pinched_cylinder.CASE.end("pinched") - 1.0) < 1e-2


@pytest.mark.slow
def test_slit_annulus_converges_at_order_three() -> None:
    """Elements of order 2, against orders 3 and 4 on finer meshes (23,589 and 20,832 unknowns): 13.8450 and 17.4826.

    Meshes are not nested, so that orders between neighbours scatter between 2.8 and 5.9.
    """
    unknowns, errors = [], []
    for size in (2.0, 0.7):
        path = slit_annulus.run("discretisation.order=2", f"discretisation.shell_size={size} m")
        unknowns.append(path.solution.cost.unknowns["u"] ** -0.5)
        errors.append(abs(path.end("inner") - 13.8450))
    assert orders(unknowns, errors)[0] > 2.7


@pytest.mark.estimated
def test_the_error_where_three_sheets_meet() -> None:
    """What the rotation at the junction is measured from goes along to the next order."""
    planned = t_cantilever.run().solution
    with unestimated():
        fine = t_cantilever.run("discretisation.order=4").solution
    assert planned.error is not None
    true = abs(planned["displacement"][-1] / fine["displacement"][-1] - 1.0)
    assert 0.5 * true < planned.error.discretisation < 5.0 * true
