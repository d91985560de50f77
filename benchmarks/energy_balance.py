"""The balance of energies along paths of 5, 10 and 20 steps: what each rule for the work leaves.

Every number is the largest residual over the steps, relative to the largest stored energy.

Run on its own: ``python -m benchmarks.energy_balance`` (about a minute); ``docs`` writes docs/post.md.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from benchmarks.pages import tell
from embedding import Scene, load_scene, solve
from embedding.post import energy_balance

PAGE = Path(__file__).parents[1] / "docs" / "post.md"
PROBLEMS = Path(__file__).parents[1] / "problems"
STEPS = (5, 10, 20)
PRESSURE = ("path=[{}]", "loads.pressure_bottom='1.1 kPa'")
SCENES: dict[str, tuple[str, tuple[str, ...]]] = {
    "balloon, pressure": ("sphere_inflation", PRESSURE),
    "charged balloon, voltage": ("charged_balloon", ()),
    "dielectric balloon, pressure and voltage": ("dielectric_balloon", ()),
    "strip bent by a force at its tip": ("cantilever_shear", ()),
}
"""Scene file and changes."""
HEADING = (
    "| scene | steps of a stage | explicit | trapezoidal | its `path_error` | cubic |",
    "| --- | --- | --- | --- | --- | --- |",
)
COLUMNS = ("residual_explicit", "residual", "path_error", "residual_cubic")


def refined(name: str, changes: tuple[str, ...], steps: int) -> Scene:
    """A scene whose stages are all ramped in so many steps."""
    scene = load_scene(PROBLEMS / f"{name}.toml", changes)
    stages = range(len(scene.path))
    ramps = [text for stage in stages for text in (f"path.{stage}.steps={steps}", f'path.{stage}.control="load"')]
    return scene.with_overrides(ramps)


def report() -> Iterator[str]:
    """The table, line by line."""
    yield from HEADING
    with tempfile.TemporaryDirectory() as folder:
        for title, (name, changes) in SCENES.items():
            for steps in STEPS:
                solve(refined(name, changes, steps), archive=Path(folder) / "run.vtkhdf")
                balance = energy_balance(Path(folder) / "run.vtkhdf")
                largest = float(np.abs(balance["stored"]).max())
                sizes = [f"{np.abs(balance[column]).max() / largest:.1e}" for column in COLUMNS]
                yield f"| {title if steps == STEPS[0] else ''} | {steps} | {' | '.join(sizes)} |"


if __name__ == "__main__":
    tell(report(), PAGE if "docs" in sys.argv else None)
