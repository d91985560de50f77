"""Where the meshed space ends: from 1.01 to 1e4 sizes of the shell."""

from __future__ import annotations

from functools import partial

from embedding.bench.extremes.cell import FAILED, REFUSED, RIGHT, Cell, Numbers
from embedding.bench.extremes.fields import (
    PULL_IN,
    SPHERE,
    R,
    balloon_strain,
    balloon_voltage,
    charged,
    conductor,
    disc_charge,
    sphere_charge,
)
from embedding.scene import Scene

RADII = (1.01, 1.1, 2.0, 10.0, 100.0, 1e4)
DISC = {"kind": "disc", "radius": 1.0}


def cells() -> list[Cell]:
    """A row for each conductor, and one for a balloon that moves."""
    found = [
        Cell(
            "radii", "charged balloon", "1.03 R", partial(_balloon, 1.03), reasons=frozenset({"INVERTED_AMBIENT"}),
            source="the balloon needs 1.05 R", expected=FAILED, slow=True, seconds=200.0,
        )
    ]  # fmt: skip
    for radius in RADII:
        value = f"{radius:g} R"
        found += [
            Cell(
                "radii", "charge of a sphere", value, partial(_held, "sphere", radius), _of_sphere, "4 pi eps0 R V",
                tolerance=1e-4, slow=radius < 100.0,
            ),
            Cell(
                "radii", "charge of a disc", value, partial(_held, "disc", radius), _of_disc, "8 eps0 R V",
                tolerance=1e-3, slow=radius > 1.01,
            ),
            Cell(
                "radii", "charged balloon", value, partial(_balloon, radius), _of_balloon,
                "the charged membrane, l - l^-5 = w", tolerance=1e-3, fields=("ambient.radius",),
                expected=REFUSED if radius < 1.025 else RIGHT, slow=radius != 2.0, seconds=200.0,
            ),
        ]  # fmt: skip
        if radius > 1.05:  # a narrower space in 3D takes minutes
            found.append(
                Cell(
                    "radii", "charge of a sphere in 3D", value, partial(_held, "sphere", radius, "3d"), _of_sphere,
                    "4 pi eps0 R V", tolerance=2e-3, slow=True, seconds=300.0,
                )
            )  # fmt: skip
    return found


LOAD = 0.5 * PULL_IN
"""Stretches the balloon by 5 per cent, more than there is room for in the narrowest space."""


def _of_sphere() -> Numbers:
    return {"charge": sphere_charge()}


def _of_disc() -> Numbers:
    return {"charge": disc_charge()}


def _of_balloon() -> Numbers:
    return {"displacement": R * balloon_strain(LOAD)}


def _held(shape: str, radius: float, reduction: str = "auto") -> Scene:
    model = {"interface": "closed", "reduction": reduction}
    return Scene.from_table(conductor(SPHERE if shape == "sphere" else DISC, {"radius": radius}, model=model))


def _balloon(radius: float) -> Scene:
    table = charged({"voltage": balloon_voltage(LOAD)}, path=[{"steps": 3}])
    table["ambient"] = {**table["ambient"], "radius": radius * R}
    return Scene.from_table(table)
