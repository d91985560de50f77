"""The tangent around open shells: the part of it that is in no matrix, Newton's order with it, and stability.

A strip in plane strain, magnetised along itself and clamped at one end: what the field does on the interior that
follows its rims is a quarter of its stiffness across a field, and all of it against one, where the strip buckles.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from embedding import Listener, Solution, solve
from embedding.coupling.system import System
from embedding.geometry.spaces import as_mask
from embedding.scene import Scene
from embedding.solving.events import StepRecord
from embedding.solving.stability import negative_eigenvalues, unstable_modes
from embedding.solving.state import State
from problems import hard_magnetic_cantilever

STRIP = (
    "model.coupling=joint",
    "shell.shape={kind='strip', length='17.2 mm'}",
    "shell.material.shear_modulus=227 kPa",
    "shell.remanence=['143 mT', '0 T', '0 T']",
)
ACROSS = "ambient.applied_field=['0 A/m', '1.5 kA/m', '0 A/m']"


class Kept(Listener):
    """The system, in the last accepted state."""

    system: System

    def accepted(self, state: State, record: StepRecord) -> None:
        self.system = state.problem.system


@cache
def strip(*changes: str) -> tuple[Solution, System]:
    scene: Scene = hard_magnetic_cantilever.scene(*STRIP, *changes)
    kept = Kept()
    return solve(scene, listeners=[kept], throw=False), kept.system


def numbers(vector: Any) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.array(vector.FV().NumPy())


def test_the_whole_tangent() -> None:
    """K + N against difference quotients of the residual: second order in the step; K alone leaves N out."""
    _, system = strip(ACROSS, "path=[{steps = 1}]", "discretisation.order=2")
    following, state = system.following, system.unknowns.state.vec.FV().NumPy()
    assert following is not None
    mask = as_mask(system.unknowns.free())
    system.linearise()
    rows = system.unknowns.state.vec.CreateVector()
    rows.FV().NumPy()[:] = mask * np.random.default_rng(1).standard_normal(len(mask))
    direction, here = numbers(system.solve(rows)), state.copy()
    direction *= 1e-2 / np.abs(direction[system.unknowns.range("u")]).max()
    along = rows.CreateVector()
    along.FV().NumPy()[:] = direction
    rows.data = system.form.mat * along
    matrix = mask * numbers(rows)
    rest = mask * following.derivative(direction)
    errors = []
    for step in (0.1, 0.05):
        sides = []
        for sign in (1.0, -1.0):
            state[:] = here + sign * step * direction
            sides.append(mask * numbers(system.residual()))
        state[:] = here
        quotient = (sides[0] - sides[1]) / (2 * step)
        errors.append(np.linalg.norm(quotient - matrix - rest))
    assert errors[1] < 0.3 * errors[0]
    assert errors[1] < 1e-2 * np.linalg.norm(rest)


def test_updates_are_those_of_the_whole_tangent() -> None:
    _, system = strip(ACROSS, "path=[{steps = 1}]", "discretisation.order=2")
    following = system.following
    assert following is not None
    mask = as_mask(system.unknowns.free())
    system.linearise()
    rows, image = (system.unknowns.state.vec.CreateVector() for _ in range(2))
    rows.FV().NumPy()[:] = mask * np.random.default_rng(2).standard_normal(len(mask))
    update = system.solve(rows)
    image.data = system.form.mat * update
    left = mask * (numbers(image) + following.derivative(numbers(update)) - numbers(rows))
    image.FV().NumPy()[:] = left
    assert system.displacement_norm(system.solve(image)) < 2e-4 * system.displacement_norm(update)


def test_newton_is_quadratic() -> None:
    """Without N every update would be a quarter of the one before, twelve and more to a step."""
    solution, _ = strip(ACROSS, "path=[{steps = 5}]", "solver.tolerance=1e-9")
    assert solution.result.ok
    last = [step.iterations for step in solution.steps]
    assert max(len(iterations) for iterations in last) <= 6
    for iterations in last:
        sizes = [iteration.update for iteration in iterations][-3:]
        first, second = (np.log(b / a) for a, b in zip(sizes, sizes[1:], strict=False))
        assert second < 1.5 * first or sizes[-1] < 1e-11


@pytest.mark.parametrize(
    ("field", "path", "unstable", "of_matrix"),
    [
        ("'-2.4 kA/m', '0 A/m'", "steps = 2", 0, 0),
        ("'-4.5 kA/m', '0 A/m'", "control = 'load', steps = 2", 1, 1),
        ("'-2.55 kA/m', '21 A/m'", "steps = 2", 0, 1),
    ],
)
def test_stability_is_that_of_the_whole_tangent(field: str, path: str, unstable: int, of_matrix: int) -> None:
    """Its eigenvalues are counted one by one: below and beyond the field against which the strip buckles, and just
    below it, where the matrix alone would have it unstable."""
    against = f"ambient.applied_field=[{field}, '0 A/m']"
    solution, system = strip(against, f"path=[{{{path}}}]", "discretisation.order=2")
    assert solution.result.ok and system.following is not None
    system.linearise()
    matrix, border = system.tangent()
    where = np.flatnonzero(as_mask(system.unknowns.free()))
    unit, columns = np.zeros(system.unknowns.space.ndof), []
    for number in where:
        unit[number] = 1.0
        columns.append(system.following.derivative(unit)[where])
        unit[number] = 0.0
    whole = matrix.toarray() + np.array(columns).T
    assert int((np.linalg.eigvals(whole).real < 0).sum()) - system.saddle_count == unstable
    assert unstable_modes(system) == unstable
    assert negative_eigenvalues(matrix, border, less=system.saddle_count) == of_matrix
