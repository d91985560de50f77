"""Load steps from tiny to all at once, tolerances down to rounding, threads; the same bytes from the same scene."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from embedding.bench.extremes.cell import REFUSED, RIGHT, Cell, Numbers
from embedding.bench.extremes.tables import Table, clamped, metal, rubber, scene_of
from embedding.scene import Scene

if TYPE_CHECKING:
    from embedding.solving import Solution

TINY = 1e-6
PATHS: dict[str, list[Table]] = {
    "all at once": [{"control": "load", "steps": 1}],
    "10 steps": [{"control": "load", "steps": 10}],
    "200 steps, the first 1e-6": [
        {"name": "touch", "control": "load", "steps": 1, "mechanical": TINY, "field": TINY},
        {"name": "go", "control": "load", "steps": 199},
    ],
    "200 steps of 1e-6, then all": [
        {"name": "touch", "control": "load", "steps": 200, "mechanical": TINY, "field": TINY},
        {"name": "go", "control": "load", "steps": 1},
    ],
}
QUICK = {
    ("balloon", "all at once"), ("balloon", "tolerance 1e-15"), ("balloon", "once more"),
    ("cantilever", "tolerance 1e-13"), ("cantilever", "once more"),
}  # fmt: skip
"""Cells of the default tests."""
TOLERANCES = (1e-4, 1e-12, 1e-13, 1e-15)


def cells() -> list[Cell]:
    """A row for each shell, a column for each way to solve it."""
    found: list[Cell] = []
    for shell in SCENES:
        # The interior of an ambient goes the way it is led, and its mesh leaves 1e-4 of the answer open.
        way = 1e-6 if shell == "charged balloon" else 1e-9
        for name, path in PATHS.items():
            found.append(_cell(shell, name, {"path": path}, way))
        for tolerance in TOLERANCES:
            allowed = max(1e-9, 10 * tolerance)
            found.append(_cell(shell, f"tolerance {tolerance:g}", {"solver": {"tolerance": tolerance}}, allowed))
        found.append(_cell(shell, "2 threads", {"solver": {"threads": 2}}, 1e-10))
        found.append(same_bytes(shell))
    return found


def _cell(shell: str, value: str, changes: Table, tolerance: float) -> Cell:
    return Cell(
        "steps", shell, value, partial(SCENES[shell], **changes), partial(_usual, shell),
        "the same shell by its own steps", tolerance=tolerance, answers=_answers,
        slow=(shell, value) not in QUICK, seconds=300.0,
        fields=("solver.tolerance",), expected=REFUSED if value.endswith(" 1e-15") else RIGHT,
    )  # fmt: skip


def _usual(shell: str) -> Numbers:
    from embedding.api import solve

    return _answers(solve(SCENES[shell]()))


def _answers(solution: Solution) -> Numbers:
    """Scalars of the last step that say where the shell is."""
    last = solution.steps[-1].scalars
    named = ("stretch", "stretch_max", "elastic_energy", "displacement", "charge")
    return {name: last[name] for name in named if abs(last.get(name, 0.0)) > 0.0}


def same_bytes(shell: str) -> Cell:
    """Two runs of one scene on one thread: every number of every step and field the same, to the last bit."""
    return Cell(
        "steps", shell, "once more", SCENES[shell], lambda: {"same numbers": 1.0}, "the run itself", tolerance=0.0,
        answers=_compared_bytes, slow=(shell, "once more") not in QUICK,
    )  # fmt: skip


def _compared_bytes(solution: Solution) -> Mapping[str, float]:
    """1 where two more runs leave the same scalars and fields in their archives, and those of ``solution``, else 0."""
    import numpy as np

    from embedding.api import solve
    from embedding.archive import open_archive

    with TemporaryDirectory() as folder:
        kept = []
        for number in range(2):
            path = Path(folder) / f"{number}.vtkhdf"
            again = solve(solution.scene, archive=path)
            archive = open_archive(path)
            names = sorted(archive.block("shell").fields)
            fields = [np.asarray(archive.block("shell").field(name)).tobytes() for name in names]
            kept.append((names, fields, [step.scalars for step in again.steps]))
    wall = "wall_seconds"
    numbers = [[{k: v for k, v in one.items() if k != wall} for one in run[2]] for run in kept]
    numbers.append([step.scalars for step in solution.steps])
    same = kept[0][:2] == kept[1][:2] and repr(numbers[0]) == repr(numbers[1]) == repr(numbers[2])
    return {"same numbers": float(same)}


def _balloon(**more: Table) -> Scene:
    return scene_of(
        "balloon", {"kind": "sphere", "radius": 0.02}, 1e-3, rubber(1e5), loads={"pressure_bottom": 5e3},
        **({"path": [{"steps": 3}]} | more),
    )  # fmt: skip


def _charged(**more: Table) -> Scene:
    electrode = {"voltage": "500 kV"}
    return scene_of(
        "charged_balloon", {"kind": "sphere", "radius": 0.02}, 1e-3, rubber(3e4), ambient={"field": "electric"},
        faces={"top": electrode, "bottom": electrode}, **({"path": [{"steps": 3}]} | more),
    )  # fmt: skip


def _cantilever(**more: Table) -> Scene:
    return scene_of(
        "cantilever", {"kind": "strip", "length": 1.0}, 1e-2, metal(1.2e7, 0.3), supports=clamped("x0"),
        loads={"edge_tractions": [{"edge": "x1", "traction": [0.0, 4.0, 0.0]}]}, **more,
    )  # fmt: skip


def _disc(**more: Table) -> Scene:
    return scene_of(
        "disc", {"kind": "disc", "radius": 1.0}, 2e-2, metal(1.2e7, 0.3), supports=clamped("rim"),
        loads={"pressure_bottom": 40.0}, **({"model": {"reduction": "3d"}, "discretisation": {"order": 2}} | more),
    )  # fmt: skip


SCENES = {"balloon": _balloon, "charged balloon": _charged, "cantilever": _cantilever, "disc, 3D": _disc}
