"""Runs that are stopped and go on, and scenes for it: small ones of every way to follow a path."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

from embedding import Listener, Scene, load_scene, resume, solve
from embedding.archive import open_archive
from embedding.solving.events import Iteration, StepRecord
from embedding.solving.state import State
from tests.archive.same import assert_same
from tests.balloons import SMALL

ROOT = Path(__file__).parents[2]
COARSE = "discretisation.order=2"
LOAD, ARC = (f"path=[{{control='{control}', steps=3}}]" for control in ("load", "arc-length"))
CHANGES: dict[str, tuple[str, tuple[str, ...]]] = {
    "membrane": ("charged_balloon", (COARSE, "path.0.steps=3")),
    "membrane by arc length": ("grounded_balloon", (COARSE, ARC)),
    "two stages": ("permeable_sphere", (COARSE, "path.0.steps=2", "path.1.steps=2")),
    "staggered": ("grounded_balloon", (COARSE, LOAD, "model.coupling='staggered'")),
    "field once": ("grounded_balloon", (COARSE, LOAD, "model.coupling='once'")),
    "past limit points, bending": ("cap_snap_through", (COARSE,)),
    "out of rest, past pull-in": ("membrane_pull_in", (COARSE,)),
    "bending in space": ("hinged_roof", (COARSE, 'discretisation.shell_size="500 m"')),
    "pull-in under load": (
        "dielectric_balloon",
        (COARSE, "path.0.steps=1", "path.1.steps=3", "faces.bottom.voltage='20 kV'", "solver.min_step=0.1"),
    ),
    "given volume": ("sphere_inflation", (COARSE, "path=[{volume_ratio=3, steps=3}]")),
    "bent strip in a field": (
        "turned_in_a_field",
        (COARSE, "loads.edge_moments=[{edge='x1', moment='83.7758 uN'}]"),
    ),
    "coupled in space": ("grounded_balloon", (COARSE, "path.0.steps=2", "model.reduction='3d'")),
}


def scene_called(name: str) -> Scene:
    """One of ``CHANGES``, or a balloon without a field, in two steps or in many."""
    if name in ("bare balloon", "long balloon"):
        return Scene.from_toml(SMALL if name == "bare balloon" else SMALL.replace("steps = 2", "steps = 10"))
    problem, changes = CHANGES[name]
    return load_scene(ROOT / "problems" / f"{problem}.toml", changes)


class Copies(Listener):
    """Copies of an archive as it is after every step: what a kill there would leave."""

    def __init__(self, archive: Path) -> None:
        self.archive, self.paths = archive, list[Path]()

    def accepted(self, state: State, record: StepRecord) -> None:
        self.paths.append(self.archive.with_name(f"{self.archive.stem}_{record.number}.vtkhdf"))
        shutil.copy(self.archive, self.paths[-1])


def check_resumed_after(scene: Scene, folder: Path, every: int = 1) -> None:
    """A run that stops after a step, every so many of them, and goes on is the one that never stopped."""
    whole = folder / "whole.vtkhdf"
    copies = Copies(whole)
    solution = solve(scene, archive=whole, throw=False, listeners=[copies])
    for path in copies.paths[::every]:
        again = resume(path, throw=False)
        assert again.result is solution.result and again.message == solution.message
        assert again.iterations == solution.iterations
        assert_same(open_archive(path), open_archive(whole))


class Told(Listener):
    """Adds a byte to a file for each step that the archive has been told of."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def accepted(self, state: State, record: StepRecord) -> None:
        with self.path.open("ab") as file:
            file.write(b".")


def work(name: str, archive: Path, told: Path) -> None:
    """Solve a scene, or go on with its archive if there is one."""
    if archive.exists():
        resume(archive, listeners=[Told(told)])
    else:
        solve(scene_called(name), archive=archive, listeners=[Told(told)])


class Stop(Listener):
    """Stops its run in an iteration: raises an error, or kills the process if that is ``KILL``."""

    def __init__(self, step: int, iteration: int, error: type[BaseException] | None) -> None:
        self.where, self.error = (step, iteration), error

    def iterated(self, step_number: int, target: dict[str, float], iteration: Iteration) -> None:
        if (step_number, iteration.number) == self.where:
            if self.error is None:
                os.kill(os.getpid(), signal.SIGKILL)
            else:
                raise self.error


KILL = None


def start(name: str, archive: Path, *more: str) -> subprocess.Popen[bytes]:
    """A process that solves a scene of this module with an archive, or goes on with it if ``more`` is "resume"; two
    numbers say in which step and iteration it kills itself."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, "-m", "tests.archive.resumed", name, str(archive), *more]
    return subprocess.Popen(command, cwd=ROOT, env=environment)


def main(name: str, archive: str, *more: str) -> None:
    """What :func:`start` starts."""
    going_on = more[:1] == ("resume",)
    stops = [Stop(int(more[-2]), int(more[-1]), KILL)] if len(more) > 1 else []
    if going_on:
        resume(archive, listeners=stops)
    else:
        solve(scene_called(name), archive=archive, listeners=stops)


if __name__ == "__main__":
    main(*sys.argv[1:])
