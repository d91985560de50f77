"""Loads and supports: what may be stated, the sentences of what may not, and the way to TOML and back."""

# ruff: noqa: E501 - one case per line, with the whole message

from __future__ import annotations

from typing import Any

import pytest

from embedding.scene import (
    EdgeMoment,
    EdgeTraction,
    ForceField,
    LineLoad,
    Loads,
    PointLoad,
    Scene,
    Support,
    axisymmetry_problems,
)
from tests.scene.samples import refusals, scene

DISC = "disc"
AXISYMMETRIC = {"reduction": "axisymmetric"}
ON_AXIS = {"at": [0, 0, 0], "force": [0, 0, "3 N"]}


def everything() -> dict[str, Any]:
    """One of each load and support on a disc, all axisymmetric."""
    return {
        "of_shell": {"density": "1.1 g/cm^3"},
        "loads": {
            "gravity": [0, 0, "-9.81 m/s^2"],
            "surface_force": {"expression": ["100*x", "100*y", 2], "unit": "kPa"},
            "edge_tractions": [
                {"edge": "rim", "traction": ["2 N/m", 0, 1], "frame": "edge", "kind": "follower"},
                {"edge": "rim", "traction": [0, 0, 1]},
            ],
            "line_loads": [{"line": "rim", "force": [0, 0, "1 N/cm"]}],
            "edge_moments": [{"edge": "rim", "moment": "-3 N"}],
            "point_loads": [ON_AXIS],
        },
        "supports": [
            {"where": "rim", "kind": "clamped", "displacement": [0, 0, "2 mm"]},
            {"where": [0, 0, 0], "fix": ["z"]},
            {"where": "rim", "fix": ["rotation", "z"]},
        ],
        "model": AXISYMMETRIC,
    }


def test_everything_survives_toml() -> None:
    stated = scene(DISC, **everything())
    assert Scene.from_toml(stated.to_toml()) == stated
    assert stated.shell.density == 1100.0
    assert stated.loads.line_loads[0].force == (0.0, 0.0, 100.0)
    assert stated.loads.edge_moments[0].moment == -3.0
    force = stated.loads.surface_force
    assert isinstance(force, ForceField)
    assert [component(0.1, 0.2, 0.0) for component in force.components] == [1e4, 2e4, 2e3]


def test_what_supports_hold() -> None:
    clamped, point, turned = scene(DISC, **everything()).supports
    assert clamped.held == ("x", "y", "z", "rotation") and clamped.displacement == (0.0, 0.0, 0.002)
    assert point.where == (0.0, 0.0, 0.0) and point.held == ("z",)
    assert turned.held == ("z", "rotation")
    assert Support(where="rim", kind="pinned").held == ("x", "y", "z")
    assert Support(where="rim", kind="symmetry").held == ("rotation",)


