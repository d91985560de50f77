"""Scenes whose answer is known from elsewhere: one scalar at the end of the path, and its value.

What accuracy costs, how far error estimates can be trusted, and whether an accuracy asked for is reached, is measured
on all of them (`benchmarks.effectivity`, `benchmarks.dial`, `benchmarks.trades`). A value "solid" is that of the
three-dimensional body, which a shell with its faces in a field only comes close to; one of "theory" is that of the
equations that are solved. ``scatter`` is how far the known value itself can be trusted, relative.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Literal

import numpy as np
from scipy.optimize import brentq

from embedding import Scene, Solution, load_scene
from embedding.scene.scales import EPSILON_0
from problems import (
    cantilever_shear,
    capacitances,
    charged_balloon,
    charged_disc,
    circular_membrane,
    cylinder_inflation,
    dielectric_balloon,
    dielectric_tube,
    grounded_balloon,
    hard_magnetic_cantilever,
    hemisphere_with_hole,
    hencky_membrane,
    open_tube,
    permeable_cylinder,
    permeable_sphere,
    plate_squeeze,
    slit_annulus,
    sphere_in_field,
    sphere_inflation,
    varying_pressure_sphere,
)
from problems.common import law_of, thickness_ratio
from problems.exact import charged_disc as exact_disc
from problems.exact import circular_membrane as exact_membrane
from problems.exact import conducting_spheres, cylinder, hard_magnetic_elastica, hencky, plate, sphere
from problems.exact import open_tube as exact_tube
from problems.published import sze_cylinders, sze_strips

OF_SOLIDS = ("thickness", "shear", "curling", "opened faces", "closed faces")
"""Sources of errors that are those of the theory against the solid body."""
THIN = "shell.thickness=2e-8"
"""Of shells whose faces are at the mid-surface, as far as the reference knows."""
APEX = "output.points={apex=[0, 0, 0]}"


@dataclass(frozen=True)
class Known:
    """The scalar ``of`` at the end of the path of ``scene`` and its ``value`` in SI units."""

    name: str
    scene: Scene
    of: str
    value: float
    kind: Literal["solid", "theory"]
    scatter: float = 0.0

    def error(self, solution: Solution) -> float:
        """Relative error of what a solve of the scene found."""
        return abs(float(solution[self.of][-1]) / self.value - 1.0)

    def estimate(self, solution: Solution) -> float:
        """What the solve itself says of that: where a theory is the reference, without what it leaves out of solids."""
        parts = solution.errors[self.of].parts
        return sum(part for source, part in parts.items() if self.kind == "solid" or source not in OF_SOLIDS)


def _moved(scene: Scene, stretch: float) -> float:
    """Displacement of a sphere or a tube that grows everywhere alike."""
    return float(scene.shell.shape.size) * (stretch - 1.0)


# -- thick walls


def _charged_balloon(*changes: str) -> tuple[Scene, float]:
    stated = charged_balloon.scene(*changes)
    top = stated.faces.top
    if top is None or top.voltage is None:
        raise ValueError("the balloon is at a voltage")
    return stated, charged_balloon.exact(stated).stretch(float(top.voltage))


def balloons() -> Iterator[Known]:
    """Balloons and tubes against the exact thick wall."""
    for ratio in (0.1, 0.05, 0.01):
        stated, stretch = _charged_balloon(*charged_balloon.at(ratio, 1.3))
        yield Known(f"charged balloon T/R {ratio:g}", stated, "displacement", _moved(stated, stretch), "solid")
    stated, stretch = _charged_balloon()
    shell, voltage = charged_balloon.exact(stated), 600e3
    yield Known("charged balloon, charge", stated, "charge", shell.charge(stretch, voltage), "solid")
    stated = grounded_balloon.scene()
    top = stated.faces.top
    if top is None or top.voltage is None:
        raise ValueError("the balloon is at a voltage")
    stretch = grounded_balloon.exact(stated).stretch(float(top.voltage))
    yield Known("grounded balloon", stated, "displacement", _moved(stated, stretch), "solid")
    for ratio in (0.1, 0.025):
        stated = dielectric_balloon.scene(*dielectric_balloon.at(ratio))
        pressure = stated.loads.pressure_bottom
        if not isinstance(pressure, float):
            raise ValueError("the balloon has a uniform pressure")
        stretch = dielectric_balloon.exact(stated).stretch(dielectric_balloon.voltage(stated), pressure)
        yield Known(f"dielectric balloon T/R {ratio:g}", stated, "displacement", _moved(stated, stretch), "solid")
    stated = dielectric_tube.scene()
    stretch = dielectric_tube.exact(stated).stretch(dielectric_balloon.voltage(stated))
    yield Known("dielectric tube", stated, "displacement", _moved(stated, stretch), "solid")
    for ratio in (0.1, 0.02):
        stated = cylinder_inflation.scene(*cylinder_inflation.at_thickness(ratio), "discretisation.order=3")
        stretch = cylinder.thick_stretch(0.8 * 100e3 * ratio, ratio, law_of(stated), 1.0)
        yield Known(f"inflated tube T/R {ratio:g}", stated, "displacement", _moved(stated, stretch), "solid")
    stated = open_tube.scene("discretisation.order=3")
    hoop, _ = exact_tube.exact_stretches(32e3, 30e3, thickness_ratio(stated), law_of(stated))
    yield Known("open tube", stated, "stretch", hoop, "solid")
    inflating = "path=[{volume_ratio = 2.197, steps = 4}]"
    for thickness in (0.2, 1.0):
        stated = sphere_inflation.scene(inflating, f"shell.thickness={thickness} mm", "discretisation.order=3")
        pressure, _ = sphere.PRESSURES["thick"]
        known = pressure(1.3, thickness_ratio(stated), law_of(stated))
        yield Known(f"inflated balloon T/R {thickness / 20:g}", stated, "pressure_difference", known, "solid")
    stated = varying_pressure_sphere.scene("discretisation.order=3")
    yield Known("varying pressure", stated, "displacement", _rms_of_solid(stated), "solid", 1e-5)


def _rms_of_solid(scene: Scene) -> float:
    """Root mean square displacement of the mid-surface of the thick solid."""
    cosine, weights = np.polynomial.legendre.leggauss(30)
    upper = cosine > 0.0
    angles = np.sort(np.arccos(cosine[upper]))
    weight = weights[upper][np.argsort(np.arccos(cosine[upper]))]
    found = varying_pressure_sphere.reference(scene, angles)
    squared = (found.r - np.sin(angles)) ** 2 + (found.z - np.cos(angles)) ** 2
    return float(scene.shell.shape.size * math.sqrt(weight @ squared / weight.sum()))


# -- fields around shells that keep their shape


def conductors() -> Iterator[Known]:
    """Charges of conductors alone, in pairs and over a plane; forces and pulls in a field."""
    for name, conductor in {**capacitances.SMOOTH, **capacitances.RIMMED}.items():
        stated = capacitances.scene(f"shell.shape={conductor.shape}", THIN)
        yield Known(f"capacitance: {name}", stated, "charge", 10e3 * conductor.known, "theory")
    distance, radii = 0.04, (capacitances.R, capacitances.OTHER)
    pair = conducting_spheres.two_spheres(*radii, distance, EPSILON_0)
    stated = capacitances.scene(capacitances.second_sphere(distance), THIN)
    yield Known("two spheres: charge", stated, "charge", 10e3 * pair.c11, "theory")
    yield Known("two spheres: induced charge", stated, "charge_body0", 10e3 * pair.c12, "theory")
    force = -conducting_spheres.repulsion(*radii, distance, (10e3, 0.0), EPSILON_0)
    yield Known("two spheres: force", stated, "force_z", force, "theory")
    stated = capacitances.scene(capacitances.plane(0.03), THIN)
    known = 10e3 * conducting_spheres.sphere_and_plane(capacitances.R, 0.03, EPSILON_0)
    yield Known("sphere over a plane", stated, "charge", known, "theory")
    stated = sphere_in_field.scene(*sphere_in_field.HELD, THIN)
    pull = -1.5 * EPSILON_0 * sphere_in_field.applied(stated) ** 2
    yield Known("sphere in a field: pull", stated, "pressure_top", pull, "theory")
    stated = sphere_in_field.scene(*sphere_in_field.HELD, THIN, "faces.both={charge = 2e-8}")
    yield Known("sphere in a field: force", stated, "force_z", 2e-8 * sphere_in_field.applied(stated), "theory")


def permeable() -> Iterator[Known]:
    """Mean pressures of a field on permeable shells that keep their shape."""
    for ratio in (0.1, 0.025):
        stated = permeable_sphere.scene(*permeable_sphere.rigid(ratio, 10.0))
        cosine, weights = np.polynomial.legendre.leggauss(20)
        known = permeable_sphere.reference(stated, np.arccos(cosine))["p_t"] @ weights / 2.0
        yield Known(f"permeable sphere T/R {ratio:g}", stated, "pressure_top", float(known), "solid")
    stated = permeable_cylinder.scene(*permeable_cylinder.rigid(0.05, 10.0))
    tube, angles = permeable_cylinder.exact(stated), 2.0 * math.pi * np.arange(64) / 64
    known = np.mean([tube.tractions(float(angle))[0] for angle in angles])
    yield Known("permeable tube", stated, "pressure_top", float(known), "solid")


# -- flat membranes and bent shells


def membranes() -> Iterator[Known]:
    """Flat sheets that are stretched or blown up."""
    stated = charged_disc.scene("faces.both={voltage = 100}", "path=[{steps = 1}]")
    stiffness = 6.0 * 30e3 * float(stated.shell.thickest)
    strain = exact_disc.edge_force(0.02, 100.0, EPSILON_0) / stiffness
    yield Known("charged disc: strain", stated, "displacement", 0.02 * strain / math.sqrt(2.0), "theory", 1e-6)
    stated = load_scene(circular_membrane.SCENE, ("path=[{}]", APEX))
    law = law_of(stated)
    high = brentq(lambda w: exact_membrane.at_deflection(w, law).pressure - 1.0, 0.1, 0.6, xtol=1e-14)
    yield Known("blown-up membrane", stated, "u_apex_z", circular_membrane.RADIUS * float(high), "theory")
    stated = load_scene(hencky_membrane.SCENE, (APEX,))
    known = 0.1 * hencky.hencky(0.3).deflection * 1e-2  # (p a / (E h))^(1/3) = 1e-2
    yield Known("Hencky's membrane", stated, "u_apex_z", known, "theory", 3e-5)
    stated = plate_squeeze.scene()
    pressure = stated.loads.pressure_top
    if not isinstance(pressure, float):
        raise ValueError("the plate is under a uniform pressure")
    yield Known("squeezed plate", stated, "stretch", plate.squeeze_stretch(pressure, law_of(stated)), "solid")


def bent() -> Iterator[Known]:
    """Strips and surfaces that bend."""
    stated = load_scene(cantilever_shear.SCENE, ("output.points={tip=[10, 0, 0]}",))
    known = cantilever_shear.reference()
    yield Known("cantilever: deflection", stated, "u_tip_y", known["deflection"], "theory")
    yield Known("cantilever: shortening", stated, "u_tip_x", -known["shortening"], "theory")
    stated = hard_magnetic_cantilever.scene(
        *hard_magnetic_cantilever.strip(0.002, 5.0), "output.points={tip=['17.2 mm', 0, 0]}"
    )
    tip = hard_magnetic_elastica.tip(5.0)
    yield Known("hard-magnetic strip", stated, "u_tip_y", 17.2e-3 * tip.deflection, "theory", 2e-5)
    stated = load_scene(hemisphere_with_hole.SCENE, ("output.points={in=[0, 10, 0], out=[10, 0, 0]}",))
    table = sze_cylinders.HEMISPHERE.table
    yield Known("hemisphere with a hole: out", stated, "u_out_x", float(table["outward"][-1]), "theory", 5e-3)
    yield Known("hemisphere with a hole: in", stated, "u_in_y", -float(table["inward"][-1]), "theory", 5e-3)
    stated = load_scene(slit_annulus.SCENE, ("output.points={outer=[10, -1e-12, 0]}",))
    outer = float(sze_strips.SLIT_ANNULUS.table["outer"][-1])
    yield Known("slit annulus", stated, "u_outer_z", outer, "theory", 5e-3)


# -- loads that take the shell to a displacement


def loads() -> Iterator[Known]:
    """The voltage at which a balloon has grown to a size, and the pressure of a membrane beyond its limit point."""
    radius, stretch = 20e-3, 1.3
    until = f"{{where=[0, 0, {radius}], axis='z', value={radius * (stretch - 1.0)}}}"
    stated = charged_balloon.scene("shell.thickness=1 mm", f"path=[{{until={until}}}]")
    voltage = charged_balloon.exact(stated).voltage(stretch)
    yield Known("charged balloon, up to a size", stated, "voltage", voltage, "solid")
    stated = load_scene(circular_membrane.SCENE, ())
    law, high = law_of(stated), stated.path[0].until
    if high is None:
        raise ValueError("the membrane is blown up to a height")
    known = exact_membrane.at_deflection(high.value / circular_membrane.RADIUS, law).pressure
    pressure = known * law.shear_modulus * thickness_ratio(stated)
    yield Known("blown-up membrane, up to a height", stated, "pressure_difference", pressure, "theory")


@cache
def all_known() -> tuple[Known, ...]:
    """Every scene with a known answer."""
    groups: tuple[Callable[[], Iterator[Known]], ...] = (balloons, conductors, permeable, membranes, bent, loads)
    return tuple(known for group in groups for known in group())
