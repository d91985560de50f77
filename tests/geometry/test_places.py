"""Points on curved meshes: found from their images, refused off the surface; corners only where there is a vertex."""

from __future__ import annotations

import numpy as np
import pytest
from ngsolve import BND, ElementId

from embedding.geometry.domain import Domain
from embedding.geometry.places import CLOSE, corner, locate, unknowns_at
from embedding.geometry.spaces import TraceSpace
from tests.forms import BODIES, Array, body


def image(domain: Domain, element: int, *local: float) -> Array:
    """Where an element has its local coordinates."""
    trafo = domain.mesh.GetTrafo(ElementId(BND, element))  # must outlive its points
    return np.array(domain.reduction.position(trafo(*local)))


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("name", BODIES)
def test_points_of_the_mesh_are_found(name: str, order: int) -> None:
    """Images of random local coordinates: the same place comes back, to rounding."""
    domain = body(name, order=order)
    rng = np.random.default_rng(5)
    for element in list(domain.shell.Elements())[::3]:
        local = rng.dirichlet(np.ones(domain.mesh.dim))[:-1]
        target = image(domain, element.nr, *local)
        found = locate(domain, tuple(target))
        assert found.distance < 1e-13
        assert image(domain, found.element, *found.local) == pytest.approx(target, abs=1e-13)


def test_points_of_the_true_shape_are_found() -> None:
    """The mesh of a sphere is not quite a sphere: its points are accepted, and how far off they are is known."""
    rng = np.random.default_rng(7)
    for order, miss in ((2, 2e-3), (3, 5e-4)):
        domain = body("octant", size=0.4, order=order)
        for point in rng.normal(size=(20, 3)):
            found = locate(domain, tuple(point / np.linalg.norm(point)))
            assert found.on_surface and found.distance < miss


@pytest.mark.parametrize(
    ("name", "point"),
    [
        ("plate", (0.5, 0.3, 2e-6)),
        ("plate", (1.00001, 0.3, 0.0)),
        ("disc", (0.0, 0.0, -0.1)),
        ("octant", (0.0, 0.0, 1.01)),
        ("octant", (-0.5, 0.5, 0.5)),
        ("axisymmetric sphere", (0.0, -1.01)),
        ("ring", (0.0, 0.0)),
    ],
)
def test_points_off_the_surface(name: str, point: tuple[float, ...]) -> None:
    assert not locate(body(name), point).on_surface


def test_the_distance_is_told() -> None:
    assert locate(body("plate"), (1.3, 0.3, 0.4)).distance == pytest.approx(0.5, abs=1e-14)
    assert locate(body("plate"), (1.3, -0.4, 1.2)).distance == pytest.approx(1.3, abs=1e-14)
    found = locate(body("plate"), (0.7, 0.2, 0.1))
    assert found.position == pytest.approx([0.7, 0.2, 0.0], abs=1e-14)


def test_a_point_of_the_whole_body_stands_for_its_mirror_image() -> None:
    domain = body("octant", order=3)
    images = [locate(domain, (a * 0.6, 0.0, b * 0.8)) for a in (1, -1) for b in (1, -1)]
    assert all(image.position == pytest.approx(images[0].position, abs=1e-12) for image in images)
    assert images[0].position == pytest.approx([0.6, 0.0, 0.8], abs=1e-3)


@pytest.mark.parametrize(
    ("name", "point", "there"),
    [
        ("plate", (1.0, 0.6, 0.0), True),
        ("plate", (0.987, 0.6, 0.0), False),
        ("plate", (1.0, 0.6, 0.1), False),
        ("octant", (0.0, 0.0, -1.0), True),
        ("axisymmetric sphere", (0.0, -1.0), True),
        ("axisymmetric disc", (1.0, 0.0), True),
    ],
)
def test_corners(name: str, point: tuple[float, ...], there: bool) -> None:
    domain = body(name, order=3)
    vertex = corner(domain, point)
    assert (vertex is not None) == there
    if vertex is not None:
        place = next(v.point for v in domain.mesh.vertices if v.nr == vertex)
        assert np.abs(np.abs(point) - np.abs(place)).max() < CLOSE


def test_a_held_corner_is_one_unknown() -> None:
    domain = body("plate", order=3)
    space = TraceSpace(domain.mesh, 3).scalar
    assert unknowns_at(domain, space, (1.0, 0.6, 0.0)).sum() == 1
    with pytest.raises(ValueError, match="no vertex"):
        unknowns_at(domain, space, (0.51, 0.3, 0.0))
