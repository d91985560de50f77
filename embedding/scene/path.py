"""The loading path: stages in which the loads and the field are ramped, or followed wherever they go."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import AfterValidator, BeforeValidator, model_validator

from embedding.scene.messages import refusal
from embedding.scene.part import Part
from embedding.scene.texts import Name
from embedding.scene.units import Coordinate, LengthVector, Number, Plain, Ratio

Control = Literal["auto", "load", "arc-length", "volume", "displacement"]
Steps = Annotated[int, BeforeValidator(Number(whole=True, at_least=1, at_most=10_000))]



class Until(Part):
    """A displacement at which a stage ends: ``value`` in m along ``axis`` at a point ``where`` of the mid-surface,
    given in m. In an axisymmetric reduction x and y both mean the radial direction."""

    where: LengthVector
    axis: Literal["x", "y", "z"]
    value: Coordinate


def _not_zero(value: float) -> float:
    if value == 0.0:
        raise refusal("must not be 0: without an imperfection there is no way onto the other branch")
    return value


class Branch(Part):
    """Where a stage leaves its path for the branch that crosses it: at its ``number``-th bifurcation point.

    ``amplitude`` is the imperfection that leads onto the branch: the first state on it is the one in which the critical
    mode has this root-mean-square displacement, in sizes of the shape. Its sign chooses the side.
    """

    at: Literal["bifurcation"] = "bifurcation"
    number: Annotated[int, BeforeValidator(Number(whole=True, at_least=1, at_most=100))] = 1
    amplitude: Annotated[float, BeforeValidator(Number(at_least=-0.5, at_most=0.5)), AfterValidator(_not_zero)] = 1e-2


class Stage(Part):
    """One part of the path.

    ``mechanical`` scales the loads and the given displacements, ``field`` the voltages and the applied field at the end
    of the stage; both start where the stage before ended (from 0 at the start). ``volume_ratio`` controls the enclosed
    volume of a closed shell, relative to the reference; the pressure difference p_b - p_t is then the unknown.

    ``control`` "load" ramps linearly in ``steps`` steps (10 unless given) and stops at a limit point. "arc-length"
    follows the equilibrium path through limit points until the end is met for the first time, in steps of its own
    choice; ``steps`` then bounds what one step may change. "displacement" needs ``until`` and reaches it in ``steps``
    equal parts of it, the load being unknown. "auto" is arc length where a load or the field changes and neither
    ``steps`` nor ``volume_ratio`` is given; the square of ``field`` then goes linearly with ``mechanical``, as forces
    do. With ``until`` the stage ends at that displacement, at whatever load it takes. ``branch`` says where to leave
    the path for another.
    """

    name: Name = "load"
    steps: Steps | None = None
    mechanical: Plain = 1.0
    field: Plain = 1.0
    volume_ratio: Ratio | None = None
    control: Control = "auto"
    until: Until | None = None
    branch: Branch | None = None

    @model_validator(mode="after")
    def _control_fits(self) -> Self:
        if self.control == "volume" and self.volume_ratio is None:
            raise refusal("volume control needs volume_ratio, where the stage ends", field="control", value="volume")
        if self.control in ("load", "displacement") and self.volume_ratio is not None:
            reason = "volume_ratio is given, so the volume is what is controlled"
            raise refusal(reason, field="control", value=self.control)
        if self.control == "displacement" and self.until is None:
            reason = "displacement control needs until, where the stage ends"
            raise refusal(reason, field="control", value=self.control)
        if self.until is not None and (self.volume_ratio is not None or self.control in ("load", "volume")):
            raise refusal("a stage ends at a load, at a volume or at a displacement", field="until", value={})
        if self.branch is not None and self.control in ("load", "volume"):
            reason = 'only a path that is followed has branches: use control = "arc-length"'
            raise refusal(reason, field="branch", value={})
        return self
