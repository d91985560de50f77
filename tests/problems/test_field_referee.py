"""Identities of a field that no solver is needed for: units, reciprocity, images, forces that must balance."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import pytest

from embedding import Scene, solve

EPSILON, MU = 8.8541878128e-12, 1.25663706212e-6
RADIUS, THICKNESS = 20e-3, 1e-3
TOP, BOTTOM = RADIUS + THICKNESS / 2, RADIUS - THICKNESS / 2
"""Radii of the faces in m."""
HELD = {"where": "surface", "fix": ["x", "y", "z"]}


def scalars(shell: Mapping[str, Any], ambient: Mapping[str, Any], **more: Any) -> dict[str, float]:
    """The end of one step of a sphere in a field, held everywhere unless ``more`` has other supports."""
    sphere = {"kind": "sphere", "radius": RADIUS}
    soft = {"law": "neo-hookean", "shear_modulus": "30 kPa"}
    whole = {"shape": sphere, "thickness": THICKNESS, "material": soft} | dict(shell)
    stated: dict[str, Any] = {"supports": [HELD], "path": [{"steps": 1}]} | more
    return solve(Scene(name="referee", shell=whole, ambient=ambient, **stated)).steps[-1].scalars


def image_capacitance(distance: float) -> float:
    """Of a sphere of radius ``TOP`` whose centre is ``distance`` from a grounded plane (Maxwell's images), F."""
    angle = math.acosh(distance / TOP)
    terms = sum(1 / math.sinh(number * angle) for number in range(1, 200))
    return 4 * math.pi * EPSILON * TOP * math.sinh(angle) * terms


def test_two_charged_spheres_are_a_sphere_and_its_image() -> None:
    """Opposite voltages: charge and force from Maxwell's series, whichever of voltage and charge is given."""
    half, step = 30e-3, 1e-7
    slope = (image_capacitance(half + step) - image_capacitance(half - step)) / (2 * step)
    charge, force = 5000 * image_capacitance(half), 0.5 * 5000**2 * slope
    place = {"kind": "sphere", "centre": [0, 0, -2 * half], "radius": TOP}

    def pair(kind: str, value: float) -> dict[str, float]:
        ambient = {"field": "electric", "bodies": [place | {kind: -value}]}
        return scalars({}, ambient, faces={"both": {kind: value}})

    for found in (pair("voltage", 5000.0), pair("charge", charge)):
        assert found["charge"] == pytest.approx(charge, rel=1e-4)
        assert found["voltage"] == pytest.approx(5000.0, rel=1e-4)
        assert found["force_z"] == pytest.approx(force, rel=5e-4)
        assert found["force_body0_z"] == pytest.approx(-force, rel=5e-4)


def test_charges_and_voltages_of_both_faces_answer_each_other() -> None:
    """The same state, whichever of the four numbers are given."""
    shell, ambient = {"relative_permittivity": 3.0}, {"field": "electric"}
    first = scalars(shell, ambient, faces={"top": {"voltage": 5000.0}, "bottom": {"voltage": 0.0}})
    top, both = first["charge_jump"], first["charge"]
    for faces in (
        {"top": {"charge": top}, "bottom": {"charge": both - top}},
        {"top": {"charge": top}, "bottom": {"voltage": 0.0}},
        {"top": {"voltage": 5000.0}, "bottom": {"charge": both - top}},
    ):
        found = scalars(shell, ambient, faces=faces)
        assert abs(found["voltage_jump"]) == pytest.approx(5000.0, rel=1e-8)
        assert found["pressure_top"] == pytest.approx(first["pressure_top"], rel=1e-8)
        assert found["field_energy"] == pytest.approx(first["field_energy"], rel=1e-8)


def test_charge_in_a_field_is_pulled_by_their_product() -> None:
    """In whatever liquid: the field is given, not the flux (the pull on a free charge Q is Q E)."""
    for liquid in (1.0, 2.0):
        ambient = {"field": "electric", "applied_field": [0, 0, 1e5], "relative_permittivity": liquid}
        found = scalars({}, ambient, faces={"both": {"charge": 1e-8}})
        assert found["force_z"] == pytest.approx(1e-3, rel=1e-5)
        assert found["voltage"] == pytest.approx(1e-8 / (4 * math.pi * liquid * EPSILON * TOP), rel=1e-4)


def test_two_magnetised_balls_are_dipoles() -> None:
    """Uniformly magnetised balls and spherical shells are dipoles to each other at any distance."""
    magnet = {"kind": "sphere", "centre": [0, 0, 0.08], "radius": 0.01, "remanence": [0, 0, 0.1]}
    found = scalars({"remanence": [0, 0, 0.1]}, {"field": "magnetic", "bodies": [magnet]})
    moments = [0.1 / MU * 4 / 3 * math.pi * cubes for cubes in (TOP**3 - BOTTOM**3, 0.01**3)]
    force = 6 * MU * moments[0] * moments[1] / (4 * math.pi * 0.08**4)
    assert found["force_z"] == pytest.approx(force, rel=1e-3)
    assert found["force_body0_z"] == pytest.approx(-force, rel=1e-3)


def test_saturation_lies_between_linear_and_nothing() -> None:
    """Far from its limit the shell is linear, far beyond it it is transparent."""
    ambient = {"field": "magnetic", "applied_field": [0, 0, 4e4]}

    def tops(**shell: float) -> float:
        return scalars(shell, ambient)["pressure_top"]

    linear = tops(relative_permeability=50.0)
    assert tops(relative_permeability=50.0, saturation=1e3) == pytest.approx(linear, rel=1e-5)
    # A transparent sphere feels Maxwell's stress of the uniform field: mean pressure mu0 H^2 / 6.
    assert tops(relative_permeability=50.0, saturation=1e-6) == pytest.approx(MU * 4e4**2 / 6, rel=1e-3)


def test_only_ratios_count() -> None:
    """A thousand times smaller and stiffer, in a field that is stronger by the root of it."""
    free: dict[str, Any] = {"supports": []}
    shell, field = {"relative_permeability": 5.0}, 4e4
    large = scalars(
        shell, {"field": "magnetic", "applied_field": [0, 0, field]}, loads={"pressure_bottom": 600.0}, **free
    )
    tiny = shell | {
        "shape": {"kind": "sphere", "radius": "20 um"},
        "thickness": "1 um",
        "material": {"law": "neo-hookean", "shear_modulus": "30 MPa"},
    }
    strong = {"field": "magnetic", "applied_field": [0, 0, field * math.sqrt(1e3)]}
    small = scalars(tiny, strong, loads={"pressure_bottom": "0.6 MPa"}, **free)
    assert small["displacement"] == pytest.approx(1e-3 * large["displacement"], rel=1e-6)
    assert small["pressure_top"] == pytest.approx(1e3 * large["pressure_top"], rel=1e-6)


def test_field_that_is_written_as_an_expression_moves_the_shell_alike() -> None:
    """The same uniform field, as a vector and as an expression: two formulations, one motion, in a liquid as well."""
    free: dict[str, Any] = {"supports": [], "loads": {"pressure_bottom": 600.0}}
    moved = []
    for applied in ([0, 0, 4e4], {"expression": ["0", "0", "4e4"]}):
        ambient = {"field": "magnetic", "applied_field": applied, "relative_permeability": 2.0}
        moved.append(scalars({"relative_permeability": 5.0}, ambient, **free))
    assert moved[1]["displacement"] == pytest.approx(moved[0]["displacement"], rel=1e-6)
    assert moved[1]["stretch_max"] == pytest.approx(moved[0]["stretch_max"], rel=1e-5)
