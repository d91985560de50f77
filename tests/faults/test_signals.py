"""Ctrl-C and SIGTERM at every stage of a run: what was accepted is kept, and it is said how to go on."""

from __future__ import annotations

import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from embedding import load_scene, open_archive, resume, solve, verify
from embedding.cli import main
from embedding.coupling import linear
from embedding.solving import driver, problem
from tests.archive.same import assert_same
from tests.faults.runs import SCENE, SETS, words

WHERE: dict[str, tuple[Any, str, int]] = {
    "mesh": (problem, "build", 1),
    "factors": (linear.DirectSolver, "factor", 24),
    "error estimate": (driver, "estimate_errors", 1),
}
"""Where the signal comes: at which call of what."""


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The archive of the run that nothing happens to."""
    path = tmp_path_factory.mktemp("whole") / "run.vtkhdf"
    solve(load_scene(SCENE, SETS), archive=path)
    return path


def signalled(where: str, numbers: tuple[int, ...], patch: pytest.MonkeyPatch) -> None:
    """Let signals come in the middle of the run."""
    place, name, call = WHERE[where]
    original: Callable[..., Any] = getattr(place, name)
    calls = 0

    def with_signals(*args: Any, **kwargs: Any) -> Any:
        nonlocal calls
        calls += 1
        if calls == call:
            for number in numbers:
                signal.raise_signal(number)
        return original(*args, **kwargs)

    patch.setattr(place, name, with_signals)


@pytest.mark.parametrize("where", WHERE)
@pytest.mark.parametrize("numbers", [(signal.SIGINT,), (signal.SIGTERM,), (signal.SIGTERM, signal.SIGINT)], ids=str)
def test_a_run_that_is_told_to_end(
    where: str,
    numbers: tuple[int, ...],
    whole: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    """The first signal ends it in good order, the second at once."""
    path, before = tmp_path / "run.vtkhdf", signal.getsignal(signal.SIGTERM)
    with monkeypatch.context() as patch:
        signalled(where, numbers, patch)
        code = main(words(path))
    told = capfd.readouterr().err
    assert signal.getsignal(signal.SIGTERM) is before
    assert "Traceback" not in told
    if where == "error estimate" and len(numbers) == 1:  # nothing is left that it could spare
        assert code == 0
    else:
        assert code == 130
        assert told.startswith("error: ") and "interrupted" in told
    if where == "mesh":
        assert not path.exists() or len(open_archive(path)) == 0
        return
    found = verify(path)
    assert found.sound and found.steps > 0, found.message
    if code == 130:
        assert f"Go on with: embedding resume {path}" in told
        resume(path)
    assert_same(open_archive(path), open_archive(whole))
