"""The faces of the shell: where they truly are, which way they look, and what the shell's fields are on them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive
from embedding.post.measure import Measure
from embedding.post.patches import FACES, Patch

Floats = npt.NDArray[np.float64]
SAME = 1e-6  # relative to the size of the shell: nodes that are one
OUTWARD = {"top": 1.0, "bottom": -1.0}


def half_thickness(run: Archive, shell: Patch) -> float:
    """Largest half of the deformed thickness in m; 0 where an older archive does not tell it."""
    if "thickness" in shell.block.units:
        return float(shell.block.field("thickness", shell.step).max()) / 2
    stated: Any = run.scene_table()["shell"]["thickness"]
    thickness = float(stated) if isinstance(stated, (int, float)) else 0.0
    if "thickness_stretch" in shell.block.units:
        thickness *= float(shell.block.field("thickness_stretch", shell.step).max())
    return thickness / 2


@dataclass(frozen=True)
class Face:
    """One face of the shell, as the facets of the ambient that lie on it (``patch``), or the mid-surface where nothing
    is meshed around it; ``partner`` holds the shell's node that belongs to each node of the patch's block, or -1."""

    name: str
    patch: Patch
    shell: Patch
    partner: npt.NDArray[np.int64]

    @staticmethod
    def of(run: Archive, name: str, step: int) -> Face:
        """The "top" or "bottom" face at a step."""
        shell = Patch.of(run, "shell", step)
        if FACES[name] not in run.blocks:
            return Face(name, shell, shell, np.arange(len(shell.nodes)))
        boundary = Patch.of(run, FACES[name], step).boundary
        partner = _partners(run, boundary, shell)
        return Face(name, boundary.part(np.asarray((partner[boundary.cells] >= 0).all(axis=1))), shell, partner)

    def nodal(self, field: str) -> Floats:
        """A field of the shell at the nodes of the patch's block; nan at nodes that are not on the face."""
        values = np.asarray(self.shell.block.field(field, self.shell.step), float)[self.partner]
        values[self.partner < 0] = np.nan
        return values

    def normals(self, measure: Measure) -> Floats:
        """Unit normals at the points of a ``measure`` of the patch, bottom to top, (cells, p, 3)."""
        towards = np.einsum("cpx,cpx->cp", measure.normals, measure.at_points(self.nodal("normal")))
        return np.asarray(measure.normals * np.sign(towards)[..., None])

    def traction(self, measure: Measure) -> Floats:
        """Force per deformed area of this face at the points of a ``measure``, (cells, p, 3), in Pa: of mechanical
        pressures and the field."""
        letter = self.name[0]
        pressure = measure.at_points(self.nodal(f"p_{letter}"))
        force = -OUTWARD[self.name] * pressure[..., None] * self.normals(measure)
        if f"t_{letter}" in self.shell.block.units:
            force = force + measure.at_points(self.nodal(f"t_{letter}"))
        return force

    def through(self, measure: Measure, field: str) -> Floats:
        """The part of a vector field of the patch's block that leaves the shell at the points of a ``measure``,
        (cells, p)."""
        values = measure.at_points(self.patch.block.field(field, self.patch.step))
        return np.asarray(OUTWARD[self.name] * np.einsum("cpx,cpx->cp", values, self.normals(measure)))


def _partners(run: Archive, boundary: Patch, shell: Patch) -> npt.NDArray[np.int64]:
    """The shell's node for every node of a side that lies on the face, -1 for all others.

    On the mesh that the run began with they are the same points; on a later one they are half a thickness apart along
    the normal, or less beside a rim.
    """
    from scipy.spatial import cKDTree

    count, length = len(shell.nodes), run.scales.length
    used = np.unique(boundary.cells)
    apart, number = map(np.asarray, cKDTree(shell.block.points).query(boundary.block.points[used]))
    partner = np.full(len(boundary.nodes), -1)
    same = apart <= SAME * length
    if len(np.unique(number[same])) < count:  # on a later mesh single ones may be: where the shell is held
        half = half_thickness(run, shell)
        normal = np.asarray(shell.block.field("normal", shell.step), float)
        places = np.concatenate([shell.nodes + shift * normal for shift in (0.0, half, -half)])
        apart, number = map(np.asarray, cKDTree(places).query(boundary.nodes[used]))
        same, number = apart <= max(half, SAME * length), number % count
    partner[used[same]] = number[same]
    return partner
