"""Sides and rims of an interface from the topology of small meshes; surfaces that have no two sides are refused."""

from __future__ import annotations

from itertools import combinations, permutations
from pathlib import Path

import numpy as np
import pytest
from netgen.occ import Axes, Compound, Glue, WorkPlane
from ngsolve import CF, InnerProduct, Integrate

from embedding import SceneError, SurfaceFile, TSection
from embedding.geometry import domain, kept
from embedding.geometry.cut import AWAY, BOTTOM, RIM, TOP, CloseSheetsError, Cut, JunctionError
from embedding.geometry.domain import MeshSizes, build
from embedding.geometry.facets import Facets
from embedding.geometry.reduction import Reduction
from tests.geometry.test_facets import alone, moebius


def square(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Points of a lattice of ``count`` by ``count`` squares, each cut into two triangles."""
    ticks = np.arange(count + 1)
    points = np.array([(x, y) for y in ticks for x in ticks], float)
    corners = [y * (count + 1) + x for y in range(count) for x in range(count)]
    below, above = [(c, c + 1, c + count + 2) for c in corners], [(c, c + count + 2, c + count + 1) for c in corners]
    return points, np.array(below + above)


def cube(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Points of a lattice of cubes, each cut into the six tetrahedra along its diagonal."""
    side = count + 1
    points = np.array([(x, y, z) for z in range(side) for y in range(side) for x in range(side)], float)
    steps = (1, side, side**2)
    tets = []
    for corner in (x + side * y + side**2 * z for x in range(count) for y in range(count) for z in range(count)):
        for order in permutations(steps):
            tets.append((corner, *(corner + sum(order[: k + 1]) for k in range(3))))
    return points, np.array(tets)


def on_level(points: np.ndarray, elements: np.ndarray, level: float, within: float = np.inf) -> np.ndarray:
    """Facets of the elements with their last coordinate at ``level``, and the others up to ``within``."""
    size = elements.shape[1] - 1
    every = np.unique(np.sort(np.concatenate([elements[:, c] for c in combinations(range(size + 1), size)]), 1), axis=0)
    flat = (points[every][..., -1] == level).all(axis=1) & (points[every][..., :-1] <= within).all(axis=(1, 2))
    return np.asarray(every[flat])


def heights(cut: Cut, points: np.ndarray, level: float) -> np.ndarray:
    """Does the element of each pair beside the interface lie above it?"""
    return np.asarray(points[cut.elements[cut.beside[0]]].mean(axis=1)[:, -1] > level)


def expected(cut: Cut, points: np.ndarray, level: float) -> np.ndarray:
    """Side of each element by its height: it touches the interface in a vertex that is no rim, or is away from it."""
    inner = np.setdiff1d(cut.facets, cut.rim_vertices)
    above = points[cut.elements].mean(axis=1)[:, -1] > level
    side = np.where(above, TOP, BOTTOM)
    side[~np.isin(cut.elements, inner).any(axis=1)] = RIM
    side[~np.isin(cut.elements, cut.facets).any(axis=1)] = AWAY
    return np.asarray(side)


@pytest.mark.parametrize("lattice", [square, cube])
def test_an_interface_from_end_to_end(lattice) -> None:  # type: ignore[no-untyped-def]
    """Without a rim where the mesh ends; two rooms."""
    points, elements = lattice(4)
    cut = Cut(elements, on_level(points, elements, 2.0))
    assert len(cut.facets) == (4 if lattice is square else 32)
    assert len(cut.rim_vertices) == len(cut.rim_edges) == 0
    side = cut.sides(heights(cut, points, 2.0))
    assert np.array_equal(side, expected(cut, points, 2.0))
    rooms = cut.rooms()
    assert len(np.unique(rooms)) == 2
    assert np.array_equal(rooms == rooms[0], points[elements].mean(axis=1)[:, -1] < 2)


@pytest.mark.parametrize("lattice", [square, cube])
def test_an_interface_that_ends_inside(lattice) -> None:  # type: ignore[no-untyped-def]
    """A rim where x (and y) reach 2, none on the outside of the mesh; one room."""
    points, elements = lattice(4)
    cut = Cut(elements, on_level(points, elements, 2.0, within=2.0))
    ends = (points[:, -1] == 2) & (points[:, :-1] <= 2).all(axis=1) & (points[:, :-1] == 2).any(axis=1)
    assert set(cut.rim_vertices) == set(np.flatnonzero(ends))
    assert len(cut.rim_edges) == (0 if lattice is square else 4)
    assert set(cut.rim_edges.ravel()) <= set(cut.rim_vertices)
    assert np.array_equal(cut.sides(heights(cut, points, 2.0)), expected(cut, points, 2.0))
    assert len(np.unique(cut.rooms())) == 1


@pytest.mark.parametrize("lattice", [square, cube])
def test_one_row_of_facets(lattice) -> None:  # type: ignore[no-untyped-def]
    """Every vertex is on the rim: elements that have a facet or an inner edge of the interface have a side."""
    points, elements = lattice(4)
    whole = on_level(points, elements, 2.0)
    middle = points[whole].mean(axis=1)[:, :-1]
    cut = Cut(elements, whole[((middle > 1) & (middle < 2)).all(axis=1)])
    assert len(cut.facets) == (1 if lattice is square else 2)
    assert set(cut.rim_vertices) == set(cut.facets.ravel())
    assert len(cut.rim_edges) == (0 if lattice is square else 4)
    side = cut.sides(heights(cut, points, 2.0))
    above = points[elements].mean(axis=1)[:, -1] > 2
    rims = {frozenset(edge) for edge in cut.rim_edges.tolist()}
    edges = {frozenset(edge) for facet in cut.facets.tolist() for edge in combinations(facet, 2)} - rims
    beside = np.isin(np.arange(len(elements)), cut.beside[0])
    if lattice is cube:
        beside |= np.array([any(edge <= set(element) for edge in edges) for element in elements.tolist()])
    assert np.array_equal(side == TOP, beside & above)
    assert np.array_equal(side == BOTTOM, beside & ~above)
    assert np.array_equal(side == AWAY, ~np.isin(elements, cut.facets).any(axis=1))


@pytest.mark.parametrize("lattice", [square, cube])
def test_sheets_that_meet_are_refused(lattice) -> None:  # type: ignore[no-untyped-def]
    """A second sheet that stands on the first one; side by side they are allowed."""
    points, elements = lattice(4)
    lying = on_level(points, elements, 2.0)
    turned = np.roll(points, 1, axis=1)
    standing = on_level(turned, elements, 2.0)
    above = (points[standing][..., -1] >= 2).all(axis=1)
    with pytest.raises(JunctionError):
        _ = Cut(elements, np.concatenate([lying, standing[above]])).rim_vertices
    apart = (points[standing][..., -1] >= 3).all(axis=1)
    cut = Cut(elements, np.concatenate([on_level(points, elements, 1.0), standing[apart]]))
    assert len(cut.rim_vertices) == (1 if lattice is square else 5)


@pytest.mark.parametrize("lattice", [square, cube])
def test_sheets_one_element_apart_are_refused(lattice) -> None:  # type: ignore[no-untyped-def]
    points, elements = lattice(4)
    for gap, allowed in ((1.0, False), (2.0, True)):
        low, high = (on_level(points, elements, level) for level in (1.0, 1.0 + gap))
        cut = Cut(elements, np.concatenate([low, high]))
        height = points[elements[cut.beside[0]]].mean(axis=1)[:, -1]
        top = height > np.where(cut.beside[1] < len(low), 1.0, 1.0 + gap)
        if allowed:
            side = cut.sides(top)
            assert np.all(side[np.isin(elements, low).any(axis=1)] != AWAY)
            assert len(np.unique(cut.rooms())) == 3
        else:
            with pytest.raises(CloseSheetsError):
                cut.sides(top)


SIZES = MeshSizes(0.3, 1.5, 3.0, 0.5, 1)


def test_a_junction_in_space_is_refused() -> None:
    with pytest.raises(SceneError) as caught:
        build(TSection(length=1.0), Reduction("3d"), SIZES)
    (problem,) = caught.value.problems
    assert problem.path == "shell.shape"
    assert problem.message == (
        "not allowed with an ambient: three or more sheets of the shell meet, "
        "and the space between them has no top and bottom"
    )


def test_a_band_with_one_side_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Facets, "on_edges", True)
    monkeypatch.setattr(kept, "mesh", lambda *_: alone(moebius(20, True)))
    monkeypatch.setattr(domain.Domain, "unfolded", True)
    with pytest.raises(SceneError, match="^shell.shape: not allowed: .* only one side, so it has no top$"):
        build(TSection(length=1.0), Reduction("3d"), SIZES)


