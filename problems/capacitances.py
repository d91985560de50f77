"""Capacitances of conductors alone and in pairs, and the forces between them, against exact values.

Physics: the shell keeps its shape, so that this is the field alone: bowls whose rims carry an infinite charge density,
smooth bodies, a sphere beside another one and over a grounded plane that goes on to infinity; a square and a cube,
which take three dimensions.

Reference: `problems.exact.capacitance` (Kelvin's bowls, spheroids, ring torus, the square by boundary elements, the
cube by random walks) and `problems.exact.conducting_spheres` (Maxwell's images).

Run: a few minutes, most of them for the cube.
"""

from __future__ import annotations

import math
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from netgen.occ import Box, Pnt

from embedding import Scene, Solution, load_scene, solve
from embedding.scene.scales import EPSILON_0
from problems.common import print_files
from problems.exact import capacitance, conducting_spheres

SCENE = Path(__file__).with_suffix(".toml")
R = 0.02
OTHER = 0.01
"""Radius of the second sphere, m."""


class Conductor(NamedTuple):
    """Shape of the shell, as a table of the scene file, and its capacitance in F."""

    shape: str
    known: float


def _bowl(degrees: float) -> Conductor:
    known = capacitance.spherical_cap(R, math.radians(degrees), EPSILON_0)
    return Conductor(f"{{kind = 'cap', radius = {R}, half_angle = '{degrees} deg'}}", known)


def _spheroid(polar: float) -> Conductor:
    known = capacitance.spheroid(R, polar, EPSILON_0)
    return Conductor(f"{{kind = 'ellipsoid', semi_axes = [{R}, {R}, {polar}]}}", known)


SMOOTH = {
    "sphere": Conductor(f"{{kind = 'sphere', radius = {R}}}", capacitance.sphere(R, EPSILON_0)),
    **{f"oblate spheroid 1:{ratio:g}": _spheroid(R / ratio) for ratio in (1.1, 1.5, 2.0, 3.0, 5.0, 10.0)},
    **{f"prolate spheroid {ratio:g}:1": _spheroid(R * ratio) for ratio in (1.1, 1.5, 2.0, 3.0, 5.0, 10.0)},
    "torus": Conductor(
        f"{{kind = 'torus', radius = {R}, tube_radius = {0.4 * R}}}", capacitance.torus(R, 0.4 * R, EPSILON_0)
    ),
}
RIMMED = {
    "disc": Conductor(f"{{kind = 'disc', radius = {R}}}", capacitance.disc(R, EPSILON_0)),
    **{f"bowl of {angle:g} degrees": _bowl(angle) for angle in (10.0, 30.0, 45.0, 60.0, 90.0, 120.0, 170.0)},
}
SQUARE = Conductor(
    f"{{kind = 'plate', length = {2 * R}, width = {2 * R}, centred = true}}", capacitance.square(2 * R, EPSILON_0)
)


def cube(file: Path) -> Conductor:
    """A cube of the edge 2 R, as faces in a new BREP ``file``."""
    corner = 1e3 * R
    Box(Pnt(-corner, -corner, -corner), Pnt(corner, corner, corner)).WriteBrep(str(file))
    return Conductor(f"{{kind = 'file', path = '{file}'}}", capacitance.cube(2 * R, EPSILON_0))


def scene(*changes: str) -> Scene:
    """The scene file with overrides."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive)


def error(conductor: Conductor, *changes: str) -> float:
    """Relative error of the capacitance."""
    solution = run(f"shell.shape={conductor.shape}", *changes)
    return float(solution["charge"][-1] / solution["voltage"][-1] / conductor.known - 1.0)


def at_edges(size: float) -> str:
    """Override: elements of this size, in m, along the edges of the square. Its error is of first order in them."""
    return f"discretisation.edge_size={{{', '.join(f'{edge} = {size!r}' for edge in ('x0', 'x1', 'y0', 'y1'))}}}"


def beyond_order(low: float, high: float, order: int) -> float:
    """The limit of the errors ``low`` and ``high`` of the potentials of ``order`` and one more, on one mesh.

    Its singularity at an edge, r^(1/2), lets the energy's error fall as order^-2 (I. Babuska, M. Suri, RAIRO Modél.
    Math. Anal. Numér. 21 (1987) 199).
    """
    return high + (high - low) / ((1.0 + 1.0 / order) ** 2 - 1.0)


def second_sphere(distance: float, voltage: float = 0.0) -> str:
    """Override: a sphere of the radius `OTHER` at the ``distance`` of the centres, in m, at a voltage."""
    return f"ambient.bodies=[{{kind='sphere', centre=[0, 0, {distance!r}], radius={OTHER}, voltage={voltage!r}}}]"


def pair_errors(distance: float, *changes: str) -> dict[str, float]:
    """Relative errors of c11, c12 and of the force, and force on both over that on one."""
    solution = run(second_sphere(distance), *changes)
    voltage, force = float(solution["voltage"][-1]), float(solution["force_z"][-1])
    known = conducting_spheres.two_spheres(R, OTHER, distance, EPSILON_0)
    apart = conducting_spheres.repulsion(R, OTHER, distance, (voltage, 0.0), EPSILON_0)
    return {
        "c11": float(solution["charge"][-1]) / voltage / known.c11 - 1.0,
        "c12": float(solution["charge_body0"][-1]) / voltage / known.c12 - 1.0,
        "force": force / -apart - 1.0,
        "balance": 1.0 + float(solution["force_body0_z"][-1]) / force,
    }


def plane(height: float, voltage: float = 0.0) -> str:
    """Override: a plane ``height`` below the centre, in m, at a voltage."""
    return f"ambient.bodies=[{{kind='half-space', level={-height!r}, voltage={voltage!r}}}]"


def plane_errors(height: float, *changes: str, voltage: float = 0.0) -> dict[str, float]:
    """Relative errors of the capacitance between sphere and plane and of the force."""
    solution = run(plane(height, voltage), *changes)
    across = float(solution["voltage"][-1]) - voltage
    attraction = conducting_spheres.attraction_to_plane(R, height, across, EPSILON_0)
    return {
        "capacitance": float(solution["charge"][-1]) / across
        / conducting_spheres.sphere_and_plane(R, height, EPSILON_0) - 1.0,
        "force": float(solution["force_z"][-1]) / -attraction - 1.0,
    }  # fmt: skip


if __name__ == "__main__":
    for name, conductor in (SMOOTH | RIMMED).items():
        print(f"{name:21} {conductor.known * 1e12:.5f} pF: {error(conductor):+.1e}")
    low, high = (error(SQUARE, f"discretisation.order={order}") for order in (1, 2))
    print(f"{'square':21} {SQUARE.known * 1e12:.5f} pF: {high:+.1e}; potentials of order 2, 3, and ", end="")
    print(f"their limit: {low:+.1e}, {high:+.1e}, {beyond_order(low, high, 2):+.1e}")
    with TemporaryDirectory() as place:
        conductor = cube(Path(place) / "cube.brep")
        print(f"{'cube':21} {conductor.known * 1e12:.5f} pF: {error(conductor):+.1e}")
    for distance in (0.032, 0.044, 0.06):
        print(f"spheres {distance} m apart: {', '.join(f'{k} {e:+.1e}' for k, e in pair_errors(distance).items())}")
    for height in (0.025, 0.04):
        print(f"plane {height} m below: {', '.join(f'{k} {e:+.1e}' for k, e in plane_errors(height).items())}")
    print_files(run(archive=Path("capacitances.vtkhdf")))
