"""The published nonlinear shells on three meshes each: the table of docs/benchmarks.md and its picture.

`python -m benchmarks.shells` prints the table; `python -m benchmarks.shells docs` writes the page's table and picture.
Every scene runs with default settings, `discretisation.shell_size` apart.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

from benchmarks.pages import write
from problems import half_cylinder, hemisphere_with_hole, hinged_roof, pulled_cylinder, slit_annulus, t_cantilever
from problems.common import LoadPath, curve_through
from problems.published.case import Case

PROBLEMS: tuple[ModuleType, ...] = (
    hemisphere_with_hole, slit_annulus, pulled_cylinder, half_cylinder, t_cantilever,
)  # fmt: skip
REFINED = 1.0 / math.sqrt(2.0)
"""Of the element size from one mesh to the next: twice the triangles."""
SHORT_STEPS = "path=[{control = 'arc-length', steps = 15}]"
"""The roofs are drawn with more states on their paths than the default takes."""
DOCS = Path(__file__).parent.parent / "docs"


def runs(problem: ModuleType) -> list[LoadPath]:
    """The scene's own mesh and two finer ones."""
    first: LoadPath = problem.run()
    size = first.solution.plan.sizes.shell * first.solution.scales.length
    finer = [problem.run(f"discretisation.shell_size={size * REFINED**n!r} m") for n in (1, 2)]
    return [first, *finer]


def rows(problem: ModuleType, paths: list[LoadPath]) -> Iterator[str]:
    """Markdown rows, one a quantity."""
    case = problem.CASE
    for name in paths[0].values:
        ends = [path.end(name) for path in paths]
        found = " | ".join(f"{end:.4f} ({100 * (end / case.end(name) - 1):+.2f} %)" for end in ends)
        others = ", ".join(f"{values[name]:g}" for values in case.others.values() if name in values)
        steps = ", ".join(str(path.solution.iterations) for path in paths)
        yield f"| {case.name}: {name} | {case.end(name):g} | {others} | {found} | {steps} |"


def draw(found: dict[str, list[LoadPath]], output: Path) -> None:
    """Load against displacement, computed and published."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.0, 7.0), dpi=130, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(2, 3).ravel()
    for axis, problem in zip(axes, PROBLEMS, strict=False):
        path, case = found[problem.CASE.name][-1], problem.CASE
        for number, name in enumerate(path.values):
            colour = ("#2f6690", "#c8553d", "#6d9a8b")[number]
            draw_path(axis, colour, path, name, case, name)
        axis.set_title(case.name, fontsize=8)
        axis.legend(frameon=False, fontsize=8)
        axis.tick_params(labelsize=8)
    for colour, (thickness, case) in zip(("#2f6690", "#c8553d"), hinged_roof.CASES.items(), strict=True):
        path = hinged_roof.run(thickness, SHORT_STEPS)
        draw_path(axes[-1], colour, path, "centre", case, f"thickness {thickness}")
    axes[-1].set_title("hinged roofs: snap-through and snap-back", fontsize=8)
    axes[-1].legend(frameon=False, fontsize=8)
    axes[-1].tick_params(labelsize=8)
    figure.supxlabel("displacement", fontsize=8)
    figure.supylabel("load factor (dots: computed steps, and the spline through them; crosses: published)", fontsize=8)
    figure.savefig(output)


def draw_path(axis: Any, colour: str, path: LoadPath, name: str, case: Case, label: str) -> None:
    """One displacement: a dot a step, the spline through them, and the published points."""
    factors, values = curve_through(path.factors, path.values[name])[0].T
    axis.plot(values, factors, "-", color=colour, linewidth=1.2, label=label)
    axis.plot(path.values[name], path.factors, "o", color=colour, markersize=3)
    axis.plot(case.table[name], case.table["factor"], "x", color=colour, markersize=5)


def main(arguments: list[str]) -> None:
    """Run everything; with "docs" also write the page's table and picture."""
    found = {problem.CASE.name: runs(problem) for problem in PROBLEMS}
    head = ["| case | published | other code | scene | finer | finest | iterations |", "|---|---|---|---|---|---|---|"]
    table = [*head, *(row for problem in PROBLEMS for row in rows(problem, found[problem.CASE.name]))]
    print("\n".join(table))
    if arguments == ["docs"]:
        write(DOCS / "benchmarks.md", table)
        draw(found, DOCS / "images" / "benchmarks.png")


if __name__ == "__main__":
    main(sys.argv[1:])
