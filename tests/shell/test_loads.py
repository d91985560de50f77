"""Mechanical loads: linearisations, potentials, and the work of pressures on the true faces."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from ngsolve import CF, BilinearForm, GridFunction, Integrate, Parameter, Variation, sin, sqrt, x, y, z

from embedding.ambient.motion import symmetry_components
from embedding.geometry.domain import Domain
from embedding.geometry.spaces import Mask, TraceSpace, plane_mask
from embedding.shell.kinematics import Kinematics
from embedding.shell.loads import MechanicalLoads, Variant, dead_load_energy, enclosed_volume, follower_residual
from tests.forms import (
    BODIES,
    CLOSED,
    Taylor,
    body,
    close_to,
    observed_orders,
    random_directions,
    set_on_shell,
    smooth,
)
from tests.shell.faces import Meridian

VARIANTS: tuple[Variant, ...] = ("embedding-aware", "net", "as-published")
NONE = MechanicalLoads(0.0, 0.0, (), (), True, "embedding-aware")
FLAT = tuple(name for name in BODIES if name not in CLOSED)


def displacement_space(domain: Domain) -> TraceSpace:
    space = TraceSpace(domain.mesh, domain.sizes.order)
    for axis in symmetry_components(domain):
        space.fix(axis, plane_mask(space.scalar, axis))
    return space


def residual_form(domain: Domain, loads: MechanicalLoads, thickness: float = 0.1) -> tuple[BilinearForm, Any, Mask]:
    """Form of the face pressures alone, a smoothly displaced state, and the free unknowns."""
    space = displacement_space(domain)
    trial, test = space.space.TnT()
    form = BilinearForm(space.space)
    kinematics = Kinematics(domain.reduction, domain.normal, trial, 1.2 if "ring" in domain.shape.kind else 1.0)
    for term in follower_residual(domain, loads, thickness, kinematics, test, Parameter(0.7)):
        form += term
    state = GridFunction(space.space)
    set_on_shell(state, smooth(domain), space.free, domain)
    return form, state, space.free


@pytest.mark.parametrize("rim_is_free", [True, False], ids=["free rim", "pressed rim"])
@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("name", BODIES)
def test_linearisation(name: str, variant: Variant, rim_is_free: bool) -> None:
    """Pressures that vary over both faces, in every reduction: the matrix is the derivative of the residual."""
    domain = body(name)
    loads = replace(
        NONE,
        pressure_top=0.4 + 0.3 * x * y,
        pressure_bottom=0.9 - sin(x) + y * y,
        variant=variant,
        rim_is_free=rim_is_free,
    )
    form, state, free = residual_form(domain, loads)
    taylor = Taylor(form, state.vec, random_directions(free, 0.01))
    assert np.linalg.norm(taylor.gradient) > 1e-3
    assert close_to(taylor.tangent_orders(), 2)


@pytest.mark.parametrize("variant", ["embedding-aware", "net"])
@pytest.mark.parametrize("name", CLOSED)
def test_uniform_pressures_work_on_the_enclosed_volume(name: str, variant: Variant) -> None:
    """On a closed shell the residual is p_t - p_b times the gradient of the enclosed volume, whatever their mean."""
    domain = body(name, size=0.5, order=3)
    form, state, free = residual_form(domain, replace(NONE, pressure_top=7.0, pressure_bottom=7.9, variant=variant))
    space = state.space
    trial = space.TrialFunction()
    volume = BilinearForm(space)
    kinematics = Kinematics(domain.reduction, domain.normal, trial, 1.2 if "ring" in domain.shape.kind else 1.0)
    density = enclosed_volume(domain, kinematics, trial.Trace())
    volume += Variation(0.7 * (7.0 - 7.9) * domain.reduction.measure * density * domain.surface())
    directions = random_directions(free, 0.01)
    residual, gradient = Taylor(form, state.vec, directions).gradient, Taylor(volume, state.vec, directions)
    assert close_to(gradient.gradient_orders(), 2)
    # Edges between elements cancel as far as the quadrature is exact: quite in the plane, nearly elsewhere.
    miss = np.linalg.norm((residual - gradient.gradient)[free])
    assert miss < (1e-13 if "ring" in name else 1e-5) * np.linalg.norm(residual[free])


def shell_work(domain: Domain, loads: MechanicalLoads, thickness: float, motion: Any, virtual: Any) -> float:
    """The shell theory's virtual work of the pressures for given displacements."""
    space = displacement_space(domain)
    trial, test = space.space.TnT()
    form = BilinearForm(space.space)
    factor = Parameter(1.0)
    kinematics = Kinematics(domain.reduction, domain.normal, trial)
    for term in follower_residual(domain, loads, thickness, kinematics, test, factor):
        form += term
    fields = [GridFunction(space.space) for _ in range(2)]
    for field, value in zip(fields, (motion, virtual), strict=True):
        set_on_shell(field, value, space.free, domain)
    residual = fields[0].vec.CreateVector()
    form.Apply(fields[0].vec, residual)
    return float(np.dot(residual.FV().NumPy(), fields[1].vec.FV().NumPy()))


