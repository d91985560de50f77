"""Is an accuracy that is asked for reached, what does it cost, and how near are estimates to errors?

On every scene of `problems.known`. ``python -m benchmarks.dial docs`` (some minutes on one core) writes the tables of
docs/accuracy.md. Costs are CPU time of the solves alone; the cheapest is that of all meshes of the ladder, with the
plan's own models, whose true error is within the accuracy.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from benchmarks.pages import write
from embedding import Scene, Solution, solve
from embedding.accuracy.levels import Level, ladder
from embedding.plan import explain
from problems.known import Known, all_known

PAGE = Path(__file__).parents[1] / "docs" / "accuracy.md"
ASKED = (1e-2, 1e-3, 1e-4)
ORDERS = (2, 3)
DEAREST = 20.0
"""CPU seconds beyond which no finer mesh is tried for the cheapest."""
ROUNDING = 1e-12


@dataclass(frozen=True)
class Asked:
    """An accuracy that was asked for: what came of it, its true error, estimate and CPU time, and the cheapest that
    truly meets it (None if none does)."""

    relative: float
    solution: Solution
    error: float
    estimate: float
    cpu_seconds: float
    cheapest: float | None

    @property
    def met(self) -> bool:
        """Is the error within what was asked?"""
        return self.error <= self.relative

    @property
    def ratio(self) -> float | None:
        """Its cost over the cheapest."""
        return None if self.cheapest is None else self.cpu_seconds / self.cheapest


def asked(known: Known, relative: float, rungs: Sequence[tuple[float, float]]) -> Asked:
    """Ask for a ``relative`` accuracy; ``rungs`` are (true error, CPU time) of all meshes."""
    solution = solve(with_accuracy(known, relative), throw=False)
    error = max(0.0, known.error(solution) - known.scatter)
    cpu = sum(attempt.cpu_seconds for attempt in solution.attempts)
    good = [cost for off, cost in rungs if off <= relative]
    estimate = solution.errors[known.of].value if solution.errors else float("inf")
    return Asked(relative, solution, error, estimate, cpu, min(good, default=None))


def with_accuracy(known: Known, relative: float) -> Scene:
    """The scene with an accuracy of its known scalar."""
    return known.scene.with_overrides((f"accuracy={{relative = {relative!r}, of = ['{known.of}']}}",))


def rungs_of(known: Known) -> list[tuple[float, float]]:
    """(true error, CPU time) of the scene on every mesh of the ladder, and on coarser ones."""
    plan, found = explain(known.scene), []
    changes = [Level(number, edges).changes(known.scene, plan) for number in range(len(ladder(plan)))
               for edges in ((0, 1, 2) if plan.sizes.edges else (0,))]  # fmt: skip
    coarse = [("discretisation.order=1",), ("discretisation.order=1", *changes[0][1:])]
    for change in [*coarse, *changes]:
        solution = solve(known.scene.with_overrides(change), throw=False)
        if solution.result.ok:
            found.append((max(0.0, known.error(solution) - known.scatter), solution.cost.cpu_seconds))
        if solution.cost.cpu_seconds > DEAREST:
            break
    return found


def effectivity(known: Known, order: int) -> float:
    """Estimate over true error of the scene as it is, at an order; 1 where both are rounding."""
    solution = solve(known.scene.with_overrides((f"discretisation.order={order}",)))
    error, estimate = known.error(solution), known.estimate(solution)
    return 1.0 if max(error, estimate) < ROUNDING else estimate / error


def rows() -> Iterator[tuple[str, list[Asked], list[float]]]:
    """Every problem with what was asked of it and its effectivities."""
    for known in all_known():
        rungs = rungs_of(known)
        sure = known.scatter == 0.0
        yield known.name, [asked(known, one, rungs) for one in ASKED], [
            effectivity(known, order) if sure else float("nan") for order in ORDERS
        ]


def cell(found: Asked) -> str:
    """One accuracy of one problem."""
    if not found.solution.result.ok:
        word = "beyond the model" if found.solution.result.name == "BEYOND_THE_MODEL" else "not reached"
        return f"{word} ({found.estimate:.0e})"
    cost = "" if found.ratio is None else f", {found.ratio:.1f}x"
    return f"{found.error:.1e} ({found.estimate:.0e}){cost}"


def table(found: Sequence[tuple[str, list[Asked], list[float]]]) -> list[str]:
    """All problems."""
    heads = " | ".join(f"asked {one:g}" for one in ASKED)
    lines = [f"| problem | {heads} | estimate over error, orders 2, 3 |", "|" + "---|" * (len(ASKED) + 2)]
    for name, cells, effects in found:
        shown = ", ".join("" if value != value else f"{value:.2g}" for value in effects)
        lines.append(f"| {name} | {' | '.join(map(cell, cells))} | {shown} |")
    return lines


def summary(found: Sequence[tuple[str, list[Asked], list[float]]]) -> list[str]:
    """How many are met, and what they cost."""
    every = [one for _, cells, _ in found for one in cells]
    answered = [one for one in every if one.solution.result.ok]
    met = sum(one.met for one in answered)
    worst = max(one.error / one.relative for one in answered)
    ratios = [one.ratio for one in answered if one.ratio is not None]
    effects = [value for _, _, values in found for value in values if value == value]
    inside = sum(0.5 <= value <= 5.0 for value in effects)
    needless = sum(one.met for one in every if one.solution.result.name == "BEYOND_THE_MODEL")
    return [
        f"* {met} of {len(answered)} answers are within what was asked; the worst is {worst:.2g} times it.",
        f"* {len(every) - len(answered)} were refused, as the model cannot reach it, {needless} of them needlessly.",
        f"* CPU time over that of the cheapest mesh that truly is within: {median(ratios):.2g} in the median,"
        f" {max(ratios):.2g} at most.",
        f"* {inside} of {len(effects)} estimates are between half and five times the error.",
    ]


if __name__ == "__main__":
    everything = list(rows())
    for line in [*summary(everything), *table(everything)]:
        print(line)
    if sys.argv[1:] == ["docs"]:
        write(PAGE, summary(everything), "<!-- summary -->")
        write(PAGE, table(everything), "<!-- problems -->")
