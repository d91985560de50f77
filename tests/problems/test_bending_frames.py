"""Kinks and branches: folded strips against frames, wherever they stand and whichever side is the top; cylinders with
caps."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from netgen.occ import Axes, Axis, Glue, WorkPlane

from tests.bent import FOLLOWED, Bent, Table, clamped, mesh, metal, rigidity
from tests.forms import Array

T = 2e-3
D = rigidity(metal(), T)
WIDTH = 0.25
TURNS: dict[str, Array] = {
    "upright": np.eye(3),
    "anywhere": np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    @ np.array([[math.cos(0.7), -math.sin(0.7), 0], [math.sin(0.7), math.cos(0.7), 0], [0, 0, 1]]),
}
"""Rotations of a frame: none, and about z by 0.7 rad and then of the axes x -> y -> z -> x."""


def folded(path: Path, turn: str = "upright", flip: bool = False) -> Table:
    """A web x = 0, z in [0, 1], and an arm z = 1, x in [0, 1], both 0.25 wide along y: edges foot and tip."""
    web = WorkPlane(Axes((0, 0, 0), n=(1, 0, 0), h=(0, 1, 0))).Rectangle(1e3 * WIDTH, 1e3).Face()
    arm = WorkPlane(Axes((0, 0, 1e3), n=(0, 0, 1), h=(1, 0, 0))).Rectangle(1e3, 1e3 * WIDTH).Face()
    both = Glue([web, arm])
    for face in both.faces:
        face.name = "web" if abs(face.center.x) < 1e-9 else "arm"
    for edge in both.edges:
        if abs(edge.center.z) < 1e-9:
            edge.name = "foot"
        elif abs(edge.center.x - 1e3) < 1e-9:
            edge.name = "tip"
    if turn == "anywhere":
        both = both.Rotate(Axis((0, 0, 0), (0, 0, 1)), math.degrees(0.7))
        both = both.Rotate(Axis((0, 0, 0), (1, 1, 1)), 120).Move((300, -200, 100))
    file = path / f"{turn}.step"
    both.WriteStep(str(file))
    return {"kind": "file", "path": str(file), "flip": flip}


def place(turn: str, *point: float) -> Array:
    """Where a point of the upright frame is."""
    shift = np.array([0.3, -0.2, 0.1]) if turn == "anywhere" else np.zeros(3)
    return TURNS[turn] @ np.array(point) + shift


def bend(shape: Table, load: Table, **parts: Any) -> Bent:
    parts = {"discretisation": mesh(2, 0.5)} | parts
    return Bent(shape, T, metal(), supports=clamped("foot"), loads=load, **parts)


@pytest.mark.parametrize("turn", TURNS)
def test_a_folded_strip_is_a_frame(turn: str, tmp_path: Path) -> None:
    """A dead force F on the tip: the web turns by F L H / D, the corner keeps its angle, F H / (E T) is squeezed."""
    force = 1e-5 * D
    pull = TURNS[turn] @ np.array([0.0, 0.0, -force])
    bent = bend(folded(tmp_path, turn), {"edge_tractions": [{"edge": "tip", "traction": pull.tolist()}]})
    tip, corner = (bent.moved(*place(turn, x, 0.1, 1.0)) @ TURNS[turn] for x in (1.0, 0.0))
    assert corner == pytest.approx([force / (2 * D), 0.0, -force / T], abs=1e-5 * force / D)
    assert tip[2] == pytest.approx(-force * (4 / (3 * D) + 1 / T), rel=3e-5)
    assert tip[0] == pytest.approx(force / (2 * D), rel=3e-5)


@pytest.mark.parametrize("turn", TURNS)
def test_a_folded_strip_under_an_end_moment(turn: str, tmp_path: Path) -> None:
    """Web and arm become arcs of the same curvature with the corner square between them, however far they turn. The
    moment turns the tip towards the top; exchanging the sides exchanges the sense."""
    angle, sense = 1.2, []
    for flip in (False, True) if turn == "upright" else (False,):
        load = {"edge_moments": [{"edge": "tip", "moment": angle * D}]}
        bent = bend(folded(tmp_path, turn, flip), load, path=FOLLOWED, discretisation=mesh(2, 0.2))
        tip, corner = (bent.moved(*place(turn, x, 0.1, 1.0)) @ TURNS[turn] for x in (1.0, 0.0))
        up = math.copysign(1.0, tip[2])
        away, along = (1 - math.cos(angle)) / angle, math.sin(angle) / angle  # of an arc of length 1
        web = np.array([-up * away, along])  # (x, z); it starts upwards and bends to -x if the tip rises
        c, s = math.cos(angle), math.sin(angle)
        arm = np.array([along * c - away * s, up * (along * s + away * c)])  # it starts along (c, up s) and turns on
        assert corner[[0, 2]] == pytest.approx(web - [0, 1], abs=2e-5)
        assert tip[[0, 2]] == pytest.approx(web + arm - [1, 1], abs=2e-5)
        sense.append(up)
    assert len(set(sense)) == len(sense)


@pytest.mark.parametrize("force", [(1.0, 0.0), (1.0, 1.0), (0.3, -1.0)])
def test_branches_share_their_moments(force: tuple[float, float]) -> None:
    """The T under forces on the ends of its top: the web takes the difference of the moments, both sides of the top
    turn with it, each bent by its own force besides (nu = 0)."""
    right, left = (1e-5 * D * f for f in force)
    loads = {
        "edge_tractions": [
            {"edge": "right", "traction": [0, 0, right]},
            {"edge": "left", "traction": [0, 0, left]},
        ]
    }
    bent = Bent(
        {"kind": "t-section", "length": 1.0}, T, metal(), supports=clamped("bottom"), loads=loads,
        discretisation=mesh(2, 0.5),
    )  # fmt: skip
    turned, lifted = 0.5 * (right - left) / D, (right + left) / T
    junction = bent.moved(0.0, 0.5, 1.0)
    assert junction == pytest.approx([-0.5 * turned, 0.0, lifted], abs=2e-10)
    assert bent.moved(0.5, 0.5, 1.0)[2] == pytest.approx(lifted + 0.5 * turned + right / (24 * D), abs=2e-10)
    assert bent.moved(-0.5, 0.5, 1.0)[2] == pytest.approx(lifted - 0.5 * turned + left / (24 * D), abs=2e-10)


def test_regions_of_a_frame(tmp_path: Path) -> None:
    """The web half as thick and twice as stiff: D of the web for what it turns, D of the arm for the arm's own part."""
    force, soft = 1e-6 * D, rigidity(metal(youngs_modulus=2.0), T / 2)
    region = {"faces": ["web"], "thickness": T / 2, "material": metal(youngs_modulus=2.0)}
    load = {"edge_tractions": [{"edge": "tip", "traction": [0, 0, -force]}]}
    bent = bend(folded(tmp_path), load, shell={"regions": [region]})
    assert bent.moved(0.0, 0.1, 1.0)[0] == pytest.approx(force / (2 * soft), rel=3e-5)
    assert bent.moved(1.0, 0.1, 1.0)[2] == pytest.approx(-force * (1 / soft + 1 / (3 * D) + 1 / T), rel=3e-5)


