"""What the commands print on standard output: one JSON object, or a few aligned lines for people."""

from __future__ import annotations

import json
import math
import os
import sys
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pathlib import Path

    from rich.console import Console

    from embedding.archive.records import ArchivedCost, ArchivedError
    from embedding.solving.solution import Assumption, Check, Cost, CriticalPoint, ErrorEstimate, Solution

NOISE = 1e-12
SMALL = 0.01
"""Part of an error whose source is not worth a word."""


def print_json(value: Mapping[str, Any]) -> None:
    """Print one JSON object on standard output; numbers that JSON cannot hold (nan, inf) become null."""
    print(json.dumps(_plain(value), indent=2, allow_nan=False))


@contextmanager
def warnings_told() -> Iterator[None]:
    """Warnings within are lines for people on standard error."""

    def tell(message: Warning | str, *_: Any, **__: Any) -> None:
        print(f"warning: {message}", file=sys.stderr)

    with warnings.catch_warnings():
        warnings.simplefilter("default", UserWarning)
        warnings.showwarning = tell
        yield


def print_rows(rows: Iterable[tuple[str, str]]) -> None:
    """Print names and values as two aligned columns, values never broken across lines."""
    rows = list(rows)
    width = max((len(name) for name, _ in rows), default=0)
    for name, value in rows:
        print(f"  {name:<{width}}  {value}")


def console() -> Console:
    """A console on standard output that is wide enough for tables where nobody looks at a terminal."""
    from rich.console import Console

    terminal = Console()
    return terminal if terminal.is_terminal else Console(width=200)


def number(value: float, unit: str = "") -> str:
    """A number with six digits and its unit; the unit "1" is not shown."""
    return f"{value:.6g} {unit}" if unit not in ("", "1") else f"{value:.6g}"


def without_noise(values: Mapping[str, float], units: Mapping[str, str]) -> dict[str, float]:
    """The same values, those far below the largest of their unit set to 0: rounding is no news to people."""
    largest: dict[str, float] = {}
    for name, value in values.items():
        largest[units[name]] = max(largest.get(units[name], 0.0), abs(value))
    return {name: 0.0 if abs(value) < NOISE * largest[units[name]] else value for name, value in values.items()}


def seconds(value: float) -> str:
    """A duration as people say it: 3.2 s, 4 min 05 s."""
    minutes, rest = divmod(value, 60.0)
    return f"{int(minutes)} min {rest:02.0f} s" if minutes else f"{rest:.1f} s"


def words(name: str) -> str:
    """A result's name as words."""
    return name.lower().replace("_", " ")


def error_line(error: ErrorEstimate | ArchivedError) -> str:
    """An error estimate in one line: its size, its largest sources, how it was found."""
    largest = sorted(error.parts.items(), key=lambda part: -part[1])
    parts = ", ".join(f"{source} {part:.1e}" for source, part in largest if part > SMALL * error.value)
    return f"{error.value:.1e} of {error.quantity}{': ' if parts else ''}{parts} ({error.method})"


def within(value: str, error: ErrorEstimate | ArchivedError | None) -> str:
    """A number with its relative error beside it; one that is given has none."""
    shown = error is not None and error.value > 0.0 and value.split(" ")[0] != "0"
    return f"{value} (± {error.value:.1e})" if shown and error is not None else value


def cost_line(cost: Cost | ArchivedCost) -> str:
    """Time, memory and size in one line."""
    unknowns = sum(cost.unknowns.values())
    return f"{seconds(cost.wall_seconds)}, {cost.peak_memory_bytes / 1e6:.0f} MB, {unknowns} unknowns"


def critical_rows(points: Sequence[CriticalPoint], ramped: Sequence[str]) -> list[tuple[str, str]]:
    """Where the path turns or branches, a row each, with the factors that scale something in its scene."""
    from embedding.solving.path import Target

    rows = []
    for point in points:
        stability = " to ".join("unknown" if n is None else str(n) for n in point.unstable)
        load = Target(point.factor_mechanical, point.factor_field, None).told(ramped, 6)
        place = f"before step {point.before_step}; unstable modes {stability}"
        rows.append((f"{point.kind} point", f"{load} (stage {point.stage}, {place})"))
    return rows


