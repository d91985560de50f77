"""The process that is measured: ``python -m embedding.bench.worker SCENE ARCHIVE REPORT BEGUN [OVERRIDE ...]``.

``BEGUN`` is when it was started, in seconds as of ``time.monotonic``; the ``REPORT`` is JSON.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import Any

from embedding.process import begin, leave, loading
from embedding.timing import Watch, part, watching


def measured(scene: str, archive: str, overrides: tuple[str, ...], watch: Watch) -> dict[str, Any]:
    """Import, read, solve and write with ``watch`` looking on; returns what became of it.

    Raises:
        SceneError: the scene cannot be read or modelled.
    """
    with watching(watch):
        with part("import"), loading():
            with part("ngsolve"):
                import ngsolve  # noqa: F401
            from embedding.api import solve
            from embedding.archive import Recorder  # noqa: F401
        with part("scene"), loading():
            from embedding.scene import load_scene

            stated = load_scene(scene, overrides)
        solution = solve(stated, archive=archive, throw=False)
    return {
        "scene": stated.name,
        "result": solution.result.name,
        "message": solution.message,
        "reduction": solution.plan.reduction.name,
        "steps": len(solution.steps),
        "iterations": solution.iterations,
        "unknowns": solution.cost.unknowns,
    }


def main(scene: str, archive: str, report: str, begun: str, *overrides: str) -> int:
    """Write the report; returns the exit code."""
    from embedding.errors import EmbeddingError

    begin()
    watch = Watch(time.monotonic)
    watch.seconds["start of Python",] = time.monotonic() - float(begun)
    try:
        told = measured(scene, archive, overrides, watch)
    except EmbeddingError as error:
        print(error, file=sys.stderr)
        return error.exit_code
    watch.charge()
    parts = [[list(names), seconds, watch.calls.get(names, 0)] for names, seconds in watch.seconds.items()]
    Path(report).write_text(json.dumps({**told, "parts": parts}))
    leave(0)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
