"""The two-sided potential: phi below, phi + jump on top, and one continuous function everywhere else.

Patch tests on straight meshes: harmonic polynomials, another one on each side, come out to rounding when their jump and
the jump of their flux are prescribed. On curved meshes the error falls with the best order.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from ngsolve import (
    BND,
    CF,
    H1,
    L2,
    VOL,
    BilinearForm,
    Grad,
    GridFunction,
    IfPos,
    InnerProduct,
    Integrate,
    LinearForm,
    Mesh,
    Norm,
    ds,
    dx,
    sqrt,
    x,
    y,
    z,
)

from embedding import Annulus, Arch, Cap, Disc, InfiniteCylinder, Plate, Sphere, Strip
from embedding.geometry.cut import Cut
from embedding.geometry.domain import Domain, MeshSizes, Shape, build
from embedding.geometry.facets import Facets
from embedding.geometry.reduction import Name, Reduction
from embedding.geometry.spaces import TraceSpace, as_bits, scalar_mask
from tests.forms import set_on_shell

RADIUS = 2.0


def slope(value: Any, domain: Domain) -> Any:
    """Gradient of an expression of the coordinates."""
    return CF(tuple(value.Diff(c) for c in (x, y, z)[: domain.mesh.dim]))


def minus_laplacian(value: Any, domain: Domain) -> Any:
    """Of the body that the mesh stands for."""
    out = sum((value.Diff(c).Diff(c) for c in (x, y, z)[: domain.mesh.dim]), CF(0.0))
    return -out - (value.Diff(x) / x if domain.reduction.name == "axisymmetric" else CF(0.0))


@dataclass
class TwoSided:
    """phi and its jump of ``order`` on a ``domain``; on top and below the potential should be ``top`` and ``below``.

    ``split`` of an expression for the space on top and one for that below is what should be; where an open shell ends
    both agree.
    """

    domain: Domain
    order: int
    top: Any
    below: Any
    split: Callable[[Any, Any], Any]

    def __post_init__(self) -> None:
        domain = self.domain
        self.trace = TraceSpace(domain.mesh, self.order, vector=False, reach=domain.materials("outside"))
        self.trace.fix(0, domain.rim_dofs(self.trace.scalar))
        self.phi = GridFunction(H1(domain.mesh, order=self.order))
        self.jump = GridFunction(self.trace.space)
        set_on_shell(self.jump, self.top - self.below, self.trace.free, domain)

    @property
    def potential(self) -> Any:
        """On every element."""
        return self._by_side(self.phi + self.jump, self.phi)

    def exact(self, of: Callable[[Any], Any]) -> Any:
        """What should be of a function ``of`` the potential."""
        return self.split(of(self.top), of(self.below))

    @property
    def gradient(self) -> Any:
        """On every element."""
        return self._by_side(Grad(self.phi) + Grad(self.jump), Grad(self.phi))

    def _by_side(self, top: Any, below: Any) -> Any:
        return by_material(self.domain)(top, below)

    def solve(self) -> None:
        """Poisson's equation with the exact values on the outer boundary and the exact jump of the flux."""
        domain, space = self.domain, self.phi.space
        u, v = space.TnT()
        measure, bonus = domain.reduction.measure, 2 * self.order + 2
        form = BilinearForm(measure * Grad(u) * Grad(v) * dx(bonus_intorder=2)).Assemble()
        load = LinearForm(space)
        load += measure * self.exact(lambda value: minus_laplacian(value, domain)) * v * dx(bonus_intorder=bonus)
        load += -measure * InnerProduct(Grad(self.jump), Grad(v)) * dx(domain.materials("outside"), bonus_intorder=2)
        flux = InnerProduct(slope(self.top, domain) - slope(self.below, domain), domain.normal)
        load += -measure * flux * v * ds("shell", bonus_intorder=bonus)
        load.Assemble()
        outer = domain.mesh.Boundaries("outer")
        self.phi.Set(self.top, BND, definedon=outer)
        free = ~scalar_mask(space, outer)
        residual = load.vec.CreateVector()
        residual.data = load.vec - form.mat * self.phi.vec
        self.phi.vec.data += form.mat.Inverse(as_bits(free), inverse="sparsecholesky") * residual

    def errors(self) -> tuple[float, float]:
        """In L2 and of the gradient in L2."""
        measure, domain, bonus = self.domain.reduction.measure, self.domain, 2 * self.order
        off = self.potential - self.exact(lambda value: value)
        off_slope = self.gradient - self.exact(lambda value: slope(value, domain))
        values = [measure * off * off, measure * InnerProduct(off_slope, off_slope)]
        return tuple(math.sqrt(Integrate(v * dx(bonus_intorder=bonus), domain.mesh)) for v in values)  # type: ignore[return-value]


