"""The base of every piece of a scene: immutable, strict about names, and told of all errors at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NoReturn, Self, TypeVar

from pydantic import (
    BaseModel,
    ConfigDict,
    ValidationError,
    ValidationInfo,
    ValidatorFunctionWrapHandler,
    field_validator,
    model_validator,
)
from pydantic._internal._model_construction import ModelMetaclass

from embedding.errors import Problem, SceneError
from embedding.scene.messages import problems_of


class Unavailable(Exception):
    """A check asked for a field that is itself wrong; it is skipped, as that field has its own problem."""


class _Broken:
    """Stands for a field that failed its validation while the rest of the scene is still being checked."""

    def _refuse(self, *_: Any) -> NoReturn:
        raise Unavailable

    __getattr__ = __lt__ = __le__ = __gt__ = __ge__ = __iter__ = __len__ = __bool__ = __getitem__ = _refuse
    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = _refuse
    __eq__ = __ne__ = __hash__ = __neg__ = __abs__ = __contains__ = __float__ = __str__ = _refuse


BROKEN = _Broken()
T = TypeVar("T")


def known(value: T) -> T:
    """The value itself, unless it is wrong; needed before a comparison by identity, such as ``is None``.

    Raises:
        Unavailable: the field failed its own validation.
    """
    if value is BROKEN:
        raise Unavailable
    return value


TOLERANT = {"tolerant": True}
"""Validation context in which wrong fields become ``BROKEN`` instead of errors."""


def kind_under(key: str) -> Callable[[Any], str | None]:
    """A function that picks the member of a union by the text under ``key``, in a table or in an object."""

    def kind(value: Any) -> str | None:
        name = value.get(key) if isinstance(value, dict) else getattr(value, key, None)
        return name if isinstance(name, str) else None

    return kind


def tolerant(info: ValidationInfo) -> bool:
    """Whether this validation only wants the fields that are right."""
    return info.context is TOLERANT


class PartType(ModelMetaclass):
    """Turns the validation error of a direct construction into a ``SceneError``.

    This sits on the metaclass because nested tables are validated without passing here, so that one
    construction reports the problems of all its parts at once, each under its own path.
    """

    if not TYPE_CHECKING:

        def __call__(cls, *args: Any, **kwargs: Any) -> Any:
            try:
                return super().__call__(*args, **kwargs)
            except ValidationError as error:
                raise SceneError(problems_of(error, cls) + cls._further_problems(kwargs)) from None


class Part(BaseModel, metaclass=PartType):
    """One piece of a scene. Immutable; numbers are SI floats; unknown names are refused.

    Raises:
        SceneError: on construction, listing every problem with the path of its field.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """A copy with some fields replaced; the result is validated like a new object.

        Raises:
            SceneError: the changed fields do not fit.
        """
        fields = {name: getattr(self, name) for name in type(self).model_fields}
        return type(self)(**{**fields, **(update or {})})

    @classmethod
    def _further_problems(cls, data: Mapping[str, Any]) -> tuple[Problem, ...]:
        """Problems between fields that can be found although some fields are wrong."""
        return ()

    @model_validator(mode="before")
    @classmethod
    def _drop_unknown(cls, data: Any, info: ValidationInfo) -> Any:
        # A misspelled name may stand for any field that is absent, so none of those can be trusted then.
        if not tolerant(info) or not isinstance(data, dict):
            return data
        known = {name: value for name, value in data.items() if name in cls.model_fields}
        suspicious = len(known) < len(data)
        absent = {
            name: BROKEN
            for name, field in cls.model_fields.items()
            if name not in known and (suspicious or field.is_required())
        }
        return known | absent

    @field_validator("*", mode="wrap")
    @classmethod
    def _mark_broken(cls, value: Any, handler: ValidatorFunctionWrapHandler, info: ValidationInfo) -> Any:
        if not tolerant(info):
            return handler(value)
        if value is BROKEN:
            return BROKEN
        try:
            return handler(value)
        except (ValueError, Unavailable):
            return BROKEN
