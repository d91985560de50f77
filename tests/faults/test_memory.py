"""A process that solves and solves needs no more memory: neither over 500 solves nor over 500 steps of one.

What counts is the heap in use, as the C library tells it, after the garbage is collected: the resident memory besides
holds what the heap keeps in reserve. ``pytest -m slow tests/faults/test_memory.py`` runs it, for some minutes.
"""

from __future__ import annotations

import ctypes
import gc
import sys
from pathlib import Path

import numpy as np
import pytest
from netgen.occ import ResetGlobalShapeProperties

from embedding import Listener, Scene, load_scene, solve
from embedding.geometry.domain import build
from embedding.plan import explain
from embedding.solving.events import StepRecord
from embedding.solving.state import State
from tests.balloons import SMALLEST
from tests.faults.runs import SCENE, SETS

SOLVES, STEPS = 500, 500
PER_SOLVE = 16e3
"""Bytes; measured are 3.5e3 after the first fifty solves, of which a mesh alone is some hundred times as large."""
PER_STEP = 16e3
"""Bytes; a step keeps its record, with some hundred scalars and its Newton history, in the solution."""

pytestmark = [pytest.mark.slow, pytest.mark.skipif(sys.platform != "linux", reason="asks glibc")]


FIELDS = ("arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks", "fordblks", "keepcost")


class _Info(ctypes.Structure):
    """``struct mallinfo2`` of glibc."""

    _fields_ = [(name, ctypes.c_size_t) for name in FIELDS]


def in_use() -> int:
    """Bytes of the heap that somebody holds."""
    gc.collect()
    library = ctypes.CDLL("libc.so.6")
    library.mallinfo2.restype = _Info
    found = library.mallinfo2()
    return int(found.uordblks + found.hblkhd)


def growth(used: list[int]) -> float:
    """Bytes from one to the next in the second half: the median of the differences over tenths of it, so that what is
    loaded once does not count."""
    later = np.array(used[len(used) // 2 :])
    pace = max(len(later) // 10, 1)
    return float(np.median(later[pace:] - later[:-pace])) / pace


def test_solves(tmp_path: Path) -> None:
    scene, used = Scene.from_toml(SMALLEST), []
    for _ in range(SOLVES):
        solve(scene, archive=tmp_path / "run.vtkhdf")
        used.append(in_use())
    print(f"{growth(used):.0f} bytes per solve, {used[-1] / 1e6:.1f} MB in use")
    assert growth(used) < PER_SOLVE


def test_solves_with_a_field() -> None:
    scene, used = load_scene(SCENE, SETS), []
    for _ in range(SOLVES):
        solve(scene)
        used.append(in_use())
    print(f"{growth(used):.0f} bytes per solve, {used[-1] / 1e6:.1f} MB in use")
    assert growth(used) < PER_SOLVE


def test_meshes() -> None:
    """Netgen keeps the names of every shape that was ever meshed, some 20 kB each, until it is told to forget them."""
    scene = load_scene(SCENE, SETS)
    plan, used = explain(scene), []
    for _ in range(100):
        build(scene.shell.shape, plan.reduction, plan.sizes)
        ResetGlobalShapeProperties()
        used.append(in_use())
    print(f"{growth(used):.0f} bytes per mesh")
    assert growth(used) < 2e3


class Used(Listener):
    """The heap in use after every step."""

    def __init__(self) -> None:
        self.bytes: list[int] = []

    def accepted(self, state: State, record: StepRecord) -> None:
        self.bytes.append(in_use())


def test_steps(tmp_path: Path) -> None:
    scene, used = load_scene(SCENE, (*SETS[:-1], f"path.0.steps={STEPS}")), Used()
    solve(scene, archive=tmp_path / "run.vtkhdf", listeners=[used])
    print(f"{growth(used.bytes):.0f} bytes per step, {used.bytes[-1] / 1e6:.1f} MB in use")
    assert len(used.bytes) >= STEPS
    assert growth(used.bytes) < PER_STEP
