"""The shielding factor of a permeable spherical shell over thickness and permeability: 96 cases.

Physics: the shell guides the flux around what is inside. The field there is uniform, H0 over the shielding factor,
which grows as 2/3 mu_r T/R.

Reference: the exact shell, `problems.exact.permeable_sphere` (Jackson, Classical Electrodynamics, sec. 5.12); the
opened interface is O((T/R)^2) away.

Run: a minute on two processors.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from embedding import Scene
from embedding.scene.scales import MU_0
from embedding.studies import StudyResult, charts
from embedding.studies.charts import Axis
from problems.common import Array
from problems.permeable_sphere import exact
from problems.studies import common

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAME = "shielding"
THICKNESS = Axis("shell.thickness", "thickness $T$", "mm")
PERMEABILITY = Axis("shell.relative_permeability", r"relative permeability $\mu_r$", log=True)
FACTOR, KNOWN = Axis("factor", "shielding factor $H_0/H$", log=True), Axis("known", "exact shell")


def complete(result: StudyResult) -> StudyResult:
    """Adds the shielding factors, found and known."""
    found = [measured(scene, row.quantities["pressure"]) for scene, row in common.cases(result)]
    references = [known(scene) for scene, _ in common.cases(result)]
    return result.with_quantity("factor", found).with_quantity("known", references)


def measured(scene: Scene, pressure: float) -> float:
    """From the mean pressure p_b: mu0 (H_t^2 - H_n^2) / 2 of a uniform field, of which H_n^2 is a third in the mean."""
    assert scene.ambient is not None
    return scene.ambient.uniform_field[2] / math.sqrt(6.0 * pressure / MU_0)


def known(scene: Scene) -> float:
    """Of the exact shell."""
    shell = exact(scene)
    return shell.applied_field / shell.coefficients.inner_field


def errors(result: StudyResult) -> dict[str, float]:
    """Largest error of the factor over the thinnest and the thickest shells, over T/R squared."""
    thickness = np.array(result.columns()["shell.thickness"])
    error = relative(result)
    return {
        f"largest error at T/R = {at / result.study.scene.shell.shape.size:g}": float(error[thickness == at].max())
        for at in (thickness.min(), thickness.max())
    }


def relative(result: StudyResult) -> Array:
    """Relative errors of all factors."""
    columns = result.columns()
    return np.abs(np.array(columns["factor"]) / np.array(columns["known"]) - 1.0)


def draw(result: StudyResult) -> Figure:
    """A map over thickness and permeability."""
    return charts.contours(result, THICKNESS, PERMEABILITY, FACTOR, reference=KNOWN)


if __name__ == "__main__":
    common.main(NAME, complete, draw, errors)
