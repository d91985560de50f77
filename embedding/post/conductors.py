"""The voltage and the charge of every conductor at every step, from the recorded scalars."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive
from embedding.scene import HalfSpace

Floats = npt.NDArray[np.float64]
BODY = "_body"


@dataclass(frozen=True)
class Conductor:
    """Voltages (V) and charges (C; plane strain: C/m), one a step; ``suffix`` is that of the scalars: "" of the shell,
    "_jump" of a film between electrodes, "_body0" of a body. Of poles in a magnetic field A and Wb."""

    suffix: str
    voltage: Floats
    charge: Floats


def conductors(run: Archive) -> list[Conductor]:
    """All that have a voltage and a charge.

    Of a half-space in free space the archive has the charge of the part within the ambient's radius. With what lies
    beyond, space as a whole is neutral: it is minus the charge of all others.
    """
    level, content = ("potential", "flux") if run.scales.magnetic else ("voltage", "charge")
    suffixes = [name.removeprefix(level) for name in run.scalars if name.split("_")[0] == level]
    found = [
        Conductor(suffix, run.scalars[f"{level}{suffix}"], run.scalars[f"{content}{suffix}"])
        for suffix in suffixes
        if f"{content}{suffix}" in run.scalars
    ]
    endless = _endless(run)
    if endless is None:
        return found
    whole = -sum((one.charge for one in found if one.suffix != endless), np.zeros(len(run)))
    return [replace(one, charge=whole) if one.suffix == endless else one for one in found]


def at_infinity(run: Archive, step: int) -> float:
    """The potential far away in free space: that of a half-space, or 0."""
    return next((float(one.voltage[step]) for one in conductors(run) if one.suffix == _endless(run)), 0.0)


def capacitances(run: Archive, step: int, through_faces: float) -> dict[str, tuple[float, float]]:
    """Charge over voltage of every conductor, with its error; nan at no voltage. Of a pole the permeance, flux over
    potential.

    Known is that of the shell's: how far the charge that leaves ``through_faces`` is from the recorded one.
    """
    found, name = {}, "permeance" if run.scales.magnetic else "capacitance"
    for one in conductors(run):
        volts, coulombs = float(one.voltage[step]), float(one.charge[step])
        off = math.nan if one.suffix else abs(through_faces - coulombs)
        found[f"{name}{one.suffix}"] = (coulombs / volts, off / abs(volts)) if volts else (math.nan, math.nan)
    return found


def _endless(run: Archive) -> str | None:
    """The suffix of a half-space that goes on beyond the meshed space."""
    ambient = run.scene_object().ambient
    if ambient is None or ambient.outer != "free-space":
        return None
    numbers = [number for number, body in enumerate(ambient.bodies) if isinstance(body, HalfSpace)]
    return f"{BODY}{numbers[0]}" if numbers else None
