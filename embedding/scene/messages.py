"""From the validator's errors to sentences for the user: which field, which value, what is allowed."""

from __future__ import annotations

import types
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails, PydanticCustomError

from embedding.errors import Problem


def refusal(reason: str, unit: str = "", **instead: Any) -> PydanticCustomError:
    """The error a validator raises; ``reason`` says what is allowed, ``unit`` is shown after plain numbers.

    A validator of a whole table names the field it means with ``field=`` and ``value=``.
    """
    return PydanticCustomError("refused", "{reason}", {"reason": reason, "unit": unit, **instead})


def nearest(name: str, allowed: Iterable[str]) -> str | None:
    """The allowed name most like ``name``, or None if nothing comes close."""
    by_lower = {candidate.lower(): candidate for candidate in allowed}
    matches = get_close_matches(name.lower(), by_lower, n=1, cutoff=0.6)
    return by_lower[matches[0]] if matches else None


def quoted(names: Iterable[str]) -> str:
    """``"a", "b" or "c"``."""
    words = [f'"{name}"' for name in names]
    return " or ".join([", ".join(words[:-1]), words[-1]]) if len(words) > 1 else "".join(words)


def choice(value: Any, allowed: Iterable[str]) -> str:
    """The sentence for a value outside a fixed set of names."""
    names = tuple(allowed)
    guess = nearest(value, names) if isinstance(value, str) else None
    hint = f'; did you mean "{guess}"?' if guess else ""
    shown = f'"{printable(value)}"' if isinstance(value, str) else show(value)
    return f"{shown} is not allowed: must be {quoted(names)}{hint}"


def unknown_key(key: str, allowed: Iterable[str]) -> str:
    """The sentence for a name that does not exist."""
    names = tuple(allowed)
    guess = nearest(key, names)
    hint = f'did you mean "{guess}"?' if guess else f"the keys here are {', '.join(names)}"
    return f"unknown key: {hint}"


def show(value: Any, unit: str = "") -> str:
    """A value as the user would write it, on one short line."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int) and abs(value) >= 10**18:
        return "an integer of more than 18 digits"
    if isinstance(value, (int, float)):
        return f"{int(value) if isinstance(value, int) else float(value)} {unit}".rstrip()
    if isinstance(value, str):
        return printable(value) or '""'
    if isinstance(value, Mapping):
        return "a table"
    if isinstance(value, BaseModel):
        return f"a {type(value).__name__}"
    if isinstance(value, (list, tuple)):
        return printable(f"[{', '.join(show(item) for item in value[:8])}{', ...' if len(value) > 8 else ''}]")
    return printable(str(value))


def problems_of(error: ValidationError, model: type[BaseModel]) -> tuple[Problem, ...]:
    """All problems of one validation, with the dotted paths a user would type."""
    return tuple(_problem(details, model) for details in error.errors(include_url=False))


def key_path(parts: Iterable[object]) -> str:
    """The dotted path; the number of an entry of a list counts from 0."""
    return ".".join(printable(str(part)) or '""' for part in parts)


def printable(text: str, limit: int = 60) -> str:
    """The beginning of a stranger's text on one line, without what would work on a terminal."""
    line = "".join(character if character.isprintable() else " " for character in text)
    return line if len(line) <= limit else f"{line[: limit - 3]}..."


def _problem(details: ErrorDetails, model: type[BaseModel]) -> Problem:
    path, owner, annotation = _locate(model, details["loc"])
    value, context, kind = details["input"], details.get("ctx", {}), details["type"]
    if kind == "missing":
        return Problem(key_path(path), f"missing: {_wanted(owner, str(path[-1]))}")
    if kind == "extra_forbidden":
        return Problem(key_path(path), unknown_key(str(path[-1]), owner.model_fields))
    if kind in ("union_tag_invalid", "union_tag_not_found"):
        return _wrong_kind(path, annotation, value)
    if kind == "literal_error":
        return Problem(key_path(path), choice(value, get_args(_bare(annotation))))
    if kind == "refused":
        path = [*path, *filter(None, [context.get("field")])]
        value = context.get("value", value)
        return Problem(key_path(path), f"{show(value, context['unit'])} is not allowed: {context['reason']}")
    expected = _shape_of(kind, annotation, details["msg"])
    return Problem(key_path(path), f"{show(value)} is not allowed: {expected}")


