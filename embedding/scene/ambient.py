"""The space around the shell, its field, and the electrodes on the faces of the shell."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, ValidationInfo

from embedding.scene.part import Part
from embedding.scene.units import ELECTRIC_FIELD, MAGNETIC_FIELD, Components, Length, Voltage


def _field_strength(value: Any, info: ValidationInfo) -> float:
    number = MAGNETIC_FIELD if info.data.get("field") == "magnetic" else ELECTRIC_FIELD
    return number(value)


FieldStrength = Annotated[float, BeforeValidator(_field_strength)]


class Ambient(Part):
    """Free space with one scalar potential: electric (E = -grad phi) or magnetic (H = -grad psi).

    ``radius`` is where the meshed space ends, in m; None leaves it to the plan. ``outer`` says what follows
    there: open space or zero potential. ``applied_field`` is the field without the shell, in V/m or A/m.
    """

    field: Literal["electric", "magnetic"]
    outer: Literal["free-space", "grounded"] = "free-space"
    radius: Length | None = None
    applied_field: Annotated[tuple[FieldStrength, FieldStrength, FieldStrength], Components] = (0.0, 0.0, 0.0)


class Electrode(Part):
    """A compliant conductor on one face of the shell, held at ``voltage`` (V)."""

    voltage: Voltage


class Faces(Part):
    """What covers the two faces of the shell; None is a bare face."""

    top: Electrode | None = None
    bottom: Electrode | None = None
