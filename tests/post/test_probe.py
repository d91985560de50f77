"""Probes against closed forms: in every reduction, in mirror images, on both sides, and where there is nothing."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from embedding import load_scene, solve
from embedding.archive import Recorder
from embedding.errors import ArchiveError
from embedding.post import PostError, flux, line, probe, probe_shell
from problems import cantilever_moment
from tests.archive.made_up_run import LENGTH, VOLTAGE, Problem, tell
from tests.post import runs

pytestmark = pytest.mark.usefixtures("unestimated")

REDUCTIONS = ("axisymmetric", "plane-strain", "3d")


def made_up(folder: Path, reduction: str, size: float) -> Path:
    path = folder / f"{reduction}{size}.vtkhdf"
    tell(Recorder(path), Problem(reduction, size=size, order=3), steps=2)
    return path


def places(reduction: str, low: float, high: float) -> Any:
    """Points all around, at distances between two from the origin, in radii; in plane strain z does not matter."""
    rng = np.random.default_rng(3)
    directions = rng.normal(size=(40, 3))
    if reduction == "plane-strain":
        directions[:, 2] = 0.0
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return rng.uniform(low, high, 40)[:, None] * directions


def motion(points: Any, reduction: str, t: float) -> Any:
    """The made-up motion of the space, in radii."""
    radius = np.linalg.norm(points, axis=1)[:, None]
    fade = np.where(radius > 1, radius**-3.0, 1.0)
    along = 1 if reduction == "plane-strain" else 2
    stretch = np.full(3, -0.15)
    stretch[along] = 0.35
    if reduction == "plane-strain":
        stretch[2] = 0.0
    return t * fade * stretch * points


@pytest.mark.parametrize("reduction", REDUCTIONS)
def test_the_moving_space_in_all_its_copies(reduction: str, tmp_path: Path) -> None:
    along = 1 if reduction == "plane-strain" else 2
    rest = np.concatenate([places(reduction, 0.1, 0.9), places(reduction, 1.2, 2.5)])
    errors = []
    for size in (0.8, 0.4):
        archive = made_up(tmp_path, reduction, size)
        gaps = []
        for step, t in ((0, 0.5), (1, 1.0)):
            moved = LENGTH * (rest + motion(rest, reduction, t))
            table = probe(archive, moved, fields=["u", "phi", "E"], steps=[step])
            assert table["where"].tolist() == ["inside"] * 40 + ["outside"] * 40
            gaps.append(table["phi"] / (-VOLTAGE * t) - rest[:, along])
            shift = np.column_stack([table[f"u_{axis}"] for axis in "xyz"])
            gaps += list((shift / LENGTH - motion(rest, reduction, t)).T)
            inner = table[f"E_{'xyz'[along]}"][:40]
            np.testing.assert_allclose(inner, 0.4 * 1.8 * VOLTAGE * t / LENGTH, rtol=1e-5)
            np.testing.assert_allclose(table["E"][:40], np.abs(inner), rtol=1e-5)
        errors.append(float(np.sqrt(np.mean(np.square(gaps)))))
        assert np.abs(gaps).max() < 4e-3
    assert errors[1] < 0.5 * errors[0], errors


@pytest.mark.parametrize("reduction", REDUCTIONS)
def test_vectors_turn_with_the_point(reduction: str, tmp_path: Path) -> None:
    """The field outside, t VOLTAGE (a + 0.7 (3 (a . X) X / R^2 - a) / R^3) with a the axis, in all directions."""
    along = 1 if reduction == "plane-strain" else 2
    rest = places(reduction, 1.3, 2.5)
    radius, axis = np.linalg.norm(rest, axis=1)[:, None], np.eye(3)[along]
    exact = axis + 0.7 * (3 * rest[:, [along]] * rest / radius**2 - axis) / radius**3
    table = probe(made_up(tmp_path, reduction, 0.4), LENGTH * (rest + motion(rest, reduction, 1.0)), steps=[-1])
    found = np.column_stack([table[f"E_{axis}"] for axis in "xyz"]) * LENGTH / VOLTAGE
    assert np.abs(found - exact).max() < 0.02


def test_the_interface_has_two_sides(tmp_path: Path) -> None:
    archive = made_up(tmp_path, "axisymmetric", 0.4)
    at = LENGTH * np.array([[0.6 * 0.85, 0.0, 0.8 * 1.35]])  # of the mid-surface, where the interface is closed
    assert probe(archive, at, steps=[-1])["where"].tolist() == ["on the interface: name the side"]
    assert np.isnan(probe(archive, at, steps=[-1])["E"]).all()
    inside = probe(archive, at, side="bottom", steps=[-1])
    outside = probe(archive, at, side="outside", steps=[-1])
    assert (inside["where"][0], outside["where"][0]) == ("inside", "outside")
    assert inside["E_z"][0] == pytest.approx(0.4 * 1.8 * VOLTAGE / LENGTH, rel=1e-4)
    exact = VOLTAGE / LENGTH * (1 + 0.7 * (3 * 0.8**2 - 1))
    assert outside["E_z"][0] == pytest.approx(exact, rel=5e-2)
    deep = probe(archive, [[0.0, 0.0, 0.0]], side="outside", steps=[-1])
    assert deep["where"].tolist() == ["not on this side"]


@pytest.mark.parametrize("reduction", REDUCTIONS)
def test_points_of_the_shell(reduction: str, tmp_path: Path) -> None:
    rest = places(reduction, 1.0, 1.0)
    archive = made_up(tmp_path, reduction, 0.4)
    along = 1 if reduction == "plane-strain" else 2
    table = probe_shell(archive, LENGTH * rest, fields=["u", "p_b"])
    assert len(table) == 80 and table["where"].tolist() == ["shell"] * 80
    assert table.units == {**dict.fromkeys(("x", "y", "z", "u", "u_x", "u_y", "u_z"), "m"), "p_b": "Pa"}
    last = table["step"] == 2
    np.testing.assert_allclose(table["p_b"][last], 40 + 300 * rest[:, along] ** 2, rtol=5e-3)
    np.testing.assert_allclose(
        table[f"u_{'xyz'[along]}"][last], 0.35 * LENGTH * rest[:, along], atol=1e-5 * LENGTH, rtol=1e-3
    )
    faces = {side: probe_shell(archive, LENGTH * rest, side=side, steps=[-1]) for side in ("top", "bottom")}
    np.testing.assert_allclose(faces["bottom"]["E"], 0.4 * 1.8 * VOLTAGE / LENGTH, rtol=1e-3)
    np.testing.assert_allclose(faces["top"]["phi"], -VOLTAGE * rest[:, along], atol=1e-3 * VOLTAGE)
    beside = probe_shell(archive, [[0.9 * LENGTH, 0.0, 0.0]], steps=[-1])
    assert beside["where"].tolist() == ["not on the shell"] and np.isnan(beside["stretch"]).all()


def test_a_charged_sphere(tmp_path: Path) -> None:
    """phi = V R / r and E = V R / r^2 outside, phi = V inside, nothing in the wall; the error falls on a finer mesh."""
    errors = []
    for size in (0.6, 0.3):
        archive = runs.sphere(tmp_path, size)
        points = runs.OUTER * places("3d", 1.1, 2.2)
        radius = np.linalg.norm(points, axis=1)
        table = probe(archive, points, steps=[-1])
        exact = runs.VOLTAGE * runs.OUTER / radius
        errors.append(max(np.abs(table["phi"] / exact - 1).max(), 0.1 * np.abs(table["E"] * radius / exact - 1).max()))
    assert errors[1] < 0.5 * errors[0] and errors[1] < 5e-4, errors
    mid = [[0.0, runs.RADIUS + 0.2 * runs.THICKNESS, 0.0]]
    assert probe(archive, mid)["where"].tolist() == ["in the shell"] * 2
    assert probe(archive, mid, side="top")["phi"] == pytest.approx([runs.VOLTAGE / 2, runs.VOLTAGE], rel=1e-6)
    assert probe(archive, [[0.0, 0.0, 9.0]])["where"].tolist() == ["beyond the meshed space"] * 2
    assert probe(archive, [[0.0, 0.0, 0.01]], steps=[-1])["phi"] == pytest.approx([runs.VOLTAGE], rel=1e-6)

    along = line(archive, (0.0, 0.0, 0.0), (0.0, 0.03, 0.04), count=26, steps=[-1])
    np.testing.assert_allclose(along["distance"], 0.05 * np.arange(26) / 25)
    np.testing.assert_allclose(along["phi"][11:], runs.VOLTAGE * runs.OUTER / along["distance"][11:], rtol=5e-4)

    height, radius = 0.03, 0.02
    disc = flux(archive, (0.0, 0.0, height), (0.0, 0.0, 2.0), radius, steps=[-1])
    share = (1 - height / math.hypot(height, radius)) / 2  # of the full solid angle
    assert disc["flux"] == pytest.approx([runs.CAPACITANCE * runs.VOLTAGE * share], rel=2e-3)
    cut = flux(archive, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), 0.03, steps=[-1])
    assert np.isnan(cut["flux"]).all() and cut["where"].tolist() == ["cut by the shell"]


def test_what_cannot_be_asked(tmp_path: Path) -> None:
    archive = made_up(tmp_path, "axisymmetric", 0.8)
    with pytest.raises(PostError, match="no side 'left'; there are outside"):
        probe(archive, [[0, 0, 0]], side="left")
    with pytest.raises(ArchiveError, match="no field 'H'; there are u, phi, E"):
        probe(archive, [[0, 0, 0]], fields=["H"])
    with pytest.raises(ArchiveError, match="no step 9"):
        probe(archive, [[0, 0, 0]], steps=[9])
    with pytest.raises(PostError, match="three finite coordinates"):
        probe(archive, [[0, 0]])
    with pytest.raises(PostError, match="at least 2 points"):
        line(archive, (0, 0, 0), (1, 0, 0), count=1)
    with pytest.raises(PostError, match="positive radius"):
        flux(archive, (0, 0, 0), (0, 0, 1), 0.0)
    with pytest.raises(PostError, match="no column 'H'; there are step"):
        probe(archive, [[0, 0, 0]])["H"]
    bare = Problem("axisymmetric", size=0.8, order=2)
    del bare.blocks["outside"], bare.blocks["inside"]
    tell(Recorder(tmp_path / "bare.vtkhdf"), bare, steps=1)
    with pytest.raises(PostError, match="nothing is meshed around the shell"):
        probe(tmp_path / "bare.vtkhdf", [[0, 0, 0]])
    tell(Recorder(tmp_path / "none.vtkhdf"), Problem("axisymmetric", 1.0), steps=0, result="PULL_IN")
    with pytest.raises(PostError, match="no step was accepted"):
        probe(tmp_path / "none.vtkhdf", [[0, 0, 0]])


def test_tables(tmp_path: Path) -> None:
    table = probe(made_up(tmp_path, "axisymmetric", 0.8), [[0.0, 0.0, 0.01], [9.0, 0.0, 0.0]])
    frame = table.to_pandas()
    assert frame.attrs["units"]["E_x"] == "V/m" and len(frame) == 4
    text = table.to_csv(tmp_path / "t.csv").read_text().splitlines()
    assert text[0].startswith("step,factor_mechanical,factor_field,point,x [m],y [m],z [m],where,phi [V],E_x [V/m]")
    assert text[2].endswith("beyond the meshed space,,,,,")


def test_a_moment_given_at_an_end_is_shown_there(tmp_path: Path) -> None:
    """A strip under a moment at its end alone carries that moment everywhere."""
    scene = load_scene(Path(cantilever_moment.__file__).with_suffix(".toml"))
    solve(scene, archive=tmp_path / "run.vtkhdf", progress=False)
    places = [[x, 0.0, 0.0] for x in (0.0, 5.5, 12.0)]
    table = probe_shell(tmp_path / "run.vtkhdf", places, fields=["moment_major", "moment_minor"])
    given = scene.loads.edge_moments[0].moment * table["factor_mechanical"]
    largest = np.maximum(np.abs(table["moment_major"]), np.abs(table["moment_minor"]))
    np.testing.assert_allclose(largest, np.abs(given), rtol=2e-3)
