"""Measuring a run from the start of its process to the end, and the table of its parts."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from embedding.errors import EmbeddingError

DEFAULT_SCENE = Path(__file__).with_name("charged_balloon.toml")
REST = "everything else"
END = "end of Python"


class BenchError(EmbeddingError):
    """The run that was to be measured ended before its end."""

    exit_code = 3


@dataclass(frozen=True)
class Part:
    """A part of a run by its ``names``, outermost first: ``own`` seconds in itself, ``seconds`` with what is inside,
    and how often it ran."""

    names: tuple[str, ...]
    seconds: float
    own: float
    calls: int


@dataclass(frozen=True)
class Spending:
    """What a run spent: ``total`` wall seconds of its process, and ``parts`` as they ran, those inside others after
    them; the outermost add up to the total."""

    scene: str
    result: str
    reduction: str
    steps: int
    iterations: int
    unknowns: dict[str, int]
    total: float
    parts: tuple[Part, ...]

    @property
    def unaccounted(self) -> float:
        """Seconds in none of the parts that have names."""
        return sum(part.seconds for part in self.parts if part.names == (REST,))


def measure_spending(scene: str | os.PathLike[str] | None = None, overrides: Sequence[str] = ()) -> Spending:
    """Solve the scene file ``scene`` in a process of its own, with its archive, and tell where the time went.

    ``overrides`` are those of :func:`embedding.load_scene`; by default a charged balloon in three dimensions is solved.

    Raises:
        SceneError: the scene has problems, all of which are listed.
        BenchError: it cannot be modelled, or the process ended early.
    """
    from embedding.scene import load_scene  # not at the start of the process that is measured

    load_scene(scene or DEFAULT_SCENE, overrides)
    with TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        files = [os.fspath(scene or DEFAULT_SCENE), os.path.join(folder, "run.vtkhdf"), os.fspath(report)]
        begun, clock = time.monotonic(), time.perf_counter()
        command = [sys.executable, "-m", "embedding.bench.worker", *files, repr(begun), *overrides]
        ended = subprocess.run(command, capture_output=True, text=True)
        total = time.perf_counter() - clock
        if ended.returncode != 0 or not report.exists():
            raise BenchError(ended.stderr.strip() or f"the run ended with exit code {ended.returncode}")
        told = json.loads(report.read_text())
    known = {tuple(names): (seconds, calls) for names, seconds, calls in told["parts"]}
    keys = ("scene", "result", "reduction", "steps", "iterations", "unknowns")
    return Spending(**{key: told[key] for key in keys}, total=total, parts=tuple(arranged(known, total)))


def arranged(known: dict[tuple[str, ...], tuple[float, int]], total: float) -> Iterable[Part]:
    """The parts from their own seconds and calls, each before those inside it, with what is left of ``total``."""
    rest, _ = known.get((), (0.0, 0))
    end = total - sum(own for own, _ in known.values())

    def inside(names: tuple[str, ...]) -> Iterable[Part]:
        within = {key: value for key, value in known.items() if key[: len(names)] == names}
        own, calls = known.get(names, (0.0, 0))
        yield Part(names, sum(seconds for seconds, _ in within.values()), own, calls)
        for child in dict.fromkeys(key[: len(names) + 1] for key in within if len(key) > len(names)):
            yield from inside(child)

    for name in dict.fromkeys(key[:1] for key in known if key):
        yield from inside(name)
    yield Part((REST,), rest, rest, 0)
    yield Part((END,), end, end, 1)
