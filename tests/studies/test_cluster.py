"""The same study on the workers of a dask scheduler: the same table, the same reasons, and lost workers."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from embedding.studies import Rows, StudyError, StudyResult, open_study, run_study
from embedding.studies.cluster import solve_on_worker
from embedding.studies.files import StudyFolder, read_json
from embedding.studies.index import read_index
from tests.studies.samples import PRESSURE, gone, keys, process_of, signals, study
from tests.studies.test_continuation import along
from tests.studies.test_running import KILLED, LATE, begun, check_rows, mixed, stretch

distributed = pytest.importorskip("distributed")
TABLE = ["case", PRESSURE, "stretch", "reached", "status", "reason", "start", "iterations"]


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    """Two workers of one thread on this machine."""
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        yield cluster


def same(one: StudyResult, other: StudyResult) -> bool:
    """To the last bit."""
    return bool(one.table()[TABLE].equals(other.table()[TABLE]))


def test_dask_gives_the_table_of_one_machine(cluster: Any, tmp_path: Path) -> None:
    """Of a continuation, whose cases start from each other's archives."""
    stated = along(PRESSURE, {PRESSURE: [500, 600]})
    found = run_study(stated, tmp_path / "dask", scheduler=cluster.scheduler_address)
    here = run_study(stated, tmp_path / "here")
    assert found.counts() == {"done": 2}
    assert [row.start for row in found.rows] == ["rest", "neighbour"]
    assert same(found, here)
    assert same(open_study(tmp_path / "dask"), found)
    there, ours = (read_index(result.folder / "index.jsonl") for result in (found, here))
    assert {key: record["states"] for key, record in there.items()} == {key: ours[key]["states"] for key in ours}


@pytest.mark.slow
def test_each_failure_is_a_row_on_dask_too(cluster: Any, tmp_path: Path) -> None:
    """One killed, one diverging, one over time; then one machine does just those, in the same folder."""
    stated, folder = mixed(4, 20.0), tmp_path / "study"
    names = keys(stated)
    with signals(folder, {names[LATE]: signal.SIGSTOP, names[KILLED]: signal.SIGKILL}):
        first = run_study(stated, folder, scheduler=cluster)
    check_rows(first, 20.0)
    before = begun(folder, names)
    last = run_study(stated, folder)
    assert last.counts() == {"done": 6, "diverged": 1}
    assert [name for name, at in begun(folder, names).items() if at != before[name]] == names[:3]


LONG = {PRESSURE: [500, 600], "path.0.steps": [60]}


@pytest.mark.slow
def test_a_lost_worker_is_replaced(cluster: Any, tmp_path: Path) -> None:
    """Its case ends with it, and is solved by another worker."""
    stated, folder, ended = study(LONG), tmp_path / "study", list[int]()
    (key, _) = keys(stated)

    def lose() -> None:
        case = process_of(folder, key)
        worker = int(Path(f"/proc/{case}/stat").read_text().rpartition(")")[2].split()[1])
        assert worker in {each.pid for each in cluster.workers.values()}
        os.kill(worker, signal.SIGKILL)
        ended.append(case)

    with ThreadPoolExecutor(1) as threads:
        losing = threads.submit(lose)
        result = run_study(stated, folder, scheduler=cluster)
        losing.result()
    assert result.counts() == {"done": 2}
    assert gone(ended[0])
    known = [stretch(500.0), stretch(600.0)]
    assert [row.quantities["stretch"] for row in result.rows] == pytest.approx(known, rel=2e-4)


@pytest.mark.slow
def test_the_end_of_the_study_ends_its_cases(cluster: Any, tmp_path: Path) -> None:
    """Here by a quantity that is none, as the first case tells; the second would take long."""
    stated = study({PRESSURE: [500, 600], "path.0.steps": [2, 10000]}, quantities={"wide": "strech"}, design=Rows())
    folder = tmp_path / "study"
    with ThreadPoolExecutor(1) as threads:
        case = threads.submit(process_of, folder, keys(stated)[1])
        with pytest.raises(StudyError, match="no scalar strech"):
            run_study(stated, folder, scheduler=cluster)
        while not gone(case.result()):
            time.sleep(0.05)
    assert open_study(folder).rows[1].status == "missing"


@pytest.mark.slow
def test_a_study_that_is_killed_takes_its_cases_along(cluster: Any, tmp_path: Path) -> None:
    """By the command line, whose process is killed; then the study is solved here."""
    stated = study({PRESSURE: [500], "path.0.steps": [60]})
    StudyFolder(tmp_path / "study").prepare(stated)
    words = ["study", "study/study.toml", "--folder", "study", "--scheduler", cluster.scheduler_address]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen([sys.executable, "-m", "embedding.cli", *words], cwd=tmp_path, env=environment) as command:
        case = process_of(tmp_path / "study", keys(stated)[0])
        command.kill()
    while not gone(case):
        time.sleep(0.05)
    assert open_study(tmp_path / "study").counts() == {"missing": 1}
    assert run_study(stated, tmp_path / "study", workers=1).counts() == {"done": 1}


@pytest.mark.slow
def test_a_lost_scheduler_ends_the_study_with_its_reason(tmp_path: Path) -> None:
    """Its cases end, and go on in the next run."""
    stated, folder = study({PRESSURE: [500], "path.0.steps": [200]}), tmp_path / "study"
    command = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0"]
    at = tmp_path / "scheduler.json"
    with ExitStack() as stack:
        scheduler = stack.enter_context(subprocess.Popen([*command, "--no-dashboard", "--scheduler-file", str(at)]))
        stack.callback(scheduler.kill)
        command = [sys.executable, "-m", "distributed.cli.dask_worker", "--scheduler-file", str(at), "--nthreads", "1"]
        worker = stack.enter_context(subprocess.Popen([*command, "--no-dashboard", "--local-directory", str(tmp_path)]))
        stack.callback(worker.terminate)
        while (told := read_json(at)) is None:
            time.sleep(0.05)
        threads = stack.enter_context(ThreadPoolExecutor(1))
        case = threads.submit(process_of, folder, keys(stated)[0])
        case.add_done_callback(lambda _: scheduler.kill())
        result = run_study(stated, folder, scheduler=told["address"])
    (row,) = result.rows
    assert (row.status, row.reason) == ("killed", "the dask scheduler dropped it, or was lost itself")
    while not gone(case.result()):
        time.sleep(0.05)
    last = run_study(stated, folder)
    assert (last.rows[0].status, last.rows[0].start) == ("done", "resumed")
    assert last.rows[0].quantities["stretch"] == pytest.approx(stretch(500.0), rel=2e-4)


def test_no_scheduler_is_one_message(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("embedding.studies.cluster.CONNECT", 0.2)
    with pytest.raises(StudyError, match="tcp://127.0.0.1:1: no dask scheduler answers"):
        run_study(study({PRESSURE: [500]}), tmp_path / "study", scheduler="tcp://127.0.0.1:1")


def test_a_folder_that_a_worker_does_not_see(cluster: Any) -> None:
    with distributed.Client(cluster, set_as_default=False) as client:
        record = client.submit(solve_on_worker, "/nowhere/case", None).result()
    assert record["status"] == "raised"
    assert record["reason"].endswith("does not see /nowhere/case; the folder must be one that all share")