def by_material(domain: Domain) -> Callable[[Any, Any], Any]:
    """The side of a closed shell."""

    def split(top: Any, below: Any) -> Any:
        return CF([top if name.startswith("outside") else below for name in domain.mesh.GetMaterials()])

    return split


def by_place(domain: Domain) -> Callable[[Any, Any], Any]:
    """On top of a cap is outside of its ball."""
    radius = 1 / domain.shape.size
    return lambda top, below: IfPos(Norm(domain.reduction.position) - radius, top, below)


def domain_of(shape: Shape, reduction: Name, planes: tuple[str, ...], size: float, order: int) -> Domain:
    return build(shape, Reduction(reduction, planes), MeshSizes(size, 1.5 * size, RADIUS, 0.5, order))


SPACE = (x * x * x - 3 * x * z * z + y * z - x + 0.3, 2 * x * y * z - z * z + x * x + 0.5 * y)
EVEN = (2 * z * z - x * x - y * y + 1.0, x * x - y * y - 0.4)
AXIS = (y**3 - 1.5 * y * x * x + y - 0.2, y * y - 0.5 * x * x + 0.7)  # r and z are the first two coordinates
PLANE = (x**3 - 3 * x * y * y + x * y, x * x - y * y + 0.3 * y - 1.0)
PATCHES = [
    (Sphere(radius=1.0), "3d", (), SPACE), (Sphere(radius=1.0), "3d", ("x", "y", "z"), EVEN),
    (Sphere(radius=1.0), "axisymmetric", (), AXIS), (InfiniteCylinder(radius=1.0), "plane-strain", (), PLANE),
]  # fmt: skip


@pytest.mark.parametrize(("shape", "reduction", "planes", "pair"), PATCHES)
def test_two_harmonic_polynomials(
    shape: Shape, reduction: Name, planes: tuple[str, ...], pair: tuple[Any, Any]
) -> None:
    """One inside and another outside a facetted closed shell: exact to rounding, whatever their jump."""
    domain = domain_of(shape, reduction, planes, 0.5, 1)
    top, below = pair
    two = TwoSided(domain, 3, top, below, by_material(domain))
    two.solve()
    assert max(two.errors()) < 1e-10


OPEN = [
    (Plate(length=1.0, width=0.6), "3d", (), 0.3),
    (Plate(length=1.0, width=0.6), "3d", (), 0.7),
    (Disc(radius=1.0), "3d", (), 0.5),
    (Disc(radius=1.0), "3d", ("x", "y"), 0.5),
    (Annulus(inner_radius=0.6, outer_radius=1.0), "3d", ("x",), 0.5),
    (Cap(radius=1.0, half_angle=1.2), "3d", ("y",), 0.5),
    (Disc(radius=1.0), "axisymmetric", (), 0.3),
    (Disc(radius=1.0), "axisymmetric", (), 1.5),
    (Strip(length=1.0), "plane-strain", (), 0.2),
    (Arch(radius=1.0, half_angle=1.0), "plane-strain", (), 0.3),
]


@pytest.mark.parametrize(("shape", "reduction", "planes", "size"), OPEN)
def test_the_potential_jumps_across_the_shell_alone(
    shape: Shape, reduction: Name, planes: tuple[str, ...], size: float
) -> None:
    """Any phi and any jump that vanishes on the rims: over all facets of the mesh, the squared jumps add up to those on
    the shell. On the top side the potential is phi + jump, on the other one phi."""
    domain = domain_of(shape, reduction, planes, size, 1)
    order = 4
    two = TwoSided(domain, order, CF(0.0), CF(0.0), by_material(domain))
    numbers = np.random.default_rng(7)
    two.jump.vec.FV().NumPy()[:] = numbers.uniform(-1, 1, two.trace.space.ndof) * two.trace.free
    two.phi.Set(1 + x * y + 0.3 * y)
    on_shell = Integrate(two.jump * two.jump * ds("shell", bonus_intorder=4), domain.mesh)
    assert on_shell > 1e-4
    assert squared_jumps(domain, two.potential, order) == pytest.approx(on_shell, rel=1e-9)
    up, middles = domain.facets.at_centres(domain.normal), domain.facets.at_centres(domain.reduction.position)
    jumps = domain.facets.at_centres(two.jump)[:, 0]
    trace = np.array([two.phi(domain.mesh(*place)) for place in middles])
    for away, factor in ((1e-3, 1.0), (-1e-3, 0.0)):  # a point on the shell itself is found on either side
        once, twice = (np.array([two.potential(domain.mesh(*p)) for p in middles + k * away * up]) for k in (1, 2))
        assert 2 * once - twice == pytest.approx(trace + factor * jumps, abs=2e-3)


