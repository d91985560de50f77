"""From a scene to numbers on a mesh: scales of every load, where supports hold, what stands off the shell."""

# ruff: noqa: E501 - one message per line

from __future__ import annotations

import math
from typing import Any

import ngsolve
import numpy as np
import pytest

from embedding import Scene, explain
from embedding.geometry.places import locate
from embedding.solving.loads import mechanical_loads
from embedding.solving.problem import Problem
from embedding.solving.supports import held_by_supports
from tests.scene.samples import MATERIAL, refusals
from tests.shell.rigid import NodalForces

MU, SIZE = 1e5, 0.02
SHAPES: dict[str, dict[str, Any]] = {
    "plate": {"kind": "plate", "length": SIZE, "width": SIZE / 2},
    "disc": {"kind": "disc", "radius": SIZE},
    "sphere": {"kind": "sphere", "radius": SIZE},
    "hemisphere": {"kind": "hemisphere", "radius": SIZE},
    "quarter": {"kind": "hemisphere", "radius": SIZE, "angle": "90 deg"},
    "skew": {"kind": "hemisphere", "radius": SIZE, "angle": "45 deg", "start": "20 deg"},
    "tube": {"kind": "cylinder", "radius": SIZE, "length": 2 * SIZE},
    "can": {"kind": "cylinder", "radius": SIZE, "length": 2 * SIZE, "ends": "capped"},
    "strip": {"kind": "strip", "length": SIZE},
}


def problem(shape: str, **parts: Any) -> Problem:
    scene = Scene(
        shell={"shape": SHAPES[shape], "thickness": SIZE / 100, "material": MATERIAL, "density": 1000.0},
        discretisation={"shell_size": SIZE / 2, "order": 2},
        **parts,
    )
    return Problem(scene, explain(scene))


def test_every_load_is_measured_in_moduli_and_sizes() -> None:
    loads = {
        "body_force": [0, 0, 1e6],
        "gravity": [0, 0, -1e3],
        "surface_force": [0, 2e4, 0],
        "edge_tractions": [
            {"edge": "x0", "traction": [20, 0, 0]},
            {"edge": "x1", "traction": [20, 0, 40], "frame": "edge"},
            {"edge": "y0", "traction": [0, 20, 0], "frame": "edge", "kind": "follower"},
        ],
        "line_loads": [{"line": "y1", "force": [0, 0, 2000]}],
        "point_loads": [{"at": [SIZE / 2, SIZE / 4, 0], "force": [0, 0, 40]}],
    }
    stated = problem("plate", loads=loads).system.physics.loads
    assert stated.body_force == pytest.approx((0, 0, (1e6 - 1e6) * SIZE / MU))
    assert stated.surface_force == pytest.approx((0, 0.2, 0))
    assert stated.edge_tractions == (("x0", pytest.approx((0.01, 0, 0))),)
    assert [(f.edge, f.follows) for f in stated.edge_forces] == [("x1", False), ("y0", True)]
    assert stated.edge_forces[0].components == pytest.approx((0.01, 0, 0.02))
    assert stated.line_loads == (("y1", pytest.approx((0, 0, 1))),)
    assert stated.point_forces == ((pytest.approx((0.5, 0.25, 0)), pytest.approx((0, 0, 1))),)


def test_a_surface_force_in_every_reduction() -> None:
    """The radial direction of axisymmetry is the x axis."""
    force = {"surface_force": {"expression": ["5e6*x", "5e6*y", 2e5]}}
    for reduction, size in (("axisymmetric", 2), ("3d", 3)):
        made = problem("disc", loads=force, model={"reduction": reduction, "symmetry": "none"})
        field = made.system.physics.loads.surface_force
        work = made.domain.shell_integral(sum(field[i] * made.reduction.position[i] for i in range(size - 1)))
        # int 5e6 Pa/m R r x r / MU dA = 1 x 2 pi / 4
        assert work == pytest.approx(math.pi / 2, rel=1e-2)
        assert made.domain.shell_integral(field[size - 1]) == pytest.approx(2 * math.pi, rel=1e-2)