@pytest.mark.parametrize(
    ("build", "line"),
    [
        (lambda: Support(where="rim", kind="clumped"), 'kind: "clumped" is not allowed: must be "clamped", "pinned" or "symmetry"; did you mean "clamped"?'),
        (lambda: Support(where="rim"), 'fix: none is not allowed: give the directions to hold, or kind = "clamped", "pinned" or "symmetry"'),
        (lambda: Support(where="rim", fix=["x"], kind="pinned"), 'fix: [x] is not allowed: kind = "pinned" says what is held; leave out one of the two'),
        (lambda: Support(where=[0, 1], fix=["x"]), "where: [0, 1] is not allowed: must be a list of 3 components [x, y, z]"),
        (lambda: Support(where=[0, 1, "1 kg"], fix=["x"]), 'where.2: 1 kg is not allowed: "kg" is a unit of mass: must be a length, such as "0.2 mm"'),
        (lambda: Support(where=3, fix=["x"]), "where: 3 is not allowed: must be text on one line, of 1 to 100 printable characters"),
        (lambda: Support(where="rim", fix=["x"], displacement=[0, 1, 0]), "displacement.1: 1.0 m is not allowed: this support does not hold y"),
        (lambda: Support(where="rim", kind="symmetry", displacement=[1, 0, 0]), "displacement.0: 1.0 m is not allowed: this support does not hold x"),
        (lambda: EdgeTraction(edge="rim", traction=(1, 0, 0), kind="follower"), 'kind: follower is not allowed: a load that follows the edge needs frame = "edge"'),
        (lambda: EdgeTraction(edge="rim", traction=(1, 0, 0), frame="local"), 'frame: "local" is not allowed: must be "global" or "edge"; did you mean "global"?'),
        (lambda: EdgeMoment(edge="rim", moment="3 J"), 'moment: 3 J is not allowed: "J" is a unit of mass * length ** 2 / time ** 2: must be a moment per length (a force), such as "3 N"'),
        (lambda: EdgeMoment(edge="rim"), 'moment: missing: must be a moment per length (a force), such as "3 N"'),
        (lambda: LineLoad(line="rim", force=[0, 0, "1 N"]), 'force.2: 1 N is not allowed: "N" is a unit of mass * length / time ** 2: must be a force per length, such as "3 N/m"'),
        (lambda: PointLoad(at=[0, 0, 0], force=[0, 0, "1 Pa"]), 'force.2: 1 Pa is not allowed: "Pa" is a unit of mass / length / time ** 2: must be a force, such as "3 N"'),
        (lambda: PointLoad(at=[0, 0], force=[0, 0, 1]), "at: [0, 0] is not allowed: must be a list of 3 components [x, y, z]"),
        (lambda: Loads(surface_force=[1, 2]), "surface_force: [1, 2] is not allowed: must be a list of 3 components [x, y, z]"),
        (lambda: Loads(surface_force=[1, 2, "1 N"]), 'surface_force.2: 1 N is not allowed: "N" is a unit of mass * length / time ** 2: must be a pressure, such as "100 kPa"'),
        (lambda: Loads(surface_force={"expression": "x"}), "surface_force.expression: x is not allowed: must be a list of 3 expressions, one for each of x, y and z"),
        (lambda: Loads(surface_force={"expression": ["x", "y", "w"]}), 'surface_force.expression.2: w is not allowed: unknown name "w": known are x, y, z, pi, sin, cos, exp, log, sqrt, tanh'),
        (lambda: Loads(surface_force={"expression": ["x", "y", True]}), "surface_force.expression.2: true is not allowed: must be text"),
        (lambda: Loads(surface_force={"expression": ["x", "y", "z"], "unit": "m"}), 'surface_force.unit: m is not allowed: "m" is a unit of length: must be a unit of pressure, such as kPa'),
        (lambda: Loads(gravity=[0, 0, "9.81 m/s"]), 'gravity.2: 9.81 m/s is not allowed: "m/s" is a unit of length / time: must be an acceleration, such as "9.81 m/s^2"'),
    ],
)  # fmt: skip
def test_a_part(build: Any, line: str) -> None:
    assert refusals(build) == [line]


