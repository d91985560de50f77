"""`embedding bench`: what a full run spends, part by part; `embedding bench extremes`: what holds at the extremes."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import App, Parameter

from embedding.cli.extremes import extremes

if TYPE_CHECKING:
    from embedding.bench import Spending

SHOWN = 5e-4
"""Parts of the whole that are smaller are not printed."""

bench_app = App(name="bench", help="Measure what a run spends, part by part, or what holds at the extremes.")
bench_app.command(extremes)


@bench_app.default
def bench(
    scene: Annotated[Path | None, Parameter(help="Scene file (TOML); default a charged balloon in 3D.")] = None,
    /,
    *,
    overrides: Annotated[
        tuple[str, ...],
        Parameter(name="--set", negative="", help="Override a field: discretisation.order=3. May be repeated."),
    ] = (),
    as_json: Annotated[bool, Parameter(name="--json", negative="", help="Print one JSON object.")] = False,
) -> None:
    """Solve a scene in a process of its own and print what the run spends, part by part.

    Parts inside others are indented; the outermost add up to the time of the whole process.
    """
    from embedding.bench import measure_spending
    from embedding.cli.output import print_json

    found = measure_spending(scene, overrides)
    if as_json:
        print_json(asdict(found))
    else:
        print_spending(found)


def print_spending(found: Spending) -> None:
    """Print the parts as a table."""
    unknowns = sum(found.unknowns.values())
    print(
        f"{found.scene}: {found.reduction}, {found.result.lower().replace('_', ' ')} after {found.steps} steps, "
        f"{found.iterations} Newton steps, {unknowns} unknowns"
    )
    print(f"  {'part':<28}{'seconds':>9}{'share':>9}{'calls':>7}")
    for part in found.parts:
        if part.seconds < SHOWN * found.total:
            continue
        name = "  " * (len(part.names) - 1) + part.names[-1]
        calls = f"{part.calls:>7}" if part.calls > 1 else ""
        print(f"  {name:<28}{part.seconds:>9.3f}{part.seconds / found.total:>9.1%}{calls}")
    print(f"  {'whole process':<28}{found.total:>9.3f}{1:>9.1%}")
