"""What a study may say: the file, its parameters, its design and its quantities; everything wrong is one message."""

# ruff: noqa: E501 - one case per line, with the whole message

from __future__ import annotations

import math
import textwrap
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w

from embedding import Scene, SceneError
from embedding.studies import Grid, LatinHypercube, Limits, Quantity, Rows, Study, cases_of, load_study
from tests.studies.samples import PRESSURE, SCENE, balloon, keys, study

THICKNESS = "shell.thickness"
FILE = """
scene = "balloon.toml"

[parameters]
shell.thickness = ["0.2 mm", "0.4 mm"]
"loads.pressure_bottom" = ["1 kPa", 500, "2e3 Pa"]

[quantities]
stretch = "stretch"
"""


def written(folder: Path, text: str) -> Path:
    (folder / "balloon.toml").write_text(SCENE)
    path = folder / "map.toml"
    path.write_text(textwrap.dedent(text))
    return path


def test_a_file_is_a_grid(tmp_path: Path) -> None:
    found = load_study(written(tmp_path, FILE))
    assert found.design == Grid()
    assert found.limits == Limits()
    cases = cases_of(found)
    assert [list(case.values.values()) for case in cases] == [
        [thickness, pressure] for thickness in (2e-4, 4e-4) for pressure in (1000.0, 500.0, 2000.0)
    ]
    assert [case.number for case in cases] == list(range(6))
    last = cases[-1].scene
    assert last is not None
    assert (last.shell.thickness, last.loads.pressure_bottom) == (4e-4, 2000.0)
    assert balloon().with_overrides(cases[-1].changes) == last


def test_rows_go_together() -> None:
    found = study({THICKNESS: ["0.2 mm", "0.3 mm"], PRESSURE: [500, 600]}, design={"kind": "rows"})
    assert found.design == Rows()
    assert [list(case.values.values()) for case in cases_of(found)] == [[2e-4, 500.0], [3e-4, 600.0]]


def test_parameters_that_go_together() -> None:
    """They are one axis of the grid, at the place of the first of them."""
    values = {"path.0.steps": [2, 3], THICKNESS: ["0.2 mm", "0.3 mm"], PRESSURE: [500, 600]}
    found = study(values, design={"kind": "grid", "together": [[PRESSURE, "path.0.steps"]]})
    assert found.axes == ((PRESSURE, "path.0.steps"), (THICKNESS,))
    rows = [case.values for case in cases_of(found)]
    assert [[row[PRESSURE], row["path.0.steps"], row[THICKNESS]] for row in rows] == [
        [500.0, 2.0, 2e-4], [500.0, 2.0, 3e-4], [600.0, 3.0, 2e-4], [600.0, 3.0, 3e-4],
    ]  # fmt: skip
    assert list(rows[0]) == list(values)


def test_an_applied_field_has_a_unit() -> None:
    magnetic = {"field": "magnetic", "applied_field": [0, 0, 1]}
    scene = balloon().model_dump(mode="json", exclude_none=True) | {"ambient": magnetic}
    scene["shell"]["relative_permeability"] = 2.0
    (case,) = cases_of(study({"ambient.applied_field.2": ["2 kA/m"]}, scene=scene))
    assert case.values == {"ambient.applied_field.2": 2000.0}


def test_tables_lists_and_words_are_values_too() -> None:
    laws = [{"law": "neo-hookean", "shear_modulus": "30 kPa"}, {"law": "gent", "shear_modulus": 3e4, "limit": 60}]
    found = study({"shell.material": laws, "path.0.steps": [2, 3], "model.theory": ["membrane"]})
    cases = cases_of(found)
    scenes = [case.scene for case in cases]
    assert [scene.shell.material.law for scene in scenes if scene] == ["neo-hookean", "neo-hookean", "gent", "gent"]
    assert [scene.path[0].steps for scene in scenes if scene] == [2, 3, 2, 3]
    assert cases[0].values == {
        "shell.material": '{ "law" = "neo-hookean", "shear_modulus" = "30 kPa" }',
        "path.0.steps": 2.0,
        "model.theory": "membrane",
    }


def hypercube(samples: int, seed: int) -> list[dict[str, float | str]]:
    bounds = {THICKNESS: {"low": "0.2 mm", "high": "0.4 mm"}, "path.0.steps": {"low": 1, "high": 4}}
    design = LatinHypercube(samples=samples, seed=seed)
    return [case.values for case in cases_of(study(bounds, design=design))]


def test_a_latin_hypercube_has_one_case_in_each_part() -> None:
    """The property that gives it its name, of both columns."""
    rows = hypercube(8, 3)
    thickness = np.array([row[THICKNESS] for row in rows], dtype=float)
    assert sorted(np.floor((thickness - 2e-4) / 2e-4 * 8).astype(int)) == list(range(8))
    assert sorted(row["path.0.steps"] for row in rows) == [1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0]


def test_a_latin_hypercube_is_that_of_its_seed() -> None:
    assert hypercube(5, 3) == hypercube(5, 3)
    assert hypercube(5, 3) != hypercube(5, 4)


