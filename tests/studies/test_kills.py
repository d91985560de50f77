"""A study that is killed with -9 at moments nobody chose: what had ended is kept, and the end is as without kills."""

from __future__ import annotations

import os
import random
import subprocess
import sys
import time
from pathlib import Path

import pytest

from embedding.studies import run_study
from embedding.studies.files import StudyFolder
from embedding.studies.index import read_index
from tests.studies.samples import PRESSURE, keys, study

SCRIPT = """
from embedding.studies import load_study, run_study
if __name__ == "__main__":
    run_study(load_study("study.toml"), ".", workers=2)
"""
KILLS = 20


@pytest.mark.slow
def test_kills_lose_nothing(tmp_path: Path) -> None:
    stated = study({PRESSURE: list(range(100, 1100, 25))})
    home, names = StudyFolder(tmp_path / "killed"), keys(stated)
    home.prepare(stated)
    script = home.path / "run.py"
    script.write_text(SCRIPT)
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    moments = random.Random(7)
    ended: dict[str, int] = {}
    for _ in range(KILLS):
        before = len(read_index(home.index))
        with subprocess.Popen([sys.executable, str(script)], cwd=home.path, env=environment) as running:
            while len(read_index(home.index)) == before and running.poll() is None:
                time.sleep(0.005)
            time.sleep(moments.uniform(0.0, 0.3))
            running.kill()
        # What has its record has ended, in the index or not; nothing of that is ever begun again.
        for name, at in ended.items():
            assert home.case(name).scene.stat().st_mtime_ns == at
        ended |= {n: home.case(n).scene.stat().st_mtime_ns for n in names if home.case(n).record.exists()}
        assert set(read_index(home.index)) <= set(ended)
    assert len(ended) >= KILLS

    result = run_study(stated, home.path)
    assert result.counts() == {"done": len(names)}
    columns = ["case", PRESSURE, *stated.quantities, "status", "reason"]
    assert result.table()[columns].equals(run_study(stated, tmp_path / "whole").table()[columns])
