"""The charged balloon in 3D against a script of plain NGSolve that solves membrane and field in turn.

``python -m benchmarks.partitioned [docs]``; with ``docs`` the table goes on the page of the manual.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from benchmarks.pages import tell
from benchmarks.reductions import LONGEST, best, reference
from benchmarks.start_up import PAGE, environment

MARK = "<!-- partitioned -->"
OURS = "3d, between three mirror planes"
SCRIPT = Path(__file__).parent / "peers" / "ngsolve_balloon.py"
TRIED = {
    "whole": ((1, 0.1, 2), (2, 0.25, 2), (2, 0.2, 2), (2, 0.17, 2)),
    "octant": ((1, 0.2, 2), (1, 0.1, 2), (2, 0.25, 2), (2, 0.2, 2), (2, 0.15, 2), (2, 0.15, 4)),
}
"""Order, size on the shell in radii and steps, of scripts of the whole balloon and of an octant."""
GRADING = 0.3


def script(order: int, size: float, steps: int, part: str) -> dict[str, Any]:
    """What the script printed, with the computing of its whole process; {} where it failed or took too long."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    words = map(str, (order, size, GRADING, steps, part))
    command = ["timeout", str(LONGEST), sys.executable, str(SCRIPT), *words]
    done = subprocess.run(command, capture_output=True, text=True, env=environment())
    if done.returncode:
        return {}
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    told = json.loads(done.stdout)
    return told | {"process": after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime}


def table() -> Iterator[str]:
    """Rows for the page of the manual."""
    known = reference("charged_balloon")
    own = best("charged_balloon", OURS, known)
    yield "| | error | unknowns | turns | solve | whole process |"
    yield "|---|---|---|---|---|---|"
    mesh = own["mesh"]
    shown = f"order {mesh.order}, {mesh.size / 0.02:.2g} radii, {mesh.steps} steps".replace("1 steps", "1 step")
    yield f"| this package, {shown} | {own['error']:.1e} | {own['unknowns']:,} | | 1 | 1 |"
    for part, order, size, steps in ((part, *tried) for part, meshes in TRIED.items() for tried in meshes):
        told, name = script(order, size, steps, part), f"script, {part}, order {order}, {size:g} radii, {steps} steps"
        if not told or not told["converged"]:
            yield f"| {name} | does not converge | | | | |"
            continue
        yield (
            f"| {name} | {abs(told['stretch'] / known - 1.0):.1e} | {told['unknowns']:,} | {told['turns']} "
            f"| {told['cpu'] / own['solve']:.2g} | {told['process'] / own['process']:.2g} |"
        )


if __name__ == "__main__":
    tell(table(), PAGE if "docs" in sys.argv[1:] else None, MARK)
