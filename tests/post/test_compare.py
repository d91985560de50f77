"""Two archives beside each other: the same run, a changed scene, another mesh."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from embedding import open_archive
from embedding.archive import Recorder
from embedding.post import PostError, compare
from tests.archive.made_up_run import Problem, tell
from tests.post import runs


def made_up(path: Path, size: float, steps: int = 2, order: int = 3) -> Path:
    tell(Recorder(path), Problem("axisymmetric", size=size, order=order), steps=steps)
    return path


def test_a_run_is_the_same_as_itself(tmp_path: Path) -> None:
    one, other = (made_up(tmp_path / f"{name}.vtkhdf", 0.5) for name in "ab")
    found = compare(one, other)
    assert found.same and found.factors == 2 and found.scene == () and found.only == ((), ())
    assert not np.any(found.table["max"]) and {"scalar", "field"} == set(found.table["kind"])
    assert {"stretch", "shell.p_t", "outside.E"} <= set(found.table["name"])


@pytest.mark.parametrize("order", [2, pytest.param(3, marks=pytest.mark.slow)])
def test_another_mesh_is_interpolated(order: int, tmp_path: Path) -> None:
    """The made-up fields are the same functions on every mesh; what is left is the interpolation's error."""
    gaps = []
    for size in (0.8, 0.4):
        found = compare(
            made_up(tmp_path / "a.vtkhdf", 0.25, order=order), made_up(tmp_path / "b.vtkhdf", size, order=order)
        )
        gaps.append(float(found.table["rms"][list(found.table["name"]).index("outside.u")]))
    assert gaps[1] < 0.5 * gaps[0] and gaps[1] > 0.0


def test_what_is_different_is_named(tmp_path: Path) -> None:
    one = runs.sphere(tmp_path, 0.6)
    other = runs.sphere(tmp_path, 0.5, runs.SPHERE.replace("3000.0", "3300.0"))
    found = compare(one, other, tolerance=1e-3)
    assert not found.same and found.factors == 2
    paths = {path: (first, second) for path, first, second in found.scene}
    assert paths["faces.both.voltage"] == ("3000.0", "3300.0") and "discretisation.shell_size" in paths
    columns = [found.table[name] for name in ("name", "max", "relative", "step")]
    rows = {name: row for name, *row in zip(*columns, strict=True)}
    assert rows["charge"][1] == pytest.approx(1 - 1 / 1.1, rel=1e-3) and rows["charge"][2] == 2
    assert rows["outside.phi"][0] == pytest.approx(300.0, rel=1e-2)
    assert rows["voltage"][0] == pytest.approx(300.0)


def test_rounding_is_no_difference(tmp_path: Path) -> None:
    """There is no field in a conductor: what its inside has is rounding, and another one on another mesh."""
    found = compare(runs.sphere(tmp_path, 0.6), runs.sphere(tmp_path, 0.5), tolerance=0.1)
    relative = dict(zip(found.table["name"], found.table["relative"], strict=True))
    assert relative["inside.E"] == relative["inside.energy_density"] == 0.0 < relative["outside.E"]


def test_a_number_against_none_is_a_difference(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    one, other = (open_archive(made_up(tmp_path / f"{name}.vtkhdf", 0.8)) for name in "ab")
    monkeypatch.setitem(other.scalars, "stretch", np.full(2, np.nan))
    found = compare(one, other)
    assert not found.same
    assert found.table["relative"][list(found.table["name"]).index("stretch")] == np.inf


@pytest.mark.parametrize("tolerance", [-1.0, float("nan")])
def test_a_tolerance_is_a_size(tolerance: float, tmp_path: Path) -> None:
    path = made_up(tmp_path / "a.vtkhdf", 0.8)
    with pytest.raises(PostError, match="a tolerance is 0 or more"):
        compare(path, path, tolerance=tolerance)


def test_paths_without_common_loads(tmp_path: Path) -> None:
    found = compare(made_up(tmp_path / "a.vtkhdf", 0.8, 2), made_up(tmp_path / "b.vtkhdf", 0.8, 4))
    assert found.factors == 2
    found = compare(made_up(tmp_path / "a.vtkhdf", 0.8, 2), made_up(tmp_path / "b.vtkhdf", 0.8, 3))
    assert found.factors == 1 and found.table["step"].max() == 2
