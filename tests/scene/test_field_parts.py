"""The pieces of a field, each by itself: electrodes, bodies, sources, liquids; their messages and their round trips."""

# ruff: noqa: E501 - one case per line, with the whole message

from __future__ import annotations

import math
from typing import Any

import pytest

from embedding.scene import (
    Ambient,
    AppliedField,
    BoxBody,
    CylinderBody,
    Electrode,
    Faces,
    HalfSpace,
    LineCurrent,
    Region,
    RemanenceField,
    Scene,
    Shell,
    SphereBody,
)
from tests.scene.samples import refusals, scene, shell

ORIGIN = [0, 0, 0]
NEITHER = "a conductor needs a voltage, a charge or a potential, another body its constants"


@pytest.mark.parametrize(
    ("build", "line"),
    [
        (lambda: Electrode(voltage=1, charge="2 nC"), "charge: 2e-09 C is not allowed: an electrode has a voltage or a charge; leave out one of the two"),
        (lambda: Electrode(charge="2 V"), 'charge: 2 V is not allowed: "V" is a unit of mass * length ** 2 / time ** 3 / current: must be a charge, such as "2 nC"'),
        (lambda: Electrode(voltage=1, where="web"), 'where: web is not allowed: must be a list of different names of faces, such as ["web"]'),
        (lambda: Electrode(voltage=1, where=["web", "web"]), 'where: [web, web] is not allowed: must be a list of different names of faces, such as ["web"]'),
        (lambda: Faces(both={"voltage": 1}, top={"voltage": 1}), "both: a table is not allowed: the whole shell is one conductor: leave out top and bottom"),
        (lambda: Shell(**shell(remanence="1 T")), "remanence: 1 T is not allowed: must be a list of 3 components [x, y, z]"),
        (lambda: Shell(**shell(remanence=[0, 0, "1 A/m"])), 'remanence.2: 1 A/m is not allowed: "A/m" is a unit of current / length: must be a flux density, such as "50 mT"'),
        (lambda: Shell(**shell(remanence={"expression": ["x"]})), "remanence.expression: [x] is not allowed: must be a list of 3 expressions, one for each of x, y and z"),
        (lambda: Shell(**shell(remanence={"expression": ["x", "y", "z"], "unit": "m"})), 'remanence.unit: m is not allowed: "m" is a unit of length: must be a unit of flux density, such as mT'),
        (lambda: Shell(**shell(polarisation=[0, 0, "1 T"])), 'polarisation.2: 1 T is not allowed: "T" is a unit of mass / time ** 2 / current: must be a polarisation, such as "1 mC/m^2"'),
        (lambda: Shell(**shell(saturation=0)), "saturation: 0 T is not allowed: must be greater than 0"),
        (lambda: Region(faces=["web"]), "faces: [web] is not allowed: a region needs a thickness, a material or another property of its own"),
        (lambda: LineCurrent(along=ORIGIN, current=1), "along: [0, 0, 0] is not allowed: must point somewhere"),
        (lambda: LineCurrent(along=[0, 0, 1]), 'current: missing: must be a current, such as "3 A"'),
        (lambda: SphereBody(centre=ORIGIN, radius=0, voltage=1), "radius: 0 m is not allowed: must be greater than 0"),
        (lambda: SphereBody(centre=ORIGIN, radius=1), f"voltage: none is not allowed: {NEITHER}"),
        (lambda: SphereBody(centre=ORIGIN, radius=1, voltage=1, charge=2), "charge: 2.0 is not allowed: a body with a voltage has nothing else but its place; leave out one of the two"),
        (lambda: SphereBody(centre=ORIGIN, radius=1, potential=1, relative_permeability=2), "relative_permeability: 2.0 is not allowed: a body with a potential has nothing else but its place; leave out one of the two"),
        (lambda: BoxBody(centre=ORIGIN, size=[1, 0, 1], voltage=1), "size.1: 0 m is not allowed: must be greater than 0"),
        (lambda: HalfSpace(level=0, charge=1), "charge: 1.0 is not allowed: a half-space is at a voltage, or in a magnetic field at a potential"),
        (lambda: HalfSpace(level=0, relative_permeability=1e4), "relative_permeability: 10000.0 is not allowed: a half-space is at a voltage, or in a magnetic field at a potential"),
        (lambda: Ambient(field="electric", box=[1, 2]), "box: [1, 2] is not allowed: must be a list of 3 components [x, y, z]"),
        (lambda: Ambient(field="electric", relative_permittivity=0), "relative_permittivity: 0 is not allowed: must be greater than 0"),
        (lambda: Ambient(field="electric", applied_field={"expression": ["0", "0", "x"], "unit": "A/m"}), "applied_field.unit: A/m is not allowed: must be a unit of the electric field, such as V/m"),
        (lambda: Ambient(field="magnetic", applied_field={"expression": ["0", "0", "x"], "unit": "T"}), "applied_field.unit: T is not allowed: must be a unit of an electric or a magnetic field, such as kV/mm or kA/m"),
        (lambda: Ambient(field="magnetic", applied_field={"expression": ["0", "0", "r"]}), 'applied_field.expression.2: r is not allowed: unknown name "r": known are x, y, z, pi, sin, cos, exp, log, sqrt, tanh'),
        (lambda: Ambient(field="electric", bodies=[{"kind": "ball"}]), 'bodies.0.kind: "ball" is not allowed: must be "sphere", "cylinder", "box" or "half-space"'),
        (lambda: Ambient(field="electric", bodies=[3]), 'bodies.0: 3 is not allowed: must be a table with kind = "sphere", "cylinder", "box" or "half-space"'),
    ],
)  # fmt: skip
def test_a_part(build: Any, line: str) -> None:
    assert refusals(build) == [line]


