"""Stroke of a dielectric balloon against voltage, over pre-pressure and thickness: 240 cases.

Physics: the pressure blows the balloon up, the voltage across its wall widens it further: the stroke. The higher the
pressure, the softer the balloon and the larger the stroke at a voltage, until it pulls in.

Reference: the thin balloon in closed form, `problems.exact.dielectric_balloon` (J. Zhu, S. Cai, Z. Suo, Polym. Int. 59
(2010) 378): stretches, and which cases have no equilibrium.

Run: two minutes on two processors, as the cases are axisymmetric and only the field in the wall is modelled.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from embedding import Scene
from embedding.studies import StudyResult, charts
from embedding.studies.charts import Axis
from problems.dielectric_balloon import exact, voltage
from problems.studies import common

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAME = "balloon_stroke"
THICKNESS = Axis("shell.thickness", "$T$", "mm")
PRESSURE = Axis("loads.pressure_bottom", "$p$", "Pa")
VOLTAGE = Axis("faces.bottom.voltage", "voltage", "kV")
STROKE = Axis("stroke", "stroke (growth of the radius)", "mm")
KNOWN = Axis("stroke_known", "thin balloon, closed form", "mm")


def complete(result: StudyResult) -> StudyResult:
    """Adds the stroke, how much the voltage widens the radius, and the one known, m."""
    strokes = [
        scene.shell.shape.size * (row.quantities["stretch"] - row.quantities["inflated"])
        for scene, row in common.cases(result)
    ]
    references = [known(scene)[1] for scene, _ in common.cases(result)]
    return result.with_quantity("stroke", strokes, "m").with_quantity("stroke_known", references, "m")


def known(scene: Scene) -> tuple[float, float]:
    """Stretch and stroke (m) of the thin balloon; nan beyond its pull-in."""
    balloon, pressure = exact(scene, "membrane"), scene.loads.pressure_bottom
    assert isinstance(pressure, float)
    try:
        stretch = balloon.stretch(voltage(scene), pressure)
    except ValueError:
        return np.nan, np.nan
    return stretch, balloon.radius * (stretch - balloon.stretch(0.0, pressure))


def errors(result: StudyResult) -> dict[str, float]:
    """Largest error of the stretch; number of cases of which only one side has an equilibrium."""
    pairs = np.array([(row.quantities["stretch"], known(scene)[0]) for scene, row in common.cases(result)])
    there = np.isfinite(pairs)
    return {
        "largest error of the stretch": float(np.nanmax(np.abs(pairs[:, 0] - pairs[:, 1]))),
        "cases that pull in on one side only": float(np.sum(there[:, 0] != there[:, 1])),
    }


def draw(result: StudyResult) -> Figure:
    """A panel for each thickness, a line for each pressure."""
    return charts.lines(result, VOLTAGE, STROKE, family=PRESSURE, panels=THICKNESS, reference=KNOWN)


if __name__ == "__main__":
    common.main(NAME, complete, draw, errors)
