"""Kinematics by name against numpy, from the same displacement gradients or from an explicit parametrisation."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from ngsolve import CF, ET, Grad, GridFunction, IntegrationRule

from embedding.geometry.domain import Domain
from embedding.geometry.spaces import TraceSpace
from embedding.shell.kinematics import Kinematics
from tests.forms import BODIES, Array, body, relative, set_on_shell, smooth


def points_of(domain: Domain) -> Any:
    rule = IntegrationRule(ET.TRIG if domain.mesh.dim == 3 else ET.SEGM, 3)
    return domain.mesh.MapToAllElements(rule, domain.shell)


def at(values: Any, points: Any) -> Array:
    return np.asarray(CF(values)(points))


def displaced(domain: Domain, axial: float = 1.0) -> tuple[Any, Kinematics]:
    space = TraceSpace(domain.mesh, domain.sizes.order, reach="shell" if domain.has_ambient else "")
    u = GridFunction(space.space)
    set_on_shell(u, smooth(domain), space.free, domain)
    return u, Kinematics(domain.reduction, domain.normal, u, axial)


def three_dimensional(domain: Domain, matrices: Array, hoop: Array) -> Array:
    """In-plane (n, 2, 2) gradients completed by the stretch of the missing direction; 3D ones as they are."""
    if matrices.shape[1] == 3:
        return matrices
    full = np.zeros((len(matrices), 3, 3))
    full[:, :2, :2] = matrices
    full[:, 2, 2] = hoop
    return full


@pytest.mark.parametrize(("name", "axial"), [*((name, 1.0) for name in BODIES), ("ring", 1.3), ("quarter ring", 0.7)])
def test_named_quantities_follow_from_the_gradient(name: str, axial: float) -> None:
    """The full 3 x 3 gradient F-hat of the shell, built in numpy, gives every named quantity by its definition."""
    domain = body(name, order=3)
    u, k = displaced(domain, axial)
    points, d = points_of(domain), domain.mesh.dim
    normal = at(domain.normal, points)
    gradient = at(Grad(u), points).reshape(-1, d, d)
    place, moved = at(domain.reduction.position, points), at(u, points)
    hoop = np.full(len(place), axial)
    if domain.reduction.name == "axisymmetric":
        hoop = (place[:, 0] + moved[:, 0]) / place[:, 0]
    # tangents of the reference: two unit vectors orthogonal to N; the third direction is the missing one in 2D
    N = np.zeros((len(place), 3))
    N[:, :d] = normal
    F = three_dimensional(domain, gradient + np.eye(d), hoop)
    first = np.cross(N, np.where(np.abs(N[:, :1]) < 0.9, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]))
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(N, first)
    a, b = np.einsum("nij,nj->ni", F, first), np.einsum("nij,nj->ni", F, second)
    m = np.cross(a, b)
    stretch = np.linalg.norm(m, axis=1)
    n, thin = m / stretch[:, None], 1.0 / stretch
    assert relative(at(k.area_vector, points), m[:, :d]) < 1e-12
    assert relative(at(k.surface_stretch, points).ravel(), stretch) < 1e-12
    assert relative(at(k.surface_stretch_squared, points).ravel(), stretch**2) < 1e-12
    assert relative(at(k.thickness_stretch, points).ravel(), thin) < 1e-12
    assert relative(at(k.normal, points), n[:, :d]) < 1e-12
    assert relative(at(k.director, points), (thin[:, None] * n)[:, :d]) < 1e-12
    metric = np.einsum("ni,ni->n", a, a) + np.einsum("ni,ni->n", b, b)
    assert relative(at(k.metric_trace, points).ravel(), metric) < 1e-12
    hat = np.einsum("ni,nj->nij", a, first) + np.einsum("ni,nj->nij", b, second)
    hat += np.einsum("ni,nj->nij", thin[:, None] * n, N)
    assert np.abs(np.linalg.det(hat) - 1).max() < 1e-12  # incompressible
    inverse_transpose = np.linalg.inv(hat).transpose(0, 2, 1)[:, :d, :d]
    assert relative(at(k.inverse_transpose, points).reshape(-1, d, d), inverse_transpose) < 1e-11


@pytest.mark.parametrize("name", BODIES)
def test_nothing_has_moved_at_rest(name: str) -> None:
    domain = body(name)
    u = GridFunction(TraceSpace(domain.mesh, domain.sizes.order).space)
    k = Kinematics(domain.reduction, domain.normal, u)
    points = points_of(domain)
    assert np.abs(at(k.surface_stretch, points) - 1).max() < 1e-12
    assert relative(at(k.normal, points), at(domain.normal, points)) < 1e-12
    assert np.abs(at(k.metric_trace, points) - 2).max() < 1e-12


@pytest.mark.parametrize("name", ["sphere", "axisymmetric sphere", "ring"])
def test_a_rotated_and_scaled_body(name: str) -> None:
    """x -> c Q X, Q a rotation the mesh can show: n = Q N, J_s = c^2, I_C = 2 c^2 (plane strain: c and c^2 + 1)."""
    domain, c = body(name, order=2), 1.4
    d = domain.mesh.dim
    rotation = np.eye(d)
    if name == "sphere":
        rotation = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
    elif name == "ring":
        rotation = np.array([[0.6, -0.8], [0.8, 0.6]])
    space = TraceSpace(domain.mesh, 2)
    u = GridFunction(space.space)
    map_of = c * rotation - np.eye(d)
    place = domain.reduction.position
    image = CF(tuple(sum(float(map_of[i, j]) * place[j] for j in range(d)) for i in range(d)))
    set_on_shell(u, image, np.ones(len(space.free), bool), domain)
    k, points = Kinematics(domain.reduction, domain.normal, u), points_of(domain)
    plane = domain.reduction.name == "plane-strain"
    assert np.abs(at(k.surface_stretch, points) - (c if plane else c * c)).max() < 1e-10
    assert np.abs(at(k.metric_trace, points) - (c * c + 1 if plane else 2 * c * c)).max() < 1e-10
    assert relative(at(k.normal, points), at(domain.normal, points) @ rotation.T) < 1e-10


def test_a_parametrised_surface() -> None:
    """A plate bent and stretched by a cubic map: the director and area from the exact tangents, to rounding."""
    domain = body("plate", order=3)
    space = TraceSpace(domain.mesh, 3)
    u = GridFunction(space.space)
    x, y = domain.reduction.position[0], domain.reduction.position[1]
    image = CF((0.2 * x + 0.1 * x * y, 0.1 * y - 0.2 * x * x, 0.5 * x * x * y - 0.3 * y * y + 0.1 * x))
    set_on_shell(u, image, np.ones(len(space.free), bool), domain)
    k, points = Kinematics(domain.reduction, domain.normal, u), points_of(domain)
    place = at(domain.reduction.position, points)
    a, b = place[:, 0], place[:, 1]
    along = np.stack([1.2 + 0.1 * b, -0.4 * a, a * b + 0.1], axis=1)
    across = np.stack([0.1 * a, 1.1 + 0 * a, 0.5 * a * a - 0.6 * b], axis=1)
    m = np.cross(along, across)
    assert relative(at(k.area_vector, points), m) < 1e-11
    assert relative(at(k.director, points), m / (m**2).sum(axis=1)[:, None]) < 1e-11
