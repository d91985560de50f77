"""Every message about a field that does not fit its scene."""

# ruff: noqa: E501 - one case per line, with the whole message

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from embedding.scene import Scene, axisymmetry_problems
from embedding.scene.checks_electrodes import inside_only
from tests.scene.samples import MATERIAL, refusals, scene

ELECTRIC, MAGNETIC = {"field": "electric"}, {"field": "magnetic"}
DIELECTRIC, PERMEABLE = {"relative_permittivity": 3.0}, {"relative_permeability": 2.0}
FILM = {"top": {"voltage": 1e3}, "bottom": {"voltage": 0}}
CONDUCTOR = {"both": {"voltage": 1e3}}
BALL = {"kind": "sphere", "centre": [0, 0, 0.05], "radius": 0.005}
WIRE = {"through": [0.05, 0, 0], "along": [0, 0, 1], "current": 3.0}
GRADIENT = {"expression": ["x", "y", "-2*z"]}
RIM = "where two electrodes meet at the rim, the field around the shell is infinite"
MARGIN = "leave a margin with faces.top.where and faces.bottom.where"
UNPERTURBED = 'with model.coupling = "unperturbed": the field is the applied one alone'
NONE = 'with model.surroundings = "none", which leaves only the field between two electrodes'
PINNED = 'when model.reduction is "axisymmetric"'
ACROSS = f"the x and y components must be 0 {PINNED}"
TURNED = f"must be the same when turned about the z axis, without a component around it, {PINNED}"


def electric(**changes: Any) -> dict[str, Any]:
    return {"ambient": ELECTRIC | changes, "of_shell": DIELECTRIC}


def magnetic(**changes: Any) -> dict[str, Any]:
    return {"ambient": MAGNETIC | changes, "of_shell": PERMEABLE}


def round_about(parts: dict[str, Any]) -> dict[str, Any]:
    return parts | {"model": {"reduction": "axisymmetric"}}


SPACE = [
    ("sphere", electric(box=[0.1, 0.1, 0.1], radius=0.1, outer="grounded"), "ambient.box: not allowed beside ambient.radius: space ends at a sphere or at a box"),
    ("sphere", electric(box=[0.1, 0.1, 0.1]), 'ambient.outer: "free-space" is not allowed with ambient.box: open space ends at a sphere; use "grounded"'),
    ("sphere", electric(box=[0.1, 0.02, 0.1], outer="grounded"), "ambient.box.1: 0.02 m is not allowed: must be greater than 0.02 m, as far as the shell extends along y"),
    ("plate", electric(radius=0.11), "ambient.radius: 0.11 m is not allowed: must be greater than 0.111903 m, the farthest point of the shell from the origin plus half its thickness"),
    ("disc", electric(inside_relative_permittivity=2), 'ambient.inside_relative_permittivity: not allowed: a shape of kind "disc" is open and has no inside'),
    ("disc", magnetic(inside_relative_permeability=2), 'ambient.inside_relative_permeability: not allowed: a shape of kind "disc" is open and has no inside'),
    ("strip", electric(applied_field=[1, 0, 5]), "ambient.applied_field.2: 5.0 V/m is not allowed: must be 0 along the axis of what is infinitely long"),
    ("strip", electric(applied_field={"expression": ["0", "0", "1"]}), "ambient.applied_field.expression.2: 1 is not allowed: must be 0 along z, along which nothing changes"),
    ("strip", electric(applied_field={"expression": ["z", "0", "0"]}), "ambient.applied_field.expression.0: z is not allowed: must not depend on z, along which nothing changes"),
    ("strip", magnetic(line_currents=[WIRE | {"along": [1, 0, 1]}]), "ambient.line_currents.0.along: [1.0, 0.0, 1.0] is not allowed: must be along z, along which nothing changes"),
    ("disc", magnetic(applied_field={"expression": ["1/y", "0", "0"]}), "ambient.applied_field.expression.0: 1/y is not allowed: it has no finite value at x = 0 m, y = 0 m, z = 0 m"),
    ("sphere", electric(line_currents=[WIRE]), 'ambient.line_currents: not allowed when ambient.field is "electric"'),
    ("sphere", electric(applied_field=GRADIENT) | {"faces": CONDUCTOR}, "faces.both: not allowed: in an applied field that varies, or in that of line currents, there can be no conductors"),
    ("sphere", electric(applied_field=GRADIENT, bodies=[BALL | {"charge": 0}]), "ambient.bodies.0: not allowed: in an applied field that varies, or in that of line currents, there can be no conductors"),
    ("sphere", magnetic(line_currents=[WIRE], bodies=[BALL | {"potential": 0}]), "ambient.bodies.0: not allowed: in an applied field that varies, or in that of line currents, there can be no conductors"),
    ("sphere", electric(applied_field=[0, 0, 1]) | {"faces": CONDUCTOR, "model": {"coupling": "unperturbed"}}, f"faces.both: not allowed {UNPERTURBED}"),
    ("sphere", magnetic(applied_field=[0, 0, 1], bodies=[BALL | PERMEABLE]) | {"model": {"coupling": "unperturbed"}}, f"ambient.bodies: not allowed {UNPERTURBED}"),
    ("sphere", magnetic() | {"model": {"coupling": "unperturbed"}}, f"ambient.applied_field: missing: needed {UNPERTURBED}"),
]  # fmt: skip

