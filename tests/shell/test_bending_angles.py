"""What rotations are measured from does not matter: averaged normals, counted angles, and the frame of the world."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from ngsolve import BND, CF, GridFunction

from embedding.solving.problem import Problem
from tests.bent import DISC, FOLLOWED, Bent, Table, clamped, mesh, metal, problem_of
from tests.forms import Array, random_directions, set_on_shell, smooth

PLATE: Table = {"kind": "plate", "length": 1.0, "width": 0.3}
SHAPES: tuple[Table, ...] = (
    PLATE,
    {"kind": "t-section", "length": 1.0},
    {"kind": "cylinder", "radius": 1.0, "length": 1.0},
)


IN_SPACE: Table = {"reduction": "3d"}
ROLLED: Table = {"loads": {"edge_moments": [{"edge": "x1", "moment": 2e-6}]}, "supports": clamped("x0")}
SHELLS: dict[str, tuple[Table, Table]] = {
    "pressed disc": (DISC, {"loads": {"surface_force": [0, 0, 2e-5]}, "supports": clamped("rim")}),
    "branches": (SHAPES[1], {"loads": {"surface_force": [0, 0, 1e-6]}, "supports": clamped("bottom")}),
    "rolled plate": (PLATE, ROLLED),
}
"""Shells that their loads turn far; the plate by 2.5 rad."""


def loaded(name: str) -> Problem:
    """A shell of SHELLS in equilibrium."""
    shape, parts = SHELLS[name]
    bent = Bent(shape, 0.02, metal(0.3), path=FOLLOWED, model=IN_SPACE, discretisation=mesh(2, 0.5), **parts)
    return bent.converged().problem


def field_of(problem: Problem, value: Any) -> Any:
    """Kinematics of another motion of the same shell."""
    unknowns = problem.system.unknowns
    u = GridFunction(unknowns.trace.space)
    set_on_shell(u, value, unknowns.trace.free, problem.domain)
    return problem.system.lagrangian.kinematics({"u": u})


def rows(problem: Problem, name: str) -> Array:
    """The free rows of ``name`` of the residual, rotations measured from what they are measured from now."""
    system = problem.system
    residual = system.unknowns.state.vec.CreateVector()
    system.form.Apply(system.unknowns.state.vec, residual)
    where = system.unknowns.range(name)
    return np.array(residual.FV().NumPy()[where])[np.asarray(system._solver.mask)[where]]


@pytest.mark.parametrize("name", SHELLS)
def test_averaged_normals_may_be_renewed_in_equilibrium(name: str) -> None:
    """Another common direction shifts the angles of both sides of an edge: their sum, and with it the displacement
    rows of the residual, stay. The rotations take up the shift in one linear solve that moves nothing else."""
    problem = loaded(name)
    system, unknowns = problem.system, problem.system.unknowns
    bending, state = unknowns.bending, unknowns.state.vec
    before = {part: np.array(unknowns.field(part).vec.FV().NumPy()) for part in unknowns.names}
    average = bending.memory
    moved = 1e-3 if name == "rolled plate" else 0.1
    forces = np.abs(before["moment"]).max()
    known = unknowns.field("u")
    bending.refresh(field_of(problem, known + smooth(problem.domain, moved)))
    assert np.abs(bending.memory - average).max() > 0.2 * moved
    residual = state.CreateVector()
    system.form.Apply(state, residual)
    assert np.abs(rows(problem, "moment")).max() > 1e-5
    if name != "rolled plate":  # the moment of its edge works on the rotation that is yet to be found
        assert np.abs(rows(problem, "u")).max() < 1e-9 * forces
    system.forget()
    system.linearise()
    state.data -= system.solve(residual)
    for part in ("u", "moment"):
        change = np.abs(unknowns.field(part).vec.FV().NumPy() - before[part]).max()
        assert change < 1e-8 * np.abs(before[part]).max(), part
    assert np.abs(unknowns.field("rotation").vec.FV().NumPy() - before["rotation"]).max() > 1e-5


@pytest.mark.parametrize("name", SHELLS)
def test_newton_contracts_at_once(name: str) -> None:
    """The matrix is the derivative of a residual that measures rotations anew in every state: close to equilibrium one
    update leaves next to nothing of a disturbance. Without the tangent of the moment, which has no potential, a
    quarter to all of it is left."""
    problem = loaded(name)
    system, state = problem.system, problem.system.unknowns.state.vec.FV().NumPy()
    assert system.symmetric == (name != "rolled plate")
    for _ in range(2):
        state += system.newton_update()[0].FV().NumPy()
    start, where = state.copy(), system.unknowns.range("u")
    sizes = []
    for direction in random_directions(np.asarray(system._solver.mask), 1e-8, seed=4):
        state[:] = start
        state[where] += direction[where]
        system.forget()
        state += system.newton_update()[0].FV().NumPy()
        sizes.append(np.abs((state - start)[where]).max() / np.abs(direction[where]).max())
    assert max(sizes) < 2e-2


@pytest.mark.parametrize(("shape", "reduction"), [({"kind": "strip", "length": 1.0}, "auto"), (DISC, "axisymmetric")])
def test_counted_angles_may_be_renewed_anywhere(shape: Table, reduction: str) -> None:
    """On curves the angle is the same from wherever it is counted: nothing changes, in equilibrium or not."""
    problem = problem_of(shape, 0.05, model={"reduction": reduction}, discretisation=mesh(2, 0.3))
    unknowns = problem.system.unknowns
    set_on_shell(unknowns.field("u"), smooth(problem.domain, 0.2), unknowns.trace.free, problem.domain)
    moments = unknowns.field("moment").vec.FV().NumPy()
    moments[:] = random_directions(np.ones(len(moments), bool), 1e-3, count=1)[0]
    before = [rows(problem, name) for name in ("u", "moment")]
    unknowns.bending.refresh(field_of(problem, smooth(problem.domain, -0.3)))
    assert np.abs(unknowns.bending.memory).max() > 0.1
    for was, name in zip(before, ("u", "moment"), strict=True):
        assert np.abs(rows(problem, name) - was).max() < 1e-12 * np.abs(was).max()


def rotation(angle: float) -> Array:
    """About z, then about x."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("locking", ["cured", "as it is"])
