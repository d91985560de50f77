"""The present state of a problem in SI units: named fields for pictures, scalars for histories, vectors."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import CF, Grad, Id, IfPos, InnerProduct, sqrt, x

from embedding.ambient.potential import Conductor
from embedding.coupling.field import FieldEnergies
from embedding.coupling.potential_solve import PotentialSolve
from embedding.geometry.points import sampling_rule
from embedding.shell.kinematics import Kinematics
from embedding.shell.loads import enclosed_volume
from embedding.solving.events import Derived, Field
from embedding.solving.memory import Memory
from embedding.solving.outputs import output_fields
from embedding.solving.places import Tracked
from embedding.solving.problem import Problem
from embedding.timing import part


class State:
    """A view of ``problem``'s present state; its fields are live and change with the next Newton step.

    ``memory`` returns what a run goes on from, right after an accepted step.
    """

    to_edges = False
    """Are all extremes looked for up to the edges of elements? Those of the stretch are on curves; on surfaces the many
    corners, where it is least accurate, would make it too large, and the stress may be singular at ends of a rim."""

    def __init__(self, problem: Problem, memory: Callable[[], Memory] = dict) -> None:
        self.problem, self.memory = problem, memory
        self._system, self._scales = problem.system, problem.scales
        self._domain, self._unknowns = problem.domain, problem.system.unknowns
        self._values = {name: self._unknowns.field(name) for name in self._unknowns.names}
        self._tracked = Tracked(problem)
        self._lengths = 2 if problem.reduction.name == "plane-strain" else 3

    # -- kinematics that can be evaluated anywhere on the shell, the axis included

    def _kinematics(self, u: Any) -> Kinematics:
        plain = Kinematics(self._domain.reduction, self._domain.normal, u, self._axial)
        if self._domain.reduction.name != "axisymmetric":
            return plain
        along = sqrt(InnerProduct(plain.deformation_gradient, plain.deformation_gradient))
        hoop = IfPos(x - 1e-9, plain.hoop, along)
        return Kinematics(self._domain.reduction, self._domain.normal, u, self._axial, hoop)

    @property
    def _axial(self) -> Any:
        return self._values.get("axial", self._system.physics.axial_stretch)

    @cached_property
    def mid_surface(self) -> Kinematics:
        """Kinematics of the deformed mid-surface."""
        return self._kinematics(self._values["u"])

    @cached_property
    def principal_stretches(self) -> tuple[Any, Any]:
        """Larger and smaller in-plane stretch: of a curve those along and across it, of a surface from the invariants
        I_C and J_s, with an error of the root of rounding where they are equal."""
        if self._domain.mesh.dim == 2:
            across = self.mid_surface.hoop
            along = self.mid_surface.surface_stretch / across
            return IfPos(along - across, along, across), IfPos(along - across, across, along)
        half = self.mid_surface.metric_trace / 2
        inside = half * half - self.mid_surface.surface_stretch_squared
        root = sqrt(IfPos(inside, inside, CF(0.0)))
        return sqrt(half + root), sqrt(IfPos(half - root, half - root, CF(0.0)))

    @property
    def min_principal_stress(self) -> Any:
        """Smaller in-plane Cauchy stress of the membrane in plane stress, dimensionless."""
        return self._system.physics.law.principal_stresses(*self.principal_stretches)[1]

    # -- pressures on the faces: mechanical plus the field's

    def face_pressures(self) -> tuple[Any, Any]:
        """p_t and p_b, the total pressures on the true faces, dimensionless."""
        top, bottom = self._mechanical_pressures()
        for face, traction in self._system.tractions.items():
            traction.refresh()
            pressure = traction.pressure(self._kinematics(traction.displacement))
            top, bottom = (top + pressure, bottom) if face == "t" else (top, bottom + pressure)
        return CF(top), CF(bottom)

    def _mechanical_pressures(self) -> tuple[Any, Any]:
        loads, factor = self._system.physics.loads, self._system.factors.mechanical.Get()
        top = factor * loads.pressure_top
        if "pressure" in self._unknowns:
            return top, top - float(self._values["pressure"].vec[0])
        return top, factor * loads.pressure_bottom

    def mean_pressures(self) -> tuple[float, float]:
        """Means of p_t and p_b over the reference mid-surface, in Pa."""
        area = self._domain.area
        mechanical = [self._domain.shell_integral(CF(p)) / area for p in self._mechanical_pressures()]
        top, bottom = self.field_pressures()
        return self._scales.stress * mechanical[0] + top, self._scales.stress * mechanical[1] + bottom

    def field_pressures(self) -> tuple[float, float]:
        """What the field has in them, in Pa."""
        means = {"t": 0.0, "b": 0.0}
        for face, traction in self._system.tractions.items():
            traction.refresh()
            means[face] = self._scales.stress * traction.mean_pressure()
        return means["t"], means["b"]

    def field_tractions(self) -> tuple[float, float]:
        """Root mean squares of the field's tractions on the two faces, in Pa; tangential ones included."""
        sizes = {"t": 0.0, "b": 0.0}
        for face, traction in self._system.tractions.items():
            traction.refresh()
            pressure, along = traction.pressure(), traction.tangential()
            squared = self._domain.shell_integral(pressure * pressure + InnerProduct(along, along))
            sizes[face] = self._scales.stress * math.sqrt(squared / self._domain.area)
        return sizes["t"], sizes["b"]

    # -- what goes into archives and pictures

    def fields(self) -> list[Field]:
        """Every named field in SI units, shell first."""
        scales, k = self._scales, self.mid_surface
        top, bottom = self.face_pressures()
        major, minor = self.principal_stretches
        squeezed = self._system.physics.law.thickness_stretch(k)
        out = [
            Field("shell", "u", "m", scales.length * CF(self._values["u"])),
            Field("shell", "p_t", "Pa", scales.stress * top),
            Field("shell", "p_b", "Pa", scales.stress * bottom),
            Field("shell", "stretch", "1", sqrt(k.surface_stretch)),
            Field("shell", "stretch_major", "1", major),
            Field("shell", "stretch_minor", "1", minor),
            Field("shell", "thickness_stretch", "1", squeezed),
            Field("shell", "thickness", "m", scales.length * self._system.physics.thickness * squeezed),
            Field("shell", "normal", "1", k.normal),
        ]
        if self._unknowns.bending is not None:
            moments = self._unknowns.bending.principal_moments(self._values, k, self._system.factors.mechanical)
            for name, moment in zip(("moment_major", "moment_minor"), moments, strict=True):
                out.append(Field("shell", name, "N", scales.force * moment))
        for face, traction in self._system.tractions.items():
            kinematics = self._kinematics(traction.displacement)
            out.append(Field("shell", f"t_{face}", "Pa", scales.stress * traction.tangential(kinematics)))
        out += self._asked_for(top, bottom)
        for side in self._system.motions:
            out += self._ambient_fields(side)
        return out

    def _asked_for(self, top: Any, bottom: Any) -> list[Field]:
        """The fields that the scene names under ``output``."""
        physics, output = self._system.physics, self.problem.scene.output
        shell = (self._domain, self.mid_surface, physics.thickness)
        return output_fields(output, shell, physics.law, (top, bottom), self._scales)

    def _ambient_fields(self, side: str) -> list[Field]:
        scales = self._scales
        # From where the ambient's mesh is, which is not where the shell came from once it has been made anew.
        motion, w = self._system.motions[side].y[side], self._system.motions[side].w
        F = Id(self._domain.mesh.dim) + Grad(motion) + Grad(w)
        strength = self._field.strength(side, self._values, motion + w, F)
        potential = self._values["phi"]
        if self._field.lifts(side, self._values):
            potential = potential + self._values["jump"]
        electric = self.problem.scene.ambient is None or self.problem.scene.ambient.field == "electric"
        names, units = (("E", "D"), ("V", "V/m", "C/m^2")) if electric else (("H", "B"), ("A", "A/m", "T"))
        liquid = self._field.field.liquids.get(side, 1.0)
        flux_density = liquid * scales.flux_density * strength
        energy_density = 0.5 * liquid * scales.stress * InnerProduct(strength, strength)
        permittivity = liquid * scales.permittivity
        of_flux = Derived(names[0], lambda found: permittivity * found)
        of_energy = Derived(names[0], lambda found: 0.5 * permittivity * (found**2).sum(axis=1))
        return [
            Field(side, "u", "m", scales.length * (motion + w)),
            Field(side, "phi", units[0], scales.potential * potential),
            Field(side, names[0], units[1], scales.field * strength),
            Field(side, names[1], units[2], flux_density, of_flux),
            Field(side, "energy_density", "J/m^3", energy_density, of_energy),
        ]

    @property
    def _field(self) -> FieldEnergies:
        field = self._system.lagrangian.field
        if field is None:
            raise RuntimeError("this scene has no field")
        return field

    def vectors(self) -> dict[str, npt.NDArray[np.float64]]:
        """Copies of all unknowns, by name."""
        return {name: np.array(self._values[name].vec.FV().NumPy()) for name in self._unknowns.names}

    # -- scalars

    @property
    def area(self) -> float:
        """Area of the reference mid-surface of the whole body, in m^2 (plane strain: its length, in m)."""
        return self._scales.length ** (self._lengths - 1) * self._domain.area

    @part("scalars")
    def scalars(self) -> dict[str, float]:
        """Named numbers of the present state in SI units (plane strain: per metre of the cylinder)."""
        top, bottom = self.mean_pressures()
        named = self._stretches() | {
            "displacement": self._scales.length * self.displacement,
            "pressure_top": top,
            "pressure_bottom": bottom,
            "pressure_difference": self._pressure_difference(),
        }
        if self._domain.closed:
            named["volume_ratio"] = self.volume / self._system.lagrangian.reference_volume
        energy = self._scales.stress * self._scales.length**self._lengths
        named["elastic_energy"] = energy * self._system.lagrangian.elastic_energy(self._values)
        if "axial" in self._values:
            named["axial_stretch"] = float(self._values["axial"].vec[0])
        if self._system.load_work.known:
            named["load_work"] = energy * self._system.load_work.at_full_strength()
        support_work = self._system.support_work()
        if support_work is not None:
            named["support_work"] = energy * support_work
        if self._unknowns.rigid:
            named["held_force"] = self._scales.stress * self._scales.length ** (self._lengths - 1) * self.held_force
        return named | self._field_scalars(energy) | self._tracked.scalars()

    @property
    def held_force(self) -> float:
        """Size of the uniform dead force that holds the free rigid motions, dimensionless; 0 if the loads balance."""
        area = self._domain.area
        forces = [float(self._values[f"rigid{i}"].vec[0]) for i in range(len(self._unknowns.rigid))]
        return area * math.sqrt(sum(force**2 for force in forces))

    @property
    def displacement(self) -> float:
        """Root mean square of the displacement over the shell, in shell sizes."""
        u = self._values["u"]
        return math.sqrt(self._domain.shell_integral(InnerProduct(u, u)) / self._domain.area)

    def _stretches(self) -> dict[str, float]:
        area = self._domain.area
        ratio = self._domain.shell_integral(self.mid_surface.surface_stretch) / area
        plane = self._domain.reduction.name == "plane-strain"
        axial = float(self._values["axial"].vec[0]) if "axial" in self._values else self._system.physics.axial_stretch
        to_edges = self.to_edges or self._domain.mesh.dim == 2
        major, minor = (self._sample(value, to_edges=to_edges) for value in self.principal_stretches)
        return {
            "stretch": ratio / axial if plane else math.sqrt(ratio),
            "stretch_max": float(major.max()),
            "stretch_min": float(minor.min()),
            "min_principal_stress": self._scales.stress * self.smallest_stress,
        }

    @property
    def smallest_stress(self) -> float:
        """Smallest principal stress of those inside the elements, or anywhere (``to_edges``), dimensionless."""
        return float(self._sample(self.min_principal_stress, to_edges=self.to_edges).min())

    def _sample(self, values: Any, *, to_edges: bool) -> Any:
        rule = sampling_rule(self._domain.mesh.dim, self._domain.sizes.order, to_edges=to_edges)
        return np.asarray(values(self._domain.mesh.MapToAllElements(rule, self._domain.shell)))

    def _pressure_difference(self) -> float:
        area = self._domain.area
        top, bottom = self._mechanical_pressures()
        return self._scales.stress * self._domain.shell_integral(CF(bottom - top)) / area

    @property
    def volume(self) -> float:
        """Volume enclosed by the deformed mid-surface, dimensionless (plane strain: per length)."""
        kinematics = self._system.lagrangian.kinematics(self._values)
        return self._domain.shell_integral(enclosed_volume(self._domain, kinematics, self._values["u"]))

    def _field_scalars(self, energy: float) -> dict[str, float]:
        potential, physics = self._system.potential, self._system.physics.field
        if potential is None or physics is None:
            return {}
        named = {"min_jacobian": self._system.min_jacobian} if self._system.motions else {}
        named |= self._conductors(potential)
        if not any(physics.applied) and physics.varying is None:
            named["field_energy"] = energy * potential.energy()
        return named | self._forces()

    def _conductors(self, potential: PotentialSolve) -> dict[str, float]:
        """Voltages and charges: of the shell (base voltage, charge of both faces), of its film, of other bodies. Of the
        poles in a magnetic field potentials in A, and the flux that leaves them."""
        volts, coulombs = self._scales.potential, self._scales.flux_density * self._scales.length ** (self._lengths - 1)
        named: dict[str, float] = {}
        for conductor in potential.conductors:
            level, content = self._names_of(conductor)
            named[level] = volts * potential.voltage(conductor)
            named[content] = coulombs * potential.charge(conductor)
        return named

    def _names_of(self, conductor: Conductor) -> tuple[str, str]:
        """The scalars of its level and of its content."""
        level, content = ("potential", "flux") if self._scales.magnetic else ("voltage", "charge")
        suffix = {"shell": "", "jump": "_jump"}.get(conductor.label, f"_{conductor.label}")
        return level + suffix, content + suffix

    @property
    def given(self) -> frozenset[str]:
        """The scalars that the scene states: the level or the content of every conductor."""
        potential = self._system.potential
        conductors = [] if potential is None else potential.conductors
        return frozenset(self._names_of(one)[one.voltage is None] for one in conductors)

    def _forces(self) -> dict[str, float]:
        """Resultants of the field on the shell and on every body; components that symmetry makes zero are left out."""
        if not self._system.resultants:
            return {}
        named: dict[str, float] = {}
        for label, resultants in self._system.resultants.items():
            suffix = "" if label == "shell" else f"_{label}"
            force, torque = resultants.evaluate()
            scale = self._scales.stress * self._scales.length ** (self._lengths - 1)
            for axis, value in zip(self._domain.reduction.axes, force, strict=True):
                if axis != "r" and axis not in self._domain.reduction.planes:
                    named[f"force{suffix}_{axis}"] = scale * float(value)
            for axis, value in zip("xyz" if len(torque) == 3 else "z", torque, strict=False):
                if set(self._domain.reduction.planes) <= {axis}:
                    named[f"torque{suffix}_{axis}"] = scale * self._scales.length * float(value)
        return named