ELECTRODES = [
    ("sphere", {"faces": CONDUCTOR}, 'faces.both: an electrode needs a field around the shell: add [ambient] with field = "electric"'),
    ("sphere", magnetic() | {"faces": CONDUCTOR}, 'faces.both: an electrode is not allowed when ambient.field is "magnetic"'),
    ("sphere", electric() | {"faces": {"top": {"voltage": 1, "where": ["web"]}}}, 'faces.top.where.0: "web" is not allowed: a shape of kind "sphere" has no named faces'),
    ("sphere", electric() | {"faces": {"both": {"voltage": 1, "where": ["web"]}}}, "faces.both.where: not allowed: the whole shell is one conductor"),
    ("sphere", {"ambient": ELECTRIC, "faces": {"top": {"charge": 1e-9}, "bottom": {"voltage": 0}}}, "shell.relative_permittivity: missing: needed because the faces may be at different voltages; faces.both makes the shell one conductor"),
    ("sphere", {"ambient": ELECTRIC, "faces": {"top": {"charge": 1e-9}}}, "faces.bottom: missing voltage: without shell.relative_permittivity both faces must be electrodes at the same voltage; give the voltage here, or the permittivity"),
    ("strip", {"ambient": ELECTRIC, "faces": CONDUCTOR}, 'ambient.outer: "free-space" is not allowed around what is infinitely long with electrodes: its potential has no zero at infinity; use "grounded"'),
    ("infinite-cylinder", {"ambient": ELECTRIC, "faces": {"both": {"charge": 1e-9}}}, 'ambient.outer: "free-space" is not allowed around an infinite cylinder with electrodes: its potential has no zero at infinity; use "grounded"'),
    ("strip", electric(bodies=[{"kind": "sphere", "centre": [0, 0.05, 0], "radius": 0.01, "voltage": 0}]), 'ambient.outer: "free-space" is not allowed around what is infinitely long with conductors: its potential has no zero at infinity; use "grounded"'),
    ("strip", magnetic(bodies=[{"kind": "sphere", "centre": [0, 0.05, 0], "radius": 0.01, "potential": 0}]), 'ambient.outer: "free-space" is not allowed around what is infinitely long with conductors: its potential has no zero at infinity; use "grounded"'),
    ("disc", electric() | {"faces": FILM, "model": {"surroundings": "meshed"}}, f'model.surroundings: "meshed" is not allowed: {RIM}; {MARGIN}, or use "auto"'),
    ("disc", electric() | {"faces": {"top": {"charge": 1e-9}, "bottom": {"charge": -1e-9}}, "model": {"surroundings": "meshed"}}, f'model.surroundings: "meshed" is not allowed: {RIM}; {MARGIN}, or use "auto"'),
    ("disc", electric(applied_field=[0, 0, 1]) | {"faces": FILM}, f"faces.top: not allowed up to the rim together with ambient.applied_field: {RIM}; {MARGIN}"),
    ("disc", electric(bodies=[BALL | {"voltage": 0}]) | {"faces": FILM}, f"faces.top: not allowed up to the rim together with ambient.bodies: {RIM}; {MARGIN}"),
    ("sphere", electric() | {"faces": {"top": {"voltage": 1}}, "model": {"surroundings": "none"}}, f"faces.bottom: missing: needed {NONE}"),
    ("sphere", electric() | {"faces": CONDUCTOR, "model": {"surroundings": "none"}}, f"faces.both: not allowed {NONE}"),
    ("sphere", electric(applied_field=[0, 0, 1]) | {"faces": FILM, "model": {"surroundings": "none"}}, f"ambient.applied_field: not allowed {NONE}"),
    ("sphere", electric(bodies=[BALL | {"voltage": 0}]) | {"faces": FILM, "model": {"surroundings": "none"}}, f"ambient.bodies: not allowed {NONE}"),
    ("sphere", {"ambient": ELECTRIC, "of_shell": {"polarisation": [0, 0, 1e-3]}, "faces": FILM, "model": {"surroundings": "none"}}, f"shell.relative_permittivity: missing: needed {NONE}"),
]  # fmt: skip

