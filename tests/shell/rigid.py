"""Nodal forces of loads, their resultants, and shells that are moved rigidly."""

from __future__ import annotations

from typing import Any

import numpy as np
from ngsolve import CF, BilinearForm, GridFunction, Parameter, Variation

from embedding.geometry.domain import Domain
from embedding.geometry.spaces import TraceSpace
from embedding.shell.edges import edge_residual
from embedding.shell.kinematics import Kinematics
from embedding.shell.loads import MechanicalLoads, dead_load_energy
from embedding.shell.point_loads import point_load_vector
from tests.forms import Array, set_on_shell


class NodalForces:
    """Forces of ``loads`` on the unknowns of a shell; the dot product with a change of those is their work."""

    def __init__(self, domain: Domain, loads: MechanicalLoads, thickness: Any = 0.1) -> None:
        self.domain = domain
        self.trace = TraceSpace(domain.mesh, domain.sizes.order)
        trial, test = self.trace.space.TnT()
        self.form = BilinearForm(self.trace.space)
        factor = Parameter(1.0)
        for term in dead_load_energy(domain, loads, thickness, trial.Trace(), factor):
            self.form += Variation(term)
        kinematics = Kinematics(domain.reduction, domain.normal, trial)
        for term in edge_residual(domain, loads.edge_forces, kinematics, test, factor):
            self.form += term
        self.at_points = point_load_vector(domain, self.trace, loads)
        self.everything = np.ones(self.trace.space.ndof, bool)

    def field(self, value: Any) -> GridFunction:
        """A displacement of the shell."""
        field = GridFunction(self.trace.space)
        set_on_shell(field, value, self.everything, self.domain)
        return field

    def at(self, motion: Any) -> Array:
        """Nodal forces in the state displaced by ``motion``."""
        state = self.field(motion)
        residual = state.vec.CreateVector()
        self.form.Apply(state.vec, residual)
        return self.at_points - np.array(residual.FV().NumPy())

    def work(self, motion: Any, virtual: Any) -> float:
        """Virtual work in the state displaced by ``motion``."""
        return float(self.at(motion) @ self.field(virtual).vec.FV().NumPy())

    def force(self, motion: Any) -> Array:
        """Resultant force, mesh components."""
        unit = np.eye(self.domain.mesh.dim)
        return np.array([self.work(motion, CF(tuple(row))) for row in unit])

    def moment(self, motion: Any) -> Array:
        """Resultant moment of the displaced shell about the origin (about z in the plane)."""
        place = self.domain.reduction.position + motion
        if self.domain.mesh.dim == 2:
            return np.array([self.work(motion, CF((-place[1], place[0])))])
        x, y, z = place[0], place[1], place[2]
        turns = (CF((0, -z, y)), CF((z, 0, -x)), CF((-y, x, 0)))
        return np.array([self.work(motion, turn) for turn in turns])


def rotation(axis: tuple[float, ...], angle: float) -> Array:
    """Rotation matrix (3, 3)."""
    a = np.asarray(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def moved(domain: Domain, matrix: Array, motion: Any = None) -> Any:
    """The displacement that turns the displaced shell by ``matrix`` (d, d) about the origin."""
    place = domain.reduction.position + (motion if motion is not None else 0 * domain.reduction.position)
    turned = [sum(float(row[j]) * place[j] for j in range(domain.mesh.dim)) for row in matrix]
    return CF(tuple(turned)) - domain.reduction.position
