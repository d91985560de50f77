"""A conducting sphere in a uniform field, neutral, grounded or charged, against its exact surface field and forces.

Physics: charges move to the poles until there is no field inside; the dipole 4 pi eps0 R^3 E0 makes the field there
3 E0. It pulls the halves of the sphere apart with 9/4 pi eps0 R^2 E0^2, which makes a balloon longer, and exerts no
net force on it unless the balloon is charged: then Q E0.

Reference: `problems.exact.conducting_spheres` (J. D. Jackson, Classical Electrodynamics, sec. 2.5), for the sphere that
is held in its shape.

Run: about five seconds.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from ngsolve import BND, ET, GridFunction, IntegrationRule, Norm

from embedding import Listener, Scene, Solution, load_scene, solve
from embedding.scene.scales import EPSILON_0
from embedding.solving.events import StepRecord
from embedding.solving.state import State
from problems.common import Array, print_files
from problems.exact import conducting_spheres

SCENE = Path(__file__).with_suffix(".toml")
HELD = (
    "supports=[{where = 'surface', fix = ['x', 'y', 'z']}]",
    "loads.pressure_bottom=0",
    "path=[{steps = 1}]",
    "model.interface=closed",
)
"""Overrides for a sphere that stays as it is, with its faces at the mid-surface, where the reference has them."""


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"faces.both={voltage = 0}"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


class Pull(Listener):
    """Outward pull in Pa on the top face, over the cosine of the angle from the z axis, of the last accepted step."""

    def __init__(self) -> None:
        self.cosine: Array = np.empty(0)
        self.pull: Array = np.empty(0)

    def accepted(self, state: State, record: StepRecord) -> None:
        problem = state.problem
        rule = IntegrationRule(ET.TRIG if problem.reduction.dimension == 3 else ET.SEGM, 6)
        points = problem.mesh.MapToAllElements(rule, problem.blocks["shell"].region)
        places = problem.embed(np.asarray(problem.reduction.position(points)))
        pressure = next(field.values for field in state.fields() if (field.block, field.name) == ("shell", "p_t"))
        self.cosine = places[:, 2] / np.linalg.norm(places, axis=1)
        self.pull = -np.asarray(pressure(points)).ravel()


class Moments(Listener):
    """Works of the field on the radial motions 1, c and c^2 of a held sphere, c the cosine, in N, last accepted step.

    The pull of the exact field is a + b c + d c^2. Works converge faster than values at points.
    """

    def __init__(self) -> None:
        self.work: Array = np.empty(0)

    def accepted(self, state: State, record: StepRecord) -> None:
        problem, system = state.problem, state.problem.system
        position = problem.reduction.position
        outwards = position / Norm(position)
        cosine = outwards[problem.mesh.dim - 1]
        forces = -system.residual().FV().NumPy()[system.unknowns.range("u")]
        motion = GridFunction(system.unknowns.field("u").space)
        works = []
        for power in range(3):
            motion.Set(cosine**power * outwards, BND, definedon=problem.domain.shell)
            works.append(float(forces @ motion.vec.FV().NumPy()))
        self.work = np.array(works) * problem.scales.stress * problem.scales.length**2

    def pull(self, radius: float) -> Array:
        """a, b and d in Pa: the work on c^n is 4 pi R^2 [a, d/3; b/3; a/3, d/5]."""
        matrix = np.array([[1.0, 0.0, 1 / 3], [0.0, 1 / 3, 0.0], [1 / 3, 0.0, 1 / 5]])
        return np.linalg.solve(4.0 * math.pi * radius**2 * matrix, self.work)

    def apart(self, radius: float) -> float:
        """Force on the upper half along z, in N."""
        return 2.0 * math.pi * radius**2 * float(self.pull(radius) @ [1 / 2, 1 / 3, 1 / 4])


def applied(scene: Scene) -> float:
    """The applied field along z in V/m; ValueError without a uniform one."""
    if scene.ambient is None:
        raise ValueError("the reference is a sphere in an electric field")
    return scene.ambient.uniform_field[2]


def known_pull(scene: Scene, cosine: Array, charge: float = 0.0) -> Array:
    """The exact pull where `Pull` has it, of a held sphere with this charge in C."""
    radius, field = scene.shell.shape.size, applied(scene)
    angles = np.arccos(np.clip(cosine, -1.0, 1.0))
    pulls = [conducting_spheres.sphere_pressure(angle, radius, field, charge, EPSILON_0) for angle in angles]
    return np.array(pulls)


if __name__ == "__main__":
    pull, moments = Pull(), Moments()
    held = run(*HELD, listeners=[pull, moments])
    known = known_pull(held.scene, pull.cosine)
    print(f"largest error of the pull on a neutral sphere: {np.abs(pull.pull - known).max() / known.max():.1e}")
    halves = conducting_spheres.hemispheres_in_field(0.02, applied(held.scene), EPSILON_0)
    print(f"halves pulled apart with {halves:.6f} N: {moments.apart(0.02) / halves - 1.0:+.1e}")
    charged = run(*HELD, "faces.both={charge = '0.1 uC'}")
    print(f"net force on a charge of 0.1 uC: {charged['force_z'][-1] / (1e-7 * applied(held.scene)) - 1.0:+.1e}")
    solution = run(archive=Path("sphere_in_field.vtkhdf"))
    print(f"the balloon: stretch {solution['stretch_min'][-1]:.4f} to {solution['stretch_max'][-1]:.4f}", end="")
    print(f", net force {solution['force_z'][-1]:.1e} N")
    print_files(solution)
