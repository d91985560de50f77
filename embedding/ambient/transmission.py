"""The field inside the shell's material, from the potential's mean and jump over its faces.

The shell is thin, so inside it the field is constant through the thickness. Pulled back, with F-hat = F + lambda n (x)
N and det F-hat = 1, it is

    H = F-hat^T h = - (Phi_t - Phi_b) / T  N  -  Grad_S mean,

so that its normal part is the jump over the present thickness and its tangential part the surface gradient of the mean.
Co-energy per reference area, with the flux b = d / dh as its derivative:

    linear        T  eps_r / 2 |h|^2
    saturating    T [ |h|^2 / 2 + (M_s^2 / chi) (sqrt(1 + (chi |h| / M_s)^2) - 1) ],   chi = mu_r - 1
    remanent    + T  B~_r . H                     (b_r = F-hat B~_r is carried by the material)

The saturating law has the magnetisation chi h / sqrt(1 + (chi |h| / M_s)^2): slope chi at rest, M_s far out, smooth.
The remanent part does not depend on the deformation: what turns and pulls a magnet is the field around it. Sources:
theory page, "The field"; Zhao, Kim, Cheng, Vogt, Zhao, J. Mech. Phys. Solids 124 (2019) 244 for B_r = F B~_r.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ngsolve import CF, Cof, Det, IfPos, InnerProduct, OuterProduct, sqrt

from embedding.shell.kinematics import Kinematics


@dataclass(frozen=True)
class Matter:
    """What the shell's material does to a field, dimensionless; numbers or coefficient functions on the shell.

    ``contrast`` is the relative permittivity or permeability, None for a conductor. ``remanence`` holds the mesh
    components of B~_r in the reference, ``saturation`` the limit M_s of the induced magnetisation.
    """

    contrast: Any | None = None
    remanence: Any | None = None
    saturation: Any | None = None

    def coenergy(self, field_squared: Any, pulled_back: Any) -> Any:
        """Co-energy per reference volume for |h|^2 and the pulled-back field H (mesh components)."""
        stored = self.stored(field_squared)
        return stored if self.remanence is None else stored + InnerProduct(CF(self.remanence), pulled_back)

    def stored(self, field_squared: Any) -> Any:
        """Co-energy per reference volume without that of the remanence."""
        contrast = CF(1.0 if self.contrast is None else self.contrast)
        if self.saturation is None:
            return 0.5 * contrast * field_squared
        return 0.5 * field_squared + self._magnetised(contrast - 1, field_squared)

    def excess(self, field_squared: Any, pulled_back: Any, medium: float) -> Any:
        """Co-energy above that of the ``medium`` around (its contrast) in the same field."""
        return self.coenergy(field_squared, pulled_back) - 0.5 * medium * field_squared

    def _magnetised(self, chi: Any, field_squared: Any) -> Any:
        limit = CF(self.saturation)
        return limit**2 / chi * (sqrt(1 + chi**2 * field_squared / limit**2) - 1)


def shell_field_energy(
    kinematics: Kinematics, thickness: Any, matter: Matter, jump: Any, mean_gradient: Any, given: Any | None = None
) -> Any:
    """Field co-energy inside the shell per reference area.

    ``jump`` is Phi_t - Phi_b and ``mean_gradient`` the reference surface gradient of (Phi_t + Phi_b) / 2. A ``given``
    field (at the present place) comes on top of that of the potential.
    """
    tangential = kinematics.inverse_transpose * mean_gradient
    pulled_back = -1 / thickness * jump * kinematics.reference_normal - mean_gradient
    if given is None:
        normal_squared = jump * jump * kinematics.surface_stretch_squared / thickness**2
        return thickness * matter.coenergy(normal_squared + InnerProduct(tangential, tangential), pulled_back)
    field = given - 1 / thickness * jump * kinematics.area_vector - tangential
    pulled_back = pulled_back + kinematics.spatial_gradient.trans * given
    return thickness * matter.coenergy(InnerProduct(field, field), pulled_back)


def tapered_field_energy(
    kinematics: Kinematics,
    director: Any,
    thickness: Any,
    matter: Matter,
    jump: Any,
    mean_gradient: Any,
    given: Any | None = None,
    medium: float = 1.0,
) -> Any:
    """As :func:`shell_field_energy`, where faces that meet in a rim lie at +- T/2 times ``director``, not lambda n.

    With G = F + director (x) N the field is h = G^{-T} H, and the space between the faces is det G of the shell's. That
    much of the ``medium`` is not in the ambient; what the material has above it is in full measure,

        T [ det G  w_0(h) + w*(h) - w_0(h) ],

    so that a shell that differs in nothing from the medium is not there at all. Where the material has less than the
    medium, the difference is tapered with the space, lest no field were better than some.
    """
    normal = kinematics.reference_normal
    stretched = kinematics.deformation_gradient + OuterProduct(director, normal)
    inverse_transpose, room = Cof(stretched) / Det(stretched), kinematics.hoop * Det(stretched)
    field = -1 * (inverse_transpose * (jump / thickness * normal + mean_gradient))
    if given is not None:
        field = field + given
    squared = InnerProduct(field, field)
    free = 0.5 * medium * squared
    measure = 1.0 if matter.contrast is None else IfPos(CF(matter.contrast) - medium, 1.0, room)
    energy = room * free + measure * (matter.stored(squared) - free)
    if matter.remanence is not None:
        energy = energy + InnerProduct(CF(matter.remanence), kinematics.spatial_gradient.trans * field)
    return thickness * energy


def given_field_energy(
    kinematics: Kinematics, thickness: Any, matter: Matter, strength: Any, medium: float = 1.0
) -> Any:
    """Excess co-energy per reference area, over that of the ``medium`` around, of a shell that does not change a field
    of the ``strength`` at its present place.

    Exact for remanence in the field of others; of an induced magnetisation the first order in mu_r - 1.
    """
    pulled_back = kinematics.spatial_gradient.trans * strength
    return thickness * matter.excess(InnerProduct(strength, strength), pulled_back, medium)
