"""An applied field that varies or circulates: the potential is then only that of the field's change.

With h = h_0(x) - grad phi the co-energy of free space is, for div h_0 = 0,

    int 1/2 |h|^2 dx = int 1/2 |grad phi|^2 dx + int 1/2 |h_0|^2 dx
                       + int_top phi_t h_0 . n da - int_bottom phi_b h_0 . n da,

the mixed part having been integrated by parts up to the faces of the shell; at infinity it vanishes. So the sources of
h_0, a line current for one, may pass anywhere but through the shell and the elements that touch it, and h_0 need not
be resolved by the mesh. Of the second integral only those elements matter: the rest of it does not change. Source:
theory page, "Applied fields".
"""

from __future__ import annotations

from typing import Any

from ngsolve import Cof, Det, Id, InnerProduct

from embedding.geometry.reduction import Reduction


def given_energy(reduction: Reduction, motion: Any, motion_gradient: Any, given: Any, axial: Any) -> Any:
    """1/2 |h_0|^2 per reference volume times the measure, for ``dx``; ``given`` is h_0 at the moved place."""
    J = Det(Id(reduction.dimension) + motion_gradient)
    return 0.5 * reduction.measure * reduction.out_of_plane(motion, axial) * J * InnerProduct(given, given)


def face_energy(reduction: Reduction, face: Face, potential: Any, given: Any) -> Any:
    """phi h_0 . n da per reference area times the measure, for ``ds``; ``given`` is h_0 at the moved face."""
    return reduction.measure * potential * InnerProduct(given, face.area_vector)


class Face:
    """The area vector m of a face that is displaced by ``y`` with the surface ``gradient``."""

    def __init__(self, reduction: Reduction, normal: Any, y: Any, gradient: Any, axial: Any) -> None:
        stretch = reduction.out_of_plane(y, axial)
        self.area_vector = stretch * (Cof(Id(reduction.dimension) + gradient) * normal)
