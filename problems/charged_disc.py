"""A thin conducting disc at a voltage in free space, against its exact charge and the force on its rim.

Physics: every point of the faces is pulled along its normal, on both sides alike. What stretches the disc acts on its
rim alone: the charge density grows as the inverse root of the distance from it, and the field pulls the rim outwards
with a finite force per length, 2 eps0 V^2 / (pi R), the derivative of the energy with the radius. The disc is held in
its plane and stretches by that force over 6 mu T.

Reference: `problems.exact.charged_disc` (W. R. Smythe, Static and Dynamic Electricity (1950), sec. 5.03).

Run: about five seconds.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from ngsolve import BND, CF, GridFunction

from embedding import Disc, Listener, NeoHookean, Scene, Solution, load_scene, solve
from embedding.scene.scales import EPSILON_0
from embedding.solving.events import StepRecord
from embedding.solving.state import State
from problems.common import Array, print_files
from problems.exact import capacitance, charged_disc

SCENE = Path(__file__).with_suffix(".toml")
HELD = "supports=[{where = 'surface', fix = ['x', 'y', 'z']}]"
"""Override for a disc that stays as it is."""


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"discretisation.order=4"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


class RadialForce(Listener):
    """Work of the field per relative growth of the radius of a disc that is `HELD`, in J, of the last accepted step."""

    def __init__(self) -> None:
        self.value = 0.0

    def accepted(self, state: State, record: StepRecord) -> None:
        problem = state.problem
        growth = GridFunction(problem.system.unknowns.field("u").space)
        growth.Set(CF((problem.reduction.position[0], 0.0)), BND, definedon=problem.domain.shell)
        rows = problem.system.residual().FV().NumPy()[problem.system.unknowns.range("u")]
        self.value = -float(rows @ growth.vec.FV().NumPy()) * problem.scales.stress * problem.scales.length**3


def charge_error(solution: Solution) -> float:
    """Relative error of the charge at the last step, at the radius there; ValueError for another shape."""
    if not isinstance(solution.scene.shell.shape, Disc):
        raise ValueError("the reference is a disc")
    radius = solution.scene.shell.shape.radius * solution["stretch"][-1]
    return float(solution["charge"][-1] / (capacitance.disc(radius, EPSILON_0) * solution["voltage"][-1]) - 1.0)


def known_strain(solution: Solution) -> Array:
    """l - 1 in equilibrium with the force on the rim, for small strains, at every step."""
    shell = solution.scene.shell
    if not isinstance(shell.shape, Disc) or not isinstance(shell.material, NeoHookean):
        raise ValueError("the reference is a neo-Hookean disc")
    stiffness = 6.0 * shell.material.shear_modulus * shell.thickest
    radius, voltages = shell.shape.radius, solution["voltage"]
    return np.array([charged_disc.edge_force(radius, voltage, EPSILON_0) / stiffness for voltage in voltages])


def force_error(*changes: str) -> float:
    """Relative error of the net radial force on the held disc, dC/dR V^2 / 2."""
    force = RadialForce()
    solution = run(HELD, *changes, listeners=[force])
    radius = solution.scene.shell.shape.size
    return force.value / (radius * charged_disc.radial_force(float(solution["voltage"][-1]), EPSILON_0)) - 1.0


if __name__ == "__main__":
    solution = run(archive=Path("charged_disc.vtkhdf"))
    strain, known = solution["stretch"][-1] - 1.0, known_strain(solution)[-1]
    print(f"strain {strain:.5e}, known {known:.5e}: {strain / known - 1.0:+.1e}")
    print(f"error of the charge {charge_error(solution):.1e}")
    for size in (0.4, 0.2, 0.1, 0.05):
        finer = f"discretisation.edge_size={{rim = '{size} mm'}}"
        print(f"elements of {size} mm at the rim: charge {charge_error(run(HELD, finer)):+.1e}, ", end="")
        print(f"force on the rim {force_error(finer):+.1e}")
    print_files(solution)
