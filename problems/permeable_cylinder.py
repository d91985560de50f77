"""A permeable tube across a uniform magnetic field: tractions on both faces, normal and tangential.

Physics: as the permeable sphere, in the plane. A tube that is held has the exact tractions of
`problems.exact.permeable_cylinder`. The opened interface meets them whatever the thickness, up to the discretisation:
of a dipole field in a circular wall, a r + c / r, the mean flux is the jump of the potential over T, and the
difference of the fluxes T times the mean potential, exactly. The field in the cavity is read off the bottom face. The
soft tube of the scene file has no exact solution.

Run: about four seconds.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from embedding import Listener, Scene, Solution, load_scene, solve
from embedding.scene.scales import MU_0
from problems.common import Array, print_files, print_steps, thickness_ratio
from problems.exact.permeable_cylinder import PermeableCylinder
from problems.permeable_sphere import COMPONENTS, FieldTractions

SCENE = Path(__file__).with_suffix(".toml")
FINE = ("discretisation.order=4", "discretisation.shell_size=2 mm")
"""A mesh with an error of 5e-7."""


class TubeTractions(FieldTractions):
    """The field's tractions on a tube, at the angles ``theta`` from the field along x."""

    def polar(self, where: Array) -> tuple[Array, Array]:
        theta = np.arctan2(where[:, 1], where[:, 0])
        return theta, np.column_stack([-np.sin(theta), np.cos(theta), np.zeros_like(theta)])


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"shell.relative_permeability=2"``."""
    return load_scene(SCENE, changes)


def rigid(ratio: float, permeability: float) -> tuple[str, ...]:
    """Overrides for a tube of another T/R that is held everywhere: a slack one bends without stretching."""
    return (
        f"shell.thickness={ratio * scene().shell.shape.size!r}",
        f"shell.relative_permeability={permeability!r}",
        "supports=[{where = 'surface', fix = ['x', 'y']}]",
        "loads.pressure_bottom=0",
        "path=[{steps = 1}]",
    )


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


def exact(scene: Scene) -> PermeableCylinder:
    """The undeformed tube of ``scene`` at mid radius 1, in SI units; ValueError without a permeability."""
    ratio, permeability = thickness_ratio(scene), scene.shell.relative_permeability
    if scene.ambient is None or permeability is None:
        raise ValueError("the reference is a permeable tube in a magnetic field")
    return PermeableCylinder(1 - ratio / 2, 1 + ratio / 2, permeability, scene.ambient.applied_field[0], MU_0)


def error(scene: Scene, found: FieldTractions) -> dict[str, float]:
    """Root mean square error over the tube of each traction, relative to the whole traction on its face."""
    tube = exact(scene)
    known = dict(zip(COMPONENTS, np.array([tube.tractions(float(t)) for t in found.theta]).T, strict=True))
    whole = {face: np.sum(known[f"p_{face}"] ** 2 + known[f"tau_{face}"] ** 2) for face in "tb"}
    return {
        name: float(np.sqrt(np.sum((found.values[name] - value) ** 2) / whole[name[-1]]))
        for name, value in known.items()
    }


def inner_field(found: FieldTractions) -> float:
    """Field in the cavity in A/m: mu0 H^2 / 2 is the length of the traction on the bottom face, everywhere."""
    traction = np.hypot(found.values["p_b"], found.values["tau_b"])
    return float(np.sqrt(2.0 * np.mean(traction) / MU_0))


def rigid_run(ratio: float, permeability: float, *changes: str) -> tuple[Scene, FieldTractions]:
    """The undeformed tube and the tractions on it."""
    found = TubeTractions()
    return run(*rigid(ratio, permeability), *changes, listeners=[found]).scene, found


if __name__ == "__main__":
    solution = run(archive=Path("permeable_cylinder.vtkhdf"))
    print_steps({name: solution[name] for name in ("stretch", "stretch_max", "pressure_top", "pressure_bottom")})
    print("errors of the tractions and of the field in the cavity on a rigid tube")
    for permeability in (2.0, 10.0, 1e3):
        for ratio in (0.1, 0.05):
            stated, found = rigid_run(ratio, permeability, *FINE)
            listed = "  ".join(f"{name} {value:.1e}" for name, value in error(stated, found).items())
            cavity = inner_field(found) / exact(stated).inner_field - 1.0
            print(f"mu_r = {permeability:<6g} T/R = {ratio:<5g} {listed}  H_in {cavity:+.1e}")
    print_files(solution)
