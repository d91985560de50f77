"""Reading an archive: what was asked, what came out, step by step."""

from __future__ import annotations

import os
from functools import cached_property
from pathlib import Path
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from embedding.archive.arrays import noted
from embedding.archive.digests import damaged_rows, digest_of, record_digest, slot_digest
from embedding.archive.documents import document
from embedding.archive.file import reading
from embedding.archive.lagrange import CELL_TYPES, lagrange_nodes
from embedding.archive.layout import (
    NEWTON_COLUMNS,
    PLACES,
    SLOTS,
    STEP_COLUMNS,
    count_of,
    mesh_of,
    part_of,
    table,
)
from embedding.archive.memory import unpacked
from embedding.archive.records import (
    UNFINISHED,
    ArchivedCost,
    ArchivedDecision,
    ArchivedError,
    ArchivedPlan,
    ArchivedResult,
    Newton,
)
from embedding.archive.verification import verify
from embedding.errors import ArchiveError
from embedding.scene import Scales, Scene
from embedding.scene.toml_io import read_table
from embedding.solving.events import Iteration, StepRecord
from embedding.solving.solution import Assumption, Check, CriticalPoint

__all__ = [
    "Archive",
    "ArchivedBlock",
    "ArchivedCost",
    "ArchivedDecision",
    "ArchivedError",
    "ArchivedPlan",
    "ArchivedResult",
    "Newton",
    "open_archive",
]

Floats = npt.NDArray[np.float64]
HIGHEST = 10
"""Order of Lagrange cells."""


def open_archive(path: str | os.PathLike[str]) -> Archive:
    """The archive at ``path``. Between calls the file is closed, so an archive may be read while its run is
    at work.

    Raises ArchiveError, naming the path and what is wrong: missing, not HDF5, truncated, damaged, or not an
    archive.
    """
    archive = Archive(Path(path))
    archive.refresh()
    return archive


