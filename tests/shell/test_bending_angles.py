"""What rotations are measured from does not matter: averaged normals, counted angles, and the frame of the world."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from ngsolve import BND, CF, GridFunction

from embedding.solving.problem import Problem
from tests.bent import DISC, Table, mesh, problem_of
from tests.forms import Array, random_directions, set_on_shell, smooth

PLATE: Table = {"kind": "plate", "length": 1.0, "width": 0.3}
SHAPES: tuple[Table, ...] = (
    PLATE,
    {"kind": "t-section", "length": 1.0},
    {"kind": "cylinder", "radius": 1.0, "length": 1.0},
)


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
