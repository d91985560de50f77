"""The bending energy of a law in terms of moments: its Legendre transform, polynomial in the moment.

The curvature measure is K = lambda b - sym(B C) (the paper's C_1 / -2): a shell of incompressible material that is
blown up without changing its shape bends by it, and K = b - B where strains are small. With mu_b the shear modulus of
the state (for neo-Hooke it is mu) and C the surface Cauchy-Green tensor, the second-order expansion over the thickness
of the plane-stress energy is

    W_b(K) = mu_b T^3 / (12 J_s^2) [tr(C^-1 K)^2 + tr(C^-1 K C^-1 K)]

and its dual, with M = F m F^T the pushed forward moment, has no inverse in it:

    W_b*(m) = 3 J_s^2 / (mu_b T^3) [M : M - (tr M)^2 / 3].

For St Venant and Kirchhoff, W_b(K) = 1/2 K : D : K with the plane-stress moduli times T^3/12, and
W_b*(m) = 6 / (E T^3) [(1 + nu) m : m - nu (tr m)^2]. Source: theory page, "Bending".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ngsolve import InnerProduct, Trace

from embedding.shell.kinematics import Kinematics

EdgeMoments = tuple[tuple[str, float], ...]
"""(edge, moment per reference length): positive turns the outward conormal towards the top normal."""


@dataclass(frozen=True)
class Stiffness:
    """Bending stiffness of a shell of ``thickness`` (dimensionless number or coefficient function) and ``law``."""

    law: Any
    thickness: Any

    def dual(self, kinematics: Kinematics, moment: Any) -> Any:
        """W_b*(m) per reference area for the 3 x 3 moment tensor ``moment`` of a surface."""
        cubed = self.thickness**3
        if not self.law.incompressible:
            E, nu = self.law.youngs, self.law.poisson
            return 6 / (E * cubed) * ((1 + nu) * InnerProduct(moment, moment) - nu * Trace(moment) ** 2)
        F = kinematics.deformation_gradient
        pushed = (F * moment) * F.trans
        scale = 3 * kinematics.surface_stretch_squared / (self.law.bending_modulus(kinematics) * cubed)
        return scale * (InnerProduct(pushed, pushed) - Trace(pushed) ** 2 / 3)

    def partial_dual(self, kinematics: Kinematics, moment: Any, hoop: Any) -> Any:
        """sup over K_ss of m K_ss - W_b(K_ss, K_hh): dual in the meridional direction of a curve alone.

        ``moment`` is the meridional moment m_ss, ``hoop`` the curvature measure K_hh of the direction that the mesh
        does not show (0 in plane strain).
        """
        if not self.law.incompressible:
            E, nu = self.law.youngs, self.law.poisson
            D = E * self.thickness**3 / (12 * (1 - nu**2))
            return moment**2 / (2 * D) - nu * moment * hoop - D / 2 * (1 - nu**2) * hoop**2
        A = self.law.bending_modulus(kinematics) * self.thickness**3 / (12 * kinematics.surface_stretch_squared)
        F = kinematics.deformation_gradient
        along = moment * InnerProduct(F, F)
        relative = hoop / kinematics.hoop**2
        # Written out: in the square of a sum NGSolve loses what is 1e-16 of the other term, and the mixed derivative.
        return along**2 / (8 * A) - along * relative / 2 - 3 / 2 * A * relative**2

    def hoop_moment(self, kinematics: Kinematics, moment: Any, hoop: Any) -> Any:
        """m_hh from the meridional ``moment`` and the ``hoop`` curvature measure."""
        if not self.law.incompressible:
            E, nu = self.law.youngs, self.law.poisson
            return nu * moment + E * self.thickness**3 / 12 * hoop
        A = self.law.bending_modulus(kinematics) * self.thickness**3 / (12 * kinematics.surface_stretch_squared)
        along = InnerProduct(kinematics.deformation_gradient, kinematics.deformation_gradient)
        around = kinematics.hoop**2
        return (moment * along / 2 + 3 * A * hoop / around) / around

    def stored(self, kinematics: Kinematics, moment: Any, hoop: Any) -> Any:
        """W_b at the meridional ``moment`` and the ``hoop`` curvature measure: m K_ss - W_b*, K_ss its derivative."""
        if not self.law.incompressible:
            E, nu = self.law.youngs, self.law.poisson
            D = E * self.thickness**3 / (12 * (1 - nu**2))
            return moment**2 / (2 * D) + D / 2 * (1 - nu**2) * hoop**2
        A = self.law.bending_modulus(kinematics) * self.thickness**3 / (12 * kinematics.surface_stretch_squared)
        F = kinematics.deformation_gradient
        relative = hoop / kinematics.hoop**2
        return (moment * InnerProduct(F, F)) ** 2 / (8 * A) + 3 / 2 * A * relative**2
