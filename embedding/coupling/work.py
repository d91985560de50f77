"""What mechanical loads and supports that move work on: the conjugates of the load factor, for the balance of energies.

With the Lagrangian L(state, f), f the factor of the mechanical loads, the work of the loads along a path of equilibria
is the integral of f dq with q = - dL/df: what loads of full strength do on the present displacement. Supports that move
by f times a given displacement do the integral of r df, with r the work of their reactions on the whole of it.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from ngsolve import BilinearForm, Variation

from embedding.coupling.lagrangian import Lagrangian
from embedding.shell.loads import dead_load_energy


class LoadWork:
    """The work of dead loads and of moments on edges; pressures and forces that follow an edge have no part in it.

    ``point_forces`` are nodal forces at full strength on the displacement.
    """

    def __init__(self, lagrangian: Lagrangian, point_forces: npt.NDArray[np.float64]) -> None:
        physics, unknowns = lagrangian.physics, lagrangian.unknowns
        self._lagrangian, self._point_forces = lagrangian, point_forces
        trial, factor = unknowns.trial, lagrangian.factors.mechanical
        u = trial["u"].Trace() if hasattr(trial["u"], "Trace") else trial["u"]
        terms = dead_load_energy(lagrangian.domain, physics.loads, physics.thickness, u, factor)
        if unknowns.bending is not None and physics.loads.edge_moments:
            terms += unknowns.bending.energies(trial, lagrangian.kinematics(trial), factor)
        self._form = BilinearForm(unknowns.space)
        for term in terms:
            self._form += Variation(term).Compile()
        self._works = bool(terms)

    @property
    def known(self) -> bool:
        """Are there loads of this kind, and none whose work depends on the way?

        It does of forces that follow an edge, and of moments on edges in space: there rotations are measured from step
        to step.
        """
        loads = self._lagrangian.physics.loads
        if loads.edge_moments and self._lagrangian.domain.mesh.dim == 3:
            return False
        return (self._works or bool(loads.point_forces)) and not loads.turning

    def at_full_strength(self) -> float:
        """q, dimensionless: L is quadratic in the factor, so that a central difference is its derivative."""
        unknowns, factor = self._lagrangian.unknowns, self._lagrangian.factors.mechanical
        work = float(self._point_forces @ unknowns.field("u").vec.FV().NumPy())
        if not self._works:
            return work
        present, energies = factor.Get(), []
        for shift in (1.0, -1.0):
            factor.Set(present + shift)
            energies.append(float(self._form.Energy(unknowns.state.vec)))
        factor.Set(present)
        return work - (energies[0] - energies[1]) / 2
