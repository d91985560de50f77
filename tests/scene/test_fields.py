"""Every message about a single field: it names the path, the value, and what is allowed."""

# ruff: noqa: E501 - one case per line, with the whole message

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from embedding.scene import (
    Ambient,
    Discretisation,
    EdgeTraction,
    Electrode,
    InfiniteCylinder,
    Loads,
    Model,
    MooneyRivlin,
    NeoHookean,
    Plate,
    PressureField,
    Scene,
    Shell,
    Solver,
    Sphere,
    Stage,
    Support,
)
from tests.scene.samples import MATERIAL, SHAPES, refusals, scene, shell

LENGTH = 'must be a length greater than 0, such as "0.2 mm"'
COMPONENTS = "must be a list of 3 components [x, y, z]"


@pytest.mark.parametrize(
    ("value", "line"),
    [
        ("-0.2 mm", "shell.thickness: -0.2 mm is not allowed: must be greater than 0"),
        (-0.0002, "shell.thickness: -0.0002 m is not allowed: must be greater than 0"),
        (0, "shell.thickness: 0 m is not allowed: must be greater than 0"),
        (float("nan"), "shell.thickness: nan m is not allowed: must be finite"),
        (float("inf"), "shell.thickness: inf m is not allowed: must be finite"),
        ("1e999 mm", "shell.thickness: 1e999 mm is not allowed: must be finite"),
        (10**400, "shell.thickness: an integer of more than 18 digits is not allowed: must be finite"),
        (2e30, "shell.thickness: 2e+30 m is not allowed: must be at most 1e+30 in magnitude"),
        (1e-31, "shell.thickness: 1e-31 m is not allowed: must be at least 1e-30"),
        (True, f"shell.thickness: true is not allowed: {LENGTH}"),
        (None, f"shell.thickness: none is not allowed: {LENGTH}"),
        ([1, 2], f"shell.thickness: [1, 2] is not allowed: {LENGTH}"),
        ({}, "shell.thickness.expression: missing: must be given"),
        ("", f'shell.thickness: "" is not allowed: not a number with a unit: {LENGTH}'),
        ("thin", f"shell.thickness: thin is not allowed: not a number with a unit: {LENGTH}"),
        ("0.2", f"shell.thickness: 0.2 is not allowed: text without a unit: {LENGTH}"),
        ("3 kg", f'shell.thickness: 3 kg is not allowed: "kg" is a unit of mass: {LENGTH}'),
        (
            "3 MM",
            f'shell.thickness: 3 MM is not allowed: "MM" is a unit of substance / length ** 3: {LENGTH}',
        ),
        ("3 furlogs", f'shell.thickness: 3 furlogs is not allowed: unknown unit "furlogs": {LENGTH}'),
        ("3 m^", f'shell.thickness: 3 m^ is not allowed: "m^" is not a unit: {LENGTH}'),
    ],
)
def test_a_length(value: Any, line: str) -> None:
    assert refusals(lambda: scene(of_shell={"thickness": value})) == [line]


@pytest.mark.parametrize("value", [np.float64(2e-4), np.float32(2e-4), Fraction(1, 5000), "0.2 mm", "200 µm"])
def test_other_spellings_of_a_length(value: Any) -> None:
    thickness = Shell(**shell(thickness=value)).thickness
    assert type(thickness) is float
    assert thickness == pytest.approx(2e-4, rel=1e-7)


