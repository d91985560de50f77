"""Scene files: round trips, and one clear line for every file that cannot be read."""

from __future__ import annotations

import copy
import math
import tomllib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from embedding.errors import SceneError
from embedding.scene import Scene, load_scene
from tests.scene.samples import MATERIAL, SHAPES, refusals, scene

BALLOON = """
name = "charged balloon"

[shell]
thickness = "0.2 mm"
relative_permittivity = 4
shape = { kind = "sphere", radius = "20 mm" }
material = { law = "mooney-rivlin", c1 = "40 kPa", c2 = 10e3 }

[loads]
pressure_bottom = "1.5 kPa"
pressure_top = { expression = "0.1*exp(-z/0.01)", unit = "kPa" }

[ambient]
field = "electric"
radius = 0.08

[faces]
top.voltage = "6 kV"

[[path]]
name = "inflate"
steps = 5
field = 0

[[path]]
name = "charge"
"""


def test_reading() -> None:
    balloon = Scene.from_toml(BALLOON)
    assert balloon.name == "charged balloon"
    assert balloon.shell.thickness == 0.0002
    assert balloon.shell.material.shear_modulus == 1e5
    assert balloon.faces.top is not None and balloon.faces.top.voltage == 6000.0
    assert [stage.steps for stage in balloon.path] == [5, None]
    assert balloon.loads.pressure_fields["pressure_top"](0.0, 0.0, 0.0) == 100.0


def test_writing_and_reading_give_the_same_scene(tmp_path: Path) -> None:
    balloon = Scene.from_toml(BALLOON)
    text = balloon.to_toml()
    assert Scene.from_toml(text) == balloon
    assert Scene.from_toml(text).to_toml() == text
    file = tmp_path / "scene.toml"
    file.write_text(text, encoding="utf-8")
    assert load_scene(file) == load_scene(str(file)) == balloon


LENGTHS = st.floats(1e-6, 1e6)
STRESSES = st.floats(1e-3, 1e12)
ANY = st.floats(-1e30, 1e30)
VECTORS = st.tuples(ANY, ANY, ANY)
NAMES = st.text(st.characters(codec="utf-8"), min_size=1, max_size=20).filter(
    lambda name: name.isprintable() and name.strip() != ""
)
PRESSURES = ANY | st.builds(
    dict,
    expression=st.sampled_from(["x", "2*y - 1e-3", "sin(pi*z)"]),
    unit=st.sampled_from(["Pa", "kPa", "N/mm^2"]),
)


SUPPORTS = st.fixed_dictionaries({"where": st.just("surface"), "fix": st.just(["z", "x"])})
STAGES = st.fixed_dictionaries(
    {"name": NAMES, "steps": st.integers(1, 10000), "mechanical": ANY, "field": ANY}
)


@st.composite
def tables(draw: st.DrawFn) -> dict[str, Any]:
    """Scenes of discs and spheres with every kind of field in them."""
    kind = draw(st.sampled_from(["disc", "sphere"]))
    radius = draw(LENGTHS)
    law = draw(st.sampled_from(["neo-hookean", "mooney-rivlin"]))
    constants = ["shear_modulus"] if law == "neo-hookean" else ["c1", "c2"]
    table: dict[str, Any] = {
        "name": draw(NAMES),
        "shell": {
            "shape": {"kind": kind, "radius": radius},
            "thickness": radius * draw(st.floats(1e-6, 1.9)),
            "material": {"law": law} | {name: draw(STRESSES) for name in constants},
            "relative_permittivity": draw(LENGTHS),
        },
        "loads": {
            "pressure_top": draw(PRESSURES),
            "pressure_bottom": draw(PRESSURES),
            "body_force": draw(VECTORS),
            "rim": draw(st.sampled_from(["traction-free", "pressurised"])),
            "variant": draw(st.sampled_from(["embedding-aware", "net", "as-published"])),
        },
        "supports": draw(st.lists(SUPPORTS, max_size=2)),
        "path": draw(st.lists(STAGES, min_size=1, max_size=3)),
        "solver": {"tolerance": draw(st.floats(1e-13, 1e-3)), "threads": draw(st.integers(1, 1024))},
    }  # fmt: skip
    if kind == "sphere" and draw(st.booleans()):
        table["ambient"] = {"field": "electric", "applied_field": draw(VECTORS), "radius": 3 * radius}
        table["faces"] = {"top": {"voltage": draw(ANY)}}
    return table


@given(tables())
def test_round_trip_is_exact(table: dict[str, Any]) -> None:
    original = Scene.from_table(table)
    copy = Scene.from_toml(original.to_toml())
    assert copy == original
    assert hash(copy) == hash(original)
    assert copy.to_toml() == original.to_toml()


@given(st.dictionaries(st.sampled_from(list(Scene.model_fields)), st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=5,
)))  # fmt: skip
def test_nothing_but_a_scene_error_comes_out(table: dict[str, Any]) -> None:
    with pytest.raises(SceneError) as caught:
        Scene.from_table(table)
    assert caught.value.problems
    assert all("\n" not in str(problem) for problem in caught.value.problems)


