"""Memory that runs out: a typed end, with every accepted step archived and able to go on."""

from __future__ import annotations

import resource
from pathlib import Path

import pytest

from embedding import Listener, SolveError, load_scene, open_archive, resume, solve, verify
from embedding.cli import main
from embedding.errors import out_of_memory
from embedding.solving.events import Iteration
from tests.archive.same import assert_same
from tests.faults.runs import SCENE, SETS, ended, limited, words


class Short(Listener):
    """Has no memory in the first iteration of the third step."""

    def __init__(self, error: Exception) -> None:
        self.error = error

    def iterated(self, step_number: int, target: dict[str, float], iteration: Iteration) -> None:
        if step_number == 3:
            raise self.error


@pytest.mark.parametrize(
    "error",
    [MemoryError(), RuntimeError("Could not allocate localheap, heapsize = 50000000")],
    ids=["python", "ngsolve"],
)
def test_in_a_step(error: Exception, tmp_path: Path) -> None:
    path, whole = tmp_path / "run.vtkhdf", tmp_path / "whole.vtkhdf"
    scene = load_scene(SCENE, SETS)
    with pytest.raises(SolveError, match="after 2 accepted steps .* there is not enough memory") as caught:
        solve(scene, archive=path, listeners=[Short(error)])
    assert caught.value.solution.result.name == "OUT_OF_MEMORY"
    assert open_archive(path).result.name == "OUT_OF_MEMORY"
    assert verify(path).sound and len(open_archive(path)) == 2
    resume(path)
    solve(scene, archive=whole)
    assert_same(open_archive(path), open_archive(whole))


def test_other_errors_are_not_of_memory() -> None:
    assert not out_of_memory(ZeroDivisionError("division by zero"))
    try:
        try:
            raise RuntimeError("std::bad_alloc: cannot allocate memory")
        except RuntimeError as first:
            raise ValueError("a step failed") from first
    except ValueError as error:
        assert out_of_memory(error)


def test_at_the_door(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def short(*_: object) -> None:
        raise ImportError("libngla.so: failed to map segment from shared object")

    monkeypatch.setattr("embedding.plan.explain", short)
    assert main(["explain", SCENE]) == 3
    assert capsys.readouterr().err.startswith("error: there is not enough memory for this: libngla.so")


@pytest.mark.slow
@pytest.mark.parametrize("megabytes", range(500, 1200, 50))
def test_a_limit_of_the_system(megabytes: int, tmp_path: Path) -> None:
    """Of the address space of the process: it ends well, or says that memory is short, wherever that is noticed."""
    path = tmp_path / "run.vtkhdf"
    finer = ("model.reduction='3d'", "discretisation.order=2", "discretisation.shell_size=7 mm", "path.0.steps=3")
    code, _, err = ended(words(path, *finer), tmp_path, limited(resource.RLIMIT_AS, megabytes << 20))
    assert "Traceback" not in err
    assert code == 0 or err.startswith("error: "), (code, err)
    assert code in (0, 2, 3), (code, err)
    if path.exists():
        found = verify(path)
        assert found.sound, found.message