@pytest.mark.parametrize(
    ("build", "line"),
    [
        (lambda: Sphere(radius=-1), "radius: -1 m is not allowed: must be greater than 0"),
        (lambda: Sphere(), f"radius: missing: {LENGTH}"),
        (lambda: Sphere(radius=1, height=2), "height: unknown key: the keys here are kind, radius"),
        (lambda: Sphere(radius=1, radios=2), 'radios: unknown key: did you mean "radius"?'),
        (lambda: Sphere(kind="disc", radius=1), 'kind: "disc" is not allowed: must be "sphere"'),
        (lambda: Plate(length=1, width="2 Pa"), f'width: 2 Pa is not allowed: "Pa" is a unit of mass / length / time ** 2: {LENGTH}'),
        (lambda: InfiniteCylinder(radius=1, axial_stretch=0), "axial_stretch: 0 is not allowed: must be greater than 0"),
        (
            lambda: InfiniteCylinder(radius=1, axial="free", axial_stretch=1.5),
            'axial_stretch: 1.5 is not allowed: a prescribed axial stretch needs axial = "held"',
        ),
        (
            lambda: InfiniteCylinder(radius=1, axial="fre"),
            'axial: "fre" is not allowed: must be "held" or "free"; did you mean "free"?',
        ),
        (lambda: NeoHookean(shear_modulus=0), "shear_modulus: 0 Pa is not allowed: must be greater than 0"),
        (
            lambda: NeoHookean(),
            'shear_modulus: missing: must be a pressure greater than 0, such as "100 kPa"',
        ),
        (lambda: MooneyRivlin(c1=1, c2="-1 kPa"), "c2: -1 kPa is not allowed: must be at least 0"),
        (lambda: Shell(**shell(relative_permittivity=-2)), "relative_permittivity: -2 is not allowed: must be greater than 0"),
        (
            lambda: Shell(**shell(relative_permeability="2 m")),
            "relative_permeability: 2 m is not allowed: must be a number greater than 0",
        ),
        (lambda: Electrode(voltage="6 kA"), 'voltage: 6 kA is not allowed: "kA" is a unit of current: must be a voltage, such as "6 kV"'),
        (lambda: Electrode(), 'voltage: none is not allowed: give a voltage, such as "6 kV", or a charge, such as "2 nC"'),
        (lambda: Ambient(), 'field: missing: must be "electric" or "magnetic"'),
        (lambda: Ambient(field="Electric"), 'field: "Electric" is not allowed: must be "electric" or "magnetic"; did you mean "electric"?'),
        (lambda: Ambient(field=3), 'field: 3 is not allowed: must be "electric" or "magnetic"'),
        (lambda: Ambient(field="electric", radius=0), "radius: 0 m is not allowed: must be greater than 0"),
        (lambda: Ambient(field="electric", outer="open"), 'outer: "open" is not allowed: must be "free-space" or "grounded"'),
        (lambda: Ambient(field="electric", applied_field=[0, 1]), f"applied_field: [0, 1] is not allowed: {COMPONENTS}"),
        (lambda: Ambient(field="electric", applied_field="up"), f"applied_field: up is not allowed: {COMPONENTS}"),
        (lambda: Ambient(field="electric", applied_field={1.0, 2.0, 3.0}), "applied_field: {1.0, 2.0, 3.0} is not allowed: " + COMPONENTS),
        (
            lambda: Ambient(field="electric", applied_field=[0, 0, "5 kA/m"]),
            'applied_field.2: 5 kA/m is not allowed: "kA/m" is a unit of current / length: '
            'must be an electric field, such as "2 kV/mm"',
        ),
        (
            lambda: Ambient(field="magnetic", applied_field=[0, "nope", 0]),
            'applied_field.1: nope is not allowed: not a number with a unit: must be a magnetic field, such as "5 kA/m"',
        ),
        (lambda: Loads(body_force=[0, 0, None]), 'body_force.2: none is not allowed: must be a force per volume, such as "10 kN/m^3"'),
        (lambda: Loads(rim="open"), 'rim: "open" is not allowed: must be "traction-free" or "pressurised"'),
        (lambda: Loads(variant="nett"), 'variant: "nett" is not allowed: must be "embedding-aware", "net" or "as-published"; did you mean "net"?'),
        (lambda: Loads(edge_tractions=3), "edge_tractions: 3 is not allowed: must be a list"),
        (lambda: Loads(edge_tractions=[3]), "edge_tractions.0: 3 is not allowed: must be a table with the keys edge, traction, frame, kind"),
        (lambda: Loads(edge_tractions=[{"edge": "rim"}]), "edge_tractions.0.traction: missing: must be given"),
        (lambda: EdgeTraction(edge="", traction=(0, 0, 1)), 'edge: "" is not allowed: must be text on one line, of 1 to 100 printable characters'),
        (lambda: EdgeTraction(edge="rim", traction=(0, "1 N", 0)), 'traction.1: 1 N is not allowed: "N" is a unit of mass * length / time ** 2: must be a force per length, such as "3 N/m"'),
        (lambda: Loads(pressure_top="6 kV"), 'pressure_top: 6 kV is not allowed: "kV" is a unit of mass * length ** 2 / time ** 3 / current: must be a pressure, such as "100 kPa"'),
        (lambda: Loads(pressure_top=[1]), 'pressure_top: [1] is not allowed: must be a pressure, such as "100 kPa"'),
        (lambda: Loads(pressure_top={}), "pressure_top.expression: missing: must be given"),
        (lambda: Loads(pressure_top={"expression": 3}), "pressure_top.expression: 3 is not allowed: must be text"),
        (lambda: Loads(pressure_top={"expression": "w"}), 'pressure_top.expression: w is not allowed: unknown name "w": known are x, y, z, pi, sin, cos, exp, log, sqrt, tanh'),
        (lambda: Loads(pressure_top={"expression": "x", "units": "Pa"}), 'pressure_top.units: unknown key: did you mean "unit"?'),
        (lambda: PressureField(expression="x", unit="m"), 'unit: m is not allowed: "m" is a unit of length: must be a unit of pressure, such as kPa'),
        (lambda: PressureField(expression="x", unit=3), "unit: 3 is not allowed: must be text on one line, of 1 to 40 printable characters"),
        (lambda: Support(where="rim", fix="x"), 'fix: x is not allowed: must be a list of different axes, such as ["x", "z"]'),
        (lambda: Support(where="rim", fix=[]), 'fix: [] is not allowed: must be a list of different axes, such as ["x", "z"]'),
        (lambda: Support(where="rim", fix=["x", "x"]), 'fix: [x, x] is not allowed: must be a list of different axes, such as ["x", "z"]'),
        (lambda: Support(where="rim", fix=["r"]), 'fix.0: "r" is not allowed: must be "x", "y", "z" or "rotation"'),
        (lambda: Support(fix=["x"]), 'where: missing: must be an edge or face of the shape, "surface" or a point [x, y, z]'),
        (lambda: Stage(steps=0), "steps: 0 is not allowed: must be at least 1 and at most 10000"),
        (lambda: Stage(steps=10001), "steps: 10001 is not allowed: must be at least 1 and at most 10000"),
        (lambda: Stage(steps=2.0), "steps: 2.0 is not allowed: must be a whole number of at least 1 and at most 10000"),
        (lambda: Stage(steps=True), "steps: true is not allowed: must be a whole number of at least 1 and at most 10000"),
        (lambda: Stage(mechanical="1"), "mechanical: 1 is not allowed: must be a number"),
        (lambda: Stage(field=float("nan")), "field: nan is not allowed: must be finite"),
        (lambda: Stage(volume_ratio=-1), "volume_ratio: -1 is not allowed: must be greater than 0"),
        (lambda: Stage(name="two\nlines"), "name: two lines is not allowed: must be text on one line, of 1 to 100 printable characters"),
        (lambda: Stage(name="n" * 101), f"name: {'n' * 57}... is not allowed: must be text on one line, of 1 to 100 printable characters"),
        (lambda: Model(reduction="2d"), 'reduction: "2d" is not allowed: must be "auto", "3d", "axisymmetric" or "plane-strain"'),
        (lambda: Model(symmetry=True), 'symmetry: true is not allowed: must be "auto" or "none"'),
        (lambda: Model(interface="open"), 'interface: "open" is not allowed: must be "auto", "opened" or "closed"; did you mean "opened"?'),
        (lambda: Model(coupling="joined"), 'coupling: "joined" is not allowed: must be "auto", "joint", "staggered", "once" or "unperturbed"; did you mean "joint"?'),
        (lambda: Model(far_field="kelvin"), 'far_field: "kelvin" is not allowed: must be "auto", "infinite" or "robin"'),
        (lambda: Discretisation(order=5), "order: 5 is not allowed: must be at least 1 and at most 4"),
        (lambda: Discretisation(grading=0.01), "grading: 0.01 is not allowed: must be at least 0.05 and at most 1"),
        (lambda: Discretisation(grading="fine"), "grading: fine is not allowed: must be a number of at least 0.05 and at most 1"),
        (lambda: Discretisation(shell_size=0), "shell_size: 0 m is not allowed: must be greater than 0"),
        (lambda: Discretisation(ambient_size="1 s"), f'ambient_size: 1 s is not allowed: "s" is a unit of time: {LENGTH}'),
        (lambda: Solver(tolerance=1), "tolerance: 1 is not allowed: must be at least 1e-13 and at most 0.001"),
        (lambda: Solver(max_iterations=0), "max_iterations: 0 is not allowed: must be at least 1 and at most 10000"),
        (lambda: Solver(min_step=0), "min_step: 0 is not allowed: must be greater than 0 and at most 1"),
        (lambda: Solver(threads=0), "threads: 0 is not allowed: must be at least 1 and at most 1024"),
    ],
)  # fmt: skip
def test_a_part(build: Any, line: str) -> None:
    assert refusals(build) == [line]


