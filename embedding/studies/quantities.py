"""Quantities of interest: numbers that a case is asked for, stated as short texts such as ``"voltage at limit"``."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from embedding.scene.messages import refusal

PLACES = ("end", "last", "limit", "bifurcation")
EXTREMES = ("max", "min")
WHOLE_PATH = ("end", *EXTREMES)
"""Where a number is known only if the whole path was solved."""

FORM = 'must be a scalar of a step, such as "stretch", "voltage at limit" or "max of stretch_max"'
_POINT = re.compile(rf"(?P<scalar>\w+)(?:\s+at\s+(?P<place>{'|'.join(PLACES)}))?")
_EXTREME = re.compile(rf"(?P<place>{'|'.join(EXTREMES)})\s+of\s+(?P<scalar>\w+)")

States = Mapping[str, Mapping[str, float] | None]
"""Scalars of a case by place; None where the path has no such place."""


@dataclass(frozen=True)
class Quantity:
    """The scalar ``scalar`` at ``place``.

    "end" is the end of the path, "last" the last accepted step, however the run ended, "limit" and "bifurcation" the
    first such point of the path, "max" and "min" the largest and smallest value over the steps.
    """

    scalar: str
    place: str = "end"

    @classmethod
    def parse(cls, text: str) -> Quantity:
        """Read ``"scalar"``, ``"scalar at place"``, ``"max of scalar"`` or ``"min of scalar"``.

        Raises:
            ValueError: the text is not of that form.
        """
        match = _EXTREME.fullmatch(text.strip()) or _POINT.fullmatch(text.strip())
        if match is None:
            raise ValueError(f"{FORM}; places are {', '.join(PLACES)}")
        return cls(match["scalar"], match["place"] or "end")

    def value(self, states: States, complete: bool) -> float:
        """The number in SI units; nan where the path does not have it, or is not ``complete`` and would need to be."""
        if self.place in WHOLE_PATH and not complete:
            return math.nan
        scalars = states.get("last" if self.place == "end" else self.place)
        return math.nan if scalars is None else scalars.get(self.scalar, math.nan)


def stated_quantities(value: Any) -> dict[str, str]:
    """Validator of the table of quantities: names and texts."""
    if not isinstance(value, Mapping) or not value:
        raise refusal('must be a table of names and scalars, such as { pull_in = "voltage at limit" }')
    for name, text in value.items():
        if not isinstance(name, str) or not name.isidentifier():
            reason = "a name of a quantity has letters, digits and underscores only"
            raise refusal(reason, value=name)
        if not isinstance(text, str):
            raise refusal(FORM, field=name, value=text)
        try:
            Quantity.parse(text)
        except ValueError as error:
            raise refusal(str(error), field=name, value=text) from None
    return dict(value)
