"""A new mesh around a deformed shell: the shell is the same, the space around it fits, fields are carried over."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from ngsolve import BND, CF, ET, Grad, GridFunction, InnerProduct, Integrate, IntegrationRule, Trace, cos, sin, x, y, z

from embedding import Strip
from embedding.geometry.domain import Domain, MeshSizes, build
from embedding.geometry.facets import INNER
from embedding.geometry.matching import put
from embedding.geometry.reduction import Reduction
from embedding.geometry.remeshing import Remeshed, RemeshingError, remeshed
from embedding.geometry.spaces import TraceSpace
from tests.forms import Array, body

STRETCHED = {"octant": (1.5, 0.8, 2.0), "axisymmetric sphere": (1.6, 0.7), "ring": (1.8, 0.6)}
"""Bodies with the factors by which their coordinates are stretched."""


def displaced(domain: Domain, displacement: Any) -> GridFunction:
    field = GridFunction(TraceSpace(domain.mesh, domain.sizes.order).space)
    field.Set(displacement, BND, definedon=domain.shell)
    return field


def stretch(domain: Domain, factors: tuple[float, ...]) -> Any:
    return CF(tuple((f - 1) * c for f, c in zip(factors, (x, y, z), strict=False)))


def made(name: str, size: float = 0.5, order: int = 3) -> tuple[Domain, Remeshed]:
    domain = body(name, size, order, radius=4.0)
    return domain, remeshed(domain, displaced(domain, stretch(domain, STRETCHED[name])))


def volume(domain: Domain, side: str) -> float:
    """Volume of a side of the configuration the mesh starts from."""
    with domain.in_ambient():
        return float(Integrate(domain.reduction.measure * domain.volume(domain.materials(side)), domain.mesh))


def on_shell(domain: Domain, values: Any) -> Array:
    rule = IntegrationRule(ET.TRIG if domain.mesh.dim == 3 else ET.SEGM, 2)
    return np.asarray(CF(values)(domain.mesh.MapToAllElements(rule, domain.shell)))


@pytest.mark.parametrize("name", STRETCHED)
def test_the_shell_is_the_same(name: str) -> None:
    """Area, enclosed volume, side of the normal, curvature: all to rounding."""
    domain, found = made(name)
    new = found.domain
    for values in (
        lambda d: CF(1.0),
        lambda d: InnerProduct(d.reduction.position, d.normal),
        lambda d: Trace(d.sign * Grad(d.reduction.normal)),
        lambda d: d.reduction.position[0] ** 3,
    ):
        assert new.shell_integral(values(new)) == pytest.approx(domain.shell_integral(values(domain)), rel=1e-9)
    assert INNER in new.mesh.GetBBoundaries()
    assert new.rims == domain.rims
    assert new.kinks.sum() == domain.kinks.sum()


@pytest.mark.parametrize("name", STRETCHED)
def test_the_space_around_it_fits_the_deformed_shell(name: str) -> None:
    """Inside an ellipsoid (ellipse), outside the rest of the ball (disc), with the order of the geometry."""
    errors = []
    for size in (0.5, 0.25):
        found = made(name, size)[1].domain
        factors = STRETCHED[name]
        if name == "ring":
            inner, whole = math.pi * math.prod(factors), math.pi * 16
        else:
            semi = factors if name == "octant" else (factors[0], *factors)
            inner, whole = 4 / 3 * math.pi * math.prod(semi), 4 / 3 * math.pi * 64
        inside, outside = (volume(found, side) for side in ("inside", "outside"))
        assert inside + outside == pytest.approx(whole, rel=1e-3)  # coarse elements at the outer boundary
        errors.append(abs(inside / inner - 1))
        assert found.unfolded
    assert errors[1] < 2e-5 and errors[0] / errors[1] > 8


@pytest.mark.parametrize("name", STRETCHED)
def test_fields_on_the_shell_are_carried(name: str) -> None:
    domain, found = made(name, 0.5, 4)
    value = 1.0 + x * y - 2.0 * y**2 + (z * x if domain.mesh.dim == 3 else 0.0)
    trace = TraceSpace(domain.mesh, 4, vector=False)
    field = GridFunction(trace.space)
    field.Set(value, BND, definedon=domain.shell)
    new = TraceSpace(found.domain.mesh, 4, vector=False)
    carried = GridFunction(new.space)
    unknowns = put(new.scalar, found.matching.new, found.matching.sampled(field, 4))
    carried.vec.FV().NumPy()[:] = new.on_shell(unknowns[0])
    before, after = on_shell(domain, field - value), on_shell(found.domain, carried - value)
    assert np.abs(after).max() == pytest.approx(np.abs(before).max(), rel=1e-6, abs=1e-11)


def test_again_and_again() -> None:
    """A mesh around a deformed shell is made from another one of its kind; back at rest it fits the first shape."""
    domain, found = made("axisymmetric sphere")
    back = remeshed(found.domain, displaced(found.domain, CF((0.0, 0.0)))).domain
    assert back.shell_integral(1.0) == pytest.approx(domain.shell_integral(1.0), rel=1e-12)
    assert volume(back, "inside") == pytest.approx(volume(domain, "inside"), rel=1e-9)


def strip() -> Domain:
    sizes = MeshSizes(shell=0.1, far=1.0, radius=3.0, grading=0.4, order=3)
    return build(Strip(length=1.0), Reduction("plane-strain"), sizes)


def rolled(domain: Domain, angle: float) -> GridFunction:
    """The strip bent to an arc of ``angle``."""
    return displaced(domain, CF((sin(angle * x) / angle - x, (1 - cos(angle * x)) / angle)))


def test_an_open_shell_rolled_up() -> None:
    domain = strip()
    found = remeshed(domain, rolled(domain, 0.9 * 2 * math.pi)).domain
    assert found.open and len(found.rim_vertices) == 2 and set(found.rims) == set(domain.rims)
    assert volume(found, "inside") + volume(found, "outside") == pytest.approx(9 * math.pi, rel=1e-4)
    assert found.unfolded


@pytest.mark.parametrize("turns", [1.0, 1.3])
def test_a_shell_that_touches_itself_has_no_mesh(turns: float) -> None:
    domain = strip()
    with pytest.raises(RemeshingError):
        remeshed(domain, rolled(domain, turns * 2 * math.pi))
