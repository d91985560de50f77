"""How hard the field of a scene loads its shell: Maxwell stresses of closed forms for spheres, films and gaps.

What is worth a pressure on a shell (times R / T over mu), and what is a stress in its wall, is told apart:

* a conductor with the field E on it feels the pressure eps E^2 / 2: E = V / R in open space, dV / gap beside another
  conductor, Q / (eps A) with a charge, 3 E_0 in an applied field (a sphere's poles);
* a film between electrodes the stress eps_r eps (dV / T)^2, twice that as a load number of a sphere;
* other matter of susceptibility chi the stress eps x H^2 / (1 + chi T / R), x = chi, in a field H that is given around
  it, and x = chi^2 / (1 + chi) where H is uniform: nothing is pulled by that but by its own change of it;
* a magnet the stress b_r H, and b_r^2 / mu0 (T / R) of its own field.

Source: J. D. Jackson, Classical Electrodynamics, sections 1.5, 2.5, 5.10.
"""

from __future__ import annotations

import math
from functools import cached_property

from embedding.scene import Ambient, Scene, Shape
from embedding.scene.bodies import Solid
from embedding.scene.checks_electrodes import one_conductor
from embedding.scene.checks_field import applied, axes_of, varying
from embedding.scene.scales import EPSILON_0, MU_0

GROUND = 4.0
"""Radius of a grounded boundary that the plan chooses, in shell sizes."""


