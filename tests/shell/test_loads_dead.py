"""Dead loads: resultant force and moment are those that are stated, in every reduction, for the whole body."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from ngsolve import CF, Integrate, dx, x, y, z

from embedding.shell.edges import EdgeForce
from embedding.shell.loads import MechanicalLoads
from tests.forms import body
from tests.shell.rigid import NodalForces

NONE = MechanicalLoads(0.0, 0.0, (), (), True, "embedding-aware")
REST = {2: CF((0, 0)), 3: CF((0, 0, 0))}


def resultant(name: str, loads: MechanicalLoads, **options: Any) -> tuple[list[float], list[float]]:
    domain = body(name, **options)
    forces = NodalForces(domain, loads)
    rest = REST[domain.mesh.dim]
    return list(forces.force(rest)), list(forces.moment(rest))


def test_a_surface_force_on_a_plate() -> None:
    """q = (2, 0, -3) on 1 x 0.6: the force q A at the centre (0.5, 0.3)."""
    force, moment = resultant("plate", replace(NONE, surface_force=(2.0, 0.0, -3.0)))
    assert force == pytest.approx([1.2, 0.0, -1.8], abs=1e-12)
    assert moment == pytest.approx([0.3 * -1.8, 0.5 * 1.8, -0.3 * 1.2], abs=1e-12)


def test_a_surface_force_that_varies() -> None:
    """q = (x, y^2, 1 + x y) on 1 x 0.6: polynomials that the quadrature integrates exactly."""
    force, moment = resultant("plate", replace(NONE, surface_force=CF((x, y * y, 1 + x * y))))
    assert force == pytest.approx([0.3, 0.072, 0.6 + 0.09], abs=1e-12)
    about_x = 0.18 + 0.5 * 0.6**3 / 3  # int y (1 + x y)
    about_y = -(0.3 + 0.6**2 / 2 / 3)  # - int x (1 + x y)
    about_z = 0.5 * 0.6**3 / 3 - 0.5 * 0.6**2 / 2  # int x y^2 - y x
    assert moment == pytest.approx([about_x, about_y, about_z], abs=1e-12)


@pytest.mark.parametrize(("name", "area"), [("sphere", 4 * math.pi), ("quarter disc", math.pi), ("ring", 2 * math.pi)])
def test_a_surface_force_acts_on_the_whole_body(name: str, area: float) -> None:
    domain = body(name, size=0.3, order=3)
    forces = NodalForces(domain, replace(NONE, surface_force=(0.0, 0.0, 2.0)[-domain.mesh.dim :]))
    up = CF((0, 0, 1)[-domain.mesh.dim :])
    assert forces.work(REST[domain.mesh.dim], up) == pytest.approx(2 * area, rel=1e-4)


def test_a_line_load_on_a_plate() -> None:
    """t = (1, 2, 3) on the edge x = 1 of length 0.6."""
    force, moment = resultant("plate", replace(NONE, line_loads=(("x1", (1.0, 2.0, 3.0)),)))
    assert force == pytest.approx([0.6, 1.2, 1.8], abs=1e-12)
    assert moment == pytest.approx([0.3 * 1.8, -1.8, 1.2 - 0.3 * 0.6], abs=1e-12)


@pytest.mark.parametrize(("name", "length"), [("quarter disc", 2.0), ("disc", 0.0)])
def test_a_line_in_a_mirror_plane_counts_once(name: str, length: float) -> None:
    """The line x = 0 of the disc from y = -1 to 1, half of which is meshed and shared by two copies."""
    loads = replace(NONE, line_loads=(("symmetry_x", (0.0, 0.0, 3.0)),))
    force, _ = resultant(name, loads)
    assert force[2] == pytest.approx(3 * length, abs=1e-12)


@pytest.mark.parametrize("kind", [False, True], ids=["dead", "follower at rest"])
@pytest.mark.parametrize(
    ("edge", "outward", "along", "middle"),
    [
        ("x0", (-1, 0), (0, -1), (0.0, 0.3)),
        ("x1", (1, 0), (0, 1), (1.0, 0.3)),
        ("y0", (0, -1), (1, 0), (0.5, 0.0)),
        ("y1", (0, 1), (-1, 0), (0.5, 0.6)),
    ],
)
def test_the_frame_of_an_edge(
    edge: str, outward: tuple[int, int], along: tuple[int, int], middle: tuple[float, float], kind: bool
) -> None:
    """Outward, counter-clockwise seen from the top, towards the top: on every edge of a plate."""
    loads = replace(NONE, edge_forces=(EdgeForce(edge, (2.0, 3.0, 5.0), kind),))
    force, moment = resultant("plate", loads)
    length = 0.6 if edge.startswith("x") else 1.0
    expected = length * np.array([2 * outward[0] + 3 * along[0], 2 * outward[1] + 3 * along[1], 5])
    assert force == pytest.approx(list(expected), abs=1e-12)
    assert moment == pytest.approx(list(np.cross([*middle, 0.0], expected)), abs=1e-12)


def test_the_frame_of_a_round_edge() -> None:
    """Outward pulls cancel, those along the edge add to a moment, those towards the top to a force.

    On the meshed disc, of area A and rim L, exactly: the force is t L and the moment t int X . nu = 2 t A.
    """
    domain = body("disc")
    forces = NodalForces(domain, replace(NONE, edge_forces=(EdgeForce("rim", (2.0, 3.0, 5.0), False),)))
    length = Integrate(CF(1.0) * dx(definedon=domain.mesh.BBoundaries("rim")), domain.mesh)
    area = domain.shell_integral(1.0)
    assert (length, area) == (pytest.approx(2 * math.pi, rel=1e-3), pytest.approx(math.pi, rel=1e-3))
    assert forces.force(REST[3]) == pytest.approx([0, 0, 5 * length], abs=1e-12)
    assert forces.moment(REST[3])[2] == pytest.approx(6 * area, abs=1e-12)


@pytest.mark.parametrize("name", ["disc", "quarter disc", "axisymmetric disc"])
def test_an_outward_pull_works_on_growth(name: str) -> None:
    """Radial displacement X: the work is 2 int X . nu = 4 A, in every reduction."""
    domain = body(name)
    forces = NodalForces(domain, replace(NONE, edge_forces=(EdgeForce("rim", (2.0, 0.0, 0.0), False),)))
    place = domain.reduction.position
    growth = CF((place[0], 0)) if domain.mesh.dim == 2 else CF((x, y, 0 * z))
    assert forces.work(REST[domain.mesh.dim], growth) == pytest.approx(4 * domain.shell_integral(1.0))
