"""Every message between fields: what is right on its own and still cannot be one scene."""

# ruff: noqa: E501 - one case per line, with the whole message

from __future__ import annotations

from typing import Any

import pytest

from embedding.scene import EdgeTraction, PressureField, Scene, axisymmetry_problems
from tests.scene.samples import MATERIAL, refusals, scene, shell

ELECTRIC = {"field": "electric"}
MAGNETIC = {"field": "magnetic"}
DIELECTRIC = {"relative_permittivity": 3.0}
SLIT = {"kind": "annulus", "inner_radius": 0.01, "outer_radius": 0.02, "slit": True}
NOT_AXISYMMETRIC = 'the x and y components must be 0 when model.reduction is "axisymmetric"'
END = {"where": [0, 0, 0], "axis": "z", "value": 1}
IDLE = "not allowed: the stage changes no load and no field, so that nothing moves the point"
ONLY_RADIUS = 'must depend on x and y through x**2 + y**2 only when model.reduction is "axisymmetric"'


def traction(edge: str, *components: float) -> dict[str, Any]:
    return {"edge_tractions": [{"edge": edge, "traction": components or (0, 0, 1)}]}


@pytest.mark.parametrize(
    ("shape", "parts", "line"),
    [
        ("plate", {"supports": [{"where": "x2", "fix": ["x"]}]}, 'supports.0.where: "x2" is not allowed: must be "x0", "x1", "y0", "y1" or "surface" (the shape is a "plate")'),
        ("disc", {"supports": [{"where": "rims", "fix": ["x"]}]}, 'supports.0.where: "rims" is not allowed: must be "rim" or "surface"; did you mean "rim"? (the shape is a "disc")'),
        ("sphere", {"supports": [{"where": "surface", "fix": ["x"]}, {"where": "rim", "fix": ["x"]}]}, 'supports.1.where: "rim" is not allowed: must be "surface" (the shape is a "sphere")'),
        ("plate", {"loads": traction("rim")}, 'loads.edge_tractions.0.edge: "rim" is not allowed: must be "x0", "x1", "y0" or "y1" (the shape is a "plate")'),
        ("disc", {"loads": traction("surface")}, 'loads.edge_tractions.0.edge: "surface" is not allowed: must be "rim" (the shape is a "disc")'),
        ("sphere", {"loads": traction("rim")}, 'loads.edge_tractions.0.edge: "rim" is not allowed: a shape of kind "sphere" has no edges'),
        ("infinite-cylinder", {"loads": traction("rim", 1, 0, 0)}, 'loads.edge_tractions.0.edge: "rim" is not allowed: a shape of kind "infinite-cylinder" has no edges'),
        ("sphere", {"of_shell": {"thickness": 0.04}}, "shell.thickness: 0.04 m is not allowed: half of it must be less than shell.shape.radius = 0.02 m, or the inner face crosses the centre of curvature"),
        ("infinite-cylinder", {"of_shell": {"thickness": "50 mm"}}, "shell.thickness: 0.05 m is not allowed: half of it must be less than shell.shape.radius = 0.02 m, or the inner face crosses the centre of curvature"),
        ("plate", {"model": {"reduction": "axisymmetric"}}, 'model.reduction: "axisymmetric" is not allowed: must be "auto" or "3d" for a shape of kind "plate"'),
        ("disc", {"model": {"reduction": "plane-strain"}}, 'model.reduction: "plane-strain" is not allowed: must be "auto", "3d" or "axisymmetric" for a shape of kind "disc"'),
        ("sphere", {"model": {"reduction": "plane-strain"}}, 'model.reduction: "plane-strain" is not allowed: must be "auto", "3d" or "axisymmetric" for a shape of kind "sphere"'),
        ("infinite-cylinder", {"model": {"reduction": "3d"}}, 'model.reduction: "3d" is not allowed: must be "auto" or "plane-strain" for a shape of kind "infinite-cylinder"'),
        ("sphere", {"model": {"reduction": "axisymmetric"}, "loads": {"body_force": [1, 0, 2]}}, f"loads.body_force: [1.0, 0.0, 2.0] is not allowed: {NOT_AXISYMMETRIC}"),
        ("disc", {"model": {"reduction": "axisymmetric"}, "loads": traction("rim", 0, 3, 0)}, f"loads.edge_tractions.0.traction: [0.0, 3.0, 0.0] is not allowed: {NOT_AXISYMMETRIC}"),
        ("sphere", {"model": {"reduction": "axisymmetric"}, "ambient": {"field": "electric", "applied_field": [1, 0, 0]}, "of_shell": DIELECTRIC}, f"ambient.applied_field: [1.0, 0.0, 0.0] is not allowed: {NOT_AXISYMMETRIC}"),
        ("disc", {"model": {"reduction": "axisymmetric"}, "loads": {"pressure_top": {"expression": "1 + x"}}}, f"loads.pressure_top.expression: 1 + x is not allowed: {ONLY_RADIUS}"),
        ("disc", {"loads": {"pressure_top": {"expression": "1/x"}}}, "loads.pressure_top.expression: 1/x is not allowed: it has no finite value at x = 0 m, y = 0 m, z = 0 m"),
        ("disc", {"loads": {"pressure_top": {"expression": "sqrt(x)"}}}, "loads.pressure_top.expression: sqrt(x) is not allowed: it has no finite value at x = -0.02 m, y = 0 m, z = 0 m"),
        ("disc", {"loads": {"pressure_top": {"expression": "y**0.5"}}}, "loads.pressure_top.expression: y**0.5 is not allowed: it has no finite value at x = 0 m, y = -0.02 m, z = 0 m"),
        ("plate", {"loads": {"pressure_top": {"expression": "exp(1e5*x)"}}}, "loads.pressure_top.expression: exp(1e5*x) is not allowed: it has no finite value at x = 0.1 m, y = 0 m, z = 0 m"),
        ("sphere", {"loads": {"pressure_top": {"expression": "1e300*1e300"}}}, "loads.pressure_top.expression: 1e300*1e300 is not allowed: it has no finite value at x = 0 m, y = 0 m, z = 0.02 m"),
        ("infinite-cylinder", {"loads": {"body_force": [0, 0, -9]}}, "loads.body_force.2: -9.0 is not allowed: must be 0 along z, along which nothing changes"),
        ("infinite-cylinder", {"loads": {"pressure_top": {"expression": "z"}}}, "loads.pressure_top.expression: z is not allowed: must not depend on z, along which nothing changes"),
        ("infinite-cylinder", {"ambient": {"field": "electric", "applied_field": [1, 0, 5]}, "of_shell": DIELECTRIC}, "ambient.applied_field.2: 5.0 V/m is not allowed: must be 0 along the axis of an infinite cylinder"),
        ("infinite-cylinder", {"ambient": {"field": "magnetic", "applied_field": [1, 0, 5]}, "of_shell": {"relative_permeability": 2}}, "ambient.applied_field.2: 5.0 A/m is not allowed: must be 0 along the axis of an infinite cylinder"),
        ("plate", {"path": [{}, {"volume_ratio": 2}]}, 'path.1.volume_ratio: not allowed for a shape of kind "plate": only closed shells enclose a volume'),
        ("plate", {"path": [{"until": END}]}, f"path.0.until: {IDLE}"),
        ("plate", {"path": [{"mechanical": 0.0, "until": END}], "loads": {"pressure_bottom": 1}}, f"path.0.until: {IDLE}"),
        ("plate", {"path": [{}, {"until": END}], "loads": {"pressure_bottom": 1}}, f"path.1.until: {IDLE}"),
        ("sphere", {"path": [{"volume_ratio": 2}], "loads": {"pressure_bottom": {"expression": "z"}}}, "path.0.volume_ratio: not allowed: loads.pressure_bottom varies over the surface, and volume control needs uniform pressures"),
        ("sphere", {"ambient": ELECTRIC, "of_shell": DIELECTRIC | {"shape": SLIT}}, "ambient: not allowed around a slit ring: there is no space between the lips of the slit"),
        ("t-section", {"ambient": ELECTRIC, "of_shell": DIELECTRIC}, 'ambient: not allowed around a shape of kind "t-section": more than two plates meet in its junction, and the space between them has no top and bottom'),
        ("sphere", {"ambient": {"field": "electric", "radius": "20.1 mm"}, "of_shell": DIELECTRIC}, "ambient.radius: 0.0201 m is not allowed: must be greater than 0.0201 m, the farthest point of the shell from the origin plus half its thickness"),
        ("sphere", {"faces": {"top": {"voltage": 1}}}, 'faces.top: an electrode needs a field around the shell: add [ambient] with field = "electric"'),
        ("sphere", {"faces": {"bottom": {"voltage": 1}}, "ambient": MAGNETIC, "of_shell": {"relative_permeability": 2}}, 'faces.bottom: an electrode is not allowed when ambient.field is "magnetic"'),
        ("sphere", {"ambient": MAGNETIC}, 'shell.relative_permeability: missing: needed when ambient.field is "magnetic"'),
        ("sphere", {"ambient": ELECTRIC}, 'shell.relative_permittivity: missing: needed when ambient.field is "electric" and no face is an electrode'),
        ("sphere", {"ambient": ELECTRIC, "faces": {"top": {"voltage": 1}}}, "faces.bottom: missing voltage: without shell.relative_permittivity both faces must be electrodes at the same voltage; give the voltage here, or the permittivity"),
        ("sphere", {"ambient": ELECTRIC, "faces": {"bottom": {"voltage": 1}}}, "faces.top: missing voltage: without shell.relative_permittivity both faces must be electrodes at the same voltage; give the voltage here, or the permittivity"),
        ("sphere", {"ambient": ELECTRIC, "faces": {"top": {"voltage": 1}, "bottom": {"voltage": "2 kV"}}}, "shell.relative_permittivity: missing: needed because the faces are at different voltages, 1.0 V on top and 2000.0 V on the bottom"),
        ("infinite-cylinder", {"ambient": ELECTRIC, "faces": {"top": {"voltage": 1}, "bottom": {"voltage": 1}}}, 'ambient.outer: "free-space" is not allowed around an infinite cylinder with electrodes: its potential has no zero at infinity; use "grounded"'),
    ],
)  # fmt: skip
def test_a_conflict(shape: str, parts: dict[str, Any], line: str) -> None:
    assert refusals(lambda: scene(shape, **parts)) == [line]


