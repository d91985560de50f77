"""What a run goes on from after an accepted step, as plain numbers, texts and arrays that a file can hold.

Every part of a run that remembers anything - the system with its ambient, the way a stage is followed, the session
itself - has a ``memory()``, and a part that was just made and is given that memory goes on from there to the last bit,
on the same machine with the same number of threads. What can be computed again from it is not in it. This module turns
the small records that such memories share into tables and back.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from embedding.coupling.system import Memory
from embedding.solving.continuation import Direction
from embedding.solving.curve import Point
from embedding.solving.events import StepRecord
from embedding.solving.path import Target
from embedding.solving.solution import CriticalPoint

__all__ = ["Kept", "Memory"]

LAYOUT = 2
"""Number of what is in a memory, raised with every change: a run that was stopped goes on with the same one alone."""


@dataclass(frozen=True)
class Kept:
    """What is known of a run that ended early: its ``steps``, the ``memory`` of the last one, and the states around
    which the ambient was meshed anew (see ``Remeshed.origin``)."""

    steps: Sequence[StepRecord]
    memory: Memory
    origins: Sequence[Memory]


def of_target(target: Target) -> Memory:
    """A load as a table."""
    return asdict(target)


def of_point(point: Point) -> Memory:
    """A point of a path as a table, without the state that goes with it."""
    tangent = point.tangent
    return {
        "values": point.values,
        "parameter": point.parameter,
        "place": point.place,
        "tangent": None if tangent is None else {"values": tangent.values, "parameter": tangent.parameter},
        "unstable": point.unstable,
    }


def point_of(memory: Memory, saved: Any) -> Point:
    """The point again, with the state ``saved`` that goes with it."""
    tangent = memory["tangent"]
    return Point(**memory | {"tangent": None if tangent is None else Direction(**tangent), "saved": saved})


def of_critical(point: CriticalPoint) -> Memory:
    """A critical point as a table."""
    return vars(point) | {"unstable": list(point.unstable)}


def critical_of(memory: Memory) -> CriticalPoint:
    """The critical point again."""
    return CriticalPoint(**memory | {"unstable": tuple(memory["unstable"])})


def mesh_digest(mesh: Any) -> str:
    """Digest of the places of a mesh's vertices and of its elements: two meshes with the same one are the same."""
    digest, generated = hashlib.sha256(), mesh.ngmesh
    digest.update(np.ascontiguousarray(generated.Coordinates()).tobytes())
    for elements in (generated.Elements1D(), generated.Elements2D(), generated.Elements3D()):
        digest.update(np.ascontiguousarray(elements.NumPy()["nodes"]).tobytes())
    return digest.hexdigest()