def test_the_hash_is_that_of_what_the_numbers_depend_on(tmp_path: Path) -> None:
    first, second = keys(study({PRESSURE: [500, 600]}))
    assert first != second
    assert keys(study({PRESSURE: ["0.5 kPa", "6e2 Pa"]}, limits={"threads": 2, "seconds": 1})) == [first, second]
    renamed = Scene.from_toml(SCENE.replace("small balloon", "another"))
    assert keys(study({PRESSURE: [500]}, scene=renamed)) == [first]
    thicker = Scene.from_toml(SCENE.replace("0.2 mm", "0.21 mm"))
    assert keys(study({PRESSURE: [500]}, scene=thicker)) != [first]


def test_the_hash_of_a_surface_file_is_that_of_its_content(tmp_path: Path) -> None:
    from netgen.occ import Face, Rectangle

    def saved(name: str, width: float) -> list[str]:
        face: Face = Rectangle(10, width).Face()
        face.WriteStep(str(tmp_path / name))
        shape = f'{{ kind = "file", path = "{tmp_path / name}" }}'
        text = SCENE.replace('{ kind = "sphere", radius = "20 mm" }', shape)
        return keys(study({THICKNESS: ["0.2 mm"]}, scene=Scene.from_toml(text)))

    first = saved("first.step", 5)
    (tmp_path / "copy.step").write_bytes((tmp_path / "first.step").read_bytes())
    text = SCENE.replace('{ kind = "sphere", radius = "20 mm" }', f'{{ kind = "file", path = "{tmp_path}/copy.step" }}')
    assert keys(study({THICKNESS: ["0.2 mm"]}, scene=Scene.from_toml(text))) == first
    assert saved("first.step", 6) != first


def test_quantities() -> None:
    states: dict[str, Any] = {
        "last": {"voltage": 5.0, "stretch": 1.5},
        "max": {"voltage": 7.0, "stretch": 1.5},
        "min": {"voltage": 1.0, "stretch": 1.0},
        "limit": {"voltage": 7.0, "stretch": 1.2},
        "bifurcation": None,
    }
    values = {
        "voltage": 5.0,
        "voltage at end": 5.0,
        "voltage at last": 5.0,
        "voltage at limit": 7.0,
        "max of voltage": 7.0,
        "min of stretch": 1.0,
    }
    for text, value in values.items():
        assert Quantity.parse(text).value(states, complete=True) == value
    assert math.isnan(Quantity.parse("voltage at bifurcation").value(states, complete=True))
    of_part = {text: Quantity.parse(text).value(states, complete=False) for text in values}
    assert [text for text, value in of_part.items() if not math.isnan(value)] == ["voltage at last", "voltage at limit"]


WRONG = {
    'scene = "nowhere.toml"': "nowhere.toml: there is no such file",
    'colour = "red"': 'map.toml: colour: unknown key: the keys here are name, scene, parameters, design, quantities, limits',
    'limits.seconds = "3 m"': 'map.toml: limits.seconds: 3 m is not allowed: "m" is a unit of length: '
    'must be a time greater than 0, such as "10 min"',
    'design.kind = "gird"': 'map.toml: design.kind: "gird" is not allowed: '
    'must be "grid", "rows" or "latin-hypercube"; did you mean "grid"?',
    'design.kind = "latin-hypercube"': "map.toml: design.samples: missing: must be a whole number of at least 1 and at most 100000",
    'design = { kind = "rows" }': "map.toml: parameters.loads.pressure_bottom: [1 kPa, 500, 2e3 Pa] is not allowed: "
    "there are 3 values, and 2 of the first parameter; rows need as many",
    'design = { kind = "grid", together = [["shell.thickness", "shell.thicknes"]] }': "map.toml: design.together: "
    "[shell.thickness, shell.thicknes] is not allowed: shell.thicknes is no parameter of the study",
    'design = { kind = "grid", together = [["shell.thickness", "shell.thickness"]] }': "map.toml: design.together: "
    "[shell.thickness, shell.thickness] is not allowed: shell.thickness is named twice",
    'design = { kind = "grid", together = [["shell.thickness", "loads.pressure_bottom"]] }': "map.toml: "
    "parameters.loads.pressure_bottom: [1 kPa, 500, 2e3 Pa] is not allowed: there are 3 values, and 2 of shell.thickness; "
    "what goes together needs as many",
    'design = { kind = "grid", along = "shell.thicknes" }': "map.toml: design.along: shell.thicknes is not allowed: "
    "shell.thicknes is no parameter of the study",
    'design = { kind = "grid", along = "shell.thickness" }\nquantities.most = "max of stretch"': "map.toml: quantities.most: "
    'max of stretch is not allowed: a case that starts from its neighbour has an end and no path: ask for it "at end"',
    'parameters."shell.thickness" = "1 mm"': "map.toml: parameters.shell.thickness: 1 mm is not allowed: must be a list of values, "
    'such as ["0.5 mm", "1 mm"], or bounds { low = "0.5 mm", high = "2 mm" }',
    'parameters."shell.thickness" = { low = 1 }': "map.toml: parameters.shell.thickness: a table is not allowed: must be a list of values, "
    'such as ["0.5 mm", "1 mm"], or bounds { low = "0.5 mm", high = "2 mm" }',
    'parameters."shell.thickness" = { low = 1, high = 2 }': "map.toml: parameters.shell.thickness: a table is not allowed: "
    'bounds are for a design of kind "latin-hypercube"; a "grid" needs a list',
    'quantities.stretch = "stretch at noon"': "map.toml: quantities.stretch: stretch at noon is not allowed: must be a scalar of a step, "
    'such as "stretch", "voltage at limit" or "max of stretch_max"; places are end, last, limit, bifurcation',
    'quantities.status = "stretch"': "map.toml: quantities.status: status is not allowed: every table has a column status already",
    'quantities."a b" = "stretch"': "map.toml: quantities: a b is not allowed: a name of a quantity has letters, digits and underscores only",
    "quantities = {}": 'map.toml: quantities: a table is not allowed: must be a table of names and scalars, '
    'such as { pull_in = "voltage at limit" }',
}  # fmt: skip


