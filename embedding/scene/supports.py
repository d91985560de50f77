"""Supports: where the shell is held, in which directions, and where to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, BeforeValidator, Discriminator, Tag, model_validator

from embedding.scene.messages import TABLE, VALUE, quoted, refusal
from embedding.scene.part import Part
from embedding.scene.texts import Name
from embedding.scene.units import LengthVector

Direction = Literal["x", "y", "z", "rotation"]
ORDER = ("x", "y", "z", "rotation")
KINDS: dict[str, tuple[Direction, ...]] = {
    "clamped": ("x", "y", "z", "rotation"),
    "pinned": ("x", "y", "z"),
    "symmetry": ("rotation",),
}
"""What each kind of support holds; "symmetry" also holds the displacement across the edge's plane."""


def _directions(value: Any) -> Any:
    if not isinstance(value, (list, tuple)) or not value or len(set(map(str, value))) < len(value):
        raise refusal('must be a list of different axes, such as ["x", "z"]')
    return value


def _sorted(directions: tuple[Direction, ...]) -> tuple[Direction, ...]:
    return tuple(sorted(directions, key=ORDER.index))


Directions = Annotated[tuple[Direction, ...], BeforeValidator(_directions), AfterValidator(_sorted)]


@dataclass(frozen=True)
class _Place:
    allowed: str = 'must be an edge or face of the shape, "surface" or a point [x, y, z]'

    def __call__(self, value: Any) -> Any:
        return value


def _point_or_name(value: Any) -> str:
    return VALUE if isinstance(value, str) or not hasattr(value, "__len__") else TABLE


Place = Annotated[
    Annotated[Name, Tag(VALUE)] | Annotated[LengthVector, Tag(TABLE)],
    Discriminator(_point_or_name),
    BeforeValidator(_Place()),
]


class Support(Part):
    """Displacements that are held, at zero or at a given ``displacement`` in m that the path may ramp.

    ``where`` is an edge of the shape, a named face of it, "surface" for the whole shell, or a point [x, y, z] in m
    where the shape has a corner. ``fix`` lists what is held: directions, and "rotation", the turning of the shell about
    an edge. Instead of it ``kind`` names a usual support: "clamped" (all), "pinned" (x, y and z) or "symmetry", for an
    edge in a plane across a coordinate axis (the displacement along that axis, and the rotation). In an axisymmetric
    reduction x and y both mean the radial direction.
    """

    where: Place
    fix: Directions | None = None
    kind: Literal["clamped", "pinned", "symmetry"] | None = None
    displacement: LengthVector = (0.0, 0.0, 0.0)

    @property
    def held(self) -> tuple[Direction, ...]:
        """What is held; for "symmetry" without the direction across the plane, which only the mesh knows."""
        return KINDS[self.kind] if self.kind is not None else self.fix or ()

    @model_validator(mode="after")
    def _fix_or_kind(self) -> Self:
        if self.kind is None and self.fix is None:
            raise refusal(f"give the directions to hold, or kind = {quoted(KINDS)}", field="fix", value=None)
        if self.kind is not None and self.fix is not None:
            reason = f'kind = "{self.kind}" says what is held'
            raise refusal(f"{reason}; leave out one of the two", field="fix", value=self.fix)
        return self

    @model_validator(mode="after")
    def _displacement_is_held(self) -> Self:
        for axis, value in zip("xyz", self.displacement, strict=True):
            if value != 0.0 and axis not in self.held:
                where = f"displacement.{'xyz'.index(axis)}"
                raise refusal(f"this support does not hold {axis}", field=where, value=f"{value} m")
        return self