@pytest.mark.parametrize(
    ("shape", "parts", "line"),
    [
        (DISC, {"of_shell": {"density": 0}}, "shell.density: 0 kg/m^3 is not allowed: must be greater than 0"),
        (DISC, {"loads": {"gravity": [0, 0, -9.81]}}, "shell.density: missing: needed under loads.gravity"),
        (DISC, {"loads": {"line_loads": [{"line": "rims", "force": [0, 0, 1]}]}}, 'loads.line_loads.0.line: "rims" is not allowed: must be "rim"; did you mean "rim"? (the shape is a "disc")'),
        ("sphere", {"loads": {"edge_moments": [{"edge": "rim", "moment": 1}]}}, 'loads.edge_moments.0.edge: "rim" is not allowed: a shape of kind "sphere" has no edges'),
        (DISC, {"supports": [{"where": "surface", "fix": ["z", "rotation"]}]}, 'supports.0.fix: "rotation" is not allowed: the rotation of the shell can be held on an edge only'),
        (DISC, {"supports": [{"where": [0, 0, 0], "kind": "clamped"}]}, 'supports.0.kind: "clamped" is not allowed: the rotation of the shell can be held on an edge only'),
        (DISC, {"loads": {"surface_force": {"expression": ["0", "1/y", "0"]}}}, "loads.surface_force.expression.1: 1/y is not allowed: it has no finite value at x = 0 m, y = 0 m, z = 0 m"),
        (DISC, {"model": AXISYMMETRIC, "loads": {"gravity": [1, 0, 0]}, "of_shell": {"density": 1}}, 'loads.gravity: [1.0, 0.0, 0.0] is not allowed: the x and y components must be 0 when model.reduction is "axisymmetric"'),
        (DISC, {"model": AXISYMMETRIC, "loads": {"surface_force": [0, 1, 0]}}, 'loads.surface_force: [0.0, 1.0, 0.0] is not allowed: the x and y components must be 0 when model.reduction is "axisymmetric"'),
        (DISC, {"model": AXISYMMETRIC, "loads": {"surface_force": {"expression": ["-y", "x", "0"]}}}, 'loads.surface_force.expression: [-y, x, 0] is not allowed: must be the same when turned about the z axis, without a component around it, when model.reduction is "axisymmetric"'),
        (DISC, {"model": AXISYMMETRIC, "loads": {"surface_force": {"expression": ["x", "0", "0"]}}}, 'loads.surface_force.expression: [x, 0, 0] is not allowed: must be the same when turned about the z axis, without a component around it, when model.reduction is "axisymmetric"'),
        (DISC, {"model": AXISYMMETRIC, "loads": {"edge_tractions": [{"edge": "rim", "traction": [1, 2, 3], "frame": "edge"}]}}, 'loads.edge_tractions.0.traction.1: 2.0 N/m is not allowed: must be 0 along the edge when model.reduction is "axisymmetric"'),
        (DISC, {"model": AXISYMMETRIC, "loads": {"point_loads": [ON_AXIS | {"at": [0.01, 0, 0]}]}}, 'loads.point_loads.0.at: [0.01, 0.0, 0.0] is not allowed: the x and y components must be 0 when model.reduction is "axisymmetric"'),
        (DISC, {"model": AXISYMMETRIC, "loads": {"point_loads": [ON_AXIS | {"force": [1, 0, 0]}]}}, 'loads.point_loads.0.force: [1.0, 0.0, 0.0] is not allowed: the x and y components must be 0 when model.reduction is "axisymmetric"'),
        (DISC, {"model": AXISYMMETRIC, "supports": [{"where": "rim", "kind": "pinned", "displacement": [1e-3, 0, 0]}]}, 'supports.0.displacement: [0.001, 0.0, 0.0] is not allowed: the x and y components must be 0 when model.reduction is "axisymmetric"'),
        (DISC, {"model": AXISYMMETRIC, "supports": [{"where": [0, 0.02, 0], "fix": ["z"]}]}, 'supports.0.where: [0.0, 0.02, 0.0] is not allowed: the x and y components must be 0 when model.reduction is "axisymmetric"'),
        ("infinite-cylinder", {"loads": {"surface_force": [0, 0, 1]}}, "loads.surface_force.2: 1.0 is not allowed: must be 0 along z, along which nothing changes"),
        ("infinite-cylinder", {"loads": {"surface_force": {"expression": ["x", "y", "x"]}}}, "loads.surface_force.expression.2: x is not allowed: must be 0 along z, along which nothing changes"),
        ("infinite-cylinder", {"loads": {"point_loads": [{"at": [0.02, 0, 1], "force": [1, 0, 0]}]}}, "loads.point_loads.0.at.2: 1.0 is not allowed: must be 0 along z, along which nothing changes"),
        ("infinite-cylinder", {"supports": [{"where": "surface", "fix": ["z"], "displacement": [0, 0, 1]}]}, "supports.0.displacement.2: 1.0 is not allowed: must be 0 along z, along which nothing changes"),
    ],
)  # fmt: skip
def test_a_conflict(shape: str, parts: dict[str, Any], line: str) -> None:
    assert refusals(lambda: scene(shape, **parts)) == [line]


