"""Charged balloon and tube: published numbers, and balance of the energy at held voltage."""

from __future__ import annotations

import math

import pytest

from problems.exact import cylinder, sphere
from problems.exact.charged_balloon import ChargedBalloon
from problems.exact.charged_shell import ChargedShell, Theory
from problems.exact.charged_tube import ChargedTube
from problems.exact.material import Law, mooney_rivlin, neo_hookean


def load(balloon: ChargedBalloon, voltage: float) -> float:
    """w = eps V^2 / (4 mu T R)."""
    modulus = balloon.law.shear_modulus
    return balloon.permittivity * voltage**2 / (4.0 * modulus * balloon.thickness * balloon.radius)


def test_membrane_in_free_space() -> None:
    balloon = ChargedBalloon(0.3, 0.01, neo_hookean(2.0), 5.0, theory="membrane")
    assert load(balloon, balloon.voltage(1.2)) == pytest.approx(0.798122427984, abs=1e-12)
    assert balloon.pull_in() is None
    voltage = balloon.voltage(1.2)
    for stretch in (1.1, 1.5):  # at fixed charge, chi = l^3 - l^-3
        ratio = balloon.charge(stretch, balloon.voltage(stretch)) / balloon.charge(1.2, voltage)
        chi = (stretch**3 - stretch**-3) / (1.2**3 - 1.2**-3)
        assert ratio**2 == pytest.approx(chi, rel=1e-12)


def test_balloon_under_pressure_and_voltage() -> None:
    """p R / (mu T) = 2 (l^-1 - l^-7) - eps V^2 / (2 mu T R l^2) (Green and Adkins, with Maxwell's pull), ten digits."""
    balloon = ChargedBalloon(thickness=0.01, theory="membrane")
    for load_, stretch, pressure in [(0.2, 1.1, 0.7092209536), (0.5, 1.3, 1.071799912), (1.0, 1.02, -0.2609204341)]:
        assert balloon.pressure(stretch, math.sqrt(0.01 * load_)) / 0.01 == pytest.approx(pressure, abs=1e-9)
    for stretch, voltage in [(1.01, 0.2341372496), (1.5, 5.473251029), (3.0, 11.98353909)]:
        assert balloon.voltage(stretch) ** 2 / 0.01 == pytest.approx(voltage, abs=1e-8)


def test_pressure_limit_at_voltage() -> None:
    balloon = ChargedBalloon(thickness=0.01, theory="membrane")
    limit = balloon.pressure_limit(math.sqrt(0.3 * 4.0 * 0.01))
    assert limit is not None
    assert limit.stretch == pytest.approx(1.50539895499, abs=1e-11)
    assert limit.load / (2.0 * 0.01) == pytest.approx(0.474823005576, abs=1e-11)


@pytest.mark.parametrize(
    ("ground", "stretch", "w"),
    [(4.0, 1.61644100288, 0.541797260201), (2.0, 1.24062015991, 0.129800486547)],
)
def test_pull_in_inside_a_grounded_sphere(ground: float, stretch: float, w: float) -> None:
    balloon = ChargedBalloon(thickness=0.01, outer_radius=ground, theory="membrane")
    limit = balloon.pull_in()
    assert limit is not None
    assert limit.stretch == pytest.approx(stretch, abs=1e-11)
    assert load(balloon, limit.load) == pytest.approx(w, abs=1e-11)
    with pytest.raises(ValueError, match="pull-in voltage"):
        balloon.stretch(1.001 * limit.load)


def test_membrane_inside_a_grounded_sphere() -> None:
    balloon = ChargedBalloon(thickness=0.01, outer_radius=4.0, theory="membrane")
    assert load(balloon, balloon.voltage(1.2)) == pytest.approx(0.391079989712, abs=1e-12)


