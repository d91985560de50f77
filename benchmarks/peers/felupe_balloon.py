"""FElupe: a neo-Hookean balloon as a thin-walled solid under inner pressure; prints one line of JSON.

``python felupe_balloon.py REDUCTION ORDER N LAYERS RATIO PRESSURE [STEPS]``: REDUCTION "axisymmetric" or "octant",
ORDER 1 (linear quads and hexahedra, pressure constant in each) or 2 (biquadratic, three fields), N elements along a
quarter circle, LAYERS through the wall of thickness RATIO (of the mid radius), PRESSURE in shear moduli. One step does.
"""

from __future__ import annotations

import json
import math
import sys
import time

import felupe
import numpy as np

# FElupe's solids are nearly incompressible. In shear moduli: 1e7 moves the stretch by 1e-7; the linear elements' Newton
# stalls on rounding beyond 1e4, which moves it by 5e-5.
BULK = {1: 1e4, 2: 1e7}


def with_midpoints(mesh: felupe.Mesh) -> felupe.Mesh:
    """The mesh of order 2: nodes on edges, faces and inside."""
    mesh = mesh.add_midpoints_edges().add_midpoints_faces()
    return mesh.add_midpoints_volumes() if mesh.dim == 3 else mesh


def wall(mesh: felupe.Mesh, order: int, ratio: float) -> tuple[felupe.Mesh, np.ndarray]:
    """The mesh with its middle nodes, and the radius of each point from its first coordinate, 0 inside to 1 outside."""
    mesh = with_midpoints(mesh) if order == 2 else mesh
    return mesh, 1.0 + ratio * (mesh.points[:, 0] - 0.5)


def quarter(n: int, layers: int, order: int, ratio: float) -> felupe.Mesh:
    """Cross-section of a hemisphere, (axial, radial): equal angles."""
    mesh, radius = wall(felupe.Rectangle(n=(layers + 1, n + 1)), order, ratio)
    angle = 0.5 * math.pi * mesh.points[:, 1]
    return felupe.Mesh(np.stack([radius * np.cos(angle), radius * np.sin(angle)], 1), mesh.cells, mesh.cell_type)


def octant(n: int, layers: int, order: int, ratio: float) -> felupe.Mesh:
    """Three patches that meet on the diagonal, each n / 2 by n / 2: the faces of a cube seen from its centre."""
    mesh, radius = wall(felupe.Cube(n=(layers + 1, n // 2 + 1, n // 2 + 1)), order, ratio)
    direction = np.stack([np.ones_like(radius), *np.tan(0.25 * math.pi * mesh.points[:, 1:]).T], 1)
    points = radius[:, None] * direction / np.linalg.norm(direction, axis=1)[:, None]
    patches = [felupe.Mesh(np.roll(points, turn, axis=1), mesh.cells, mesh.cell_type) for turn in range(3)]
    return felupe.mesh.concatenate(patches).merge_duplicate_points(decimals=10)


REGIONS = {
    ("axisymmetric", 1): (felupe.RegionQuad, felupe.RegionQuadBoundary),
    ("axisymmetric", 2): (felupe.RegionBiQuadraticQuad, felupe.RegionBiQuadraticQuadBoundary),
    ("octant", 1): (felupe.RegionHexahedron, felupe.RegionHexahedronBoundary),
    ("octant", 2): (felupe.RegionTriQuadraticHexahedron, felupe.RegionTriQuadraticHexahedronBoundary),
}


def body(region: object, order: int, flat: bool) -> tuple[felupe.FieldContainer, object]:
    """The unknowns and the solid: pressure condensed in each linear element, three fields at order 2."""
    if order == 2:
        field = felupe.FieldsMixed(region, n=3, axisymmetric=flat)
        return field, felupe.SolidBody(felupe.NearlyIncompressible(felupe.NeoHooke(mu=1.0), bulk=BULK[order]), field)
    kind = felupe.FieldAxisymmetric(region, dim=2) if flat else felupe.Field(region, dim=3)
    field = felupe.FieldContainer([kind])
    return field, felupe.SolidBodyNearlyIncompressible(felupe.NeoHooke(mu=1.0), field, bulk=BULK[order])


def stretch(mesh: felupe.Mesh, moved: np.ndarray, flat: bool) -> float:
    """Mean of r / R over the nodes of the mid-surface, by their share of the angle (axisymmetric) or alike (octant)."""
    radius = np.linalg.norm(mesh.points, axis=1)
    middle = np.abs(radius - 1.0) < 1e-9
    if not middle.any():
        raise SystemExit("no node lies on the mid-surface: linear elements need an even number of layers")
    weight = mesh.points[middle, 1] if flat else np.ones(middle.sum())
    return float(np.average(np.linalg.norm(mesh.points + moved, axis=1)[middle], weights=weight))


def main(reduction: str, order: int, n: int, layers: int, ratio: float, pressure: float, steps: int) -> None:
    """Solve and print."""
    flat = reduction == "axisymmetric"
    begun = time.perf_counter()
    mesh = (quarter if flat else octant)(n, layers, order, ratio)
    volume, boundary = REGIONS[reduction, order]
    field, solid = body(volume(mesh), order, flat)
    inside = np.linalg.norm(mesh.points, axis=1) < 1.0 - 0.5 * ratio + 1e-9
    surface = boundary(mesh, only_surface=True, mask=inside, **({"ensure_3d": True} if flat else {}))
    kind = felupe.FieldAxisymmetric(surface, dim=2) if flat else felupe.Field(surface, dim=3)
    load = felupe.SolidBodyPressure(felupe.FieldContainer([kind]))
    held = felupe.dof.symmetry(field[0])
    dof0, dof1 = felupe.dof.partition(field, held)
    wall_time, cpu, iterations = time.perf_counter(), time.process_time(), 0
    setup = wall_time - begun
    for step in range(1, steps + 1):
        load.update(pressure * step / steps)
        done = felupe.newtonraphson(
            x0=field,
            items=[solid, load],
            dof0=dof0,
            dof1=dof1,
            ext0=felupe.dof.apply(field, held, dof0),
            tol=1e-8,
            verbose=0,
        )
        iterations += done.iterations
    wall_time, cpu = time.perf_counter() - wall_time, time.process_time() - cpu
    answer = {
        "stretch": stretch(mesh, field[0].values, flat),
        "unknowns": len(dof1),
        "iterations": iterations,
        "steps": steps,
        "converged": bool(done.success),
        "setup_wall": setup,
        "solve_wall": wall_time,
        "solve_cpu": cpu,
    }
    print(json.dumps(answer))


if __name__ == "__main__":
    words = sys.argv[1:]
    main(words[0], *map(int, words[1:4]), *map(float, words[4:6]), int(words[6]) if len(words) > 6 else 1)