MATTER = [
    ("sphere", {"of_shell": {"remanence": [0, 0, 1]}}, 'shell.remanence: a remanence needs a field around the shell: add [ambient] with field = "magnetic"'),
    ("sphere", {"of_shell": {"polarisation": [0, 0, 1]}}, 'shell.polarisation: a polarisation needs a field around the shell: add [ambient] with field = "electric"'),
    ("sphere", {"ambient": ELECTRIC, "of_shell": DIELECTRIC | {"remanence": [0, 0, 1]}}, 'shell.remanence: a remanence is not allowed when ambient.field is "electric"'),
    ("sphere", {"ambient": MAGNETIC, "of_shell": PERMEABLE | {"polarisation": {"expression": ["x", "0", "0"]}}}, 'shell.polarisation: a polarisation is not allowed when ambient.field is "magnetic"'),
    ("sphere", {"ambient": ELECTRIC, "of_shell": DIELECTRIC | {"saturation": 1}}, 'shell.saturation: not allowed when ambient.field is "electric"'),
    ("sphere", {"ambient": MAGNETIC, "of_shell": {"relative_permeability": 1.0, "saturation": 1}}, "shell.relative_permeability: 1.0 is not allowed: must be greater than 1, as there is a saturation"),
    ("sphere", {"ambient": MAGNETIC, "of_shell": {"remanence": [0, 0, 1], "saturation": 1}}, "shell.relative_permeability: missing: must be greater than 1, as there is a saturation"),
    ("strip", {"ambient": MAGNETIC, "of_shell": {"remanence": [0, 0, 1]}}, "shell.remanence.2: 1.0 is not allowed: must be 0 along z, along which nothing changes"),
    ("strip", {"ambient": MAGNETIC, "of_shell": {"remanence": {"expression": ["0", "0", "x"]}}}, "shell.remanence.expression.2: x is not allowed: must be 0 along z, along which nothing changes"),
    ("disc", {"ambient": MAGNETIC, "of_shell": {"remanence": {"expression": ["0", "0", "1/x"]}}}, "shell.remanence.expression.2: 1/x is not allowed: it has no finite value at x = 0 m, y = 0 m, z = 0 m"),
]  # fmt: skip

