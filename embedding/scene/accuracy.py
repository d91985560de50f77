"""How accurate the answer is to be, and what counts as the answer."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator

from embedding.scene.messages import refusal
from embedding.scene.part import BROKEN, Part
from embedding.scene.units import Number

FINEST, COARSEST = 1e-7, 0.3


def _name(value: Any) -> str:
    if not isinstance(value, str) or not value.isidentifier():
        raise refusal('must be the name of a scalar that a run records, such as "stretch" or "charge"')
    return value


def _different(names: tuple[str, ...]) -> tuple[str, ...]:
    if len(set(names)) < len(names):
        raise refusal("must name every scalar once")
    return names


class Accuracy(Part):
    """The ``relative`` error allowed in the scalars ``of`` at the end of the path.

    Mesh, order and models are then chosen for it, and refined until the error estimate meets it or a mesh would have
    more than ``max_unknowns``. Without names it is the scalar whose error a run of the scene estimates by default
    (docs/accuracy.md).
    """

    relative: Annotated[float, BeforeValidator(Number(at_least=FINEST, at_most=COARSEST))]
    max_unknowns: Annotated[int, BeforeValidator(Number(whole=True, at_least=1000, at_most=100_000_000))] = 200_000
    of: Annotated[tuple[Annotated[str, BeforeValidator(_name)], ...], AfterValidator(_different)] = ()


def from_number(value: Any) -> Any:
    """A number alone is the relative error; a name alone is one scalar."""
    if isinstance(value, (int, float, str)) and not isinstance(value, bool):
        return {"relative": value}
    if isinstance(value, dict) and isinstance(value.get("of"), str):
        return {**value, "of": (value["of"],)}
    if value is not None and not isinstance(value, (dict, Accuracy, type(BROKEN))):
        raise refusal(f"must be a number, or a table with the keys {', '.join(Accuracy.model_fields)}")
    return value
