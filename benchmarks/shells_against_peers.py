"""Error against solve time, whole-process time and unknowns, beside KratosMultiphysics and FElupe in one run.

``sh benchmarks/peers/setup.sh`` once, then ``python -m benchmarks.shells_against_peers [--repeats N] [--case NAME]
[--to FOLDER]`` prints a table and writes one CSV file and one picture a case. Every row is a process of its own with
one thread; the rows take turns, so that a busy spell of the machine hits all of them. Rows that take longer than
`LONG` seconds run twice at most. Times are over those of a reference row of the same run.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Any

from benchmarks.peers.cases import CASES, Case, Row

HERE = Path(__file__).resolve().parent
PEERS = HERE / "peers" / ".venv" / "bin" / "python"
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
LONG, TIMEOUT = 20.0, 300.0
CLOCKS = ("solve_wall", "solve_cpu", "process_wall")


@dataclass
class Measured:
    """What the runs of one row gave; ``answer`` is that of the last."""

    row: Row
    answer: dict[str, Any] = field(default_factory=dict)
    times: dict[str, list[float]] = field(default_factory=lambda: {clock: [] for clock in CLOCKS})

    @property
    def good(self) -> bool:
        """Did it reach the end?"""
        return bool(self.answer.get("converged"))

    def run(self) -> None:
        """One more time."""
        python = sys.executable if self.row.own else str(PEERS)
        command = [python, str(HERE / "peers" / self.row.program), *self.row.arguments]
        start = time.perf_counter()
        try:
            done = subprocess.run(
                command, env={**os.environ, **ONE_THREAD}, capture_output=True, text=True, timeout=TIMEOUT
            )
        except subprocess.TimeoutExpired:
            self.answer = {}
            return
        wall = time.perf_counter() - start
        last = done.stdout.strip().splitlines()[-1:] if done.returncode == 0 else []
        self.answer = json.loads(last[0]) if last else {}
        for clock in CLOCKS:
            self.times[clock].append(wall if clock == "process_wall" else self.answer.get(clock, wall))


def measure(case: Case, repeats: int) -> list[Measured]:
    """All rows of a case, by turns."""
    measured = [Measured(row) for row in case.rows]
    for turn in range(repeats):
        for one in measured:
            walls = one.times["process_wall"]
            if turn == 0 or (one.good and (turn == 1 or min(walls) < LONG)):
                one.run()
        print(f"  {case.name}: round {turn + 1} of {repeats}", file=sys.stderr, flush=True)
    return measured


def table(case: Case, measured: list[Measured]) -> list[dict[str, Any]]:
    """One dictionary a row: errors, unknowns, iterations, and times over those of the reference row."""
    base = measured[case.reference]
    if not base.good:
        raise SystemExit(f"{base.row.label} is what times are compared with, and it failed")
    lines = []
    for one in measured:
        line: dict[str, Any] = {"series": one.row.series, "row": one.row.label, "runs": len(one.times["solve_wall"])}
        if one.good:
            line |= case.errors(one.answer)
            line |= {name: one.answer[name] for name in ("unknowns", "iterations", "steps")}
            for clock in CLOCKS:
                for name, statistic in (("min", min), ("median", median)):
                    line[f"{clock}_{name}"] = statistic(one.times[clock]) / statistic(base.times[clock])
        lines.append(line)
    return lines


def text(case: Case, lines: list[dict[str, Any]]) -> Iterator[str]:
    """The table, line by line; times as min / median."""
    yield f"{case.title}; times over those of: {case.rows[case.reference].label}"
    yield f"{'':58s} {'error':>8s} {'unknowns':>8s} {'Newton':>6s} {'solve':>15s} {'CPU':>15s} {'process':>15s}"
    for line in lines:
        if "error" not in line:
            yield f"{line['row']:58s} did not converge"
            continue
        pairs = (f"{line[f'{clock}_min']:7.3f}/{line[f'{clock}_median']:7.3f}" for clock in CLOCKS)
        numbers = f"{line['error']:8.1e} {line['unknowns']:8d} {line['iterations']:6d}"
        yield f"{line['row']:58s} {numbers} {' '.join(pairs)}"


def write_csv(lines: list[dict[str, Any]], path: Path) -> None:
    """All columns."""
    columns = list(dict.fromkeys(column for line in lines for column in line))
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        for line in lines:
            writer.writerow({name: f"{x:.5g}" if isinstance(x, float) else x for name, x in line.items()})


def draw(case: Case, lines: list[dict[str, Any]], path: Path) -> None:
    """Error over solve time, process time and unknowns: one curve a series, dashed and hollow for the peers."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import NullFormatter

    good = [line for line in lines if "error" in line]
    series = list(dict.fromkeys(line["series"] for line in good))
    figure, panels = plt.subplots(1, 3, figsize=(13, 4.6), sharey=True, layout="constrained")
    columns = (
        ("solve_wall_min", "solve time / reference"),
        ("process_wall_min", "whole process / reference"),
        ("unknowns", "unknowns"),
    )
    for axes, (column, name) in zip(panels, columns, strict=True):
        for number, one in enumerate(series):
            points = sorted((line[column], line["error"]) for line in good if line["series"] == one)
            peer = not one.startswith("embedding")
            style = {"linestyle": "--" if peer else "-", "markerfacecolor": "white" if peer else None}
            if not peer and "order" not in one:  # several orders: no curve
                style["linestyle"] = "none"
            axes.loglog(*zip(*points, strict=True), marker="os^Dv"[number % 5], color=f"C{number}", label=one, **style)
        axes.set_xlabel(name)
        axes.grid(True, which="major", alpha=0.3)
        axes.xaxis.set_minor_formatter(NullFormatter())
    panels[0].set_ylabel("relative error")
    figure.suptitle(case.title)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3, fontsize=9)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def main() -> None:
    """Run, print and write."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.shells_against_peers", description="Beside peers.")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--case", choices=[case.name for case in CASES], action="append", help="default: all")
    parser.add_argument("--to", type=Path, default=Path("build/peers"))
    options = parser.parse_args()
    if not PEERS.exists():
        raise SystemExit("the peers are not installed: run sh benchmarks/peers/setup.sh")
    options.to.mkdir(parents=True, exist_ok=True)
    for case in CASES:
        if options.case is None or case.name in options.case:
            lines = table(case, measure(case, options.repeats))
            print("\n".join(text(case, lines)), flush=True)
            write_csv(lines, options.to / f"{case.name}.csv")
            draw(case, lines, options.to / f"{case.name}.png")


if __name__ == "__main__":
    main()
