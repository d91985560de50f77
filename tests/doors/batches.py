"""Batches of cases in processes of their own, which must not die of any of them."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

from tests.archive.resumed import ROOT


def outcomes(module: str, *words: object) -> tuple[list[str], Counter[str]]:
    """The lines that ``python -m tests.doors.MODULE WORDS`` prints, and how often which "code" is in them."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1", "PYTHONWARNINGS": "ignore"}
    command = [sys.executable, "-X", "faulthandler", "-m", f"tests.doors.{module}", *map(str, words)]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, errors="replace")
    assert done.returncode == 0, done.stdout[-600:] + done.stderr[-4000:]
    assert "Traceback" not in done.stdout + done.stderr
    lines = done.stdout.splitlines()
    return lines, Counter(found[1] for line in lines if (found := re.search(r": code (\d+)", line)))


def stopped_run(path: Path) -> Path:
    """The archive of a small run with a field, interrupted after two of three steps."""
    from embedding import Listener, load_scene, solve
    from embedding.solving.events import StepRecord
    from embedding.solving.state import State

    class Stop(Listener):
        def accepted(self, state: State, record: StepRecord) -> None:
            if record.number == 2:
                raise KeyboardInterrupt

    changes = ("discretisation.order=1", 'discretisation.shell_size="15 mm"', "path.0.steps=3")
    solution = solve(
        load_scene(ROOT / "problems" / "charged_balloon.toml", changes), archive=path, throw=False, listeners=[Stop()]
    )
    assert solution.result.name == "INTERRUPTED"
    return path
