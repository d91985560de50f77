"""What accuracy costs on every problem: the whole ladder of each scene, compared; the tables of docs/trades.md.

``python -m benchmarks.trades docs FOLDER [PROBLEM ...]`` (an hour on one core) keeps the archives of all rungs in
FOLDER, and goes on with what is there; with names of problems it does only those, and leaves the rows of others.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from benchmarks.pages import merged, write
from embedding import load_scene
from embedding.studies.errors import StudyError
from embedding.trade import Trade, measure_trade
from embedding.trade.measuring import TOLERANCES

PROBLEMS = Path(__file__).parents[1] / "problems"
PAGE = Path(__file__).parents[1] / "docs" / "trades.md"
BEGINNING = {
    "half_cylinder": "path=[{mechanical=0.1}]",
    "pinched_cylinder": "path=[{mechanical=0.1, steps=2}]",
    "pulled_cylinder": "path=[{mechanical=0.1}]",
}
"""Paths of minutes on every rung; solved to a tenth of their loads."""
LONGEST = 40.0
"""Wall time in s after which a rung is given up."""
LONGER = {"dielectric_film": 240.0, "pinched_cylinder": 400.0, "plate_pull_in": 240.0}
"""The same for paths past pull-in points, and that of a cylinder with diaphragms, whose finest rungs take longer."""
MODELS = ("reduction", "shell theory", "faces", "coupling", "far field")
"""Choices of the model; those of the mesh are in the columns of the cheapest."""


def trades(folder: Path, names: Sequence[str]) -> Iterator[Trade]:
    """Every problem whose scene has an answer on its finest rung, or those of the ``names``."""
    for file in sorted(PROBLEMS.glob("*.toml")):
        if names and file.stem not in names:
            continue
        changes = (BEGINNING[file.stem],) if file.stem in BEGINNING else ()
        longest = LONGER.get(file.stem, LONGEST)
        try:
            yield measure_trade(load_scene(file, changes), folder / file.stem, seconds=longest, progress=True)
        except StudyError as error:
            print(f"{file.stem}: {error}", file=sys.stderr)


def cheapest_row(trade: Trade) -> str:
    """One problem: the plan, and the cheapest rung within each tolerance."""
    planned = next(row for row in trade.rows if row.of == "plan")
    best = trade.best()
    cells = [f"{best[t].rung} ({trade.cost(best[t]):.2g})" if best[t] else "none" for t in TOLERANCES]  # type: ignore
    plan = f"{planned.error:.1e} ({planned.estimate:.1e}), {planned.cpu_seconds:.1f} s"
    return f"| {trade.scene.name} | {trade.quantity} | {plan} | {' | '.join(cells)} |"


def model_rows(trade: Trade) -> Iterator[str]:
    """What each other model of a problem is off by, and what it costs."""
    for row in trade.rows:
        if row.of in MODELS and row.done and math.isfinite(row.error):
            yield f"| {trade.scene.name} | {row.rung} | {row.error:.1e} | {trade.cost(row):.2g} |"


def tables(folder: Path, names: Sequence[str]) -> dict[str, list[str]]:
    """The tables of the page, by their markers."""
    found = list(trades(folder, names))
    heads = " | ".join(f"within {t:g}" for t in TOLERANCES)
    cheapest = [f"| problem | answer | plan: error (estimate), CPU | {heads} |", "|" + "---|" * (3 + len(TOLERANCES))]
    models = ["| problem | in place of the plan's | error | CPU over the plan's |", "|---|---|---|---|"]
    return {
        "cheapest": cheapest + [cheapest_row(trade) for trade in found],
        "models": models + [row for trade in found for row in model_rows(trade)],
    }


if __name__ == "__main__":
    names = sys.argv[3:]
    for name, lines in tables(Path(sys.argv[2]), names).items():
        mark = f"<!-- {name} -->"
        write(PAGE, merged(PAGE, lines, mark) if names else lines, mark)
