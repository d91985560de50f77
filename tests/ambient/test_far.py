"""What lies beyond the outer boundary, around one conductor in open space: exact charges and dipole moments."""

from __future__ import annotations

import math

import pytest
from ngsolve import CF, H1, Grad, GridFunction, InnerProduct, Integrate, Norm, dx

from benchmarks.open_space import Request, answer, circle_answer, open_space, sphere_answer
from embedding import InfiniteCylinder, Sphere
from embedding.ambient.far import beyond, beyond_energy, far_field
from embedding.geometry.domain import Domain, MeshSizes, build
from embedding.geometry.reduction import Name, Reduction
from embedding.geometry.surroundings import REACH
from problems.exact.capacitance import disc

REDUCTIONS: tuple[Name, ...] = ("3d", "axisymmetric", "plane-strain")
DEGREES = {"3d": (0, 2), "axisymmetric": (0, 1, 2, 3), "plane-strain": (1, 2, 3)}
"""In the plane a charge has no zero at infinity, and no harmonic of degree 0 decays."""
HARMONICS = [(name, degree) for name in REDUCTIONS for degree in DEGREES[name]]
FIELD = 0.7
RADIUS = 2.0


def domain(name: Name, radius: float, order: int, *, mapped: bool = True, finer: float = 1.0) -> Domain:
    shell = (0.6 if name == "3d" else 0.3) / finer
    return open_space(Request(name, radius, order, "beyond" if mapped else "none", shell, 0.5 * radius / finer))


def along(name: Name, field: float) -> tuple[float, ...]:
    return (0.0, 0.0, field) if name == "3d" else (0.0, field)


def errors(
    name: Name, radius: float = RADIUS, order: int = 4, *, mapped: bool = True, finer: float = 1.0
) -> tuple[float, float]:
    """Relative errors of the charge (in the plane, where it is 0, over the dipole) and of the dipole moment of the
    conductor off the centre, at voltage 1 (plane 0), in a uniform field."""
    plane = name == "plane-strain"
    body = domain(name, radius, order, mapped=mapped, finer=finer)
    found = answer(body, far_field(body, along(name, FIELD), infinite=mapped).terms, 0.0 if plane else 1.0)
    charge, dipole = circle_answer(FIELD) if plane else sphere_answer(1.0, FIELD)
    return abs(found.charge - charge) / (charge or dipole), abs(found.dipole[-1] / dipole - 1)


@pytest.mark.parametrize(("name", "degree"), HARMONICS)
def test_decaying_harmonics(name: Name, degree: int) -> None:
    """(R / s)^{l+1} Y_l beyond R has the energy (l + 1) / 2R times the square of Y_l over the sphere; in the plane
    (R / s)^l Y_l and l / 2R."""
    coarse, fine = (_excess_of_harmonic(name, degree, finer) for finer in (1.0, 2.0))
    assert abs(fine) < 0.25 * abs(coarse)
    assert abs(fine) < (1e-6, 5e-5, 3e-4, 1e-3)[degree]


def _excess_of_harmonic(name: Name, degree: int, finer: float) -> float:
    """Zonal harmonics with the square 4 pi R^2 / (2 l + 1) over the sphere; in the plane sin(l theta), pi R."""
    body = domain(name, RADIUS, 4, finer=finer)
    place, r = body.reduction.position, Norm(body.reduction.position)
    w = (REACH * RADIUS - r) / ((REACH - 1) * RADIUS)
    if name == "plane-strain":
        a, b = place[0] / r, place[1] / r
        psi = w ** (degree - 1) * (b, 2 * a * b, 3 * a * a * b - b**3)[degree - 1]
        expected = 0.5 * degree * math.pi
    else:
        t = place[body.mesh.dim - 1] / r
        psi = w**degree * (CF(1.0), t, 1.5 * t * t - 0.5, 2.5 * t**3 - 1.5 * t)[degree]
        expected = 2 * math.pi * RADIUS * (degree + 1) / (2 * degree + 1)
    field = GridFunction(H1(body.mesh, order=4, definedon=body.mesh.Materials("beyond")))
    field.Set(psi, definedon=body.mesh.Materials("beyond"))
    energy = beyond_energy(body.reduction, field, Grad(field), RADIUS)
    return float(Integrate(energy * beyond(body), body.mesh)) / expected - 1