def plates(folder: Path, gap: float) -> SurfaceFile:
    """Two unit squares above one another."""
    frames = [Axes((0, 0, z), n=(0, 0, 1), h=(1, 0, 0)) for z in (0.0, gap)]
    written = folder / f"plates{gap}.step"
    Compound([WorkPlane(frame).Rectangle(1, 1).Face() for frame in frames]).WriteStep(str(written))
    return SurfaceFile(path=str(written), unit="1 m")


def test_sheets_too_close_for_the_mesh_are_refused(tmp_path: Path) -> None:
    """Two plates need two elements between them."""
    with pytest.raises(SceneError) as caught:
        build(plates(tmp_path, 0.05), Reduction("3d"), SIZES)
    (problem,) = caught.value.problems
    assert problem.path == "discretisation.shell_size"
    assert problem.message == "an element touches both sides of the shell: make the mesh on the shell finer"
    made = build(plates(tmp_path, 0.8), Reduction("3d"), SIZES)
    assert made.shell_integral(1.0) == pytest.approx(2.0)
    assert made.facets.parts.max() == 1


@pytest.mark.parametrize("flip", [False, True])
def test_a_box_of_faces_is_closed(tmp_path: Path, flip: bool) -> None:
    """Six glued squares: no rim; what its normals point away from is the box, flipped the space around it."""
    frames = [
        Axes(tuple(np.array(normal) / 2), n=normal, h=across)
        for normal, across in (
            ((0, 0, 1), (1, 0, 0)), ((0, 0, -1), (0, 1, 0)), ((1, 0, 0), (0, 1, 0)),
            ((-1, 0, 0), (0, 0, 1)), ((0, 1, 0), (0, 0, 1)), ((0, -1, 0), (1, 0, 0)),
        )
    ]  # fmt: skip
    written = tmp_path / "box.step"
    Glue([WorkPlane(frame).RectangleC(1, 1).Face() for frame in frames]).WriteStep(str(written))
    shape = SurfaceFile(path=str(written), unit="1 m", flip=flip)
    made = build(shape, Reduction("3d"), SIZES)
    assert made.closed and not made.open
    enclosed = made.shell_integral(InnerProduct(made.reduction.position, made.normal)) / 3
    assert enclosed == pytest.approx(-1.0 if flip else 1.0)
    box = "outside.*" if flip else "inside.*"
    assert Integrate(CF(1.0), made.mesh, definedon=made.mesh.Materials(box)) == pytest.approx(1.0)


@pytest.mark.parametrize("flip", [False, True])
def test_open_files_keep_their_side_in_space(tmp_path: Path, flip: bool) -> None:
    """Two squares with opposite normals, each a part of its own: as alone."""
    frames = [Axes((x, 0, 0), n=(0, 0, z), h=(1, 0, 0)) for x, z in ((0.0, 1), (1.5, -1))]
    written = tmp_path / "squares.step"
    Compound([WorkPlane(frame).Rectangle(0.5, 0.5).Face() for frame in frames]).WriteStep(str(written))
    shape = SurfaceFile(path=str(written), unit="1 m", flip=flip)
    for radius in (0.0, 3.0):
        made = build(shape, Reduction("3d"), MeshSizes(0.1, 1.5, radius, 0.5, 1))
        place = made.facets.at_centres(made.reduction.position)[:, 0] * shape.size
        normal = made.facets.at_centres(made.normal)[:, 2]
        assert normal == pytest.approx(np.where(place < 1, 1.0, -1.0) * (-1 if flip else 1))
