"""What `embedding trade` tells: every rung with its error and cost, and the cheapest one at each accuracy."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from rich.table import Table

from embedding.cli.output import console

if TYPE_CHECKING:
    from embedding.trade import Trade


def trade_summary(trade: Trade) -> dict[str, Any]:
    """A trade as plain data."""
    best = {f"{tolerance:g}": None if row is None else row.rung for tolerance, row in trade.best().items()}
    return {
        "scene": trade.scene.name,
        "quantity": trade.quantity,
        "unit": trade.unit,
        "reference": trade.reference,
        "reference_stated": trade.stated,
        "front": [row.rung for row in trade.front],
        "best": best,
        "rows": [asdict(row) for row in trade.rows],
    }


def print_trade(trade: Trade) -> None:
    """Print a trade as a table, those on the front marked, and which rung is best at which accuracy."""
    unit = "" if trade.unit == "1" else f" {trade.unit}"
    source = "stated" if trade.stated else "the finest rung's, whose own error is not known"
    print(f"{trade.scene.name}: {trade.quantity}, reference {trade.reference:.8g}{unit} ({source})")
    table = Table(box=None, padding=(0, 2, 0, 0), header_style="bold")
    headings = ("rung", "error", "estimate", "CPU / plan", "CPU [s]", "memory [MB]", "unknowns", "front")
    for heading in headings:
        table.add_column(heading.replace("[", r"\["), justify="left" if heading in ("rung", "front") else "right")
    on_front = {row.rung for row in trade.front}
    for row in trade.rows:
        if row.done:
            numbers = (_short(row.error, ".1e"), _short(row.estimate, ".1e"), f"{trade.cost(row):.2g}")
            costs = (f"{row.cpu_seconds:.2f}", f"{row.peak_memory_bytes / 1e6:.0f}", f"{row.unknowns:.0f}")
            table.add_row(row.rung, *numbers, *costs, "*" if row.rung in on_front else "")
    console().print(table)
    for row in trade.rows:
        if not row.done:
            print(f"  {row.rung}: {row.status}: {row.reason}")
    for tolerance, best in trade.best().items():
        print(f"  cheapest within {tolerance:.0e}: {'none' if best is None else best.rung}")


def _short(value: float, form: str) -> str:
    return "" if math.isnan(value) else format(value, form)
