"""The field inside a linear dielectric or permeable shell, from the potential's mean and jump over its faces.

The shell is thin, so inside it the field is constant through the thickness: its normal part is the jump over the
current thickness, -(Phi_t - Phi_b) / (lambda T), its tangential part the surface gradient of the mean. The energy per
reference area of the incompressible shell (volume T per area, whatever the stretch) is

    1/2 eps_r [ (Phi_t - Phi_b)^2 / (lambda T)^2 + |F-hat^{-T} Grad_S mean|^2 ] T.

Source: theory page, "The field inside the shell"; design of the opened interface.
"""

from __future__ import annotations

from typing import Any

from ngsolve import InnerProduct

from embedding.shell.kinematics import Kinematics


def shell_field_energy(kinematics: Kinematics, thickness: float, contrast: float, jump: Any, mean_gradient: Any) -> Any:
    """Field energy inside the shell per reference area.

    ``jump`` is Phi_t - Phi_b and ``mean_gradient`` the reference surface gradient of (Phi_t + Phi_b) / 2.
    """
    normal_squared = jump * jump * kinematics.surface_stretch_squared / thickness**2
    tangential = kinematics.inverse_transpose * mean_gradient
    return 0.5 * contrast * thickness * (normal_squared + InnerProduct(tangential, tangential))
