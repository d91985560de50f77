"""Pictures of every reduction are drawn, look as they should in the large, and fail in words."""

from __future__ import annotations

import math
import sys
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from netgen.occ import OCCGeometry, Pnt, Segment, Wire
from ngsolve import Mesh

from embedding.archive import Recorder, open_archive
from embedding.errors import ArchiveError
from embedding.view import RenderError, can_render, history_plot, picture, rendering
from embedding.view.colours import colour_limits
from embedding.view.picture import StepView
from embedding.view.section import cropped, sections
from embedding.view.surface import shell_surface
from problems import dielectric_balloon
from tests.archive.made_up_run import LENGTH, RADIUS, Problem, tell

REDUCTIONS = ("axisymmetric", "plane-strain", "3d")
draws = pytest.mark.skipif(not can_render(), reason="no OpenGL driver here")


@pytest.fixture(scope="module", params=REDUCTIONS)
def archive(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished run of every reduction, of two steps."""
    path = tmp_path_factory.mktemp(request.param) / "run.vtkhdf"
    tell(Recorder(path), Problem(request.param, size=0.8, order=3), steps=2)
    return path


def pixels(path: Path) -> Any:
    """The pixels of a PNG file, (height, width, 3), from 0 to 1."""
    from matplotlib.image import imread

    return imread(path)[..., :3]


def measure(points: Any, simplices: Any) -> float:
    """Area of triangles in space."""
    corners = points[simplices]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float(np.linalg.norm(normals, axis=1).sum() / 2)


def test_the_whole_shell_is_shown(archive: Path) -> None:
    opened = open_archive(archive)
    rest = shell_surface(opened, "stretch", 0, deformed=False, depth=2.0)
    radius = RADIUS * LENGTH
    exact = 4 * math.pi * radius**2  # of a sphere; of a cylinder twice as long as its radius, the same
    assert measure(rest.points, rest.triangles) == pytest.approx(exact, rel=1e-2)
    moved = shell_surface(opened, "stretch", 1)
    along = 1 if opened.run["reduction"] == "plane-strain" else 2
    assert np.ptp(moved.points[:, along]) == pytest.approx(1.35 * 2 * radius, rel=1e-2)
    if opened.run["reduction"] == "axisymmetric":
        part = shell_surface(opened, "stretch", 0, turn=(0.0, 270.0), deformed=False)
        assert measure(part.points, part.triangles) == pytest.approx(0.75 * exact, rel=1e-2)
        assert not ((part.points[:, 0] > 1e-9) & (part.points[:, 1] < -1e-9)).any()


def test_the_plane_of_the_ambient_is_whole(archive: Path) -> None:
    pytest.importorskip("pyvista")
    opened = open_archive(archive)
    planes = sections(opened, "E", 1)
    assert set(planes) == {"outside", "inside"}
    half = opened.run["reduction"] != "plane-strain"
    axis = 2 if half else 1
    normal = 1 if half else 2
    for side, plane in planes.items():
        assert np.abs(plane.points[:, normal]).max() < 1e-9
        if half:
            assert plane.points[:, 0].min() > -1e-9
        reach = np.abs(plane.points[:, axis]).max() / LENGTH
        assert reach == pytest.approx(1.35 if side == "inside" else 3.0 + 0.35 / 9, rel=2e-2)
        assert plane.points[:, axis].min() == pytest.approx(-plane.points[:, axis].max(), rel=2e-2)
    inner = planes["inside"]
    area = math.pi * 1.35 * 0.85 * LENGTH**2 / (2 if half else 1)
    assert measure(inner.points, inner.triangles) == pytest.approx(area, rel=3e-2)
    assert (inner.vectors[:, axis] > 0).all(), "the mirrored field goes on through an odd plane"
    part = cropped(planes["outside"], 2 * LENGTH)
    assert np.linalg.norm(part.points, axis=1).max() == pytest.approx(2 * LENGTH, rel=1e-3)


@draws
def test_a_picture_is_drawn(archive: Path, tmp_path: Path) -> None:
    output = tmp_path / "picture.png"
    assert picture(archive, output) == output
    image = pixels(output)
    assert min(image.shape[:2]) > 800
    corners = image[[0, 0, -1, -1], [0, -1, 0, -1]]
    np.testing.assert_array_equal(corners, 1.0)
    red, green, blue = image.reshape(-1, 3).T
    assert 0.02 < np.mean(red > blue + 0.2) < 0.6, "the shell is there, in warm colours"
    assert 0.05 < np.mean(blue > red + 0.05) < 0.6, "the field is there, in cold colours"
    for border in (image[:12], image[-12:], image[:, :12], image[:, -12:]):
        assert border.min() == 1.0, "nothing is cut off"


@draws
def test_other_fields_and_steps(archive: Path, tmp_path: Path) -> None:
    for number, (shell, ambient) in enumerate([("p_b", "phi"), ("u", "u")]):
        output = tmp_path / f"{number}.png"
        picture(archive, output, step=0, shell_field=shell, ambient_field=ambient, lines=False, reach=1.5)
        assert np.ptp(pixels(output)) > 0.5
    with pytest.raises(ArchiveError, match="no field 'colour'"):
        picture(archive, tmp_path / "x.png", shell_field="colour")
    with pytest.raises(ArchiveError, match="no field 'H'; there are u, phi, E"):
        picture(archive, tmp_path / "x.png", ambient_field="H")
    with pytest.raises(ArchiveError, match="no step 7"):
        picture(archive, tmp_path / "x.png", step=7)
    assert not (tmp_path / "x.png").exists()


@draws
def test_a_shell_without_ambient(tmp_path: Path) -> None:
    problem = Problem("axisymmetric", size=0.8, order=2)
    del problem.blocks["outside"], problem.blocks["inside"]
    tell(Recorder(tmp_path / "run.vtkhdf"), problem, steps=1)
    image = pixels(picture(tmp_path / "run.vtkhdf", tmp_path / "p.png"))
    red, _, blue = image.reshape(-1, 3).T
    assert np.mean(red > blue + 0.2) > 0.1


@draws
def test_a_disc_is_revolved_whole(tmp_path: Path) -> None:
    problem = Problem("axisymmetric", size=0.8, order=2)
    wire = Wire([Segment(Pnt(0, 0, 0), Pnt(RADIUS, 0, 0))])
    problem.mesh = Mesh(OCCGeometry(wire, dim=2).GenerateMesh(maxh=0.3))
    shell = problem.mesh.Boundaries(".*")
    problem.blocks = {"shell": SimpleNamespace(name="shell", region=shell, codim=1, within=nullcontext)}
    toml = problem.scene.to_toml().replace('"sphere"', '"disc"')
    problem.scene = SimpleNamespace(to_toml=lambda: toml, name="disc", discretisation=problem.scene.discretisation)
    path = tmp_path / "run.vtkhdf"
    tell(Recorder(path), problem, steps=1)
    whole = shell_surface(open_archive(path), "stretch", 0, deformed=False)
    assert measure(whole.points, whole.triangles) == pytest.approx(math.pi * (RADIUS * LENGTH) ** 2, rel=1e-2)
    picture(path, tmp_path / "p.png")


def test_a_history_is_drawn(archive: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    output = tmp_path / "history.png"
    assert history_plot(archive, output) == output
    image = pixels(output)
    assert min(image.shape[:2]) > 600
    assert 0.01 < np.mean(image.min(axis=2) < 0.9) < 0.3


def test_a_run_without_steps_has_no_history(tmp_path: Path) -> None:
    path = tmp_path / "run.vtkhdf"
    tell(Recorder(path), Problem("axisymmetric", 1.0), steps=0, result="PULL_IN")
    with pytest.raises(ArchiveError, match="no step was accepted"):
        history_plot(path, tmp_path / "history.png")
    if can_render():
        with pytest.raises(ArchiveError, match="0 steps are committed"):
            picture(path, tmp_path / "picture.png")


def test_where_nothing_can_be_drawn_it_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rendering, "PROBE", "import os; os.abort()")
    rendering.can_render.cache_clear()
    try:
        assert not can_render()
        with pytest.raises(RenderError, match="apt-get install libegl1 libgl1-mesa-dri"):
            picture(tmp_path / "run.vtkhdf", tmp_path / "p.png")
        monkeypatch.setitem(sys.modules, "pyvista", None)
        monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
        with pytest.raises(RenderError, match=r"pyvista and matplotlib: pip install 'embedding\[pictures\]'"):
            history_plot(tmp_path / "run.vtkhdf", tmp_path / "p.png")
        rendering.can_render.cache_clear()
        assert not can_render()
    finally:
        rendering.can_render.cache_clear()


@pytest.mark.parametrize(
    ("values", "from_zero", "expected"),
    [
        ([1.0, 2.0], False, (1.0, 2.0)),
        ([1.0, 4.0], True, (0.0, 4.0)),
        ([3.0, 4.0], True, (3.0, 4.0)),
        ([1.0, 1.0 + 1e-9], False, (0.99, 1.01)),
        ([0.0, 0.0], True, (0.0, 1e-3)),
        ([0.0, 0.0], False, (-5e-4, 5e-4)),
    ],
)
def test_ranges_of_colours(values: list[float], from_zero: bool, expected: tuple[float, float]) -> None:
    low, high = colour_limits([np.array(values), np.array([math.nan])], from_zero, noise=1e-3)
    assert (low, high) == pytest.approx(expected, rel=2e-3)


def test_a_field_that_is_all_in_the_wall_is_not_drawn_beside_it(tmp_path: Path) -> None:
    """What the solve leaves beside a dielectric balloon is rounding, and would be drawn as lines in all directions."""
    path = tmp_path / "balloon.vtkhdf"
    changes = "path=[{steps = 1, field = 0.0}, {steps = 1}]", "faces.bottom.voltage=10 kV", "discretisation.order=2"
    dielectric_balloon.run(*changes, archive=path)
    archive = open_archive(path)
    assert "outside" in archive.blocks
    assert StepView.of(archive, 1, None, None, 2.4).ambient_field is None
    assert StepView.of(archive, 0, None, None, 2.4).ambient_field == "E"
