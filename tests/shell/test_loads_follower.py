"""Forces that follow an edge: linearisation, objectivity, work around a full turn, values on stretched discs."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from netgen.occ import WorkPlane
from ngsolve import CF, BilinearForm, GridFunction, Integrate, Parameter, dx, x, y

from embedding import Strip, SurfaceFile
from embedding.geometry.domain import Domain, MeshSizes, build
from embedding.geometry.reduction import Reduction
from embedding.shell.edges import EdgeForce, edge_residual
from embedding.shell.kinematics import Kinematics
from embedding.shell.loads import MechanicalLoads
from tests.forms import Taylor, body, close_to, random_directions, set_on_shell, smooth
from tests.shell.rigid import NodalForces, moved, rotation
from tests.shell.test_loads import displacement_space

NONE = MechanicalLoads(0.0, 0.0, (), (), True, "embedding-aware")
EDGES = {"plate": "x1", "disc": "rim", "quarter disc": "rim", "axisymmetric disc": "rim", "strip": "x1"}


def open_body(name: str, order: int = 2) -> Domain:
    if name != "strip":
        return body(name, order=order)
    return build(Strip(length=1.0), Reduction("plane-strain"), MeshSizes(0.3, 0.3, 0.0, 0.5, order))


def follower(name: str, *components: float) -> MechanicalLoads:
    a, b, c = components
    along = b if name in ("plate", "disc", "quarter disc") else 0.0
    return replace(NONE, edge_forces=(EdgeForce(EDGES[name], (a, along, c), True),))


@pytest.mark.parametrize("name", EDGES)
def test_linearisation(name: str) -> None:
    """The matrix is the derivative of the residual, whatever bends, shears and stretches the edge."""
    domain = open_body(name)
    space = displacement_space(domain)
    trial, test = space.space.TnT()
    form = BilinearForm(space.space)
    kinematics = Kinematics(domain.reduction, domain.normal, trial)
    loads = follower(name, 1.0, -0.7, 0.4)
    for term in edge_residual(domain, loads.edge_forces, kinematics, test, Parameter(0.7)):
        form += term
    state = GridFunction(space.space)
    set_on_shell(state, smooth(domain), space.free, domain)
    taylor = Taylor(form, state.vec, random_directions(space.free, 0.01))
    assert np.linalg.norm(taylor.gradient) > 1e-3
    assert close_to(taylor.tangent_orders(), 2)


@pytest.mark.parametrize("name", ["plate", "disc"])
def test_turning_the_shell_turns_the_forces(name: str) -> None:
    domain = open_body(name, order=3)
    forces = NodalForces(domain, follower(name, 2.0, 3.0, -1.5))
    bent, matrix = smooth(domain), rotation((1, 2, 3), 1.1)
    before = forces.at(bent).reshape(3, -1)
    after = forces.at(moved(domain, matrix, bent)).reshape(3, -1)
    assert np.abs(after - matrix @ before).max() < 1e-12 * np.abs(before).max()


@pytest.mark.parametrize(("components", "work"), [((0, 0, 5.0), 2 * math.pi * 5.0), ((4.0, 0, 0), 0.0)])
def test_work_around_a_full_turn(components: tuple[float, float, float], work: float) -> None:
    """A strip turned rigidly about its end: a force across it works on the way 2 pi L, one along it never.

    The first work is not zero on a closed path: such a load has no potential.
    """
    domain = open_body("strip")
    forces = NodalForces(domain, follower("strip", *components))
    angles = np.linspace(0, 2 * math.pi, 17)[:-1]
    done = 0.0
    for angle in angles:
        c, s = math.cos(angle), math.sin(angle)
        virtual = CF((-s * x - c * y, c * x - s * y))  # d/d angle of the turned place
        done += forces.work(moved(domain, np.array([[c, -s], [s, c]])), virtual) * 2 * math.pi / 16
    assert done == pytest.approx(work, abs=1e-11)


def test_a_disc_blown_up() -> None:
    """Scaled by 1.7: each metre of the reference rim still carries its force, along the turned frame."""
    domain = open_body("disc")
    forces = NodalForces(domain, follower("disc", 2.0, 3.0, 5.0))
    length = Integrate(CF(1.0) * dx(definedon=domain.mesh.BBoundaries("rim")), domain.mesh)
    growth = CF((0.7 * x, 0.7 * y, 0))
    assert forces.force(growth) == pytest.approx([0, 0, 5 * length], abs=1e-12)
    assert forces.moment(growth)[2] == pytest.approx(1.7 * 6 * domain.shell_integral(1.0), abs=1e-12)


def test_a_cone_pulled_along_its_meridians() -> None:
    """A disc drawn to the cone z = r: outward is (1, 1) / sqrt 2 and the normal (-1, 1) / sqrt 2 in the meridian."""
    domain = open_body("axisymmetric disc", order=3)
    forces = NodalForces(domain, follower("axisymmetric disc", 2.0, 0.0, 5.0))
    cone = CF((0, x))
    assert forces.work(cone, CF((x, 0))) == pytest.approx(2 * math.pi * (2 - 5) / math.sqrt(2), rel=1e-12)
    assert forces.work(cone, CF((0, 1))) == pytest.approx(2 * math.pi * (2 + 5) / math.sqrt(2), rel=1e-12)


@pytest.mark.parametrize("flip", [False, True])
def test_a_flipped_shell(flip: bool, tmp_path: Path) -> None:
    """Top and bottom exchanged: the normal and the sense along the edge turn round, outward stays outward."""
    face = WorkPlane().Rectangle(10, 6).Face()
    for edge in face.edges:
        edge.name = "x1" if edge.center.x > 9.9 else "other"
    face.WriteStep(str(tmp_path / "plate.step"))
    shape = SurfaceFile(path=str(tmp_path / "plate.step"), flip=flip)
    domain = build(shape, Reduction("3d"), MeshSizes(0.5, 0.5, 0.0, 0.3, 2))
    up = domain.shell_integral(domain.normal[2]) / 0.6
    sign = round(up)
    assert up == pytest.approx(sign) and abs(sign) == 1
    forces = NodalForces(domain, replace(NONE, edge_forces=(EdgeForce("x1", (2.0, 3.0, 5.0), True),)))
    stretched = CF((0.3 * x, -0.2 * y, 0))
    # The kernel's box around the file, its size, is 1e-7 too large.
    assert forces.force(stretched) == pytest.approx(list(0.6 * np.array([2, 3 * sign, 5 * sign])), abs=1e-6)
