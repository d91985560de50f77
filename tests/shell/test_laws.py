"""Hyperelastic laws: energies against numpy, the scaling of a scene's material, gradients and Hessians."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from ngsolve import BND, CF, BilinearForm, GridFunction, Variation

from embedding import Gent, MooneyRivlin, NeoHookean, Ogden, StrainEnergy, StVenantKirchhoff, Yeoh
from embedding.geometry.domain import Domain
from embedding.geometry.spaces import TraceSpace, plane_mask
from embedding.scene import parse_expression
from embedding.shell.kinematics import Kinematics
from embedding.shell.laws import GentLaw, KoiterLaw, Law, MooneyRivlinLaw, OgdenLaw, StrainEnergyLaw, YeohLaw, law_of
from tests.forms import BODIES, Taylor, body, close_to, random_directions, set_on_shell, smooth

LAWS: dict[str, Law] = {
    "neo-hookean": MooneyRivlinLaw(0.5),
    "mooney-rivlin": MooneyRivlinLaw(0.4, 0.1),
    "yeoh": YeohLaw(0.5, -0.02, 0.003),
    "gent": GentLaw(1.0, 20.0),
    "ogden": OgdenLaw((1.2, 0.01, -0.2), (1.3, 5.0, -2.0)),
    "st-venant-kirchhoff": KoiterLaw(2.6, 0.3),
    "strain-energy": StrainEnergyLaw(
        parse_expression("0.8*I1 + 0.48*log(I2) + 0.4*exp(0.1*(I1 - 3))", ("I1", "I2")), 0.5
    ),
}
EACH = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
NAMES = [name for name, law in LAWS.items() if law.incompressible]
EACH_INCOMPRESSIBLE = pytest.mark.parametrize("law", [LAWS[name] for name in NAMES], ids=NAMES)


class Stretched:
    """What a law asks of kinematics, for two principal stretches; with ``hoop`` as a reduction shows them."""

    def __init__(self, first: float, second: float, hoop: bool = False) -> None:
        self.dimension, self.hoop = (2, second) if hoop else (3, 1.0)
        self.surface_stretch_squared = (first * second) ** 2
        self.metric_trace = first**2 + second**2
        across = 1 / self.surface_stretch_squared
        self.excess = self.metric_trace + across - 3
        self.second_excess = self.surface_stretch_squared + self.metric_trace * across - 3
        self.hoop_strain = 0.5 * (self.hoop**2 - 1)
        shown = (first, 1.0 if hoop else second)
        self.strain = CF((0.5 * (shown[0] ** 2 - 1), 0, 0, 0.5 * (shown[1] ** 2 - 1)), dims=(2, 2))


def number(value: Any, point: Any) -> float:
    """A law's answer, a number or a coefficient function that is the same everywhere, as a number."""
    return float(CF(value)(point))


@pytest.fixture(scope="module")
def point() -> Iterator[Any]:
    mesh = body("plate").mesh  # must live as long as the point
    yield mesh(0.1, 0.1, 0.0, BND)


def density(law: Law, first: float, second: float) -> float:
    """Energy by numpy, from the definitions of the laws."""
    third = 1 / (first * second)
    stretches = np.array([first, second, third])
    x = (stretches**2).sum() - 3
    match law:
        case MooneyRivlinLaw():
            return float(law.c1 * x + law.c2 * ((stretches**-2.0).sum() - 3))
        case YeohLaw():
            return float(law.c1 * x + law.c2 * x**2 + law.c3 * x**3)
        case GentLaw():
            return float(-law.shear_modulus * law.limit / 2 * np.log(1 - x / law.limit))
        case OgdenLaw():
            pairs = zip(law.moduli, law.exponents, strict=True)
            return float(sum(mu / alpha * ((stretches**alpha).sum() - 3) for mu, alpha in pairs))
        case StrainEnergyLaw():
            return float(0.4 * x + 0.24 * np.log((stretches**-2.0).sum() / 3) + 0.2 * (np.exp(0.1 * x) - 1))
        case KoiterLaw():
            strain, nu = (stretches[:2] ** 2 - 1) / 2, law.poisson
            stress = law.youngs / (1 - nu**2) * np.array([[1, nu], [nu, 1]]) @ strain
            return float(stress @ strain / 2)
    raise NotImplementedError


STRETCHES = ((1.0, 1.0), (1.3, 0.9), (2.0, 1.7), (0.6, 2.1), (1.5, 1.5), (1.5, 1.5001))


@EACH
@pytest.mark.parametrize("hoop", [False, True])
def test_energy_of_principal_stretches(law: Law, hoop: bool, point: Any) -> None:
    for first, second in STRETCHES:
        found = number(law.energy(Stretched(first, second, hoop)), point)  # type: ignore[arg-type]
        assert found == pytest.approx(density(law, first, second), rel=1e-13, abs=1e-14)


