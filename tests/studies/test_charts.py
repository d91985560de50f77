"""Charts of a study: the numbers of the table in the units of the axes, and what is missing left out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from embedding.studies import StudyError, StudyResult
from embedding.studies.charts import Axis, contours, gridded, lines, save
from tests.studies.samples import PRESSURE, study
from tests.studies.test_result import THICKNESS, told

GRID = {THICKNESS: ["0.2 mm", "0.4 mm", "0.6 mm"], PRESSURE: [500, "0.6 kPa", 700]}
"""The second case, 0.2 mm and 0.6 kPa, was killed; the stretches of the others are 1, 3, 4, ... 9."""

T, P = Axis(THICKNESS, "thickness", "mm"), Axis(PRESSURE, "pressure", "kPa")


@pytest.fixture
def result(tmp_path: Path) -> StudyResult:
    return told(study(GRID), tmp_path)


def test_lines_in_their_units(result: StudyResult) -> None:
    known = result.with_quantity("known", [10.0 * number for number in range(9)])
    figure = lines(known, P, Axis("stretch"), family=T, reference=Axis("known", "closed form"))
    (axes,) = figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("pressure [kPa]", "stretch")
    solid = [line for line in axes.lines if line.get_linestyle() == "-"]
    assert [line.get_label() for line in solid] == [f"thickness = {value} mm" for value in (0.2, 0.4, 0.6)]
    np.testing.assert_allclose(solid[0].get_xydata(), [(0.5, 1), (0.7, 3)])
    np.testing.assert_allclose(solid[2].get_xydata(), [(0.5, 7), (0.6, 8), (0.7, 9)])
    dotted = [line for line in axes.lines if line.get_linestyle() == ":"]
    np.testing.assert_allclose(dotted[1].get_ydata(), [30, 40, 50])
    assert [text.get_text() for text in axes.get_legend().get_texts()][-1] == "closed form"


def test_panels_and_the_end_of_a_line(result: StudyResult, tmp_path: Path) -> None:
    """The line of 0.6 kPa lacks its first case, that over the thickness at 0.2 mm its second of two."""
    figure = lines(result, P, Axis("stretch"), panels=T)
    assert [axes.get_title() for axes in figure.axes] == [f"thickness = {value} mm" for value in (0.2, 0.4, 0.6)]
    two = told(study({THICKNESS: ["0.2 mm"], PRESSURE: [500, 600]}), tmp_path / "two")
    (axes,) = lines(two, P, Axis("stretch")).axes
    (cross,) = [line for line in axes.lines if line.get_marker() == "x"]
    np.testing.assert_allclose(cross.get_xydata(), [(0.5, 1)])


def test_a_map(result: StudyResult, tmp_path: Path) -> None:
    across, up, height = gridded(result, P, T, Axis("stretch"))
    np.testing.assert_allclose(across, [0.5, 0.6, 0.7])
    np.testing.assert_allclose(up, [0.2, 0.4, 0.6])
    np.testing.assert_allclose(height, [[1, np.nan, 3], [4, 5, 6], [7, 8, 9]])
    figure = contours(result, P, T, Axis("stretch", log=True), reference=Axis("stretch", "the same"))
    axes, bar = figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel(), bar.get_ylabel()) == ("pressure [kPa]", "thickness [mm]", "stretch")
    chart = save(figure, tmp_path / "map.png")
    assert chart.read_bytes().startswith(b"\x89PNG")


def test_units_by_themselves(result: StudyResult) -> None:
    assert Axis(THICKNESS).text(result) == "shell.thickness [µm]"
    assert Axis(PRESSURE).text(result) == "loads.pressure bottom [Pa]"
    np.testing.assert_allclose(Axis(THICKNESS).values(result)[[0, -1]], [200.0, 600.0])


def test_what_cannot_be_drawn(result: StudyResult) -> None:
    with pytest.raises(StudyError, match="strech: the table has no numbers of that name; it has shell.thickness, "):
        Axis("strech").values(result)
    with pytest.raises(StudyError, match="status: the table has no numbers of that name"):
        lines(result, P, Axis("status"))
    with pytest.raises(StudyError, match='shell.thickness: "kPa" is a unit of mass'):
        Axis(THICKNESS, unit="kPa").values(result)
    with pytest.raises(StudyError, match="a map over shell.thickness and stretch needs one case for each pair"):
        contours(result, T, Axis("stretch"), P)


def test_a_quantity_of_ones_own(result: StudyResult) -> None:
    more = result.with_quantity("stroke", [1e-3 * row.quantities["stretch"] for row in result.rows], "m")
    assert more.units["stroke"] == "m"
    np.testing.assert_allclose(more.table()["stroke"], 1e-3 * result.table()["stretch"])
    assert more.dataset()["stroke"].attrs["units"] == "m"
    with pytest.raises(ValueError, match="there is a column stretch already"):
        result.with_quantity("stretch", [0.0] * 9)
    with pytest.raises(ValueError):
        result.with_quantity("short", [0.0])