@pytest.mark.parametrize(
    ("shape", "parts"),
    [
        ("plate", {"supports": [{"where": "x0", "fix": ["x", "y", "z"]}], "loads": traction("x1")}),
        ("disc", {"supports": [{"where": "surface", "fix": ["z"]}], "model": {"reduction": "axisymmetric"}}),
        ("disc", {"loads": {"pressure_top": {"expression": "x**2 + y**2 + z"}}, "model": {"reduction": "axisymmetric"}}),
        ("sphere", {"loads": {"pressure_top": {"expression": "1 - z/0.1"}}, "model": {"reduction": "axisymmetric"}}),
        ("sphere", {"loads": {"pressure_top": {"expression": "(4.0001e-4 - x**2 - y**2 - z**2)**-0.5"}}, "model": {"reduction": "axisymmetric"}}),
        ("disc", {"loads": {"pressure_top": {"expression": "1/(z - 0.018 + 1e-99*x)"}}, "model": {"reduction": "axisymmetric"}}),
        ("sphere", {"loads": {"pressure_top": {"expression": "sqrt(4.0001e-4 - x**2 - y**2 - z**2)"}}, "model": {"reduction": "axisymmetric"}}),
        ("disc", {"loads": traction("rim", 0, 0, 2), "model": {"reduction": "axisymmetric"}}),
        ("sphere", {"of_shell": {"thickness": 0.0399}, "path": [{"volume_ratio": 2.0}]}),
        ("sphere", {"ambient": ELECTRIC, "of_shell": DIELECTRIC, "faces": {"top": {"voltage": 1}}}),
        ("sphere", {"ambient": ELECTRIC, "faces": {"top": {"voltage": 1}, "bottom": {"voltage": 1}}}),
        ("sphere", {"ambient": ELECTRIC | {"applied_field": [1, 1, 1]}, "of_shell": DIELECTRIC}),
        ("sphere", {"ambient": MAGNETIC | {"radius": 0.02011}, "of_shell": {"relative_permeability": 100}}),
        ("infinite-cylinder", {"ambient": ELECTRIC | {"applied_field": [1, 1, 0]}, "of_shell": DIELECTRIC}),
        ("infinite-cylinder", {"ambient": ELECTRIC | {"outer": "grounded"}, "faces": {"top": {"voltage": 1}, "bottom": {"voltage": 1}}}),
        ("infinite-cylinder", {"model": {"reduction": "plane-strain"}, "loads": {"body_force": [1, 2, 0], "pressure_top": {"expression": "x*y"}}}),
    ],
)  # fmt: skip
def test_what_fits_together(shape: str, parts: dict[str, Any]) -> None:
    assert scene(shape, **parts).shell.shape.kind == shape


