"""What the axisymmetric reduction buys: the same problems to the same accuracy in three dimensions.

``python -m benchmarks.reductions [docs] [PROBLEM ...]``; with ``docs`` the table goes on the page of the manual.
"""

from __future__ import annotations

import importlib
import json
import math
import resource
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from benchmarks.pages import tell
from benchmarks.start_up import PAGE, environment

MARK = "<!-- reductions -->"
WITHIN, LONGEST = 1e-3, 900
REDUCTIONS = {
    "axisymmetric": ("model.reduction=axisymmetric",),
    "3d, between three mirror planes": ("model.reduction=3d",),
    "3d, the whole sphere": ("model.reduction=3d", "model.symmetry=none"),
}
WHOLE = "3d, the whole sphere"


@dataclass(frozen=True)
class Mesh:
    """Order, element size on the shell in m and load steps of each stage."""

    order: int
    size: float
    steps: int

    @property
    def changes(self) -> tuple[str, ...]:
        """As overrides."""
        return f"discretisation.order={self.order}", f"discretisation.shell_size={self.size}"


TRIED: dict[str, tuple[Mesh, ...]] = {
    "axisymmetric": (Mesh(2, 0.015, 1), Mesh(2, 0.02, 1), Mesh(2, 0.015, 3)),
    "3d, between three mirror planes": (Mesh(2, 0.008, 1), Mesh(2, 0.01, 2), Mesh(2, 0.02, 2)),
    WHOLE: (Mesh(2, 0.008, 3),),
}
"""Meshes to choose from; the cheapest one within 1e-3 counts. On coarser ones the whole sphere, which nothing holds
symmetric, wrinkles on its way and takes many small steps."""
FINER: dict[str, tuple[Mesh, ...]] = {
    "axisymmetric": (Mesh(3, 0.004, 1), Mesh(4, 0.006, 1)),
    "3d, between three mirror planes": (Mesh(3, 0.008, 2),),
}
"""For the permeable sphere, whose largest stretch is at a pole."""
PROBLEMS = {"charged_balloon": 1, "grounded_balloon": 1, "permeable_sphere": 2}
"""Problems of spheres, with their stages."""


def measured(name: str, changes: tuple[str, ...]) -> dict[str, Any]:
    """Solve with `embedding run`: the stretch and unknowns, seconds of computing of the solve with its archive, and of
    the whole process. {} if it fails or takes too long."""
    scene = Path(__file__).parent.parent / "problems" / f"{name}.toml"
    words = [word for change in changes for word in ("--set", change)]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with TemporaryDirectory() as folder:
        done = subprocess.run(
            ["timeout", str(LONGEST), sys.executable, "-m", "embedding.cli", "run", str(scene), "--json", *words],
            capture_output=True, text=True, env=environment(), cwd=folder,
        )  # fmt: skip
    if done.returncode:
        return {}
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    told = json.loads(done.stdout)
    return {
        "stretch": told["scalars"]["stretch_max" if name == "permeable_sphere" else "stretch"],
        "unknowns": sum(told["cost"]["unknowns"].values()),
        "solve": told["cost"]["cpu_seconds"],
        "process": after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime,
    }


def reference(name: str) -> float:
    """The exact stretch; where nothing is exact, the largest stretch of a fine axisymmetric solution."""
    problem = importlib.import_module(f"problems.{name}")
    if name == "permeable_sphere":
        return float(measured(name, ("discretisation.order=4", "discretisation.shell_size=0.002"))["stretch"])
    scene = problem.scene()
    return float(problem.exact(scene).stretch(scene.faces.top.voltage))


def best(name: str, reduction: str, known: float) -> dict[str, Any]:
    """The cheapest of the meshes that is within 1e-3, with its error."""
    found: dict[str, Any] = {}
    for mesh in (FINER if name == "permeable_sphere" else TRIED).get(reduction, ()):
        steps = tuple(f"path.{stage}.steps={mesh.steps}" for stage in range(PROBLEMS[name]))
        told = measured(name, (*REDUCTIONS[reduction], *mesh.changes, *steps))
        error = abs(told["stretch"] / known - 1.0) if told else math.nan
        print(f"  {name} {reduction} {mesh}: {error:.1e} {told}", file=sys.stderr, flush=True)
        if error <= WITHIN and (not found or told["solve"] < found["solve"]):
            found = {**told, "error": error, "mesh": mesh}
    return found


def table(problems: Sequence[str]) -> Iterator[str]:
    """Rows for the page of the manual."""
    yield "| problem | reduction | mesh | error | unknowns | solve | whole process |"
    yield "|---|---|---|---|---|---|---|"
    for name in problems:
        known, first = reference(name), dict[str, Any]()
        for reduction in REDUCTIONS:
            row = best(name, reduction, known)
            if not row:
                continue
            first = first or row
            mesh: Mesh = row["mesh"]
            shown = f"order {mesh.order}, {1e3 * mesh.size:g} mm, {mesh.steps} steps".replace("1 steps", "1 step")
            yield (
                f"| {name} | {reduction} | {shown} | {row['error']:.1e} | {row['unknowns']:,} "
                f"| {row['solve'] / first['solve']:.3g} | {row['process'] / first['process']:.3g} |"
            )


if __name__ == "__main__":
    named = [word for word in sys.argv[1:] if word in PROBLEMS]
    tell(table(named or list(PROBLEMS)), PAGE if "docs" in sys.argv[1:] else None, MARK)
