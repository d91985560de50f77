"""Field and shell solved together, in turn, or the field once: answers, iterations and time, charged balloon.

In free space a sphere's pull does not depend on its size, and turns are lost on shorter waves; inside a grounded sphere
of four radii it grows with the size up to pull-in, at 383.95 kV. Times are those of the load steps, relative to the
joint solve; "off" is the difference of the stretch from it, "factor" what a turn multiplies the worst error by.

Run on its own: ``python -m benchmarks.coupling_rungs`` (about a minute).
"""

from __future__ import annotations

from collections.abc import Iterator

from embedding import Solution, load_scene, solve
from problems import charged_balloon, grounded_balloon

LOADS = ((charged_balloon, (300e3, 450e3, 600e3)), (grounded_balloon, (250e3, 340e3, 375e3, 383e3)))
RUNGS = {
    "joint": (),
    "staggered, IQN-ILS": ("model.coupling=staggered",),
    "staggered, Aitken": ("model.coupling=staggered", "solver.acceleration=aitken"),
    "staggered, plain": ("model.coupling=staggered", "solver.acceleration=none"),
    "once": ("model.coupling=once",),
}
STEPS, MESHES = 6, {"axisymmetric": (), "3d": ("model.reduction=3d", "discretisation.shell_size=8 mm")}


def seconds(solution: Solution) -> float:
    """Time of all load steps."""
    return sum(step.wall_seconds for step in solution.steps)


def rows(scene: str, changes: tuple[str, ...]) -> Iterator[str]:
    """Every rung on one scene."""
    joint: Solution | None = None
    for name, rung in RUNGS.items():
        solution = solve(load_scene(scene, (*changes, *rung)), throw=False)
        joint = joint or solution
        last = solution.steps[-1]
        off = last.scalars["stretch"] - joint.steps[-1].scalars["stretch"]
        factor = f", factor {last.scalars['contraction']:+.2f}" if "contraction" in last.scalars else ""
        gap = f", gap {last.scalars['coupling_gap']:.1%}" if "coupling_gap" in last.scalars else ""
        end = "" if solution.result.ok else f", {solution.result.name} at {last.scalars['voltage'] / 1e3:.1f} kV"
        yield (
            f"  {name:18s}  stretch {last.scalars['stretch']:.7f} (off {off:+.1e}), {solution.iterations} iterations, "
            f"time {seconds(solution) / seconds(joint):.2f}{factor}{gap}{end}"
        )


def report() -> Iterator[str]:
    """The table, line by line."""
    path = f"path=[{{steps = {STEPS}}}]"
    for reduction, mesh in MESHES.items():
        for problem, voltages in LOADS:
            for voltage in voltages if reduction == "axisymmetric" else voltages[1:2]:
                yield f"{problem.scene().name}, {reduction}, {voltage / 1e3:g} kV in {STEPS} steps"
                yield from rows(str(problem.SCENE), (*grounded_balloon.at_voltage(voltage), path, *mesh))


if __name__ == "__main__":
    for line in report():
        print(line, flush=True)
