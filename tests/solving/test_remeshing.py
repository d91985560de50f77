"""Paths on which the space around the shell is meshed anew: the same answers, more of the way, and it is told."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from embedding import Listener, Solution, open_archive
from embedding.solving import arc, session
from embedding.solving.driver import Run
from embedding.solving.problem import Problem
from embedding.solving.result import Result
from problems import grounded_balloon, permeable_cylinder, permeable_sphere, turned_in_a_field
from tests.unestimated import unestimated

pytestmark = pytest.mark.usefixtures("unestimated")

ROUND = 'loads.edge_moments=[{ edge = "x1", moment = "83.3569 uN" }]'
TOO_FAR = 'loads.edge_moments=[{ edge = "x1", moment = "95 uN" }]'


class Meshes(Listener):
    """The number of elements of each mesh after the first."""

    def __init__(self) -> None:
        self.sizes: list[int] = []

    def remeshed(self, problem: Problem) -> None:
        self.sizes.append(problem.mesh.ne)


@pytest.mark.slow
def test_a_strip_rolled_up_to_a_full_circle(tmp_path: Path) -> None:
    """Its tip comes back to the clamp, up to half a hundredth of the turn, before it touches it; on one mesh it gets to
    three quarters."""
    solution, tip = turned_in_a_field.run(ROUND, archive=tmp_path / "rolled.vtkhdf")
    assert solution["remeshings"][0] == 0 and solution["remeshings"][-1] >= 1
    assert solution["min_jacobian"].min() > 0.02
    assert tip == pytest.approx((1.0, 0.0), abs=2 * (0.02 * np.pi) ** 2)
    check_archive(tmp_path / "rolled.vtkhdf", solution)


def check_archive(path: Path, solution: Solution) -> None:
    """One file, with every step on its own mesh."""
    archive = open_archive(path)
    archive.verify()
    assert archive.steps == solution.steps
    sizes = [len(archive.block("outside", step).points) for step in range(len(archive))]
    assert len(set(sizes)) == solution["remeshings"][-1] + 1
    assert [a != b for a, b in zip(sizes, sizes[1:], strict=False)] == list(np.diff(solution["remeshings"]) > 0)


@pytest.mark.slow
def test_a_strip_that_touches_itself_is_told_of() -> None:
    run = Run(turned_in_a_field.scene(TOO_FAR), ())
    solution = run.solve()
    assert solution.result is Result.INVERTED_AMBIENT
    assert "no new mesh of the ambient around this shape" in solution.message
    assert 95 * solution.steps[-1].factor_mechanical == pytest.approx(83.7758, rel=0.02), "the full circle"


ARC, RAMP = "path=[{control='arc-length', steps=5}]", "path=[{control='load', steps=5}]"
IN_TURN = "model.coupling='staggered'"
IN_SPACE = ("model.reduction='3d'", "path=[{control='arc-length', steps=2}]")


@pytest.mark.parametrize(
    "changes", [(ARC,), (RAMP,), (RAMP, IN_TURN), pytest.param(IN_SPACE, marks=pytest.mark.slow)],
    ids=["arc length", "load", "staggered", "3d"],
)  # fmt: skip
def test_the_answer_does_not_depend_on_it(changes: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    """A balloon pulled outwards, its mesh made anew after every step: the same but for the ambient's own error."""
    plain = grounded_balloon.run(*changes)
    monkeypatch.setattr(session, "WORN", 1.0)
    seen = Meshes()
    often = Run(grounded_balloon.scene(*changes), [seen]).solve()
    assert often.result.ok and often["remeshings"][-1] >= 1 and often["remeshings"][-1] <= len(seen.sizes)
    assert often["min_jacobian"][-1] > plain["min_jacobian"][-1]
    assert often["stretch"][-1] == pytest.approx(plain["stretch"][-1], rel=2e-4)
    assert often["charge"][-1] == pytest.approx(plain["charge"][-1], rel=2e-4)


@pytest.mark.slow
def test_through_a_limit_point(monkeypatch: pytest.MonkeyPatch) -> None:
    """Past the largest voltage the walk keeps its direction, and finds the bifurcations there."""
    end = "path=[{until={where=['20 mm', '0 mm', '0 mm'], axis='x', value='18 mm'}}]"
    changes = (*grounded_balloon.at_voltage(400e3), end)
    plain = grounded_balloon.run(*changes)
    monkeypatch.setattr(session, "WORN", 0.8)
    often = grounded_balloon.run(*changes)
    assert often["remeshings"][-1] >= 1
    kinds, places = (
        [[getattr(point, name) for point in solution.critical_points] for solution in (plain, often)]
        for name in ("kind", "factor_field")
    )
    assert kinds[0] == kinds[1] and kinds[0].count("limit") == 1
    assert places[1] == pytest.approx(places[0], rel=5e-4)
    assert often["voltage"].argmax() < len(often["voltage"]) - 1
    assert often["voltage"][-1] == pytest.approx(plain["voltage"][-1], rel=1e-3)


@pytest.mark.estimated
@pytest.mark.parametrize("order", [2, pytest.param(3, marks=pytest.mark.slow)])
def test_the_error_is_estimated_on_a_new_mesh_as_well(order: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Against a much finer solution: most of the error is that of the shell's geometry, which no new mesh changes.
    Parts that cancel count for up to twice what they change together."""
    monkeypatch.setattr(session, "WORN", 1.0)
    path = "path=[{steps=2, field=0.0}, {steps=3}]"
    with unestimated():
        fine = permeable_sphere.run(path, "discretisation.order=4", "discretisation.shell_size=2 mm")
    found = permeable_sphere.run(path, f"discretisation.order={order}")
    assert found["remeshings"][-1] >= 2 and found.error is not None
    true = abs(found["stretch"][-1] / fine["stretch"][-1] - 1.0)
    assert 0.5 < found.errors["stretch"].discretisation / true < 4.0


def test_a_mesh_that_the_scene_forbids_is_not_taken() -> None:
    """Elements beside the shell of a new mesh would reach a wire: the old one serves on."""
    wire = 'ambient.line_currents=[{through=["62 mm", "0 mm", "0 mm"], along=[0, 0, 1], current="10 A"}]'
    path = "path=[{steps=10, field=0.0, control='volume', volume_ratio=8}]"
    solution = Run(permeable_cylinder.scene(wire, path), ()).solve()
    assert solution.result.ok and solution["remeshings"][-1] == 0
    assert solution["min_jacobian"].min() < session.WORN


def test_an_interrupt_while_a_new_mesh_settles(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every accepted step is kept, and the state is the last one of them."""
    monkeypatch.setattr(session, "WORN", 1.0)

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(arc, "settled", interrupted)
    run = Run(grounded_balloon.scene(ARC), ())
    solution = run.solve()
    assert solution.result is Result.INTERRUPTED and solution.steps
    assert run.state.scalars()["stretch"] == pytest.approx(solution["stretch"][-1], rel=1e-12)
