"""Shapes on their meshes: areas, volumes, edges, orientation and curvature against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from ngsolve import BND, CF, InnerProduct, Integrate, dx

from embedding.geometry.curvature import mesh_curvature
from embedding.geometry.domain import Domain, MeshSizes, build
from embedding.geometry.reduction import Reduction
from tests.geometry.shapes import BODIES, CASES, TRIAXIAL, body, ellipsoid_area, embedded

CLOSED = [entry for entry in BODIES if CASES[entry[0]].volume is not None]


def edge_length(domain: Domain, edge: str) -> float:
    line = dx(definedon=domain.mesh.BBoundaries(edge))
    return float(Integrate(domain.reduction.measure * line, domain.mesh))


@pytest.mark.parametrize(("name", "reduction", "planes"), BODIES)
def test_areas_and_edges(name: str, reduction: str, planes: tuple[str, ...]) -> None:
    """Area, and every edge with its name and length; between mirror planes one of two swapped edges stands for both."""
    case, domain = CASES[name], body(name, reduction, planes)
    assert domain.shell_integral(1.0) == pytest.approx(case.area, rel=3e-4)
    assert set(case.edges) == set(case.shape.edges)
    for edge, length in case.edges.items():
        images = {case.shape.mirror_image(edge, axis) for axis in planes} | {edge}
        measured = sum(edge_length(domain, image) for image in images)
        assert measured == pytest.approx(len(images) * length, rel=1e-3)
    assert set(domain.rims) <= case.true_edges
    swapped = {case.shape.mirror_image(edge, axis) for axis in planes for edge in domain.rims}
    assert case.true_edges == set(domain.rims) | swapped


@pytest.mark.parametrize(("name", "reduction", "planes"), CLOSED)
def test_enclosed_volumes(name: str, reduction: str, planes: tuple[str, ...]) -> None:
    domain = body(name, reduction, planes)
    assert domain.closed
    volume = domain.shell_integral(InnerProduct(domain.reduction.position, domain.normal)) / 3
    assert volume == pytest.approx(CASES[name].volume, rel=1e-3)


@pytest.mark.parametrize(("name", "reduction", "planes"), BODIES)
def test_normals(name: str, reduction: str, planes: tuple[str, ...]) -> None:
    """On every element our normal is the exact one, to the order of the geometry, and has its sign."""
    domain = body(name, reduction, planes, size=0.2)
    places = embedded(domain, domain.facets.at_centres(domain.reduction.position))
    normals = embedded(domain, domain.facets.at_centres(domain.normal))
    assert np.abs(normals - CASES[name].normal(places)).max() < 0.02


@pytest.mark.parametrize(("name", "reduction", "planes"), BODIES)
def test_mean_curvature(name: str, reduction: str, planes: tuple[str, ...]) -> None:
    """Against formulas written down anew; and the mesh's own normal agrees on average, with its O(h^2)."""
    case = CASES[name]
    domain = body(name, reduction, planes, size=0.25 * (case.shape.curvature_radius or 1.0))
    places = domain.facets.at_centres(domain.reduction.position)
    exact = case.curvature(embedded(domain, places))
    assert domain.facets.at_centres(domain.mean_curvature)[:, 0] == pytest.approx(exact, rel=5e-3, abs=1e-9)
    measured = domain.shell_integral(mesh_curvature(domain.reduction, domain.sign))
    assert measured == pytest.approx(domain.shell_integral(domain.mean_curvature), rel=0.02, abs=1e-9)


@pytest.mark.parametrize(("name", "reduction", "planes"), [entry for entry in CLOSED if entry[0] != "capped cylinder"])
def test_minkowski(name: str, reduction: str, planes: tuple[str, ...]) -> None:
    """On a smooth closed surface the integral of 1 + H X.N vanishes (Minkowski's first formula, our sign of H)."""
    domain = body(name, reduction, planes)
    support = domain.mean_curvature * InnerProduct(domain.reduction.position, domain.normal)
    assert domain.shell_integral(support) == pytest.approx(-CASES[name].area, rel=1e-3)


