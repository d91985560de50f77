"""Parameters of a study: dotted paths into the scene, each with the values it takes or the bounds it lies between."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any, get_args

from pydantic import BaseModel
from pydantic_core import PydanticCustomError

from embedding.scene import Scene
from embedding.scene.messages import refusal
from embedding.scene.units import ELECTRIC_FIELD, MAGNETIC_FIELD, Number

BOUNDS = frozenset(("low", "high"))
ALLOWED = 'must be a list of values, such as ["0.5 mm", "1 mm"], or bounds { low = "0.5 mm", high = "2 mm" }'


def stated_parameters(value: Any) -> dict[str, Any]:
    """Validator of the table of parameters. Nested tables are dotted paths: TOML makes them of unquoted keys."""
    if not isinstance(value, Mapping) or not value:
        raise refusal('must be a table of paths and values, such as { "shell.thickness" = ["0.5 mm", "1 mm"] }')
    return _flat(value, "")


def are_bounds(values: Any) -> bool:
    """Is a parameter given by its bounds rather than by a list of values?"""
    return isinstance(values, Mapping)


def _flat(table: Mapping[Any, Any], prefix: str) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key, value in table.items():
        path = f"{prefix}{key}"
        if isinstance(value, Mapping) and value and not BOUNDS & set(value):
            found |= _flat(value, f"{path}.")
        elif isinstance(value, Mapping):
            if set(value) != BOUNDS:
                raise refusal(ALLOWED, field=path, value=value)
            found[path] = dict(value)
        elif isinstance(value, Sequence) and not isinstance(value, str) and value:
            found[path] = tuple(value)
        else:
            raise refusal(ALLOWED, field=path, value=value)
    return found


def override(path: str, value: Any) -> str:
    """The change ``path=value`` as the command line takes it with ``--set``."""
    return f"{path}={_toml(value)}"


def _toml(value: Any) -> str:
    """A value as TOML on one line."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(key)} = {_toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(_toml, value))}]"
    return repr(value.item() if hasattr(value, "item") else value)


def number_at(scene: Scene, path: str) -> Number | None:
    """The validator of the number at ``path`` of a scene; None where something else stands, or nothing."""
    node: Any = scene
    annotation: Any = Scene
    for key in path.split("."):
        if isinstance(node, BaseModel):
            field = type(node).model_fields.get(key)
            if field is None:
                return None
            annotation = (field.annotation, *field.metadata)
            node = getattr(node, key)
        elif isinstance(node, Mapping):
            node = node.get(key)
        elif isinstance(node, (list, tuple)) and key.isdecimal() and int(key) < len(node):
            node = node[int(key)]
        else:
            return None
    if isinstance(node, BaseModel):
        return None
    if path.startswith("ambient.applied_field.") and isinstance(node, float) and scene.ambient is not None:
        return ELECTRIC_FIELD if scene.ambient.field == "electric" else MAGNETIC_FIELD  # its type does not say which
    return _number_in(annotation)


def _number_in(annotation: Any) -> Number | None:
    """The first validator of a number in a type and what annotates it."""
    validator = getattr(annotation, "func", None)
    if isinstance(validator, Number):
        return validator
    if isinstance(annotation, type) and not hasattr(annotation, "__args__"):
        return None
    parts = annotation if isinstance(annotation, tuple) else get_args(annotation)
    metadata = getattr(annotation, "__metadata__", ())
    for part in (*metadata, *parts):
        found = _number_in(part)
        if found is not None:
            return found
    return None


def column_value(number: Number | None, value: Any) -> float | str:
    """A stated value as it stands in the table: in SI where it is a number there, else as its text."""
    if number is not None:
        try:
            return float(number(value))
        except PydanticCustomError:
            pass
    return value if isinstance(value, str) else _toml(value)
