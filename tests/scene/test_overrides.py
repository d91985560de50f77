"""Overrides: TOML values, plain text, entries of lists, and refusals with the nearest name."""

# ruff: noqa: E501 - one case per line, with the whole message

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from embedding.scene import Scene, load_scene
from embedding.scene.overrides import apply_overrides, parse_override
from tests.scene.samples import refusals, scene

FILE = """
[shell]
thickness = 1e-3
shape = { kind = "sphere", radius = 0.02 }
material = { law = "neo-hookean", shear_modulus = 1e5 }
"""


@pytest.mark.parametrize(
    ("text", "keys", "value"),
    [
        ("shell.thickness=0.1 mm", ["shell", "thickness"], "0.1 mm"),
        ("loads.pressure_top=2e3", ["loads", "pressure_top"], 2000.0),
        ("path.0.steps=5", ["path", "0", "steps"], 5),
        (" a . b = 1 ", ["a", "b"], 1),
        ("a=true", ["a"], True),
        ("a=[1, 2]", ["a"], [1, 2]),
        ('a={b = "c"}', ["a"], {"b": "c"}),
        ('a="quoted = text"', ["a"], "quoted = text"),
        ("a=plain = text", ["a"], "plain = text"),
        ("a=3d", ["a"], "3d"),
        ("a=", ["a"], ""),
        ("a=2024-01-01", ["a"], "2024-01-01"),
        ("a=1\nb=2", ["a"], "1\nb=2"),
    ],
)
def test_reading(text: str, keys: list[str], value: Any) -> None:
    assert parse_override(text) == (keys, value)


def test_loading_with_overrides(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(FILE, encoding="utf-8")
    changed = load_scene(
        file,
        [
            "shell.thickness=0.1 mm",
            "loads.pressure_top=2e3",
            "path.0.steps=5",
            "path.1.name=second",
            "model.reduction=3d",
            "ambient.field=electric",
            "faces.top.voltage=6 kV",
            "faces.bottom={voltage = 6e3}",
            "shell.thickness=0.3 mm",
        ],
    )
    assert changed.shell.thickness == 0.0003
    assert changed.loads.pressure_top == 2000.0
    assert [(stage.name, stage.steps) for stage in changed.path] == [("load", 5), ("second", None)]
    assert changed.model.reduction == "3d"
    assert changed.faces.bottom == changed.faces.top
    assert load_scene(file).shell.thickness == 1e-3


def test_overrides_of_a_scene() -> None:
    original = scene(loads={"body_force": [1, 2, 3]})
    changed = original.with_overrides(["loads.body_force.1=7 kN/m^3", "path.0.steps=3"])
    assert changed.loads.body_force == (1.0, 7000.0, 3.0)
    assert changed.path[0].steps == 3
    assert original.path[0].steps is None
    assert original.with_overrides([]) == original


@pytest.mark.parametrize(
    ("override", "line"),
    [
        ("shell.thicknes=1", 'shell.thicknes: unknown key: did you mean "thickness"?'),
        ("shel.thickness=1", 'shel: unknown key: did you mean "shell"?'),
        ("shell.shape.raduis=1", 'shell.shape.raduis: unknown key: did you mean "radius"?'),
        ("path.0.step=1", 'path.0.step: unknown key: did you mean "steps"?'),
        ("shell.thickness=-1", "shell.thickness: -1 m is not allowed: must be greater than 0"),
        ("shell.thickness=nan", "shell.thickness: nan m is not allowed: must be finite"),
        ("shell.thickness.top=1", "shell.thickness.top: shell.thickness is a single value and has no key top"),
        ("path.steps=5", "path.steps: path is a list: name one of its entries by number, such as path.0"),
        ("path.3.steps=5", "path.3.steps: the next entry of path has the number 1; or give the whole list"),
        ("path.-1.steps=5", "path.-1.steps: path is a list: name one of its entries by number, such as path.0"),
        ("shell.thickness", "shell.thickness: an override reads key=value, such as shell.thickness=0.1 mm"),
        ("=1", "=1: empty key: an override reads key=value, such as shell.thickness=0.1 mm"),
        ("shell..thickness=1", "shell..thickness: empty key: an override reads key=value, such as shell.thickness=0.1 mm"),
        ("loads.body_force=[1, 2", "loads.body_force: [1, 2 is not a valid TOML value"),
        ("shell=5", "shell: 5 is not allowed: must be a table with the keys shape, thickness, material, density, regions, relative_permittivity, relative_permeability, remanence, polarisation, saturation"),
        ("name=5", "name: 5 is not allowed: must be text on one line, of 1 to 100 printable characters"),
    ],
)  # fmt: skip
def test_refusals(override: str, line: str) -> None:
    assert refusals(lambda: scene().with_overrides([override])) == [line]


def test_all_broken_overrides_come_at_once(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(FILE, encoding="utf-8")
    assert refusals(lambda: load_scene(file, ["a", "path.7.steps=1", "name=ok"])) == [
        "a: an override reads key=value, such as shell.thickness=0.1 mm",
        "path.7.steps: the next entry of path has the number 0; or give the whole list",
    ]


def test_the_original_table_is_left_alone() -> None:
    table: dict[str, Any] = {"shell": {"shape": {"radius": 1}}}
    apply_overrides(table, ["shell.shape.radius=2", "path.0.steps=1"])
    assert table == {"shell": {"shape": {"radius": 1}}}


def test_a_missing_shell_is_still_named() -> None:
    assert refusals(lambda: Scene.from_table(apply_overrides({}, ["name=a"]))) == [
        "shell: missing: must be a table with the keys "
        "shape, thickness, material, density, regions, relative_permittivity, relative_permeability, "
        "remanence, polarisation, saturation"
    ]