def test_a_triaxial_ellipsoid() -> None:
    for planes in ((), ("x", "y", "z")):
        domain = build(TRIAXIAL, Reduction("3d", planes), MeshSizes(0.25, 0.25, 0.0, 0.3, 3))
        area = ellipsoid_area(1.0, 0.8, 0.6)
        assert domain.shell_integral(1.0) == pytest.approx(area, rel=1e-4)
        support = InnerProduct(domain.reduction.position, domain.normal)
        assert domain.shell_integral(support) == pytest.approx(4 * math.pi * 0.48, rel=1e-4)
        assert domain.shell_integral(domain.mean_curvature * support) == pytest.approx(-area, rel=1e-3)


CURVED = ("annulus", "cylinder", "cap", "hemisphere", "cone", "torus", "oblate spheroid", "slit ring")


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("name", CURVED)
def test_areas_converge_with_size_and_order(name: str, order: int) -> None:
    """At least as fast as curved elements of order k approach the surface, h^(k+1); h from the number of elements."""
    case, errors, counts = CASES[name], [], []
    for size in (0.1, 0.05):
        domain = body(name, "3d", case.shape.mirrors, size, order)
        errors.append(abs(domain.shell_integral(1.0) / case.area - 1))
        counts.append(len(domain.facets.numbers))
    assert math.log(errors[0] / errors[1]) > (order + 0.6) * math.log(counts[1] / counts[0]) / 2


@pytest.mark.parametrize("name", [name for name, case in CASES.items() if "3d" in case.shape.reductions])
def test_triangles_are_well_shaped(name: str) -> None:
    """No angle below 25 degrees at the coarse sizes of a default mesh, whole or between mirror planes."""
    for planes in {(), CASES[name].shape.mirrors}:
        corners = body(name, "3d", planes, 0.35, 1).facets.points
        sides = np.roll(corners, -1, axis=1) - corners
        lengths = np.linalg.norm(sides, axis=2)
        cosines = -np.einsum("nij,nij->ni", sides, np.roll(sides, 1, axis=1)) / lengths / np.roll(lengths, 1, axis=1)
        assert np.degrees(np.arccos(cosines)).min() > 25


def test_sizes_along_edges() -> None:
    """Small elements where asked for, coarse ones far away."""
    case = CASES["cylinder"]
    sizes = MeshSizes(0.4, 0.4, 0.0, 0.3, 1, (("end1", 0.05),))
    for reduction, planes in (("3d", ("x", "y")), ("axisymmetric", ())):
        domain = build(case.shape, Reduction(reduction, planes), sizes)  # type: ignore[arg-type]
        height = domain.facets.points[:, :, -1].mean(axis=1)
        length = np.linalg.norm(domain.facets.points[:, 1] - domain.facets.points[:, 0], axis=1)
        assert length[height > 0.95].max() < 0.1
        assert length[height < -0.5].max() > 0.2
        assert domain.mesh.GetNE(BND) > 1.5 * body("cylinder", reduction, planes, 0.4, 1).mesh.GetNE(BND)


def test_shapes_are_scaled_to_their_size() -> None:
    """The mesh of a shape of another size has the area in SI units over the size squared."""
    for name, case in CASES.items():
        fields = {k: getattr(case.shape, k) for k in type(case.shape).model_fields}
        lengths = ("radius", "length", "top_radius", "height", "tube_radius", "inner_radius", "outer_radius")
        grown = {
            k: 7.3 * v if k in lengths else tuple(7.3 * a for a in v) if k == "semi_axes" else v
            for k, v in fields.items()
        }
        shape = type(case.shape)(**grown)
        reduction = Reduction(shape.reductions[0])  # type: ignore[arg-type]
        domain = build(shape, reduction, MeshSizes(0.4, 0.4, 0.0, 0.3, 3))
        dimension = 1 if reduction.name == "plane-strain" else 2
        assert domain.shell_integral(CF(1.0)) * shape.size**dimension == pytest.approx(
            case.area * 7.3**dimension, rel=3e-3
        ), name
