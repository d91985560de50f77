"""A permeable spherical balloon in a uniform magnetic field: tractions on both faces, normal and tangential.

Physics: the shell gathers flux; the potential jumps across it and its normal derivative does too. Unlike a conductor,
both faces carry tractions, and the tangential ones are as large as the normal ones: mu0 H_n H_t on the top.

Reference: a shell too stiff to deform has the exact tractions of `problems.exact.permeable_sphere` (three regions;
Jackson, Classical Electrodynamics, sec. 5.12), which the opened interface approaches as O((T/R)^2). The soft balloon
of the scene file has no exact solution: its energy and its forces must balance, see the tests.

Run: about ten seconds.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from ngsolve import CF, ET, IntegrationRule

from embedding import Listener, Scene, Solution, load_scene, solve
from embedding.scene.scales import MU_0
from embedding.solving.events import StepRecord
from embedding.solving.state import State
from problems.common import Array, print_files, print_steps, thickness_ratio
from problems.exact.permeable_sphere import PermeableSphere

SCENE = Path(__file__).with_suffix(".toml")
COMPONENTS = ("p_t", "tau_t", "p_b", "tau_b")
FINE = ("discretisation.order=4", "discretisation.shell_size=2 mm")
"""A mesh whose error is below that of the theory."""


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"shell.relative_permeability=2"``."""
    return load_scene(SCENE, changes)


def rigid(ratio: float, permeability: float) -> tuple[str, ...]:
    """Overrides for a shell of another T/R that is too stiff to deform: mu0 H0^2 is 2e-9 of its modulus."""
    return (
        f"shell.thickness={ratio * scene().shell.shape.size!r}",
        f"shell.relative_permeability={permeability!r}",
        "shell.material.shear_modulus=1e12",
        "loads.pressure_bottom=0",
        "path=[{steps = 1}]",
        "solver.tolerance=1e-12",
    )


class FieldTractions(Listener):
    """The field's tractions at the last step, in Pa, at the polar angles ``theta`` of points of the shell.

    Signs as in `problems.exact.three_regions.Tractions`; arrays of shape (n,) by name.
    """

    def __init__(self) -> None:
        self.theta: Array = np.empty(0)
        self.values: dict[str, Array] = {}

    def accepted(self, state: State, record: StepRecord) -> None:
        problem = state.problem
        rule = IntegrationRule(ET.TRIG if problem.reduction.dimension == 3 else ET.SEGM, 6)
        points = problem.mesh.MapToAllElements(rule, problem.blocks["shell"].region)
        where = problem.embed(np.asarray(problem.reduction.position(points)))
        self.theta, e_theta = self.polar(where)
        for face, traction in problem.system.tractions.items():
            traction.refresh()
            tangential = problem.embed_vector(np.asarray(CF(traction.tangential())(points)))
            pressure = np.asarray(CF(traction.pressure())(points)).ravel()
            self.values[f"p_{face}"] = problem.scales.stress * pressure
            self.values[f"tau_{face}"] = problem.scales.stress * np.einsum("ij,ij->i", tangential, e_theta)

    def polar(self, where: Array) -> tuple[Array, Array]:
        """Angle (n,) from the field along z, and e_theta (n, 3), at points (n, 3)."""
        across = np.hypot(where[:, 0], where[:, 1])
        theta = np.arctan2(across, where[:, 2])
        outward = where[:, :2] / across[:, None]
        return theta, np.column_stack([np.cos(theta)[:, None] * outward, -np.sin(theta)])


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


def reference(scene: Scene, theta: Array) -> dict[str, Array]:
    """Exact tractions of the undeformed shell of ``scene`` at polar angles, in Pa, by component.

    Raises ValueError without an ambient or a permeability.
    """
    sphere = exact(scene)
    tractions = np.array([sphere.tractions(float(angle)) for angle in theta])
    return dict(zip(COMPONENTS, tractions.T, strict=True))


def exact(scene: Scene) -> PermeableSphere:
    """The undeformed shell of ``scene`` at mid radius 1, in SI units; ValueError without a permeability."""
    ratio, permeability = thickness_ratio(scene), scene.shell.relative_permeability
    if scene.ambient is None or permeability is None:
        raise ValueError("the reference is a permeable shell in a magnetic field")
    return PermeableSphere(1 - ratio / 2, 1 + ratio / 2, permeability, scene.ambient.applied_field[2], MU_0)


def error(scene: Scene, found: FieldTractions) -> dict[str, float]:
    """Root mean square error over the sphere of each traction, relative to its own root mean square."""
    weight = np.sin(found.theta)
    return {
        name: float(np.sqrt(np.sum(weight * (found.values[name] - known) ** 2) / np.sum(weight * known**2)))
        for name, known in reference(scene, found.theta).items()
    }


def inner_field(found: FieldTractions) -> float:
    """Field in the cavity in A/m: mu0 H^2 / 2 is the length of the traction on the bottom face, everywhere."""
    traction = np.hypot(found.values["p_b"], found.values["tau_b"])
    return float(np.sqrt(2.0 * np.average(traction, weights=np.sin(found.theta)) / MU_0))


def rigid_error(ratio: float, permeability: float, *changes: str) -> dict[str, float]:
    """Errors of the four tractions on the undeformed shell."""
    found = FieldTractions()
    solution = run(*rigid(ratio, permeability), *changes, listeners=[found])
    return error(solution.scene, found)


if __name__ == "__main__":
    solution = run(archive=Path("permeable_sphere.vtkhdf"))
    columns = {name: solution[name] for name in ("stretch", "stretch_max", "pressure_top", "pressure_bottom")}
    print_steps(columns)
    print("errors of the tractions on a rigid shell")
    for permeability in (2.0, 10.0, 1e3):
        for ratio in (0.1, 0.05):
            errors = rigid_error(ratio, permeability, *FINE)
            listed = "  ".join(f"{name} {value:.1e}" for name, value in errors.items())
            print(f"mu_r = {permeability:<6g} T/R = {ratio:<5g} {listed}")
    print_files(solution)
