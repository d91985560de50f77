"""What an archive has for a run to go on from, and whether it may."""

from __future__ import annotations

import os
import warnings
from dataclasses import replace

from embedding.archive.reader import Archive, open_archive
from embedding.archive.recorder import versions
from embedding.archive.verification import verify
from embedding.errors import ArchiveError
from embedding.scene import Scene
from embedding.solving.events import StepRecord
from embedding.solving.memory import LAYOUT, Kept


class OtherVersionsWarning(UserWarning):
    """A run goes on with other versions of packages than it began with: not to the last bit as it would have."""


def resumable(path: str | os.PathLike[str]) -> Archive:
    """The archive at ``path``, verified as a whole, of a run that ended early after at least one accepted step.

    Warns with OtherVersionsWarning where that is so. Raises ArchiveError, saying which, if the archive is damaged, or
    its run is finished or has no step.
    """
    found = verify(path)
    if not found.sound:
        raise ArchiveError(f"{found.message}. It cannot be resumed")
    archive = open_archive(path)
    if archive.result.name == "CONVERGED":
        raise ArchiveError(f"{path}: the run is finished: there is nothing to resume")
    if not len(archive):
        raise ArchiveError(f"{path}: no step was accepted: there is nothing to resume from. Solve the scene again")
    if not found.resumable:
        raise ArchiveError(f"{path}: was saved from a damaged archive, without what a run goes on from")
    then, now = archive.versions, versions()
    changed = [f"{name} {old} then, {now.get(name)} now" for name, old in then.items() if now.get(name) != old]
    if changed:
        reason = f"{', '.join(changed)}: the run goes on, but its last digits will not be those it would have had"
        warnings.warn(f"{path}: {reason}", OtherVersionsWarning, stacklevel=3)
    return archive


def kept(archive: Archive, scene: Scene) -> Kept:
    """What is known of the run in ``archive``, whose scene is ``scene``.

    Raises:
        ArchiveError: it is the run of a version of embedding that kept something else of it.
    """
    memory = archive.checkpoint()
    if memory.get("layout") != LAYOUT:
        raise ArchiveError(
            f"{archive.path}: was written by another version of embedding: it can be read, but its run cannot go on "
            "from it. Solve the scene again"
        )
    return Kept([_whole(step, scene) for step in archive.steps], memory, archive.origins())


def _whole(step: StepRecord, scene: Scene) -> StepRecord:
    """The step with the whole name of its stage, of which the archive holds the beginning."""
    return replace(step, stage=next(stage.name for stage in scene.path if stage.name.startswith(step.stage)))
