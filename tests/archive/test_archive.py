"""What a listener was told comes back from the archive; viewers see the same."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from ngsolve import CF

from embedding.archive import Recorder, open_archive, repair
from embedding.archive.lagrange import LagrangeBlock
from embedding.errors import ArchiveError
from embedding.scene import Scales, Scene
from tests.archive.made_up_run import LENGTH, Problem, State, record, solution, tell

REDUCTIONS = ("axisymmetric", "plane-strain", "3d")


@pytest.fixture(scope="module", params=REDUCTIONS)
def run(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """A problem, where it was recorded, and the records it told."""
    problem = Problem(request.param, size=1.0, order=2)
    path = tmp_path_factory.mktemp(request.param) / "run.vtkhdf"
    return problem, path, tell(Recorder(path), problem, steps=4)


def test_the_record_of_the_run(run: Any) -> None:
    problem, path, records = run
    archive = open_archive(path)
    assert len(archive) == 4
    assert archive.steps == tuple(records)
    assert archive.scene == problem.scene.to_toml()
    assert archive.scene_object() == problem.scene
    assert isinstance(archive.scene_object(), Scene)
    assert archive.scales == Scales.of(problem.scene)
    assert archive.plan.text() == f"reduction: {problem.reduction.name}"
    assert [decision.topic for decision in archive.plan.decisions] == ["reduction"]
    assert archive.run["reduction"] == problem.reduction.name
    assert tuple(archive.run["mirrors"]) == problem.reduction.planes
    assert {"embedding", "ngsolve", "numpy", "python", "platform"} <= archive.versions.keys()
    assert (archive.result.name, archive.result.message) == ("CONVERGED", "the whole path is solved")
    assert archive.error is not None and archive.error.value == 2e-4
    assert archive.cost is not None and archive.cost.unknowns == {"displacement": 120, "potential": 1000}
    assert archive.cuts == ({"step": 2, "fraction": 0.5, "reason": "update too large"},)
    archive.verify()


def test_scalars_and_newton(run: Any) -> None:
    problem, path, records = run
    archive = open_archive(path)
    for name, values in archive.scalars.items():
        expected = [getattr(one, name, one.scalars.get(name)) for one in records]
        np.testing.assert_array_equal(values, expected)
    per_length = problem.reduction.name == "plane-strain"
    assert archive.scalar_units["charge"] == ("C/m" if per_length else "C")
    assert archive.scalar_units["pressure_top"] == "Pa"
    newton = archive.newton(2)
    for name in ("update", "residual", "pressure_top", "pressure_bottom"):
        told = [getattr(one, name) for one in records[2].iterations]
        np.testing.assert_array_equal(getattr(newton, name), told)


def test_fields_and_checkpoint(run: Any) -> None:
    problem, path, records = run
    archive = open_archive(path)
    assert archive.blocks == ("shell", "outside", "inside")
    for step in (0, 3, -1):
        state = State(problem, records[step].factor_field)
        for field in state.fields():
            block = archive.block(field.block)
            assert block.units[field.name] == field.unit
            values = block.field(field.name, step)
            assert values.shape == ((len(block.points), 3) if field.values.dim > 1 else (len(block.points),))
            assert np.isfinite(values).all()
    shell = archive.block("shell")
    np.testing.assert_allclose(np.linalg.norm(shell.points, axis=1), LENGTH, rtol=6e-3)
    along = 1 if problem.reduction.name == "plane-strain" else 2
    np.testing.assert_allclose(shell.field("u")[:, along], 0.35 * shell.points[:, along], atol=1e-7)
    kept = archive.checkpoint()
    assert kept.pop("cuts") == list(archive.cuts)
    for name, vector in kept.items():
        np.testing.assert_array_equal(vector, State(problem, 1.0).memory()[name])


def test_pyvista_reads_every_step_of_every_view(run: Any) -> None:
    pyvista = pytest.importorskip("pyvista")
    _, path, records = run
    archive = open_archive(path)
    for name in archive.blocks:
        reader = pyvista.get_reader(path.with_name(f"run.{name}.vtkhdf"))
        for step in range(4):
            reader.reader.SetStep(step)
            reader.reader.Update()
            grid = pyvista.wrap(reader.reader.GetOutputDataObject(0))
            block = archive.block(name)
            np.testing.assert_array_equal(grid.points, block.points.astype(grid.points.dtype))
            np.testing.assert_array_equal(grid.cells_dict[block.cell_type], block.cells)
            for field in block.fields:
                np.testing.assert_array_equal(grid.point_data[field], block.field(field, step))
            assert grid.field_data["stretch"] == records[step].scalars["stretch"]
            assert grid.field_data["factor_field"] == records[step].factor_field


@pytest.mark.parametrize("reduction", REDUCTIONS)
def test_a_run_that_changes_its_mesh(reduction: str, tmp_path: Path) -> None:
    """Two steps on one mesh, two on a finer one, one on a coarser: each comes back on its own, also for viewers."""
    pyvista = pytest.importorskip("pyvista")
    path, meshes = tmp_path / "run.vtkhdf", [Problem(reduction, size) for size in (0.9, 0.7, 1.2)]
    steps = [record(number, 5) for number in range(1, 6)]
    on = [meshes[k] for k in (0, 0, 1, 1, 2)]
    recorder = Recorder(path)
    recorder.started(on[0])
    for number, (one, problem) in enumerate(zip(steps, on, strict=True)):
        if number and problem is not on[number - 1]:
            recorder.remeshed(problem)
        recorder.accepted(State(problem, one.factor_field), one)
    recorder.finished(solution(steps))
    for again in (False, True):
        if again:
            assert repair(path) == 5
        archive = open_archive(path)
        archive.verify()
        assert archive.steps == tuple(steps)
        for name in archive.blocks:
            reader = pyvista.get_reader(path.with_name(f"run.{name}.vtkhdf"))
            for step, problem in enumerate(on):
                block = archive.block(name, step)
                known = LagrangeBlock(problem.mesh, problem.blocks[name].region, 2, True, problem.embed)
                np.testing.assert_array_equal(block.points, known.points)
                np.testing.assert_array_equal(block.cells, known.cells)
                reader.reader.SetStep(step)
                reader.reader.Update()
                grid = pyvista.wrap(reader.reader.GetOutputDataObject(0))
                np.testing.assert_array_equal(grid.cells_dict[block.cell_type], block.cells)
                for field in State(problem, steps[step].factor_field).fields():
                    if field.block == name:
                        values = block.field(field.name)
                        assert len(values) == len(known.points)
                        np.testing.assert_array_equal(grid.point_data[field.name], values)
    np.testing.assert_array_equal(archive.checkpoint()["phi"], State(on[-1], 1.0).memory()["phi"])
    with pytest.raises(ArchiveError, match=r"step 0 has another mesh: ask for block\('outside', 0\)"):
        archive.block("outside").field("phi", 0)


def test_every_array_has_a_unit(run: Any) -> None:
    _, path, _ = run
    bare = []

    def visit(name: str, item: Any) -> None:
        counters = ("NumberOf", "committed", "length", "digest", "extent", "scene", "plan", "scales", "versions", "run")
        known = any(name.rsplit("/")[-1].startswith(one) for one in counters)
        if isinstance(item, h5py.Dataset) and not known and "unit" not in item.attrs:
            bare.append(name)

    with h5py.File(path) as file:
        file.visititems(visit)
    assert bare == []


def test_every_axis_of_what_grows_has_a_name_and_a_scale(run: Any) -> None:
    """For readers without this package: what a row of a table is, and its number."""
    _, path, records = run
    with h5py.File(path) as file:
        for place, label in (("steps", "step"), ("scalars", "step"), ("newton", "Newton iteration")):
            for name, dataset in file[f"embedding/{place}"].items():
                assert dataset.dims[0].label == label
                if name != "number":
                    (scale,) = dataset.dims[0].values()
                    assert scale.name == f"/embedding/{'newton' if place == 'newton' else 'steps'}/number"
        steps = file["embedding/scalars/stretch"].dims[0][0]
        assert steps[:4].tolist() == [record.number for record in records]
        for block in file["VTKHDF/Assembly/Scene"]:
            for dataset in file["VTKHDF"][block]["PointData"].values():
                assert [axis.label for axis in dataset.dims][0] == "node, step after step"


def test_a_repaired_archive_is_the_same(run: Any, tmp_path: Path) -> None:
    problem, path, records = run
    copy = tmp_path / "run.vtkhdf"
    copy.write_bytes(path.read_bytes())
    assert repair(copy) == 4
    old, new = open_archive(path), open_archive(copy)
    assert new.steps == old.steps and new.result == old.result and new.scene == old.scene
    for name in old.blocks:
        for field in old.block(name).fields:
            np.testing.assert_array_equal(new.block(name).field(field, 2), old.block(name).field(field, 2))
    new.verify()
    assert copy.stat().st_size < 1.2 * path.stat().st_size
    with h5py.File(copy) as file:
        axis = file["embedding/scalars/stretch"].dims[0]
        assert axis.label == "step" and axis[0][:].tolist() == [1, 2, 3, 4]


def test_a_running_archive_can_be_read_and_held_open(tmp_path: Path) -> None:
    problem, path = Problem("axisymmetric", 1.0), tmp_path / "run.vtkhdf"
    recorder = Recorder(path)
    recorder.started(problem)
    assert not path.exists()
    recorder.accepted(State(problem, 0.5), record(1, 2))
    archive = open_archive(path)
    assert (len(archive), archive.result.name, archive.error, archive.cost) == (1, "unfinished", None, None)
    hold = "import h5py, sys; f = h5py.File(sys.argv[1]); print('held', flush=True); sys.stdin.read()"
    command = [sys.executable, "-c", hold, str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as viewer:
        assert viewer.stdout is not None
        assert viewer.stdout.readline() == b"held\n"
        recorder.accepted(State(problem, 1.0), record(2, 2))
        viewer.communicate()
    assert len(archive) == 1
    assert archive.refresh() == len(archive) == len(archive.steps) == 2
    recorder.finished(solution([]))
    archive.refresh()
    assert archive.result.name == "CONVERGED"


def test_a_failure_is_recorded_with_its_steps(tmp_path: Path) -> None:
    path = tmp_path / "run.vtkhdf"
    tell(Recorder(path), Problem("axisymmetric", 1.0), steps=2, result="PULL_IN")
    archive = open_archive(path)
    assert (len(archive), archive.result.name) == (2, "PULL_IN")


def test_a_failed_first_step_never_touches_an_older_archive(tmp_path: Path) -> None:
    problem, path = Problem("axisymmetric", 1.0), tmp_path / "run.vtkhdf"
    first = Recorder(path)
    tell(first, problem, steps=0, result="STEP_BELOW_MINIMUM")
    assert first.path == path
    archive = open_archive(path)
    assert (len(archive), archive.result.name, archive.steps) == (0, "STEP_BELOW_MINIMUM", ())
    assert archive.scalars == {} and archive.block("shell").fields == ()
    with pytest.raises(ArchiveError, match="no step -1; 0 steps"):
        archive.newton()
    tell(Recorder(path), problem, steps=2)
    before = path.read_bytes()
    again = Recorder(path)
    tell(again, problem, steps=0, result="PULL_IN")
    assert path.read_bytes() == before
    assert again.path == tmp_path / "run.failed.vtkhdf"
    assert open_archive(again.path).result.name == "PULL_IN"


def test_views_of_an_older_archive_disappear(tmp_path: Path) -> None:
    path = tmp_path / "run.vtkhdf"
    problem = Problem("axisymmetric", 1.0)
    tell(Recorder(path), problem, steps=1)
    (tmp_path / "run.notes.vtkhdf").write_text("mine")
    del problem.blocks["outside"], problem.blocks["inside"]
    tell(Recorder(path), problem, steps=1)
    names = sorted(one.name for one in tmp_path.iterdir())
    assert names == ["run.notes.vtkhdf", "run.shell.vtkhdf", "run.vtkhdf"]


def test_two_runs_never_mix_in_one_file(tmp_path: Path) -> None:
    problem, path = Problem("axisymmetric", 1.0), tmp_path / "run.vtkhdf"
    one, other = Recorder(path), Recorder(path)
    for recorder in (one, other):
        recorder.started(problem)
        recorder.accepted(State(problem, 0.5), record(1, 2))
    with pytest.raises(ArchiveError, match="another run has replaced"):
        one.accepted(State(problem, 1.0), record(2, 2))
    other.accepted(State(problem, 1.0), record(2, 2))
    assert len(open_archive(path)) == 2


def test_a_step_that_brings_something_new_is_refused(tmp_path: Path) -> None:
    problem, path = Problem("axisymmetric", 1.0), tmp_path / "run.vtkhdf"
    recorder = Recorder(path)
    recorder.started(problem)
    recorder.accepted(State(problem, 0.5), record(1, 2))
    late = record(2, 2)
    late.scalars["surprise"] = 1.0
    with pytest.raises(ArchiveError, match="brings 'surprise'"):
        recorder.accepted(State(problem, 1.0), late)
    assert len(open_archive(path)) == 1


def test_steps_are_counted_like_a_sequence(run: Any) -> None:
    _, path, _ = run
    archive = open_archive(path)
    np.testing.assert_array_equal(archive.block("shell").field("u", -4), archive.block("shell").field("u", 0))
    for step in (4, -5):
        with pytest.raises(ArchiveError, match="4 steps are committed"):
            archive.block("shell").field("u", step)
    with pytest.raises(ArchiveError, match=r"only the last step \(3\)"):
        archive.checkpoint(0)
    with pytest.raises(ArchiveError, match="no block 'air'; there are shell, outside, inside"):
        archive.block("air")
    with pytest.raises(ArchiveError, match="no field 'H'; there are u, phi, E"):
        archive.block("outside").field("H")


def test_a_listener_that_was_never_started_does_nothing(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path / "run.vtkhdf")
    recorder.finished(solution([]))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("target", "reason"), [(".", "is a folder"), ("none/run.vtkhdf", "does not exist")])
def test_a_target_that_cannot_be_written_is_told_before_the_solve(
    tmp_path: Path, target: str, reason: str
) -> None:
    with pytest.raises(ArchiveError, match=reason):
        Recorder(tmp_path / target)


def damaged(path: Path, how: str) -> None:
    """Spoil an archive."""
    content = path.read_bytes()
    if how == "missing":
        path.unlink()
    elif how == "empty":
        path.write_bytes(b"")
    elif how == "text":
        path.write_text("scene")
    elif how.startswith("cut"):
        path.write_bytes(content[: int(len(content) * float(how[4:]))])
    elif how == "foreign":
        with h5py.File(path, "w") as file:
            file["x"] = 1.0
    elif how == "newer":
        with h5py.File(path, "r+") as file:
            file["embedding"].attrs["schema"] = 99


@pytest.mark.parametrize(
    ("how", "reason"),
    [
        ("missing", "no such archive"),
        ("empty", "is empty"),
        ("text", "is not an HDF5 file"),
        ("cut 0.99", "truncated"),
        ("cut 0.5", "truncated"),
        ("cut 0.001", "truncated|damaged"),
        ("foreign", "not an archive of embedding"),
        ("newer", "has layout 99"),
    ],
)
def test_an_unreadable_archive_is_named_with_its_reason(tmp_path: Path, how: str, reason: str) -> None:
    path = tmp_path / "run.vtkhdf"
    tell(Recorder(path), Problem("axisymmetric", 1.0), steps=1)
    damaged(path, how)
    with pytest.raises(ArchiveError, match=f"run.vtkhdf: .*({reason})"):
        open_archive(path)


def test_a_view_file_and_a_folder_are_no_archives(tmp_path: Path) -> None:
    path = tmp_path / "run.vtkhdf"
    tell(Recorder(path), Problem("axisymmetric", 1.0), steps=1)
    with pytest.raises(ArchiveError, match="view file of run.vtkhdf, open that"):
        open_archive(tmp_path / "run.shell.vtkhdf")
    with pytest.raises(ArchiveError, match="is a folder"):
        open_archive(tmp_path)


def test_a_flipped_bit_is_noticed(tmp_path: Path) -> None:
    path = tmp_path / "run.vtkhdf"
    tell(Recorder(path), Problem("axisymmetric", 1.0), steps=2)
    block = open_archive(path).block("outside")
    chunk = block.field("phi", 1).tobytes()
    content = bytearray(path.read_bytes())
    place = content.index(chunk)
    content[place + 5] ^= 4
    path.write_bytes(content)
    archive = open_archive(path)
    archive.block("outside").field("phi", 0)
    with pytest.raises(ArchiveError, match="damaged"):
        archive.block("outside").field("phi", 1)
    with pytest.raises(ArchiveError, match="damaged"):
        archive.verify()


def test_numbers_of_numpy_may_be_in_the_end_of_a_run(tmp_path: Path) -> None:
    path = tmp_path / "run.vtkhdf"
    recorder, problem = Recorder(path, order=1), Problem("axisymmetric", 1.0)
    recorder.started(problem)
    one = record(1, 1)
    recorder.accepted(State(problem, 1.0), one)
    ended = solution([one])
    ended.cost.unknowns["all"] = np.int64(7)
    ended.cost.parts["assembly"] = np.float64("nan")
    recorder.finished(ended)
    cost = open_archive(path).cost
    assert cost is not None and cost.unknowns["all"] == 7 and np.isnan(cost.parts["assembly"])
    assert open_archive(path).block("shell").order == 1
    assert json.dumps(cost.unknowns)


def test_sampling_a_plain_number_works() -> None:
    from embedding.archive.lagrange import LagrangeBlock

    problem = Problem("axisymmetric", 1.0)
    block = LagrangeBlock(problem.mesh, problem.mesh.Materials("inside"), 3, True, problem.embed)
    np.testing.assert_allclose(block.sample(CF(2.0)), 2.0)