ALL_KINDS = (
    '"plate", "disc", "annulus", "sphere", "cylinder", "cap", "hemisphere", "cone", '
    '"torus", "ellipsoid", "t-section", "infinite-cylinder", "strip", "arch" or "file"'
)
KINDS = f"must be a table with kind = {ALL_KINDS}"


@pytest.mark.parametrize(
    ("table", "line"),
    [
        ({}, "shell: missing: must be a table with the keys shape, thickness, material, density, regions, relative_permittivity, relative_permeability, remanence, polarisation, saturation"),
        ({"shell": 5}, "shell: 5 is not allowed: must be a table with the keys shape, thickness, material, density, regions, relative_permittivity, relative_permeability, remanence, polarisation, saturation"),
        ({"shell": shell(shape=5)}, f"shell.shape: 5 is not allowed: {KINDS}"),
        ({"shell": shell(shape=NeoHookean(shear_modulus=1))}, f"shell.shape: a NeoHookean is not allowed: {KINDS}"),
        ({"shell": shell(shape={"radius": 1})}, f'shell.shape.kind: missing: must be {ALL_KINDS}'),
        ({"shell": shell(shape={"kind": 3})}, f'shell.shape.kind: 3 is not allowed: must be {ALL_KINDS}'),
        ({"shell": shell(shape={"kind": ["disc"]})}, f'shell.shape.kind: [disc] is not allowed: must be {ALL_KINDS}'),
        ({"shell": shell(shape={"kind": "sphere"})}, f"shell.shape.radius: missing: {LENGTH}"),
        ({"shell": shell(shape={"kind": "infinite-cylinder", "radius": 1, "axial": "free", "axial_stretch": 2})}, 'shell.shape.axial_stretch: 2.0 is not allowed: a prescribed axial stretch needs axial = "held"'),
        ({"shell": shell(material={"law": "hookean"})}, 'shell.material.law: "hookean" is not allowed: must be "neo-hookean", "mooney-rivlin", "yeoh", "gent", "ogden", "st-venant-kirchhoff" or "strain-energy"; did you mean "neo-hookean"?'),
        ({"shell": shell(), "path": []}, "path: [] is not allowed: must hold at least one stage"),
        ({"shell": shell(), "path": {"steps": 1}}, "path: a table is not allowed: must be a list"),
        ({"shell": shell(), "path": [{"steps": 1}, {"stesp": 1}]}, 'path.1.stesp: unknown key: did you mean "steps"?'),
        ({"shell": shell(), "supports": {"where": "rim"}}, "supports: a table is not allowed: must be a list"),
        ({"shell": shell(), "loads": {"body_force": [0, 0, "1 N"]}}, 'loads.body_force.2: 1 N is not allowed: "N" is a unit of mass * length / time ** 2: must be a force per volume, such as "10 kN/m^3"'),
        ({"shell": shell(), "loads": {"pressure_bottom": {"expression": "2+"}}}, "loads.pressure_bottom.expression: 2+ is not allowed: must be arithmetic in x, y and z; this cannot be read"),
        ({"shell": shell(relative_permittivity=3), "ambient": {"field": "electric", "feld": 1}}, 'ambient.feld: unknown key: did you mean "field"?'),
        ({"shell": shell(), "faces": {"top": 6e3}}, "faces.top: 6000.0 is not allowed: must be a table with the keys voltage, charge, where"),
        ({"shell": shell(), "faces": {"outer": {"voltage": 1}}}, "faces.outer: unknown key: the keys here are top, bottom, both"),
        ({"shell": shell(), "solver": Model()}, "solver: a Model is not allowed: must be a table with the keys tolerance, max_iterations, min_step, max_steps, max_arc, acceleration, linear, threads"),
        ({"shell": shell(), "name": 3}, "name: 3 is not allowed: must be text on one line, of 1 to 100 printable characters"),
        ({"shell": shell(), "name": " "}, "name:   is not allowed: must be text on one line, of 1 to 100 printable characters"),
        ({"shell": shell(), "lodas": {}}, 'lodas: unknown key: did you mean "loads"?'),
        ({"shell": shell(), "Solver": {}}, 'Solver: unknown key: did you mean "solver"?'),
    ],
)  # fmt: skip
def test_a_path_inside_the_scene(table: dict[str, Any], line: str) -> None:
    assert refusals(lambda: Scene(**table)) == [line]


