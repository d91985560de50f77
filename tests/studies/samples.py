"""The cheapest balloon, and studies of it whose cases end in every way a case can end."""

from __future__ import annotations

import json
import os
import signal
import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from embedding import Scene
from embedding.studies import Study, cases_of
from embedding.studies.files import read_json
from tests.balloons import SMALLEST as SCENE

PRESSURE = "loads.pressure_bottom"
QUANTITIES = {"stretch": "stretch", "largest": "max of stretch_max", "reached": "pressure_difference at last"}


def balloon() -> Scene:
    return Scene.from_toml(SCENE)


def study(parameters: Mapping[str, Any], **fields: Any) -> Study:
    """A study of the balloon."""
    return Study(**{"scene": balloon(), "parameters": parameters, "quantities": QUANTITIES, **fields})


def keys(study: Study) -> list[str]:
    return [case.key for case in cases_of(study)]


@contextmanager
def signals(folder: Path, sent: Mapping[str, signal.Signals]) -> Iterator[None]:
    """Send signals to the processes of cases as soon as they tell their number; none of them is a fork of this one."""
    over, forks = threading.Event(), list[str]()

    def watch() -> None:
        waiting = dict(sent)
        while waiting and not over.is_set():
            for key in list(waiting):
                try:
                    told = json.loads((folder / "cases" / key / "progress.json").read_text())
                except (OSError, ValueError):
                    continue
                status = Path(f"/proc/{told['process']}/status").read_text()
                forks.extend([key] if f"PPid:\t{os.getpid()}\n" in status else [])
                os.kill(told["process"], waiting.pop(key))
            time.sleep(0.005)

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        yield
    finally:
        over.set()
        watcher.join()
    assert forks == []


def process_of(folder: Path, key: str) -> int:
    """The number of the process that solves a case, as soon as it has accepted a step."""
    while True:
        told = read_json(folder / "cases" / key / "progress.json")
        if told is not None and told["step"] > 0:
            return int(told["process"])
        time.sleep(0.01)


def gone(process: int) -> bool:
    status = Path(f"/proc/{process}/status")
    return not status.exists() or "State:\tZ" in status.read_text()
