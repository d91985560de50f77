"""Moving pictures, and the page for a browser."""

from __future__ import annotations

import base64
import importlib
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from embedding import open_archive
from embedding.archive import Recorder
from embedding.errors import ArchiveError
from embedding.view import RenderError, animation, can_render, faces_plot, interactive_page, rendering
from embedding.view.interactive import page_data
from tests.archive.made_up_run import Problem, tell

draws = pytest.mark.skipif(not can_render(), reason="no OpenGL driver here")


def run(folder: Path, reduction: str = "axisymmetric", steps: int = 3) -> Path:
    tell(Recorder(folder / "run.vtkhdf"), Problem(reduction, size=0.8, order=2), steps=steps)
    return folder / "run.vtkhdf"


@draws
@pytest.mark.parametrize("reduction", ["axisymmetric", pytest.param("3d", marks=pytest.mark.slow)])
def test_a_moving_picture(reduction: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.import_module("embedding.view.animation"), "PIXELS", (500, 500))
    from PIL import Image

    path = animation(run(tmp_path, reduction), tmp_path / "a.gif", reach=1.5, lines=reduction == "3d")
    with Image.open(path) as film:
        assert film.n_frames == 3 and film.info["loop"] == 0
        frames = []
        for number in range(3):
            film.seek(number)
            frames.append(np.asarray(film.convert("RGB"), float))
    assert len({frame.shape for frame in frames}) == 1
    for frame in frames:
        red, _, blue = frame.reshape(-1, 3).T
        assert np.mean(red > blue + 40) > 0.01, "the shell is there"
        assert frame[:6].min() > 250 and frame[:, :6].min() > 250, "nothing is cut off"
    assert np.abs(frames[2] - frames[0]).mean() > 1.0, "it moves"


def test_films_need_a_writer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(RenderError, match=r"pip install 'embedding\[movies\]'; a GIF needs nothing more"):
        animation(tmp_path / "run.vtkhdf", tmp_path / "a.mp4")


def test_where_nothing_can_be_drawn_it_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rendering, "PROBE", "import os; os.abort()")
    rendering.can_render.cache_clear()
    try:
        with pytest.raises(RenderError, match="no OpenGL driver answers"):
            animation(run(tmp_path), tmp_path / "a.gif")
        with pytest.raises(RenderError, match="no OpenGL driver answers"):
            faces_plot(run(tmp_path, "3d"), tmp_path / "f.png")
        assert interactive_page(run(tmp_path), tmp_path / "p.html").exists()
        assert faces_plot(run(tmp_path), tmp_path / "f.png").exists()
    finally:
        rendering.can_render.cache_clear()


def decoded(text: str, kind: str) -> Any:
    return np.frombuffer(base64.b64decode(text), kind).astype(float)


@pytest.mark.parametrize("reduction", ["axisymmetric", "plane-strain", "3d"])
def test_a_page_for_a_browser(reduction: str, tmp_path: Path) -> None:
    archive = run(tmp_path, reduction)
    page = interactive_page(archive, tmp_path / "p.html").read_text()
    assert not re.search(r"https?:|src=|href=|@DATA@|@TITLE@", page), "the page asks for nothing"
    data = json.loads(re.search(r"const DATA = (.*);\n", page)[1])  # type: ignore[index]
    assert [step["caption"].split("  ")[0] for step in data["steps"]] == ["step 1 of 3", "step 2 of 3", "step 3 of 3"]
    names = [field["name"] for field in data["fields"]]
    assert names[0] == "stretch" and {"u", "p_t", "p_b", "thickness_stretch"} <= set(names) and "normal" not in names
    triangles = decoded(data["triangles"], "<u4").reshape(-1, 3)
    places = decoded(data["steps"][-1]["places"], "<i2").reshape(-1, 3)
    assert triangles.max() == len(places) - 1
    along = 1 if reduction == "plane-strain" else 2
    first = decoded(data["steps"][0]["places"], "<i2").reshape(-1, 3)
    stretched = np.ptp(places[:, along]) / np.ptp(first[:, along])
    assert stretched == pytest.approx(1.35 / (1 + 0.35 / 3), rel=2e-2)
    field = names.index("p_b")
    levels = decoded(data["steps"][-1]["values"][field], "<u2") / 65535
    low, high = (data["fields"][field][end] for end in ("low", "high"))
    assert low + levels.max() * (high - low) == pytest.approx(340, rel=1e-2)
    assert data["fields"][field]["label"].endswith("[Pa]") and len(page) < 3_000_000
    assert len(decoded(data["colours"], "<u1")) == 3 * 256


def test_what_a_page_cannot_show(tmp_path: Path) -> None:
    archive = run(tmp_path, steps=1)
    assert [field["name"] for field in page_data(open_archive(archive), ["p_t"])["fields"]] == ["p_t"]
    with pytest.raises(ArchiveError, match="no field 'colour'; there are u, p_t"):
        interactive_page(archive, tmp_path / "p.html", fields=["colour"])
    tell(Recorder(tmp_path / "none.vtkhdf"), Problem("axisymmetric", 1.0), steps=0, result="PULL_IN")
    with pytest.raises(ArchiveError, match="no step was accepted"):
        interactive_page(tmp_path / "none.vtkhdf", tmp_path / "p.html")
