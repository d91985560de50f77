"""The form of a published case: everything a reader needs to compute it again, and what to compare."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

Confidence = Literal["high", "medium"]


@dataclass(frozen=True)
class Case:
    """Consistent units, none given in the source. The material is Hooke's law in the shell's plane stress.

    `table` has a column "factor", the load over `largest_load`, and one column a quantity, all of equal length.
    `others` are end values at the full load by other codes or meshes: where they differ from the table by more
    than a solver's tolerance, the table is not converged in the mesh.
    """

    name: str
    source: str
    geometry: Mapping[str, float]
    young: float
    poisson_ratio: float
    supports: str
    load: str
    largest_load: float
    quantities: Mapping[str, str]
    table: Mapping[str, tuple[float, ...]]
    mesh: str
    confidence: Confidence
    others: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    notes: str = ""

    def end(self, quantity: str) -> float:
        """The published value in the last row: the full load, or the end of the path."""
        return self.table[quantity][-1]

    def at(self, factor: float, quantity: str) -> float:
        """The published value at a tabulated load factor; KeyError for another one."""
        row = dict(zip(self.table["factor"], self.table[quantity], strict=True))
        return row[factor]


def columns(names: str, rows: str) -> dict[str, tuple[float, ...]]:
    """A table typed as text: the names of the columns, and one line a row."""
    values = [[float(x) for x in line.split()] for line in rows.strip().splitlines()]
    return dict(zip(names.split(), zip(*values, strict=True), strict=True))


SZE = (
    "K. Y. Sze, X. H. Liu, S. H. Lo, Popular benchmark problems for geometric nonlinear analysis of shells, "
    "Finite Elem. Anal. Des. 40 (2004) 1551-1569, doi:10.1016/j.finel.2003.11.001"
)