def motion_of(r: Any, height: Any) -> tuple[Any, Any]:
    """An axisymmetric displacement (radial, axial) without any symmetry about the equator."""
    return r * (0.2 + 0.1 * height - 0.15 * r * r), 0.1 * height + 0.2 * r * r - 0.05 * height * r * r


def virtual_of(r: Any, height: Any) -> tuple[Any, Any]:
    return r * (1.0 - 0.6 * height + 0.4 * r * r), 0.5 - 0.8 * r * r + 0.7 * height


def top_of(r: Any, height: Any) -> Any:
    return 1.0 + 0.5 * r * r + 0.4 * height


def bottom_of(r: Any, height: Any) -> Any:
    return 0.8 - 0.6 * r * r + 0.7 * height * (1 + r * r)


def misses(shape: str, variant: Variant, thicknesses: tuple[float, ...]) -> list[float]:
    """Work in the shell theory minus work on the true faces, for shells of several thicknesses."""
    domain = body(f"axisymmetric {shape}", size=0.1, order=4)
    loads = replace(NONE, pressure_top=top_of(x, y), pressure_bottom=bottom_of(x, y), variant=variant)
    meridian = Meridian(sphere=shape == "sphere")
    out = []
    for thickness in thicknesses:
        exact = meridian.virtual_work(thickness, motion_of, virtual_of, top_of, bottom_of)
        ours = shell_work(domain, loads, thickness, CF(motion_of(x, y)), CF(virtual_of(x, y)))
        out.append(abs(ours - exact))
    return out


@pytest.mark.parametrize("shape", ["sphere", "disc"])
def test_work_on_the_true_faces(shape: str) -> None:
    """The embedding-aware load is the work on the faces at r +- (T/2) lambda n up to T^2; the others only up to T."""
    thicknesses = (0.02, 0.01, 0.005)
    aware, net, published = (observed_orders(misses(shape, variant, thicknesses)) for variant in VARIANTS)
    assert close_to(aware, 2, within=0.1)
    assert close_to(net, 1, within=0.25)
    assert close_to(published, 1, within=0.25)


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("shape", ["sphere", "disc"])
def test_all_reductions_agree(shape: str, variant: Variant) -> None:
    """The same axisymmetric motion under the same varying pressures, in the axisymmetric and the 3D form."""
    works = []
    for name in (f"axisymmetric {shape}", shape):
        domain = body(name, size=0.25, order=4)
        if domain.mesh.dim == 2:
            r, height = x, y
            motion, virtual = CF(motion_of(r, height)), CF(virtual_of(r, height))
        else:
            r, height = sqrt(x * x + y * y + 1e-30), z
            (a, b), (c, d) = motion_of(r, height), virtual_of(r, height)
            motion, virtual = CF((a * x / r, a * y / r, b)), CF((c * x / r, c * y / r, d))
        loads = replace(NONE, pressure_top=top_of(r, height), pressure_bottom=bottom_of(r, height), variant=variant)
        works.append(shell_work(domain, loads, 0.1, motion, virtual))
    assert works[1] == pytest.approx(works[0], rel=1e-5)


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("name", CLOSED)
def test_work_of_an_inflation(name: str, variant: Variant) -> None:
    """Closed shells scaled by c, virtual motion X: (p_t - p_b) c^(k - 1) A, k = 3 or in the plane 2; as published also

    - T pbar (k - 1) (1 / c - 1) A, from the surface divergence (k - 1) / c and twice the reference curvature, 1 - k.
    """
    domain, c, thickness, top, bottom = body(name, size=0.3, order=3), 1.4, 0.1, 0.5, 0.9
    place = domain.reduction.position
    loads = replace(NONE, pressure_top=CF(top), pressure_bottom=CF(bottom), variant=variant)
    work = shell_work(domain, loads, thickness, (c - 1) * place, place)
    k, area = (2, 2 * math.pi) if "ring" in name else (3, 4 * math.pi)
    expected = (top - bottom) * c ** (k - 1) * area
    if variant == "as-published":
        expected -= thickness * 0.5 * (top + bottom) * (k - 1) * (1 / c - 1) * area
    assert work == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("name", FLAT)