def test_numbers_are_si() -> None:
    assert Electrode(charge="2 nC").charge == 2e-9 == Electrode(charge="2 nC").strength
    assert Electrode(voltage="2 kV").strength == 2e3
    assert Shell(**shell(remanence=[0, 0, "50 mT"])).remanence == (0.0, 0.0, 0.05)
    assert Shell(**shell(polarisation=["1 mC/m^2", 0, 0])).polarisation == (1e-3, 0.0, 0.0)
    assert Shell(**shell(saturation="1500 mT")).saturation == 1.5
    wire = LineCurrent(through=["1 mm", 0, 0], along=[0, 0, 2], current="3 kA")
    assert (wire.through, wire.along, wire.current) == ((1e-3, 0.0, 0.0), (0.0, 0.0, 2.0), 3e3)


def test_vectors_that_vary_have_callable_components() -> None:
    remanence = Shell(**shell(remanence={"expression": [0, "x/0.01", "z*y"], "unit": "mT"})).remanence
    assert isinstance(remanence, RemanenceField)
    assert [component(0.02, 3.0, 5.0) for component in remanence.components] == pytest.approx([0.0, 2e-3, 15e-3])
    uniform = Ambient(field="magnetic", applied_field=[0, 0, "2 kA/m"])
    assert (uniform.uniform_field, uniform.varying_field) == ((0.0, 0.0, 2e3), None)
    field = Ambient(field="magnetic", applied_field={"expression": ["0", "0", "1 + x"], "unit": "kA/m"})
    assert field.uniform_field == (0.0, 0.0, 0.0)
    assert isinstance(field.varying_field, AppliedField) and not field.varying_field.electric
    assert field.varying_field.components[2](2.0, 0.0, 0.0) == 3e3
    without_unit = Ambient(field="electric", applied_field={"expression": ["x", "0", "0"]}).varying_field
    assert without_unit is not None and without_unit.electric and without_unit.unit == "V/m"


def test_the_numbers_that_belong_to_the_field() -> None:
    liquids = {"relative_permittivity": 2, "relative_permeability": 3, "inside_relative_permeability": 5}
    electric, magnetic = Ambient(field="electric", **liquids), Ambient(field="magnetic", **liquids)
    assert (electric.contrast, electric.inside_contrast) == (2.0, 2.0)
    assert (magnetic.contrast, magnetic.inside_contrast) == (3.0, 5.0)
    place: dict[str, Any] = {"centre": ORIGIN, "radius": 1}
    bodies = [SphereBody(**place, **what) for what in (
        {"voltage": 0}, {"charge": -2}, {"potential": 3}, {"relative_permittivity": 4},
        {"relative_permeability": 5, "remanence": [0, 0, 1]}, {"remanence": [0, 0, 1]},
    )]  # fmt: skip
    assert [body.is_conductor for body in bodies] == [True, True, True, False, False, False]
    assert [body.strength for body in bodies] == [0.0, -2.0, 3.0, 0.0, 0.0, 0.0]
    assert [body.contrast for body in bodies] == [1.0, 1.0, 1.0, 4.0, 5.0, 1.0]


