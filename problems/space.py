"""The field in the space around a shell, read at given places."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from ngsolve import CF

from embedding import Listener
from embedding.solving.events import StepRecord
from embedding.solving.state import State
from problems.common import Array

ROUNDS = 20


class FieldAt(Listener):
    """The field strength at the last step, (n, 3) in A/m or V/m, at ``places`` (n, 3) in m, on one side of the shell.

    The mesh moves with the faces: the material point that is now at a place is found by going back along its
    displacement, which is small where nothing near by has moved far. In axisymmetry places lie in the half plane
    y = 0, x >= 0.
    """

    def __init__(self, places: npt.ArrayLike, side: str = "outside") -> None:
        self.places = np.atleast_2d(np.asarray(places, dtype=np.float64))
        self.side = side
        self.values: Array = np.empty((0, 3))

    def accepted(self, state: State, record: StepRecord) -> None:
        problem = state.problem
        names = {field.name: field.values for field in state.fields() if field.block == self.side}
        strength = CF(names["H"] if "H" in names else names["E"])
        axes = {"axisymmetric": [0, 2], "plane-strain": [0, 1], "3d": [0, 1, 2]}[problem.reduction.name]
        found = []
        for place in self.places[:, axes]:
            point = place
            for _ in range(ROUNDS):
                at = problem.mesh(*(point / problem.scales.length))
                point = place - np.asarray(names["u"](at))
            found.append(strength(problem.mesh(*(point / problem.scales.length))))
        self.values = problem.embed_vector(np.array(found))
