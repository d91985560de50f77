"""What every term that a plan may leave out is worth: relative errors of the answer, estimated from the scene alone.

Each is the part of the load that the term changes, times the response of the answer to the load. ``None``: not known,
and then the term stays. Coefficients are measured: docs/planner.md.
"""

from __future__ import annotations

import math
from functools import cached_property

from embedding.plan.coefficients import BENT, CLOSED_FACES, MEMBRANE, ON_FACES, OWN_FIELD, ROBIN, SHEAR, TWICE
from embedding.plan.loading import Loading
from embedding.plan.response import Answer, bending_share
from embedding.scene import Scene
from embedding.scene.checks_electrodes import one_conductor


class Effects:
    """The worth of every term of ``scene``, with the stretch and response of the simplest shell of its kind, or with
    those ``found``."""

    def __init__(self, scene: Scene, found: Answer | None = None) -> None:
        self.scene, self.loading = scene, Loading(scene, found)
        self.shape, self.field = scene.shell.shape, self.loading.field

    @property
    def slenderness(self) -> float:
        """Thickness over radius of curvature, deformed; over the size of a flat shell."""
        loading = self.loading
        if loading.radius is None:
            return loading.thickness / loading.size
        thinner = max(loading.answer.stretch, 1.0) ** (2 if loading.form == "cylinder" else 3)
        return loading.slenderness / thinner

    @property
    def thinness(self) -> float:
        """Thickness now over the radius of curvature at rest; 0 for a flat shell."""
        loading = self.loading
        return loading.slenderness / max(loading.answer.stretch, 1.0) ** (1 if loading.form == "cylinder" else 2)

    def thin_shell(self, *, bending: bool) -> float:
        """What shell theory itself misses: of a curved wall that is stretched; transverse shear of one that is bent."""
        curved = (BENT if bending else MEMBRANE) * self.thinness**2
        sheared = bending and not self.shape.closed
        shear = SHEAR * (self.loading.thickness / self.shape.narrowest) ** 2 if sheared else 0.0
        return self.loading.response * curved + shear

    @cached_property
    def bending_number(self) -> float | None:
        """Bending stiffness against membrane tension, D / (N a^2), a half the narrowest extent; None where the tension
        is not known, infinite in compression."""
        tension = self.loading.tension
        if tension is None:
            return None
        if tension <= 0.0:
            return math.inf
        return self._stiffness / 12 * (self.loading.thickness / self.loading.half) ** 2 / tension

    @property
    def _stiffness(self) -> float:
        """Y / (1 - nu^2) over mu."""
        poisson = getattr(self.scene.shell.material, "poisson_ratio", 0.5)
        return float(2 / (1 - poisson))

    @property
    def walls_cancel(self) -> bool:
        """Is the load on a curved wall for the most part that of electrodes? What a thick wall resists more, and what
        the field on or in it pulls more, then cancel for the most part: bending, which has the first alone, makes it
        worse (problems/charged_balloon, problems/dielectric_balloon)."""
        driven = bool(self.scene.faces.electrodes) and self.loading.field_share > 0.5
        return self.loading.radius is not None and driven

    @cached_property
    def bending(self) -> float | None:
        """What bending adds to the load that a membrane carries: of a flat one with hinged ends 2 D / (N a^2), of a
        curved one what stretching it bends, and its rims."""
        loading = self.loading
        if loading.form == "flat" and loading.transverse == 0.0:
            return 0.0
        if self.walls_cancel:
            return None
        number = self.bending_number
        if number is None or math.isinf(number):
            return number
        if loading.form == "flat":
            return loading.response * 2 * number
        rims = 0.0 if self.shape.closed else number
        share = bending_share(loading.form, loading.answer.stretch)
        return loading.response * (share * loading.slenderness**2 + rims)

    @property
    def mean_pressure(self) -> float:
        """What the mean of both face pressures is worth: it pushes where it varies, and squeezes a shell with rims."""
        loading = self.loading
        push = loading.unevenness_of_mean
        push += loading.mean_pressure if self.shape.edges and not self.shape.closed else 0.0
        whole = loading.mechanical + loading.pull + (loading.mean_pressure if self.shape.edges else 0.0)
        return loading.response * push / whole if whole > 0.0 else 0.0

    @property
    def closed_faces(self) -> float:
        """What the true places of the faces are worth: their distance over the radius, or over the gap to what stands
        beside the shell; and the space that is counted twice."""
        loading = self.loading
        off = max(self.slenderness, loading.thickness / self.field.gap_to())
        return loading.response * loading.field_share * (CLOSED_FACES * off + self.counted_twice)

    @property
    def counted_twice(self) -> float:
        """Between closed faces lies no space, and the shell's is there once as the shell and once as free space: of its
        own load, that is the more the less it differs."""
        if one_conductor(self.scene) or self.field.film_voltage:
            return 0.0
        induced = self.field.induced
        return TWICE / induced if induced > 0.0 else math.inf

    @property
    def field_felt(self) -> float:
        """What the field is worth beside the mechanical loads; all of it where it pushes a flat shell out of its
        plane."""
        sideways = self.loading.form == "flat" and self.field.pushes_sideways
        return (1.0 if sideways else self.loading.response) * self.loading.field_share

    @property
    def surroundings(self) -> float | None:
        """What the field around two electrodes is worth beside that between them; None where there are none."""
        if not self.field.film_voltage:
            return None
        return self.loading.response * self.loading.field_share * self.field.outside_share

    @property
    def perturbation(self) -> float | None:
        """What the shell does to an applied field that acts on it; None where something else acts. In a uniform field
        that is all that acts on matter without remanence."""
        field, loading = self.field, self.loading
        if not field.given or self.scene.faces.electrodes or (self.scene.ambient and self.scene.ambient.bodies):
            return None
        own = OWN_FIELD * field.remanence / (field.constant * field.given) * loading.thickness / loading.size
        alone = field.in_uniform_field and not field.remanence
        return loading.response * loading.field_share * (1.0 if alone else field.susceptibility + own)

    @property
    def coupling(self) -> float:
        """What the change of the field's forces with the shape is worth.

        They change by twice the strain (on a sphere at a voltage in open space only by the way of the face to the
        mid-surface), twice the part of a gap to a conductor that the shell crosses, and seven times that to a magnet,
        whose pull on matter falls with the seventh power of the distance.
        """
        loading, field = self.loading, self.field
        held = all(electrode.voltage is not None for electrode in self.scene.faces.electrodes.values())
        same = loading.homogeneous and field.conducting and held
        length = loading.radius or loading.size
        change = ON_FACES * self.loading.thickness / length * loading.strain if same else 2 * loading.deflection
        near = 2 / min(field.gap_to(conducting=True), field.grounded_at - length)
        crossed = loading.deflection * length * max(near, 7 / field.gap_to(conducting=False))
        return loading.response * loading.field_share * max(change, crossed)

    def far_field(self, ratio: float) -> float:
        """What a Robin condition misses where the shell and the bodies reach to ``ratio`` of its radius."""
        loading = self.loading
        grown = ratio * min(loading.answer.stretch, 2.0)
        return loading.response * loading.field_share * ROBIN * grown**5
