"""Load stepping with plain Newton's method, for the referees only."""

from __future__ import annotations

import math
from typing import Any

from ngsolve import Parameter


def solve_in_steps(form: Any, state: Any, load: Parameter, steps: int) -> None:
    """Carry the GridFunction `state` to full load, through equal steps of `load` up to 1.

    Raises RuntimeError where Newton's method does not converge, naming the step.
    """
    for step in range(1, steps + 1):
        load.Set(step / steps)
        if not _converges(form, state):
            raise RuntimeError(f"Newton's method failed in load step {step} of {steps}")


def _converges(form: Any, state: Any, tolerance: float = 1e-10, iterations: int = 15) -> bool:
    """Iterate until the update is below `tolerance` relative to the state's own size."""
    residual, update = state.vec.CreateVector(), state.vec.CreateVector()
    for _ in range(iterations):
        form.Apply(state.vec, residual)
        form.AssembleLinearization(state.vec)
        update.data = form.mat.Inverse(form.space.FreeDofs(), inverse="umfpack") * residual
        state.vec.data -= update
        size = update.Norm()
        if not math.isfinite(size):
            return False
        if size <= tolerance * (1.0 + state.vec.Norm()):
            return True
    return False
