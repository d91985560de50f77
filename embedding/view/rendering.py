"""Can this machine draw at all? Asked in a process of its own, because without a driver the answer is a
crash."""

from __future__ import annotations

import functools
import importlib.util
import os
import subprocess
import sys
from typing import ClassVar

from embedding.errors import EmbeddingError

PROBE = (
    "import pyvista; p = pyvista.Plotter(off_screen=True); p.add_mesh(pyvista.Sphere()); "
    "p.screenshot(None, return_img=True)"
)
WINDOW = "VTK_DEFAULT_OPENGL_WINDOW"
TIME_LIMIT = 120.0


class RenderError(EmbeddingError):
    """Pictures cannot be drawn here; the message says what to install."""

    exit_code: ClassVar[int] = 2


@functools.cache
def can_render() -> bool:
    """Can three-dimensional pictures be drawn here? Takes about two seconds the first time.

    False if pyvista is not installed or no OpenGL driver answers. The probe runs in a process of its own,
    as VTK ends the process that asks it to draw without a driver.
    """
    if importlib.util.find_spec("pyvista") is None:
        return False
    prepare()
    try:
        probe = subprocess.run([sys.executable, "-c", PROBE], capture_output=True, timeout=TIME_LIMIT, check=False)
    except subprocess.TimeoutExpired:
        return False
    return probe.returncode == 0


def prepare() -> None:
    """Where there is no display, draw without asking for one."""
    if sys.platform == "linux" and not os.environ.get("DISPLAY"):
        os.environ.setdefault(WINDOW, "vtkEGLRenderWindow")


def require_packages(*names: str) -> None:
    """Raise RenderError, saying how to install them, if packages that draw are missing (default: all of them)."""
    missing = [name for name in names or ("pyvista", "matplotlib") if importlib.util.find_spec(name) is None]
    if missing:
        raise RenderError(f"pictures need {' and '.join(missing)}: pip install 'embedding[pictures]'")


def require_rendering() -> None:
    """Raise RenderError, saying what to install, if pictures cannot be drawn here."""
    require_packages()
    if not can_render():
        raise RenderError(
            "no OpenGL driver answers, so three-dimensional pictures cannot be drawn here; "
            "on Debian: apt-get install libegl1 libgl1-mesa-dri"
        )
