"""A closed shell under the same pressure inside and outside: nothing moves, and the shell is as stiff as before.

The pressure is ten times the shear modulus, a thousand times what the wall could hold as a difference. The stiffness is
measured twice: as the Newton matrix, applied to a random motion at a stretched and distorted state, and as the shell's
answer to a small further pressure inside.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
from ngsolve import BND

from embedding import Scene, explain
from embedding.geometry.spaces import as_mask
from embedding.solving.problem import Problem
from problems import cylinder_inflation, sphere_inflation
from problems.common import Array, Positions
from tests.problems.measures import as_field

TEN_MODULI = 1e6  # Pa
LOADING = "path=[{steps = 4}]"
SPHERES = {
    "axisymmetric": ("model.reduction=axisymmetric", LOADING),
    "octant": ("model.reduction=3d", "discretisation.order=3", LOADING),
    "whole": ("model.reduction=3d", "model.symmetry=none", "discretisation.order=2", LOADING),
}
State = Callable[[str, float], str]


def as_number(name: str, pressure: float) -> str:
    return f"loads.{name}={pressure!r}"


def squeezed(state: State, pressure: float, further: float = 0.0) -> tuple[str, ...]:
    """Overrides: ``pressure`` on both faces, stated as ``state`` does, and ``further`` pressure inside."""
    return state("pressure_top", pressure), state("pressure_bottom", pressure + further)


def newton_matrix_on_a_probe(scene: Scene) -> Array:
    """The assembled tangent at full load and at a given distorted state, times a random motion."""
    problem = Problem(scene, explain(scene))
    system = problem.system
    system.load(1.0, 0.0, None)
    place = problem.reduction.position
    free = as_mask(system.unknowns.free())
    vector = system.unknowns.state.vec
    system.unknowns.field("u").Set(0.1 * place + 0.05 * place[1] ** 2 * place, BND, definedon=problem.domain.shell)
    vector.FV().NumPy()[~free] = 0.0
    system.form.AssembleLinearization(vector)
    probe, answer = vector.CreateVector(), vector.CreateVector()
    probe.FV().NumPy()[:] = free * np.random.default_rng(7).standard_normal(len(free))
    answer.data = system.form.mat * probe
    return np.asarray(free * answer.FV().NumPy())


def motion(run: Callable[..., Any], *changes: str) -> Array:
    """Displacements of the shell's points at the end of the path, in units of R."""
    positions = Positions()
    solution = run(*changes, listeners=[positions])
    moved: Array = (positions.deformed - positions.reference) / solution.scene.shell.shape.size
    return moved


def largest(values: Sequence[float] | Array) -> float:
    return float(np.abs(values).max())


@pytest.mark.parametrize("state", [as_number, as_field])
@pytest.mark.parametrize("body", SPHERES)
def test_a_sphere_stays_where_it_is(body: str, state: State) -> None:
    assert largest(motion(sphere_inflation.run, *SPHERES[body], *squeezed(state, TEN_MODULI))) < 1e-10


@pytest.mark.parametrize("state", [as_number, as_field])
@pytest.mark.parametrize("body", SPHERES)
def test_a_sphere_keeps_its_stiffness(body: str, state: State) -> None:
    free = newton_matrix_on_a_probe(sphere_inflation.scene(*SPHERES[body]))
    pressed = newton_matrix_on_a_probe(sphere_inflation.scene(*SPHERES[body], *squeezed(state, TEN_MODULI)))
    assert np.linalg.norm(pressed - free) < 1e-12 * np.linalg.norm(free)


@pytest.mark.parametrize("state", [as_number, as_field])
def test_a_tube_keeps_its_stiffness(state: State) -> None:
    """In plane strain a tube without tension has none against ovalling, and rests by definition: only this is asked."""
    free = newton_matrix_on_a_probe(cylinder_inflation.scene(*squeezed(as_number, 0.0)))
    pressed = newton_matrix_on_a_probe(cylinder_inflation.scene(*squeezed(state, TEN_MODULI)))
    assert np.linalg.norm(pressed - free) < 1e-12 * np.linalg.norm(free)


@pytest.mark.parametrize("state", [as_number, as_field])
@pytest.mark.parametrize(
    ("run", "changes", "further"),
    [
        (sphere_inflation.run, SPHERES["axisymmetric"], 1e3),
        (sphere_inflation.run, SPHERES["octant"], 1e3),
        (cylinder_inflation.run, (), 4e3),
    ],
)
def test_it_answers_a_further_pressure_alike(
    run: Callable[..., Any], changes: tuple[str, ...], further: float, state: State
) -> None:
    """Inflated by ``further`` Pa: the same displacements with and without ten shear moduli on both faces."""
    free = motion(run, *changes, *squeezed(state, 0.0, further))
    pressed = motion(run, *changes, *squeezed(state, TEN_MODULI, further))
    assert largest(free) > 0.1
    assert largest(pressed - free) < 1e-10


@pytest.mark.parametrize("run", [sphere_inflation, cylinder_inflation])
def test_the_published_load_changes_the_stiffness(run: Any) -> None:
    """What the measure finds where the mean pressure does act: several times the stiffness itself."""
    published = ("loads.variant=as-published", LOADING)
    free = newton_matrix_on_a_probe(run.scene(LOADING, *squeezed(as_number, 0.0)))
    pressed = newton_matrix_on_a_probe(run.scene(*published, *squeezed(as_number, TEN_MODULI)))
    assert np.linalg.norm(pressed - free) > np.linalg.norm(free)
