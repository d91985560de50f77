"""How deep tables and lists lie in each other: a stranger's file must not exhaust what works on them by recursion."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

MAX_DEPTH = 50
"""Of a scene or a study; what they can state is not half as deep."""
TOO_DEEP = f"tables and lists may lie at most {MAX_DEPTH} deep in each other"


def too_deep(value: Any, limit: int = MAX_DEPTH) -> bool:
    """Do tables and lists lie deeper in each other than ``limit``? Looked at level by level."""
    level = [value]
    for _ in range(limit + 1):
        level = [item for holder in level for item in _items(holder)]
        if not level:
            return False
    return True


def _items(value: Any) -> list[Any]:
    if isinstance(value, Mapping):
        return list(value.values())
    return list(value) if isinstance(value, (list, tuple)) else []
