"""The pull-in voltage of a stretched strip over a rigid electrode, mapped over gap and tension: 36 cases.

Physics: the electrode attracts the strip the more the nearer it comes; at the pull-in no tension holds it any more.
The voltage grows as g^(3/2) with the gap g and as N^(1/2) with the tension.

Reference: eps0 V^2 L^2 / (2 N g^3) = 1.400016 {1 + [a ln(L/g) + b] (g/L)^2}, a = 0.4256: `problems.exact.mems` (J. A.
Pelesko, D. H. Bernstein, Modeling MEMS and NEMS, 2002, and its fringes). b is not known: one number for the whole map.

Run: three minutes on two processors.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from embedding import Scene
from embedding.scene.scales import EPSILON_0
from embedding.studies import StudyResult, charts
from embedding.studies.charts import Axis
from problems.common import Array
from problems.exact import mems
from problems.membrane_pull_in import gap, tension
from problems.studies import common

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAME = "pull_in_map"
GAP, TENSION = Axis("gap", "gap $g$", "mm"), Axis("loads.edge_tractions.0.traction.0", "tension $N$", "N/m")
PULL_IN, KNOWN = Axis("pull_in", "pull-in voltage", "V"), Axis("known", "thin gap with its fringes, closed form", "V")


def complete(result: StudyResult) -> StudyResult:
    """Adds the gap in m and the known pull-in in V."""
    scenes = [scene for scene, _ in common.cases(result)]
    result = result.with_quantity("gap", [gap(scene) for scene in scenes], "m")
    return result.with_quantity("known", [known(scene) for scene in scenes], "V")


def known(scene: Scene) -> float:
    """Pull-in voltage of the thin gap with the logarithm of its fringes."""
    (force, size), height, limit = tension(scene), gap(scene), mems.strip_pull_in()
    ratio = height / size
    load = limit.load * (1.0 + mems.fringe(limit) * ratio**2 * math.log(1.0 / ratio))
    return math.sqrt(2.0 * force * height**3 * load / (EPSILON_0 * size**2))


def remainders(result: StudyResult) -> Array:
    """What is left of every load, relative, over (g/L)^2: b of the reference, the same everywhere."""
    return np.array([
        ((row.quantities["pull_in"] / known(scene)) ** 2 - 1.0) / (gap(scene) / tension(scene)[1]) ** 2
        for scene, row in common.cases(result)
    ])  # fmt: skip


def errors(result: StudyResult) -> dict[str, float]:
    """Largest distance from the closed form; b at the smallest and the largest gap."""
    left, gaps = remainders(result), np.array(result.columns()["gap"])
    ratio = np.array([row.quantities["pull_in"] / row.quantities["known"] for row in result.rows])
    return {
        "largest error of the pull-in voltage": float(np.abs(ratio - 1.0).max()),
        "what is left of the load over (g/L)^2, smallest gap": float(left[gaps == gaps.min()].mean()),
        "largest gap": float(left[gaps == gaps.max()].mean()),
    }


def draw(result: StudyResult) -> Figure:
    """A map over gap and tension."""
    return charts.contours(result, GAP, TENSION, PULL_IN, reference=KNOWN)


if __name__ == "__main__":
    common.main(NAME, complete, draw, errors)