def test_a_rigid_motion_turns_the_forces_of_a_bent_shell_with_it(shape: Table, locking: str) -> None:
    """Inner forces turn; the rows of moments and rotations stay as they are. All of it to rounding."""
    model = {"symmetry": "none", "reduction": "3d"}
    problem = problem_of(shape, 0.1, discretisation=mesh(2, 0.6, locking=locking), model=model)
    system, unknowns = problem.system, problem.system.unknowns
    u = unknowns.field("u")
    still = GridFunction(u.space)
    still.Set(smooth(problem.domain, 0.2), BND, definedon=problem.domain.shell)
    u.vec.data = still.vec
    for name in ("moment", "rotation"):
        values = unknowns.field(name).vec.FV().NumPy()
        values[:] = random_directions(np.ones(len(values), bool), 1e-3, count=1)[0]
    before = np.array(system.residual().FV().NumPy())
    Q = rotation(2.0)
    X = problem.reduction.position
    turned = CF(tuple(Q.ravel()), dims=(3, 3)) * (X + still) + CF((0.3, -1.0, 2.0))
    u.Set(turned - X, BND, definedon=problem.domain.shell)
    after = np.array(system.residual().FV().NumPy())
    forces = [r[unknowns.range("u")].reshape(3, -1) for r in (before, after)]
    assert np.abs(forces[1] - Q @ forces[0]).max() < 1e-10 * np.abs(forces[0]).max()
    for name in ("moment", "rotation"):
        one, other = before[unknowns.range(name)], after[unknowns.range(name)]
        assert np.abs(one - other).max() < 1e-9 * np.abs(one).max()
