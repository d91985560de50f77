"""A writer with small made-up steps whose every number is known, for tests that kill it: ``python
small_writer.py FILE``."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from embedding.archive.reader import Archive
from embedding.archive.writer import ArchiveWriter, SampledField
from embedding.solving.events import Iteration, StepRecord

DOCUMENTS = {"scene": "", "plan": "{}", "scales": "{}", "versions": "{}", "run": "{}"}
POINTS = {"shell": 50, "outside": 700}


def numbers(seed: int, size: int) -> Any:
    """Numbers that are known from the seed; the same in float32 and float64."""
    return np.random.default_rng(seed).integers(-1000, 1000, size).astype(float)


def block(points: int) -> Any:
    """The face of a block of straight segments."""
    cells = np.column_stack([np.arange(points - 1), np.arange(1, points)])
    return SimpleNamespace(
        points=np.zeros((points, 3)), cells=cells, cell_type=68, order=1, point_count=points
    )


def writer(path: Path) -> ArchiveWriter:
    """A writer of two blocks."""
    return ArchiveWriter(path, {name: block(points) for name, points in POINTS.items()}, DOCUMENTS)


def record(number: int) -> StepRecord:
    """The record of a step."""
    rows = range(number % 4 + 1)
    iterations = tuple(Iteration(k, number + k, number - k, 7.0 * k, 9.0 * number) for k in rows)
    stage, scalars = f"stage {number % 3}", {"stretch": float(number**2)}
    return StepRecord(number, stage, number / 7, number / 5, iterations, scalars, 0.5)


def fields(number: int) -> list[SampledField]:
    """The fields of a step."""
    return [
        SampledField("shell", "u", "m", numbers(number, 150).reshape(-1, 3)),
        SampledField("shell", "p_t", "Pa", numbers(number + 1, 50)),
        SampledField("outside", "phi", "V", numbers(number + 2, 700)),
    ]


def memory(number: int) -> dict[str, Any]:
    """The checkpoint of a step, larger with every step."""
    return {"u": numbers(number + 3, 2000 + 100 * number), "phi": numbers(number + 4, 333), "at": number / 7}


def write(target: ArchiveWriter, number: int) -> None:
    """Commit step ``number``."""
    target.append(record(number), fields(number), memory(number))


def check(archive: Archive) -> int:
    """Compare every number of an archive with what was written; returns the number of steps."""
    count = archive.refresh()
    assert archive.steps == tuple(record(number) for number in range(1, count + 1))
    for number in range(1, count + 1):
        for field in fields(number):
            found = archive.block(field.block).field(field.name, number - 1)
            np.testing.assert_array_equal(found, field.values)
    if count:
        kept = archive.checkpoint()
        assert kept.keys() == memory(count).keys()
        for name, vector in memory(count).items():
            np.testing.assert_array_equal(kept[name], vector)
    return count


def main() -> None:
    """Write steps for ever, and say so after each."""
    target = writer(Path(sys.argv[1]))
    number = 0
    while True:
        number += 1
        write(target, number)
        print(number, flush=True)


if __name__ == "__main__":
    main()