FLOOR = {"kind": "half-space", "voltage": 0}
BODIES = [
    ("sphere", electric(bodies=[BALL | {"potential": 0}]), 'ambient.bodies.0.potential: not allowed when ambient.field is "electric": a body has a voltage, charge or relative_permittivity'),
    ("sphere", magnetic(bodies=[BALL | PERMEABLE, BALL | {"voltage": 0}]), 'ambient.bodies.1.voltage: not allowed when ambient.field is "magnetic": a body has a potential, relative_permeability or remanence'),
    ("sphere", electric(bodies=[BALL | {"remanence": [0, 0, 1]}]), 'ambient.bodies.0.remanence: not allowed when ambient.field is "electric": a body has a voltage, charge or relative_permittivity'),
    ("sphere", electric(radius=0.055, bodies=[BALL | DIELECTRIC]), "ambient.bodies.0: not allowed here: it reaches beyond the end of space, a sphere of radius 0.055 m"),
    ("sphere", electric(box=[0.1, 0.1, 0.054], outer="grounded", bodies=[BALL | DIELECTRIC]), "ambient.bodies.0: not allowed here: it reaches beyond the end of space, ambient.box"),
    ("sphere", electric(radius=0.1, bodies=[FLOOR | {"level": -0.1}]), "ambient.radius: 0.1 m is not allowed: must be greater than 0.1201 m, the farthest point of the shell from the point below the origin on the half-space plus half its thickness"),
    ("sphere", electric(box=[1, 1, 0.1], outer="grounded", bodies=[FLOOR | {"level": -0.2}]), "ambient.bodies.0.level: -0.2 m is not allowed: must lie within 0.1 m of the origin, where space ends"),
    ("sphere", electric(bodies=[BALL | {"voltage": 0, "centre": [0, 0, 0.022]}]), "ambient.bodies.0: not allowed here: the shell is inside it, at x = 0 m, y = 0 m, z = 0.02 m"),
    ("strip", electric(outer="grounded", bodies=[{"kind": "box", "centre": [0, 0, 7], "size": [1, 1, 1], "voltage": 0}]), "ambient.bodies.0: not allowed here: the shell is inside it, at x = 0 m, y = 0 m"),
    ("disc", electric(bodies=[{"kind": "cylinder", "centre": [0, 0, 0.001], "radius": 1e-3, "length": 0.003, "voltage": 0}]), "ambient.bodies.0: not allowed here: the shell is inside it, at x = 0 m, y = 0 m, z = 0 m"),
    ("sphere", electric(bodies=[FLOOR | {"level": -0.0201}]), "ambient.bodies.0.level: -0.0201 m is not allowed: must be less than -0.0201 m, the lowest z of the shell"),
    ("strip", electric(outer="grounded", bodies=[FLOOR | {"level": 0}]), "ambient.bodies.0.level: 0.0 m is not allowed: must be less than -0.0001 m, the lowest y of the shell"),
    ("strip", magnetic(bodies=[{"kind": "sphere", "centre": [0, 0.05, 0], "radius": 0.01, "remanence": [0, 0, 1]}]), "ambient.bodies.0.remanence.2: 1.0 is not allowed: must be 0 along z, along which nothing changes"),
]  # fmt: skip

AXISYMMETRY = [
    ("sphere", round_about(electric(box=[1, 1, 1], outer="grounded")), f"ambient.box: not allowed {PINNED}: a box is not round"),
    ("sphere", round_about(magnetic(line_currents=[WIRE])), f"ambient.line_currents: not allowed {PINNED}: their field is around them"),
    ("sphere", round_about(electric(bodies=[{"kind": "box", "centre": [0, 0, 0.05], "size": [0.01, 0.01, 0.01], "voltage": 0}])), f'ambient.bodies.0.kind: "box" is not allowed {PINNED}: a box is not round'),
    ("sphere", round_about(electric(bodies=[BALL | {"voltage": 0, "centre": [0.001, 0, 0.05]}])), f"ambient.bodies.0.centre: [0.001, 0.0, 0.05] is not allowed: {ACROSS}"),
    ("sphere", round_about(magnetic(bodies=[BALL | {"remanence": [1, 0, 0]}])), f"ambient.bodies.0.remanence: [1.0, 0.0, 0.0] is not allowed: {ACROSS}"),
    ("sphere", round_about({"ambient": MAGNETIC, "of_shell": {"remanence": [0, 1, 0]}}), f"shell.remanence: [0.0, 1.0, 0.0] is not allowed: {ACROSS}"),
    ("sphere", round_about({"ambient": ELECTRIC, "of_shell": {"polarisation": {"expression": ["-y", "x", "0"]}}}), f"shell.polarisation.expression: [-y, x, 0] is not allowed: {TURNED}"),
    ("sphere", round_about(magnetic(applied_field={"expression": ["x", "-y", "0"]})), f"ambient.applied_field.expression: [x, -y, 0] is not allowed: {TURNED}"),
]  # fmt: skip


@pytest.mark.parametrize(("shape", "parts", "line"), [*SPACE, *ELECTRODES, *MATTER, *BODIES, *AXISYMMETRY])
def test_a_conflict(shape: str, parts: dict[str, Any], line: str) -> None:
    assert refusals(lambda: scene(shape, **parts)) == [line]


