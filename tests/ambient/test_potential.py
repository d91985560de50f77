"""The potential around a shell at rest and in motion: patch tests, multipoles, a known jump, and what is prescribed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from ngsolve import CF, ET, IntegrationRule

from embedding import (
    Ambient,
    Discretisation,
    Electrode,
    Faces,
    InfiniteCylinder,
    Model,
    NeoHookean,
    Scene,
    Shell,
    Sphere,
    explain,
)
from embedding.scene.scales import EPSILON_0
from embedding.solving.problem import Problem
from embedding.solving.state import State
from tests.forms import Array

R, T = 0.02, 0.002
FIELD = 1e4  # V/m
WAYS = {
    "axisymmetric": (Sphere(radius=R), Model(reduction="axisymmetric"), (0.0, 0.0, FIELD)),
    "octant": (Sphere(radius=R), Model(reduction="3d"), (0.0, FIELD, 0.0)),
    "oblique": (Sphere(radius=R), Model(reduction="3d"), (0.0, 0.6 * FIELD, 0.8 * FIELD)),
    "quarter ring": (InfiniteCylinder(radius=R), Model(), (FIELD, 0.0, 0.0)),
    "ring": (InfiniteCylinder(radius=R), Model(symmetry="none"), (0.6 * FIELD, 0.8 * FIELD, 0.0)),
    "stretched ring": (InfiniteCylinder(radius=R, axial_stretch=1.3), Model(), (0.0, FIELD, 0.0)),
}


def problem(
    way: str,
    *,
    permittivity: float | None = 1.0,
    top: float | None = None,
    bottom: float | None = None,
    applied: bool = True,
    outer: Any = "free-space",
    interface: Any = "auto",
    order: int = 3,
) -> Problem:
    """A shell at rest with the field at full strength, potential solved."""
    shape, model, field = WAYS[way]
    voltages = {"top": top, "bottom": bottom}
    faces = {name: Electrode(voltage=v) for name, v in voltages.items() if v is not None}
    scene = Scene(
        shell=Shell(
            shape=shape, thickness=T, material=NeoHookean(shear_modulus=1e5), relative_permittivity=permittivity
        ),
        ambient=Ambient(field="electric", outer=outer, applied_field=field if applied else (0.0, 0.0, 0.0)),
        faces=Faces(**faces),
        model=model.model_copy(update={"interface": interface}),
        discretisation=Discretisation(order=order, shell_size=0.4 * R),
    )
    out = Problem(scene, explain(scene))
    out.system.load(0.0, 1.0, None)
    assert out.system.follow()
    assert out.system.potential is not None
    out.system.potential.solve()
    return out


def field_inside_and_outside(made: Problem) -> dict[str, tuple[Array, Array]]:
    """Points (SI, from the centre) with field vectors (SI) in the middle of the elements of each side."""
    rule = IntegrationRule(ET.TET if made.mesh.dim == 3 else ET.TRIG, 1)
    strengths = {f.block: f.values for f in State(made).fields() if f.name == "E"}
    places = {f.block: f.values for f in State(made).fields() if f.name == "u" and f.block != "shell"}
    out = {}
    for side in ("inside", "outside"):
        points = made.mesh.MapToAllElements(rule, made.blocks[side].region)
        place = made.embed(np.asarray(made.reduction.position(points))) + made.embed_vector(
            np.asarray(CF(places[side])(points))
        )
        out[side] = (place, made.embed_vector(np.asarray(CF(strengths[side])(points))))
    return out


@pytest.mark.parametrize("outer", ["free-space", "grounded"])
@pytest.mark.parametrize("way", WAYS)
def test_a_shell_like_empty_space_is_not_seen(way: str, outer: str) -> None:
    """Patch test: eps_r = 1 leaves the applied field as it is on both sides, but for (T/R)^2 of the shell theory."""
    made = problem(way, outer=outer)
    for _, field in field_inside_and_outside(made).values():
        assert np.abs(field - np.array(WAYS[way][2])).max() < 2e-3 * FIELD


@pytest.mark.parametrize("interface", ["opened", "closed"])
@pytest.mark.parametrize("way", ["axisymmetric", "octant"])
def test_a_known_jump(way: str, interface: str) -> None:
    """Electrodes at 100 V and 300 V: V_b inside, V_t b / r outside, charge 4 pi eps0 b V_t; b the place of the face."""
    made = problem(way, permittivity=3.0, top=100.0, bottom=300.0, applied=False, interface=interface)
    b = R + T / 2 if interface == "opened" else R
    sides = field_inside_and_outside(made)
    assert np.abs(sides["inside"][1]).max() < 1e-6 * 100 / b
    place, field = sides["outside"]
    distance = np.linalg.norm(place, axis=1)[:, None]
    near = distance.ravel() < 2 * R
    exact = 100.0 * b * place / distance**3
    assert np.abs(field - exact)[near].max() < 0.03 * 100 / b
    assert State(made).scalars()["charge"] == pytest.approx(4 * math.pi * EPSILON_0 * b * 100, rel=2e-3)


@pytest.mark.parametrize(("top", "bottom"), [(100.0, None), (None, 100.0), (100.0, 300.0), (100.0, 100.0)])
@pytest.mark.parametrize("way", ["axisymmetric", "octant"])
def test_charges_of_every_kind_of_electrodes(way: str, top: float | None, bottom: float | None) -> None:
    """The spherical capacitor: outer face at b, inner at a, permittivity 3 between them.

    Energy and charge: a top electrode sees free space alone; one at the bottom sees the wall in series with it.
    """
    made = problem(way, permittivity=3.0, top=top, bottom=bottom, applied=False)
    a, b = R - T / 2, R + T / 2
    free, wall = 4 * math.pi * EPSILON_0 * b, 4 * math.pi * EPSILON_0 * 3.0 * a * b / (b - a)
    if top is not None:
        charge = free * top
        energy = 0.5 * free * top**2 + (0.5 * wall * (top - bottom) ** 2 if bottom is not None else 0.0)
    else:
        assert bottom is not None
        series = 1 / (1 / free + 1 / wall)
        charge, energy = series * bottom, 0.5 * series * bottom**2
    scalars = State(made).scalars()
    assert scalars["charge"] == pytest.approx(charge, rel=2e-3)
    assert scalars["field_energy"] == pytest.approx(energy, rel=4e-3)  # the wall's a b is R^2 - T^2 / 4


@pytest.mark.parametrize("way", ["axisymmetric", "octant", "oblique"])
def test_a_conductor_becomes_a_dipole(way: str) -> None:
    """At 0 V in a uniform field: E = E0 + (b / r)^3 (3 (E0 . n) n - E0) outside, nothing inside."""
    made = problem(way, permittivity=None, top=0.0, bottom=0.0)
    sides = field_inside_and_outside(made)
    assert np.abs(sides["inside"][1]).max() < 1e-9 * FIELD
    place, field = sides["outside"]
    distance = np.linalg.norm(place, axis=1)[:, None]
    n, applied = place / distance, np.array(WAYS[way][2])
    b = R + T / 2
    exact = applied + (b / distance) ** 3 * (3 * (n @ applied)[:, None] * n - applied)
    assert np.abs(field - exact)[distance.ravel() < 2.5 * R].max() < 0.03 * FIELD
    far = distance.ravel() > 3 * R
    assert np.abs(field - exact)[far].max() < 0.01 * FIELD


def test_prescribed_values_scale_with_the_field() -> None:
    made = problem("octant", permittivity=3.0, top=100.0, bottom=300.0, applied=False)
    system, half = made.system, 0.5
    assert system.potential is not None
    before = {name: system.unknowns.field(name).vec.FV().NumPy().copy() for name in ("phi", "jump")}
    system.load(0.0, half, None)
    system.potential.solve()
    for name, values in before.items():
        assert np.abs(system.unknowns.field(name).vec.FV().NumPy() - half * values).max() < 1e-10 * np.abs(values).max()


def test_equal_electrodes_need_no_jump() -> None:
    assert "jump" not in problem("octant", permittivity=None, top=5.0, bottom=5.0, applied=False).system.unknowns
    assert "jump" in problem("octant", permittivity=2.0, top=5.0, bottom=4.0, applied=False).system.unknowns
