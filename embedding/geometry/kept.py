"""The last meshes are kept: who solves the same shape again, at another voltage or order say, need not wait for its
mesh.

Nor does memory grow with every solve then: Netgen remembers the names of each geometry that it ever meshed.
"""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import replace

from ngsolve import Mesh

from embedding.geometry import meshing
from embedding.geometry.meshing import Meshed
from embedding.geometry.reduction import Reduction
from embedding.geometry.sizes import MeshSizes
from embedding.scene import Shape, SurfaceFile

MOST, LARGEST = 4, 50_000
"""How many meshes are kept, and of how many elements at most: some ten megabytes each, of any order."""

Key = tuple[Shape, Reduction, MeshSizes]
_kept: OrderedDict[Key, Meshed] = OrderedDict()


def mesh(shape: Shape, reduction: Reduction, sizes: MeshSizes) -> Meshed:
    """As :func:`meshing.mesh`, and the same to the last bit if it has been made before; a mesh of its own in any case.

    Raises:
        As :func:`meshing.mesh`.
    """
    if isinstance(shape, SurfaceFile):  # what is in the file may have changed
        return meshing.mesh(shape, reduction, sizes)
    key = (shape, reduction, replace(sizes, order=1))  # elements are straight until they are curved to their order
    made = _kept.pop(key, None) or meshing.mesh(shape, reduction, sizes)
    if made.mesh.ne > LARGEST:
        return made
    _kept[key] = made
    if len(_kept) > MOST:
        _kept.popitem(last=False)
    return replace(made, mesh=Mesh(made.mesh.ngmesh.Copy()))
