"""What the shell is made of: permeable, remanent, saturating, in uniform and in circulating fields; against exact walls
of finite thickness."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from ngsolve import BND, CF, ET, Cross, Grad, GridFunction, Id, InnerProduct, IntegrationRule, sqrt

from embedding import (
    Ambient,
    Discretisation,
    InfiniteCylinder,
    Model,
    NeoHookean,
    Scene,
    Shell,
    Sphere,
    explain,
)
from embedding.ambient.sources import Electrodes
from embedding.ambient.transmission import Matter
from embedding.coupling.physics import FieldPhysics
from embedding.coupling.system import System
from embedding.geometry.domain import Domain
from embedding.solving.partition import FieldPart, ShellAlone
from embedding.solving.problem import Problem
from problems.exact.line_current import TubeBesideCurrent, squeeze
from problems.exact.magnetised_shell import magnetised_sphere, magnetised_tube, potential_drop
from problems.exact.permeable_cylinder import PermeableCylinder
from problems.exact.permeable_sphere import PermeableSphere
from problems.exact.radial_modes import generalised_force

Matters = Callable[[Domain], Matter]


def shell(reduction: Any, thickness: float, *, size: float = 0.2, order: int = 3, symmetry: Any = "auto") -> Problem:
    """A sphere, or the section of a tube, of radius 1 m at rest, surrounded by a magnetic field."""
    shape = InfiniteCylinder(radius=1.0) if reduction == "plane-strain" else Sphere(radius=1.0)
    scene = Scene(
        shell=Shell(
            shape=shape, thickness=thickness, material=NeoHookean(shear_modulus=1.0), relative_permeability=2.0
        ),
        ambient=Ambient(field="magnetic"),
        model=Model(reduction=reduction, symmetry=symmetry),
        discretisation=Discretisation(order=order, shell_size=size),
    )
    return Problem(scene, explain(scene))


def magnetic(problem: Problem, matter: Matter, **field: Any) -> System:
    """The shell of ``problem`` made of ``matter``, with its potential solved."""
    dimension = problem.mesh.dim
    parts = {"applied": (0.0,) * dimension, "grounded": False, "odd_planes": ()} | field
    physics = replace(problem.system.physics, field=FieldPhysics(electrodes=Electrodes(), matter=matter, **parts))
    system = System(problem.domain, physics)
    system.load(0.0, 1.0, None)
    system.place_faces()
    assert system.follow() and system.potential is not None
    system.potential.solve()
    return system


def strengths(system: System, side: str) -> tuple[Any, Any]:
    """Places and field vectors in the middle of the elements of ``side``."""
    domain, field = system.domain, system.lagrangian.field
    assert field is not None
    values = {name: system.unknowns.field(name) for name in system.unknowns.names}
    motion = system.motions[side]
    moved = motion.y[side] + motion.w
    F = Id(domain.mesh.dim) + Grad(motion.y[side]) + Grad(motion.w)
    rule = IntegrationRule(ET.TET if domain.mesh.dim == 3 else ET.TRIG, 1)
    points = domain.mesh.MapToAllElements(rule, domain.mesh.Materials(domain.materials(side)))
    place = np.asarray(CF(domain.reduction.position + moved)(points))
    return place, np.asarray(CF(field.strength(side, values, moved, F))(points))


@pytest.mark.parametrize(("reduction", "size"), [("axisymmetric", 0.2), ("3d", 0.5), ("plane-strain", 0.2)])
@pytest.mark.parametrize("contrast", [1.0, 5.0])
def test_a_closed_shell_magnetised_along_its_normal_has_no_field_around_it(
    reduction: str, size: float, contrast: float
) -> None:
    """A double layer: only the potential jumps, by B_r T / mu_r, to the error of the discretisation."""
    problem = shell(reduction, 0.1, size=size)
    system = magnetic(problem, Matter(contrast, 0.7 * problem.domain.normal))
    for side in ("outside", "inside"):
        assert np.abs(strengths(system, side)[1]).max() < 2e-3 * 0.7 * 0.1
    area = problem.domain.shell_integral(1.0)
    jump = problem.domain.shell_integral(system.unknowns.field("jump")) / area
    assert jump == pytest.approx(potential_drop(0.1, 0.7, contrast), rel=1e-4)


@pytest.mark.parametrize(
    ("reduction", "exact"), [("axisymmetric", magnetised_sphere), ("plane-strain", magnetised_tube)]
)
@pytest.mark.parametrize("contrast", [1.0, 10.0])
def test_a_uniformly_magnetised_shell(reduction: str, exact: Any, contrast: float) -> None:
    """The cavity's field and the dipole outside, second order in the thickness."""
    errors = []
    for thickness in (0.1, 0.05):
        problem = shell(reduction, thickness, size=0.15, symmetry="none")
        along = (0.0, 1.0) if reduction == "axisymmetric" else (1.0, 0.0)
        system = magnetic(problem, Matter(contrast, along))
        wanted = exact(thickness, contrast)
        field = strengths(system, "inside")[1] @ np.array(along)
        place, outside = strengths(system, "outside")
        distance = np.linalg.norm(place, axis=1)
        far = (distance > 2.0) & (distance < 3.5)
        cosine = (place @ np.array(along))[far] / distance[far]
        d = wanted.dimension
        dipole = wanted.coefficients.dipole / distance[far] ** d
        parallel = dipole * (d * cosine**2 - 1.0)
        scale = abs(wanted.coefficients.dipole)
        errors.append(
            (
                np.abs(field - wanted.inner_field).max() / scale,
                np.abs((outside @ np.array(along))[far] - parallel).max() / scale,
            )
        )
    assert errors[1][0] < 2e-3 and errors[1][1] < 2e-3
    assert errors[0][0] < 1.2e-2 and errors[0][1] < 1.2e-2


