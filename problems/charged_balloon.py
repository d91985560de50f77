"""A conducting balloon at a voltage in free space, against the exact thick-walled sphere.

Physics: the field pulls each bit of the outer face outwards with eps0 E^2 / 2, E = V / b at the outer face radius b;
inside the conductor there is no field, so p_b = 0 and p_t = -eps0 (V / b)^2 / 2. The shell has no limit point.

Reference: `problems.exact.charged_balloon`, incompressible neo-Hookean sphere of finite thickness with the field at
its true outer face. With the interface opened the error of the stretch is O((T/R)^2), closed O(T/R).

Run: about three seconds.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from embedding import Listener, Scene, Solution, Sphere, load_scene, solve
from embedding.scene.scales import EPSILON_0
from problems.common import Array, law_of, print_files, print_steps
from problems.exact.charged_balloon import ChargedBalloon
from problems.exact.charged_shell import Theory

SCENE = Path(__file__).with_suffix(".toml")


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"model.interface=closed"``."""
    return load_scene(SCENE, changes)


def at(thickness_ratio: float, stretch: float) -> tuple[str, ...]:
    """Overrides for another T/R, with the voltage that holds the exact sphere at ``stretch``."""
    stated = scene()
    thickness = f"shell.thickness={thickness_ratio * stated.shell.shape.size!r}"
    voltage = exact(scene(thickness)).voltage(stretch)
    return thickness, f"faces.top.voltage={voltage!r}", f"faces.bottom.voltage={voltage!r}"


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


def exact(scene: Scene, theory: Theory = "thick") -> ChargedBalloon:
    """The exact shell of ``scene``, in SI units.

    Raises ValueError for a shape other than a sphere, or without an ambient.
    """
    shape, ambient = scene.shell.shape, scene.ambient
    if not isinstance(shape, Sphere) or ambient is None:
        raise ValueError("the reference is a sphere in an electric field")
    ground = (ambient.radius or 4.0 * shape.radius) if ambient.outer == "grounded" else math.inf
    return ChargedBalloon(shape.radius, scene.shell.thickness, law_of(scene), EPSILON_0, ground, theory)


def reference(solution: Solution, theory: Theory = "thick") -> Array:
    """Exact stretch of the mid-surface at the voltage of every step."""
    shell = exact(solution.scene, theory)
    return np.array([shell.stretch(float(voltage)) for voltage in solution["voltage"]])


def error(solution: Solution, theory: Theory = "thick") -> float:
    """Largest error of the stretch over the steps."""
    return float(np.abs(solution["stretch"] - reference(solution, theory)).max())


if __name__ == "__main__":
    solution = run(archive=Path("charged_balloon.vtkhdf"))
    columns = {"voltage / kV": solution["voltage"] / 1e3, "stretch": solution["stretch"]}
    print_steps(columns | {"exact": reference(solution), "p_t / Pa": solution["pressure_top"]})
    print(f"largest error of the stretch: {error(solution):.1e}")
    for ratio in (0.1, 0.05, 0.025):
        opened, closed = (error(run(*at(ratio, 1.2), f"model.interface={kind}")) for kind in ("opened", "closed"))
        print(f"T/R = {ratio:<5}: interface opened {opened:.1e}, closed {closed:.1e}")
    print_files(solution)
