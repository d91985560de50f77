"""How large a mesh will be, before it is made: a mesh that does not fit into memory is refused while there is some."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Iterator
from pathlib import Path

from embedding.geometry.outline import CurveOutline, NoMeshError, Outline, real
from embedding.geometry.reduction import Reduction
from embedding.geometry.sizes import MeshSizes

TRIANGLE, TETRAHEDRON = math.sqrt(3) / 4, math.sqrt(2) / 12
"""Area and volume of the regular element of edge 1."""
LAYERS = 4.0
"""Rows of elements that a graded mesh has at least from a fine part into a coarse one, both sides together."""
BYTES = {2: 1e3, 3: 5e3}
"""Memory for each unknown of the potential, or of a shell alone, by the dimension of the mesh: half of what is measured
where it is least (docs/coupled_step.md), so that what is refused could not have been solved."""


class TooLargeError(NoMeshError):
    """A mesh would not fit into memory; ``field`` is what asks for it."""

    def __init__(self, field: str, reason: str) -> None:
        self.field = field
        super().__init__(reason)


def refuse_too_large(outline: Outline, reduction: Reduction, sizes: MeshSizes) -> None:
    """Refuse a mesh whose unknowns would not fit into the memory there is.

    Raises:
        TooLargeError: they do not; the text says how many there would be, and how many are possible.
    """
    parts = dict(_elements(outline, reduction, sizes))
    order = sizes.potential_order if sizes.radius else sizes.order
    dimension = reduction.dimension if sizes.radius else reduction.dimension - 1
    each = order**dimension / math.factorial(dimension)
    unknowns, free = each * sum(parts.values()), free_memory()
    possible = free / BYTES[reduction.dimension]
    if unknowns <= possible:
        return
    largest = max(parts, key=lambda field: parts[field])
    told = f"about {unknowns:.0e} unknowns or more; there is memory for {possible:.0e} at most ({free / 1e9:.3g} GB)"
    raise TooLargeError(f"discretisation.{largest}", told)


def _elements(outline: Outline, reduction: Reduction, sizes: MeshSizes) -> Iterator[tuple[str, float]]:
    """Least numbers of elements, by the size that asks for them."""
    around = bool(sizes.radius)
    if isinstance(outline, CurveOutline):
        yield "shell_size", (LAYERS if around else 1.0) * sum(edge.mass for edge in outline.edges) / sizes.shell
    else:
        area = sum(face.mass for face in outline.shape.faces) / (TRIANGLE * sizes.shell**2)
        yield "shell_size", (LAYERS if around else 1.0) * area
        edges = filter(real, outline.shape.edges)
        along = ((edge.mass, sizes.along(outline.name(edge) or edge.name or "")) for edge in edges)
        yield "edge_size", sum(length / size for length, size in along if size < sizes.shell)
    if around and reduction.dimension == 3:
        part = 2.0 ** -len(reduction.planes)
        yield "ambient_size", part * 4 / 3 * math.pi * (sizes.radius / sizes.far) ** 3 / TETRAHEDRON
    elif around:
        yield "ambient_size", 0.5 * math.pi * (sizes.radius / sizes.far) ** 2 / TRIANGLE


def free_memory() -> float:
    """Bytes that this process may still take: what the machine has left, or less where that is limited."""
    return min(_of_the_machine(), _of_the_group(), _of_the_process())


def _of_the_machine() -> float:
    try:
        lines = Path("/proc/meminfo").read_text().splitlines()
        return next(1024.0 * float(line.split()[1]) for line in lines if line.startswith("MemAvailable"))
    except (OSError, StopIteration):
        return float(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))


def _of_the_group() -> float:
    try:
        return float(Path("/sys/fs/cgroup/memory.max").read_text())
    except (OSError, ValueError):
        return math.inf


def _of_the_process() -> float:
    if sys.platform == "win32":
        return math.inf
    import resource

    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    return math.inf if limit == resource.RLIM_INFINITY else float(limit)
