"""What the studies share: a study from its file, a part of it, its cases with their scenes, and the command line."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from embedding import Scene
from embedding.studies import Grid, Row, Study, StudyResult, cases_of, charts, load_study, run_study

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HERE = Path(__file__).parent


def study(name: str, part: Mapping[str, Sequence[int]] | None = None) -> Study:
    """The study in the file ``name``; of the parameters in ``part`` only the values with these numbers, from 0."""
    stated = load_study(HERE / f"{name}.toml")
    if not part:
        return stated
    chosen = {path: part[axis[0]] for axis in stated.axes if axis[0] in part for path in axis}
    parameters = {
        path: [values[i] for i in chosen[path]] if path in chosen else values
        for path, values in stated.parameters.items()
    }
    design = stated.design if isinstance(stated.design, Grid) else Grid()
    return Study(
        name=stated.name, scene=stated.scene, parameters=parameters, design=design, quantities=stated.quantities,
        limits=stated.limits,
    )  # fmt: skip


def cases(result: StudyResult) -> Iterator[tuple[Scene, Row]]:
    """Every row with its scene."""
    for case, row in zip(cases_of(result.study), result.rows, strict=True):
        if case.scene is None:
            raise ValueError(f"case {case.number} has no scene: {case.refusal}")
        yield case.scene, row


def main(
    name: str, complete: Callable[[StudyResult], StudyResult], draw: Callable[[StudyResult], Figure],
    told: Callable[[StudyResult], Mapping[str, float]],
) -> None:  # fmt: skip
    """Solve the study ``name`` in the present folder, print its errors by name, and draw its chart."""
    parser = argparse.ArgumentParser(description=f"Solve the study {name} and draw its chart.")
    parser.add_argument("--chart", default=f"{name}.png", help="file of the chart: .png, .pdf or .svg")
    parser.add_argument("--workers", type=int, help="cases solved at once; default one for each processor")
    options = parser.parse_args()
    result = complete(run_study(study(name), name, workers=options.workers, progress=True))
    print(f"{len(result.rows)} cases: " + ", ".join(f"{count} {status}" for status, count in result.counts().items()))
    for what, error in told(result).items():
        print(f"{what}: {error:.1e}")
    print(f"chart: {charts.save(draw(result), options.chart)}; table: embedding table {name}")