def test_in_plane_strain_a_point_is_a_line() -> None:
    """40 N per metre along z over modulus times size."""
    load = {"at": [SIZE, 0, 0], "force": [0, 40, 0]}
    made = problem("strip", loads={"point_loads": [load]})
    assert made.system.physics.loads.point_forces == (((1.0, 0.0), pytest.approx((0, 0.02))),)


def test_points_off_the_shell_are_refused() -> None:
    loads = {"point_loads": [{"at": [0, 0, z], "force": [0, 0, 1]} for z in (SIZE, 0.021, 0.0)]}
    assert refusals(lambda: problem("sphere", loads=loads)) == [
        "loads.point_loads.1.at: [0.0, 0.0, 0.021] is not allowed: must be a point of the mid-surface, which is 0.001 m away",
        "loads.point_loads.2.at: [0.0, 0.0, 0.0] is not allowed: must be a point of the mid-surface, which is 0.02 m away",
    ]


@pytest.mark.parametrize(
    ("shape", "edge", "component", "parts"),
    [
        ("plate", "x0", 0, {}),
        ("plate", "y1", 1, {}),
        ("hemisphere", "rim", 1, {}),
        ("hemisphere", "rim", 2, {"model": {"reduction": "3d"}}),
        ("quarter", "side0", 1, {}),
        ("quarter", "side1", 0, {}),
        ("quarter", "rim", 2, {}),
        ("strip", "x1", 0, {}),
    ],
)
def test_symmetry_holds_what_crosses_the_plane(shape: str, edge: str, component: int, parts: dict[str, Any]) -> None:
    physics = problem(shape, supports=[{"where": edge, "kind": "symmetry"}], **parts).system.physics
    assert physics.supports == ((edge, component),)
    assert physics.clamped == (edge,) and physics.prescribed == ()


@pytest.mark.parametrize(("shape", "edge"), [("disc", "rim"), ("skew", "side0")])
def test_symmetry_needs_a_plane(shape: str, edge: str) -> None:
    supports = [{"where": edge, "kind": "symmetry"}]
    for reduction in ("3d", "auto"):
        line = f'supports.0.kind: "symmetry" is not allowed: the shell does not end square in a plane across the x, y or z axis at "{edge}"'
        assert refusals(lambda r=reduction: problem(shape, supports=supports, model={"reduction": r})) == [line]


def test_what_is_held_where() -> None:
    supports = [
        {"where": "x0", "kind": "clamped", "displacement": [0, 0, SIZE / 10]},
        {"where": [SIZE, SIZE / 2, 0], "fix": ["z"]},
        {"where": "x1", "fix": ["rotation"]},
    ]
    made = problem("plate")
    scene = made.scene.model_copy(update={"supports": supports})
    held = held_by_supports(scene, made.domain, made.scales)
    corner = (1.0, 0.5, 0.0)
    assert held.components == (("x0", 0), ("x0", 1), ("x0", 2), (corner, 2))
    assert held.prescribed == (("x0", 2, pytest.approx(0.1)),)
    assert held.clamped == ("x0", "x1")


def test_a_held_edge_and_a_held_corner() -> None:
    """What moves with the load's factor: an edge as a whole, and a corner."""
    supports = [
        {"where": "x0", "kind": "pinned", "displacement": [0, 0, SIZE / 10]},
        {"where": [SIZE, SIZE / 2, 0], "fix": ["z"], "displacement": [0, 0, -SIZE]},
    ]
    made = problem("plate", supports=supports)
    system, trace = made.system, made.system.unknowns.trace
    held = ~trace.free.reshape(3, -1)
    assert held[2].sum() == held[0].sum() + 1
    assert np.array_equal(held[0], held[1])
    system.load(0.5, 0.0, None)
    u = system.unknowns.field("u")
    line = ngsolve.dx(definedon=made.mesh.BBoundaries("x0"))
    assert ngsolve.Integrate(u[2] * line, made.mesh) == pytest.approx(0.05 * 0.5, abs=1e-14)
    assert ngsolve.Integrate((u[2] - 0.05) ** 2 * line, made.mesh) == pytest.approx(0.0, abs=1e-28)
    at = locate(made.domain, (1.0, 0.5, 0.0))
    trafo = made.mesh.GetTrafo(ngsolve.ElementId(ngsolve.BND, at.element))
    assert u(trafo(*at.local))[2] == pytest.approx(-0.5, abs=1e-14)


