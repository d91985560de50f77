"""Stretched membranes, a strip and a disc, pulled in over a rigid electrode, in the limit of a thin gap.

Physics: opposite charges attract the membrane towards the electrode, the more the nearer it comes: at a largest voltage
no tension holds it any more. Arc length finds that as a limit point; beyond it the membrane would snap on.

Reference: `problems.exact.mems`, loads 1.400016 (strip) and 0.789229 (disc) for gaps without fringes and small slopes
(J. A. Pelesko, D. H. Bernstein, Modeling MEMS and NEMS, 2002). What both leave out is of second order in the gap, up to
a logarithm; three gaps, each half of the one before, show the order and the limit (A. Aitken's extrapolation).

Run: about half a minute.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from embedding import Disc, Listener, NeoHookean, Scene, Solution, load_scene, solve
from embedding.scene.scales import EPSILON_0
from problems.common import Probe, Reading, print_files
from problems.exact import mems

SCENES = {name: Path(__file__).with_name(f"{name}.toml") for name in ("membrane_pull_in", "membrane_pull_in_disc")}
STRIP, DISC = SCENES
RATIOS = (0.2, 0.1, 0.05)
"""Gaps over the size of the membrane; the last one is that of the scene files."""


def scene(name: str = STRIP, *changes: str) -> Scene:
    """The scene file ``name`` with overrides."""
    return load_scene(SCENES[name], changes)


def at(name: str, ratio: float) -> tuple[str, ...]:
    """Overrides for another gap over size, at the same load in units of the limit."""
    stated = scene(name)
    factor = ratio * stated.shell.shape.size / gap(stated)
    new, voltage = factor * gap(stated), factor**1.5 * full_voltage(stated)
    edges = ", ".join(f"{edge} = {factor * size!r}" for edge, size in stated.discretisation.edge_size.items())
    until = stated.path[-1].until
    assert until is not None
    end = f"{{where = {list(until.where)!r}, axis = '{until.axis}', value = {factor * until.value!r}}}"
    return (
        f"ambient.bodies=[{{kind = 'half-space', level = {-new!r}, voltage = '0 V'}}]",
        f"faces.both.voltage={voltage!r}",
        f"discretisation.edge_size={{{edges}}}",
        f"path=[{{name = 'stretching', steps = 2, field = 0.0}}, {{name = 'charging', until = {end}}}]",
    )


def run(
    name: str, *changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()
) -> Solution:
    """Solve the scene ``name`` with overrides."""
    return solve(scene(name, *changes), archive=archive, listeners=listeners)


def gap(scene: Scene) -> float:
    """Between the flat membrane and the electrode, in m; ValueError without a half-space."""
    if scene.ambient is None or not scene.ambient.bodies or scene.ambient.bodies[0].kind != "half-space":
        raise ValueError("the reference has a half-space as its electrode")
    return -scene.ambient.bodies[0].level


def full_voltage(scene: Scene) -> float:
    """Voltage of the membrane at the end of the path, in V; ValueError where it is not given."""
    if scene.faces.both is None or scene.faces.both.voltage is None:
        raise ValueError("the membrane has a voltage")
    return scene.faces.both.voltage


def tension(scene: Scene) -> tuple[float, float]:
    """(N, L): force per deformed length, N/m, and the size of the stretched membrane, m: width or radius.

    ValueError for another material than neo-Hooke.
    """
    if not isinstance(scene.shell.material, NeoHookean):
        raise ValueError("the stretch is that of neo-Hooke")
    stiffness = scene.shell.material.shear_modulus * scene.shell.thickest
    traction, power = scene.loads.edge_tractions[0].traction[0], 5 if isinstance(scene.shell.shape, Disc) else 3
    stretch = mems.bracketed_root(lambda s: stiffness * (s - s**-power) - traction, 1.0, 2.0)
    size = stretch * scene.shell.shape.size
    return (traction / stretch if isinstance(scene.shell.shape, Disc) else traction), size


def pull_in(solution: Solution) -> float:
    """Load eps0 V^2 L^2 / (2 N g^3) at the first limit point; ValueError if there is none."""
    scene = solution.scene
    (force, size), height = tension(scene), gap(scene)
    for point in solution.critical_points:
        if point.kind == "limit":
            voltage = point.scalars["voltage"]
            return EPSILON_0 * voltage**2 * size**2 / (2.0 * force * height**3)
    raise ValueError("the path has no limit point")


def known(name: str) -> mems.PullIn:
    """The thin-gap limit."""
    return mems.disc_pull_in() if name == DISC else mems.strip_pull_in()


def extrapolated(loads: Sequence[float]) -> tuple[float, float]:
    """(limit, order) of three loads at gaps that halve."""
    first, second, third = loads
    before, after = first - second, second - third
    return third - after**2 / (before - after), math.log2(before / after)


def centre(name: str) -> Probe:
    """Records the displacement "centre" of the middle towards the electrode, in m."""
    until = scene(name).path[-1].until
    assert until is not None
    return Probe({"centre": Reading(until.where, until.axis, -1.0)})


if __name__ == "__main__":
    for name in (DISC, STRIP):
        solutions = [run(name, *at(name, ratio)) for ratio in RATIOS[:-1]]
        solutions.append(run(name, archive=Path(f"{name}.vtkhdf")))
        loads = [pull_in(solution) for solution in solutions]
        for ratio, load in zip(RATIOS, loads, strict=True):
            print(f"{name}: gap {ratio:<4} of the size, pull-in at the load {load:.6f}")
        limit, order = extrapolated(loads)
        exact = known(name).load
        print(f"extrapolated with order {order:.2f}: {limit:.6f}, known {exact:.6f}: {limit / exact - 1.0:+.1e}")
    print_files(solutions[-1])