def assumption_rows(assumptions: Sequence[Assumption]) -> list[tuple[str, str]]:
    """What was left out and whether that was allowed, a row each."""
    rows = []
    for one in assumptions:
        verdict, sign = ("OK", "<=") if one.held else ("VIOLATED", ">")
        lift = "" if one.held else f"; try --set {' --set '.join(one.rung)}" if one.rung else "; no model here has it"
        told = f"{verdict}, {one.number:.1e} {sign} {one.allowed:g}: {one.sentence}{lift}"
        rows.append((f"{one.topic}: {one.choice}", told))
    return rows


def attempt_rows(solution: Solution) -> list[tuple[str, str]]:
    """The solves that led to an accuracy, a row each."""
    asked, rows = solution.scene.accuracy, []
    for number, attempt in enumerate(solution.attempts, 1):
        found = "no answer" if attempt.estimate is None else f"{attempt.estimate:.1e}"
        goal = f", {asked.relative:g} is asked" if asked is not None else ""
        why = f"; {attempt.reason}" if attempt.reason else ""
        rows.append((f"attempt {number}", f"error {found}{goal}{why} ({', '.join(attempt.changes)})"))
    return rows


def health_rows(checks: Sequence[Check], *, all_of_them: bool) -> list[tuple[str, str]]:
    """Whether the solution is sound: a row for each check, or for each that is not good and one for the rest."""
    rows = []
    for one in checks:
        if all_of_them or not one.good:
            should = f", should be {one.should_be}" if one.should_be else ""
            told = f"{_verdict(one.good)}, {number(one.value, one.unit)}{should}: {one.sentence}"
            rows.append((f"health: {one.topic}", told))
    if checks and not rows:
        rows.append(("health", f"{_verdict(True)}, all {len(checks)} checks"))
    return rows


def _verdict(good: bool) -> str:
    """A word, green or red on a terminal."""
    word = "good" if good else "BAD"
    plain = not sys.stdout.isatty() or "NO_COLOR" in os.environ
    return word if plain else f"\x1b[{32 if good else 31}m{word}\x1b[0m"


def solution_summary(solution: Solution) -> dict[str, Any]:
    """A solution as plain data: result, final scalars, error estimate and cost."""
    last = solution.steps[-1] if solution.steps else None
    return {
        "scene": solution.scene.name,
        "result": solution.result.name,
        "message": solution.message,
        "steps": len(solution.steps),
        "scalars": last.scalars if last else {},
        "critical_points": [{**vars(point), "mode": None} for point in solution.critical_points],
        "estimated_error": None if solution.error is None else asdict(solution.error),
        "errors": {name: asdict(error) for name, error in solution.errors.items()},
        "assumptions": [asdict(assumption) for assumption in solution.assumptions],
        "health": [asdict(check) for check in solution.health],
        "attempts": [asdict(attempt) for attempt in solution.attempts],
        "cost": asdict(solution.cost),
        "archive": solution.archive,
    }


def print_solution(solution: Solution, picture: Path | None) -> None:
    """Print the end of a run for people: the final scalars, error estimate, cost, archive and picture."""
    from embedding.archive.units import scalar_unit

    print(f"{solution.scene.name}: {words(solution.result.name)} after {len(solution.steps)} steps")
    per_length = solution.scene.shell.shape.reductions == ("plane-strain",)
    scalars = solution.steps[-1].scalars if solution.steps else {}
    units = {name: scalar_unit(name, per_length) for name in scalars}
    told = {name: number(value, units[name]) for name, value in without_noise(scalars, units).items()}
    rows = [(name, within(text, solution.errors.get(name))) for name, text in told.items()]
    rows += critical_rows(solution.critical_points, solution.scene.ramped)
    if solution.error is not None:
        rows.append(("estimated error", error_line(solution.error)))
    rows += attempt_rows(solution) + assumption_rows(solution.assumptions)
    rows += health_rows(solution.health, all_of_them=False)
    rows.append(("cost", cost_line(solution.cost)))
    if solution.archive is not None:
        rows.append(("archive", str(solution.archive)))
    if picture is not None:
        rows.append(("picture", str(picture)))
    print_rows(rows)


def _plain(value: Any) -> Any:
    """The same value in the types of JSON."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, bool | int | str) or value is None:
        return value
    if hasattr(value, "item"):  # a NumPy scalar
        return _plain(value.item())
    return str(value)
