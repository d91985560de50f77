"""What is run side by side: rows of programs with their arguments, and how far their answers are from the truth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from problems.exact.sphere import Theory, membrane_pressure, thick_pressure
from problems.published.sze_cylinders import HEMISPHERE

# Order 4 of this package agrees with itself to 3e-5 (sizes 4, 2, 1.5: 4.07452 / 8.14922, 4.07443 / 8.14887, 4.07447 /
# 8.14885), order 3 to 1e-4 (1.5: 4.07461 / 8.14818), Kratos' triangles 64 by 64 to 7e-4 (4.07162 / 8.14839).
CONVERGED = {"outward": 4.0745, "inward": 8.1489}
PUBLISHED = {name: HEMISPHERE.end(name) for name in CONVERGED}
STRETCH = 1.2
OWN = "embedding"


class Row(NamedTuple):
    """One program with its arguments; ``series`` is its curve in the picture, ``label`` its line in the table."""

    series: str
    label: str
    program: str
    arguments: tuple[str, ...]

    @property
    def own(self) -> bool:
        """Is it this package's?"""
        return self.program.startswith(OWN)


@dataclass(frozen=True)
class Case:
    """Rows that solve the same problem; times are given over those of row number ``reference``."""

    name: str
    title: str
    rows: tuple[Row, ...]
    reference: int
    thickness_ratio: float | None = None
    theory: Theory = "thick"

    def errors(self, answer: dict[str, Any]) -> dict[str, float]:
        """Relative errors of what a row printed, by name; the first is the one that is drawn."""
        if self.thickness_ratio is None:
            converged = {name: abs(answer[name] / value - 1.0) for name, value in CONVERGED.items()}
            published = {f"{name} (S4R)": abs(answer[name] / value - 1.0) for name, value in PUBLISHED.items()}
            return {"error": max(converged.values())} | converged | published
        # All are given the exact pressure at STRETCH; the error is that of the pressure at the stretch they found.
        found = _pressure(self.theory, answer["stretch"], self.thickness_ratio)
        return {"error": abs(_pressure(self.theory, STRETCH, self.thickness_ratio) / found - 1.0)}


def _pressure(theory: Theory, stretch: float, ratio: float) -> float:
    return (thick_pressure if theory == "thick" else membrane_pressure)(stretch, ratio)


def hemisphere() -> Case:
    """Hemisphere with a hole under P = 400, a quarter of it."""
    rows = []
    for element, steps, sizes in (("4N", 8, (8, 16, 32)), ("3N", 5, (16, 32))):
        for n in sizes:
            name = f"Kratos thin shell {element}"
            arguments = (str(n), f"ShellThinElementCorotational3D{element}", str(steps))
            rows.append(Row(name, f"{name}, {n} x {n}, {steps} steps", "kratos_hemisphere.py", arguments))
    for order, sizes in ((1, (1.25, 0.8)), (2, (3.5, 2.5, 1.6)), (3, (5.0, 3.0, 2.0)), (4, (6.0, 4.0, 2.5))):
        for size in sizes:
            name = f"{OWN} order {order}"
            rows.append(_hemisphere(name, order, size, 4))
    rows.append(_hemisphere(f"{OWN} order 2, path by default", 2, 2.5, 0))
    return Case("hemisphere", "hemisphere with a hole, P = 400", tuple(rows), reference=1)


def _hemisphere(name: str, order: int, size: float, steps: int) -> Row:
    label = f"{name}, size {size:g}" + (f", {steps} steps" if steps else "")
    return Row(name, label, "embedding_hemisphere.py", (str(order), str(size), str(steps)))


def balloon(ratio: float) -> Case:
    """Neo-Hookean balloon at stretch 1.2 against the exact thick sphere; the wall is ``ratio`` mid radii thick."""
    given = (str(ratio), repr(_pressure("thick", STRETCH, ratio)))
    rows = []
    for reduction, order, layers, sizes in (
        ("axisymmetric", 1, 2, (32, 64)),
        ("axisymmetric", 2, 1, (4, 8, 16)),
        ("octant", 1, 2, (8, 16)),
        ("octant", 2, 1, (4, 8)),
    ):
        for n in sizes:
            name = f"FElupe {reduction} order {order}"
            label = f"{name}, {n} x {layers}"
            rows.append(Row(name, label, "felupe_balloon.py", (reduction, str(order), str(n), str(layers), *given)))
    for reduction, theory, meshes in (
        ("axisymmetric", "membrane", ((1, 0.1), (2, 0.3), (3, 0.5), (3, 0.25), (4, 0.4))),
        ("axisymmetric", "bending", ((1, 0.1), (2, 0.3), (3, 0.5), (3, 0.25), (4, 0.4))),
        ("3d", "membrane", ((2, 0.3), (3, 0.5), (4, 0.8))),
        ("3d", "bending", ((2, 0.5), (2, 0.3), (3, 0.8), (3, 0.3), (4, 0.8))),
    ):
        for order, size in meshes:
            name = f"{OWN} {'octant' if reduction == '3d' else reduction} {theory}"
            label = f"{name}, order {order}, size {size:g}"
            arguments = (reduction, theory, str(order), str(size), *given)
            rows.append(Row(name, label, "embedding_balloon.py", arguments))
    title = f"balloon at stretch {STRETCH:g}, T/R = {ratio:g}"
    return Case(f"balloon_{ratio:g}", title, tuple(rows), reference=3, thickness_ratio=ratio)


def membrane(ratio: float) -> Case:
    """The same balloon as a membrane under the net pressure, against the membrane's own closed form."""
    given = (str(ratio), repr(_pressure("membrane", STRETCH, ratio)), "net")
    rows = []
    for reduction, place in (("axisymmetric", "axisymmetric"), ("3d", "octant")):
        for order, size in ((1, 0.1), (2, 0.3), (2, 0.15), (3, 0.5), (3, 0.25), (4, 0.8), (4, 0.4)):
            name = f"{OWN} {place} order {order}"
            arguments = (reduction, "membrane", str(order), str(size), *given)
            rows.append(Row(name, f"{name}, size {size:g}", "embedding_balloon.py", arguments))
    title = f"membrane balloon at stretch {STRETCH:g}, against the membrane's closed form"
    return Case("balloon_membrane", title, tuple(rows), reference=1, thickness_ratio=ratio, theory="membrane")


CASES = (hemisphere(), balloon(0.05), balloon(0.01), membrane(0.01))
