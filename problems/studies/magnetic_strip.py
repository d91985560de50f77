"""Bending of a hard-magnetic strip over field and remanence, in plane strain: 60 cases.

Physics: the field turns the remanence, and the strip with it, towards its own direction. Only the product of the two
matters, so that the contours are hyperbolas; near full alignment more field bends the strip hardly further.

Reference: the elastica under the dead end force a = 12 B_r H L^2 / (E T^2), E = 4 mu in plane strain,
`problems.exact.hard_magnetic_elastica` (R. Zhao et al., J. Mech. Phys. Solids 124 (2019) 244). The strip stretches a
little, as T^2.

Run: half a minute on two processors.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from embedding import NeoHookean, Scene, open_archive
from embedding.scene.scales import MU_0
from embedding.studies import StudyResult, charts
from embedding.studies.charts import Axis
from problems.common import Array
from problems.exact import hard_magnetic_elastica
from problems.studies import common

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAME = "magnetic_strip"
FIELD = Axis("ambient.applied_field.1", "field $H$", "kA/m", log=True)
REMANENCE = Axis("shell.remanence.0", "remanence $B_r$", "mT", log=True)
DEFLECTION, KNOWN = Axis("deflection", "deflection of the tip", "mm"), Axis("known", "elastica", "mm")


def complete(result: StudyResult) -> StudyResult:
    """Adds the deflection of the tip along the field, found and known, m."""
    found = [deflection(result, number) for number in range(len(result.rows))]
    references = [known(scene) for scene, _ in common.cases(result)]
    return result.with_quantity("deflection", found, "m").with_quantity("known", references, "m")


def deflection(result: StudyResult, number: int) -> float:
    """Of the tip of a row, from its archive; nan where the case is not done."""
    if result.rows[number].status != "done":
        return np.nan
    strip = open_archive(result.archive(number)).block("shell")
    return float(strip.field("u")[strip.points[:, 0].argmax(), 1])


def known(scene: Scene) -> float:
    """Of the elastica."""
    shell = scene.shell
    assert isinstance(shell.material, NeoHookean) and isinstance(shell.remanence, tuple) and scene.ambient is not None
    length, young = shell.shape.size, 4.0 * shell.material.shear_modulus
    field = MU_0 * scene.ambient.uniform_field[1]
    load = hard_magnetic_elastica.load(length, shell.thickest, young, shell.remanence[0], field, MU_0)
    return length * hard_magnetic_elastica.tip(load).deflection


def relative(result: StudyResult) -> Array:
    """Errors of all deflections, over the length."""
    columns = result.columns()
    length = result.study.scene.shell.shape.size
    return np.abs(np.array(columns["deflection"]) - np.array(columns["known"])) / length


def errors(result: StudyResult) -> dict[str, float]:
    """Largest error over the length."""
    return {"largest error of the deflection over the length": float(relative(result).max())}


def draw(result: StudyResult) -> Figure:
    """A map over field and remanence."""
    return charts.contours(result, FIELD, REMANENCE, DEFLECTION, reference=KNOWN)


if __name__ == "__main__":
    common.main(NAME, complete, draw, errors)
