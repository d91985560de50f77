"""The one Lagrangian of the coupled problem, as an NGSolve form whose derivative is the Newton matrix.

    L = int T Psi dA  +  dead loads  +  p~ (V - V_target)                          shell
      - int 1/2 eps J |F^{-T} Grad Phi|^2 dX  -  far field                         ambient, moved by y + w
      - int T W*(h, B~_r) dA                                                       field inside the shell
      + sum Q V                                                                    conductors with given charges
      + int tau_t . (u + (T/2) lambda n - y_t) + tau_b . (u - (T/2) lambda n - y_b) dA      faces (opened interface)

u displaces the mid-surface, y_t and y_b the faces, w (frozen here) the ambient's interior. Stationarity in tau places
the faces, in y makes -tau the traction on the face, in u gives all its work, in Phi the field. With the interface
closed, y_t = y_b = u and tau drops out. On an open shell y = u + o, and o is the unknown; W* then depends on it, too.
The charges Q are constant forces on the potentials V of their conductors, which the system adds. Source: theory page,
"The coupled Lagrangian".
"""

from __future__ import annotations

from typing import Any, Literal

from ngsolve import CF, BilinearForm, GridFunction, InnerProduct, Integrate, Parameter, Variation

from embedding.ambient.motion import AmbientMotion
from embedding.coupling.field import FieldEnergies
from embedding.coupling.physics import Physics
from embedding.coupling.room import RoomyForm
from embedding.coupling.unknowns import Unknowns
from embedding.geometry.domain import Domain
from embedding.shell.edges import edge_residual
from embedding.shell.kinematics import Kinematics, surface_gradient
from embedding.shell.loads import dead_load_energy, enclosed_volume, follower_residual
from embedding.shell.membrane import Membrane

ANCHOR = 1e-6
"""Stiffness, relative to the shell's, that ties each face to where it is. It changes no residual, only the matrix:
where there is no field a face would have a zero on the diagonal, and elimination without pivoting cannot have that."""


Extent = Literal["all", "touching", "shell"]
OFFSET = {"t": 0.5, "b": -0.5}
"""Where the faces lie along the director lambda n, in thicknesses."""


class Factors:
    """The parameters of a form: strength of the mechanical loads and of the field, target volume, proximal stiffness.

    The proximal stiffness (shear moduli) ties the mid-surface to where it is, and stretches it like a tension, in the
    matrix only: Newton's method then takes shorter and smoother steps, to the same solution. A membrane at rest needs
    it, whose matrix is singular or nearly so.
    """

    def __init__(self) -> None:
        self.mechanical = Parameter(0.0)
        self.field = Parameter(0.0)
        self.volume = Parameter(1.0)
        self.proximal = Parameter(0.0)


