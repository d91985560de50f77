"""Blocked force and free stroke of a dielectric disc with electrodes, over voltage and prestretch.

Physics: opposite charges squeeze the disc; it widens by its free stroke, or pushes on a ring that holds its rim with
its blocked force. Both grow with the voltage; prestretch thins the disc and makes both larger, and pull-in nearer.

Reference: the uniform film. A voltage V takes eps V^2 l^3 / T of the tension mu T (l - l^-5) - eps V^2 l^3 / T per
reference length of the rim, at the stretch l: the blocked force. The free stroke is that of
`problems.exact.dielectric_film` under the dead tension (X. Zhao, Z. Suo, Appl. Phys. Lett. 91 (2007) 061921).

Run: about fifteen seconds.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from embedding import NeoHookean, Scene
from embedding.scene.scales import EPSILON_0
from embedding.studies import StudyResult, charts
from embedding.studies.charts import Axis
from problems.common import law_of
from problems.exact.dielectric_film import DielectricFilm
from problems.studies import common

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAME = "disc_force"
VOLTAGE = Axis("faces.bottom.voltage", "voltage", "kV")
PRESTRETCH = Axis("prestretch", r"prestretch $\lambda_p$")
QUANTITIES = {
    "force": Axis("force", "blocked force (whole rim)", "N"),
    "stroke": Axis("stroke", "free stroke (growth of the radius)", "mm"),
}


def complete(result: StudyResult) -> StudyResult:
    """Adds prestretch, blocked force in N and free stroke in m, and the known ones."""
    found = [measured(scene, row.quantities) for scene, row in common.cases(result)]
    references = [known(scene) for scene, _ in common.cases(result)]
    result = result.with_quantity("prestretch", [prestretch(scene) for scene, _ in common.cases(result)])
    for number, (name, unit) in enumerate((("force", "N"), ("stroke", "m"))):
        result = result.with_quantity(name, [one[number] for one in found], unit)
        result = result.with_quantity(f"{name}_known", [one[number] for one in references], unit)
    return result


def prestretch(scene: Scene) -> float:
    """Of the rim where it is blocked."""
    until = scene.path[-1].until
    assert until is not None
    return 1.0 + until.value / scene.shell.shape.size


def measured(scene: Scene, quantities: dict[str, float]) -> tuple[float, float]:
    """Blocked force and free stroke of a case from its numbers."""
    radius, tension = scene.shell.shape.size, scene.loads.edge_tractions[0].traction[0]
    force = 2.0 * math.pi * radius * tension * (1.0 - quantities["tension"])
    return force, radius * (quantities["widest"] - quantities["blocked"])


def known(scene: Scene) -> tuple[float, float]:
    """The same of the uniform film; nan where it pulls in under the dead tension before."""
    shell, electrode, tension = scene.shell, scene.faces.bottom, scene.loads.edge_tractions[0].traction[0]
    assert electrode is not None and electrode.voltage is not None and shell.relative_permittivity is not None
    assert isinstance(shell.material, NeoHookean)
    permittivity, thickness, radius = shell.relative_permittivity * EPSILON_0, shell.thickest, shell.shape.size
    film = DielectricFilm(thickness, law_of(scene), permittivity, load=tension / thickness)
    try:
        stroke = radius * (film.stretch(electrode.voltage) - film.unelectrified)
    except ValueError:
        return np.nan, np.nan
    line = permittivity * electrode.voltage**2 * film.unelectrified**3 / thickness
    return 2.0 * math.pi * radius * line, stroke


def errors(result: StudyResult) -> dict[str, float]:
    """Largest errors over the largest value; number of cases of which only one side pulls in."""
    columns = result.columns()
    told = {}
    for name in QUANTITIES:
        found, reference = np.array(columns[name]), np.array(columns[f"{name}_known"])
        told[f"largest error of the {name}"] = float(np.nanmax(np.abs(found - reference)) / np.nanmax(reference))
    told["cases that pull in on one side only"] = float(np.sum(np.isfinite(found) != np.isfinite(reference)))
    return told


def draw(result: StudyResult) -> Figure:
    """Force and stroke over the voltage, a line for each prestretch."""
    figure, axes = charts.figure_of(2)
    for one, (name, axis) in zip(axes, QUANTITIES.items(), strict=True):
        reference = Axis(f"{name}_known", "uniform film, closed form", axis.unit)
        charts.draw_lines(one, result, VOLTAGE, axis, family=PRESTRETCH, reference=reference)
    axes[1].get_legend().remove()
    return figure


if __name__ == "__main__":
    common.main(NAME, complete, draw, errors)
