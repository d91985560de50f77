"""What a step costs on the disk, against its fields in single precision."""

from __future__ import annotations

from pathlib import Path

from embedding.archive import Recorder, open_archive
from tests.archive.made_up_run import Problem, tell


def test_a_step_is_little_more_than_its_fields(tmp_path: Path) -> None:
    """Beyond the meshes and the two slots to go on from, which do not grow with the steps; tables come in chunks, of
    which a file has one each from its first step on."""
    path, sizes = tmp_path / "run.vtkhdf", {}
    problem = Problem("3d", size=0.35, order=3)
    for steps in (4, 12):
        tell(Recorder(path), problem, steps=steps)
        sizes[steps] = path.stat().st_size
    archive = open_archive(path)
    blocks = [archive.block(name) for name in archive.blocks]
    raw = sum(block.field(field).nbytes for block in blocks for field in block.fields)
    assert raw > 100_000
    assert (sizes[12] - sizes[4]) / 8 < 1.1 * raw