@pytest.mark.parametrize("contrast", [2.0, 10.0, 1e3, 1e6])
@pytest.mark.parametrize(
    ("reduction", "exact"), [("axisymmetric", PermeableSphere), ("plane-strain", PermeableCylinder)]
)
def test_generalised_force_on_the_second_mode(reduction: str, exact: Any, contrast: float) -> None:
    """All the work of the field on a radial motion P_2, at T / R = 0.05."""
    thickness = 0.05
    problem = shell(reduction, thickness, size=0.12, symmetry="none")
    along = (0.0, 1.0) if reduction == "axisymmetric" else (1.0, 0.0)
    system = magnetic(problem, Matter(contrast), applied=along)
    part = FieldPart(system, ShellAlone(problem.domain, system.physics))
    part.shell.load(0.0, 0.0, None)
    assert part.follow()
    part.solve()
    position = problem.reduction.position
    cosine = InnerProduct(position, CF(along)) / sqrt(InnerProduct(position, position))
    mode = 0.5 * (3 * cosine**2 - 1) if reduction == "axisymmetric" else 2 * cosine**2 - 1
    direction = GridFunction(system.unknowns.trace.space)
    direction.Set(mode * problem.domain.normal, BND, definedon=problem.domain.shell)
    force = float(part.forces() @ direction.vec.FV().NumPy())
    wanted = generalised_force(exact(1 - thickness / 2, 1 + thickness / 2, contrast, 1.0, 1.0))
    assert force == pytest.approx(wanted, rel=1e-2)


def line_current(through: tuple[float, float], current: float) -> Callable[[Any], Any]:
    """H of a current along z (mesh components of plane strain)."""

    def field(x: Any) -> Any:
        away = CF((x[0] - through[0], x[1] - through[1], 0.0))
        h = current / (2 * math.pi) / InnerProduct(away, away) * Cross(CF((0.0, 0.0, 1.0)), away)
        return CF((h[0], h[1]))

    return field


@pytest.mark.parametrize("contrast", [3.0, 100.0])
def test_a_line_current_draws_a_permeable_tube(contrast: float) -> None:
    """A circulating applied field, whose source passes through the meshed space: force against the multipole series."""
    errors = []
    for thickness in (0.1, 0.05):
        problem = shell("plane-strain", thickness, size=0.1, symmetry="none")
        system = magnetic(problem, Matter(contrast), varying=line_current((2.0, 0.0), 3.0))
        force, _ = system.resultants["shell"].evaluate()
        wanted = TubeBesideCurrent(1 - thickness / 2, 1 + thickness / 2, contrast, 2.0, 3.0).force
        assert abs(force[1]) < 1e-4 * wanted
        errors.append(abs(force[0] / wanted - 1))
    assert errors[1] < 3e-3 and errors[1] < 0.5 * errors[0]


@pytest.mark.parametrize("current", [0.3, 3.0, 10.0])
def test_a_saturating_tube_around_a_line_current(current: float) -> None:
    """H = I / (2 pi r) whatever the law; the squeeze on the wall is that of its magnetisation."""
    thickness, contrast, limit = 0.05, 6.0, 0.4
    problem = shell("plane-strain", thickness, size=0.15, symmetry="none")
    system = magnetic(problem, Matter(contrast, None, limit), varying=line_current((0.0, 0.0), current))
    scale = current / (2 * math.pi)
    for name in ("phi", "jump"):
        assert np.abs(system.unknowns.field(name).vec.FV().NumPy()).max() < 1e-3 * scale
    part = FieldPart(system, ShellAlone(problem.domain, system.physics))
    part.shell.load(0.0, 0.0, None)
    assert part.follow()
    part.solve()
    direction = GridFunction(system.unknowns.trace.space)
    direction.Set(problem.domain.normal, BND, definedon=problem.domain.shell)
    force = float(part.forces() @ direction.vec.FV().NumPy()) / (2 * math.pi)

    def magnetisation(field: float) -> float:
        chi = contrast - 1
        return chi * field / math.sqrt(1 + (chi * field / limit) ** 2)

    wanted = -squeeze(1 - thickness / 2, 1 + thickness / 2, current, magnetisation)
    assert force == pytest.approx(wanted, rel=5e-3)
