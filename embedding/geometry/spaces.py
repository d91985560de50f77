"""Finite element spaces whose unknowns live on the shell but whose functions reach into the ambient.

A trace space keeps just the degrees of freedom of ``VectorH1`` (or ``H1``) that lie on the shell. On the shell they
describe a surface field; the same basis functions, read in the volume, extend it into the elements that touch it.
``Compress`` loses componentwise Dirichlet flags, so the fixed unknowns are kept here as plain boolean arrays.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import EDGE, FACE, H1, VERTEX, BitArray, Compress, Mesh, NodeId, PlateauFESpace, VectorH1

Mask = npt.NDArray[np.bool_]
ON_PLANE = 1e-9


def scalar_mask(space: Any, region: Any) -> Mask:
    """Degrees of freedom of a scalar space that lie on ``region``, as a boolean array of length ``space.ndof``."""
    return as_mask(space.GetDofs(region))


def as_mask(bits: BitArray) -> Mask:
    """A ``BitArray`` as a boolean array."""
    return np.fromiter((bits[i] for i in range(len(bits))), bool, len(bits))


def as_bits(mask: Mask) -> BitArray:
    """A boolean array as a ``BitArray``."""
    return BitArray(mask.tolist())


def plane_mask(space: Any, axis: int) -> Mask:
    """Unknowns of a scalar H1 ``space`` on the coordinate plane number ``axis`` (or on the axis of revolution).

    Found from the positions of the mesh's vertices: names of edges on degenerate or glued faces cannot be trusted.
    """
    mesh: Mesh = space.mesh
    on = {v.nr: abs(v.point[axis]) < ON_PLANE for v in mesh.vertices}
    mask = np.zeros(space.ndof, bool)
    nodes = [(VERTEX, mesh.vertices), (EDGE, mesh.edges)] + ([(FACE, mesh.faces)] if mesh.dim == 3 else [])
    for kind, group in nodes:
        for node in group:
            corners = [node.nr] if kind == VERTEX else [v.nr for v in node.vertices]
            if all(on[c] for c in corners):
                mask[[d for d in space.GetDofNrs(NodeId(kind, node.nr)) if d >= 0]] = True
    return mask


class TraceSpace:
    """``VectorH1`` (or ``H1``) restricted to the unknowns on the shell, with its own book of fixed components.

    ``reach`` limits where the basis functions live besides the shell: "" in all elements that touch it, "shell"
    nowhere else, or a pattern of materials. Element matrices hold only unknowns that can matter there. The numbering
    of the unknowns does not depend on the reach, so vectors can be copied between such spaces. On each region of
    ``plateaus`` a scalar field has one value, one unknown.
    """

    def __init__(
        self, mesh: Mesh, order: int, *, vector: bool = True, reach: str = "", plateaus: Sequence[Any] = ()
    ) -> None:
        self._plateaus = list(plateaus)
        self.scalar = self._flattened(H1(mesh, order=order))
        self.components = mesh.dim if vector else 1
        self._on_shell = scalar_mask(self.scalar, mesh.Boundaries("shell"))
        self._fixed = np.zeros((self.components, self.scalar.ndof), bool)
        self.space = self.reaching(reach)

    def reaching(self, reach: str) -> Any:
        """The same space of shell unknowns with another reach."""
        mesh, order = self.scalar.mesh, self.scalar.globalorder
        limits = {"": {}, "shell": {"definedon": mesh.Boundaries("shell")}}
        limit = limits.get(reach, {"definedon": mesh.Materials(reach)})
        limited = self._flattened(H1(mesh, order=order, **limit))
        active = np.tile(scalar_mask(limited, mesh.Boundaries("shell")), self.components)
        full = limited if self.components == 1 else VectorH1(mesh, order=order, **limit)
        space = Compress(full, as_bits(active))
        if space.ndof != self.components * int(self._on_shell.sum()):
            raise RuntimeError("the trace space lost unknowns: component blocks are not where they were expected")
        return space

    def _flattened(self, space: Any) -> Any:
        return PlateauFESpace(space, self._plateaus) if self._plateaus else space

    def plateau_unknown(self, region: Any) -> int:
        """The one unknown of a scalar field on a ``region`` of the plateaus, in the numbering of ``space``."""
        return int(self.in_block(np.flatnonzero(scalar_mask(self.scalar, region))[:1].tolist())[0])

    def fix(self, component: int, mask: Mask) -> None:
        """Hold ``component`` on the unknowns of ``mask`` (length: unknowns of the scalar space)."""
        self._fixed[component] |= mask

    def fix_unknown(self, number: int) -> None:
        """Hold one unknown of a scalar field, in the numbering of ``space``."""
        self._fixed[0][np.flatnonzero(self._on_shell)[number]] = True

    def on_shell(self, mask: Mask) -> Mask:
        """A ``mask`` over the scalar space as one over the block of one component."""
        return np.asarray(mask[self._on_shell])

    def in_block(self, dofs: Sequence[int]) -> npt.NDArray[np.int64]:
        """Where unknowns of the scalar space that lie on the shell stand within the block of one component."""
        return (np.cumsum(self._on_shell) - 1)[list(dofs)]

    @property
    def free(self) -> Mask:
        """Free unknowns, in the numbering of ``space``."""
        return ~np.concatenate([fixed[self._on_shell] for fixed in self._fixed])
