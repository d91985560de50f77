"""What every law offers. All is dimensionless, and the thickness stretch lambda is eliminated.

A law asks kinematics for ``metric_trace`` (I_C), ``surface_stretch_squared`` (J_s^2), what both make of the
invariants (``excess``, ``second_excess``) and, where the mesh has two dimensions, ``hoop``, the stretch it does not
show; the law of small strains asks for ``strain`` and ``hoop_strain`` instead.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, ClassVar, Protocol

from embedding.shell.kinematics import Kinematics


class Law(Protocol):
    """A hyperelastic law of a shell in plane stress."""

    incompressible: ClassVar[bool]

    def energy(self, kinematics: Kinematics) -> Any:
        """Psi, energy per reference volume, at a point of the mid-surface."""

    def thickness_stretch(self, kinematics: Kinematics) -> Any:
        """lambda = t / T."""

    def principal_stresses(self, major: Any, minor: Any) -> tuple[Any, Any]:
        """In-plane Cauchy stresses at the principal stretches ``major`` and ``minor``, numbers, arrays or functions."""


class IncompressibleLaw(ABC):
    """A law with lambda = 1 / J_s."""

    incompressible: ClassVar[bool] = True

    @abstractmethod
    def energy(self, kinematics: Kinematics) -> Any:
        """Psi, energy per reference volume, at a point of the mid-surface."""

    @abstractmethod
    def bending_modulus(self, kinematics: Kinematics) -> Any:
        """Mean of (sigma_i - sigma_j) / (l_i^2 - l_j^2) over the three pairs of principal directions.

        The shear modulus at rest; positive wherever the larger stress goes with the larger stretch (Baker and Ericksen
        1954).
        """

    @abstractmethod
    def principal_stresses(self, major: Any, minor: Any) -> tuple[Any, Any]:
        """In-plane Cauchy stresses at the principal stretches ``major`` and ``minor``, numbers, arrays or functions."""

    def thickness_stretch(self, kinematics: Kinematics) -> Any:
        """lambda = t / T = 1 / J_s."""
        return kinematics.thickness_stretch
