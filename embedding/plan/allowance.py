"""How much a term that is left out may be worth, and how a choice between a cheap and a dear model is made of it."""

from __future__ import annotations

from dataclasses import dataclass

from embedding.scene import Scene

SAFE = 1 / 3
"""The part of the accuracy that one neglected term may use up. Numbers are estimates, and there are others."""
UNSTATED = 1e-2
"""The accuracy that numbers are compared with where the scene states none."""


@dataclass(frozen=True)
class Allowance:
    """The relative error ``accuracy`` that a scene allows in its answer; None where it states none, and the plan then
    keeps every term, whatever its number."""

    accuracy: float | None

    @classmethod
    def of(cls, scene: Scene) -> Allowance:
        """That of ``scene``."""
        return cls(None if scene.accuracy is None else scene.accuracy.relative)

    @property
    def threshold(self) -> float:
        """Up to what number a term counts as small."""
        return SAFE * (UNSTATED if self.accuracy is None else self.accuracy)

    @property
    def stated(self) -> bool:
        """Does the scene state an accuracy, so that numbers decide?"""
        return self.accuracy is not None

    def permits(self, number: float | None) -> bool:
        """May a term that is worth ``number`` be left out? One of unknown worth may not."""
        return self.stated and number is not None and number <= self.threshold

    def says(self, number: float | None, *, kept: bool = False) -> str:
        """The comparison that made the choice, in words; ``kept`` says that the term is in the model."""
        if not self.stated:
            return "no accuracy is stated: the number decides nothing"
        small = self.permits(number)
        if small == kept:
            return "whatever its number"
        return "within the accuracy" if small else "not within the accuracy"