def _leaves(node: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    return [path, *(leaf for key, value in items for leaf in _leaves(value, (*path, key)))]


COMPLETE = tomllib.loads(
    scene(
        of_shell={"relative_permittivity": 2.0},
        ambient={"field": "electric", "applied_field": [1, 2, 3]},
        faces={"top": {"voltage": 1}},
        loads={"pressure_top": {"expression": "x"}},
        supports=[{"where": "surface", "fix": ["x"]}],
        path=[{"name": "a"}, {"volume_ratio": None}],
    ).to_toml()
)
JUNK = st.sampled_from(
    [None, True, -1, 0, 1e300, math.nan, "", "x", "3 kg", "1 mm", [], [1, "x"], {}, {"kind": "disc"}]
)


@given(st.lists(st.tuples(st.sampled_from(_leaves(COMPLETE)[1:]), JUNK), min_size=1, max_size=3))
def test_a_damaged_scene_is_refused_in_words(damage: list[tuple[tuple[Any, ...], Any]]) -> None:
    table: Any = copy.deepcopy(COMPLETE)
    for path, junk in damage:
        node = table
        try:
            for key in path[:-1]:
                node = node[key]
            node[path[-1]] = junk
        except (TypeError, KeyError, IndexError):
            continue  # an earlier damage took the place away
    try:
        built = Scene.from_table(table)
    except SceneError as error:
        assert all(problem.path and "\n" not in problem.message for problem in error.problems)
    else:
        assert Scene.from_toml(built.to_toml()) == built


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "not a scene: it is empty"),
        (b"# nothing\n", "not a scene: it is empty"),
        (b"a = 1\n[tool]\nb = 2\n", "not a scene: it has none of the keys name, shell, supports, loads"),
        (b"name = \xff\n", "not UTF-8 text: byte 7 cannot be decoded"),
        (b"{\"shell\": 1}", "not valid TOML: "),
        (b"[shell]\nthickness = 0.2 mm\n", "not valid TOML: "),
        (b"name = " + b"[" * 20000, "tables and lists may lie at most 50 deep in each other"),
        (b"name = 2020-02-30T00:00:00", "not valid TOML: "),
        (b"name = " + b"1" * 5000, "not valid TOML: "),
        (b"#" * 4_000_001, "too large for a scene file: more than 4000000 bytes"),
    ],
)  # fmt: skip
def test_unreadable_files(tmp_path: Path, content: bytes, message: str) -> None:
    file = tmp_path / "scene.toml"
    file.write_bytes(content)
    with pytest.raises(SceneError) as caught:
        load_scene(file)
    assert len(caught.value.problems) == 1
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith(f"{file}: {message}")
    assert caught.value.source == str(file)


def test_files_that_are_none(tmp_path: Path) -> None:
    assert refusals(lambda: load_scene(tmp_path / "none.toml")) == ["there is no such file"]
    assert refusals(lambda: load_scene(tmp_path)) == ["this is a directory, not a scene file"]
    assert refusals(lambda: load_scene("")) == ["this is a directory, not a scene file"]
    assert refusals(lambda: load_scene("a\0b")) == ["cannot be read: embedded null byte"]
    assert refusals(lambda: load_scene("n" * 5000)) == ["cannot be read: File name too long"]
    (tmp_path / "file").touch()
    assert refusals(lambda: load_scene(tmp_path / "file" / "scene.toml")) == [
        "cannot be read: Not a directory"
    ]


def test_a_byte_order_mark_is_accepted(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_bytes(b"\xef\xbb\xbf" + BALLOON.encode())
    assert load_scene(file) == Scene.from_toml(BALLOON)


def test_errors_name_their_source(tmp_path: Path) -> None:
    file = tmp_path / "bad.toml"
    file.write_text('[shell]\nthickness = nan\nshape = { kind = "disc", radius = inf }\n', encoding="utf-8")
    with pytest.raises(SceneError) as caught:
        load_scene(file)
    assert str(caught.value).splitlines() == [
        f"{file}: 3 problems",
        "  shell.shape.radius: inf m is not allowed: must be finite",
        "  shell.thickness: nan m is not allowed: must be finite",
        '  shell.material: missing: must be a table with law = "neo-hookean", "mooney-rivlin", "yeoh", "gent", '
        '"ogden", "st-venant-kirchhoff" or "strain-energy"',
    ]
    with pytest.raises(SceneError, match="^in memory: shell: missing"):
        Scene.from_toml('name = "x"', source="in memory")
    with pytest.raises(SceneError, match="^in memory: not valid TOML"):
        Scene.from_toml("name", source="in memory")


def test_conflicts_name_their_source() -> None:
    with pytest.raises(SceneError, match=r"^s\.toml: shell\.relative_permittivity: missing"):
        Scene.from_table({"shell": scene().shell, "ambient": {"field": "electric"}}, "s.toml")


def test_every_shape_survives() -> None:
    for shape in SHAPES:
        built = scene(shape, of_shell={"material": MATERIAL})
        assert Scene.from_toml(built.to_toml()) == built
        assert all(math.isfinite(value) for point in built.shell.shape.sample_points() for value in point)
