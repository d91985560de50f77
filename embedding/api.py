"""The library's front door: solve a scene, with an archive and a progress display if wanted; go on with a run."""

from __future__ import annotations

import os
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import replace
from typing import TYPE_CHECKING

from embedding.errors import ArchiveError, SolveError
from embedding.scene import Scene
from embedding.solving import Listener, Solution, run
from embedding.solving.neighbour import Neighbour, run_from
from embedding.solving.result import Result

if TYPE_CHECKING:
    from embedding.archive import Recorder
    from embedding.solving.memory import Kept

Name = str | os.PathLike[str]


def solve(
    scene: Scene,
    *,
    archive: Name | None = None,
    resume: Name | None = None,
    start: Name | None = None,
    throw: bool = True,
    progress: bool = False,
    listeners: Sequence[Listener] = (),
) -> Solution:
    """Solve ``scene`` along its path.

    With ``archive`` every accepted step is written to that HDF5 file as it is found; with ``progress`` a display on
    standard error shows load, Newton history and time. ``listeners`` are told of everything besides. With ``resume``,
    an archive of this very scene whose run ended early, go on with that run; see :func:`resume`. With ``start``, the
    archive of a scene that differs in loads or materials, go from its last state to the end of this scene's path; where
    there is no way from there, as on another mesh, solve from rest, and ``solution.start`` says why.

    A scene that states an accuracy is solved on finer meshes and with dearer models until its error estimate meets it,
    from rest; ``solution.attempts`` tell of all solves, each of which listeners are told of and writes the archive
    anew.

    Raises:
        SceneError: the scene cannot be modelled.
        ArchiveError: the archive cannot be written, or not be resumed: it is damaged, of another scene, or its run is
            finished.
        SolveError: the path was not solved to its end; its ``solution`` holds the accepted steps, the reason and
            advice. With ``throw=False`` that solution is returned instead.
    """
    if scene.accuracy is not None and resume is None:
        return _accurate(scene, archive, start is not None, throw=throw, progress=progress, listeners=listeners)
    recorder, known = None, None
    if resume is not None:
        if archive is not None and os.path.abspath(archive) != os.path.abspath(resume):
            raise ArchiveError(f"{resume}: a run goes on in its own archive, not in {archive}")
        recorder, known = _resumed(resume, scene)
    elif archive is not None:
        from embedding.archive import Recorder

        recorder = Recorder(archive)
    neighbour = None if start is None or resume is not None else _last_state(start)
    return _solved(scene, recorder, known, neighbour, throw=throw, progress=progress, listeners=listeners)


def _accurate(
    scene: Scene, archive: Name | None, starts: bool, *, throw: bool, progress: bool, listeners: Sequence[Listener]
) -> Solution:
    from embedding.accuracy import solve_to_accuracy

    def once(attempted: Scene) -> Solution:
        recorder = None
        if archive is not None:
            from embedding.archive import Recorder

            recorder = Recorder(archive)
        return _solved(attempted, recorder, None, None, throw=False, progress=progress, listeners=listeners)

    solution = solve_to_accuracy(scene, once)
    if starts:
        solution = replace(solution, start="rest: an accuracy is asked for")
    if throw and not solution.result.ok:
        raise SolveError(solution.message, solution)
    return solution


def resume(
    archive: Name, *, throw: bool = True, progress: bool = False, listeners: Sequence[Listener] = ()
) -> Solution:
    """Go on with the run in ``archive``, which was killed, interrupted or failed, from its last accepted step.

    The scene is that in the archive, where the steps to come are written as well. On the same machine, with the same
    versions of packages and threads, everything comes out as it would have without the interruption, to the last bit;
    with other versions a warning says that it will not. Errors are those of :func:`solve`.
    """
    from embedding.archive import open_archive

    scene = open_archive(archive).scene_object()
    recorder, known = _resumed(archive, scene)
    return _solved(scene, recorder, known, None, throw=throw, progress=progress, listeners=listeners)


def _resumed(path: Name, scene: Scene) -> tuple[Recorder, Kept]:
    from embedding.archive import Recorder
    from embedding.archive.resuming import kept, resumable

    archive = resumable(path)
    if archive.scene_object() != scene:
        hint = ", as each attempt at an accuracy is: embedding resume goes on with that" if scene.accuracy else ""
        raise ArchiveError(f"{path}: is the archive of another scene{hint}: only the run of the same scene can go on")
    known = kept(archive, scene)
    return Recorder.going_on(archive), known


def _last_state(path: Name) -> Neighbour:
    from embedding.archive import open_archive
    from embedding.archive.resuming import kept

    archive = open_archive(path)
    if not len(archive):
        raise ArchiveError(f"{path}: no step was accepted: there is no state to start from")
    scene = archive.scene_object()
    return Neighbour(scene, kept(archive, scene))


def _solved(
    scene: Scene,
    recorder: Recorder | None,
    known: Kept | None,
    neighbour: Neighbour | None,
    *,
    throw: bool,
    progress: bool,
    listeners: Sequence[Listener],
) -> Solution:
    with ExitStack() as stack:
        watching: list[Listener] = [] if recorder is None else [recorder]
        if progress:
            from embedding.progress import ProgressDisplay

            watching.append(stack.enter_context(ProgressDisplay()))
        everyone = [*watching, *listeners]
        solution = run(scene, everyone, known) if neighbour is None else run_from(scene, neighbour, everyone)
    if known is not None and scene.accuracy is not None:
        from embedding.accuracy.dial import resumed

        solution = resumed(solution)
    if recorder is not None:
        solution = replace(solution, archive=recorder.path)
        if solution.result is Result.INTERRUPTED and solution.steps:
            hint = f"Go on with: embedding resume {recorder.path}"
            solution = replace(solution, message=f"{solution.message}. {hint}")
    if throw and not solution.result.ok:
        raise SolveError(solution.message, solution)
    return solution
