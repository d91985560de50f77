"""Dead forces at points as nodal vectors: the work of a force on a displacement is the force times its value there.

The whole body's forces act on the meshed part through their mirror images in it: the energy of the part counts for all
its copies, so the work of every force of the whole body is added. Source: theory page, "Dead and follower loads".
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from ngsolve import BND, ElementId

from embedding.geometry.domain import Domain
from embedding.geometry.places import locate
from embedding.geometry.spaces import TraceSpace
from embedding.shell.loads import MechanicalLoads


def point_load_vector(domain: Domain, trace: TraceSpace, loads: MechanicalLoads) -> npt.NDArray[np.float64]:
    """Nodal forces (trace.space.ndof,) of the point loads of ``loads`` at full strength.

    Their virtual work is the dot product with the unknowns of ``trace``; fixed unknowns carry their force, too.
    """
    blocks = np.zeros((trace.components, trace.space.ndof // trace.components))
    for place, force in loads.point_forces:
        at = locate(domain, place)
        element = ElementId(BND, at.element)
        shape = np.array(trace.scalar.GetFE(element).CalcShape(*at.local)).ravel()
        numbers = trace.in_block(trace.scalar.GetDofNrs(element))
        for component, value in enumerate(_image(domain, place, force)):
            blocks[component, numbers] += value * shape
    return blocks.ravel()


def _image(domain: Domain, place: tuple[float, ...], force: tuple[float, ...]) -> list[float]:
    """The force as it acts at the image of its place on the positive side of the mirror planes."""
    planes = domain.reduction.planes
    return [f if axis not in planes or p >= 0.0 else -f for axis, p, f in zip("xyz", place, force, strict=False)]
