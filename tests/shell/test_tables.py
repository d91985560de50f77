"""The tables of both configurations against definitions in numpy, with observed orders under refinement."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from ngsolve import CF

from embedding.shell.charts import chart, normal_chart
from embedding.shell.laws import KoiterLaw, MooneyRivlinLaw
from embedding.shell.tables import MidSurface, Tables
from tests.forms import Array
from tests.shell.bodies import CASES, THICKNESS, Meshed, meshed
from tests.shell.parametrised import Geometry, slope

NEO_HOOKEAN = MooneyRivlinLaw(0.5)
FLOOR = 1e-8
"""Errors of NGSolve's second derivatives, which are differences themselves."""


def distance(computed: Array, exact: Array) -> float:
    """Root mean square of the difference, relative to the largest of 1 and the exact values' own."""
    a, b = computed.reshape(len(exact), -1), exact.reshape(len(exact), -1)
    return float(np.sqrt(((a - b) ** 2).sum(1).mean()) / max(1.0, np.sqrt((b**2).sum(1).mean())))


def first_order(body: Meshed, surface: MidSurface, exact: Geometry, components: bool) -> dict[str, float]:
    """Errors of quantities made of first derivatives."""
    errors = {"normal": distance(body(surface.normal), exact.normal)}
    errors["projector"] = distance(body(surface.projector), exact.projector)
    if components:
        errors["metric"] = distance(body(surface.metric), exact.metric)
        for i in range(2):
            errors[f"basis {i}"] = distance(body(surface.tangents[i]), exact.tangents[:, i])
            errors[f"dual {i}"] = distance(body(surface.duals[i]), exact.duals[:, i])
    return errors


def second_order(body: Meshed, surface: MidSurface, exact: Geometry, components: bool) -> dict[str, float]:
    """Errors of quantities made of second derivatives."""
    errors = {
        "curvature": distance(body(surface.curvature), exact.curvature),
        "mean": distance(body(surface.mean_curvature), np.trace(exact.mixed, axis1=1, axis2=2) / 2),
        "gauss": distance(body(surface.gauss_curvature), np.linalg.det(exact.mixed)),
    }
    if components:
        errors["second form"] = distance(body(surface.second_form), exact.second)
        errors["mixed"] = distance(body(surface.mixed_curvature), exact.mixed)
        symbols = CF(surface.christoffel[0] + surface.christoffel[1])
        errors["christoffel"] = distance(body(symbols), exact.christoffel)
    return errors


@pytest.mark.parametrize("order", [2, 3])
@pytest.mark.parametrize("name", CASES)
def test_orders(name: str, order: int) -> None:
    """First derivatives are right to the order k of the displacement, second ones to k - 1, in the mean."""
    case = CASES[name]
    found: list[list[dict[str, float]]] = []
    for size in (case.size, case.size / 2):
        body = meshed(case, size, order)
        tables = Tables(body.derivatives, chart(body.derivatives, case.coordinates or "frame"), THICKNESS, NEO_HOOKEAN)
        pairs = list(zip((tables.reference, tables.deformed), case.geometries(body.p, body.q), strict=True))
        components = case.coordinates is not None
        found.append([first_order(body, s, e, components) for s, e in pairs])
        found[-1] += [second_order(body, s, e, components) for s, e in pairs]
    for expected, coarse, fine in zip((order, order, order - 1, order - 1), *found, strict=True):
        for quantity in coarse:
            a, b = coarse[quantity], fine[quantity]
            assert b < 0.2, quantity  # refinement is resolved at all
            assert b < FLOOR or math.log2(a / b) > expected - 0.5, (quantity, a, b)


def test_a_growing_sphere() -> None:
    """The unit sphere blown up to radius 1.4: kappa = K / 1.4 whatever the mesh makes of K, and lambda is uniform."""
    ball = meshed(replace(CASES["sphere"], motion=lambda x, y, z: (1.4 * x, 1.4 * y, 1.4 * z)), 0.4, 4)
    tables = Tables(ball.derivatives, normal_chart(ball.derivatives), THICKNESS, NEO_HOOKEAN)
    assert np.abs(ball(tables.reference.mean_curvature) + 1).max() < 0.02  # the mesh's own curvature
    assert distance(1.4 * ball(tables.deformed.curvature), ball(tables.reference.curvature)) < FLOOR
    assert distance(ball(tables.deformed.mean_curvature) ** 2, ball(tables.deformed.gauss_curvature)) < 1e-3
    assert np.abs(ball(tables.thickness_gradient)).max() < 1e-7


def test_a_tensor_does_not_depend_on_coordinates() -> None:
    body = meshed(CASES["sphere"], 0.4, 3)
    one, other = (
        Tables(body.derivatives, chart(body.derivatives, name), THICKNESS, NEO_HOOKEAN)
        for name in ("frame", "spherical")
    )
    for a, b in ((one.deformed, other.deformed), (one.reference, other.reference)):
        assert distance(body(a.projector), body(b.projector)) < 1e-12
        assert distance(body(a.mean_curvature), body(b.mean_curvature)) < 1e-12
    for place in (-0.5, 0.3):
        pairs = [
            (one.deformation_gradient(place), other.deformation_gradient(place)),
            (one.deformed_layer(place).shifter, other.deformed_layer(place).shifter),
            (one.deformed_layer(place).area_vector, other.deformed_layer(place).area_vector),
        ]
        for left, right in pairs:
            assert distance(body(left), body(right)) < 1e-8  # second derivatives by differences, twice


def test_the_frame_is_orthonormal_and_follows_the_direction() -> None:
    body = meshed(CASES["torus"], 0.4, 2)
    e, f = (body(v) for v in body.derivatives.frame)
    n = body(body.derivatives.reference_normal)
    assert np.abs(np.cross(e, f) - n).max() < 1e-12
    direction = np.where(np.abs(n[:, :1]) < 0.99, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    assert np.abs(np.einsum("ni,ni->n", direction, f)).max() < 1e-12
    assert np.einsum("ni,ni->n", direction, e).min() > 0.0


def test_thickness_slope_of_small_strains() -> None:
    """St Venant-Kirchhoff: lambda = 1 - nu / (1 - nu) tr E, differentiated in numpy."""
    case, poisson = CASES["plate"], 0.3
    body = meshed(case, 0.3, 3)
    tables = Tables(body.derivatives, chart(body.derivatives), THICKNESS, KoiterLaw(1.0, poisson))

    def stretch(p: Array, q: Array) -> Array:
        trace = np.trace(case.geometries(p, q)[1].metric, axis1=1, axis2=2)
        return np.asarray(1 - poisson / (1 - poisson) * (trace - 2) / 2)

    assert distance(body(tables.thickness_stretch).ravel(), stretch(body.p, body.q)) < 1e-10
    slopes = np.stack([slope(stretch, body.p, body.q, i) for i in range(2)], axis=1)
    assert distance(body(tables.thickness_gradient)[:, :2], slopes) < FLOOR