@pytest.mark.parametrize("line", WRONG)
def test_a_wrong_file_is_one_message(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    path = written(tmp_path, FILE)
    table = tomllib.loads(FILE)
    table["parameters"] = {THICKNESS: ["0.2 mm", "0.4 mm"], PRESSURE: ["1 kPa", 500, "2e3 Pa"]}
    for key, value in tomllib.loads(line).items():
        nested = isinstance(value, dict) and isinstance(table.get(key), dict) and value
        table[key] = {**table[key], **value} if nested else value
    path.write_text(tomli_w.dumps(table))
    with pytest.raises(SceneError) as caught:
        load_study(path.name)
    assert str(caught.value) == WRONG[line]


MISSING = 'scene: missing: must be the name of a scene file, such as "balloon.toml", or the tables of a scene'
THICK = "scene.shell.thickness: 0.05 m is not allowed: half of it must be less than shell.shape.radius = 0.02 m"
WRONG_SCENES: dict[str, Callable[[dict[str, Any]], object]] = {
    MISSING: lambda table: table.pop("scene"),
    MISSING.replace("missing", "3 is not allowed"): lambda table: table.update(scene=3),
    THICK: lambda table: table["scene"]["shell"].update(thickness="50 mm"),
    "scene.shell.thickness: 1 s is not allowed": lambda table: table["scene"]["shell"].update(thickness="1 s"),
}


def test_a_scene_within_a_study(tmp_path: Path) -> None:
    def load(change: Callable[[dict[str, Any]], object] | None = None) -> Study:
        table = tomllib.loads(FILE) | {"scene": tomllib.loads(SCENE)}
        if change is not None:
            change(table)
        (tmp_path / "map.toml").write_text(tomli_w.dumps(table))
        return load_study(tmp_path / "map.toml")

    assert load().scene == balloon()
    for message, change in WRONG_SCENES.items():
        with pytest.raises(SceneError) as caught:
            load(change)
        assert str(caught.value).startswith(f"{tmp_path / 'map.toml'}: {message}")


WRONG_VALUES = {
    "shell.thicknes": (["1 mm"], 'parameters.shell.thicknes: unknown key: did you mean "thickness"?'),
    "shell.thickness": (
        ["1 mm", "1 s"],
        'parameters.shell.thickness: 1 s is not allowed: "s" is a unit of time: '
        'must be a length greater than 0, such as "0.2 mm"',
    ),
    "path.0.steps": ([2, 0], "parameters.path.0.steps: 0 is not allowed: must be at least 1 and at most 10000"),
    "name.of": ([1], "parameters.name.of: name is a single value and has no key of"),
}


@pytest.mark.parametrize("path", WRONG_VALUES)
def test_a_wrong_value_is_one_message(path: str) -> None:
    values, message = WRONG_VALUES[path]
    with pytest.raises(SceneError) as caught:
        cases_of(study({path: values, PRESSURE: [400, 500]}))
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("bounds", "message"),
    [
        (("1 mm", "1 s"), 'high = 1 s is not allowed: "s" is a unit of time: must be a length greater than 0, such as "0.2 mm"'),
        (("2 mm", "1 mm"), "low = 0.002 is not allowed: must be less than high = 0.001"),
    ],
)  # fmt: skip
def test_wrong_bounds_are_one_message(bounds: tuple[str, str], message: str) -> None:
    low, high = bounds
    with pytest.raises(SceneError) as caught:
        cases_of(study({THICKNESS: {"low": low, "high": high}}, design=LatinHypercube(samples=3)))
    assert str(caught.value) == f"parameters.shell.thickness: {message}"


def test_values_that_do_not_fit_together_are_a_row() -> None:
    """Each is allowed by itself; half the thickness must be less than the radius."""
    good, bad = cases_of(study({THICKNESS: ["1 mm", "50 mm"]}))
    assert good.scene is not None
    assert bad.scene is None
    assert bad.refusal.startswith("shell.thickness: ")
    assert bad.values == {THICKNESS: 0.05}
