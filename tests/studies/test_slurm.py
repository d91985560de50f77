"""A study through SLURM, where there is one: jobs that start dask workers, one of which is cancelled on the way."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from embedding.studies import run_study
from tests.studies.samples import PRESSURE, gone, keys, process_of, study
from tests.studies.test_cluster import TABLE

jobqueue = pytest.importorskip("dask_jobqueue")
HERE = shutil.which("sinfo") and subprocess.run(["sinfo", "-h"], capture_output=True, timeout=30).stdout


@pytest.mark.slow
@pytest.mark.skipif(not HERE, reason="no SLURM answers here")
def test_jobs_solve_the_study(tmp_path: Path) -> None:
    """The job that has the first case is cancelled; the table is that of one machine."""
    quantities = {"stretch": "stretch", "reached": "pressure_difference at last"}
    stated = study({PRESSURE: [500, "2 kPa", 700], "path.0.steps": [60]}, quantities=quantities)
    path = os.pathsep.join(filter(None, sys.path))
    cluster = jobqueue.SLURMCluster(
        cores=1, processes=1, memory="1GB", walltime="00:10:00", interface="lo", log_directory=str(tmp_path / "logs"),
        job_script_prologue=[f"export PYTHONPATH={path}"], scheduler_options={"dashboard_address": None},
    )  # fmt: skip
    folder = tmp_path / "slurm"

    def cancel() -> int:
        case = process_of(folder, keys(stated)[0])
        job = Path(f"/proc/{case}/environ").read_bytes().split(b"SLURM_JOB_ID=")[1].split(b"\0")[0]
        subprocess.run(["scancel", job.decode()], check=True)
        return case

    with cluster, ThreadPoolExecutor(1) as threads:
        cluster.scale(jobs=2)
        cancelled = threads.submit(cancel)
        result = run_study(stated, folder, scheduler=cluster)
        assert gone(cancelled.result())
    assert result.counts() == {"done": 2, "diverged": 1}
    assert result.rows[0].start == "resumed"
    columns = [name for name in TABLE if name != "start"]
    assert result.table()[columns].equals(run_study(stated, tmp_path / "here").table()[columns])
