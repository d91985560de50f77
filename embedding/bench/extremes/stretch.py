"""Stretches from 0.2 to 10 of sheets and balloons, of every kind of rubber; Gent's at 99 % of its limit."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

from embedding.bench.extremes.cell import FAILED, RIGHT, Cell
from embedding.bench.extremes.tables import Table, scene_of
from embedding.scene import Scene

STRETCHES = (0.2, 0.5, 2.0, 5.0, 10.0)
MODULUS, SIZE = 1e5, 0.1
THICKNESS, RADIUS = 1e-4, 0.1
QUICK = {("sheet, equibiaxial", "gent", 0.2), ("balloon", "gent", 10.0), ("balloon", "neo-hookean", 0.2)}
"""Cells of the default tests."""
NEAR = 0.99
"""How near Gent's chains are to their limit."""


@dataclass(frozen=True)
class Rubber:
    """A law by its parts: the coefficients of (l^a - l3^a) in the Cauchy stress, or Gent's."""

    name: str
    moduli: tuple[float, ...] = ()
    exponents: tuple[float, ...] = ()

    def stress(self, along: float, aside: float) -> float:
        """Cauchy stress along a principal direction, the faces free (Ogden, Proc. R. Soc. A 326 (1972) 565)."""
        across = 1.0 / (along * aside)
        if self.name == "gent":
            return MODULUS / (1.0 - NEAR) * (along**2 - across**2)
        pairs = zip(self.moduli, self.exponents, strict=True)
        return MODULUS * float(sum(mu * (along**a - across**a) for mu, a in pairs))

    def table(self, along: float, aside: float) -> Table:
        """As in a scene; Gent's limit is that of chains near it at these stretches."""
        if self.name == "gent":
            excess = along**2 + aside**2 + (along * aside) ** -2 - 3.0
            return {"law": "gent", "shear_modulus": MODULUS, "limit": excess / NEAR}
        if self.name == "neo-hookean":
            return {"law": "neo-hookean", "shear_modulus": MODULUS}
        if self.name == "mooney-rivlin":
            return {"law": "mooney-rivlin", "c1": 0.5 * MODULUS * self.moduli[0], "c2": -0.5 * MODULUS * self.moduli[1]}
        return {"law": "ogden", "moduli": [MODULUS * mu for mu in self.moduli], "exponents": list(self.exponents)}


LAWS = (
    Rubber("neo-hookean", (1.0,), (2.0,)),
    Rubber("mooney-rivlin", (0.8, -0.2), (2.0, -2.0)),
    Rubber("ogden", (1.491, 0.003, -0.0237), (1.3, 5.0, -2.0)),
    Rubber("gent"),
)
"""Ogden's with his numbers for Treloar's rubber, over its shear modulus."""


def cells() -> list[Cell]:
    """A row for each body and law, a column for each stretch."""
    return [body(law, stretch) for body in (pulled, spread, balloon) for law in LAWS for stretch in STRETCHES]


def _cell(body: str, law: Rubber, stretch: float, scene: Scene | partial[Scene], reference: Mapping[str, float],
          source: str, **more: object) -> Cell:  # fmt: skip
    quick = (body, law.name, stretch) in QUICK
    return Cell(
        "stretch", f"{body}, {law.name}", f"{stretch:g}", scene, lambda: reference, source,  # type: ignore[arg-type]
        tolerance=5e-6, slow=not quick, **more,  # type: ignore[arg-type]
    )  # fmt: skip


def pulled(law: Rubber, stretch: float) -> Cell:
    """A sheet pulled or pushed along one direction, held flat."""
    aside = stretch**-0.5
    traction = THICKNESS * law.stress(stretch, aside) / stretch
    scene = partial(_sheet, law.table(stretch, aside), (traction, 0.0))
    reference = {"stretch_max": max(stretch, aside), "stretch_min": min(stretch, aside)}
    return _cell("sheet, uniaxial", law, stretch, scene, reference, "uniform stress")


def spread(law: Rubber, stretch: float) -> Cell:
    """A sheet pulled or pushed along both directions, held flat."""
    traction = THICKNESS * law.stress(stretch, stretch) / stretch
    scene = partial(_sheet, law.table(stretch, stretch), (traction, traction))
    return _cell("sheet, equibiaxial", law, stretch, scene, {"stretch_max": stretch}, "uniform stress")


def _sheet(material: Table, tractions: tuple[float, float]) -> Scene:
    pulls = [
        {"edge": "x1", "traction": [tractions[0], 0.0, 0.0]},
        {"edge": "y1", "traction": [0.0, tractions[1], 0.0]},
    ]
    return scene_of(
        "sheet", {"kind": "plate", "length": SIZE, "width": SIZE}, THICKNESS, material,
        supports=[{"where": "x0", "fix": ["x"]}, {"where": "y0", "fix": ["y"]}, {"where": "surface", "fix": ["z"]}],
        loads={"edge_tractions": pulls}, model={"theory": "membrane"}, discretisation={"shell_size": SIZE},
    )  # fmt: skip


def balloon(law: Rubber, stretch: float) -> Cell:
    """A balloon filled to a volume, its pressure against that of the membrane; emptied, it wrinkles."""
    pressure = 2.0 * THICKNESS * law.stress(stretch, stretch) / (RADIUS * stretch**3)
    if stretch < 1.0:
        return _cell(
            "balloon", law, stretch, partial(_balloon, law.table(stretch, stretch), stretch), {}, "wrinkling",
            reasons=frozenset({"COMPRESSIVE_MEMBRANE"}), expected=FAILED,
        )  # fmt: skip
    scene = partial(_balloon, law.table(stretch, stretch), stretch)
    return _cell(
        "balloon", law, stretch, scene, {"pressure_difference": pressure, "stretch": stretch},
        "Green and Adkins, Large Elastic Deformations (1960)", expected=RIGHT,
    )  # fmt: skip


def _balloon(material: Table, stretch: float) -> Scene:
    steps = 1 + math.ceil(4 * abs(math.log(stretch)))
    return scene_of(
        "balloon", {"kind": "sphere", "radius": RADIUS}, THICKNESS, material,
        path=[{"volume_ratio": stretch**3, "steps": steps}], model={"theory": "membrane"},
    )  # fmt: skip
