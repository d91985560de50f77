"""The same problem on a new mesh of the ambient, made around the present shape of the shell, in the present state."""

from __future__ import annotations

import numpy as np
from ngsolve import GridFunction

from embedding.geometry.matching import put
from embedding.geometry.remeshing import remeshed
from embedding.shell.bending import CurveBending
from embedding.solving.memory import Memory
from embedding.solving.problem import Array, Problem

WORN, TIRED = 0.12, 0.5
"""Smallest det F of the ambient's motion below which its mesh is made anew: after a step, and where the next step would
turn elements over."""
ON_NODES = ("u", "y_t", "y_b", "o_t", "o_b", "tau_t", "tau_b")


def origin_of(problem: Problem) -> Memory:
    """What of the present state a new mesh around it depends on."""
    saved = problem.system.save()
    return {"unknowns": saved["unknowns"], "turned": saved["turned"]}


class Remeshed(Problem):
    """``problem`` with a new ambient around its shell. The displacement and all that lives on the shell's nodes are the
    same; bending moments and the potential are linear in their equations, and are found with the next Newton step.
    ``origin`` is the state it was made in, from which it can be made again.

    Raises:
        RemeshingError: there is no sound mesh around the deformed shell.
    """

    def __init__(self, problem: Problem) -> None:
        unknowns = problem.system.unknowns
        found = remeshed(problem.domain, unknowns.field("u"))
        super().__init__(problem.scene, problem.plan, found.domain)
        self.origin = origin_of(problem)
        self._before, self._matching = unknowns, found.matching
        system = self.system
        system.present = self.carried(problem.system.present)
        counted, before = system.unknowns.bending, unknowns.bending
        if isinstance(counted, CurveBending) and isinstance(before, CurveBending):
            counted.carried_from(before, found.matching)
        system.restore(system.save())  # the state did not get here by Newton steps

    @classmethod
    def from_origin(cls, problem: Problem, origin: Memory) -> Remeshed:
        """The new ``problem`` that was made of this one in the state ``origin``; ``problem`` is left in that state."""
        system = problem.system
        system.present = origin["unknowns"]
        if system.unknowns.bending is not None:
            system.unknowns.bending.memory = origin["turned"]
        return cls(problem)

    def carried(self, values: Array) -> Array:
        """What a vector of all unknowns of the problem before has on the shell's nodes and in numbers, as one of this
        problem."""
        old, new = self._before, self.system.unknowns
        field, out = GridFunction(old.space), np.zeros(new.space.ndof)
        field.vec.FV().NumPy()[:] = values
        for name in new.names:
            if name in ON_NODES:
                out[new.range(name)] = self._on_nodes(field.components[old.names.index(name)], name)
            elif name in new.numbers:
                out[new.range(name)] = values[old.range(name)]
        return out

    def _on_nodes(self, field: GridFunction, name: str) -> Array:
        unknowns, trace = self.system.unknowns, self.system.unknowns.trace
        samples = self._matching.sampled(field, self.domain.sizes.order)
        components = put(trace.scalar, self._matching.new, samples)
        values = np.concatenate([trace.on_shell(component) for component in components])
        return values if name == "u" else np.where(unknowns.face_free, values, 0.0)