def squared_jumps(domain: Domain, value: Any, order: int) -> float:
    """Integral over all facets between two elements of the squared difference of a polynomial of the elements."""
    space = L2(domain.mesh, order=order, dgjumps=True)
    u, v = space.TnT()
    form = BilinearForm(space)
    form += (u - u.Other()) * (v - v.Other()) * dx(skeleton=True)
    form.Assemble()
    field = GridFunction(space)
    field.Set(value)
    image = field.vec.CreateVector()
    image.data = form.mat * field.vec
    return float(InnerProduct(image, field.vec))


def test_a_jump_on_the_rim_is_seen_elsewhere() -> None:
    """The test above can fail: a jump that does not vanish on the rim tears the space around it."""
    domain = domain_of(Disc(radius=1.0), "3d", ("x", "y"), 0.5, 1)
    two = TwoSided(domain, 2, CF(0.0), CF(0.0), by_material(domain))
    two.jump.vec[:] = 1.0
    on_shell = Integrate(two.jump * two.jump * ds("shell", bonus_intorder=4), domain.mesh)
    assert squared_jumps(domain, two.potential, 2) > 1.05 * on_shell


def spheres(domain: Domain) -> tuple[Any, Any]:
    """A charge and a growing quadrupole outside, another quadrupole inside."""
    along = y if domain.mesh.dim == 2 else z
    r = sqrt(x * x + y * y + (z * z if domain.mesh.dim == 3 else 0.0))
    quadrupole = 3 * along * along - r * r
    return 1 / r - 0.3 * quadrupole, 0.7 * quadrupole - 0.4


def caps(domain: Domain) -> tuple[Any, Any]:
    """Outside the ball and above the rim's plane the fourth power of the distance from it, three times differentiable,
    is added."""
    along = y if domain.mesh.dim == 2 else z
    height = along - math.cos(1.0) / domain.shape.size
    below = 0.7 * x * x - 0.4 * along + 0.2 * along * along
    return below + IfPos(height, height**4, 0.0), below


RATES = [
    (shape, reduction, planes, order)
    for shape in (Sphere(radius=1.0), Cap(radius=1.0, half_angle=1.0))
    for order in (2, 3)
    for reduction, planes in (("axisymmetric", ()), ("3d", shape.mirrors))
]


def refined(domain: Domain) -> Domain:
    """Every element cut into four or eight of half its size, new vertices on the surface."""
    raw = domain.mesh.ngmesh.Copy()  # spaces on a mesh that is refined would change with it
    raw.Refine()
    mesh = Mesh(raw)
    mesh.Curve(domain.sizes.order)
    elements = np.array([[v.nr for v in element.vertices] for element in mesh.Elements(VOL)])
    cut = Cut(elements, Facets(mesh, mesh.Boundaries("shell")).corners)
    rims = cut.rim_vertices, cut.rim_edges
    return Domain(mesh, domain.reduction, domain.shape, domain.sizes, domain.face_numbers, *rims)


@pytest.mark.parametrize(
    ("shape", "reduction", "planes", "order"),
    [pytest.param(*rate, marks=pytest.mark.slow) if rate[1] == "3d" and rate[3] == 3 else rate for rate in RATES],
)
def test_curved_shells_have_the_best_order(shape: Shape, reduction: Name, planes: tuple[str, ...], order: int) -> None:
    """The gradient of order k, the potential of order k + 1."""
    domain = domain_of(shape, reduction, planes, 0.4 if reduction == "3d" else 0.2, order)
    errors = []
    for level in range(3):
        domain = refined(domain) if level else domain
        top, below = (spheres if shape.closed else caps)(domain)
        two = TwoSided(domain, order, top, below, (by_material if shape.closed else by_place)(domain))
        two.solve()
        errors.append(two.errors())
    potential, gradient = (math.log2(a / b) for a, b in zip(errors[1], errors[2], strict=True))
    assert gradient > order - 0.2
    assert potential > order + 0.8
