"""The response that arcs start along, against differences of solved states: with the square of the field's factor as
the parameter, out of no field included, and with the factor itself where the shell has a remanence."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from ngsolve import CF

from embedding.ambient.transmission import Matter
from embedding.coupling.system import System
from embedding.solving.continuation import Corrector, at_parameter
from embedding.solving.newton import Clock
from embedding.solving.path import Target
from embedding.solving.shell_path import ShellPath
from embedding.solving.stability import countable
from tests.coupling.scenes import coupled

Array = Any
NONE, FULL = Target(0.6, 0.0, None), Target(0.6, 1.0, None)
MATTERS = {
    "linear": Matter(8.0),
    "saturating": Matter(8.0, saturation=1.0),
    "remanent": Matter(1.0, remanence=CF((0.0, 0.2))),
}


def path_of(faces: str, matter: str, start: Target, end: Target) -> ShellPath:
    problem = coupled("axisymmetric", faces, "closed", size=0.5)
    physics = problem.system.physics
    assert physics.field is not None
    problem.system = System(problem.domain, replace(physics, field=replace(physics.field, matter=MATTERS[matter])))
    return ShellPath(problem, start, end, Clock())


def solved(path: ShellPath, parameter: float) -> Array:
    """The mid-surface's displacement at a parameter."""
    corrector = Corrector(path, 1e-11, 20)
    correction = corrector.correct(path.values(), parameter, at_parameter(parameter), lambda *_: None, thorough=True)
    assert correction.reason is None
    return path.values()[path.problem.system.unknowns.range("u")]


@pytest.mark.parametrize("parameter", [0.0, 0.3])
@pytest.mark.parametrize(
    ("faces", "matter", "turned"),
    [
        ("conductor", "linear", False),
        ("bare", "linear", False),
        ("bare", "saturating", False),
        ("bare", "remanent", False),
        ("conductor", "linear", True),
    ],
)
def test_response(faces: str, matter: str, turned: bool, parameter: float) -> None:
    start = replace(FULL, field=-0.4) if turned else NONE
    path = path_of(faces, matter, start, replace(FULL, field=0.8))
    assert countable(path.problem.system)
    step = 2e-3
    values = [solved(path, parameter + number * step) for number in (0, 1, 2)]
    solved(path, parameter)
    response = path.linearise().response[path.problem.system.unknowns.range("u")]
    # One-sided, of second order: there is nothing before the field is there.
    expected = (-3 * values[0] + 4 * values[1] - values[2]) / (2 * step)
    assert np.linalg.norm(expected) > 1e-3
    assert response == pytest.approx(expected, abs=5e-4 * np.abs(expected).max())


def test_a_state_without_a_real_field_is_none() -> None:
    path = path_of("conductor", "linear", NONE, FULL)
    solved(path, 0.1)
    before = path.values()
    assert not path.move(before, -0.1) and path.faded
    assert path.parameter == 0.1 and np.array_equal(path.values(), before)
    assert path.move(before, 0.05) and not path.faded


def test_no_field_but_for_rounding_is_no_field() -> None:
    """An update of the parameter that rounding made may lead below 0, where there is no field any more."""
    path = path_of("conductor", "linear", NONE, FULL)
    values = path.values()
    assert path.move(values, -1e-20) and not path.faded
    assert path.target(path.parameter).field == 0.0
    assert not path.move(values, -1e-3) and path.faded
