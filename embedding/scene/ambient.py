"""The space around the shell, its field, and the electrodes on the faces of the shell."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, BeforeValidator, Discriminator, Tag, ValidationInfo, model_validator

from embedding.scene.bodies import Body
from embedding.scene.messages import TABLE, VALUE, refusal
from embedding.scene.part import Part, known
from embedding.scene.surface_fields import value_or_table
from embedding.scene.texts import Names
from embedding.scene.units import (
    ELECTRIC_FIELD,
    MAGNETIC_FIELD,
    Charge,
    Components,
    Current,
    Length,
    LengthVector,
    PlainVector,
    PositiveLengthVector,
    Ratio,
    Voltage,
)
from embedding.scene.vector_fields import AppliedField


def _si(info: ValidationInfo) -> str:
    return "A/m" if info.data.get("field") == "magnetic" else "V/m"


def _field_strength(value: Any, info: ValidationInfo) -> float:
    number = MAGNETIC_FIELD if _si(info) == "A/m" else ELECTRIC_FIELD
    return number(value)


def _with_a_unit(value: Any, info: ValidationInfo) -> Any:
    return {"unit": _si(info)} | value if isinstance(value, dict) else value


def _of_the_field(value: Any, info: ValidationInfo) -> Any:
    if isinstance(value, AppliedField) and value.electric != (_si(info) == "V/m"):
        reason = f"must be a unit of the {info.data.get('field', 'electric')} field, such as {_si(info)}"
        raise refusal(reason, field="unit", value=value.unit)
    return value


FieldStrength = Annotated[float, BeforeValidator(_field_strength)]
Applied = Annotated[
    Annotated[Annotated[tuple[FieldStrength, FieldStrength, FieldStrength], Components], Tag(VALUE)]
    | Annotated[AppliedField, Tag(TABLE)],
    Discriminator(value_or_table(AppliedField)),
    BeforeValidator(_with_a_unit),
    AfterValidator(_of_the_field),
]


def _direction(value: tuple[float, float, float]) -> tuple[float, float, float]:
    if not any(value):
        raise refusal("must point somewhere")
    return value


class LineCurrent(Part):
    """A straight wire of infinite length: ``through`` a point in m, ``along`` a direction, with a ``current`` in A.

    Its field circulates about it by the right hand, with the strength I / (2 pi distance).
    """

    through: LengthVector = (0.0, 0.0, 0.0)
    along: Annotated[PlainVector, AfterValidator(_direction)]
    current: Current


class Ambient(Part):
    """The space around the shell, with one scalar potential: electric (E = -grad phi) or magnetic (H = -grad psi).

    ``radius`` is where the meshed space ends, in m; None leaves it to the plan. Instead of it ``box`` gives half the
    edge lengths of a box around the origin. ``outer`` says what follows there: open space or zero potential.
    ``applied_field`` is the field without the shell, in V/m or A/m, uniform or an expression of the place in space;
    ``line_currents`` add theirs. The space is filled with a liquid of the given permittivity or permeability relative
    to vacuum; ``inside_...`` is that of the liquid in a closed shell, None for the same. ``bodies`` stand in it.
    """

    field: Literal["electric", "magnetic"]
    outer: Literal["free-space", "grounded"] = "free-space"
    radius: Length | None = None
    box: PositiveLengthVector | None = None
    applied_field: Applied = (0.0, 0.0, 0.0)
    line_currents: tuple[LineCurrent, ...] = ()
    relative_permittivity: Ratio = 1.0
    relative_permeability: Ratio = 1.0
    inside_relative_permittivity: Ratio | None = None
    inside_relative_permeability: Ratio | None = None
    bodies: tuple[Body, ...] = ()

    @property
    def uniform_field(self) -> tuple[float, float, float]:
        """The applied field where it is the same everywhere, in V/m or A/m; zero where it is an expression."""
        applied = known(self.applied_field)
        return (0.0, 0.0, 0.0) if isinstance(applied, AppliedField) else applied

    @property
    def varying_field(self) -> AppliedField | None:
        """The applied field where it is an expression; None where it is the same everywhere."""
        applied = known(self.applied_field)
        return applied if isinstance(applied, AppliedField) else None

    @property
    def contrast(self) -> float:
        """Relative permittivity or permeability, by the kind of field, of what fills the space."""
        return self.relative_permittivity if self.field == "electric" else self.relative_permeability

    @property
    def inside_contrast(self) -> float:
        """Relative permittivity or permeability, by the kind of field, of what fills a closed shell."""
        electric = self.field == "electric"
        inside = self.inside_relative_permittivity if electric else self.inside_relative_permeability
        return self.contrast if inside is None else inside


class Electrode(Part):
    """A compliant conductor on one face of the shell, held at ``voltage`` (V) or with a ``charge`` (C).

    In plane strain the charge is that of a metre. ``where`` names the faces of a surface file that it covers; empty:
    all of it.
    """

    voltage: Voltage | None = None
    charge: Charge | None = None
    where: Names = ()

    @property
    def strength(self) -> float:
        """The voltage or charge that is given."""
        return self.voltage or self.charge or 0.0

    @model_validator(mode="after")
    def _one_drive(self) -> Self:
        if self.voltage is None and self.charge is None:
            raise refusal('give a voltage, such as "6 kV", or a charge, such as "2 nC"', field="voltage", value=None)
        if self.voltage is not None and self.charge is not None:
            reason = "an electrode has a voltage or a charge; leave out one of the two"
            raise refusal(reason, "C", field="charge", value=self.charge)
        return self


class Faces(Part):
    """What covers the two faces of the shell; None is a bare face. ``both``: the whole shell is one conductor."""

    top: Electrode | None = None
    bottom: Electrode | None = None
    both: Electrode | None = None

    @property
    def electrodes(self) -> dict[str, Electrode]:
        """Those that there are, by the name of their field."""
        stated = {name: known(getattr(self, name)) for name in ("top", "bottom", "both")}
        return {name: electrode for name, electrode in stated.items() if electrode is not None}

    @model_validator(mode="after")
    def _both_or_each(self) -> Self:
        if self.both is not None and not (self.top is None and self.bottom is None):
            reason = "the whole shell is one conductor: leave out top and bottom"
            raise refusal(reason, field="both", value={})
        return self