SHELLS: list[ChargedShell] = [
    ChargedBalloon(0.7, 0.2, mooney_rivlin(0.4, 0.1), 2.0),
    ChargedBalloon(0.7, 0.2, neo_hookean(), 2.0, 2.5),
    ChargedBalloon(0.7, 0.2, neo_hookean(), 2.0, 2.5, "membrane"),
    ChargedTube(0.7, 0.2, mooney_rivlin(0.4, 0.1), 2.0, 2.5),
    ChargedTube(0.7, 0.2, neo_hookean(), 2.0, 2.5, "membrane"),
]


@pytest.mark.parametrize("shell", SHELLS)
@pytest.mark.parametrize("pressure", [-0.02, 0.0, 0.03])
def test_round_trip(shell: ChargedShell, pressure: float) -> None:
    voltage = shell.voltage(1.15, pressure)
    assert shell.stretch(voltage, pressure) == pytest.approx(1.15, abs=1e-12)
    assert shell.pressure(1.15, voltage) == pytest.approx(pressure, abs=1e-14)
    p_t, p_b = shell.face_pressures(1.15, voltage, pressure)
    assert p_b == pressure
    assert p_t == pytest.approx(-0.5 * shell.permittivity * shell.field(1.15, voltage) ** 2)


@pytest.mark.parametrize("shell", SHELLS)
def test_pull_of_the_field_is_the_derivative_of_the_energy(shell: ChargedShell) -> None:
    """Work of -p_t on the moving face = change of Q V / 2 at held voltage."""
    voltage, step = 0.3, 1e-5

    def energy(stretch: float) -> float:
        return 0.5 * voltage * shell.charge(stretch, voltage)

    def volume(stretch: float) -> float:
        face = shell.face_radius(stretch)
        return 4.0 * math.pi / 3.0 * face**3 if isinstance(shell, ChargedBalloon) else math.pi * face**2

    pull = -shell.face_pressures(1.3, voltage)[0]
    work = pull * (volume(1.3 + step) - volume(1.3 - step))
    assert work == pytest.approx(energy(1.3 + step) - energy(1.3 - step), rel=1e-8)


@pytest.mark.parametrize("law", [neo_hookean(), mooney_rivlin(0.4, 0.1)])
@pytest.mark.parametrize("ground", [math.inf, 3.0])
def test_thick_balloon_approaches_the_membrane_at_first_order(law: Law, ground: float) -> None:
    def error(thickness: float) -> float:
        thick = ChargedBalloon(1.0, thickness, law, 1.0, ground)
        membrane = ChargedBalloon(1.0, thickness, law, 1.0, ground, "membrane")
        return thick.voltage(1.2) / membrane.voltage(1.2) - 1.0

    assert error(0.02) / error(0.01) == pytest.approx(2.0, rel=0.02)


@pytest.mark.parametrize("shell", [s for s in SHELLS if math.isfinite(s.outer_radius)])
def test_pull_in_is_the_largest_voltage(shell: ChargedShell) -> None:
    limit = shell.pull_in(0.01)
    assert limit is not None
    for nearby in (0.99, 0.999, 1.001, 1.01):
        assert shell.voltage(nearby * limit.stretch, 0.01) < limit.load


@pytest.mark.parametrize("theory", ["membrane", "thick"])
def test_without_voltage_only_the_elastic_pressure_is_left(theory: Theory) -> None:
    balloon = ChargedBalloon(theory=theory)
    assert balloon.pressure(1.3) == sphere.PRESSURES[theory][0](1.3, 0.1, None)
    assert balloon.stretch(0.0, 0.05) == pytest.approx(sphere.stretch_at(0.05, 0.1, None, theory))
    tube = ChargedTube(outer_radius=3.0, theory="thick")
    assert tube.pressure(1.3) == cylinder.thick_pressure(1.3, 0.1)


def test_bad_input_is_refused() -> None:
    with pytest.raises(ValueError, match="outer_radius"):
        ChargedTube()
    with pytest.raises(ValueError, match="outer face"):
        ChargedBalloon(outer_radius=1.02)
    with pytest.raises(ValueError, match="alone stretches"):
        ChargedBalloon().voltage(1.01, 0.1)
    with pytest.raises(ValueError, match="exceeds the limit"):
        ChargedBalloon().stretch(0.1, 0.2)
