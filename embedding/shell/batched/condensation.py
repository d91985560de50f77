"""Elimination of the moments, element by element.

With the element's matrix [[K, B^T], [B, -D]], -D that of the moments, the condensed one is K - B^T R with the response
R = (-D)^-1 B. Loads and updates follow it: f - R^T g, and the moments' part (-D)^-1 g - R u.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from embedding.shell.batched.polynomials import Array


@dataclass(frozen=True)
class Condensation:
    """``inverse`` (e, nm, nm) of the moments' matrices and ``response`` (e, nm, nk)."""

    inverse: Array
    response: Array

    @classmethod
    def of(cls, kept: Array, coupling: Array, moments: Array) -> tuple[Array, Condensation]:
        """The condensed matrices (e, nk, nk) of ``kept`` (e, nk, nk), ``coupling`` (e, nm, nk), ``moments``
        (e, nm, nm), and how they came about.

        Raises:
            numpy.linalg.LinAlgError: a matrix of moments is singular.
        """
        inverse = np.asarray(np.linalg.inv(moments), np.float64)
        response = inverse @ coupling
        return kept - coupling.swapaxes(1, 2) @ response, cls(inverse, response)

    def load(self, on_moments: Array) -> Array:
        """What a load (e, nm) on the moments adds to that on the kept unknowns, shape (e, nk)."""
        return -np.asarray(on_moments[:, None] @ self.response)[:, 0]

    def follow(self, kept: Array) -> Array:
        """The update of the moments (e, nm) that goes with one of the ``kept`` unknowns (e, nk)."""
        return -np.asarray(self.response @ kept[:, :, None])[:, :, 0]

    def own(self, on_moments: Array) -> Array:
        """The update of the moments for a load on them, the kept unknowns held."""
        return np.asarray(self.inverse @ on_moments[:, :, None])[:, :, 0]
