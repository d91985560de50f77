"""The command line in a process of its own, to which things happen."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from tests.archive.resumed import ROOT

SETS = ("discretisation.order=1", "discretisation.shell_size=15 mm", "path.0.steps=6")
SCENE = str(ROOT / "problems" / "charged_balloon.toml")


def words(archive: Path, *sets: str, scene: str = SCENE) -> list[str]:
    """Of ``embedding run`` on a small balloon in a field, or another ``scene``."""
    changes = [word for one in (*SETS, *sets) for word in ("--set", one)]
    return ["run", scene, "--out", str(archive), "--no-progress", *changes]


def begun(
    command: list[str], folder: Path, before: Callable[[], None] | None = None, **environment: str
) -> subprocess.Popen[str]:
    """``embedding COMMAND`` in ``folder``; ``before`` it, something is done in its process."""
    return subprocess.Popen(
        [sys.executable, "-m", "embedding.cli", *command],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1", **environment},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=before,
    )


def ended(command: list[str], folder: Path, before: Callable[[], None] | None = None) -> tuple[int, str, str]:
    """Its exit code, and what it printed."""
    process = begun(command, folder, before)
    out, err = process.communicate(timeout=600)
    return process.returncode, out, err


def limited(kind: int, size: int) -> Callable[[], None]:
    """A limit of the system, such as ``resource.RLIMIT_FSIZE``, for a process that is about to begin."""
    return lambda: resource.setrlimit(kind, (size, resource.getrlimit(kind)[1]))
