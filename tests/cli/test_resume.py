"""`embedding resume` and `embedding verify` from the outside: what is said, exit codes, and what is left behind."""

from __future__ import annotations

import json
import re
import signal
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

from embedding import ArchiveError, open_archive, solve
from embedding.archive import recorder, resuming, salvage
from embedding.archive.layout import LIBVER
from embedding.scene import load_scene
from tests.archive.resumed import Stop
from tests.archive.same import assert_same
from tests.cli.conftest import Outcome

Call = Callable[..., Outcome]


class Pressed(Stop):
    """Ctrl-C in an iteration."""

    def iterated(self, step_number, target, iteration) -> None:  # type: ignore[no-untyped-def]
        if (step_number, iteration.number) == self.where:
            signal.raise_signal(signal.SIGINT)


@pytest.fixture
def stopped(scene_file: Path) -> Path:
    """The archive of a run that stopped in its second step."""
    path = Path("run.vtkhdf")
    solve(load_scene(scene_file), archive=path, throw=False, listeners=[Stop(2, 1, KeyboardInterrupt)])
    return path


def test_a_run_goes_on(scene_file: Path, stopped: Path, call: Call) -> None:
    call("run", scene_file, "--out", "whole.vtkhdf", "--no-progress")
    outcome = call("resume", stopped)
    assert outcome.code == 0, outcome.err
    assert outcome.out.startswith("small balloon: converged after 2 steps\n")
    assert_same(open_archive(stopped), open_archive("whole.vtkhdf"))
    again = call("resume", stopped)
    assert again.code == 2 and again.out == ""
    assert again.err == "error: run.vtkhdf: the run is finished: there is nothing to resume\n"


def test_as_json(stopped: Path, call: Call) -> None:
    report = json.loads(call("resume", stopped, "--json", "--no-progress").out)
    assert (report["result"], report["steps"], report["archive"]) == ("CONVERGED", 2, "run.vtkhdf")
    assert json.loads(call("resume", stopped, "--json").out)["error"]["kind"] == "archive"


def test_an_interrupt_says_how_to_go_on(scene_file: Path, call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    from embedding.cli import interrupts

    pressed = Pressed(2, 1, None)

    class Watched(interrupts.Interrupts):
        def iterated(self, step_number, target, iteration) -> None:  # type: ignore[no-untyped-def]
            pressed.iterated(step_number, target, iteration)
            super().iterated(step_number, target, iteration)

    monkeypatch.setattr(interrupts, "Interrupts", Watched)
    outcome = call("run", scene_file, "--no-progress")
    assert outcome.code == 130
    hint = re.search(r"embedding (resume \S+\.vtkhdf)", outcome.err)
    assert hint is not None
    pressed.where = (0, 0)
    assert call(*hint[1].split(), "--no-progress").code == 0


def test_other_versions(stopped: Path, call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    true = recorder.versions()
    monkeypatch.setattr(resuming, "versions", lambda: true | {"numpy": "99"})
    outcome = call("resume", stopped, "--no-progress")
    assert outcome.code == 0
    assert outcome.err.startswith("warning: run.vtkhdf: numpy ") and outcome.err.count("\n") == 1


def test_verify(stopped: Path, call: Call) -> None:
    outcome = call("verify", stopped)
    assert (outcome.code, outcome.out, outcome.err) == (0, "run.vtkhdf: whole; 1 step\n", "")
    report = json.loads(call("verify", stopped, "--json").out)
    assert report["sound"] and report["resumable"] and report["whole"] == [1]


def test_a_finished_run_is_not_resumable(stopped: Path, call: Call) -> None:
    """What `verify` says is what `resume` does."""
    call("resume", stopped, "--no-progress")
    report = json.loads(call("verify", stopped, "--json").out)
    assert report["sound"] and not report["resumable"]
    assert "the run is finished" in call("resume", stopped).err


def test_what_is_saved_takes_the_place_of_nothing(stopped: Path, call: Call) -> None:
    other = Path("other.vtkhdf")
    other.write_bytes(b"of another run")
    outcome = call("verify", stopped, "--save", other)
    expected = "error: --save: 'other.vtkhdf' exists already, and would be lost: name another\n"
    assert (outcome.code, outcome.out, outcome.err) == (2, "", expected)
    with pytest.raises(ArchiveError, match="exists already; what is saved needs a file of its own"):
        salvage(stopped, other)
    assert other.read_bytes() == b"of another run"


def test_verify_a_damaged_one(stopped: Path, call: Call) -> None:
    call("resume", stopped, "--no-progress")
    with h5py.File(stopped, "r+", libver=LIBVER) as file:
        file["embedding/scalars/stretch"][1] = np.pi
    outcome = call("verify", stopped, "--save", "saved.vtkhdf")
    assert (outcome.code, outcome.out) == (2, "")
    expected = "damaged: rows of step 2. Whole, and to be saved: step 1 of 2 steps. They are in saved.vtkhdf"
    assert outcome.err == f"error: run.vtkhdf: the archive is {expected}\n"
    assert call("verify", "saved.vtkhdf").code == 0
    report = json.loads(call("verify", stopped, "--json").out)["error"]
    assert report["kind"] == "archive" and report["whole"] == [1] and report["damages"] == ["rows of step 2"]
    assert call("resume", stopped).code == 2
    assert call("verify", stopped, "--save", "saved.txt").code == 2


@pytest.mark.parametrize(
    ("content", "part"),
    [
        (None, "no such archive"),
        (b"", "is empty"),
        (b"scene", "is not an HDF5 file"),
        (b"\x89HDF\r\n\x1a\n" + bytes(200), "damaged"),
    ],
)
@pytest.mark.parametrize("command", ["resume", "verify"])
def test_what_is_no_archive(scene_file: Path, call: Call, command: str, content: bytes | None, part: str) -> None:
    if content is not None:
        Path("run.vtkhdf").write_bytes(content)
    outcome = call(command, "run.vtkhdf")
    assert (outcome.code, outcome.out) == (2, "")
    assert outcome.err.startswith("error: run.vtkhdf: ") and part in outcome.err
    assert outcome.err.count("\n") == 1