def test_a_free_rim_is_what_a_pressed_rim_is_not(name: str) -> None:
    """The rim term: free minus pressed is - T pbar times the rim's stretch outwards, here uniform by a factor c.

    With x = c X in the plane, F-hat^-T nu = nu / c and the motion v = X: the work is - T pbar (1/c) int nu . X dL, and
    int nu . X dL is twice the area.
    """
    domain, c, pressure, thickness = body(name), 1.3, 0.8, 0.1
    place = domain.reduction.position
    flat = (place[0], 0.0) if domain.mesh.dim == 2 else (place[0], place[1], 0.0)
    works = []
    for rim_is_free in (True, False):
        loads = replace(NONE, pressure_top=pressure, pressure_bottom=pressure, rim_is_free=rim_is_free)
        motion = CF(tuple((c - 1) * component for component in flat))
        works.append(shell_work(domain, loads, thickness, motion, CF(flat)))
    area = 0.6 if name == "plate" else math.pi
    assert works[1] == pytest.approx(0.0, abs=1e-12)
    assert works[0] == pytest.approx(-thickness * pressure * 2 * area / c, rel=1e-3)


@pytest.mark.parametrize("name", BODIES)
def test_body_force_is_weight_times_displacement(name: str) -> None:
    """A constant displacement c: the potential is - T b . c times the area of the whole body."""
    domain = body(name, size=0.3, order=3)
    d, thickness = domain.mesh.dim, 0.05
    force, move = (0.0, 3.0, -2.0)[-d:], (0.0, 0.5, 0.7)[-d:]
    loads = replace(NONE, body_force=force)
    (term,) = dead_load_energy(domain, loads, thickness, CF(move), Parameter(0.5))
    area = {"plate": 0.6, "disc": math.pi, "sphere": 4 * math.pi, "infinite-cylinder": 2 * math.pi}[domain.shape.kind]
    expected = -0.5 * thickness * float(np.dot(force, move)) * area
    assert Integrate(term, domain.mesh) == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize(
    ("name", "edge", "length"),
    [
        ("plate", "x0", 0.6),
        ("plate", "x1", 0.6),
        ("plate", "y0", 1.0),
        ("plate", "y1", 1.0),
        ("disc", "rim", 2 * math.pi),
        ("quarter disc", "rim", 2 * math.pi),
        ("axisymmetric disc", "rim", 2 * math.pi),
    ],
)
def test_edge_traction_is_force_per_length_times_displacement(name: str, edge: str, length: float) -> None:
    domain = body(name, size=0.3, order=3)
    traction, move = (2.0, 3.0, -1.5)[-domain.mesh.dim :], (0.4, 0.5, 0.7)[-domain.mesh.dim :]
    form = BilinearForm(displacement_space(domain).space)
    loads = replace(NONE, edge_tractions=((edge, traction),))
    trial = form.space.TrialFunction()
    for term in dead_load_energy(domain, loads, 0.05, trial.Trace(), Parameter(0.5)):
        form += Variation(term)
    u = GridFunction(form.space)
    set_on_shell(u, CF(move), np.ones(form.space.ndof, bool), domain)
    assert form.Energy(u.vec) == pytest.approx(-0.5 * float(np.dot(traction, move)) * length, rel=1e-4)


def test_which_loads_press() -> None:
    assert NONE.uniform and not NONE.pressed
    both = replace(NONE, pressure_top=2.0, pressure_bottom=5.0)
    assert both.uniform and both.pressed
    assert (both.difference, both.mean) == (-3.0, 3.5)
    assert not replace(NONE, pressure_top=CF(2.0)).uniform
    assert replace(NONE, pressure_top=CF(0.0)).pressed
