"""The listener that records a solve in an archive."""

from __future__ import annotations

import importlib.metadata
import json
import os
import platform
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from embedding.archive.file import check_target
from embedding.archive.lagrange import LagrangeBlock
from embedding.archive.writer import ArchiveWriter, SampledField
from embedding.solving.events import Listener
from embedding.timing import part

if TYPE_CHECKING:
    from embedding.archive.reader import Archive
    from embedding.solving.events import Field, StepRecord
    from embedding.solving.problem import Problem
    from embedding.solving.solution import Solution
    from embedding.solving.state import State

PACKAGES = ("embedding", "ngsolve", "netgen-mesher", "numpy", "scipy", "h5py")
CONTINUOUS = frozenset({"u", "phi"})  # inside a block, so that shared nodes need no averaging


class Recorder(Listener):
    """Writes the archive of a solve at ``path``: each step as it is accepted, and at the end the result,
    cost and error.

    ``order`` of the pictured cells is that of the discretisation unless given. A solve that fails after its
    first step leaves its accepted steps and says why it failed; what becomes of an older archive at
    ``path``, and of a solve without a single accepted step, is told at ``ArchiveWriter``. ``Recorder.path``
    is where the record is.

    Raises ArchiveError, at construction already if ``path`` cannot be written.
    """

    def __init__(self, path: str | os.PathLike[str], order: int | None = None) -> None:
        self._target = check_target(path)
        self._order = order
        self._resumed: int | None = None
        self._writer: ArchiveWriter | None = None
        self._problem: Problem | None = None
        self._cuts: list[dict[str, Any]] = []

    @classmethod
    def going_on(cls, archive: Archive) -> Recorder:
        """The recorder of a run that goes on from the last step of ``archive``, in the same file."""
        recorder = cls(archive.path, archive.block(archive.blocks[0]).order)
        recorder._resumed, recorder._cuts = len(archive), list(archive.checkpoint()["cuts"])
        return recorder

    @property
    def path(self) -> Path:
        """Where the record of the run is, or will be."""
        return self._writer.path if self._writer is not None else self._target

    @part("archive")
    def started(self, problem: Problem) -> None:
        """Build the pictured blocks; nothing is written yet, but that a run which goes on takes over its archive."""
        self._problem = problem
        if self._resumed is not None:
            self._writer = ArchiveWriter.going_on(self._target, self._blocks(problem), self._resumed)
            return
        per_length = problem.reduction.name == "plane-strain"
        self._cuts = []
        self._writer = ArchiveWriter(self._target, self._blocks(problem), documents(problem), per_length)

    def _blocks(self, problem: Problem) -> dict[str, LagrangeBlock]:
        order = problem.scene.discretisation.order if self._order is None else self._order
        return {
            name: LagrangeBlock(problem.mesh, block.region, order, True, problem.embed, block.within)
            for name, block in problem.blocks.items()
        }

    @part("archive")
    def accepted(self, state: State, record: StepRecord) -> None:
        """Commit the step."""
        writer, problem = self._writer, self._problem
        if writer is not None and problem is not None:
            fields = _sampled(writer.blocks, state.fields(), problem)
            writer.append(record, fields, {**state.memory(), "cuts": self._cuts})

    @part("archive")
    def remeshed(self, problem: Problem) -> None:
        """Steps from here on are on the new mesh."""
        self._problem = problem
        if self._writer is not None:
            self._writer.remesh(self._blocks(problem), getattr(problem, "origin", None))

    def cut(self, step_number: int, fraction: float, reason: str) -> None:
        """Remember the cut; it is written with the end of the run."""
        self._cuts.append({"step": step_number, "fraction": fraction, "reason": reason})

    @part("archive")
    def finished(self, solution: Solution) -> None:
        """Write how the run ended."""
        if self._writer is None:
            return
        result = solution.result
        self._writer.finish(
            {
                "result": {"name": result.name, "advice": result.advice, "message": solution.message},
                "error": None if solution.error is None else asdict(solution.error),
                "errors": {name: asdict(error) for name, error in solution.errors.items()},
                "cost": asdict(solution.cost),
                "assumptions": [asdict(assumption) for assumption in solution.assumptions],
                "health": [asdict(check) for check in solution.health],
                "cuts": self._cuts,
                "start": solution.start,
                "critical_points": [{**vars(point), "mode": point.mode.tolist()} for point in solution.critical_points],
            }
        )


def _sampled(blocks: Mapping[str, LagrangeBlock], fields: Sequence[Field], problem: Problem) -> list[SampledField]:
    """All ``fields`` at the nodes of their blocks; a derived one from what was sampled before."""
    done: dict[tuple[str, str], SampledField] = {}
    for field in fields:
        if field.derived is None:
            values = blocks[field.block].sample(field.values, average=field.name not in CONTINUOUS)
            if values.ndim == 2 and values.shape[1] == problem.mesh.dim:
                values = np.asarray(problem.embed_vector(values))
        else:
            values = field.derived.of(done[field.block, field.derived.name].values)
        done[field.block, field.name] = SampledField(field.block, field.name, field.unit, values)
    return list(done.values())


def documents(problem: Problem) -> dict[str, str]:
    """What reproduces the run, as named texts: TOML for the scene, JSON for the rest."""
    plan = problem.plan
    data: dict[str, Any] = {
        "plan": {
            "text": plan.text(),
            "decisions": [asdict(decision) for decision in plan.decisions],
        },
        "scales": asdict(problem.scales),
        "versions": versions(),
        "run": {
            "name": problem.scene.name,
            "reduction": problem.reduction.name,
            "mirrors": list(problem.reduction.planes),
            "odd_mirrors": list(plan.odd_planes),
            "started": datetime.now(UTC).isoformat(timespec="seconds"),
        },
    }
    return {"scene": problem.scene.to_toml(), **{name: json.dumps(value) for name, value in data.items()}}


def versions() -> dict[str, str]:
    """Versions of the packages that determine the numbers, of Python and of the platform."""
    found = {"python": platform.python_version(), "platform": platform.platform()}
    for package in PACKAGES:
        try:
            found[package] = importlib.metadata.version(package)
        except importlib.metadata.PackageNotFoundError:
            found[package] = "not installed"
    return found
