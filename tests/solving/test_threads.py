"""The same scene with as many threads gives the same bytes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from embedding import Listener, load_scene, solve

pytestmark = pytest.mark.usefixtures("unestimated")

CASES = {
    "a field": ("charged_balloon", "path.0.steps=1", "discretisation.order=2", "discretisation.shell_size=0.02"),
    "a membrane in 3D": ("hencky_membrane", "model.reduction=3d", "discretisation.order=2", "path.0.steps=2"),
}


class Unknowns(Listener):
    """Those of the last accepted step, as bytes."""

    def accepted(self, state: Any, record: Any) -> None:
        self.bytes = np.array(state.memory()["system"]["unknowns"]).tobytes()


def solved(problem: str, *changes: str) -> tuple[bytes, Any, Any]:
    """Unknowns, scalars and Newton history."""
    kept = Unknowns()
    solution = solve(load_scene(f"problems/{problem}.toml", changes), listeners=[kept])
    return kept.bytes, [step.scalars for step in solution.steps], [step.iterations for step in solution.steps]


@pytest.mark.parametrize("case", CASES)
def test_two_threads_give_the_same_bytes(case: str) -> None:
    first, again = (solved(*CASES[case], "solver.threads=2") for _ in range(2))
    assert first == again
