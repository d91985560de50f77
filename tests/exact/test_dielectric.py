"""Dielectric films, balloons and tubes: published numbers, energies, thin limits."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from scipy.integrate import quad
from scipy.optimize import minimize

from problems.exact import cylinder, sphere
from problems.exact.dielectric_balloon import DielectricBalloon
from problems.exact.dielectric_film import DielectricFilm
from problems.exact.dielectric_shell import DielectricShell
from problems.exact.dielectric_tube import DielectricTube
from problems.exact.material import Gent, MooneyRivlin, neo_hookean


def test_film_published_numbers() -> None:
    """X. Zhao, Z. Suo, Appl. Phys. Lett. 91 (2007) 061921: about 1.26 and 0.69; here to the digits of the formula."""
    film = DielectricFilm()
    table = {1.0: 0.0, 1.02: 0.3281438862, 1.1: 0.5999490818, 1.3: 0.6849281001, 2.0: 0.4960783708}
    assert [film.voltage(x) for x in table] == pytest.approx(list(table.values()), abs=1e-10)
    assert film.true_field(1.3) == pytest.approx(1.157528489, abs=1e-9)
    limit = film.pull_in()
    assert limit is not None
    assert limit.stretch == pytest.approx(2.0 ** (1.0 / 3.0), abs=1e-12)
    assert limit.load == pytest.approx(0.687364818499, abs=1e-12)
    assert film.true_field(limit.stretch) == pytest.approx(1.0911236359717, abs=1e-12)


@pytest.mark.parametrize(
    ("load", "start", "stretch", "voltage"),
    [
        (0.2, 1.036380476, 1.315464291, 0.6152247497),
        (1.0, 1.285199033, 1.746300423, 0.3585747898),
        (3.0, 3.004087307, 4.502162496, 0.128276926),
    ],
)
def test_prestressed_film(load: float, start: float, stretch: float, voltage: float) -> None:
    """The same paper: a dead load puts pull-in off to larger stretches and lower voltages."""
    film = DielectricFilm(load=load)
    assert film.unelectrified == pytest.approx(start, abs=1e-9)
    limit = film.pull_in()
    assert limit is not None
    assert limit.load == pytest.approx(voltage, abs=1e-9)
    assert limit.stretch == pytest.approx(stretch, abs=2e-8)  # the maximum is flat: the known stretch is worth less
    assert film.voltage(limit.stretch * 1.001) < limit.load > film.voltage(limit.stretch * 0.999)


FILMS = [
    DielectricFilm(0.5, neo_hookean(2.0), 3.0),
    DielectricFilm(0.5, MooneyRivlin(0.4, 0.1), 3.0, 0.2),
    DielectricFilm(0.5, neo_hookean(2.0), 3.0, 0.4, 1.5),
]


@pytest.mark.parametrize("film", FILMS)
def test_film_minimises_its_energy_at_held_charge(film: DielectricFilm) -> None:
    """Both stretches free; past the pull-in stretch as well."""
    charge = film.charge(1.5)

    def energy(s: list[float]) -> float:
        l1, l2 = (s[0], s[1]) if film.width is None else (s[0], film.width)
        work = film.load * (l1 + (l2 if film.width is None else 0.0))
        return film.law.energy(l1, l2) + charge**2 / (2.0 * film.permittivity * (l1 * l2) ** 2) - work

    start = [1.4, 1.6] if film.width is None else [1.4]
    found = minimize(energy, start, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-15})
    assert found.x == pytest.approx([1.5] * len(start), abs=2e-7)
    assert film.stretch_at_charge(charge) == pytest.approx(1.5, abs=1e-12)


@pytest.mark.parametrize("film", FILMS)
def test_film_round_trip(film: DielectricFilm) -> None:
    stretch = film.unelectrified + 0.1
    assert film.stretch(film.voltage(stretch)) == pytest.approx(stretch, abs=1e-12)
    with pytest.raises(ValueError, match="alone stretches"):
        film.voltage(0.9 * film.unelectrified)


def test_held_width_has_no_pull_in() -> None:
    film = DielectricFilm(width=2.0)
    assert film.pull_in() is None
    assert film.voltage(50.0) == pytest.approx(0.5, abs=1e-6) and film.voltage(50.0) < 0.5
    free = DielectricFilm()
    with pytest.raises(ValueError, match="pull-in"):
        free.stretch(0.69)


def test_stiffening_film_comes_back() -> None:
    """Gent with a near limit has no pull-in: the voltage goes on rising."""
    assert DielectricFilm(law=Gent(1.0, 1.0)).pull_in() is None


def test_balloon_published_numbers() -> None:
    """Thin balloon of Zhu, Cai and Suo (2010), and its limit points."""
    balloon = DielectricBalloon(thickness=0.01, theory="membrane")
    for load, stretch, pressure in [(0.1, 1.1, 0.5718655817), (0.2, 2.0, 0.184375), (0.3, 1.5, 0.3162780064)]:
        voltage = 0.01 * math.sqrt(load)
        assert balloon.pressure(stretch, voltage) / 0.01 == pytest.approx(pressure, abs=1e-10)
    limit = balloon.pressure_limit(0.3 * 0.01)
    assert limit is not None
    assert (limit.stretch, limit.load / 0.02) == pytest.approx((1.34858204502, 0.496876920694), abs=1e-11)
    limit = balloon.pull_in(0.2 * 0.02)
    assert limit is not None
    assert (limit.stretch, limit.load / 0.01) == pytest.approx((1.28924066670, 0.561681678090), abs=1e-11)


SHELLS: list[DielectricShell] = [
    DielectricBalloon(0.7, 0.2, MooneyRivlin(0.4, 0.1), 2.0, 0.5),
    DielectricBalloon(0.7, 0.2, neo_hookean(), 2.0, 0.5, 2.5, "membrane"),
    DielectricTube(0.7, 0.2, MooneyRivlin(0.4, 0.1), 2.0, 0.5, 2.5),
    DielectricTube(0.7, 0.2, neo_hookean(), 2.0, 0.5, 2.5, "membrane"),
]


@pytest.mark.parametrize("shell", SHELLS)
def test_pressure_is_the_derivative_of_the_energy(shell: DielectricShell) -> None:
    """Work of both voltage sources and of the pressure against the energy of wall, outer field and elasticity."""
    voltage, outer, step = 0.08, 0.1, 1e-5

    def fields(stretch: float) -> float:
        wall = 0.5 * voltage**2 * shell.capacitance(stretch)
        return wall + 0.5 * outer * shell.conductor.charge(stretch, outer)

    def volume(face: float) -> float:
        return 4.0 * math.pi / 3.0 * face**3 if isinstance(shell, DielectricBalloon) else math.pi * face**2

    elastic = shell.pressure(1.3)
    pull = elastic - shell.pressure(1.3, voltage, outer)
    middle = [shell.radius * (1.3 + sign * step) for sign in (1, -1)]
    work = pull * (volume(middle[0]) - volume(middle[1]))
    assert work == pytest.approx(fields(1.3 + step) - fields(1.3 - step), rel=1e-8)


@pytest.mark.parametrize("shell", SHELLS)
@pytest.mark.parametrize("pressure", [-0.02, 0.03])
def test_shell_round_trip(shell: DielectricShell, pressure: float) -> None:
    voltage = shell.voltage(1.12, pressure)
    assert shell.stretch(voltage, pressure) == pytest.approx(1.12, abs=1e-12)
    wall = shell.charges(1.12, voltage)[1]
    assert shell.pressure_at_charge(1.12, wall) == pytest.approx(pressure, abs=1e-14)
    limit = shell.pull_in(pressure)
    if limit is not None:
        for nearby in (0.99, 0.999, 1.001, 1.01):
            assert shell.voltage(nearby * limit.stretch, pressure) < limit.load


@pytest.mark.parametrize("shell", [s for s in SHELLS if s.theory == "thick"])
def test_thick_wall_by_quadrature(shell: DielectricShell) -> None:
    """Radial equilibrium of the total stress, elastic and Maxwell together, particle by particle."""
    stretch, voltage = 1.2, 0.08
    dimension = 3 if isinstance(shell, DielectricBalloon) else 2
    inner, outer = shell.face_radii(stretch)

    def power(r: float) -> float:
        return r ** (1 - dimension)

    k = voltage / quad(power, inner, outer)[0]
    added = shell.radius**dimension * (stretch**dimension - 1.0)

    def rate(r: float) -> float:
        hoop = r / (r**dimension - added) ** (1.0 / dimension)
        thin = hoop ** (1 - dimension)
        total = shell.law.stress_difference(hoop, thin) - shell.permittivity * (k * power(r)) ** 2
        return (dimension - 1) * total / r

    assert shell.pressure(stretch, voltage) == pytest.approx(quad(rate, inner, outer)[0], rel=1e-9)


@pytest.mark.parametrize("kind", [DielectricBalloon, DielectricTube])
def test_thick_wall_approaches_the_membrane_at_second_order(kind: type[DielectricShell]) -> None:
    def error(thickness: float) -> float:
        thick = kind(1.0, thickness)
        membrane = replace(thick, theory="membrane")
        voltage = 0.5 * thickness
        return thick.pressure(1.3, voltage) / membrane.pressure(1.3, voltage) - 1.0

    assert error(0.04) / error(0.02) == pytest.approx(4.0, rel=0.02)


def test_own_charge_of_the_outer_electrode() -> None:
    """Equal charge on both electrodes but opposite: nothing outside. Else the pull of a conductor adds."""
    balloon = DielectricBalloon(vacuum=0.5)
    assert sum(balloon.charges(1.2, 0.03)) == 0.0
    total = sum(balloon.charges(1.2, 0.03, 0.2))
    face = balloon.face_radii(1.2)[1]
    assert total == pytest.approx(4.0 * math.pi * 0.5 * face * 0.2)
    pull = balloon.pressure(1.2, 0.03) - balloon.pressure(1.2, 0.03, 0.2)
    assert pull == pytest.approx(0.25 * (total / (4.0 * math.pi * 0.5 * face**2)) ** 2)


def test_without_voltage_only_the_elastic_pressure_is_left() -> None:
    assert DielectricBalloon().pressure(1.3) == sphere.thick_pressure(1.3, 0.1)
    assert DielectricTube().pressure(1.3) == cylinder.thick_pressure(1.3, 0.1)
    with pytest.raises(ValueError, match="ground"):
        DielectricTube().pressure(1.1, 0.0, 0.1)
