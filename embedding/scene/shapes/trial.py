"""Reads a STEP or BREP file in a process of its own: the geometry kernel dies of broken ones, or never comes back.

Run as ``python -P trial.py FILE``; it ends with 0 if the file can be read and measured.
"""

from __future__ import annotations

import math
import subprocess
import sys

PATIENCE = 120.0
"""Seconds for a file."""


def why_not(path: str) -> str | None:
    """Why the file at ``path`` cannot be read, in a word or two; None if it can."""
    if not sys.executable:  # of a program that Python is a part of
        return None
    command = [sys.executable, "-P", __file__, path]
    try:
        ended = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=PATIENCE, check=False)
    except subprocess.TimeoutExpired:
        return f"the geometry kernel was not done with it after {PATIENCE:g} s"
    return None if ended.returncode == 0 else "the geometry kernel fails on it"


def read(path: str) -> None:
    """Read the file and measure all of it, as those do who use it. Raises whatever the kernel raises."""
    from netgen.occ import Glue, OCCGeometry

    shape = OCCGeometry(path).shape
    faces = list(shape.faces)
    shape = Glue(faces) if len(faces) > 1 else shape
    low, high = shape.bounding_box
    masses = [one.mass for one in (*shape.faces, *shape.edges)]
    places = [
        value for corner in (low, high, *(v.p for v in shape.vertices)) for value in (corner.x, corner.y, corner.z)
    ]
    if not all(map(math.isfinite, (*masses, *places))) or min(masses, default=0.0) < 0.0:
        raise ValueError("lengths and areas that are no numbers")


if __name__ == "__main__":
    read(sys.argv[1])
