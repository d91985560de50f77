"""Ways to end space around a conductor: error against radius, order, unknowns and time, in one table.

A unit sphere at voltage 1, 0.36 off the centre of the ball that is meshed: charge 4 pi, dipole moment 0.36 times that.
Each method solves on the same mesh of the ball; times are relative to the second-order Robin condition there.

Run on its own: ``python -m benchmarks.far_field`` (two minutes); with ``docs`` it writes docs/far_field.md.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from netgen.occ import Pnt, Sphere
from ngsolve import Grad, InnerProduct, Norm, dx

from benchmarks.open_space import Answer, Region, Request, answer, open_space, sphere_answer
from benchmarks.pages import tell
from embedding.ambient.far import beyond, far_field
from embedding.geometry.domain import Domain
from embedding.geometry.surroundings import REACH

RADII, ORDERS = (1.6, 2.0, 4.0), (2, 3, 4)
SHELL, FAR = 0.5, 0.5
"""Size of elements on the sphere; of those far away, over the radius."""
REPEATS = 5
PAGE = Path(__file__).parent.parent / "docs" / "far_field.md"

Terms = Callable[[Domain, Any], list[Any]]


@dataclass(frozen=True)
class Method:
    """A way to end space: what is meshed beyond the ball, what is held at 0, and the energies of the potential."""

    name: str
    terms: Terms
    region: Region = "none"
    held: str = ""


def robin_of_first_order(domain: Domain, potential: Any) -> list[Any]:
    """phi^2 / 2R: exact for a net charge."""
    energy = 0.5 * domain.reduction.measure * potential * potential / domain.sizes.radius
    return [energy * domain.surface("outer")]


def map_of_the_potential(domain: Domain, potential: Any) -> list[Any]:
    """The mapped region with the potential itself as the unknown, and its infinite coefficients."""
    radius, place, slope = domain.sizes.radius, domain.reduction.position, Grad(potential)
    depth, r = (REACH - 1) * radius, Norm(domain.reduction.position)
    along = InnerProduct(place / r, slope)
    across = InnerProduct(slope, slope) - along * along
    energy = 0.5 * radius * depth * (along * along / r**2 + across / (REACH * radius - r) ** 2)
    return [domain.reduction.measure * energy * beyond(domain)]


def kelvin_ball(domain: Domain, potential: Any) -> list[Any]:
    """Kelvin's inversion in a ball of its own."""
    slope = Grad(potential)
    return [0.5 * InnerProduct(slope, slope) * dx("kelvin"), *robin_of_first_order(domain, potential)]


def of_product(*, infinite: bool) -> Terms:
    """The far field as scenes have it."""

    def terms(domain: Domain, potential: Any) -> list[Any]:
        return far_field(domain, (0.0, 0.0, 0.0), infinite=infinite).terms(potential)

    return terms


ROBIN = Method("Robin, second order", of_product(infinite=False))
METHODS = (
    Method("grounded there", lambda domain, potential: [], held="outer"),
    Method("Robin, first order", robin_of_first_order),
    ROBIN,
    Method("infinite map, potential", map_of_the_potential, "beyond", "infinity"),
    Method("infinite map", of_product(infinite=True), "beyond"),
    Method("Kelvin ball", kelvin_ball, "kelvin"),
)


def solved(method: Method, request: Request) -> Answer:
    """The fastest of a few solves."""
    domain = open_space(request)
    found = [answer(domain, lambda phi: method.terms(domain, phi), 1.0, method.held) for _ in range(REPEATS)]
    return min(found, key=lambda each: each.seconds)


def request(radius: float, order: int, region: Region) -> Request:
    """The mesh of one row."""
    return Request("3d", radius, order, region, SHELL, FAR * radius)


def row(method: Method, radius: float, order: int, base: Answer) -> str:
    """One row of the table, in Markdown."""
    found = base if method is ROBIN else solved(method, request(radius, order, method.region))
    charge, dipole = sphere_answer(1.0, 0.0)
    errors = f"{found.charge / charge - 1:+.1e} | {found.dipole[-1] / dipole - 1:+.1e}"
    return (
        f"| {method.name} | {radius:g} | {order} | {found.unknowns} | {errors} | {found.seconds / base.seconds:.1f} |"
    )


def boundary_elements(order: int, base: Answer) -> Iterator[str]:
    """The sphere by boundary elements; nothing where NGSolve was built without them."""
    try:
        from benchmarks.boundary_elements import capacitance
    except ImportError:
        return
    start = time.process_time()
    charge, unknowns = capacitance(Sphere(Pnt(0, 0, 0), 1.0).faces[0], SHELL, order - 1)
    ratio = (time.process_time() - start) / base.seconds
    yield f"| boundary elements | | {order} | {unknowns} | {charge / (4 * math.pi) - 1:+.1e} | | {ratio:.0f} |"


def report() -> Iterator[str]:
    """The table, line by line."""
    yield "| beyond the ball | radius | order | unknowns | charge off | dipole moment off | time |"
    yield "|---|---|---|---|---|---|---|"
    for order in ORDERS:
        for radius in RADII:
            base = solved(ROBIN, request(radius, order, "none"))
            yield from (row(method, radius, order, base) for method in METHODS)
        yield from boundary_elements(order, base)


def main(arguments: list[str]) -> None:
    """Print the table; with "docs" also write the page's."""
    tell(report(), PAGE if arguments == ["docs"] else None)


if __name__ == "__main__":
    main(sys.argv[1:])