@pytest.mark.parametrize(
    ("shape", "parts"),
    [
        ("plate", electric(applied_field=[0, 0, 1])),
        ("plate", {"ambient": ELECTRIC, "faces": CONDUCTOR, "model": {"surroundings": "meshed"}}),
        ("disc", {"ambient": ELECTRIC, "faces": {"both": {"charge": 1e-9}}}),
        ("disc", electric() | {"faces": FILM}),
        ("disc", electric() | {"faces": FILM, "model": {"surroundings": "none"}}),
        ("disc", electric() | {"faces": {"top": {"voltage": 1}}, "model": {"surroundings": "meshed"}}),
        ("strip", electric() | {"faces": FILM}),
        ("strip", {"ambient": ELECTRIC, "faces": {"both": {"charge": 0}}}),
        ("strip", {"ambient": ELECTRIC | {"bodies": [FLOOR | {"level": -0.01}]}, "faces": CONDUCTOR}),
        ("strip", magnetic(line_currents=[WIRE])),
        ("sphere", {"ambient": ELECTRIC, "of_shell": {"polarisation": [0, 0, 1e-3]}}),
        ("sphere", {"ambient": MAGNETIC, "of_shell": {"remanence": [0, 0, 1]}} | {"model": {"reduction": "axisymmetric"}}),
        ("sphere", round_about(magnetic(applied_field=GRADIENT, bodies=[BALL | {"remanence": [0, 0, 1]}]))),
        ("sphere", round_about({"ambient": MAGNETIC, "of_shell": {"remanence": {"expression": ["x", "y", "z"]}}})),
        ("sphere", magnetic(applied_field=GRADIENT, line_currents=[WIRE], bodies=[BALL | PERMEABLE])),
        ("sphere", magnetic(line_currents=[WIRE]) | {"model": {"coupling": "unperturbed"}}),
        ("sphere", electric(radius=0.0551, inside_relative_permittivity=80, bodies=[BALL | DIELECTRIC])),
        ("infinite-cylinder", electric(inside_relative_permittivity=80, applied_field=GRADIENT | {"expression": ["x", "-y", "0"]})),
        ("sphere", {"ambient": MAGNETIC, "of_shell": PERMEABLE | {"saturation": "1 T"} | DIELECTRIC}),
        ("disc", electric(bodies=[BALL | {"voltage": 0}, {"kind": "half-space", "level": -1e-3, "voltage": 5}])),
    ],
)  # fmt: skip
def test_what_fits_together(shape: str, parts: dict[str, Any]) -> None:
    stated = scene(shape, **parts)
    assert Scene.from_toml(stated.to_toml()) == stated


@pytest.mark.parametrize(
    ("shape", "parts", "expected"),
    [
        ("disc", electric() | {"faces": FILM}, True),
        ("strip", electric() | {"faces": FILM}, True),
        ("sphere", electric() | {"faces": FILM}, False),
        ("sphere", electric() | {"faces": FILM, "model": {"surroundings": "none"}}, True),
        ("disc", {"ambient": ELECTRIC, "faces": CONDUCTOR}, False),
        ("disc", {"ambient": ELECTRIC, "faces": {"top": {"voltage": 1}, "bottom": {"voltage": 1}}}, False),
        ("disc", electric() | {"faces": {"top": {"voltage": 1}}}, False),
        ("disc", {}, False),
    ],
)
def test_films_need_no_surroundings(shape: str, parts: dict[str, Any], expected: bool) -> None:
    """Electrodes that meet at a rim are modelled by the field between them unless the scene says otherwise."""
    assert inside_only(scene(shape, **parts)) is expected


def test_what_breaks_axisymmetry_in_a_field() -> None:
    tilted = scene("disc", **magnetic(line_currents=[WIRE], bodies=[BALL | {"centre": [1, 0, 0], "remanence": [1, 0, 0]}]))
    assert [problem.path for problem in axisymmetry_problems(tilted)] == [
        "ambient.line_currents",
        "ambient.bodies.0.centre",
        "ambient.bodies.0.remanence",
    ]


