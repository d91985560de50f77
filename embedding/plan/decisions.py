"""A plan: what will be modelled, what is left out, and why; each decision a topic, a choice and a sentence."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from embedding.geometry.domain import MeshSizes
from embedding.geometry.reduction import Reduction

Extent = Literal["none", "surroundings", "inside", "given"]
"""How much of the field is modelled: nothing, all around the shell, inside the shell, or the given field alone."""


@dataclass(frozen=True)
class Decision:
    """One choice of the plan and its reason.

    ``number`` is the dimensionless number behind it, ``measure`` says of what, and ``threshold`` up to where it counts
    as small; without a number the choice is exact, or stated by the scene.
    """

    topic: str
    choice: str
    reason: str
    number: float | None = None
    measure: str = ""
    threshold: float | None = None

    @property
    def compared(self) -> str:
        """The number against its threshold, as text; "" without one."""
        if self.number is None:
            return ""
        if self.threshold is None:
            return f"{self.number:.1e}"
        return f"{self.number:.1e} {'<=' if self.number <= self.threshold else '>'} {self.threshold:.1e}"

    @property
    def told(self) -> str:
        """The reason, and what the number is."""
        return f"{self.reason} [{self.measure}]" if self.measure else self.reason


@dataclass(frozen=True)
class Plan:
    """Everything the solver needs to know beyond the scene; sizes are relative to the size of the shape.

    ``opened`` names the faces ("t", "b") at their true places, ``odd_planes`` the mirror planes across which the
    potential changes sign. ``bending`` says whether the shell resists it,
    ``locking_cured`` whether membrane strains are interpolated for it, ``coupling`` the rung between shell and field,
    ``extent`` how much of the field is modelled.
    """

    reduction: Reduction
    sizes: MeshSizes
    opened: tuple[str, ...]
    odd_planes: tuple[str, ...]
    decisions: tuple[Decision, ...]
    bending: bool = False
    locking_cured: bool = False
    coupling: str = "joint"
    extent: Extent = "none"

    def text(self) -> str:
        """The decisions as aligned lines: topic, choice, number against threshold, reason and what the number is."""
        rows = [(d.topic, d.choice, d.compared, d.told) for d in self.decisions]
        widths = [max(len(row[column]) for row in rows) for column in range(3)]
        return "\n".join(
            "  ".join([*(f"{cell:<{width}}" for cell, width in zip(row, widths, strict=False)), row[3]]) for row in rows
        )
