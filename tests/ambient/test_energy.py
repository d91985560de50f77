"""Field energies: Taylor tests with respect to potential, motion and jump, and closed forms of simple states."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from ngsolve import CF, H1, BilinearForm, FESpace, Grad, GridFunction, Integrate, Variation, VectorH1, ds, dx

from embedding.ambient.energy import field_energy
from embedding.ambient.far import robin_energy
from embedding.ambient.motion import symmetry_components
from embedding.ambient.transmission import Matter, shell_field_energy
from embedding.geometry.domain import Domain
from embedding.geometry.reduction import Reduction
from embedding.geometry.spaces import Mask, TraceSpace, plane_mask, scalar_mask
from embedding.shell.kinematics import Kinematics, surface_gradient
from tests.forms import CLOSED, Taylor, body, close_to, random_directions, set_on_shell, smooth

MESHED = {"octant": 0.7, "axisymmetric sphere": 0.7, "ring": 0.7, "quarter ring": 0.7}
REDUCTIONS = ("octant", "axisymmetric sphere", "ring")


def surrounded(name: str, order: int = 2, size: float = 0.7, radius: float = 2.0) -> Domain:
    return body(name, size, order, radius=radius)


def kept(space: Any, domain: Domain) -> Mask:
    """Unknowns of a vector space that mirror planes and the axis leave free."""
    masks = [np.ones(component.ndof, bool) for component in space.components]
    for axis in symmetry_components(domain):
        masks[axis] &= ~plane_mask(space.components[axis], axis)
    return np.concatenate(masks)


@pytest.mark.parametrize("axial", [1.0, 1.3])
@pytest.mark.parametrize("name", REDUCTIONS)
def test_field_energy(name: str, axial: float) -> None:
    """Potential and motion of the ambient together; the energy is quadratic in the potential alone."""
    domain = surrounded(name)
    motions, potentials = VectorH1(domain.mesh, order=2), H1(domain.mesh, order=3)
    space = FESpace([motions, potentials])
    (motion, potential), _ = space.TnT()
    form = BilinearForm(space)
    density = field_energy(domain.reduction, motion, Grad(motion), Grad(potential), axial)
    form += Variation(density * dx(bonus_intorder=2))
    state = GridFunction(space)
    place = domain.reduction.position
    state.components[0].Set(0.3 * smooth(domain))
    state.components[1].Set(place[0] * place[1] + place[1] ** 2 - 0.5 * place[0])
    free_motion, free_potential = kept(motions, domain), np.ones(potentials.ndof, bool)
    free = np.concatenate([free_motion, free_potential])
    both = Taylor(form, state.vec, random_directions(free, 0.005))
    assert close_to(both.gradient_orders(), 2)
    assert close_to(both.hessian_orders(), 3)
    assert close_to(both.tangent_orders(), 2)
    of_potential = np.concatenate([np.zeros(len(free_motion), bool), free_potential])
    moving = Taylor(form, state.vec, random_directions(free & ~of_potential, 0.01))
    assert close_to(moving.gradient_orders(), 2)
    assert close_to(moving.hessian_orders(), 3)
    charging = Taylor(form, state.vec, random_directions(of_potential, 1.0))
    assert charging.tangent_orders(rows=of_potential) == []  # linear


@pytest.mark.parametrize("name", REDUCTIONS)
def test_robin_energy(name: str) -> None:
    """Quadratic in the potential: gradient and Hessian to rounding."""
    domain = surrounded(name)
    space = H1(domain.mesh, order=3)
    form = BilinearForm(space)
    applied = CF((0.0, 0.3) if domain.mesh.dim == 2 else (0.0, 0.2, 0.3))
    form += Variation(robin_energy(domain.reduction, space.TrialFunction(), applied, 2.0) * ds("outer"))
    state = GridFunction(space)
    state.Set(domain.reduction.position[0] ** 2 + 0.4)
    taylor = Taylor(form, state.vec, random_directions(np.ones(space.ndof, bool), 1.0))
    start = taylor.energy(0 * taylor.start)
    for direction, curvature in zip(taylor.directions, taylor.curvatures, strict=True):
        expansion = start + float(taylor.gradient @ direction) + 0.5 * float(curvature @ direction)
        assert taylor.energy(direction) == pytest.approx(expansion, rel=1e-11)


@pytest.mark.parametrize("name", CLOSED)
def test_field_energy_inside_the_shell(name: str) -> None:
    """Displacement, potential and jump of a dielectric shell together."""
    domain = body(name, order=2)
    displacements = TraceSpace(domain.mesh, 2)
    for axis in symmetry_components(domain):
        displacements.fix(axis, plane_mask(displacements.scalar, axis))
    scalars = TraceSpace(domain.mesh, 3, vector=False)
    space = FESpace([displacements.space, scalars.space, scalars.space])
    u, potential, jump = space.TrialFunction()
    kinematics = Kinematics(domain.reduction, domain.normal, u, 1.2 if "ring" in name else 1.0)
    mean_gradient = surface_gradient(potential) + 0.5 * surface_gradient(jump)
    form = BilinearForm(space)
    density = shell_field_energy(kinematics, 0.1, Matter(4.0), jump.Trace(), mean_gradient)
    form += Variation(domain.reduction.measure * density * domain.surface())
    state = GridFunction(space)
    set_on_shell(state.components[0], smooth(domain), displacements.free, domain)
    place = domain.reduction.position
    set_on_shell(state.components[1], place[0] * place[1], scalars.free, domain)
    set_on_shell(state.components[2], 0.1 + 0.2 * place[1], scalars.free, domain)
    free = np.concatenate([displacements.free, scalars.free, scalars.free])
    taylor = Taylor(form, state.vec, random_directions(free, 0.01))
    assert close_to(taylor.gradient_orders(), 2)
    assert close_to(taylor.hessian_orders(), 3)
    assert close_to(taylor.tangent_orders(), 2)


@pytest.mark.parametrize("stretch", [1.0, 1.5])
@pytest.mark.parametrize("name", CLOSED)
def test_a_capacitor_between_the_faces(name: str, stretch: float) -> None:
    """A uniform jump V over a body scaled by c: eps_r V^2 / (2 lambda T) times the deformed area."""
    domain = body(name, size=0.3, order=3)
    displacements = TraceSpace(domain.mesh, 3)
    u = GridFunction(displacements.space)
    set_on_shell(u, (stretch - 1) * domain.reduction.position, np.ones(len(displacements.free), bool), domain)
    kinematics = Kinematics(domain.reduction, domain.normal, u)
    zero = CF((0.0,) * domain.mesh.dim)
    energy = domain.shell_integral(shell_field_energy(kinematics, 0.1, Matter(4.0), CF(0.3), zero))
    area, grown = (2 * math.pi, stretch) if "ring" in name else (4 * math.pi, stretch**2)
    assert energy == pytest.approx(0.5 * 4.0 * 0.3**2 / (0.1 / grown) * area * grown, rel=1e-4)


@pytest.mark.parametrize("name", [*REDUCTIONS, "quarter ring"])
def test_a_constant_field_does_not_feel_the_motion(name: str) -> None:
    """A field E along an axis in an ambient whose boundary rests: E^2 / 2 times the volume, whatever moves inside.

    The potential is carried along, Phi(X) = - E . x(X), so that the field in space is the same everywhere.
    """
    domain = surrounded(name, size=0.5, radius=2.0)
    motion = GridFunction(VectorH1(domain.mesh, order=2))
    potential = GridFunction(H1(domain.mesh, order=2))
    place = domain.reduction.position
    motion.Set(0.3 * smooth(domain))
    still = np.tile(scalar_mask(potential.space, domain.mesh.Boundaries("outer")), domain.mesh.dim)
    motion.vec.FV().NumPy()[still | ~kept(motion.space, domain)] = 0.0
    energies = [_energy_of_constant_field(domain, factor, motion, potential, place[1]) for factor in (0.0, 1.0)]
    volume = Integrate(domain.reduction.measure * dx(bonus_intorder=6), domain.mesh)
    assert energies == pytest.approx([0.5 * 0.7**2 * volume] * 2, rel=1e-10)


def _energy_of_constant_field(domain: Domain, factor: float, motion: Any, potential: Any, height: Any) -> float:
    moved = GridFunction(motion.space)
    moved.vec.data = factor * motion.vec
    potential.Set(-0.7 * (height + moved[1]))
    density = field_energy(domain.reduction, moved, Grad(moved), Grad(potential), 1.0)
    return float(Integrate(density * dx(bonus_intorder=6), domain.mesh))


def test_measures_count_the_whole_ambient() -> None:
    """The volume of the ball and the area of the disc, in every way of meshing them."""
    for name in MESHED:
        domain = surrounded(name, order=3, size=0.5)
        total = Integrate(domain.reduction.measure * dx, domain.mesh)
        expected = math.pi * 4.0 if domain.reduction.name == "plane-strain" else 4 / 3 * math.pi * 8.0
        assert total == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("name", REDUCTIONS)
@pytest.mark.parametrize("degree", [0, 1, 2])
def test_decaying_harmonics_on_the_outer_boundary(name: str, degree: int) -> None:
    """The Robin form on a harmonic of degree l: (l + 1) / 2R of its square for l = 0, 1; in the plane l / 2R, l = 1, 2.

    One degree more and it is a bound from above: 4 instead of 3, in the plane (without charge) 1.
    """
    domain = surrounded(name, order=3, size=0.5, radius=2.0)
    plane = domain.reduction.name == "plane-strain"
    a, b = domain.reduction.position[0], domain.reduction.position[domain.mesh.dim - 1]
    harmonic = [CF(1.0), b, (a * a - b * b) if plane else (2 * b * b - _across_squared(domain.reduction))][degree]
    potential = GridFunction(H1(domain.mesh, order=3))
    potential.Set(harmonic)
    zero = CF((0.0,) * domain.mesh.dim)
    outer = ds("outer", bonus_intorder=4)
    energy = Integrate(robin_energy(domain.reduction, potential, zero, 2.0) * outer, domain.mesh)
    square = Integrate(domain.reduction.measure * potential**2 * outer, domain.mesh)
    coefficient = {True: (2 / 3, 1.0, 2.0), False: (1.0, 2.0, 4.0)}[plane][degree]
    assert energy == pytest.approx(0.5 * coefficient / 2.0 * square, rel=1e-3)


def _across_squared(reduction: Reduction) -> Any:
    place = reduction.position
    return place[0] ** 2 if reduction.name == "axisymmetric" else place[0] ** 2 + place[1] ** 2