class Archive:
    """What a run recorded. Steps are counted from 0, and from the last with -1, as in Python's sequences.

    Every access raises ArchiveError if the file has become unreadable or the part that is asked for is
    damaged.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._committed = 0
        self._rows_hold = self._record_holds = False

    def refresh(self) -> int:
        """Look for steps committed since the archive was opened; returns how many there are now."""
        with reading(self.path) as file:
            self._committed = count_of(file["embedding/committed"])
            if self._committed > len(file["embedding/steps/rows_digest"]):
                raise ValueError(f"{self._committed} steps, and rows of fewer")
        self._rows_hold = False
        for name in ("steps", "scalars", "_end"):
            self.__dict__.pop(name, None)
        return self._committed

    def __len__(self) -> int:
        """Number of committed steps."""
        return self._committed

    @cached_property
    def scene(self) -> str:
        """The scene as TOML."""
        return self._text("scene")

    def scene_object(self) -> Scene:
        """The scene, ready to be solved again. Raises SceneError if this version no longer accepts it."""
        return Scene.from_toml(self.scene, source=str(self.path))

    def scene_table(self) -> dict[str, Any]:
        """The scene as nested tables, also one that this version no longer accepts; it has ``shell.thickness`` and
        ``shell.shape.kind``. Raises ArchiveError or SceneError if it is no scene."""
        table = read_table(self.scene, str(self.path))
        try:
            str(table["shell"]["thickness"]), str(table["shell"]["shape"]["kind"])
        except (KeyError, TypeError) as error:
            raise ArchiveError(f"{self.path}: the archive is damaged: its scene has no shell") from error
        return table

    @cached_property
    def plan(self) -> ArchivedPlan:
        """Decisions of the plan."""
        plan = self._json("plan")
        return ArchivedPlan(plan["decisions"], plan["text"])

    @cached_property
    def scales(self) -> Scales:
        """The scales of the run."""
        return cast(Scales, self._json("scales"))

    @cached_property
    def versions(self) -> dict[str, str]:
        """Versions of the packages, of Python and of the platform that made the numbers."""
        return cast(dict[str, str], self._json("versions"))

    @cached_property
    def run(self) -> dict[str, Any]:
        """``name`` of the scene, ``reduction``, ``mirrors`` (names of the symmetry planes), ``odd_mirrors``
        (those across which the potential changes sign) and ``started`` (ISO time)."""
        return cast(dict[str, Any], self._json("run"))

    @property
    def result(self) -> ArchivedResult:
        """How the run ended; its name is "unfinished" as long as it has not."""
        return cast(ArchivedResult, self._end.get("result", UNFINISHED))

    @property
    def error(self) -> ArchivedError | None:
        """The estimated error of the answer, if the run has ended with one."""
        return self._end.get("error")

    @property
    def errors(self) -> dict[str, ArchivedError]:
        """The estimated error of every scalar of the last step, if the run has ended with them."""
        return dict(self._end.get("errors", {}))

    @property
    def assumptions(self) -> tuple[Assumption, ...]:
        """What the plan left out, checked on the last step, known once the run has ended."""
        return tuple(self._end.get("assumptions", ()))

    @property
    def health(self) -> tuple[Check, ...]:
        """Whether mesh and equations were fit to give an answer, known once the run has ended well."""
        return tuple(self._end.get("health", ()))

    @property
    def cost(self) -> ArchivedCost | None:
        """What the run cost, if it has ended."""
        return self._end.get("cost")

    @property
    def cuts(self) -> tuple[dict[str, Any], ...]:
        """Steps that failed and were retried shorter (``step``, ``fraction``, ``reason``), known once the
        run has ended."""
        return tuple(self._end.get("cuts", ()))

    @property
    def start(self) -> str:
        """Where the run began: "rest", "neighbour" for the state of another run, or "rest: ..." and why it was not
        that, known once the run has ended."""
        return str(self._end.get("start", "rest"))

    @property
    def critical_points(self) -> tuple[CriticalPoint, ...]:
        """Limit and bifurcation points that the path went through, known once the run has ended."""
        found = self._end.get("critical_points", ())
        return tuple(CriticalPoint(**{**point, "mode": np.array(point["mode"])}) for point in found)

    @cached_property
    def steps(self) -> tuple[StepRecord, ...]:
        """The records of all committed steps, as the solver gave them."""
        self._check_rows()
        with reading(self.path) as file:
            group = file["embedding/steps"]
            table = {name: group[name][: self._committed] for name in STEP_COLUMNS}
            ends = table.pop("newton_end").tolist()
            rows = ends[-1] if ends else 0
            newton = [file["embedding/newton"][name][:rows].tolist() for name in NEWTON_COLUMNS]
            columns = {name: column.tolist() for name, column in table.items()}
            columns["stage"] = [stage.decode() for stage in columns["stage"]]
        iterations = [Iteration(*row) for row in zip(*newton, strict=True)]
        own = [name for name in self.scalars if name not in columns]
        return tuple(
            StepRecord(
                **{name: column[step] for name, column in columns.items()},
                iterations=tuple(iterations[ends[step - 1] if step else 0 : ends[step]]),
                scalars={name: float(self.scalars[name][step]) for name in own},
            )
            for step in range(self._committed)
        )

    @cached_property
    def scalars(self) -> dict[str, Floats]:
        """Every scalar over the steps, in SI units, and the load factors ``factor_mechanical`` and
        ``factor_field``."""
        self._check_rows()
        with reading(self.path) as file:
            group = file["embedding/scalars"]
            return {name: column[: self._committed, 0] for name, column in group.items()}

    @cached_property
    def scalar_units(self) -> dict[str, str]:
        """SI unit of every scalar."""
        self._check_record()
        with reading(self.path) as file:
            return {name: noted(column, "unit") for name, column in file["embedding/scalars"].items()}

    def newton(self, step: int = -1) -> Newton:
        """All Newton iterations of a step."""
        rows = self.steps[self.index(step)].iterations
        columns = {name: np.array([getattr(row, name) for row in rows]) for name in NEWTON_COLUMNS}
        return Newton(**columns)

    def checkpoint(self, step: int = -1) -> dict[str, Any]:
        """What a run goes on from after the last committed step; no other step keeps it. A table of numbers, texts,
        lists, tables and arrays: ``["system"]["unknowns"]`` are the degrees of freedom, ``["system"]["ranges"]`` says
        which are whose."""
        last = len(self) - 1
        if self.index(step) != last:
            raise ArchiveError(f"{self.path}: only the last step ({last}) has a checkpoint, not step {step}")
        with reading(self.path) as file:
            slot = file["embedding/checkpoint"][SLOTS[len(self) % 2]]
            number, text, numbers = slot["extent"][...].tolist()
            if number != len(self) or not np.array_equal(slot_digest(slot), slot["digest"][...]):
                raise ArchiveError(f"{self.path}: the archive is damaged: the checkpoint of step {len(self)}")
            return cast(dict[str, Any], unpacked(slot["text"][:text].tobytes().decode(), slot["numbers"][:numbers]))

    def origins(self) -> list[dict[str, Any]]:
        """The states around which the space was meshed anew, in their order, as tables like :meth:`checkpoint`."""
        self._check_record()
        with reading(self.path) as file:
            groups = [file["embedding/origins"][str(k + 1)] for k in range(len(file["embedding/origins"]))]
            return [unpacked(one["text"][...].tobytes().decode(), one["numbers"][...]) for one in groups]

    @cached_property
    def blocks(self) -> tuple[str, ...]:
        """Names of the blocks: "shell", and with a field "outside" and "inside"."""
        self._check_record()
        with reading(self.path) as file:
            return tuple(file["VTKHDF/Assembly/Scene"])

    def block(self, name: str, step: int = -1) -> ArchivedBlock:
        """The block called ``name``, with the mesh of a ``step``: a run may change it. Raises ArchiveError, listing the
        blocks there are."""
        if name not in self.blocks:
            raise ArchiveError(f"{self.path}: no block {name!r}; there are {', '.join(self.blocks)}")
        return ArchivedBlock(self, name, self.index(step) if len(self) else None)

    def verify(self) -> None:
        """Compare everything that counts with its checksums. Raises ArchiveError naming what is damaged, and what can
        be saved; see :func:`embedding.archive.verify` for a report."""
        found = verify(self.path)
        if not found.sound:
            raise ArchiveError(found.message)

    def _check_rows(self) -> None:
        """Compare the rows of all steps with their digests, once. Raises ArchiveError."""
        if self._rows_hold:
            return
        with reading(self.path) as file:
            damaged = damaged_rows(file["embedding"], self._committed)
        if damaged:
            listed = ", ".join(map(str, damaged))
            raise ArchiveError(f"{self.path}: the archive is damaged: rows of step {listed}; see embedding verify")
        self._rows_hold = True

    def _check_record(self) -> None:
        """Compare documents and meshes with their digest, once. Raises ArchiveError."""
        if self._record_holds:
            return
        with reading(self.path) as file:
            holds = np.array_equal(record_digest(file), file["embedding/digest"][...])
        if not holds:
            raise ArchiveError(f"{self.path}: the archive is damaged: its documents or meshes; see embedding verify")
        self._record_holds = True

    def index(self, step: int) -> int:
        """``step`` as a number from 0 on. Raises ArchiveError if there is no such step."""
        count = len(self)
        if not -count <= step < count:
            raise ArchiveError(f"{self.path}: no step {step}; {count} steps are committed")
        return step % count

    @cached_property
    def _end(self) -> dict[str, Any]:
        with reading(self.path) as file:
            finish = file["embedding/finish"]
            data = finish["json"][: count_of(finish["length"])]
            if len(data) and not np.array_equal(digest_of(data), finish["digest"][...]):
                raise ArchiveError(f"{self.path}: the archive is damaged: how the run ended")
            return cast(dict[str, Any], document("finish", data.tobytes())) if len(data) else {}

    def _text(self, name: str) -> str:
        self._check_record()
        with reading(self.path) as file:
            return bytes(file["embedding"][name][()]).decode()

    def _json(self, name: str) -> Any:
        text = self._text(name)
        with reading(self.path):
            return document(name, text)


class ArchivedBlock:
    """One part of the mesh as VTK Lagrange cells, as it is at ``step`` (None: nothing is committed), with its fields at
    every committed step on that mesh."""

    def __init__(self, archive: Archive, name: str, step: int | None) -> None:
        self.archive, self.name, self.step = archive, name, -1 if step is None else step
        archive._check_record()
        archive._check_rows()
        with reading(archive.path) as file:
            group = file["VTKHDF"][name]
            first = dict.fromkeys(PLACES, 0) if step is None else mesh_of(group, step)
            self._part = first["Part"]
            counts = {place: int(group[f"NumberOf{place}s"][self._part]) for place in PLACES[1:]}
            rows = {place: slice(first[place], first[place] + counts[place]) for place in PLACES[1:]}
            self.order = int(group.attrs["order"])
            self.points: Floats = group["Points"][rows["Point"]]
            self.cell_type = int(group["Types"][0])
            nodes = int(group["Offsets"][1])
            self.cells: npt.NDArray[np.int64] = group["Connectivity"][rows["ConnectivityId"]].reshape(-1, nodes)
            data = group.get("PointData", {})
            self.units: dict[str, str] = {field: noted(column, "unit") for field, column in data.items()}
            self._check_mesh(counts["Point"])

    def _check_mesh(self, points: int) -> None:
        """Raises ValueError if the mesh is none."""
        dimension = next((d for d, kind in CELL_TYPES.items() if kind == self.cell_type), 0)
        nodes = len(lagrange_nodes(dimension, self.order)) if dimension and 1 <= self.order <= HIGHEST else 0
        if self.points.shape != (points, 3) or self.cells.shape[1] != nodes:
            raise ValueError(f"{self.name} has no mesh of points and Lagrange cells")
        if self.cells.size and not 0 <= self.cells.min() <= self.cells.max() < points:
            raise ValueError(f"cells of {self.name} have points that there are not")
        corners = self.cells[:, : dimension + 1]
        if any((corners[:, a] == corners[:, b]).any() for a in range(dimension + 1) for b in range(a)):
            raise ValueError(f"cells of {self.name} have one corner twice")
        if not np.isfinite(self.points).all():
            raise ValueError(f"points of {self.name} are nowhere")

    @property
    def fields(self) -> tuple[str, ...]:
        """Names of the fields."""
        return tuple(self.units)

    def field(self, name: str, step: int | None = None) -> npt.NDArray[np.float32]:
        """Values of a field at the nodes, (n,), (n, 3), (n, 4) or (n, 9) by rows of a tensor, in its unit (``units``),
        at the block's own step or another one.

        Raises ArchiveError if there is no such field or step, listing what there is, or if the step has another mesh.
        """
        if name not in self.units:
            there = ", ".join(self.fields)
            where = f"{self.archive.path}: block {self.name!r}"
            raise ArchiveError(f"{where} has no field {name!r}; there are {there}")
        number = self.archive.index(self.step if step is None else step)
        with reading(self.archive.path) as file:
            group = file["VTKHDF"][self.name]
            if part_of(group, number) != self._part:
                raise ArchiveError(
                    f"{self.archive.path}: step {number} has another mesh: ask for block({self.name!r}, {number})"
                )
            begin, dataset = int(file["embedding/vtk"][table("Row", self.name)][number]), group["PointData"][name]
            values = dataset[begin : begin + len(self.points)]
            if len(values) != len(self.points) or values.ndim > 2 or values.size > 9 * len(values):
                raise ValueError(f"{name} of {self.name} is no field on its mesh")
            return cast(npt.NDArray[np.float32], values)