@pytest.mark.parametrize("mapped", [True, False])
@pytest.mark.parametrize("name", REDUCTIONS)
def test_a_uniform_field_passes(name: Name, mapped: bool) -> None:
    """The conductor at the potential of the applied field leaves it as it is: to rounding on a straight mesh."""
    body = domain(name, RADIUS, 3, mapped=mapped)
    body.mesh.Curve(1)
    applied = along(name, FIELD)
    uniform = -InnerProduct(CF(applied), body.reduction.position)
    found = answer(body, far_field(body, applied, infinite=mapped).terms, uniform)
    assert Integrate((found.potential - uniform) ** 2 * dx("outside"), body.mesh) < 1e-24
    assert abs(found.charge) < 1e-12


@pytest.mark.parametrize("name", [pytest.param("3d", marks=pytest.mark.slow), *REDUCTIONS[1:]])
def test_the_error_falls_with_the_order(name: Name) -> None:
    """Charge and dipole moment of the conductor off the centre: nothing but discretisation is left."""
    second, third, fourth = (errors(name, order=order) for order in (2, 3, 4))
    assert second[1] > 5 * third[1] > 25 * fourth[1]
    assert fourth[0] < 3e-6
    assert fourth[1] < (1e-4 if name == "3d" else 5e-6)


@pytest.mark.parametrize("name", ["axisymmetric", "plane-strain"])
def test_the_error_falls_with_the_size(name: Name) -> None:
    """Functionals of the field converge with twice the order, 6; half way there on meshes this coarse."""
    coarse, fine = (errors(name, order=3, finer=finer)[1] for finer in (1.0, 2.0))
    assert math.log2(coarse / fine) > 3.5


@pytest.mark.parametrize("name", ["axisymmetric", "plane-strain"])
def test_the_radius_is_felt_by_robin_alone(name: Name) -> None:
    """Robin's condition misses the first harmonic after those that it has: degree 2 (plane 3). Its part of the dipole
    moment falls with the radius to the 2 l + 1 (plane 2 l)."""
    near, far = (errors(name, radius, mapped=False, finer=2.0)[1] for radius in (1.6, 2.0))
    assert near > 3e-4
    assert math.log(near / far) / math.log(2.0 / 1.6) == pytest.approx(5 if name == "axisymmetric" else 6, abs=0.7)
    for radius in (1.6, 2.0, 4.0):
        assert errors(name, radius, finer=2.0)[1] < 2e-6


@pytest.mark.parametrize("radius", [1.5, 2.0])
def test_capacitance_of_a_disc(radius: float) -> None:
    """8 R, whatever the radius of the ball; the rim's singularity leaves about the element size there."""
    for rim in (1e-3, 1e-4):
        body = open_space(Request("axisymmetric", radius, 4, "beyond", 0.3, 0.5 * radius, rim))
        found = answer(body, far_field(body, (0.0, 0.0), infinite=True).terms, 1.0)
        assert found.charge / disc(1.0) - 1 == pytest.approx(0.0, abs=rim)


@pytest.mark.parametrize(
    "reduction",
    [Reduction("3d", ("x", "y")), Reduction("axisymmetric"), Reduction("plane-strain")],
    ids=lambda reduction: reduction.name,
)
def test_on_the_mesh_of_a_shell(reduction: Reduction) -> None:
    """A shell in a uniform field, in 3D between mirror planes that cut the mapped region. Solid elements of order 3 and
    size 0.4 miss the sphere's surface by 1e-4 of its volume."""
    plane, solid = reduction.name == "plane-strain", reduction.name == "3d"
    shape = InfiniteCylinder(radius=1.0) if plane else Sphere(radius=1.0)
    body = build(shape, reduction, MeshSizes(0.4 if solid else 0.2, 1.0, 2.0, 0.3, 3, beyond=True))
    far = far_field(body, along(reduction.name, FIELD), infinite=True)
    found = answer(body, far.terms, 0.0 if plane else 1.0)
    charge, dipole = 0.0 if plane else 4 * math.pi, (2 if plane else 4) * math.pi * FIELD
    assert found.charge == pytest.approx(charge, rel=5e-5 if solid else 5e-6, abs=1e-5)
    assert found.dipole[-1] == pytest.approx(dipole, rel=3e-4 if solid else 2e-6)