@EACH
def test_rest_is_the_only_minimum_nearby(law: Law) -> None:
    """Zero and stationary at rest; for small strains W = mu (e_1^2 + e_2^2 + nu / (1 - nu) (e_1 + e_2)^2), mu = 1."""
    coupling = law.poisson / (1 - law.poisson) if isinstance(law, KoiterLaw) else 1.0
    mu, h = 2 * MooneyRivlinLaw(0.5).c1, 1e-3
    mu = {"ogden": 0.5 * (1.2 * 1.3 + 0.01 * 5 + 0.2 * 2)}.get(next(n for n, w in LAWS.items() if w is law), mu)

    def second_derivative(a: float, b: float) -> float:
        return (density(law, 1 + a * h, 1 + b * h) + density(law, 1 - a * h, 1 - b * h)) / h**2

    assert density(law, 1.0, 1.0) == pytest.approx(0.0, abs=1e-15)
    assert density(law, 1 + h, 1.0) - density(law, 1 - h, 1.0) == pytest.approx(0.0, abs=20 * mu * h**3)
    assert second_derivative(1, 1) == pytest.approx(mu * (4 + 8 * coupling), rel=1e-4)
    assert second_derivative(1, -1) == pytest.approx(4 * mu, rel=1e-4)


@EACH
def test_stresses_are_derivatives_of_the_energy(law: Law) -> None:
    """l_i dW/dl_i (over J_s for the law that is not incompressible), by central differences."""
    h = 1e-5
    for first, second in ((1.3, 0.9), (2.0, 1.7), (1.2, 1.2)):
        found = law.principal_stresses(first, second)
        along = first * (density(law, first + h, second) - density(law, first - h, second)) / (2 * h)
        across = second * (density(law, first, second + h) - density(law, first, second - h)) / (2 * h)
        area = 1.0 if law.incompressible else first * second
        assert found == pytest.approx((along / area, across / area), rel=1e-7)
    assert law.principal_stresses(1.0, 1.0) == pytest.approx((0.0, 0.0), abs=1e-15)
    rows = law.principal_stresses(np.array([1.3, 2.0]), np.array([0.9, 1.7]))
    assert rows[0][1] == pytest.approx(law.principal_stresses(2.0, 1.7)[0])


@EACH_INCOMPRESSIBLE
@pytest.mark.parametrize("hoop", [False, True])
def test_bending_modulus(law: Any, hoop: bool, point: Any) -> None:
    """The mean over pairs, from the stresses; three different stretches, so that no pair is singular."""
    for first, second in ((1.3, 0.9), (2.0, 1.7), (0.6, 2.1)):
        stretches = np.array([first, second, 1 / (first * second)])
        stresses = np.array([*law.principal_stresses(first, second), 0.0])
        pairs = ((0, 1), (0, 2), (1, 2))
        each = [(stresses[i] - stresses[j]) / (stretches[i] ** 2 - stretches[j] ** 2) for i, j in pairs]
        found = number(law.bending_modulus(Stretched(first, second, hoop)), point)
        # On a surface Ogden's law keeps the in-plane stretches apart by OgdenLaw's APART, 1e-7 of its modulus.
        assert found == pytest.approx(np.mean(each), rel=1e-7 if isinstance(law, OgdenLaw) and not hoop else 1e-12)


@EACH_INCOMPRESSIBLE
@pytest.mark.parametrize("hoop", [False, True])
def test_bending_modulus_where_stretches_are_equal(law: Any, hoop: bool, point: Any) -> None:
    """At rest the shear modulus; in uniaxial tension and on a balloon the limit of its neighbours."""

    def modulus(first: float, second: float) -> float:
        return number(law.bending_modulus(Stretched(first, second, hoop)), point)

    assert modulus(1.0, 1.0) == pytest.approx(law.principal_stresses(1 + 1e-6, 1)[0] / 4e-6, rel=1e-5)
    for first, second in ((1.44, 1 / 1.2), (1.5, 1.5), (0.7, 0.7)):
        around = modulus(first, second * 1.001) + modulus(first, second / 1.001)
        assert modulus(first, second) == pytest.approx(around / 2, rel=3e-6)


def test_ogden_holds_mooney_and_rivlin(point: Any) -> None:
    """mu = (2 c1, -2 c2), alpha = (2, -2)."""
    plain, general = MooneyRivlinLaw(0.4, 0.1), OgdenLaw((0.8, -0.2), (2.0, -2.0))
    for first, second in STRETCHES:
        stretched: Any = Stretched(first, second)
        energy, modulus = (number(f(stretched), point) for f in (general.energy, general.bending_modulus))
        assert energy == pytest.approx(plain.energy(stretched), rel=1e-14, abs=1e-14)
        assert modulus == pytest.approx(plain.bending_modulus(stretched), rel=1e-7)


