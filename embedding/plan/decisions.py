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
    """One choice of the plan, with the reason and the number it was based on."""

    topic: str
    choice: str
    reason: str


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
        """The decisions as aligned lines."""
        topic = max(len(d.topic) for d in self.decisions)
        choice = max(len(d.choice) for d in self.decisions)
        return "\n".join(f"{d.topic:<{topic}}  {d.choice:<{choice}}  {d.reason}" for d in self.decisions)
