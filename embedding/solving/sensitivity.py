"""How much scalars of a solution answer to its load, from its last steps."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import numpy as np

from embedding.plan.loading import STRETCHES
from embedding.solving.events import StepRecord

Moved = Literal["mechanical", "field", "both"]


def last_of(steps: Sequence[StepRecord]) -> list[StepRecord]:
    """The last three steps of the last stage, or as many as it has."""
    return [step for step in steps if step.stage == steps[-1].stage][-3:]


def moved(steps: Sequence[StepRecord], *, with_field: bool) -> Moved:
    """Which loads changed in the last ``steps``; in a single one both did."""
    last = last_of(steps)
    if len(last) < 2 or not with_field:
        return "both"
    mechanical, field = (len({getattr(s, name) for s in last}) > 1 for name in ("factor_mechanical", "factor_field"))
    return "both" if mechanical == field else "field" if field else "mechanical"


def slope(steps: Sequence[StepRecord], name: str, *, with_field: bool) -> float:
    """|d ln(scalar) / d ln(load)| at the last of ``steps``, from a parabola through the last three of its stage.

    Field forces grow with the square of the field's factor. A single step is taken to answer linearly, of a scalar that
    starts at 1 its difference from that.
    """
    stage = last_of(steps)
    field = with_field and stage[-1].factor_field != stage[0].factor_field
    factors = [step.factor_field**2 if field else step.factor_mechanical for step in stage]
    values = [abs(step.scalars.get(name, 0.0)) for step in stage]
    usable = len(stage) > 1 and min(factors) > 0.0 and len(set(factors)) == len(stage) and min(values) > 0.0
    if not usable:
        return abs(math.log(values[-1])) if name in STRETCHES and values[-1] > 0.0 else 1.0
    loads = np.log(factors) - math.log(factors[-1])
    return float(abs(np.polyfit(loads, np.log(values), len(stage) - 1)[-2]))