def _shape_of(kind: str, annotation: Any, fallback: str) -> str:
    if kind in ("model_type", "model_attributes_type", "dict_type"):
        keys = ", ".join(_models(annotation)[0].model_fields)
        return f"must be a table with the keys {keys}"
    if kind == "tuple_type":
        return "must be a list"
    if kind.startswith("string"):
        return "must be text"
    return fallback[:1].lower() + fallback[1:]


def _wrong_kind(path: list[str | int], annotation: Any, value: Any) -> Problem:
    key, kinds = _kinds(_models(annotation))
    if not isinstance(value, Mapping):
        expected = f"must be a table with {key} = {quoted(kinds)}"
        return Problem(key_path(path), f"{show(value)} is not allowed: {expected}")
    path = [*path, key]
    if key not in value:
        return Problem(key_path(path), f"missing: must be {quoted(kinds)}")
    return Problem(key_path(path), choice(value[key], kinds))


def _kinds(models: list[type[BaseModel]]) -> tuple[str, list[str]]:
    """The key that tells the models of a union apart, and its value for each."""
    for name, field in models[0].model_fields.items():
        if get_origin(field.annotation) is Literal:
            return name, [str(get_args(model.model_fields[name].annotation)[0]) for model in models]
    raise TypeError(f"{models[0].__name__} has no key that tells it apart")


def _wanted(owner: type[BaseModel], name: str) -> str:
    """What a missing field expects, from its own validator or the keys of its table."""
    field = owner.model_fields[name]
    if (allowed := _allowed(field)) is not None:
        return allowed
    models = _models(field.annotation)
    if len(models) == 1:
        return f"must be a table with the keys {', '.join(models[0].model_fields)}"
    if models:
        key, kinds = _kinds(models)
        return f"must be a table with {key} = {quoted(kinds)}"
    names = get_args(_bare(field.annotation))
    return f"must be {quoted(names)}" if names and all(isinstance(n, str) for n in names) else "must be given"


def _allowed(field: FieldInfo) -> str | None:
    for item in field.metadata:
        sentence = getattr(getattr(item, "func", None), "allowed", None)
        if isinstance(sentence, str):
            return sentence
    return None


Location = tuple[list[str | int], type[BaseModel], Any]


def _locate(model: type[BaseModel], loc: tuple[str | int, ...]) -> Location:
    """The path without the validator's union tags, the model that owns its last name, and its annotation."""
    path: list[str | int] = []
    owner: type[BaseModel] = model
    annotation: Any = model
    for part in loc:
        models = _models(annotation)
        if isinstance(part, str) and len(models) > 1 or part in (VALUE, TABLE):
            annotation = _tagged(models, str(part))
            continue
        path.append(part)
        if isinstance(part, int):
            members = [a for a in get_args(_bare(annotation)) if a is not Ellipsis]
            annotation = members[min(part, len(members) - 1)] if members else Any
            continue
        owner = models[0] if models else owner
        field = owner.model_fields.get(part)
        annotation = field.annotation if field else Any
    return path, owner, annotation


VALUE, TABLE = "<value>", "<table>"
"""Union tags of a field that takes either a plain value or a table; they never appear in a message."""


def _tagged(models: list[type[BaseModel]], tag: str) -> Any:
    for member in models:
        for field in member.model_fields.values():
            if get_origin(field.annotation) is Literal and tag in get_args(field.annotation):
                return member
    return models[0] if models and tag != VALUE else Any


def _bare(annotation: Any) -> Any:
    """Strip ``Annotated`` and ``| None``."""
    while get_origin(annotation) is Annotated:
        annotation = get_args(annotation)[0]
    if get_origin(annotation) in (Union, types.UnionType):
        members = [a for a in get_args(annotation) if a is not type(None)]
        if len(members) == 1:
            return _bare(members[0])
    return annotation


def _models(annotation: Any) -> list[type[BaseModel]]:
    """The models that a field may hold itself (not inside a list)."""
    annotation = _bare(annotation)
    if get_origin(annotation) in (Union, types.UnionType):
        return [model for member in get_args(annotation) for model in _models(member)]
    return [annotation] if isinstance(annotation, type) and issubclass(annotation, BaseModel) else []
