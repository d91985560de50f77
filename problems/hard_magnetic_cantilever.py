"""A hard-magnetic cantilever in a field across it: the elastica, the experiment, and what the beam's own field adds.

Physics: the field turns the remanence, and the beam with it, towards its own direction. In a field that the beam does
not change this is a dead load. The beam's own field is that of two opposite poles, one at the clamp and one at the
tip: they attract each other, which softens the beam a little.

Reference: `problems.exact.hard_magnetic_elastica`, an inextensible beam; a strip in plane strain has the stiffness
mu T^3 / 3 and stretches a little, which vanishes as T^2. The experiment is `problems.published.hard_magnetic_beam`.
The poles of a strip are lines; where its remanence fades out at the ends, their attraction is that of
`problems.exact.magnetised_strip`.

Run: about twenty seconds.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from embedding import Plate, Scene, Solution, Strip, load_scene, solve
from embedding.scene.scales import MU_0
from problems.common import Array, Probe, Reading, print_files, print_steps
from problems.exact import magnetised_strip
from problems.exact.hard_magnetic_elastica import Tip, tip
from problems.published.hard_magnetic_beam import ZHAO

SCENE = Path(__file__).with_suffix(".toml")
REMANENCE = 143.2566e-3
"""In T, as in the scene file."""
SHEAR_MODULUS = 227.25e3
"""In Pa, of a strip that is as stiff in plane strain as the beam of 303 kPa."""
SCATTER = 0.052
"""Of measured deflections over the length: 3 to 5 per cent of the digitisation; the elastica is off by up to 0.042."""


class Tips(NamedTuple):
    """Where the tip is at the end of every step, over the length: along the field, and how much shorter."""

    deflection: Array
    shortening: Array


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"shell.thickness=1 mm"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None) -> tuple[Solution, Tips]:
    """Solve the scene with overrides; where the tip went."""
    stated = scene(*changes)
    shape = stated.shell.shape
    if not isinstance(shape, Plate | Strip):
        raise ValueError("the beam is a plate or a strip")
    end = (shape.length, 0.0, 0.0)
    along = "y" if isinstance(shape, Strip) else "z"
    probe = Probe({"deflection": Reading(end, along), "shortening": Reading(end, "x", -1.0)})
    solution = solve(stated, archive=archive, listeners=[probe])
    return solution, Tips(*(np.array(probe.values[name]) / shape.length for name in Tips._fields))


# -- a thin strip: the elastica


def strip(ratio: float, load: float) -> tuple[str, ...]:
    """Overrides for a strip of thickness over length ``ratio`` with the elastica's ``load``; the field is the same."""
    field, length = 37540.7, 17.2e-3
    modulus = 12.0 * REMANENCE * field / (4.0 * ratio**2 * load)
    return (
        "shell.shape={kind='strip', length='17.2 mm'}",
        f"shell.thickness={ratio * length!r}",
        f"shell.material.shear_modulus={modulus!r}",
        f"ambient.applied_field=[0, {field!r}, 0]",
        "discretisation.shell_size=0.86 mm",
    )


def elastica_error(ratio: float, load: float) -> float:
    """Distance of the tip from that of the elastica, over the length."""
    found = run(*strip(ratio, load))[1]
    known = tip(load)
    return math.hypot(found.deflection[-1] - known.deflection, found.shortening[-1] - known.shortening)


# -- the experiment


def measured(*changes: str) -> dict[str, Array]:
    """At the measured fields (mT) but zero: deflection found, of the elastica and measured, over the length."""
    fields = np.array(ZHAO.table["field"][1:])
    stages = ", ".join(f"{{field = {float(b / fields[-1])!r}, steps = 2}}" for b in fields)
    solution, found = run(f"path=[{stages}]", *changes)
    factors = np.array([step.factor_field for step in solution.steps])
    at = [int(np.abs(factors - b / fields[-1]).argmin()) for b in fields]
    known: list[Tip] = [tip(ZHAO.load(1e-3 * b)) for b in fields]
    return {
        "field": fields,
        "found": found.deflection[at],
        "elastica": np.array([t.deflection for t in known]),
        "measured": np.array(ZHAO.table["deflection"][1:]),
    }


# -- the strip's own field

FADING = "{expression=['143.2566*tanh((0.0172 - x)/0.00084)*tanh(x/0.00084)', '0', '0'], unit='mT'}"
"""The remanence fades out over one thickness at both ends: a sharp pole at a rim without a wall has no finite energy,
and its force would depend on the mesh."""


def own_field(strength: float, *changes: str) -> float:
    """How much more the strip of the experiment bends with its own field, at an applied field in A/m: a ratio."""
    beam = (
        "shell.shape={kind='strip', length='17.2 mm'}",
        f"shell.material.shear_modulus={SHEAR_MODULUS!r}",
        f"shell.remanence={FADING}",
        f"ambient.applied_field=[0, {strength!r}, 0]",
        "path=[{steps = 1}]",
        *changes,
    )
    joint, alone = (run(*beam, f"model.coupling={name}")[1].deflection[-1] for name in ("joint", "unperturbed"))
    return float(joint / alone)


def own_field_of_poles() -> float:
    """The same of a thin strip and small deflections."""
    stiffness = SHEAR_MODULUS * ZHAO.thickness**3 / 3.0
    strength = (REMANENCE * ZHAO.thickness) ** 2 / (MU_0 * stiffness) * ZHAO.length
    return magnetised_strip.own_field(strength, *magnetised_strip.fading(ZHAO.thickness / ZHAO.length))


if __name__ == "__main__":
    solution, _ = run(archive=Path("hard_magnetic_cantilever.vtkhdf"))
    print_steps(measured(), 4)
    for ratio in (0.02, 0.01, 0.005):
        print(f"strip of T/L = {ratio:<5g} at a = 5, tip from the elastica: {elastica_error(ratio, 5.0):.1e} L")
    bends = own_field(300.0, "discretisation.shell_size=1.7 mm")
    print(f"with the own field of a strip it bends {bends:.4f} times as far; two poles: {own_field_of_poles():.4f}")
    print_files(solution)
