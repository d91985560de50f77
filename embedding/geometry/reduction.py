"""The three dimensional reductions: one small object that the kinematics, loads and fields are written on.

A reduction knows the dimension ``d`` of its mesh, the measure that turns a mesh integral into an integral over the
body, and the stretch of the direction the mesh does not show. In ``d = 2`` the in-plane part of a tensor is 2 x 2 and
the missing direction contributes that one stretch:

==============  =============  ==================  ============================
reduction       mesh           measure             out-of-plane stretch
==============  =============  ==================  ============================
3d              x, y, z        1 per mirror copy   1 (nothing is missing)
axisymmetric    r, z (r >= 0)  2 pi r              (r + u_r) / r
plane-strain    x, y           1 per length        lambda_z, given or unknown
==============  =============  ==================  ============================
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from ngsolve import CF, specialcf, x, y, z

Name = Literal["3d", "axisymmetric", "plane-strain"]
Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Reduction:
    """A dimensional reduction and the mirror planes used with it.

    ``planes`` holds the names ("x", "y", "z") of coordinate planes through the origin about which the scene is
    mirrored; each halves what is meshed, so integrals are multiplied by ``copies``.
    """

    name: Name
    planes: tuple[str, ...] = ()

    @property
    def dimension(self) -> int:
        """Dimension of the mesh, 3 or 2."""
        return 3 if self.name == "3d" else 2

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the displacement components, in the order of the mesh's coordinates."""
        return {"3d": ("x", "y", "z"), "axisymmetric": ("r", "z"), "plane-strain": ("x", "y")}[self.name]

    @property
    def copies(self) -> int:
        """How many mirror images make up the whole body."""
        return int(2 ** len(self.planes))

    @property
    def position(self) -> Any:
        """Reference position of the mesh's points, shape (d,)."""
        return CF((x, y, z)) if self.dimension == 3 else CF((x, y))

    @property
    def normal(self) -> Any:
        """The mesh's own unit normal on boundary elements, shape (d,); its sign is not ours to trust."""
        return specialcf.normal(self.dimension)

    @property
    def measure(self) -> Any:
        """Weight of ``ds`` and ``dx`` in the reference configuration (whole body; plane strain: per unit length)."""
        return CF(2 * math.pi * x) if self.name == "axisymmetric" else CF(float(self.copies))

    def out_of_plane(self, displacement: Any, axial: Any = 1.0) -> Any:
        """Stretch of the direction the mesh does not show: hoop stretch, lambda_z, or 1 in 3D."""
        if self.name == "axisymmetric":
            return (x + displacement[0]) / x
        return axial if self.name == "plane-strain" else 1.0

    def hoop_change(self, displacement: Any) -> Any:
        """What a ``displacement`` (d,) adds to the stretch around the axis; 0 where there is none."""
        return displacement[0] / x if self.name == "axisymmetric" else CF(0.0)

    def components(self, axis: str) -> tuple[int, ...]:
        """Displacement components meant by the Cartesian ``axis`` ("x" and "y" are both radial in axisymmetry)."""
        if self.name == "axisymmetric":
            return (1,) if axis == "z" else (0,)
        return ({"x": 0, "y": 1, "z": 2}[axis],) if axis in self.axes else ()

    def project(self, vector: tuple[float, float, float]) -> tuple[float, ...]:
        """Components of a Cartesian vector that the mesh shows (axisymmetry: radial part 0, axial part z)."""
        if self.name == "axisymmetric":
            return (0.0, vector[2])
        return tuple(vector[: self.dimension])

    def embed(self, points: Array) -> Array:
        """Mesh coordinates (n, d) placed in three-dimensional space (n, 3)."""
        if self.dimension == 3:
            return points
        out = np.zeros((len(points), 3))
        out[:, 0] = points[:, 0]
        out[:, 2 if self.name == "axisymmetric" else 1] = points[:, 1]
        return out

    def rigid_motions(self) -> list[Any]:
        """Rigid motions of the whole body that the mesh can represent, as coefficient functions of shape (d,).

        A mirror plane takes away the translation across it and the rotations about the axes that lie in it: seen on the
        meshed part alone such a motion may satisfy the conditions on the plane, but its mirror image bends the body.
        """
        if self.name == "axisymmetric":
            return [CF((0, 1))]
        unit = np.eye(self.dimension)
        along = [CF(tuple(unit[i])) for i, axis in enumerate(self.axes) if axis not in self.planes]
        if self.name == "plane-strain":
            return along + ([] if self.planes else [CF((-y, x))])
        turns = {"x": CF((0, -z, y)), "y": CF((z, 0, -x)), "z": CF((-y, x, 0))}
        return along + [turn for axis, turn in turns.items() if set(self.planes) <= {axis}]

    def rotations(self) -> Array:
        """Rotation vector of each of the :meth:`rigid_motions`, shape (n, 3)."""
        if self.name == "axisymmetric":
            return np.zeros((1, 3))
        shifts = np.zeros((sum(axis not in self.planes for axis in self.axes), 3))
        if self.name == "plane-strain":
            turns = np.zeros((0, 3)) if self.planes else np.array([[0.0, 0.0, 1.0]])
        else:
            about = [i for i, axis in enumerate("xyz") if set(self.planes) <= {axis}]
            turns = np.eye(3)[about]
        return np.concatenate([shifts, turns])
