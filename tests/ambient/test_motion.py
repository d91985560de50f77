"""The ambient's mesh follows the face: its elements never turn over, what it leaves alone, what it gives back."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from ngsolve import BND, CF, GridFunction

from embedding.ambient.motion import GUARD, AmbientMotion
from embedding.geometry.domain import Domain
from embedding.geometry.spaces import Mask, TraceSpace, plane_mask, scalar_mask
from tests.forms import Array, body, set_on_shell

BODIES = ("octant", "axisymmetric sphere", "quarter ring", "ring")


def moving(name: str, side: str = "outside", size: float = 0.4) -> tuple[Domain, AmbientMotion, Any, Mask]:
    """A domain, the motion of one side, a face displacement to set, and its free unknowns."""
    domain = body(name, size, 2, radius=4.0)
    trace = TraceSpace(domain.mesh, 2, reach=domain.materials(side))
    return domain, AmbientMotion(domain, {side: trace.space}), GridFunction(trace.space), np.ones(len(trace.free), bool)


def grown(domain: Domain, factor: float) -> Any:
    return (factor - 1) * domain.reduction.position


def moved_to(face: Any, motion: AmbientMotion) -> dict[str, Array]:
    """The displacement of the one side that ``motion`` has."""
    return {side: np.array(face.vec.FV().NumPy()) for side in motion.y}


def state_of(motion: AmbientMotion) -> Array:
    return np.concatenate([np.array(vector) for vector in motion.vectors()])


@pytest.mark.parametrize("side", ["outside", "inside"])
@pytest.mark.parametrize("name", BODIES)
def test_elements_keep_their_sense(name: str, side: str) -> None:
    domain, motion, face, free = moving(name, side)
    assert motion.min_jacobian == pytest.approx(1.0)
    for factor in (1.1, 1.3, 1.6, 0.8):
        set_on_shell(face, grown(domain, factor), free, domain)
        assert motion.follow(moved_to(face, motion))
        assert motion.min_jacobian > GUARD
        assert np.abs(motion.y[side].vec.FV().NumPy() - face.vec.FV().NumPy()).max() < 1e-14


@pytest.mark.parametrize("name", BODIES)
def test_an_impossible_motion_is_refused_and_nothing_moves(name: str) -> None:
    """The face is asked to go beyond the outer boundary."""
    domain, motion, face, free = moving(name)
    set_on_shell(face, grown(domain, 1.2), free, domain)
    assert motion.follow(moved_to(face, motion))
    before = state_of(motion)
    set_on_shell(face, grown(domain, 4.5), free, domain)
    assert not motion.follow(moved_to(face, motion))
    assert np.array_equal(state_of(motion), before)


@pytest.mark.parametrize("name", BODIES)
def test_a_matrix_of_a_wild_shape_is_not_held_on_to(name: str) -> None:
    """As a step leaves it that was given up: the face is near, the interior was turned over."""
    domain, motion, face, free = moving(name)
    wild = np.random.default_rng(1).uniform(-1.0, 1.0, motion.w.space.ndof) * np.array(motion.free)
    motion.recall(np.concatenate([np.zeros_like(motion.y["outside"].vec.FV().NumPy()), wild]))
    assert motion.min_jacobian == pytest.approx(1.0)
    set_on_shell(face, grown(domain, 1.1), free, domain)
    assert motion.follow(moved_to(face, motion))
    assert motion.min_jacobian > 0.5


def test_a_face_that_hardly_moves_leaves_the_interior_at_rest() -> None:
    """Newton's method is quadratic only where w stands still: below a thousandth of the mesh size it does."""
    domain, motion, face, free = moving("octant")
    set_on_shell(face, grown(domain, 1.2), free, domain)
    assert motion.follow(moved_to(face, motion))
    interior = motion.w.vec.FV().NumPy().copy()
    set_on_shell(face, grown(domain, 1.2 + 1e-4), free, domain)
    assert motion.follow(moved_to(face, motion))
    assert np.array_equal(motion.w.vec.FV().NumPy(), interior)
    assert np.array_equal(motion.y["outside"].vec.FV().NumPy(), face.vec.FV().NumPy())
    set_on_shell(face, grown(domain, 1.25), free, domain)
    assert motion.follow(moved_to(face, motion))
    assert not np.array_equal(motion.w.vec.FV().NumPy(), interior)


@pytest.mark.parametrize("name", BODIES)
def test_boundaries_and_planes_are_kept(name: str) -> None:
    """w is zero on the shell and the outer boundary, and slides along mirror planes and the axis."""
    domain, motion, face, free = moving(name)
    set_on_shell(face, grown(domain, 1.4), free, domain)
    assert motion.follow(moved_to(face, motion))
    w, dim = motion.w, domain.mesh.dim
    scalar = w.space.components[0]
    values = w.vec.FV().NumPy().reshape(dim, -1)
    held = scalar_mask(scalar, domain.shell) | scalar_mask(scalar, domain.mesh.Boundaries("outer"))
    assert np.abs(values).max() > 0.05
    assert np.all(values[:, held] == 0.0)
    axes = [0] if domain.reduction.name == "axisymmetric" else ["xyz".index(a) for a in domain.reduction.planes]
    for axis in axes:
        assert np.all(values[axis, plane_mask(scalar, axis)] == 0.0)


def test_a_rigid_shift_of_the_ring_keeps_it_round() -> None:
    """A face displaced far by a rigid shift: the elements around it deform, none turns over."""
    domain, motion, face, free = moving("ring")
    for shift in (0.2, 0.5, 0.9):
        face.Set(CF((shift, 0.3 * shift)), BND, definedon=domain.shell)
        assert motion.follow(moved_to(face, motion))
    assert motion.min_jacobian > GUARD


def test_a_state_can_be_put_back() -> None:
    domain, motion, face, free = moving("octant")
    set_on_shell(face, grown(domain, 1.2), free, domain)
    assert motion.follow(moved_to(face, motion))
    saved, smallest = [vector.copy() for vector in motion.vectors()], motion.min_jacobian
    set_on_shell(face, grown(domain, 1.4), free, domain)
    assert motion.follow(moved_to(face, motion))
    for vector, values in zip(motion.vectors(), saved, strict=True):
        vector[:] = values
    assert motion.min_jacobian == smallest


@pytest.mark.parametrize("name", ["octant", "axisymmetric sphere"])
def test_a_balloon_may_grow_to_twice_its_size(name: str) -> None:
    """In steps of a tenth, inside an ambient of four times the shell; the elements at the shell grow with it."""
    domain, motion, face, free = moving(name)
    for factor in np.linspace(1.1, 2.0, 10):
        set_on_shell(face, grown(domain, float(factor)), free, domain)
        assert motion.follow(moved_to(face, motion))
    assert motion.min_jacobian > 0.2