@pytest.mark.parametrize(
    ("body", "far", "flat", "depth"),
    [
        (SphereBody(centre=(3, 4, 12), radius=2, voltage=0), 15.0, 7.0, -2.0),
        (CylinderBody(centre=(3, 4, 12), radius=2, length=6, voltage=0), math.hypot(7, 15), 7.0, -2.0),
        (BoxBody(centre=(3, 4, 12), size=(2, 8, 4), voltage=0), math.hypot(4, 8, 14), math.hypot(4, 8), -1.0),
    ],
)
def test_how_far_bodies_reach(body: Any, far: float, flat: float, depth: float) -> None:
    assert (body.farthest(3), body.farthest(2)) == (pytest.approx(far), pytest.approx(flat))
    assert body.clearance(body.centre, 3) == pytest.approx(depth)
    outside = (3.0, 4.0, 12.0 + 30.0)
    assert body.clearance(outside, 3) == pytest.approx(30.0 - (body.reach(3)[2] - 12.0))
    assert body.clearance(outside, 2) < 0.0, "in plane strain z counts for nothing"


def test_half_spaces_lie_below_their_level() -> None:
    floor = HalfSpace(level=-2, voltage=0)
    assert floor.clearance((7.0, 5.0, 1.0), 3) == 3.0 and floor.clearance((7.0, 5.0, 1.0), 2) == 7.0
    assert floor.farthest(3) == floor.farthest(2) == 2.0


MAGNETIC = """
[shell]
shape = { kind = "disc", radius = "10 mm" }
thickness = "1 mm"
material = { law = "neo-hookean", shear_modulus = "30 kPa" }
relative_permeability = 2
saturation = "1 T"
remanence = { expression = ["x/0.01", "y/0.01", "0"], unit = "mT" }

[ambient]
field = "magnetic"
applied_field = { expression = ["0", "0", "1 + z/0.01"], unit = "kA/m" }
line_currents = [{ through = ["5 mm", 0, "30 mm"], along = [0, 1, 0], current = "3 A" }]
relative_permeability = 1.1
bodies = [
    { kind = "sphere", centre = [0, 0, "15 mm"], radius = "2 mm", remanence = [0, 0, "1 T"], relative_permeability = 1.05 },
    { kind = "cylinder", centre = [0, 0, "-5 mm"], radius = "2 mm", length = "1 mm", relative_permeability = 1000 },
]

[model]
far_field = "infinite"
"""
ELECTRIC = """
[shell]
shape = { kind = "plate", length = "10 mm", width = "5 mm" }
thickness = "0.1 mm"
material = { law = "neo-hookean", shear_modulus = "30 kPa" }
polarisation = [0, 0, "1 mC/m^2"]

[ambient]
field = "electric"
outer = "grounded"
box = ["20 mm", "20 mm", "20 mm"]
relative_permittivity = 2
bodies = [
    { kind = "box", centre = [0, 0, "5 mm"], size = ["1 mm", "1 mm", "1 mm"], charge = "2 nC" },
    { kind = "half-space", level = "-3 mm", voltage = "1 kV" },
]

[faces]
both = { charge = 0 }

[model]
surroundings = "meshed"
"""


@pytest.mark.parametrize("text", [MAGNETIC, ELECTRIC])
def test_writing_and_reading_give_the_same_scene(text: str) -> None:
    stated = Scene.from_toml(text)
    again = Scene.from_toml(stated.to_toml())
    assert again == stated and hash(again) == hash(stated) and again.to_toml() == stated.to_toml()


def test_regions_differ_by_what_they_carry() -> None:
    part = Region(faces=["web"], remanence=[0, 0, 1])
    carrier = scene(of_shell={"relative_permeability": 2}).shell.model_copy(update={"remanence": (1, 0, 0)})
    assert carrier.carried == {"remanence": (1.0, 0.0, 0.0)} == carrier.constant_vectors
    both = carrier.model_copy(update={"regions": (part, Region(faces=["foot"], polarisation={"expression": ["x", "0", "0"]}))})
    assert list(both.carried) == ["remanence", "regions.0.remanence", "regions.1.polarisation"]
    assert list(both.vector_fields) == ["regions.1.polarisation"]
