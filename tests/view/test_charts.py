"""Slices, faces and probes as charts: what they say, and where their curves are."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from embedding import open_archive
from embedding.archive import Recorder
from embedding.errors import ArchiveError
from embedding.post import line, probe
from embedding.view import can_render, faces_plot, probe_plot, slice_plot
from embedding.view.curves import probe_figure
from embedding.view.faces import chains, faces_figure
from embedding.view.section import Section, field_limits
from embedding.view.slice import slice_figure
from tests.archive.made_up_run import LENGTH, Problem, tell

REDUCTIONS = ("axisymmetric", "plane-strain", "3d")


@pytest.fixture(scope="module", params=REDUCTIONS)
def archive(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished run of every reduction, of two steps."""
    path = tmp_path_factory.mktemp(request.param) / "run.vtkhdf"
    tell(Recorder(path), Problem(request.param, size=0.8, order=3), steps=2)
    return path


def test_a_slice(archive: Path, tmp_path: Path) -> None:
    opened = open_archive(archive)
    flat = opened.run["reduction"] == "plane-strain"
    figure = slice_figure(opened, 1, None, True, 2.4)
    axes, bar = figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [mm]", "y [mm]" if flat else "z [mm]")
    assert bar.get_ylabel() == "electric field $|E|$ [kV/m]"
    assert axes.get_title(loc="left") == "made-up, step 2 of 2" and axes.get_aspect() == 1.0
    shell = [one for one in axes.lines if one.get_linewidth() > 2]
    lines = [one for one in axes.lines if one.get_linewidth() < 1]
    assert len(lines) > 8
    high = max(np.abs(one.get_ydata()).max() for one in shell)
    wide = max(one.get_xdata().max() for one in shell)
    assert (high, wide) == (pytest.approx(1e3 * 1.35 * LENGTH, rel=1e-2), pytest.approx(1e3 * 0.85 * LENGTH, rel=1e-2))
    assert min(one.get_xdata().min() for one in lines) < 0 if flat else axes.get_xlim()[0] == pytest.approx(0, abs=0.1)
    assert slice_plot(archive, tmp_path / "s.png", field="phi", lines=False).stat().st_size > 10_000


def test_an_infinite_field_does_not_hide_all_else() -> None:
    """Values r^(-1/2) of a rim on a mesh that is fine there; those of a half per cent of the area are cut off."""
    graded = np.linspace(0, 1, 41) ** 4
    points = np.array([[x, 0.0, z] for x in graded for z in graded])
    cells = [[i * 41 + j, (i + 1) * 41 + j, i * 41 + j + 1] for i in range(40) for j in range(40)]
    radius = np.maximum(np.linalg.norm(points, axis=1), 1e-6)
    (low, high), brighter = field_limits([Section(points, np.array(cells), radius**-0.5, points)], 1e-9)
    assert brighter and low == 0.0 and high == pytest.approx((4 * 0.005 / np.pi) ** -0.25, rel=0.15)
    assert field_limits([Section(points, np.array(cells), points[:, 0], points)], 1e-9)[1] is False


def test_a_slice_needs_an_ambient(tmp_path: Path) -> None:
    problem = Problem("axisymmetric", size=0.8, order=2)
    del problem.blocks["outside"], problem.blocks["inside"]
    tell(Recorder(tmp_path / "run.vtkhdf"), problem, steps=1)
    with pytest.raises(ArchiveError, match="there is no field to cut"):
        slice_plot(tmp_path / "run.vtkhdf", tmp_path / "s.png")


def test_both_faces(archive: Path, tmp_path: Path) -> None:
    """p_t = 40 Pa and p_b = 40 + 300 z^2 Pa over a half ellipse, whose length is known."""
    opened = open_archive(archive)
    if opened.run["reduction"] == "3d":
        if can_render():
            assert faces_plot(archive, tmp_path / "f.png").stat().st_size > 10_000
        return
    (axes,) = faces_figure(opened, 1).axes
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["top face, $p_t$", "bottom face, $p_b$"]
    top, bottom = axes.lines
    np.testing.assert_allclose(top.get_ydata(), 40.0, rtol=1e-5)
    assert (bottom.get_ydata().min(), bottom.get_ydata().max()) == (pytest.approx(40, abs=1), pytest.approx(340, abs=1))
    angle = np.linspace(0, 2 * np.pi if opened.run["reduction"] == "plane-strain" else np.pi, 20001)
    ellipse = np.column_stack([0.85 * np.sin(angle), 1.35 * np.cos(angle)]) * LENGTH * 1e3
    length = np.linalg.norm(np.diff(ellipse, axis=0), axis=1).sum()
    assert bottom.get_xdata()[-1] == pytest.approx(length, rel=2e-3)
    assert axes.get_ylabel() == "pressure [Pa]" and axes.get_xlabel().endswith("[mm]")


def test_segments_become_curves() -> None:
    curves = chains(np.array([[2, 1], [0, 1], [5, 6], [6, 7], [7, 5]]))
    assert [curve.tolist() for curve in curves] in ([[2, 1, 0], [5, 6, 7, 5]], [[0, 1, 2], [5, 6, 7, 5]])


def test_probes_along_a_line(archive: Path, tmp_path: Path) -> None:
    table = line(archive, (0.0, 0.0, 0.0), (0.9 * 3 * LENGTH, 0.0, 0.0), count=30)
    figure = probe_figure(table, "a_line")
    above, below = figure.axes
    assert [text.get_text() for text in above.get_legend().get_texts()] == ["step 1", "step 2"]
    assert above.get_ylabel().startswith(r"potential $\varphi$") and below.get_ylabel() == "electric field $|E|$ [kV/m]"
    assert below.get_xlabel() == "distance along the line [mm]" and above.get_title(loc="left") == "a line"
    assert all(np.isnan(one.get_ydata()).any() for one in below.lines), "a gap where the curve crosses the shell"
    assert probe_plot(table, tmp_path / "p.png").exists()


def test_probes_at_points(archive: Path) -> None:
    table = probe(archive, [[0.005, 0.0, 0.0], [0.04, 0.0, 0.0]], fields=["E"])
    (axes,) = probe_figure(table).axes
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["(5, 0, 0) mm", "(40, 0, 0) mm"]
    assert axes.get_xlabel() == "accepted step"
    with pytest.raises(ArchiveError, match="no field to draw"):
        probe_figure(probe(archive, [[0.0, 0.0, 0.0]], fields=[]))
