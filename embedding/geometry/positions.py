"""Where the vertices of a mesh are in the reference configuration.

On a mesh that was made around a deformed shell, the shell's vertices are elsewhere in the mesh itself; see
:mod:`embedding.geometry.remeshing`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import Mesh

Floats = npt.NDArray[np.float64]


def reference_positions(mesh: Mesh) -> Floats:
    """Positions (vertices, d) of all vertices."""
    places = np.array([vertex.point for vertex in mesh.vertices], dtype=np.float64)
    return places if mesh.deformation is None else places + _moved(mesh)[:, : mesh.nv].T


def reference_position(mesh: Mesh, vertex: Any) -> Floats:
    """Position (d,) of one vertex."""
    place = np.array(mesh[vertex].point, dtype=np.float64)
    return place if mesh.deformation is None else place + _moved(mesh)[:, vertex.nr]


def _moved(mesh: Mesh) -> Any:
    """Unknowns (d, n) of the mesh's deformation; the first ones of each component are values at vertices."""
    return mesh.deformation.vec.FV().NumPy().reshape(mesh.dim, -1)