def test_thickness(point: Any) -> None:
    """1 / J_s of an incompressible shell; by Poisson's ratio of the other, and at 1/2 the same for small strains."""
    stretched: Any = Stretched(1.001, 1.002)
    stretched.thickness_stretch = 1 / (1.001 * 1.002)
    assert LAWS["gent"].thickness_stretch(stretched) == stretched.thickness_stretch
    third = number(KoiterLaw(1.0, 0.25).thickness_stretch(stretched), point)
    assert third == pytest.approx(1 - (1.001**2 + 1.002**2 - 2) / 6, abs=1e-14)
    half = number(KoiterLaw(1.0, 0.5).thickness_stretch(stretched), point)
    assert half == pytest.approx(stretched.thickness_stretch, abs=1e-5)
    assert number(KoiterLaw(1.0, 0.25).thickness_stretch(Stretched(1.001, 1.002, True)), point) == third  # type: ignore[arg-type]


def test_a_material_in_units_of_a_stress() -> None:
    assert law_of(NeoHookean(shear_modulus=2e5), 2e5) == MooneyRivlinLaw(0.5, 0.0)
    assert law_of(NeoHookean(shear_modulus=2e5), 1e5) == MooneyRivlinLaw(1.0, 0.0)
    assert law_of(MooneyRivlin(c1=3e4, c2=1e4), 8e4) == MooneyRivlinLaw(0.375, 0.125)
    assert law_of(Yeoh(c1=3e4, c2=-1e3, c3=100), 1e4) == YeohLaw(3.0, -0.1, 0.01)
    assert law_of(Gent(shear_modulus=3e4, limit=50), 1e4) == GentLaw(3.0, 50.0)
    assert law_of(Ogden(moduli=(3e4, -2e4), exponents=(2, -1)), 1e4) == OgdenLaw((3.0, -2.0), (2.0, -1.0))
    assert law_of(StrainEnergy(expression="2*I1", unit="kPa"), 1e4).principal_stresses(1.5, 1.2) == pytest.approx(
        MooneyRivlinLaw(0.2).principal_stresses(1.5, 1.2)
    )
    assert law_of(StVenantKirchhoff(youngs_modulus=3e4, poisson_ratio=0.2), 1e4) == KoiterLaw(3.0, 0.2)


@pytest.mark.parametrize(
    "material",
    [
        NeoHookean(shear_modulus=2e5),
        MooneyRivlin(c1=8e4, c2=2e4),
        Yeoh(c1=1e5, c2=-1e3, c3=100),
        Gent(shear_modulus=2e5, limit=50),
        Ogden(moduli=(2e5, -1e5), exponents=(1.5, -0.5)),
        StrainEnergy(expression="100*I1 + 3*log(I2)", unit="kPa"),
        StVenantKirchhoff(youngs_modulus=5e5, poisson_ratio=0.25),
    ],
    ids=lambda material: material.law,
)
def test_the_shear_modulus_is_that_of_small_strains(material: Any) -> None:
    """In units of its own shear modulus, a pure shear of size e has the stress 2 e."""
    law, e = law_of(material, material.shear_modulus), 1e-6
    assert law.principal_stresses(1 + e, 1 - e) == pytest.approx((2 * e, -2 * e), rel=1e-5)


def energy_form(domain: Domain, law: Law) -> tuple[BilinearForm, Any, Any]:
    space = TraceSpace(domain.mesh, domain.sizes.order)
    if domain.reduction.name == "axisymmetric":
        space.fix(0, plane_mask(space.scalar, 0))
    trial = space.space.TrialFunction()
    form = BilinearForm(space.space)
    density = law.energy(Kinematics(domain.reduction, domain.normal, trial))
    form += Variation(domain.reduction.measure * density * domain.surface()).Compile()
    u = GridFunction(space.space)
    set_on_shell(u, smooth(domain), space.free, domain)
    return form, u, space.free


@EACH
@pytest.mark.parametrize("name", BODIES)
def test_gradient_and_hessian(name: str, law: Law) -> None:
    form, u, free = energy_form(body(name), law)
    taylor = Taylor(form, u.vec, random_directions(free, 0.01))
    assert close_to(taylor.gradient_orders(), 2)
    assert close_to(taylor.hessian_orders(), 3)
    assert close_to(taylor.tangent_orders(), 2)


@EACH
@pytest.mark.parametrize(
    ("part", "whole"),
    [
        ("quarter disc", "disc"),
        ("octant", "sphere"),
        ("quarter ring", "ring"),
        ("axisymmetric disc", "disc"),
        ("axisymmetric sphere", "sphere"),
    ],
)
def test_a_part_counts_for_the_whole(part: str, whole: str, law: Law) -> None:
    """Stretched to (1.3, 1.3, 0.8) times itself a mirrored part, or a meridian, has the energy of the whole body."""
    values = []
    for name in (part, whole):
        domain = body(name, size=0.3, order=4)
        form, u, free = energy_form(domain, law)
        place = domain.reduction.position
        across = (0.3,) if domain.reduction.name == "axisymmetric" else (0.3, 0.3)
        up = () if domain.reduction.name == "plane-strain" else (-0.2,)
        factors = (*across, *up)
        set_on_shell(u, CF(tuple(factor * place[i] for i, factor in enumerate(factors))), free, domain)
        values.append(form.Energy(u.vec))
    assert values[0] == pytest.approx(values[1], rel=1e-6)
    assert values[1] > 0.1
