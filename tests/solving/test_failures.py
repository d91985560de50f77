"""Every way a path can end has its name, and the name is the true cause; what was reached before is kept."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from embedding import Listener, Result, Scene, SolveError, open_archive, solve

pytestmark = pytest.mark.usefixtures("unestimated")

SPHERE: dict[str, Any] = {
    "shape": {"kind": "sphere", "radius": 0.02},
    "thickness": 1e-3,
    "material": {"law": "neo-hookean", "shear_modulus": 1e5},
}
CONDUCTOR = {"ambient": {"field": "electric"}, "faces": {"top": {"voltage": 1e5}, "bottom": {"voltage": 1e5}}}


def ended(**changes: Any) -> Any:
    return solve(Scene.from_table({"shell": SPHERE, **changes}), throw=False)


def test_limit_point() -> None:
    """A balloon under pressure: the maximum is 0.6197 of mu T / R times two at T/R = 0.05."""
    solution = ended(loads={"pressure_bottom": 8e3}, path=[{"control": "load"}])
    assert solution.result is Result.LIMIT_POINT
    assert solution["stretch"][-1] == pytest.approx(7 ** (1 / 6), abs=0.02)
    assert "volume" in solution.message


def test_pull_in() -> None:
    """Inside a grounded sphere of twice the radius the voltage has a maximum at a stretch of about 1.24."""
    voltages = {"top": {"voltage": 4e5}, "bottom": {"voltage": 4e5}}
    surroundings = {"field": "electric", "outer": "grounded", "radius": 0.04}
    solution = ended(
        ambient=surroundings, faces=voltages, path=[{"control": "load"}], solver={"min_step": 0.01}
    )
    assert solution.result is Result.PULL_IN
    assert solution["stretch"][-1] == pytest.approx(1.24, abs=0.03)
    assert 'control = "arc-length"' in solution.message


def test_compression() -> None:
    solution = ended(loads={"pressure_top": 8e3})
    assert solution.result is Result.COMPRESSIVE_MEMBRANE
    assert "100 % of the area" in solution.message and 'model.theory = "bending"' in solution.message
    assert all(solution["min_principal_stress"] > -1e-3 * 1e5)


def test_nothing_holds_it() -> None:
    """A plate pulled along one side, free on every other."""
    plate = {**SPHERE, "shape": {"kind": "plate", "length": 1.0, "width": 1.0}}
    pull = {"edge_tractions": [{"edge": "x1", "traction": [10.0, 0.0, 5.0]}]}
    held = [{"where": "x0", "fix": ["x", "y"]}]
    solution = ended(shell=plate, loads=pull, supports=held, path=[{"steps": 1}], solver={"min_step": 0.2})
    assert not solution.result.ok
    assert solution.steps == ()


def test_inverted_ambient() -> None:
    """Inflated by volume until the outer boundary is in the way."""
    solution = ended(
        **{**CONDUCTOR, "ambient": {"field": "electric", "outer": "grounded", "radius": 0.026}},
        path=[{"steps": 4, "volume_ratio": 4.0}],
        solver={"min_step": 0.2},
    )
    assert solution.result is Result.INVERTED_AMBIENT
    assert solution["min_jacobian"][-1] > 0


class Interrupt(Listener):
    """Presses Ctrl-C in the third step."""

    def iterated(self, step_number: int, target: dict[str, float], iteration: Any) -> None:
        """Raise as the signal would."""
        if step_number == 3:
            raise KeyboardInterrupt


def test_an_interrupt_keeps_what_was_accepted(tmp_path: Path) -> None:
    scene = Scene.from_table({"shell": SPHERE, **CONDUCTOR, "path": [{"steps": 5}]})
    with pytest.raises(SolveError) as caught:
        solve(scene, archive=tmp_path / "run.vtkhdf", listeners=[Interrupt()])
    solution = caught.value.solution
    assert solution.result is Result.INTERRUPTED
    assert len(solution.steps) == 2
    archive = open_archive(tmp_path / "run.vtkhdf")
    assert archive.result.name == "INTERRUPTED"
    assert archive.scalars["stretch"].tolist() == solution["stretch"].tolist()


@pytest.mark.estimated
def test_failures_are_raised_by_default() -> None:
    scene = Scene.from_table({"shell": SPHERE, "loads": {"pressure_bottom": 8e3}})
    with pytest.raises(SolveError, match="limit point") as caught:
        solve(scene)
    assert caught.value.solution.steps
    assert caught.value.solution.error is None


def test_every_result_has_advice() -> None:
    assert all(len(result.advice) > 20 for result in Result)