class Lagrangian:
    """Builds the forms of a coupled problem on ``unknowns``; symmetric unless a load has no potential."""

    def __init__(
        self,
        domain: Domain,
        physics: Physics,
        unknowns: Unknowns,
        motions: dict[str, AmbientMotion],
        factors: Factors,
    ) -> None:
        self.domain, self.physics, self.unknowns = domain, physics, unknowns
        self.factors = factors
        self.measure = domain.reduction.measure
        self.field: FieldEnergies | None = None
        if physics.field is not None:
            self.field = FieldEnergies(
                domain, physics, physics.field, unknowns, motions, factors.field, self.kinematics
            )
        self.membrane: Membrane | None = None
        if unknowns.bending is not None:
            update = GridFunction(unknowns.trace.space)
            self.membrane = Membrane(domain, physics.law, physics.thickness, update, cured=physics.locking_cured)

    # -- what both the joint form and the potential's own form are made of

    def axial(self, values: dict[str, Any]) -> Any:
        """The axial stretch of plane strain: prescribed, or its unknown."""
        return values.get("axial", self.physics.axial_stretch)

    def kinematics(self, values: dict[str, Any], displacement: str = "u") -> Kinematics:
        """Kinematics of the mid-surface (or of a face) for the unknowns ``values``."""
        return Kinematics(self.domain.reduction, self.domain.normal, values[displacement], self.axial(values))

    def field_energies(self, values: dict[str, Any], extent: Extent = "all") -> list[Any]:
        """Every term of the field's co-energy, or those of an ``extent``: "touching" the shell, or in the "shell"
        itself; empty without a field."""
        field = self.field
        if field is None:
            return []
        terms = {"all": field.energies, "touching": field.touching_energies, "shell": field.shell_energies}
        return terms[extent](values)

    # -- the forms

    def joint_form(self, *, elastic: bool = True, proximal: bool = True, field: Extent = "all") -> Any:
        """The form of all unknowns together; w and the load factors are parameters.

        Without what is ``elastic``, the energies of membrane and bending are left to others, and nothing is condensed;
        without ``proximal``, the proximal stiffness is left out; ``field`` is the extent of the field's terms.
        """
        trial = self.unknowns.trial
        residuals = self._residuals()
        condense = self.unknowns.condensed is not None and elastic
        form = BilinearForm(self.unknowns.space, symmetric=not residuals, condense=condense)
        for term in self._shell_energies(trial, elastic=elastic):
            form += Variation(term).Compile()
        for term in self.field_energies(trial, field):
            form += Variation(-1 * term).Compile()
        for term in [*([self._proximal()] * proximal), *self._openings(), *residuals]:
            form += term.Compile()
        if field == "all":
            return form
        pairs = [(trial[name], self.unknowns.test[name]) for name in ("phi", "jump") if name in self.unknowns]
        return RoomyForm(form, self.domain.mesh, pairs)

    def _shell_energies(self, values: dict[str, Any], *, elastic: bool = True) -> list[Any]:
        physics, measure = self.physics, self.measure
        kinematics = self.kinematics(values)
        u = _trace(values["u"])
        terms: list[Any] = []
        surface = self.domain.surface()
        shell = measure * self._membrane_energy(kinematics) if self.membrane is None else CF(0.0)
        # One compiled expression for everything that is nonlinear in u: the terms share the kinematics.
        for face in self.unknowns.opened:
            offset = OFFSET[face] * physics.thickness * kinematics.director
            shell = shell + measure * InnerProduct(_trace(values[f"tau_{face}"]), offset)
        if self.membrane is None or self.unknowns.opened:
            terms.append(shell * surface)
        if self.membrane is not None and self.unknowns.bending is not None and elastic:
            state = self.kinematics({name: self.unknowns.field(name) for name in self.unknowns.names})
            terms.append(measure * self.membrane.energy(kinematics, state) * self.membrane.integral)
            terms += self.unknowns.bending.energies(values, kinematics, self.factors.mechanical)
        terms += dead_load_energy(self.domain, physics.loads, physics.thickness, u, self.factors.mechanical)
        if self.pressure_has_potential:
            terms.append(measure * self._pressure_energy(kinematics, u, values.get("pressure")) * self.domain.surface())
        for i, motion in enumerate(self.unknowns.rigid):
            terms.append(measure * values[f"rigid{i}"] * InnerProduct(motion, u) * self.domain.surface())
        return terms

    def _proximal(self) -> Any:
        trial, test, state = self.unknowns.trial["u"], self.unknowns.test["u"], self.unknowns.field("u")
        pull = InnerProduct(_trace(trial) - state, _trace(test))
        tension = InnerProduct(surface_gradient(trial) - surface_gradient(state), surface_gradient(test))
        strength = self.factors.proximal * self.physics.thickness
        return self.measure * strength * (pull + tension) * self.domain.surface()

    def _openings(self) -> list[Any]:
        """The part of the faces' terms that is linear in the unknowns, with the anchors, as a bilinear form.

        The gap u - y (or -o) is paired with tau both ways; written out it is assembled several times faster than by
        differentiating an energy. What is nonlinear, the director, is among the shell's energies.
        """
        trial = {name: _trace(value) for name, value in self.unknowns.trial.items()}
        test = {name: _trace(value) for name, value in self.unknowns.test.items()}
        terms = []
        for face in self.unknowns.opened:
            y, tau = self.unknowns.moved_by(face), f"tau_{face}"
            gap, gap_test = (-1 * v[y] if self.domain.open else v["u"] - v[y] for v in (trial, test))
            pairing = InnerProduct(trial[tau], gap_test) + InnerProduct(test[tau], gap)
            for name, strength in ((tau, ANCHOR), (y, -ANCHOR)):
                shift = trial[name] - self.unknowns.field(name)
                pairing = pairing + strength * InnerProduct(shift, test[name])
            terms.append(self.measure * pairing * self.domain.surface())
        return terms

    def elastic_energy(self, values: dict[str, Any]) -> float:
        """Elastic energy of stretching and bending in the state of grid functions.

        It is that of the discrete equilibrium, whose strain is interpolated where locking is cured.
        """
        kinematics = self.kinematics(values)
        if self.membrane is None or self.unknowns.bending is None:
            return float(self.domain.shell_integral(self._membrane_energy(kinematics)))
        stretching = self.measure * self.membrane.energy(kinematics, kinematics) * self.membrane.integral
        bending = self.unknowns.bending.stored(values, kinematics, self.factors.mechanical)
        return float(Integrate(stretching, self.domain.mesh)) + float(self.domain.shell_integral(bending))

    def _membrane_energy(self, kinematics: Kinematics) -> Any:
        return self.physics.thickness * self.physics.law.energy(kinematics)

    @property
    def pressure_has_potential(self) -> bool:
        """Uniform pressures in and on a closed shell do work on its volume alone."""
        physics, loads = self.physics, self.physics.loads
        uniform = self.domain.closed and loads.uniform and loads.variant != "as-published" and not physics.axial_free
        return physics.volume_controlled or (uniform and loads.pressed)

    def _pressure_energy(self, kinematics: Kinematics, u: Any, unknown: Any | None) -> Any:
        volume = enclosed_volume(self.domain, kinematics, u)
        if unknown is None:
            return self.factors.mechanical * self.physics.loads.difference * volume
        reference = self.reference_volume / self.domain.area
        return unknown * (volume - self.factors.volume * reference)

    @property
    def reference_volume(self) -> float:
        """Volume enclosed by the meshed mid-surface (plane strain: per length), at the prescribed axial stretch."""
        normal = self.domain.normal
        share = 2 if self.domain.reduction.name == "plane-strain" else 3
        return self.domain.shell_integral(InnerProduct(self.domain.reduction.position, normal) / share)

    @property
    def symmetric(self) -> bool:
        """Do all loads have a potential, so that the Newton matrix is symmetric?"""
        loads = self.physics.loads
        turning = loads.turning or (bool(loads.edge_moments) and self.domain.mesh.dim == 3)
        return not turning and (self.pressure_has_potential or not loads.pressed)

    def _residuals(self) -> list[Any]:
        physics = self.physics
        if self.symmetric:
            return []
        kinematics = self.kinematics(self.unknowns.trial)
        factor = self.factors.mechanical
        v = self.unknowns.test["u"]
        terms = edge_residual(self.domain, physics.loads.edge_forces, kinematics, v, factor)
        if self.unknowns.bending is not None:
            terms += self.unknowns.bending.residuals(self.unknowns.trial, v, kinematics)
        if self.pressure_has_potential or not physics.loads.pressed:
            return terms
        terms += follower_residual(self.domain, physics.loads, physics.thickness, kinematics, v, factor)
        if physics.axial_free and physics.loads.rim_is_free and physics.loads.variant != "net":
            stretch, test = self.unknowns.trial["axial"], self.unknowns.test["axial"]
            work = self.measure * factor * physics.thickness * physics.loads.mean * test / stretch
            terms.append(-1 * work * self.domain.surface())
        return terms


def _trace(value: Any) -> Any:
    return value.Trace() if hasattr(value, "Trace") else value