@pytest.fixture(scope="module")
def two_faces(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """A file with two plates in line, called left and right."""
    from netgen.occ import Axes, Glue, WorkPlane

    left = WorkPlane(Axes((0, 0, 0), n=(0, 0, 1), h=(1, 0, 0))).Rectangle(10, 10).Face()
    right = WorkPlane(Axes((10, 0, 0), n=(0, 0, 1), h=(1, 0, 0))).Rectangle(10, 10).Face()
    left.name, right.name = "left", "right"
    path: Path = tmp_path_factory.mktemp("faces") / "plates.step"
    Glue([left, right]).WriteStep(str(path))
    return {"kind": "file", "path": str(path)}


def on_faces(shape: dict[str, Any], field: str = "electric", faces: Any = None, **of_shell: Any) -> dict[str, Any]:
    body = {"shape": shape, "thickness": 1e-4, "material": MATERIAL} | of_shell
    return {"shell": body, "ambient": {"field": field}, "faces": faces or {}}


def test_patterned_electrodes(two_faces: dict[str, Any]) -> None:
    left, right = {"voltage": 1, "where": ["left"]}, {"voltage": 0, "where": ["right"]}
    table = on_faces(two_faces, faces={"top": left, "bottom": left | {"voltage": 0}}, relative_permittivity=3)
    stated = Scene(**table, model={"surroundings": "meshed"})
    assert stated.faces.top is not None and stated.faces.top.where == ("left",)
    assert Scene.from_toml(stated.to_toml()) == stated
    same = on_faces(two_faces, faces={"top": left, "bottom": left})
    assert refusals(lambda: Scene(**same)) == [
        "shell.relative_permittivity: missing: needed because the electrodes do not cover all of the shell"
    ]
    unlike = on_faces(two_faces, faces={"top": left, "bottom": right}, relative_permittivity=3)
    assert refusals(lambda: Scene(**unlike)) == [
        "faces.bottom.where: not allowed: two electrodes must cover the same faces, those of faces.top"
    ]
    unknown = on_faces(two_faces, faces={"top": {"voltage": 1, "where": ["lefd"]}}, relative_permittivity=3)
    assert refusals(lambda: Scene(**unknown)) == [
        'faces.top.where.0: "lefd" is not allowed: must be "left" or "right"; did you mean "left"?'
    ]


def test_regions_in_a_field(two_faces: dict[str, Any]) -> None:
    north: dict[str, Any] = {"faces": ["left"], "remanence": [0, 0, 1]}
    stated = Scene(**on_faces(two_faces, "magnetic", regions=[north]))
    assert Scene.from_toml(stated.to_toml()) == stated
    wrong = on_faces(two_faces, "electric", regions=[north], relative_permittivity=3)
    assert refusals(lambda: Scene(**wrong)) == [
        'shell.regions.0.remanence: a remanence is not allowed when ambient.field is "electric"'
    ]
    soft = on_faces(two_faces, "magnetic", regions=[{"faces": ["left"], "relative_permeability": 0.5}], relative_permeability=2, saturation=1)
    assert refusals(lambda: Scene(**soft)) == [
        "shell.regions.0.relative_permeability: 0.5 is not allowed: must be greater than 1, as there is a saturation"
    ]
    vacuum = on_faces(two_faces, "magnetic", regions=[{"faces": ["left"], "saturation": 1}], relative_permeability=1)
    assert refusals(lambda: Scene(**vacuum)) == [
        "shell.relative_permeability: 1.0 is not allowed: must be greater than 1, as there is a saturation"
    ]


@pytest.mark.parametrize(
    ("parts", "paths"),
    [
        ({"ambient": ELECTRIC | {"radius": 0.03, "bodies": [BALL | {"radius": -1, "voltage": 0}]}, "of_shell": DIELECTRIC}, ["ambient.bodies.0.radius"]),
        ({"ambient": ELECTRIC | {"bodies": [BALL | {"volts": 0}]}, "of_shell": DIELECTRIC}, ["ambient.bodies.0.volts"]),
        ({"ambient": ELECTRIC | {"box": [1, 1, "x"]}, "of_shell": DIELECTRIC}, ["ambient.box.2"]),
        ({"ambient": MAGNETIC | {"applied_field": {"expression": ["x", "y", "w"]}}, "model": {"coupling": "unperturbed"}}, ["ambient.applied_field.expression.2", "shell.relative_permeability"]),
        ({"ambient": MAGNETIC, "of_shell": {"remanence": [0, 0, "x"]}}, ["shell.remanence.2"]),
        ({"ambient": MAGNETIC, "of_shell": {"saturation": -1}}, ["shell.saturation", "shell.relative_permeability"]),
        ({"ambient": ELECTRIC, "faces": {"both": {"volts": 1}}}, ["faces.both.volts"]),
        ({"ambient": ELECTRIC, "faces": {"both": {"voltage": "x"}}}, ["faces.both.voltage"]),
        ({"ambient": ELECTRIC, "of_shell": DIELECTRIC, "faces": {"top": {"charge": "x"}, "bottom": {"where": 3}}}, ["faces.top.charge", "faces.bottom.where"]),
    ],
)  # fmt: skip
def test_wrong_fields_start_no_false_conflicts(parts: dict[str, Any], paths: list[str]) -> None:
    assert [line.partition(": ")[0] for line in refusals(lambda: scene(**parts))] == paths