class FieldLoading:
    """The field of ``scene`` at full strength, in SI units, and what it does to the shell."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self.shape = scene, scene.shell.shape
        self.ambient = scene.ambient

    @property
    def constant(self) -> float:
        """eps0 or mu0 of what fills the space."""
        if self.ambient is None:
            return EPSILON_0
        return self.ambient.contrast * (EPSILON_0 if self.ambient.field == "electric" else MU_0)

    def number(self, lever: float, modulus: float) -> float:
        """The load number at full strength, for a shell with R / T = ``lever`` and shear modulus ``modulus``."""
        if self.ambient is None:
            return 0.0
        if self.conducting:
            return 0.5 * self.constant * self.strength**2 * lever / modulus
        return (self._film + 0.5 * self.constant * self._outside**2 * lever + self._matter(1 / lever)) / modulus

    @property
    def conducting(self) -> bool:
        """Is the whole shell one conductor?"""
        return one_conductor(self.scene)

    @property
    def pull(self) -> int:
        """Does the field pull the shell outwards everywhere, 1; is it all within its wall, where it makes no tension,
        0; or may it push it inwards, -1?"""
        if self.conducting:
            return 1
        return 0 if self._film > 0.0 and not self.around else -1

    @property
    def around(self) -> bool:
        """Is there a field around the shell that is not the shell's own?"""
        return self.ambient is not None and (applied(self.scene) or bool(self.ambient.bodies))

    @property
    def pushes_sideways(self) -> bool:
        """Does it push a flat shell out of its plane? Not the field between two electrodes alone."""
        return self.ambient is not None and (self.around or bool(self.scene.shell.carried))

    @property
    def uniform(self) -> bool:
        """Is a sphere or an infinite cylinder pulled the same everywhere, or not at all?"""
        ambient = self.ambient
        if ambient is None:
            return True
        return not self.around and not self.scene.shell.carried and ambient.box is None

    @cached_property
    def strength(self) -> float:
        """The field on a conducting shell: of its voltage or charge, of other conductors, of the applied field."""
        electrodes = self.scene.faces.electrodes.values()
        voltage = max((abs(e.voltage) for e in electrodes if e.voltage is not None), default=0.0)
        charge = max((abs(e.charge) for e in electrodes if e.charge is not None), default=0.0)
        own = voltage / self._distance + charge / (self.constant * self._area)
        beside = self._beside(next((e.voltage for e in electrodes if e.voltage is not None), None))
        return max(own, beside) + 3.0 * self.given

    @cached_property
    def given(self) -> float:
        """The applied field, the largest of a few points of the shell, and that of magnets and poles beside it."""
        ambient = self.ambient
        if ambient is None:
            return 0.0
        found = math.hypot(*ambient.uniform_field)
        if ambient.varying_field is not None:
            points = self.shape.sample_points()
            parts = [max(map(abs, part.values_at(points)), default=0.0) for part in ambient.varying_field.components]
            found = math.hypot(*parts)
        for line in ambient.line_currents:
            found += abs(line.current) / (2 * math.pi * _distance_to(line.through, line.along, self.shape))
        return found + max((self._of_body(ambient, body) for body in ambient.bodies if body.remanence), default=0.0)

    def _of_body(self, ambient: Ambient, body: Solid) -> float:
        """Of a magnet: at most half its remanence, less with the cube of the distance."""
        near = self._gap(body)
        size = body.farthest(3) - math.hypot(*getattr(body, "centre", (0.0, 0.0, 0.0)))
        return math.hypot(*(body.remanence or (0.0,))) / (2 * MU_0) * (size / (size + near)) ** 3

    def _beside(self, voltage: float | None) -> float:
        """The largest field across a gap to a conductor beside the shell."""
        bodies = self.ambient.bodies if self.ambient is not None else ()
        found = [0.0]
        for body in bodies:
            if body.is_conductor:
                level = body.voltage if body.voltage is not None else body.potential or 0.0
                found.append(abs((voltage or 0.0) - level) / self._gap(body))
        return max(found)

    def _gap(self, body: Solid) -> float:
        axes = axes_of(self.scene)
        return max(min(body.clearance(point, axes) for point in self.shape.sample_points()), 1e-300)

    def gap_to(self, *, conducting: bool | None = None) -> float:
        """Narrowest distance to a body, or to one that is a conductor or not, in m; infinite without any."""
        bodies = self.ambient.bodies if self.ambient is not None else ()
        gaps = (self._gap(body) for body in bodies if conducting in (None, body.is_conductor))
        return min(gaps, default=math.inf)

    @cached_property
    def grounded_at(self) -> float:
        """Radius of a grounded boundary, in m; infinite in open space."""
        ambient = self.ambient
        if ambient is None or ambient.outer != "grounded":
            return math.inf
        if ambient.box is not None:
            return min(ambient.box[: axes_of(self.scene)])
        return ambient.radius or GROUND * self.shape.size

    @property
    def _distance(self) -> float:
        """What divides the voltage of a shell by the field on it: R (1 - R/G) or R ln(G/R) to a ground at G."""
        size = self.shape.size
        if axes_of(self.scene) == 3:
            return size * (1 - size / self.grounded_at)
        return size * math.log(self.grounded_at / size) if math.isfinite(self.grounded_at) else math.inf

    @property
    def _area(self) -> float:
        """Of the outer face, both faces of an open shell; in plane strain its length."""
        size = self.shape.size
        return 4 * math.pi * size**2 if axes_of(self.scene) == 3 else 2 * math.pi * size

    @cached_property
    def film_voltage(self) -> float:
        """Voltage between two electrodes on the faces, from a charge by the area of a sphere; 0 without them."""
        top, bottom = self.scene.faces.top, self.scene.faces.bottom
        if self.conducting or top is None or bottom is None:
            return 0.0
        if top.voltage is not None and bottom.voltage is not None:
            return abs(top.voltage - bottom.voltage)
        charge = max(abs(e.charge or 0.0) for e in (top, bottom))
        return charge * self.scene.shell.thickest / (self._permittivity * self._area)

    @property
    def _permittivity(self) -> float:
        return EPSILON_0 * (self.scene.shell.relative_permittivity or 1.0)

    @property
    def _film(self) -> float:
        """Twice the stress between two electrodes."""
        return 2 * self._permittivity * (self.film_voltage / self.scene.shell.thickest) ** 2

    @property
    def _outside(self) -> float:
        """The field on the outer one of two electrodes."""
        top = self.scene.faces.top
        if self.conducting or top is None or not self.shape.closed:
            return 0.0
        charge = abs(top.charge or 0.0) / (self.constant * self._area)
        return abs(top.voltage or 0.0) / self._distance + (0.0 if self.film_voltage else charge)

    @property
    def outside_share(self) -> float:
        """Of the load of two electrodes, that of the field around them."""
        lever = (self.shape.curvature_radius or self.shape.size) / self.scene.shell.thickest
        around = 0.5 * self.constant * self._outside**2 * lever
        whole = around + self._film
        return around / whole if whole > 0.0 else 1.0

    @property
    def susceptibility(self) -> float:
        """chi of the shell against what fills the space, the largest of its regions, as far as it is not saturated."""
        shell, ambient = self.scene.shell, self.ambient
        if ambient is None:
            return 0.0
        name = "relative_permittivity" if ambient.field == "electric" else "relative_permeability"
        stated = [getattr(part, name) for part in (shell, *shell.regions)]
        chi = max((abs(value / ambient.contrast - 1) for value in stated if value is not None), default=0.0)
        if shell.saturation is not None and self.given > 0.0:
            chi = min(chi, shell.saturation / (MU_0 * self.given))
        return chi

    @property
    def in_uniform_field(self) -> bool:
        """Is the field around the shell the same everywhere, but for what the shell does to it?"""
        ambient = self.ambient
        return ambient is not None and not ambient.bodies and not varying(self.scene)

    @property
    def induced(self) -> float:
        """What pulls on matter in a field, over eps H^2."""
        chi = self.susceptibility
        return chi**2 / (1 + chi) if self.in_uniform_field else chi

    @property
    def remanence(self) -> float:
        """Size of what the shell carries: b_r in T, or a polarisation in C/m^2."""
        points = self.shape.sample_points()
        found = [0.0]
        for vector in self.scene.shell.carried.values():
            parts = vector if isinstance(vector, tuple) else [
                max(map(abs, part.values_at(points)), default=0.0) for part in vector.components
            ]
            found.append(math.hypot(*parts))
        return max(found)

    def _matter(self, slenderness: float) -> float:
        """Stress of what the shell is made of, in the field around it and in its own."""
        given = max(self.given, self._beside(None))
        induced = self.constant * self.induced * given**2 / (1 + self.susceptibility * slenderness)
        return induced + self.remanence * given + self.remanence**2 / self.constant * slenderness


def _distance_to(through: tuple[float, ...], along: tuple[float, ...], shape: Shape) -> float:
    """Smallest distance of a few points of a shape from a line."""
    size = math.hypot(*along)
    t = [c / size for c in along]
    found = []
    for point in shape.sample_points():
        away = [p - c for p, c in zip(point, through, strict=True)]
        beside = sum(a * b for a, b in zip(away, t, strict=True))
        found.append(math.dist(away, [beside * c for c in t]))
    return max(min(found), 1e-300)