@pytest.mark.parametrize("ratio", [1e-1, 1e-2, 1e-3])
def test_a_cylinder_with_caps(ratio: float) -> None:
    """The corner around a cap is squeezed, where a membrane would wrinkle; half way between the caps the wall is a
    closed tube under p: sigma_theta = 2 sigma_z, whose stretches the membrane has."""
    load = 0.3 * ratio
    bent = Bent(
        {"kind": "cylinder", "radius": 1.0, "length": 4.0, "ends": "capped"}, ratio, path=FOLLOWED,
        loads={"pressure_bottom": load}, model={"reduction": "axisymmetric"},
    )  # fmt: skip
    assert bent.scalars["stretch_min"] < 0.985
    stretch = 1 + bent.moved(1.0, 0.0, 0.0)[0]
    assert stretch == pytest.approx(tube_stretch(0.3), rel=5e-3 if ratio == 0.1 else 1e-3)


def tube_stretch(load: float) -> float:
    """Hoop stretch l of a closed neo-Hookean membrane tube, radius 1, at p R / (mu T) = ``load``: with the axial
    stretch a, hoop l - l^-3 a^-2 = p l a R / (mu T) and axial a - a^-3 l^-2 = p l^2 R / (2 mu T)."""
    l, a = 1.0, 1.0  # noqa: E741
    for _ in range(500):
        l += 0.2 * (load * l * a - l + l**-3 * a**-2)  # noqa: E741
        a += 0.2 * (load * l * l / 2 - a + a**-3 * l**-2)
    return l


def test_a_cylinder_with_caps_in_space() -> None:
    """An eighth of it agrees with its meridian."""
    shape = {"kind": "cylinder", "radius": 1.0, "length": 2.0, "ends": "capped"}
    space, meridian = (
        Bent(shape, 0.1, path=FOLLOWED, loads={"pressure_bottom": 0.03}, model={"reduction": reduction})
        for reduction in ("3d", "axisymmetric")
    )
    for point in ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0)):
        assert np.linalg.norm(space.moved(*point) - meridian.moved(*point)) < 3e-3
