"""Gaps between a shell and an electrode beside it, from the shell's size to 1e-4 of it: shells that are held, and such
that the field pulls across the gap."""

from __future__ import annotations

from functools import partial

from embedding.bench.extremes.cell import FAILED, Cell
from embedding.bench.extremes.electrodes import (
    LENGTH,
    PELESKO,
    SHEETS,
    at_pull_in,
    balloon,
    balloon_at,
    balloon_pull_in,
    limit_of,
    of_fringes,
    reached,
    strip,
    until,
)
from embedding.bench.extremes.fields import SPHERE, conductor, disc_charge_over, sphere_charge
from embedding.scene import Scene

GAPS = (1.0, 1e-1, 1e-2, 1e-3, 1e-4)


def cells() -> list[Cell]:
    """Concentric spheres and a disc over a plane, held; a balloon in a sphere, and sheets over a plane, pulled."""
    return [*held(), *balloons(), *membranes()]


def held() -> list[Cell]:
    """Charges of conductors that keep their shape."""
    found: list[Cell] = []
    for gap in GAPS:
        found.append(
            Cell(
                "gaps", "sphere in a grounded sphere", f"{gap:.0e}", partial(_spheres, gap),
                partial(_sphere, gap), "4 pi eps0 V / (1/R - 1/R_o)", tolerance=1e-4, slow=gap != 1e-2, seconds=300.0,
            )
        )  # fmt: skip
        if 1e-4 < gap < 1.0:  # the formula is for narrow gaps; a mesh of 1e-4 takes minutes
            found.append(
                Cell(
                    "gaps", "disc over a plane", f"{gap:.0e}", partial(_disc, gap), partial(_plates, gap),
                    "the discs of Kirchhoff and Shaw", tolerance=3e-3 if gap > 0.05 else 1e-3, slow=True, seconds=300.0,
                )
            )  # fmt: skip
    return found


def balloons() -> list[Cell]:
    """A charged membrane in a grounded sphere, of which it crosses a third before it is pulled in."""
    source = "the charged membrane in a grounded sphere"
    below, beyond = (f"balloon in a grounded sphere, {part} V_p" for part in ("0.99", "1.0001"))
    steps = [{"control": "load", "steps": 10}]
    return [
        cell
        for gap in GAPS
        for cell in (
            Cell(
                "gaps", below, f"{gap:.0e}", partial(balloon, gap, 0.99, steps), partial(balloon_at, gap, 0.99),
                source, tolerance=2e-4, slow=gap != 1e-2, seconds=600.0,
            ),
            Cell(
                "gaps", beyond, f"{gap:.0e}", partial(balloon, gap, 1.0001, steps), partial(_voltage_of, gap), source,
                tolerance=2e-4, answers=reached, reasons=frozenset({"PULL_IN"}), expected=FAILED, slow=True,
                seconds=600.0,
            ),
        )
    ]  # fmt: skip


def _voltage_of(gap: float) -> dict[str, float]:
    return {"voltage": balloon_pull_in(gap)["voltage"]}


def membranes() -> list[Cell]:
    """Limit points of tensioned membranes against the thin gap, and a gap for which there is no closed form."""
    slack = Cell(
        "gaps", "stretched strip over a plane", "1e+00", partial(strip, 1.0, 20.0, [{"control": "load", "steps": 10}]),
        source="no closed form: the strip is pulled out more than down", reasons=frozenset({"PULL_IN"}),
        expected=FAILED, slow=True, seconds=300.0,
    )  # fmt: skip
    found = [slack]
    # a mesh between a strip and a plane 1e-4 away has a million unknowns
    for row, way, gaps, seconds in (("strip", 0.44, (1e-1, 1e-2, 1e-3), 600.0), ("disc", 0.5, (1e-1, 1e-2), 300.0)):
        scene, _, axis = SHEETS[row]
        found += [
            Cell(
                "gaps", f"stretched {row} over a plane", f"{gap:.0e}",
                partial(scene, gap, 1.1, until(axis, way * gap * LENGTH)), partial(at_pull_in, row, gap),
                PELESKO, tolerance=of_fringes(gap), answers=limit_of, slow=gap < 0.05, seconds=seconds,
            )
            for gap in gaps
        ]  # fmt: skip
    return found


def _sphere(gap: float) -> dict[str, float]:
    return {"charge": sphere_charge(1.0 + gap)}


def _plates(gap: float) -> dict[str, float]:
    return {"charge": disc_charge_over(gap)}


def _spheres(gap: float) -> Scene:
    return Scene.from_table(conductor(SPHERE, {"outer": "grounded", "radius": 1.0 + gap}))


def _disc(gap: float) -> Scene:
    plane = {"kind": "half-space", "level": -gap, "voltage": 0.0}
    return Scene.from_table(conductor({"kind": "disc", "radius": 1.0}, {"bodies": [plane]}))
