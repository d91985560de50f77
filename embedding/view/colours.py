"""Colours of fields, and the range of values that they stand for."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Limits = tuple[float, float]
SHELL_COLOURS, FIELD_COLOURS = "YlOrRd", "GnBu"


def colour_limits(parts: Sequence[Floats], from_zero: bool, noise: float) -> Limits:
    """Range of colours for all ``parts``: wider than ``noise`` and 2 % of the values, from zero on if that
    is natural.

    A part in a thousand of the values may lie above the range: a singular point must not hide everything
    else.
    """
    values = np.concatenate([part[np.isfinite(part)] for part in parts])
    low, high = float(values.min()), float(np.quantile(values, 0.999))
    if from_zero and 0 <= low <= max(0.5 * high, noise):
        return 0.0, max(high, noise)
    least = max(0.02 * max(abs(low), abs(high)), noise)
    if high - low < least:
        middle = (low + high) / 2
        low, high = middle - least / 2, middle + least / 2
    return low, high
