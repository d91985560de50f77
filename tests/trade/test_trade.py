"""Trades: which rungs a scene has, who is on the front, and what was measured."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import Any

import pytest

from embedding import Scene, load_scene
from embedding.cli import main
from embedding.studies.errors import StudyError
from embedding.trade import Row, Rung, Trade, ladder, measure_trade, measuring
from embedding.trade.chart import figure_of, trade_plot
from embedding.trade.ladder import FINEST, PLANNED
from embedding.trade.rows import cheapest, front
from problems import charged_balloon
from tests.balloons import SMALLEST


def rungs(scene: Scene) -> dict[str, tuple[str, ...]]:
    return {rung.name: rung.changes for rung in ladder(scene)}


def test_rungs_of_a_charged_balloon() -> None:
    """The planned order, reduction, interface, coupling and far field are not among the changes."""
    found = rungs(charged_balloon.scene())
    assert found[PLANNED] == ()
    assert {"order 1", "order 2", "order 4", "mesh x 2", "mesh / 2", "3d", "bending", "faces closed"} < set(found)
    assert {"coupling staggered", "coupling once", "far field infinite"} < set(found)
    assert not {"order 3", "faces opened", "coupling joint", "far field robin", "axisymmetric"} & set(found)
    assert "discretisation.order=4" in found[FINEST] and "model.far_field=infinite" in found[FINEST]


def test_rungs_without_a_field() -> None:
    found = {rung.of for rung in ladder(Scene.from_toml(SMALLEST))}
    assert found == {"plan", "order", "mesh", "order and mesh", "reference", "reduction", "shell theory"}


def row(name: str, error: float, cpu: float, status: str = "done") -> Row:
    return Row(name, "order", (), status, error=error, cpu_seconds=cpu)


def test_the_front_and_the_cheapest() -> None:
    rows = [
        row("slow and rough", 1e-2, 9.0), row("quick", 1e-2, 1.0), row("good", 1e-4, 3.0),
        row("as good, slower", 1e-4, 4.0), row("exact", 0.0, 8.0), row("unknown", math.nan, 0.1),
        row("failed", math.nan, 0.1, "diverged"),
    ]  # fmt: skip
    assert [one.rung for one in front(rows)] == ["quick", "good", "exact"]
    best = {tolerance: cheapest(rows, tolerance) for tolerance in (1e-1, 1e-3, 1e-5)}
    assert {t: one and one.rung for t, one in best.items()} == {1e-1: "quick", 1e-3: "good", 1e-5: "exact"}
    assert cheapest(rows[:2], 1e-3) is None


SHORT = (
    Rung(PLANNED, "plan"),
    Rung("order 1", "order", ("discretisation.order=1",)),
    Rung("in the plane", "reduction", ("model.reduction=plane-strain",)),
    Rung(FINEST, "reference", ("discretisation.order=4",)),
)


@pytest.fixture
def scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A scene for which one rung is refused, in the present folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(measuring, "ladder", lambda scene: SHORT)
    (tmp_path / "small.toml").write_text(SMALLEST)
    return tmp_path / "small.toml"


def test_a_short_ladder(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """From the command line: table, CSV, picture and JSON; the second time nothing is solved."""
    pytest.importorskip("pebble")
    asked = ["trade", str(scene), "--csv", "trade.csv", "--picture", "trade.png", "--no-progress"]
    assert main(asked) == 0
    printed = capsys.readouterr().out
    assert "the finest rung's" in printed and "in the plane: refused: model.reduction" in printed
    with open("trade.csv", encoding="utf-8") as file:
        lines = {line["rung"]: line for line in csv.DictReader(file)}
    assert list(lines) == [rung.name for rung in SHORT]
    assert float(lines[PLANNED]["error"]) < 0.2 * float(lines["order 1"]["error"])
    assert Path("trade.png").stat().st_size > 10_000
    before = {path: path.stat().st_mtime_ns for path in Path("small_balloon.trade").rglob("record.json")}
    assert len(before) == 3
    assert main([*asked, "--json"]) == 0
    summary = json.loads(capsys.readouterr().out)
    assert summary["quantity"] == "displacement" and summary["best"]["0.0001"] == PLANNED
    assert before == {path: path.stat().st_mtime_ns for path in Path("small_balloon.trade").rglob("record.json")}


def test_a_stated_reference(scene: Path) -> None:
    """Its error is then known for the finest rung as well; a wrong name is answered by what there is."""
    pytest.importorskip("pebble")
    found = measure_trade(load_scene(scene), "trade", quantity="volume_ratio", reference=1.0)
    assert all(one.error == pytest.approx(one.value - 1.0) for one in found.rows if one.done)
    assert found.cost(found.rows[0]) == 1.0
    with pytest.raises(StudyError, match="no scalar volume: did you mean \"volume_ratio\""):
        measure_trade(load_scene(scene), "trade", quantity="volume")


def test_names_in_the_picture_do_not_cover_each_other() -> None:
    """Two rungs close to each other, between others."""
    pytest.importorskip("pebble")
    scene = charged_balloon.scene()
    places = {PLANNED: (1.0, 1e-4), "order 2": (1.01, 1.05e-4), "faces closed": (4.0, 1e-2), "3d": (9.0, 1e-6)}
    rows = tuple(
        Row(rung, "plan", (), "done", value=1.0, error=error, cpu_seconds=cpu) for rung, (cpu, error) in places.items()
    )
    figure = figure_of(Trade(scene, "stretch", "1", 1.0, True, rows))
    figure.draw_without_rendering()
    names = {text.get_text(): text.get_window_extent() for text in figure.axes[0].texts}
    assert names.keys() == places.keys()
    assert all(box.count_overlaps(names.values()) == 1 for box in names.values()), "itself alone"


@pytest.mark.slow
def test_what_approximations_cost_a_charged_balloon(tmp_path: Path) -> None:
    """Against the exact thick sphere: faces at the mid-surface and a field solved once are what is not affordable."""
    pytest.importorskip("pebble")
    scene = charged_balloon.scene("path.0.steps=3")
    exact = charged_balloon.exact(scene).stretch(600e3)
    found = measure_trade(scene, tmp_path / "trade", quantity="stretch", reference=exact)
    errors: dict[str, Any] = {one.rung: one.error for one in found.rows}
    assert errors[PLANNED] < 2e-4
    assert errors["faces closed"] > 30 * errors[PLANNED] and errors["coupling once"] > 30 * errors[PLANNED]
    assert errors["order 1"] > 5 * errors["order 2"]
    cost = {one.rung: found.cost(one) for one in found.rows}
    assert cost["3d, mesh of the plan"] > 5
    assert figure_of(found).axes
    trade_plot(found, tmp_path / "trade.png")
