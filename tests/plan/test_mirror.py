"""Mirror planes are used only where loads and supports are their own mirror image."""

from __future__ import annotations

from typing import Any

import pytest

from embedding import Scene, explain
from tests.scene.samples import MATERIAL

R = 0.02
SHELL: dict[str, Any] = {"thickness": 2e-4, "material": MATERIAL, "density": 1000.0}
CYLINDER = {"kind": "cylinder", "radius": R, "length": 2 * R}
SPHERE = {"kind": "sphere", "radius": R}


def planes(shape: dict[str, Any], **parts: Any) -> str:
    scene = Scene(shell=SHELL | {"shape": shape}, model={"reduction": "3d"}, **parts)
    return "".join(explain(scene).reduction.planes)


def point(at: tuple[float, ...], force: tuple[float, ...]) -> dict[str, Any]:
    return {"at": [R * c for c in at], "force": list(force)}


@pytest.mark.parametrize(
    ("loads", "expected"),
    [
        ({}, "xyz"),
        ({"gravity": [0, 0, -9.81]}, "xy"),
        ({"surface_force": [0, 3, 0]}, "xz"),
        ({"surface_force": {"expression": ["x", "y*z*z", "z"]}}, "xyz"),
        ({"surface_force": {"expression": ["x*x", "y", "y"]}}, ""),
        ({"pressure_bottom": {"expression": "1 + x"}}, "yz"),
        ({"point_loads": [point((0, 0, 1), (0, 0, 1))]}, "xy"),
        ({"point_loads": [point((0, 0, 1), (0, 0, 1)), point((0, 0, -1), (0, 0, -1))]}, "xyz"),
        ({"point_loads": [point((0, 0, 1), (0, 0, 1)), point((0, 0, -1), (0, 0, 1))]}, "xy"),
        ({"point_loads": [point((0, 0, 1), (1, 0, 1))]}, "y"),
        ({"point_loads": [point((0.6, 0, 0.8), (1, 0, 2)), point((-0.6, 0, 0.8), (-1, 0, 2))]}, "xy"),
        ({"point_loads": [point((0.6, 0, 0.8), (1, 0, 2)), point((-0.6, 0, 0.8), (1, 0, 2))]}, "y"),
        ({"point_loads": [point((0.6, 0, 0.8), (1, 0, 2)), point((-0.6, 0, 0.8), (-1, 0, 1))] * 2}, "y"),
        ({"point_loads": [point((1, 0, 0), (2, 0, 0)), *[point((-1, 0, 0), (-1, 0, 0))] * 2]}, "xyz"),
    ],
)
def test_loads_on_a_sphere(loads: dict[str, Any], expected: str) -> None:
    assert planes(SPHERE, loads=loads) == expected


def pulled(*entries: tuple[str, tuple[float, ...]], **more: Any) -> dict[str, Any]:
    return {"edge_tractions": [{"edge": edge, "traction": list(t)} | more for edge, t in entries]}


@pytest.mark.parametrize(
    ("loads", "expected"),
    [
        (pulled(("end1", (0, 0, 1))), "xy"),
        (pulled(("end0", (0, 0, -1)), ("end1", (0, 0, 1))), "xyz"),
        (pulled(("end0", (0, 0, 1)), ("end1", (0, 0, 1))), "xy"),
        (pulled(("end0", (1, 0, 0)), ("end1", (1, 0, 0))), "yz"),
        (pulled(("end0", (2, 0, 3)), ("end1", (2, 0, 3)), frame="edge"), "xyz"),
        (pulled(("end0", (2, 0, 3)), ("end1", (2, 0, 1)), frame="edge"), "xy"),
        (pulled(("end0", (2, 1, 3)), ("end1", (2, 1, 3)), frame="edge"), ""),
        (pulled(("end0", (2, 1, 3)), ("end1", (2, -1, 3)), frame="edge", kind="follower"), "z"),
        ({"edge_moments": [{"edge": "end0", "moment": 2}, {"edge": "end1", "moment": 2}]}, "xyz"),
        ({"edge_moments": [{"edge": "end0", "moment": 2}, {"edge": "end1", "moment": -2}]}, "xy"),
        ({"line_loads": [{"line": "end0", "force": [0, 0, 1]}]} | pulled(("end1", (0, 0, -1))), "xyz"),
    ],
)
def test_loads_on_the_ends_of_a_cylinder(loads: dict[str, Any], expected: str) -> None:
    """Mirroring z swaps the ends; in an edge's own frame only the component along it changes sign."""
    assert planes(CYLINDER, loads=loads) == expected


@pytest.mark.parametrize(
    ("supports", "expected"),
    [
        ([{"where": "end0", "kind": "clamped"}, {"where": "end1", "kind": "clamped"}], "xyz"),
        ([{"where": "end0", "kind": "clamped"}, {"where": "end1", "kind": "pinned"}], "xy"),
        ([{"where": "end0", "fix": ["x"]}, {"where": "end1", "fix": ["x"]}, {"where": "surface", "fix": ["y"]}], "xyz"),
        ([{"where": e, "kind": "pinned", "displacement": [0, 0, d]} for e, d in (("end0", -1), ("end1", 1))], "xyz"),
        ([{"where": e, "kind": "pinned", "displacement": [0, 0, 1]} for e in ("end0", "end1")], "xy"),
        ([{"where": "surface", "kind": "pinned", "displacement": [1e-3, 0, 0]}], "yz"),
        ([{"where": [R, 0, -R], "fix": ["z"]}, {"where": [-R, 0, -R], "fix": ["z"]}], "xy"),
        ([{"where": [R, 0, -R], "fix": ["z"]}, {"where": [-R, 0, -R], "fix": ["x"]}], "y"),
    ],
)
def test_supports_of_a_cylinder(supports: list[dict[str, Any]], expected: str) -> None:
    assert planes(CYLINDER, supports=supports) == expected


def test_a_thickness_that_varies() -> None:
    thickness = {"expression": f"1e-4 * (2 + x/{R} + (y/{R})**2 + z/{R})"}
    scene = Scene(shell=SHELL | {"shape": SPHERE, "thickness": thickness}, model={"reduction": "3d"})
    assert explain(scene).reduction.planes == ("y",)
