"""Starting from the state of another run: when its loads are this scene's at other factors, and when they are not."""

from __future__ import annotations

from pathlib import Path

import pytest

from embedding import ArchiveError, Scene, open_archive, solve
from embedding.post import energy_balance
from embedding.solving.neighbour import common_factors
from tests.balloons import SMALL

pytestmark = pytest.mark.usefixtures("unestimated")

SCENE = Scene.from_toml(SMALL)
CHARGED = SCENE.with_overrides(
    ["ambient.field=electric", "shell.relative_permittivity=3.0", "faces.top.voltage=0.0", "faces.bottom.voltage=1e3"]
)
VARYING = "loads.surface_force={expression=['x', 'y', 'z'], unit='kPa'}"


@pytest.mark.parametrize(
    ("scene", "changes", "factors"),
    [
        (SCENE, ["loads.pressure_bottom=1000.0"], (0.5, 1.0)),
        (SCENE, ["loads.pressure_bottom=1000.0", "path.0.steps=7", "name=other", "solver.threads=2"], (0.5, 1.0)),
        (SCENE, [], (1.0, 1.0)),
        (CHARGED, ["faces.bottom.voltage=4e3"], (1.0, 0.25)),
        (CHARGED, ["faces.bottom.voltage=4e3", "loads.pressure_bottom=250.0"], (2.0, 0.25)),
        (SCENE, ["loads.pressure_top=100.0"], None),  # another mixture of loads
        (SCENE, ["shell.thickness=0.3 mm"], None),
        (SCENE, ["loads.pressure_bottom=0.0"], None),
        (SCENE.with_overrides([VARYING]), ["loads.pressure_bottom=1000.0"], None),
        (SCENE, ["shell.density=1000.0"], None),
    ],
)
def test_loads_at_other_factors(scene: Scene, changes: list[str], factors: tuple[float, float] | None) -> None:
    assert common_factors(scene, scene.with_overrides(changes)) == (factors and pytest.approx(factors, rel=1e-12))


def test_from_the_archive_of_another_scene(tmp_path: Path) -> None:
    solve(SCENE, archive=tmp_path / "first.vtkhdf")
    more = SCENE.with_overrides(["loads.pressure_bottom=700.0"])
    found = solve(more, start=tmp_path / "first.vtkhdf")
    known = solve(more)
    assert (found.start, known.start) == ("neighbour", "rest")
    assert len(found.steps) == 1
    assert found["stretch"][-1] == pytest.approx(known["stretch"][-1], rel=1e-10)
    assert found.iterations < known.iterations
    assert found.steps[-1].factor_mechanical == 1.0


def test_the_archive_tells_where_the_run_began(tmp_path: Path) -> None:
    """Work is counted from there: over a path of several steps it is what was stored."""
    solve(SCENE, archive=tmp_path / "first.vtkhdf")
    known = open_archive(tmp_path / "first.vtkhdf")
    assert known.start == "rest"
    beyond = SCENE.with_overrides(["loads.pressure_bottom=5000.0"])
    solve(beyond, archive=tmp_path / "second.vtkhdf", start=tmp_path / "first.vtkhdf", throw=False)
    archive = open_archive(tmp_path / "second.vtkhdf")
    assert archive.start == "neighbour"
    assert archive.result.name == "LIMIT_POINT"
    balance = energy_balance(archive)
    work, stored = balance["work"], balance["stored"]
    assert len(work) == len(archive) > 3
    assert work[0] == 0.0
    assert work[-1] == pytest.approx(stored[-1] - stored[0], rel=2e-2)


def test_there_must_be_a_state(tmp_path: Path) -> None:
    with pytest.raises(ArchiveError, match=r"nowhere\.vtkhdf"):
        solve(SCENE, start=tmp_path / "nowhere.vtkhdf")
