"""What `embedding info` tells about an archive: as plain data, and as lines and a table for people."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from rich.table import Table

from embedding.cli.output import (
    assumption_rows,
    console,
    cost_line,
    critical_rows,
    error_line,
    health_rows,
    number,
    print_rows,
    without_noise,
    words,
)

if TYPE_CHECKING:
    from embedding.archive import Archive, Verification
    from embedding.archive.records import ArchivedError

#: Scalars worth a column for people, in this order; the later ones are left out where they are zero or unknown.
COLUMNS = ("stretch",)
FURTHER = (
    "displacement", "pressure_top", "pressure_bottom", "pressure_difference", "volume_ratio", "voltage", "charge",
    "unstable_modes",
)  # fmt: skip
ROWS = 20


def archive_summary(archive: Archive) -> dict[str, Any]:
    """Everything an archive says about its run except the fields, as plain data."""
    return {
        "archive": archive.path,
        **archive.run,
        "result": asdict(archive.result),
        "critical_points": [{**vars(point), "mode": None} for point in archive.critical_points],
        "estimated_error": None if archive.error is None else asdict(archive.error),
        "health": [asdict(check) for check in archive.health],
        "errors": {name: asdict(error) for name, error in archive.errors.items()},
        "assumptions": [asdict(assumption) for assumption in archive.assumptions],
        "cost": None if archive.cost is None else asdict(archive.cost),
        "steps": [asdict(step) for step in archive.steps],
        "cuts": archive.cuts,
        "units": archive.scalar_units,
        "blocks": {name: archive.block(name).units for name in archive.blocks},
        "plan": [asdict(decision) for decision in archive.plan.decisions],
        "versions": archive.versions,
        "scene": archive.scene,
    }


def verification_summary(found: Verification) -> dict[str, Any]:
    """What was found in an archive, as plain data."""
    return {"archive": found.path, "sound": found.sound, **{k: v for k, v in vars(found).items() if k != "path"}}


def print_archive(archive: Archive) -> None:
    """Print the run of an archive for people: how it ended, its cost, what is inside, its last steps."""
    run, result = archive.run, archive.result
    print(f"{archive.path}: {run['name']}, {run['reduction']}, started {run['started']}")
    rows = [("result", f"{words(result.name)}: {result.message}")]
    if archive.error is not None:
        rows.append(("estimated error", error_line(archive.error)))
        rows += _accuracy(archive, archive.error)
    rows += assumption_rows(archive.assumptions) + health_rows(archive.health, all_of_them=True)
    if archive.cost is not None:
        rows.append(("cost", cost_line(archive.cost)))
    if archive.critical_points:
        rows += critical_rows(archive.critical_points, archive.scene_object().ramped)
    if archive.cuts:
        rows.append(("cuts", f"{len(archive.cuts)} steps were retried shorter"))
    rows += [(f"block {name}", ", ".join(archive.block(name).fields)) for name in archive.blocks]
    rows.append(("made with", ", ".join(f"{name} {version}" for name, version in archive.versions.items())))
    print_rows(rows)
    if len(archive):
        print()
        console().print(_history(archive))


def _accuracy(archive: Archive, error: ArchivedError) -> list[tuple[str, str]]:
    """Whether the answer is as accurate as its scene asks for."""
    asked = archive.scene_object().accuracy
    if asked is None:
        return []
    return [("accuracy", f"{asked.relative:g} asked: {'reached' if error.value <= asked.relative else 'NOT reached'}")]


def _history(archive: Archive) -> Table:
    """One row a step: where on the path, how many iterations, and the scalars that say something."""
    scalars, units = archive.scalars, archive.scalar_units
    shown = [name for name in COLUMNS if name in scalars]
    shown += [name for name in FURTHER if name in scalars and any(map(_says_something, scalars[name]))]
    table = Table(box=None, padding=(0, 2, 0, 0), header_style="bold")
    for heading in ("step", "stage", "mechanical", "field", "iterations"):
        table.add_column(heading, justify="left" if heading == "stage" else "right")
    for name in shown:
        unit = "" if units[name] == "1" else f" [{units[name]}]"
        table.add_column((name + unit).replace("[", r"\["), justify="right")
    steps = archive.steps[-ROWS:]
    if len(steps) < len(archive):
        table.caption = f"the last {ROWS} of {len(archive)} steps; --json shows all"
    for step in steps:
        values = without_noise(step.scalars, units)
        table.add_row(
            str(step.number), step.stage, f"{step.factor_mechanical:.4g}", f"{step.factor_field:.4g}",
            str(len(step.iterations)), *(number(values[name]) for name in shown),
        )  # fmt: skip
    return table


def _says_something(value: float) -> bool:
    return math.isfinite(value) and value != 0.0
