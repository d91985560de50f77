"""The library's front door: solve a scene, with an archive and a progress display if wanted."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace

from embedding.errors import SolveError
from embedding.scene import Scene
from embedding.solving import Listener, Solution, run


def solve(
    scene: Scene,
    *,
    archive: str | os.PathLike[str] | None = None,
    throw: bool = True,
    progress: bool = False,
    listeners: Sequence[Listener] = (),
) -> Solution:
    """Solve ``scene`` along its path.

    With ``archive`` every accepted step is written to that HDF5 file as it is found; with ``progress`` a display on
    standard error shows load, Newton history and time. ``listeners`` are told of everything besides.

    Raises:
        SceneError: the scene cannot be modelled.
        SolveError: the path was not solved to its end; its ``solution`` holds the accepted steps, the reason and
            advice. With ``throw=False`` that solution is returned instead.
    """
    from contextlib import ExitStack

    with ExitStack() as stack:
        watching: list[Listener] = []
        recorder = None
        if archive is not None:
            from embedding.archive import Recorder

            recorder = Recorder(archive)
            watching.append(recorder)
        if progress:
            from embedding.view.progress import ProgressDisplay

            watching.append(stack.enter_context(ProgressDisplay()))
        solution = run(scene, [*watching, *listeners])
    if recorder is not None:
        solution = replace(solution, archive=recorder.path)
    if throw and not solution.result.ok:
        raise SolveError(solution.message, solution)
    return solution
