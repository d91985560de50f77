"""Symmetries of space and of the field equations, which no choice of mesh or reduction may break."""

from __future__ import annotations

import math
from typing import Any

import pytest

from embedding import (
    Ambient,
    Disc,
    Discretisation,
    Electrode,
    Faces,
    InfiniteCylinder,
    Loads,
    Model,
    NeoHookean,
    PressureField,
    Scene,
    Shell,
    Solution,
    Sphere,
    Stage,
    Support,
    solve,
)
from embedding.scene import EPSILON_0

pytestmark = pytest.mark.usefixtures("unestimated")

R, MU = 0.02, 1e5
FIELD = math.sqrt(MU / EPSILON_0)
"""The field whose Maxwell stress is of the size of the modulus."""
INFLATE_FIRST = (Stage(name="inflate", steps=2, field=0.0), Stage(name="field", steps=2))
SCALARS = ("stretch", "elastic_energy", "volume_ratio", "pressure_top", "pressure_bottom")


def dielectric(
    direction: tuple[float, float, float],
    shape: Any = None,
    faces: Faces | None = None,
    strength: float = 0.12,
    size: float | None = None,
    order: int = 3,
    **model: Any,
) -> Solution:
    """An inflated dielectric shell in an applied field."""
    applied = tuple(strength * FIELD * c for c in direction)
    return solve(
        Scene(
            shell=Shell(
                shape=shape or Sphere(radius=R),
                thickness=0.05 * R,
                material=NeoHookean(shear_modulus=MU),
                relative_permittivity=5.0,
            ),
            loads=Loads(pressure_bottom=3e3),
            ambient=Ambient(field="electric", applied_field=applied),
            faces=faces or Faces(),
            path=INFLATE_FIRST,
            model=Model(**model),
            discretisation=Discretisation(order=order, shell_size=size),
        )
    )


def same(one: Solution, other: Solution, tolerance: float, names: tuple[str, ...] = SCALARS) -> None:
    """The same scalars in every step; pressures to the tolerance times the largest of them."""
    assert one.result.ok and other.result.ok
    for name in names:
        scale = max(abs(one["pressure_bottom"])) if name.startswith("pressure") else max(abs(one[name]))
        assert one[name] == pytest.approx(other[name], abs=tolerance * scale), name


@pytest.fixture(scope="module")
def along_z() -> Solution:
    return dielectric((0.0, 0.0, 1.0), reduction="axisymmetric")


def test_the_field_matters(along_z: Solution) -> None:
    """What the tests below compare is not nothing."""
    assert along_z["stretch_max"][-1] - along_z["stretch_min"][-1] > 0.015


@pytest.mark.parametrize(
    "direction",
    [(1.0, 0.0, 0.0), *(pytest.param(axis, marks=pytest.mark.slow) for axis in ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))],
)
def test_no_axis_is_special(direction: tuple[float, float, float], along_z: Solution) -> None:
    """The field along x, y or z of an octant: the axisymmetric answer, to the discretisation."""
    same(dielectric(direction, reduction="3d", size=0.4 * R), along_z, 5e-4)


@pytest.mark.slow
def test_an_oblique_field_of_a_half_body(along_z: Solution) -> None:
    """Mirrored about one plane alone: the potential is even there and has no plane on which it vanishes."""
    oblique = dielectric((0.6, 0.0, 0.8), size=0.4 * R)
    assert oblique.plan.reduction.planes == ("y",)
    same(oblique, along_z, 5e-4)


def test_directions_in_the_plane() -> None:
    """A tube in a transverse field along x and y (quarters) and obliquely (whole)."""
    shape = InfiniteCylinder(radius=R)
    along = [dielectric(d, shape) for d in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.6, 0.8, 0.0))]
    for other in along[1:]:
        same(other, along[0], 2e-5, (*SCALARS, "stretch_max"))


def test_the_field_may_be_reversed(along_z: Solution) -> None:
    """Forces are quadratic in the field."""
    same(dielectric((0.0, 0.0, -1.0), reduction="axisymmetric"), along_z, 1e-9)


@pytest.mark.parametrize("reduction", ["axisymmetric", pytest.param("3d", marks=pytest.mark.slow)])
def test_charges_may_be_reversed(reduction: str) -> None:
    faces = [Faces(top=Electrode(voltage=s * 1e3), bottom=Electrode(voltage=s * 3e3)) for s in (1, -1)]
    one, other = (dielectric((0.0, 0.0, 0.0), faces=f, order=2, reduction=reduction) for f in faces)
    same(one, other, 1e-9)
    assert one["charge"] == pytest.approx(-other["charge"], rel=1e-9)
    assert one["field_energy"] == pytest.approx(other["field_energy"], rel=1e-9)


def test_a_shared_potential_of_both_faces_is_not_felt_inside() -> None:
    """The film's own pull depends on the voltage across it: (0, V) and (V, 0) differ only in the space outside."""
    across = 1.2e4
    grounded_top = dielectric(
        (0.0, 0.0, 0.0),
        faces=Faces(top=Electrode(voltage=0.0), bottom=Electrode(voltage=across)),
        reduction="axisymmetric",
    )
    assert grounded_top["charge"][-1] == pytest.approx(0.0, abs=1e-9 * 4 * math.pi * EPSILON_0 * R * across)
    reversed_film = dielectric(
        (0.0, 0.0, 0.0),
        faces=Faces(top=Electrode(voltage=0.0), bottom=Electrode(voltage=-across)),
        reduction="axisymmetric",
    )
    same(grounded_top, reversed_film, 1e-9)


def squeezed_disc(reduction: Any, symmetry: Any) -> Solution:
    """A free flat disc under pressures that vary with the radius: the rim is where they act."""
    varying = PressureField(expression=f"2e4 + 2e4 * (x**2 + y**2) / {R * R}")
    return solve(
        Scene(
            shell=Shell(shape=Disc(radius=R), thickness=0.1 * R, material=NeoHookean(shear_modulus=MU)),
            supports=(Support(where="surface", fix=("z",)),),
            loads=Loads(pressure_top=varying, pressure_bottom=varying),
            path=(Stage(steps=2),),
            model=Model(reduction=reduction, symmetry=symmetry),
            discretisation=Discretisation(order=4, shell_size=0.3 * R),
        )
    )


def test_a_disc_in_every_reduction() -> None:
    """Radius, quarter and whole: gradient and rim terms of the mean pressure, which here is all there is."""
    radius = squeezed_disc("axisymmetric", "auto")
    assert abs(radius["stretch"][-1] - 1) > 0.02
    for other in (squeezed_disc("3d", "auto"), squeezed_disc("3d", "none")):
        same(other, radius, 1e-5, ("stretch", "elastic_energy"))


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_a_varying_pressure_along_any_axis(axis: str) -> None:
    """An octant under pressures that vary along x, y or z, and the axisymmetric body for z."""

    def sphere(along: str, reduction: Any) -> Solution:
        pressure = PressureField(expression=f"3e3 + 3e4 * ({along} / {R})**2")
        opposite = PressureField(expression=f"3e4 * ({along} / {R})**2")
        return solve(
            Scene(
                shell=Shell(shape=Sphere(radius=R), thickness=0.05 * R, material=NeoHookean(shear_modulus=MU)),
                loads=Loads(pressure_bottom=pressure, pressure_top=opposite),
                path=(Stage(steps=2),),
                model=Model(reduction=reduction),
                discretisation=Discretisation(shell_size=0.3 * R),
            )
        )

    names = ("stretch", "elastic_energy", "volume_ratio")
    same(sphere(axis, "3d"), sphere("z", "axisymmetric"), 5e-4, names)
