"""What a run shows besides its usual fields: any quantity of the shell's geometry and stress, by name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator

from embedding.errors import Problem
from embedding.scene.materials import StVenantKirchhoff
from embedding.scene.messages import nearest, refusal
from embedding.scene.options import Fixed
from embedding.scene.part import Part
from embedding.scene.quantities import QUANTITIES
from embedding.scene.units import Components, LengthVector, Plain

if TYPE_CHECKING:
    from embedding.scene.scene import Scene

LISTED = "docs/fields.md lists all names"


def parsed(field: str) -> tuple[str, float | None]:
    """``"shifter_deformed@0.5"`` as the quantity's name and its place in the thickness, None without one.

    Raises:
        ValueError: no such quantity, a place where none belongs or none where one does; the text says what may stand.
    """
    name, at, text = field.partition("@")
    if name not in QUANTITIES:
        guess = nearest(name, QUANTITIES)
        raise ValueError(f'did you mean "{guess}"? {LISTED}' if guess else f"no such field; {LISTED}")
    if not QUANTITIES[name].place:
        if at:
            raise ValueError(f'does not depend on the place in the thickness: write "{name}"')
        return name, None
    try:
        place = float(text)
    except ValueError:
        place = float("nan")
    if not -0.5 <= place <= 0.5:
        raise ValueError(f'must name a place in the thickness from -0.5 to 0.5, such as "{name}@0.5" for the top face')
    return name, place


def _field(value: Any) -> str:
    if not isinstance(value, str):
        raise refusal(f'must be the name of a field, such as "mean_curvature_deformed"; {LISTED}')
    try:
        parsed(value)
    except ValueError as error:
        raise refusal(str(error)) from error
    return value


def _different(fields: tuple[str, ...]) -> tuple[str, ...]:
    if len(set(fields)) < len(fields):
        raise refusal("must name every field once")
    return fields


def _not_zero(direction: tuple[float, float, float]) -> tuple[float, float, float]:
    if not any(direction):
        raise refusal("must not be the zero vector")
    return direction


def _named(value: Any) -> Any:
    if not isinstance(value, Mapping) or not all(isinstance(name, str) and name.isidentifier() for name in value):
        raise refusal('must be a table of names and points of the mid-surface, such as { tip = ["0.1 m", 0, 0] }')
    return value


class Output(Part):
    """``fields`` by name, and the surface coordinates that components are given in.

    The displacement of each of the ``points`` of the reference mid-surface, in m, is recorded at every step: of one
    called tip as the scalars u_tip_x, u_tip_y, u_tip_z.

    ``coordinates``: "frame" takes A_1 along ``direction`` projected to the surface (in a reduction: along the curve);
    "polar", "cylindrical" and "spherical" are those about the z axis.
    """

    points: Annotated[dict[str, LengthVector], BeforeValidator(_named), AfterValidator(Fixed)] = Fixed()
    fields: Annotated[tuple[Annotated[str, BeforeValidator(_field)], ...], AfterValidator(_different)] = ()
    coordinates: Literal["frame", "polar", "cylindrical", "spherical"] = "frame"
    direction: Annotated[tuple[Plain, Plain, Plain], Components, AfterValidator(_not_zero)] = (1.0, 0.0, 0.0)


def output_problems(scene: Scene) -> Iterator[Problem]:
    """Fields that this order or this material cannot give."""
    flat = scene.discretisation.order == 1
    materials = [scene.shell.material, *(region.material for region in scene.shell.regions)]
    compressible = any(isinstance(material, StVenantKirchhoff) for material in materials)
    for number, field in enumerate(scene.output.fields):
        name, _ = parsed(field)
        if QUANTITIES[name].bends and flat:
            message = f"{field} is not allowed: it needs second derivatives, so discretisation.order must be at least 2"
            yield Problem(f"output.fields.{number}", message)
        if name == "pressure_3d" and compressible:
            message = f"{field} is not allowed: the material is compressible and has no pressure of its own"
            yield Problem(f"output.fields.{number}", message)
