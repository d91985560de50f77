"""The loading path: stages in which the loads and the field are ramped."""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator

from embedding.scene.part import Part
from embedding.scene.texts import Name
from embedding.scene.units import Number, Plain, Ratio


class Stage(Part):
    """One ramp, in ``steps`` steps.

    ``mechanical`` scales the loads and given displacements, ``field`` the voltages and the applied field at the end of
    the stage; both run linearly from the end of the stage before (from 0 at the start). ``volume_ratio`` controls the
    enclosed volume of a closed shell, relative to the reference; the pressure difference p_b - p_t is then
    the unknown.
    """

    name: Name = "load"
    steps: Annotated[int, BeforeValidator(Number(whole=True, at_least=1, at_most=10_000))] = 10
    mechanical: Plain = 1.0
    field: Plain = 1.0
    volume_ratio: Ratio | None = None
