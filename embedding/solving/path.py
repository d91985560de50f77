"""The loading path of a scene as a sequence of targets, and the stepping that reaches them with cutbacks."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from embedding.scene import Stage

DEFAULT_STEPS = 10
"""Steps of a stage that is ramped and does not say."""


@dataclass(frozen=True)
class Target:
    """Load factors and, under volume control, the volume ratio; under pressure control ``volume`` is None."""

    mechanical: float
    field: float
    volume: float | None
    pressure: float | None = None

    def between(self, start: Target, fraction: float, *, squared: bool = False) -> Target:
        """The target at ``fraction`` of the way from ``start`` to here.

        ``squared``: the square of the field's factor goes there linearly, as the forces of the field do.
        """

        def mix(a: float | None, b: float | None) -> float | None:
            return None if b is None else (b if a is None else a + fraction * (b - a))

        field = start.field + fraction * (self.field - start.field)
        if squared:
            square = start.field**2 + fraction * (self.field**2 - start.field**2)
            field = math.copysign(math.sqrt(max(square, 0.0)), start.field + self.field)
        return Target(
            start.mechanical + fraction * (self.mechanical - start.mechanical),
            field,
            mix(start.volume, self.volume),
            mix(start.pressure, self.pressure),
        )

    def report(self) -> dict[str, float]:
        """The target as named numbers, for progress and records."""
        named = {"mechanical": self.mechanical, "field": self.field, "volume_ratio": self.volume}
        return {name: value for name, value in named.items() if value is not None}

    def told(self, ramped: Sequence[str], digits: int = 4) -> str:
        """The target in words, of its factors those that scale something; of all if that is none."""
        return in_words(self.report(), ramped, digits)


def in_words(named: Mapping[str, float], ramped: Sequence[str], digits: int = 4) -> str:
    """What :meth:`Target.report` returned in words, see :meth:`Target.told`."""
    shown = [name for name in named if name in ramped or name == "volume_ratio"] or named
    return ", ".join(f"{name} {named[name]:.{digits}g}" for name in shown)


def stage_target(stage: Stage, full_difference: float | None) -> Target:
    """Where a stage ends. ``full_difference`` is p_t - p_b at full mechanical load, if it is a number."""
    pressure = None if full_difference is None else stage.mechanical * full_difference
    return Target(stage.mechanical, stage.field, stage.volume_ratio, pressure)


def followed(stage: Stage, start: Target, end: Target, *, with_field: bool, joint: bool = True) -> bool:
    """Is the stage to be followed by arc length, wherever its load goes, rather than ramped?

    That takes the tangent of a ``joint`` solve of shell and field.
    """
    if not joint:
        return False
    if stage.control != "auto":
        return stage.control in ("arc-length", "displacement")
    if stage.until is not None or stage.branch is not None:
        return True
    changes = start.mechanical != end.mechanical or (with_field and start.field != end.field)
    return stage.steps is None and stage.volume_ratio is None and changes


def planned_steps(stage: Stage, *, with_field: bool, joint: bool = True) -> int | None:
    """How many steps a stage will take, None if it follows its path in steps of its own choice."""
    here = Target(0.0, 0.0, None)
    there = Target(1.0, 1.0 if with_field else 0.0, stage.volume_ratio)
    alone = followed(stage, here, there, with_field=with_field, joint=joint)
    return None if alone else stage.steps or DEFAULT_STEPS


@dataclass
class Stepper:
    """Fractions of one stage, at most 1 / steps apart, halved on failure and doubled again on success.

    ``length`` is the present distance.
    """

    steps: int
    min_step: float
    fraction: float = 0.0
    accepted: float = 0.0

    def __post_init__(self) -> None:
        self._planned = 1.0 / self.steps
        self.length = self._planned

    def proposals(self) -> Iterator[float]:
        """Yield the next fraction to try until the stage is done; call ``accept`` or ``cut`` after each."""
        while self.accepted < 1.0:
            left = 1.0 - self.accepted
            # A remainder of rounding is not a step of its own.
            self.fraction = 1.0 if left < self.length * (1 + 1e-9) else self.accepted + self.length
            yield self.fraction

    def accept(self) -> None:
        """The last proposal was solved."""
        self.accepted = self.fraction
        self.length = min(self._planned, 2 * self.length)

    def cut(self) -> bool:
        """The last proposal failed; False when no smaller step is allowed."""
        self.length = (self.fraction - self.accepted) / 2
        return self.length >= self.min_step * self._planned

    @property
    def relative_length(self) -> float:
        """Present step as a part of the planned one."""
        return self.length / self._planned
