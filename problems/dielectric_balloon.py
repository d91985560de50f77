"""A dielectric elastomer balloon under pressure and voltage, against the exact thick-walled dielectric sphere.

Physics: opposite charges on the two faces attract each other and squeeze the wall; it thins and widens, which raises
the field in it: at 18.9 kV it pulls in. The outer electrode is at zero: outside there is no field.

Reference: `problems.exact.dielectric_balloon`. The shell follows the equation of the thin balloon (Zhu, Cai and Suo,
Polym. Int. 59 (2010) 378) up to the discretisation; the thick wall is O((T/R)^2) away.

Run: about two seconds.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from embedding import Listener, Scene, Solution, Sphere, load_scene, solve
from embedding.scene.scales import EPSILON_0
from problems.common import Array, law_of, print_files, print_steps, thickness_ratio
from problems.exact.charged_shell import Theory
from problems.exact.dielectric_balloon import DielectricBalloon

SCENE = Path(__file__).with_suffix(".toml")


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"shell.relative_permittivity=5"``."""
    return load_scene(SCENE, changes)


def at(ratio: float) -> tuple[str, ...]:
    """Overrides for another T/R at the same loads in units of the wall: p R / (mu T) and V / T."""
    stated = scene()
    factor = ratio / thickness_ratio(stated)
    thickness, pressure = factor * stated.shell.thickest, factor * 600.0
    return (
        f"shell.thickness={thickness!r}",
        f"loads.pressure_bottom={pressure!r}",
        f"faces.bottom.voltage={factor * voltage(stated)!r}",
    )


def voltage(scene: Scene) -> float:
    """The voltage across the wall at the end of the path, in V; ValueError without electrodes."""
    if scene.faces.top is None or scene.faces.bottom is None:
        raise ValueError("the reference has an electrode on each face")
    return float(scene.faces.bottom.voltage) - float(scene.faces.top.voltage)


def run(
    *changes: str, archive: Path | None = None, listeners: Sequence[Listener] = (), throw: bool = True
) -> Solution:
    """Solve the scene with overrides; an unfinished path is returned where ``throw`` is off."""
    return solve(scene(*changes), archive=archive, listeners=listeners, throw=throw)


def exact(scene: Scene, theory: Theory = "thick") -> DielectricBalloon:
    """The exact shell of ``scene``, in SI units; ValueError for another shape, or without a permittivity."""
    shape, permittivity = scene.shell.shape, scene.shell.relative_permittivity
    if not isinstance(shape, Sphere) or permittivity is None:
        raise ValueError("the reference is a dielectric sphere")
    wall = permittivity * EPSILON_0
    return DielectricBalloon(shape.radius, scene.shell.thickest, law_of(scene), wall, EPSILON_0, theory=theory)


def reference(solution: Solution, theory: Theory = "thick") -> Array:
    """Exact stretch of the mid-surface at the pressure and the voltage of every step."""
    scene = solution.scene
    shell, full, pressure = exact(scene, theory), voltage(scene), scene.loads.pressure_bottom
    if not isinstance(pressure, float):
        raise ValueError("the reference has a uniform pressure")
    steps = solution.steps
    return np.array([shell.stretch(full * s.factor_field, pressure * s.factor_mechanical) for s in steps])


def error(solution: Solution, theory: Theory = "thick") -> float:
    """Largest error of the stretch over the steps."""
    return float(np.abs(solution["stretch"] - reference(solution, theory)).max())


if __name__ == "__main__":
    solution = run(archive=Path("dielectric_balloon.vtkhdf"))
    columns = {"voltage / kV": np.array([voltage(solution.scene) * s.factor_field / 1e3 for s in solution.steps])}
    print_steps(columns | {"stretch": solution["stretch"], "exact": reference(solution)})
    limit = exact(solution.scene).pull_in(600.0)
    if limit is not None:
        print(f"pull-in at {limit.load / 1e3:.4g} kV, stretch {limit.stretch:.4f}")
    for ratio in (0.1, 0.05, 0.025):
        found = run(*at(ratio))
        thick, thin = error(found), error(found, "membrane")
        print(f"T/R = {ratio:<5}: from the thick wall {thick:.1e}, from the thin one {thin:.1e}")
    print_files(solution)