def test_all_errors_come_at_once() -> None:
    lines = refusals(
        lambda: Scene(
            name=7,
            shell={
                "shape": {"kind": "sphere", "radius": -1},
                "thicknes": 1,
                "material": {"law": "mooney-rivlin", "c1": True, "c2": -1},
            },
            supports=[{"where": "rim", "fix": ["x", "q"]}],
            loads={"pressure_top": {"expression": "x^2", "unit": "s"}, "body_force": [1, 2]},
            path=[{"steps": 0}, {"field": "x", "volume_ratio": 0}],
            solver={"threads": 0, "thread": 1},
        )
    )
    assert [line.partition(": ")[0] for line in lines] == [
        "name",
        "shell.shape.radius",
        "shell.thickness",
        "shell.material.c1",
        "shell.material.c2",
        "shell.thicknes",
        "supports.0.fix.1",
        "loads.pressure_top.expression",
        "loads.pressure_top.unit",
        "loads.body_force",
        "path.0.steps",
        "path.1.field",
        "path.1.volume_ratio",
        "solver.threads",
        "solver.thread",
        "supports.0.where",
    ]


def test_accepted_spellings() -> None:
    built = Loads(
        pressure_top="1.1 kPa", pressure_bottom=PressureField(expression="x"), body_force=np.array([0, 0, -1])
    )
    assert built.pressure_top == 1100.0
    assert built.body_force == (0.0, 0.0, -1.0)
    assert list(built.pressure_fields) == ["pressure_bottom"]
    assert Support(where="rim", fix=("z", "x")).fix == ("x", "z")
    assert Stage(steps=np.int64(3)).steps == 3
    assert Ambient(field="magnetic", applied_field=[0, 0, "2 kA/m"]).applied_field == (0.0, 0.0, 2000.0)
    assert Ambient(field="electric", applied_field=[0, 0, "2 kV/mm"]).applied_field == (0.0, 0.0, 2e6)
    assert MooneyRivlin(c1=1, c2=2).shear_modulus == 6.0
    assert (
        Shell(shape=Sphere(**SHAPES["sphere"]), thickness=1e-4, material=NeoHookean(**MATERIAL)).shape.size
        == 0.02
    )
