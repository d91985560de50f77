"""The texts of an archive as what they are: a checksum that holds says who wrote them nothing."""

from __future__ import annotations

import json
from functools import cache
from typing import (
    Any,
    Literal,
    NotRequired,  # pydantic wants these before Python 3.12
)

from pydantic import TypeAdapter
from typing_extensions import TypedDict

from embedding.archive.records import ArchivedCost, ArchivedDecision, ArchivedError, ArchivedResult
from embedding.scene import Scales
from embedding.solving.solution import Assumption, Check


class PlanDocument(TypedDict):
    """Decisions of the plan, and the plan as it was printed."""

    decisions: tuple[ArchivedDecision, ...]
    text: str


class RunDocument(TypedDict):
    """What a run is, beside its scene."""

    name: str
    reduction: Literal["3d", "axisymmetric", "plane-strain"]
    mirrors: list[str]
    odd_mirrors: NotRequired[list[str]]
    started: str


class Cut(TypedDict):
    """A step that was retried shorter."""

    step: int
    fraction: float
    reason: str


class PointDocument(TypedDict):
    """A critical point, see ``CriticalPoint``."""

    kind: Literal["limit", "bifurcation"]
    stage: str
    before_step: int
    factor_mechanical: float
    factor_field: float
    scalars: dict[str, float]
    mode: list[float]
    unstable: tuple[int | None, int | None]


class EndDocument(TypedDict, total=False):
    """How a run ended; empty as long as it has not."""

    result: ArchivedResult
    error: ArchivedError | None
    errors: dict[str, ArchivedError]
    cost: ArchivedCost | None
    assumptions: tuple[Assumption, ...]
    health: tuple[Check, ...]
    cuts: tuple[Cut, ...]
    start: str
    critical_points: tuple[PointDocument, ...]


KINDS: dict[str, Any] = {
    "plan": PlanDocument, "scales": Scales, "versions": dict[str, str], "run": RunDocument, "finish": EndDocument,
}  # fmt: skip


def document(name: str, text: str | bytes) -> Any:
    """The document called ``name`` from its JSON ``text``. Raises ValueError if it is something else."""
    try:
        return _adapter(name).validate_python(json.loads(text))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"its {name} is not what a run writes") from error


@cache
def _adapter(name: str) -> TypeAdapter[Any]:
    return TypeAdapter(KINDS[name])