def test_conflicts_come_at_once() -> None:
    lines = refusals(
        lambda: scene(
            "plate",
            supports=[{"where": "rim", "fix": ["x"]}],
            loads=traction("rim") | {"pressure_bottom": {"expression": "1/y"}},
            ambient={"field": "magnetic", "radius": 0.01},
            faces={"top": {"voltage": 1}, "bottom": {"voltage": 1}},
            path=[{"volume_ratio": 2}],
            model={"reduction": "plane-strain"},
        )
    )
    assert [line.partition(": ")[0] for line in lines] == [
        "supports.0.where",
        "loads.edge_tractions.0.edge",
        "loads.pressure_bottom.expression",
        "path.0.volume_ratio",
        "path.0.volume_ratio",
        "ambient.radius",
        "faces.top",
        "faces.bottom",
        "shell.relative_permeability",
        "model.reduction",
    ]


@pytest.mark.parametrize(
    ("table", "paths"),
    [
        # a wrong thickness says nothing about edges, and hides only the checks that need it
        ({"shell": shell(thickness=-1), "supports": [{"where": "rim", "fix": ["x"]}], "ambient": ELECTRIC | {"radius": 1e-3}}, ["shell.thickness", "supports.0.where", "shell.relative_permittivity"]),
        # a misspelled key may be the one that a check would miss
        ({"shell": shell(relative_permitivity=3), "ambient": ELECTRIC}, ["shell.relative_permitivity"]),
        ({"shell": shell("plate"), "ambiet": {"field": "magnetic"}, "faces": {"top": {"voltage": 1}}}, ["ambiet"]),
        ({"shell": shell(), "ambient": {"field": "electrik"}, "faces": {"top": {"voltage": 1}}}, ["ambient.field"]),
        ({"shell": shell(relative_permittivity="x"), "ambient": ELECTRIC}, ["shell.relative_permittivity"]),
        ({"shell": shell(relative_permeability=-1), "ambient": MAGNETIC}, ["shell.relative_permeability"]),
        ({"shell": shell(), "ambient": ELECTRIC, "faces": {"top": {"voltage": "1"}}}, ["faces.top.voltage", "faces.bottom"]),
        ({"shell": shell("plate"), "path": [{"volume_ratio": -1}]}, ["path.0.volume_ratio"]),
        ({"shell": shell(shape={"kind": "spere"}), "path": [{"volume_ratio": 1}]}, ["shell.shape.kind"]),
        ({"shell": shell(shape={"kind": "infinite-cylinder", "radius": 1, "axial": 1}), "path": [{"volume_ratio": 1}], "model": {"reduction": "3d"}}, ["shell.shape.axial"]),
        ({"supports": [{"where": "rim", "fix": ["x"]}]}, ["shell"]),
        ({"shell": 3, "ambient": 4}, ["shell", "ambient"]),
    ],
)  # fmt: skip
def test_wrong_fields_start_no_false_conflicts(table: dict[str, Any], paths: list[str]) -> None:
    assert [line.partition(": ")[0] for line in refusals(lambda: Scene(**table))] == paths


def test_what_breaks_axisymmetry_can_be_asked() -> None:
    tilted = scene(
        "disc",
        loads={
            "edge_tractions": [EdgeTraction(edge="rim", traction=(1, 0, 0))],
            "pressure_top": PressureField(expression="x"),
            "pressure_bottom": PressureField(expression="sin(x*x + y*y)"),
            "body_force": (0, 1, 0),
        },
    )
    assert [problem.path for problem in axisymmetry_problems(tilted)] == [
        "loads.body_force",
        "loads.edge_tractions.0.traction",
        "loads.pressure_top.expression",
    ]


def test_a_material_may_be_given_as_a_table() -> None:
    assert (
        scene(of_shell={"material": MATERIAL | {"shear_modulus": "0.1 MPa"}}).shell.material.shear_modulus
        == 1e5
    )
