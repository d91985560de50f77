"""The extension's energy on many tets at once: against the symbolic form that defines it, and its own derivatives."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from ngsolve import BND, CF, H1, TET, Grad, GridFunction, Integrate, IntegrationRule

from embedding.ambient.motion import AmbientMotion
from embedding.ambient.stiffening import StiffeningForm
from embedding.ambient.tets import Tets, invariant
from embedding.geometry.spaces import TraceSpace
from tests.forms import Array, body


def displaced(name: str, order: int) -> AmbientMotion:
    """A motion of both sides, with faces and interior displaced at random, on curved elements."""
    domain = body(name, 0.5, order, radius=3.0)
    sides = [side for side in ("outside", "inside") if any(m.startswith(side) for m in domain.mesh.GetMaterials())]
    faces = {side: TraceSpace(domain.mesh, order, reach=domain.materials(side)).space for side in sides}
    motion = AmbientMotion(domain, faces)
    x, y, z = domain.reduction.position
    for number, face in enumerate(motion.y.values()):
        face.Set(CF((0.2 * x, 0.1 * y * x, 0.15 * z - 0.05 * y)) * (1 + 0.2 * number), BND, definedon=domain.shell)
    motion.w.vec.FV().NumPy()[:] = 0.005 * np.random.default_rng(3).standard_normal(len(motion.w.vec))
    return motion


def rows(form: Any, vector: Any) -> Array:
    out = vector.CreateVector()
    form.Apply(vector, out)
    return np.array(out.FV().NumPy())


@pytest.mark.parametrize(("name", "order"), [("octant", 1), ("octant", 3), ("octant", 5), ("disc", 2)])
def test_it_is_the_symbolic_form(name: str, order: int) -> None:
    motion = displaced(name, order)
    own, symbolic, at = motion._form, motion.symbolic_form(), motion.w.vec
    assert isinstance(own, StiffeningForm)
    assert own.Energy(at) == pytest.approx(symbolic.Energy(at), rel=1e-12)
    known = rows(symbolic, at)
    assert np.abs(rows(own, at) - known).max() < 1e-12 * np.abs(known).max()
    for form in (own, symbolic):
        form.AssembleLinearization(at)
    probe = at.CreateVector()
    probe.FV().NumPy()[:] = np.random.default_rng(4).standard_normal(len(at))
    images = []
    for form in (own, symbolic):
        image = at.CreateVector()
        image.data = form.mat * probe
        images.append(np.array(image.FV().NumPy()))
    assert np.abs(images[0] - images[1]).max() < 1e-12 * np.abs(images[1]).max()


def test_an_element_that_has_turned_over_has_no_energy() -> None:
    motion = displaced("octant", 2)
    motion.w.vec.FV().NumPy()[:] *= 1000
    assert math.isnan(motion._form.Energy(motion.w.vec))


@pytest.mark.parametrize("degree", [1, 2, 3, 4])
def test_functions_and_places_are_those_of_the_mesh(degree: int) -> None:
    """The energy of a gradient, from the sums over all tets and from NGSolve, with one rule."""
    domain = body("octant", 0.6, 3, radius=3.0)
    tets, rule = Tets(domain, ".*"), IntegrationRule(TET, 6)
    space = H1(domain.mesh, order=degree)
    field = GridFunction(space)
    field.vec.FV().NumPy()[:] = np.random.default_rng(5).standard_normal(space.ndof)
    points = np.array(rule.points)
    geometry = H1(domain.mesh, order=3)
    jacobian = np.tensordot(tets.shapes(geometry, 3, points)[1], tets.places(geometry, 3), axes=(2, 0))
    jacobian = jacobian.transpose(1, 3, 0, 2)  # (p, e, derivative, component)
    slopes = np.tensordot(tets.shapes(space, degree, points)[1], field.vec.FV().NumPy()[tets.dofs(space, degree)], 1)
    gradient = np.linalg.solve(jacobian, slopes.transpose(1, 2, 0)[..., None])[..., 0]
    density = np.abs(np.linalg.det(jacobian)) * (gradient**2).sum(axis=2)
    known = Integrate(Grad(field) * Grad(field) * domain.volume(".*", {TET: rule}), domain.mesh)
    assert float((np.array(rule.weights) @ density).sum()) == pytest.approx(known, rel=1e-12)


def test_rules_that_do_not_depend_on_the_order_of_vertices() -> None:
    assert [invariant(IntegrationRule(TET, 2 * order)) for order in range(1, 6)] == [True] * 4 + [False]
