"""Node tables and sampling: against VTK's own numbering, exact measures, NGSolve's count of shared nodes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from netgen.occ import ArcOfCircle, OCCGeometry, Pnt, Wire
from netgen.occ import Sphere as SphereSolid
from ngsolve import CF, H1, L2, GridFunction, Mesh, unit_square, x, y, z

from embedding.archive.lagrange import LagrangeBlock, lagrange_nodes
from embedding.errors import ArchiveError
from tests.archive.made_up_run import disc, half_disc, octant

ORDERS = (1, 2, 3, 4)


def lift(points: Any) -> Any:
    """Mesh points in space."""
    return np.pad(points, ((0, 0), (0, 3 - points.shape[1])))


def grid(block: LagrangeBlock) -> Any:
    """The block as a pyvista grid."""
    pyvista = pytest.importorskip("pyvista")
    count, nodes = block.cells.shape
    cells = np.column_stack([np.full(count, nodes), block.cells])
    return pyvista.UnstructuredGrid(cells.ravel(), np.full(count, block.cell_type), block.points)


@pytest.mark.parametrize("order", [1, 2, 3, 4, 5, 6])
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_nodes_are_all_of_the_lattice(dimension: int, order: int) -> None:
    nodes = lagrange_nodes(dimension, order)
    assert len(nodes) == math.comb(order + dimension, dimension)
    assert len(set(nodes)) == len(nodes)
    assert all(sum(node) == order and min(node) >= 0 for node in nodes)


@pytest.mark.parametrize("order", [1, 2, 3, 4, 5, 6])
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_nodes_are_where_vtk_has_them(dimension: int, order: int) -> None:
    model = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    kind = {1: model.vtkLagrangeCurve, 2: model.vtkLagrangeTriangle, 3: model.vtkLagrangeTetra}[dimension]
    nodes = np.array(lagrange_nodes(dimension, order)) / order
    cell = kind()
    cell.GetPointIds().SetNumberOfIds(len(nodes))
    cell.GetPoints().SetNumberOfPoints(len(nodes))
    for number, weights in enumerate(nodes):
        cell.GetPointIds().SetId(number, number)
        cell.GetPoints().SetPoint(number, *np.pad(weights[1:], (0, 3 - dimension)))
    cell.Initialize()
    values = [0.0] * len(nodes)
    for number, weights in enumerate(nodes):
        cell.InterpolateFunctions([*weights[1:], 0.0, 0.0][:3], values)
        np.testing.assert_allclose(values, np.arange(len(nodes)) == number, atol=1e-9)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("make", [half_disc, disc, octant])
def test_shared_nodes_are_those_of_the_continuous_space(make: Any, order: int) -> None:
    mesh = make(1.0, order)
    block = LagrangeBlock(mesh, mesh.Materials(".*"), order, True, lift)
    assert block.point_count == H1(mesh, order=order).ndof == len(block.points)
    split = LagrangeBlock(mesh, mesh.Materials(".*"), order, False, lift)
    np.testing.assert_allclose(split.points[split.cells], block.points[block.cells], atol=1e-12)


@pytest.mark.parametrize("order", ORDERS)
def test_tetrahedra_fill_the_ball(order: int) -> None:
    mesh = octant(1.0, order)
    sized = grid(LagrangeBlock(mesh, mesh.Materials(".*"), 1, True, lift)).compute_cell_sizes()["Volume"]
    assert sized.min() > 0
    exact = sum(1 for _ in mesh.Materials(".*").Elements())
    assert len(sized) == exact
    block = LagrangeBlock(mesh, mesh.Materials("inside"), order, True, lift)
    refined = grid(block).extract_surface(nonlinear_subdivision=4, algorithm="dataset_surface").triangulate()
    assert abs(refined.volume) == pytest.approx(math.pi / 6, rel=0.2 if order == 1 else 6e-3)


@pytest.mark.parametrize("order", ORDERS)
def test_planar_triangles_turn_counterclockwise(order: int) -> None:
    mesh = disc(0.8, order)
    block = LagrangeBlock(mesh, mesh.Materials(".*"), order, True, lift)
    corners = block.points[block.cells[:, :3]]
    assert (np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] > 0).all()


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("make", [half_disc, octant])
def test_shell_nodes_lie_on_the_curved_shell(make: Any, order: int) -> None:
    mesh = make(0.8, order)
    block = LagrangeBlock(mesh, mesh.Boundaries("shell"), order, True, lift)
    assert block.cell_type == {2: 68, 3: 69}[mesh.dim]
    radii = np.linalg.norm(block.points, axis=1)
    np.testing.assert_allclose(radii, 1, atol={1: 1e-12, 2: 6e-3, 3: 2e-3, 4: 2e-4}[order])
    ambient = LagrangeBlock(mesh, mesh.Materials("outside"), order, True, lift)
    shared = (np.linalg.norm(ambient.points[:, None] - block.points[None], axis=2) < 1e-10).any(axis=0)
    assert shared.all()


@pytest.mark.parametrize("order", ORDERS)
def test_mesh_of_a_wire_alone(order: int) -> None:
    arc = ArcOfCircle(Pnt(0, -1, 0), Pnt(1, 0, 0), Pnt(0, 1, 0))
    mesh = Mesh(OCCGeometry(Wire([arc]), dim=2).GenerateMesh(maxh=0.4)).Curve(order)
    block = LagrangeBlock(mesh, mesh.Boundaries(".*"), order, True, lift)
    assert block.point_count == order * len(block.cells) + 1
    np.testing.assert_allclose(block.sample(CF((x, y))), block.points[:, :2], atol=1e-14)
    along = block.cells[:, [0, *range(2, order + 1), 1]]
    angles = np.arctan2(*block.points[along][:, :, [1, 0]].transpose(2, 0, 1))
    assert (np.diff(angles, axis=1) > 0).all() or (np.diff(angles, axis=1) < 0).all()
    length = np.linalg.norm(np.diff(block.points[along], axis=1), axis=2).sum()
    assert length == pytest.approx(math.pi, rel=0.02)


@pytest.mark.parametrize("order", ORDERS)
def test_mesh_of_a_face_alone(order: int) -> None:
    mesh = Mesh(OCCGeometry(SphereSolid(Pnt(0, 0, 0), 1).faces[0]).GenerateMesh(maxh=0.6)).Curve(order)
    block = LagrangeBlock(mesh, mesh.Boundaries(".*"), order, True, lift)
    cells = len(block.cells)
    assert block.point_count == 2 + cells * order**2 // 2  # Euler: a closed surface of genus 0
    area = grid(block).extract_surface(nonlinear_subdivision=4, algorithm="dataset_surface").area
    assert area == pytest.approx(4 * math.pi, rel=0.06 if order == 1 else 5e-3)


def test_a_field_that_is_not_finite_on_the_axis_is_read_beside_it() -> None:
    mesh = half_disc(0.8, 2)
    block = LagrangeBlock(mesh, mesh.Boundaries("shell"), 2, True, lift)
    hoop = block.sample((x + 0.25 * x * (1 + y)) / x)
    np.testing.assert_allclose(hoop, 1 + 0.25 * (1 + block.points[:, 1]), atol=1e-4)


def test_shared_nodes_average_what_jumps() -> None:
    mesh = Mesh(unit_square.GenerateMesh(maxh=2))
    assert mesh.ne == 2
    jump = GridFunction(L2(mesh, order=0))
    jump.vec[0], jump.vec[1] = 1, 3
    block = LagrangeBlock(mesh, mesh.Materials(".*"), 2, True, lift)
    values = block.sample(jump)
    diagonal = np.bincount(block.cells.ravel()) == 2
    np.testing.assert_allclose(values[diagonal], 2)
    assert set(values[~diagonal]) == {1.0, 3.0}
    assert set(block.sample(jump, average=False)) == {1.0, 3.0}


def test_vectors_and_scalars_keep_their_shape() -> None:
    mesh = octant(1.5, 1)
    block = LagrangeBlock(mesh, mesh.Materials("inside"), 2, True, lambda points: 2 * points)
    np.testing.assert_allclose(block.sample(CF((x, y, z))), block.points / 2, atol=1e-12)  # but for rounding near 0
    assert block.sample(x * y).shape == (block.point_count,)


def test_what_a_block_cannot_show_is_refused() -> None:
    mesh = octant(1.5, 1)
    with pytest.raises(ArchiveError, match="no elements"):
        LagrangeBlock(mesh, mesh.Materials("nowhere"), 2, True, lift)
    with pytest.raises(ArchiveError, match="codimension"):
        LagrangeBlock(mesh, mesh.BBoundaries(".*"), 2, True, lift)
    square = Mesh(unit_square.GenerateMesh(maxh=0.5, quad_dominated=True))
    with pytest.raises(ArchiveError, match="simplicial"):
        LagrangeBlock(square, square.Materials(".*"), 2, True, lift)
