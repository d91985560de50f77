"""Unknowns by name: which exist, which are free, and which rigid motions nothing holds."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from ngsolve import BND, GridFunction, IntegrationRule, x, y, z

from embedding import (
    Disc,
    InfiniteCylinder,
    Model,
    NeoHookean,
    Plate,
    Scene,
    Shell,
    Sphere,
    Stage,
    Support,
    explain,
)
from embedding.coupling.unknowns import Unknowns, free_rigid_motions
from embedding.geometry.spaces import TraceSpace, plane_mask
from embedding.solving.problem import Problem
from tests.coupling.scenes import coupled
from tests.forms import BODIES, body

MATERIAL = NeoHookean(shear_modulus=1e5)
SHAPES: dict[str, Any] = {
    "plate": Plate(length=0.1, width=0.05),
    "disc": Disc(radius=0.02),
    "sphere": Sphere(radius=0.02),
    "tube": InfiniteCylinder(radius=0.02),
    "open tube": InfiniteCylinder(radius=0.02, axial="free"),
}


def unknowns(shape: str, *supports: tuple[str, str], reduction: Any = "auto", **parts: Any) -> Unknowns:
    scene = Scene(
        shell=Shell(shape=SHAPES[shape], thickness=1e-3, material=MATERIAL),
        supports=tuple(Support(where=where, fix=tuple(fix)) for where, fix in supports),
        model=Model(reduction=reduction, **parts.pop("model", {})),
        **parts,
    )
    return Problem(scene, explain(scene)).system.unknowns


@pytest.mark.parametrize(
    ("faces", "interface", "expected"),
    [
        ("conductor", "closed", {"u", "phi"}),
        ("conductor", "auto", {"u", "y_t", "tau_t", "phi"}),
        ("conductor", "opened", {"u", "y_t", "tau_t", "y_b", "tau_b", "phi"}),
        ("film", "auto", {"u", "y_t", "tau_t", "y_b", "tau_b", "phi", "jump"}),
        ("bare", "closed", {"u", "phi", "jump"}),
    ],
)
def test_names(faces: str, interface: str, expected: set[str]) -> None:
    made = coupled("3d", faces, interface, order=1).system.unknowns
    assert {name for name in made.names if not name.startswith("rigid")} == expected
    assert all(name in made for name in expected)
    assert "pressure" not in made


def test_numbers_come_with_the_control_that_needs_them() -> None:
    assert "pressure" in unknowns("sphere", path=(Stage(volume_ratio=2.0),))
    assert "axial" in unknowns("open tube")
    assert "axial" not in unknowns("tube")


def test_ranges_are_where_the_fields_are() -> None:
    made = coupled("axisymmetric", "film").system.unknowns
    for number, name in enumerate(made.names):
        made.field(name).vec.FV().NumPy()[:] = number + 1.0
    state = made.state.vec.FV().NumPy()
    for number, name in enumerate(made.names):
        assert np.all(state[made.range(name)] == number + 1.0)
    assert sum(made.range(name).stop - made.range(name).start for name in made.names) == len(state)


def test_held_components_are_not_free() -> None:
    made = unknowns("sphere", path=(Stage(volume_ratio=2.0),))
    free = np.array([bool(bit) for bit in made.free()])
    held = np.array([bool(bit) for bit in made.free(("pressure",))])
    assert free.sum() - held.sum() == 1
    assert free[made.range("pressure")].all() and not held[made.range("pressure")].any()
    assert sum(made.count.values()) == free.sum()


RIGID = [
    ("sphere", (), "axisymmetric", 1),
    ("sphere", (), "3d", 0),  # an octant: every motion breaks a mirror plane
    ("disc", (("surface", "z"),), "axisymmetric", 0),
    ("disc", (), "axisymmetric", 1),
    ("disc", (), "3d", 1),  # a quarter: it may move along z
    ("disc", (("rim", "xy"),), "3d", 1),
    ("disc", (("rim", "xyz"),), "3d", 0),
    ("plate", (), "3d", 6),
    ("plate", (("surface", "z"),), "3d", 3),
    ("plate", (("x0", "x"),), "3d", 4),  # along y and z, and about x; not about z: the edge would leave its line
    ("plate", (("x0", "xyz"),), "3d", 1),  # a hinge: it may turn about the edge
    ("tube", (), "plane-strain", 0),  # a quarter: its two ends must keep to the mirror planes
]


@pytest.mark.parametrize(("shape", "supports", "reduction", "expected"), RIGID)
def test_free_rigid_motions(shape: str, supports: tuple[tuple[str, str], ...], reduction: str, expected: int) -> None:
    assert len(unknowns(shape, *supports, reduction=reduction).rigid) == expected


@pytest.mark.parametrize(("shape", "expected"), [("sphere", 6), ("disc", 6), ("tube", 3)])
def test_a_whole_body_is_free_to_move(shape: str, expected: int) -> None:
    reduction = "plane-strain" if shape == "tube" else "3d"
    assert len(unknowns(shape, reduction=reduction, model={"symmetry": "none"}).rigid) == expected


@pytest.mark.parametrize("name", BODIES)
def test_what_counts_as_rigid_is_rigid_for_the_whole_body(name: str) -> None:
    """A free motion is a translation along the mirror planes, or a rotation about an axis in none of them."""
    domain = body(name)
    trace = TraceSpace(domain.mesh, 2)
    axes = (0,) if domain.reduction.name == "axisymmetric" else ["xyz".index(a) for a in domain.reduction.planes]
    for axis in axes:
        trace.fix(axis, plane_mask(trace.scalar, axis))
    for motion in free_rigid_motions(domain, trace):
        field = GridFunction(trace.space)
        field.Set(motion, BND, definedon=domain.shell)
        values = field.vec.FV().NumPy()
        assert np.abs(values).max() > 0.1
        assert np.abs(values[~trace.free]).max(initial=0.0) < 1e-9
        # A rotation about a point off the mirror planes would bend the mirrored body there: no rotation is left.
        coordinates = (x, y, z)[: domain.mesh.dim]
        point = domain.mesh.MapToAllElements(IntegrationRule([(0.2, 0.2)], [1.0]), domain.shell)[:1]
        for a, b in ((0, 1), (1, 2), (2, 0))[: 3 if domain.mesh.dim == 3 else 1]:
            if {"xyz"[a], "xyz"[b]} & set(domain.reduction.planes):
                assert abs(float(np.asarray(motion.Diff(coordinates[a])(point)).ravel()[b])) < 1e-9


def test_supports_hold_the_middle_and_leave_the_faces() -> None:
    made = coupled("axisymmetric", "film", supports=(Support(where="surface", fix=("x", "y", "z")),)).system.unknowns
    assert made.count["u"] == 0
    assert made.count["y_t"] > 0 and made.count["tau_b"] == made.count["y_b"] == made.count["y_t"]
