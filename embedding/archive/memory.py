"""What a run goes on from, as a text and one row of numbers: how an archive holds it.

The text is JSON; an array in it is a table ``{"numbers": [begin, end]}`` that says where its entries lie in the row.
Nothing here can run code: an archive may come from a stranger.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
WHERE = "numbers"


def packed(memory: Any) -> tuple[str, Floats]:
    """``memory``, tables and lists of numbers, texts and arrays (n,), as its text and its row of numbers."""
    rows: list[Floats] = []

    def plain(value: Any) -> Any:
        if isinstance(value, dict):
            return {str(key): plain(item) for key, item in value.items()}
        if isinstance(value, (list, tuple)):
            return [plain(item) for item in value]
        if isinstance(value, np.ndarray):
            begin = sum(map(len, rows))
            rows.append(np.asarray(value, np.float64))
            return {WHERE: [begin, begin + len(value)]}
        return value.item() if isinstance(value, np.generic) else value

    text = json.dumps(plain(memory))
    return text, np.concatenate(rows) if rows else np.zeros(0)


def unpacked(text: str, numbers: Floats) -> Any:
    """What :func:`packed` was given. Raises ValueError if the two do not fit together."""

    def whole(value: Any) -> Any:
        if isinstance(value, list):
            return [whole(item) for item in value]
        if not isinstance(value, dict):
            return value
        if value.keys() != {WHERE}:
            return {key: whole(item) for key, item in value.items()}
        begin, end = value[WHERE]
        if not 0 <= begin <= end <= len(numbers):
            raise ValueError(f"numbers {begin} to {end} of {len(numbers)}")
        return np.array(numbers[begin:end])

    return whole(json.loads(text))