def test_a_point_support_needs_a_corner() -> None:
    supports = [{"where": [SIZE / 2.1, 0, 0], "fix": ["z"]}]
    assert refusals(lambda: problem("plate", supports=supports)) == [
        f"supports.0.where: [{SIZE / 2.1}, 0.0, 0.0] is not allowed: must be a corner of the shape: there is no vertex of the mesh"
    ]


def test_a_thickness_that_dips_below_zero_between_the_samples_is_refused() -> None:
    """Seen only on the mesh."""
    dip = {"expression": f"1 - 2*exp(-((x/{SIZE} - 0.75)/0.05)**2)", "unit": "mm"}
    shell = {"shape": SHAPES["strip"], "thickness": dip, "material": MATERIAL}
    scene = Scene(shell=shell, discretisation={"shell_size": SIZE / 50})
    (line,) = refusals(lambda: Problem(scene, explain(scene)))
    assert line.startswith("shell.thickness: -0.00")
    assert line.endswith(" m is not allowed: must be greater than 0 everywhere")


def test_a_uniform_thickness_stays_a_number() -> None:
    assert problem("disc").system.physics.thickness == 0.01
    assert isinstance(problem("disc").system.physics.thickness, float)


def test_a_moment_is_measured_in_forces() -> None:
    made = problem("plate")
    scene = made.scene.model_copy(update={"loads": {"edge_moments": [{"edge": "x1", "moment": 4}]}})
    assert mechanical_loads(scene, made.domain, made.scales).edge_moments == (("x1", pytest.approx(0.1)),)


def test_what_a_membrane_cannot_carry_is_refused() -> None:
    supports = [
        {"where": "x0", "kind": "clamped"},
        {"where": "x1", "fix": ["z", "rotation"]},
        {"where": "y0", "kind": "symmetry"},
    ]
    reason = "needs a shell that resists bending, and this one is a membrane"
    loads = {"edge_moments": [{"edge": "y1", "moment": 4}]}
    membrane = {"theory": "membrane"}
    assert refusals(lambda: problem("plate", supports=supports, loads=loads, model=membrane)) == [
        f"loads.edge_moments.0: {reason}",
        f"supports.0.kind: {reason}",
        f"supports.1.fix: {reason}",
    ]


def test_a_line_within_the_shell_has_no_outward_direction() -> None:
    loads = {
        "edge_tractions": [
            {"edge": "end0", "traction": [1, 0, 0], "frame": "edge"},
            {"edge": "end1", "traction": [0, 0, 1]},
        ],
        "line_loads": [{"line": "end1", "force": [1, 0, 0]}],
    }
    reason = "is not allowed: the shell goes on there, so that the line has no outward direction"
    assert refusals(lambda: problem("can", loads=loads)) == [f'loads.edge_tractions.0.edge: "end0" {reason}']
    assert problem("tube", loads=loads).system.physics.loads.edge_forces[0].edge == "end0"


def test_edges_beyond_a_mirror_plane() -> None:
    """Both ends of a tube are held and pulled; the lower one is not meshed, and its supports are those of its image."""
    supports = [{"where": end, "fix": ["x"]} for end in ("end0", "end1")]
    pulled = [{"edge": end, "traction": [0, 0, t]} for end, t in (("end0", -2e3), ("end1", 2e3))]
    made = problem("tube", supports=supports, loads={"edge_tractions": pulled}, model={"reduction": "3d"})
    physics, domain = made.system.physics, made.domain
    assert domain.reduction.planes == ("x", "y", "z")
    assert physics.supports == (("end1", 0),)
    forces = NodalForces(domain, physics.loads)
    work = forces.work(ngsolve.CF((0, 0, 0)), ngsolve.CF((0, 0, ngsolve.z)))
    ring = ngsolve.Integrate(ngsolve.CF(1.0) * ngsolve.dx(definedon=made.mesh.BBoundaries("end1")), made.mesh)
    assert ring == pytest.approx(math.pi / 2, rel=1e-2)
    assert work == pytest.approx(2 * 4 * ring * 1.0 * 1.0)  # two ends of four quarters, force 1 and displacement 1
