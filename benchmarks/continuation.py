"""Studies along a parameter: each case from the state of the one before, against all from rest.

Newton iterations of all cases but the first, which starts from rest in either, those of failed attempts included; time
is that of the processor, meshes and archives included, relative to starts from rest; "off" is the largest difference of
the answers, relative. Three scenes: a balloon with the field in its wall and around it; the same over its stiffness,
which has no path to follow and is reached in one leap or not at all; a strip that bends far from one field to the next.

Run on its own: ``python -m benchmarks.continuation`` (about a minute); with ``docs`` it writes the table of
docs/studies.md.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from benchmarks.pages import tell
from embedding import Scene, Solution, load_scene, solve
from embedding.studies import cases_of
from problems import dielectric_balloon
from problems.studies import common

PAGE, MARK = Path(__file__).parents[1] / "docs" / "studies.md", "<!-- continuation -->"
KILOVOLTS = (2, 5, 8, 11, 14, 16)
KILOPASCALS = (40, 38, 36, 34, 32, 30)
HEADING = (
    "| along | cases | iterations | from rest | time, from rest 1 | off |",
    "| --- | --- | --- | --- | --- | --- |",
)


class Sweep(NamedTuple):
    """Scenes along a parameter, and the scalar that is compared."""

    name: str
    scenes: Sequence[Scene]
    scalar: str


def sweeps() -> Iterator[Sweep]:
    """The three of the table."""
    for name, path, values in (
        ("voltage, dielectric balloon", "faces.bottom.voltage", [1e3 * value for value in KILOVOLTS]),
        ("stiffness, dielectric balloon", "shell.material.shear_modulus", [1e3 * value for value in KILOPASCALS]),
    ):
        yield Sweep(name, [load_scene(dielectric_balloon.SCENE, [f"{path}={value!r}"]) for value in values], "stretch")
    cases = cases_of(common.study("magnetic_strip", {"shell.remanence.0": [4]}))
    yield Sweep("field, hard-magnetic strip", [case.scene for case in cases if case.scene is not None], "displacement")


def solutions(scenes: Sequence[Scene], *, follow: bool) -> list[Solution]:
    """All but the first, each from the archive of the one before it, or from rest; either leaves archives."""
    found, start = [], None
    with tempfile.TemporaryDirectory() as folder:
        for number, scene in enumerate(scenes):
            archive = Path(folder) / f"{number}.vtkhdf"
            found.append(solve(scene, archive=archive, start=start))
            start = archive if follow else None
    return found[1:]


def report() -> Iterator[str]:
    """The table, line by line."""
    yield from HEADING
    for sweep in sweeps():
        warm, cold = (solutions(sweep.scenes, follow=follow) for follow in (True, False))
        pairs = [[each.steps[-1].scalars[sweep.scalar] for each in two] for two in zip(warm, cold, strict=True)]
        off = max(abs(one / other - 1.0) for one, other in pairs)
        iterations = [sum(each.iterations for each in some) for some in (warm, cold)]
        seconds = [sum(each.cost.cpu_seconds for each in some) for some in (warm, cold)]
        followed = sum(each.start == "neighbour" for each in warm)
        yield (
            f"| {sweep.name} | {len(warm)}, {followed} from their neighbour | {iterations[0]} | {iterations[1]} | "
            f"{seconds[0] / seconds[1]:.2f} | {off:.0e} |"
        )


if __name__ == "__main__":
    tell(report(), PAGE if "docs" in sys.argv else None, MARK)
