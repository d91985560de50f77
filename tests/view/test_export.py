"""The series of files for older viewers holds what the archive does."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from embedding.archive import Recorder, open_archive
from embedding.cli import main
from embedding.errors import ArchiveError
from embedding.view.export import export
from tests.archive.made_up_run import Problem, tell

pyvista = pytest.importorskip("pyvista")


@pytest.mark.parametrize("reduction", ["axisymmetric", "3d"])
def test_every_step_of_every_block(reduction: str, tmp_path: Path) -> None:
    path = tmp_path / "run.vtkhdf"
    tell(Recorder(path), Problem(reduction, size=1.0, order=3), steps=3)
    archive = open_archive(path)
    assert main(["export", str(path)]) == 0
    for name in archive.blocks:
        reader = pyvista.get_reader(tmp_path / "run" / f"{name}.pvd")
        assert reader.time_values == [1.0, 2.0, 3.0]
        for step in range(3):
            reader.set_active_time_point(step)
            grid, block = reader.read()[0], archive.block(name, step)
            np.testing.assert_array_equal(grid.points, block.points.astype(grid.points.dtype))
            np.testing.assert_array_equal(grid.cells_dict[block.cell_type], block.cells)
            assert set(grid.point_data.keys()) == set(block.fields)
            for field in block.fields:
                np.testing.assert_array_equal(grid.point_data[field], block.field(field))
            for scalar, values in archive.scalars.items():
                assert grid.field_data[scalar] == values[step]


def test_nothing_is_overwritten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "run.vtkhdf"
    tell(Recorder(path), Problem("axisymmetric", size=1.0, order=1), steps=1)
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "mine.txt").touch()
    with pytest.raises(ArchiveError, match="holds files already; name a new folder"):
        export(open_archive(path), tmp_path / "run")
    assert main(["export", str(path), "--out", str(path)]) != 0
    assert "cannot be written" in capsys.readouterr().err
