"""What `embedding compare` tells of two archives: as plain data, and as lines and a table for people."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from embedding.cli.output import print_rows
from embedding.cli.tables import print_table, table_summary

if TYPE_CHECKING:
    from embedding.post import Comparison

MOST = 12  # differences of the scene that are printed


def summary(found: Comparison) -> dict[str, Any]:
    """A comparison as plain data."""
    return {
        "same": found.same,
        "tolerance": found.tolerance,
        "common_steps": found.factors,
        "scene": [{"path": path, "first": first, "second": second} for path, first, second in found.scene],
        "only_in_first": found.only[0],
        "only_in_second": found.only[1],
        **table_summary(found.table),
    }


def print_comparison(first: Path, second: Path, found: Comparison) -> None:
    """Print what is different in the scenes, what only one has, and the table of differences."""
    verdict = "the same" if found.same else "different"
    print(f"{first} and {second}: {verdict} to {found.tolerance:g} at {found.factors} common loads")
    rows = [(path, f"{one} | {other}") for path, one, other in found.scene[:MOST]]
    if len(found.scene) > MOST:
        rows.append(("...", f"{len(found.scene) - MOST} more; --json shows all"))
    rows += [("only in the first", ", ".join(found.only[0]))] if found.only[0] else []
    rows += [("only in the second", ", ".join(found.only[1]))] if found.only[1] else []
    print_rows(rows)
    if found.factors:
        print_table(found.table)
    else:
        print("  no step of one has the stage and the loads of a step of the other")
