"""How hard a scene loads its shell, before anything is solved: load numbers, stretch and tension in closed form.

A load number is what a load is worth as a pressure p on a shell of radius R: p R / (mu T). For a flat shell R is its
size. The estimates are those of the simplest shell with the same numbers, and right to a factor of two or so: how right
is measured (docs/planner.md).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property

from embedding.plan.field_loading import FieldLoading
from embedding.plan.response import FLAT_TENSION, Answer, Form, answer
from embedding.scene import ForceField, InfiniteCylinder, Scene, Stage, ThicknessField
from embedding.scene.surface_fields import SurfaceField

STRETCHES = {"stretch": 1, "stretch_max": 1, "stretch_min": 1, "axial_stretch": 1, "volume_ratio": 3}
"""Scalars that start at 1 and hardly move under a small load, and what power of a length they are."""
RIGID = 1e-9
"""Strain below which a shell answers linearly."""
TIGHTENED = 1 / 3
"""How the deflection of a membrane answers to its load where it makes its own tension."""


class Loading:
    """The load numbers of ``scene`` at the end of its path, and what the simplest shell of its kind does under them, or
    what was ``found``."""

    def __init__(self, scene: Scene, found: Answer | None = None) -> None:
        self._found = found
        self.scene, self.shape = scene, scene.shell.shape
        self.size, self.thickness = self.shape.size, scene.shell.thickest
        unknown = self.shape.narrowest / 2 if self.shape.closed else None  # of a surface from a file
        self.radius = self.shape.curvature_radius or unknown
        self.modulus = scene.shell.material.shear_modulus
        self.last: Stage = scene.path[-1]
        self.field = FieldLoading(scene)

    @property
    def lever(self) -> float:
        """R / T, what turns a pressure into a membrane stress."""
        return (self.radius or self.size) / self.thickness

    @property
    def slenderness(self) -> float:
        """T / r, 0 for a flat shell."""
        return 0.0 if self.radius is None else self.thickness / self.radius

    @property
    def form(self) -> Form:
        """The simplest shell of its kind."""
        if self.radius is None:
            return "flat"
        return "cylinder" if isinstance(self.shape, InfiniteCylinder) or self.shape.kind == "arch" else "sphere"

    @cached_property
    def pressure(self) -> float:
        """That of p_b - p_t, positive where it inflates; where the volume is controlled, that of the volume."""
        if self.last.volume_ratio is not None:
            return self._of_volume(self.last.volume_ratio)
        return float(self.last.mechanical) * self.pressure_of_full_load

    @property
    def pressure_of_full_load(self) -> float:
        """That of the pressures as they are stated."""
        differences = [bottom - top for top, bottom in self._pressures]
        return sum(differences) / len(differences) * self.lever / self.modulus

    @cached_property
    def _pressures(self) -> list[tuple[float, float]]:
        """p_t and p_b at a few points of the shape, in Pa."""
        loads, points = self.scene.loads, self.shape.sample_points()
        top, bottom = (
            [p.value_at(point) for point in points] if isinstance(p, SurfaceField) else [float(p)] * len(points)
            for p in (loads.pressure_top, loads.pressure_bottom)
        )
        return list(zip(top, bottom, strict=True))

    @property
    def unevenness_of_mean(self) -> float:
        """That of the mean of both pressures, whose gradient times the thickness pushes like their difference."""
        spread = _spread([(bottom + top) / 2 for top, bottom in self._pressures])
        return abs(self.last.mechanical) * spread / self.modulus

    @property
    def mean_pressure(self) -> float:
        """Size of the mean of both pressures over the shear modulus, a stress that squeezes the wall."""
        mean = [(bottom + top) / 2 for top, bottom in self._pressures]
        return abs(self.last.mechanical) * abs(sum(mean) / len(mean)) / self.modulus

    def _of_volume(self, ratio: float) -> float:
        if self.form == "cylinder":
            return 1 - math.pow(ratio, -2)
        return 2 * (math.pow(ratio, -1 / 3) - math.pow(ratio, -7 / 3))

    @cached_property
    def others(self) -> float:
        """That of all other mechanical loads together, whichever way they push."""
        loads, mu, T = self.scene.loads, self.modulus, self.thickness
        length = self.lever * T
        force = loads.surface_force
        if isinstance(force, ForceField):
            points = self.shape.sample_points()
            spread = math.hypot(*(max(map(abs, part.values_at(points))) for part in force.components))
        else:
            spread = math.hypot(*force)
        weight = math.hypot(*loads.gravity) * (self.scene.shell.density or 0.0)
        numbers = [
            spread * self.lever / mu,
            (math.hypot(*loads.body_force) + weight) * length / mu,
            _spread([bottom - top for top, bottom in self._pressures]) * self.lever / mu,
            *(math.hypot(*edge.traction) / (mu * T) for edge in loads.edge_tractions),
            *(math.hypot(*line.force) / (mu * T) for line in loads.line_loads),
            *(math.hypot(*point.force) / (mu * T * length) for point in loads.point_loads),
            *(abs(edge.moment) / (mu * T**2) for edge in loads.edge_moments),
            *(12 * math.hypot(*support.displacement) / self.size for support in self.scene.supports),
        ]
        return abs(self.last.mechanical) * sum(numbers) + self.unevenness_of_mean

    @property
    def mechanical(self) -> float:
        """Size of all mechanical loads together."""
        return abs(self.pressure) + self.others

    @cached_property
    def pull(self) -> float:
        """That of the field's load, 0 or positive."""
        return self.last.field**2 * self.field.number(self.lever, self.modulus)

    @property
    def field_share(self) -> float:
        """The field's part of the whole load; of a flat shell that it pushes out of its plane, of what does that."""
        sideways = self.form == "flat" and self.field.pushes_sideways
        whole = self.transverse if sideways else self.pull + self.mechanical
        return self.pull / whole if whole > 0.0 else 0.0

    @cached_property
    def answer(self) -> Answer:
        """Stretch and its response under pressure and pull; where the volume is controlled, the stretch of that."""
        if self.last.volume_ratio is not None and self._found is None:
            return Answer(math.pow(self.last.volume_ratio, 1 / 2 if self.form == "cylinder" else 1 / 3), 0.0)
        if self._found is None and self.form == "flat" and self.transverse == 0.0:
            return Answer(1.0 + self.others / 6, self.others / 6)  # in its plane: Y / (1 - nu) is 6 mu
        return self._found or answer(self.form, self.pressure, self.pull + self.others)

    @property
    def strain(self) -> float:
        """Of the mid-surface."""
        return 0.0 if self.held else abs(self.answer.stretch - 1.0)

    @property
    def deflection(self) -> float:
        """How far the shell moves, over its radius or size."""
        if self.held:
            return 0.0
        if self.form != "flat":
            return self.strain
        beforehand = self._stretched_beforehand
        if beforehand <= 0.0:
            return math.sqrt(2 * self.strain)
        return self.transverse * (self.half / self.size) ** 2 / (2 * beforehand)

    @property
    def half(self) -> float:
        """Half the narrowest extent, in m; the radius of a disc."""
        whole = self.shape.kind == "disc" or self.shape.closed
        return self.shape.narrowest / (1 if whole else 2)

    @property
    def of(self) -> tuple[str, ...]:
        """The scalars whose accuracy counts: those stated, or what counts as the answer of a run (docs/accuracy.md)."""
        stated = self.scene.accuracy.of if self.scene.accuracy is not None else ()
        if stated:
            return stated
        if self.held:
            return ("field_energy",)
        return ("pressure_difference",) if self.controlled else ("displacement",)

    @property
    def held(self) -> bool:
        """Can no point of the shell move?"""
        return any(s.where == "surface" and {"x", "y", "z"} <= set(s.held) for s in self.scene.supports)

    @property
    def controlled(self) -> bool:
        """Is the volume given, and the pressure the answer?"""
        return self.last.volume_ratio is not None

    @cached_property
    def response(self) -> float:
        """Largest |d ln(answer) / d ln(load)| of the answers, or what was found of them."""
        return self._found.response if self._found is not None else max(map(self._response_of, self.of))

    def _response_of(self, name: str) -> float:
        """That of the stretch, c; of a displacement l c / (l - 1), or a third on a flat shell that its own deflection
        tightens; else 1, and at a given volume."""
        stretch, response = self.answer
        if self.controlled and name in (*STRETCHES, "displacement"):
            # the volume of a shell that grows alike everywhere says all; of another it leaves the shape open
            return 0.0 if self.homogeneous or name == "volume_ratio" else 1.0
        if name in STRETCHES:
            return STRETCHES[name] * response
        if not is_displacement(name) or self.controlled:
            return 1.0
        if self.form == "flat":
            return TIGHTENED if self._held_all_around and self._stretched_beforehand == 0.0 else 1.0
        return stretch * response / abs(stretch - 1.0) if abs(stretch - 1.0) > RIGID else 1.0

    @cached_property
    def tension(self) -> float | None:
        """Smallest membrane force over mu T at the ends of the stages with a load; negative in compression, None where
        it is not known: of open shells that are not blown up, and of flat ones that are not held all around."""
        if self.form == "flat":
            return self._flat_tension
        if self.others > 0.0 or not (self.shape.closed or self._held_all_around):
            return None
        share = {"sphere": 0.5, "cylinder": 1.0}[self.form]
        outward = self.field.pull
        nets = []
        for stage in self.scene.path:
            pressure = stage.mechanical * self.pressure_of_full_load
            if stage.volume_ratio is not None:
                pressure = self._of_volume(stage.volume_ratio)
            pull = stage.field**2 * self.field.number(self.lever, self.modulus)
            nets.append(share * (pressure + outward * pull))
        loaded = [net for net in nets if net != 0.0]
        return min(loaded, default=None)

    @property
    def _flat_tension(self) -> float | None:
        stretched = self._stretched_beforehand
        if stretched > 0.0:
            return stretched
        if not self._held_all_around:
            return None
        number = self.transverse / 3
        return 3 * FLAT_TENSION * number ** (2 / 3) if number > 0.0 else None

    @property
    def _held_all_around(self) -> bool:
        """Does every edge of the shape stay where it is?"""
        held = {support.where for support in self.scene.supports if {"x", "y", "z"} <= set(support.held)}
        return bool(self.shape.edges) and set(self.shape.edges) <= held

    @property
    def _stretched_beforehand(self) -> float:
        """Membrane force of edges that are pulled outwards, over mu T."""
        pulls = [
            edge.traction[0] / (self.modulus * self.thickness)
            for edge in self.scene.loads.edge_tractions
            if edge.frame == "edge" or edge.edge == "x1"
        ]
        moved = [abs(s.displacement[0]) + abs(s.displacement[1]) for s in self.scene.supports if _on_edge(s.where)]
        strain = max(moved, default=0.0) / self.size
        return max([*pulls, 4 * strain])

    @cached_property
    def transverse(self) -> float:
        """Of a flat shell, the load number of what pushes it out of its plane."""
        normal = 1 if self.shape.reductions == ("plane-strain",) else 2
        loads = self.scene.loads
        numbers = [abs(self.pressure)]
        if not isinstance(loads.surface_force, ForceField):
            numbers.append(abs(loads.surface_force[normal]) * self.lever / self.modulus)
        weight = loads.body_force[normal] + loads.gravity[normal] * (self.scene.shell.density or 0.0)
        numbers.append(abs(weight) * self.lever * self.thickness / self.modulus)
        bent = self.others if loads.point_loads or isinstance(loads.surface_force, ForceField) else 0.0
        return sum(numbers) + bent + (self.pull if self.field.pushes_sideways else 0.0)

    @property
    def homogeneous(self) -> bool:
        """Is the answer the same everywhere, and known in closed form? A sphere or infinite cylinder of uniform
        thickness and material under uniform pressures, alone or at a voltage or charge in open space."""
        scene, shell = self.scene, self.scene.shell
        uniform = not shell.regions and not isinstance(shell.thickness, ThicknessField)
        pressed = not scene.loads.pressure_fields and self.others == 0.0 and not scene.supports
        return uniform and pressed and self.shape.kind in ("sphere", "infinite-cylinder") and self.field.uniform


def is_displacement(name: str) -> bool:
    """Is a scalar one of the displacements that every step records?"""
    return name == "displacement" or name.startswith("u_")


def _on_edge(where: object) -> bool:
    return isinstance(where, str) and where != "surface"


def _spread(values: Sequence[float]) -> float:
    return (max(values) - min(values)) / 2
