"""Capacitance of a thin disc, 8 eps R: error against unknowns and time, in axisymmetry and in 3D, in one table.

The field is singular at the rim, and the elements there decide. Meshes are those of scenes: the disc as an interface
in space (3D: between two mirror planes), elements that grow from the rim. "Field" is the potential alone, elements
condensed and a direct solver; "run" is a whole run of the same scene, which ends with an error estimate at one order
more. Times are relative to a Poisson problem of order 2 with nine thousand unknowns in a cube, one thread.

Run on its own: ``python -m benchmarks.disc_capacitance`` (two minutes); with ``docs`` it writes
docs/disc_capacitance.md.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from netgen.occ import OCCGeometry, unit_cube
from ngsolve import (
    BND,
    H1,
    BilinearForm,
    Grad,
    GridFunction,
    InnerProduct,
    Mesh,
    SetNumThreads,
    TaskManager,
    Variation,
    dx,
)

from benchmarks.pages import tell
from embedding.ambient.far import far_field
from embedding.geometry.domain import Domain, MeshSizes, build
from embedding.geometry.reduction import Name, Reduction
from embedding.scene import Disc
from problems import capacitances
from problems.exact import capacitance as exact

PAGE = Path(__file__).parent.parent / "docs" / "disc_capacitance.md"
REPEATS, ENOUGH = 3, 1.0
"""The fastest of this many, as long as together they take less than this, s."""
ORDERS = (2, 3, 4)
"""Of the potential."""


@dataclass(frozen=True)
class Meshes:
    """A ladder of meshes: sizes of elements along the rim, over the radius of the disc, those on the disc, and growth;
    where the meshed space ends, and whether the infinite map follows. Whole runs are timed at the sizes ``runs``."""

    name: Name
    rims: tuple[float, ...]
    shell: float
    grading: float
    radius: float
    infinite: bool
    runs: tuple[float, ...]

    def sizes(self, rim: float, order: int) -> MeshSizes:
        """The request of one mesh for a potential of this order."""
        edges = (("rim", rim),)
        return MeshSizes(
            self.shell, self.radius / 2, self.radius, self.grading, order - 1, edges, beyond=self.infinite
        )

    def changes(self, rim: float, order: int) -> tuple[str, ...]:
        """The same as overrides of the scene of `problems.capacitances`."""
        size = capacitances.R
        return (
            f"model.reduction={self.name}", f"model.far_field={'infinite' if self.infinite else 'robin'}",
            f"discretisation.edge_size={{rim = {rim * size!r}}}", f"discretisation.order={order - 1}",
            f"discretisation.shell_size={self.shell * size!r}", f"discretisation.grading={self.grading}",
            f"ambient.radius={self.radius * size!r}",
        )  # fmt: skip


LADDERS = (
    Meshes("axisymmetric", (0.05, 1e-2, 1e-3, 1e-4, 1e-5), 0.2, 0.6, 2.0, True, (0.05, 1e-4)),
    Meshes("axisymmetric", (1e-3, 1e-4, 1e-5), 0.2, 0.3, 2.0, True, ()),
    Meshes("3d", (0.1, 0.05, 0.02), 0.4, 0.6, 4.0, False, (0.1,)),
)


def fastest(action: Callable[[], Any]) -> tuple[Any, float]:
    """What ``action`` returns, and the least time it took, s."""
    seconds: list[float] = []
    while len(seconds) < REPEATS and sum(seconds) < ENOUGH:
        start = time.process_time()
        found = action()
        seconds.append(time.process_time() - start)
    return found, min(seconds)


def poisson(mesh: Mesh) -> None:
    """The problem that times are relative to."""
    space = H1(mesh, order=2, dirichlet=".*")
    u, v = space.TnT()
    form = BilinearForm(Grad(u) * Grad(v) * dx, symmetric=True).Assemble()
    form.mat.Inverse(space.FreeDofs(), inverse="sparsecholesky")


def capacitance(domain: Domain, *, infinite: bool) -> tuple[float, int]:
    """Over eps R, twice the field's energy at one volt; and the number of unknowns."""
    space = H1(domain.mesh, order=domain.sizes.potential_order, dirichlet="shell")
    trial, potential = space.TrialFunction(), GridFunction(space)
    form = BilinearForm(space, symmetric=True, condense=True)
    energy = 0.5 * domain.reduction.measure * InnerProduct(Grad(trial), Grad(trial))
    form += Variation(energy * dx("outside.*|inside.*", bonus_intorder=1)).Compile()
    for term in far_field(domain, (0.0, 0.0, 0.0), infinite=infinite).terms(trial):
        form += Variation(term).Compile()
    potential.Set(1.0, BND, definedon=domain.shell)
    form.AssembleLinearization(potential.vec)
    residual, step = potential.vec.CreateVector(), potential.vec.CreateVector()
    form.Apply(potential.vec, residual)
    residual.data += form.harmonic_extension_trans * residual
    step.data = form.mat.Inverse(space.FreeDofs(True), inverse="sparsecholesky") * residual
    step.data += form.harmonic_extension * step
    step.data += form.inner_solve * residual
    potential.vec.data -= step
    return 2.0 * form.Energy(potential.vec), space.ndof


def rows(ladder: Meshes, unit: float) -> Iterator[str]:
    """Rows of the table, in Markdown: a mesh, and what each order makes of it."""
    reduction = Reduction(ladder.name, ("x", "y") if ladder.name == "3d" else ())
    for rim in ladder.rims:
        before = 0.0
        for order in ORDERS:
            sizes = ladder.sizes(rim, order)
            domain, meshing = fastest(partial(build, Disc(radius=1.0), reduction, sizes))
            (found, unknowns), field = fastest(partial(capacitance, domain, infinite=ladder.infinite))
            error, limit, run = found / exact.disc(1.0) - 1.0, "", ""
            if ladder.name == "3d" and order > ORDERS[0]:
                limit = f"{capacitances.beyond_order(before, error, order - 1):+.1e}"
            if rim in ladder.runs:
                whole = partial(capacitances.error, capacitances.RIMMED["disc"], *ladder.changes(rim, order))
                run = f"{fastest(whole)[1] / unit:.1f}"
            before = error
            yield (
                f"| {ladder.name} | {ladder.grading:g} | {rim:g} | {order} | {unknowns:,} | {error:+.1e} | {limit} "
                f"| {meshing / unit:.2f} | {field / unit:.2f} | {run} |"
            )


def report() -> Iterator[str]:
    """The table, line by line."""
    SetNumThreads(1)
    with TaskManager():
        mesh = Mesh(OCCGeometry(unit_cube.shape).GenerateMesh(maxh=0.09))
        _, unit = fastest(partial(poisson, mesh))
        yield "| | growth | rim | order | unknowns | error | limit of two orders | mesh | field | run |"
        yield "|---|---|---|---|---|---|---|---|---|---|"
        for ladder in LADDERS:
            yield from rows(ladder, unit)


def main(arguments: list[str]) -> None:
    """Print the table; with "docs" also write the page's."""
    tell(report(), PAGE if arguments == ["docs"] else None)


if __name__ == "__main__":
    main(sys.argv[1:])
