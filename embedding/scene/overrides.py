"""Changes to a scene written as ``key.sub=value``: values are TOML, and plain text needs no quotes."""

from __future__ import annotations

import copy
import datetime
import tomllib
from collections.abc import Mapping, Sequence
from typing import Any

from embedding.errors import Problem, SceneError
from embedding.scene.depth import MAX_DEPTH, TOO_DEEP, too_deep
from embedding.scene.messages import printable


def apply_overrides(table: Mapping[str, Any], overrides: Sequence[str], source: str | None = None) -> dict[str, Any]:
    """A changed copy of ``table``; list entries count from 0, and the number after the last adds one.

    Whether the keys exist and the values fit is seen when the scene is built from the result.

    Raises:
        SceneError: no ``=``, an empty key, a broken value, or a key that leads through a single value.
    """
    changed: dict[str, Any] = copy.deepcopy(dict(table))
    problems = []
    for text in overrides:
        try:
            keys, value = parse_override(text)
            _assign(changed, keys, value)
        except ValueError as error:
            problems.append(Problem(printable(text.partition("=")[0].strip() or text, 200), str(error)))
    if problems:
        raise SceneError(problems, source)
    return changed


def parse_override(text: str) -> tuple[list[str], Any]:
    """Split ``shell.thickness=0.1 mm`` into its keys and its value.

    Raises:
        ValueError: the text is not of that form.
    """
    key, equals, value = text.partition("=")
    keys = [part.strip() for part in key.split(".")]
    if len(keys) > MAX_DEPTH:
        raise ValueError(TOO_DEEP)
    if not equals:
        raise ValueError("an override reads key=value, such as shell.thickness=0.1 mm")
    if not all(keys):
        raise ValueError("empty key: an override reads key=value, such as shell.thickness=0.1 mm")
    return keys, _value(value.strip())


def _value(text: str) -> Any:
    try:
        parsed = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError) as error:
        if text[:1] in ("[", "{", '"', "'"):
            raise ValueError(f"{printable(text)} is not a valid TOML value") from error
        return text
    value = parsed["value"]
    if too_deep(value):
        raise ValueError(TOO_DEEP)
    # a line break would smuggle in further keys, and a date is only ever meant as a name here
    return text if len(parsed) > 1 or isinstance(value, (datetime.date, datetime.time)) else value


def _assign(table: dict[str, Any], keys: Sequence[str], value: Any) -> None:
    node: Any = table
    for depth, key in enumerate(keys):
        last = depth == len(keys) - 1
        empty: Any = None if last else ([] if keys[depth + 1].isdecimal() else {})
        if isinstance(node, list):
            index = _index(key, node, keys[:depth])
            if index == len(node):
                node.append(empty)
            position: Any = index
        elif isinstance(node, dict):
            node.setdefault(key, empty)
            position = key
        else:
            raise ValueError(f"{'.'.join(keys[:depth])} is a single value and has no key {key}")
        if last:
            node[position] = value
        node = node[position]


def _index(key: str, node: list[Any], path: Sequence[str]) -> int:
    where = ".".join(path)
    if not key.isdecimal():
        raise ValueError(f"{where} is a list: name one of its entries by number, such as {where}.0")
    if int(key) > len(node):
        raise ValueError(f"the next entry of {where} has the number {len(node)}; or give the whole list")
    return int(key)