@pytest.mark.parametrize(
    ("shape", "parts", "line"),
    [
        (DISC, {"of_shell": {"thickness": {"expression": "w"}}}, 'shell.thickness.expression: w is not allowed: unknown name "w": known are x, y, z, pi, sin, cos, exp, log, sqrt, tanh'),
        (DISC, {"of_shell": {"thickness": {"expression": "x", "unit": "kg"}}}, 'shell.thickness.unit: kg is not allowed: "kg" is a unit of mass: must be a unit of length, such as mm'),
        (DISC, {"of_shell": {"thickness": {"expression": "1e-6/y**2"}}}, "shell.thickness.expression: 1e-6/y**2 is not allowed: it has no finite value at x = 0 m, y = 0 m, z = 0 m"),
        (DISC, {"of_shell": {"thickness": {"expression": "0.001 - 0.1*y"}}}, "shell.thickness.expression: 0.001 - 0.1*y is not allowed: must be greater than 0, and is -0.001 m at x = 0 m, y = 0.02 m, z = 0 m"),
        (DISC, {"of_shell": {"thickness": {"expression": "1e-3 + 0.01*x"}}, "model": AXISYMMETRIC}, 'shell.thickness.expression: 1e-3 + 0.01*x is not allowed: must depend on x and y through x**2 + y**2 only when model.reduction is "axisymmetric"'),
        ("infinite-cylinder", {"of_shell": {"thickness": {"expression": "1e-3 + z"}}}, "shell.thickness.expression: 1e-3 + z is not allowed: must not depend on z, along which nothing changes"),
        ("sphere", {"of_shell": {"thickness": {"expression": "0.05 + z"}}}, "shell.thickness: 0.07 m is not allowed: half of it must be less than shell.shape.radius = 0.02 m, or the inner face crosses the centre of curvature"),
        (DISC, {"of_shell": {"regions": [{"faces": ["web"], "density": 1}]}}, 'shell.regions.0.faces.0: "web" is not allowed: a shape of kind "disc" has no named faces'),
        (DISC, {"of_shell": {"regions": [{"faces": "web", "density": 1}]}}, 'shell.regions.0.faces: web is not allowed: must be a list of different names of faces, such as ["web"]'),
    ],
)  # fmt: skip
def test_a_thickness_that_varies(shape: str, parts: dict[str, Any], line: str) -> None:
    assert refusals(lambda: scene(shape, **parts)) == [line]


def test_the_thickest_place() -> None:
    stated = scene("plate", of_shell={"thickness": {"expression": "1 + x/0.1 - y/0.1", "unit": "mm"}})
    assert stated.shell.thickest == 2e-3
    assert Scene.from_toml(stated.to_toml()) == stated
    assert scene("plate").shell.thickest == 2e-4


def test_a_wrong_load_hides_no_other_problem() -> None:
    """What is wrong by itself skips only the checks that would read it."""
    loads = {"gravity": [0, 0, "1 m"], "edge_moments": [{"edge": "rum", "moment": 1}], "line_loads": 3}
    lines = refusals(lambda: scene("disc", loads=loads, supports=[{"where": "surface", "kind": "clamped"}]))
    paths = [line.partition(": ")[0] for line in lines]
    assert paths == ["loads.line_loads", "loads.gravity.2", "supports.0.kind"]


def test_a_point_off_the_axis_needs_three_dimensions() -> None:
    off = {"at": [0.02, 0, 0], "force": [0, 0, 1]}
    stated = scene("sphere", loads={"point_loads": [ON_AXIS | {"at": [0, 0, 0.02]}, off]})
    assert [problem.path for problem in axisymmetry_problems(stated)] == ["loads.point_loads.1.at"]


PRESSED, ELECTRIC, RUBBER = {"pressure_bottom": 500.0}, {"field": "electric"}, {"relative_permittivity": 3.0}
MOVED = [{"where": "x0", "fix": ["x"]}, {"where": "x1", "fix": ["x"], "displacement": [1e-3, 0.0, 0.0]}]


@pytest.mark.parametrize(
    ("stated", "ramped"),
    [
        (scene(), ()),
        (scene(loads={"rim": "pressurised"}), ()),
        (scene(loads=PRESSED), ("mechanical",)),
        (scene(loads={"gravity": [0.0, 0.0, -9.81]}, of_shell={"density": 1e3}), ("mechanical",)),
        (scene(loads=PRESSED, ambient=ELECTRIC, of_shell=RUBBER), ("mechanical", "field")),
        (scene(ambient=ELECTRIC, of_shell=RUBBER), ("field",)),
        (scene("strip", supports=MOVED[:1]), ()),
        (scene("strip", supports=MOVED), ("mechanical",)),
    ],
)
def test_what_the_factors_of_the_path_scale(stated: Scene, ramped: tuple[str, ...]) -> None:
    assert stated.ramped == ramped
