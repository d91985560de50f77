"""The joint form put together from parts, against the one symbolic form that defines it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from embedding.coupling.joint import JointForm
from embedding.coupling.system import System
from embedding.coupling.touching import possible
from tests.coupling.scenes import coupled, distort
from tests.forms import Array, random_directions

CASES = {
    "3d conductor": (("3d", "conductor"), {"order": 3}),
    "3d closed": (("3d", "conductor", "closed"), {}),
    "3d film": (("3d", "film"), {}),
    "3d bare": (("3d", "bare"), {}),
    "3d varying pressure": (("3d", "conductor"), {"varying": True}),
    "axisymmetric bare": (("axisymmetric", "bare"), {}),
    "plane-strain top": (("plane-strain", "top"), {}),
}


def distorted(name: str) -> System:
    arguments, options = CASES[name]
    problem = coupled(*arguments, **options)
    distort(problem)
    return problem.system


def image(form: Any, system: System, at: Array, direction: Array) -> tuple[Array, Array]:
    """Residual ``at`` a state, and the matrix there times a ``direction``."""
    place, probe, out = (system.unknowns.state.vec.CreateVector() for _ in range(3))
    place.FV().NumPy()[:], probe.FV().NumPy()[:] = at, direction
    form.Apply(place, out)
    residual = np.array(out.FV().NumPy())
    form.AssembleLinearization(place)
    out.data = form.mat * probe
    return residual, np.array(out.FV().NumPy())


SLOW = ("3d closed", "3d bare", "3d varying pressure", "plane-strain top")


@pytest.mark.parametrize("name", [pytest.param(n, marks=[pytest.mark.slow] * (n in SLOW)) for n in CASES])
def test_residual_and_matrix_are_those_of_the_symbolic_form(name: str) -> None:
    """At the state and, as the form is a function of its argument alone, away from it and back."""
    system = distorted(name)
    assert isinstance(system.form, JointForm)
    assert possible(system.lagrangian) == name.startswith("3d")
    free, start = np.asarray(system._solver.mask), np.array(system.unknowns.state.vec.FV().NumPy())
    direction, move = random_directions(free, 1.0, seed=2)[0], random_directions(free, 1e-3, seed=3)[0]
    whole = system.lagrangian.joint_form()
    for at in (start, start + move, start):
        pairs = zip(image(system.form, system, at, direction), image(whole, system, at, direction), strict=True)
        for own, known in pairs:
            assert np.abs(own - known)[free].max() < 1e-11 * np.abs(known[free]).max()
    assert np.array_equal(system.unknowns.state.vec.FV().NumPy(), start)


def test_the_matrix_of_the_potential_is_assembled_again_where_something_has_moved() -> None:
    system = distorted("3d film")
    form = system.potential._form if system.potential is not None else None
    assert form is not None
    form.assemble()
    known, entries = form.version, np.array(form.mat.AsVector().FV().NumPy())
    system.unknowns.field("phi").vec.FV().NumPy()[:] += 1.0
    form.assemble()
    assert form.version == known
    system.unknowns.field("u").vec.FV().NumPy()[:] *= 1.01
    form.assemble()
    assert form.version == known + 1
    form.forget()
    form.assemble()
    assert form.version == known + 2
    again = form.mat.AsVector().FV().NumPy()
    assert not np.array_equal(again, entries)
    system.unknowns.field("u").vec.FV().NumPy()[:] /= 1.01
    form.assemble()
    assert np.abs(again - entries).max() < 1e-12 * np.abs(entries).max()
