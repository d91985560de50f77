"""Drawing shell and section in space, without axes or labels: an image whose scale is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from embedding.view.colours import FIELD_COLOURS, SHELL_COLOURS, Limits
from embedding.view.lines import Raster, field_lines
from embedding.view.section import Section, section_mesh
from embedding.view.surface import Surface

Floats = npt.NDArray[np.float64]
Place = tuple[float, float, float]
EDGE_COLOUR, LINE_COLOUR = "#22222a", "#24385e"
VIEWS = {  # from where, and what is up
    "meridian": ((0.42, -1.0, 0.36), (0.0, 0.0, 1.0)),
    "cross-section": ((0.62, 0.42, 1.0), (0.0, 1.0, 0.0)),
    "sheet": ((0.45, -1.0, 0.75), (0.0, 0.0, 1.0)),
}
PIXELS, WHITE = (2200, 2200), 250
SPACING = 0.16  # between field lines, relative to the size of the shell
DASH = 0.06  # length of a dash, relative to the size of the shell
RASTER = 0.1  # width of the grid on which field lines are followed, relative to their spacing


@dataclass(frozen=True)
class Drawing:
    """Pixels (height, width, 3) and the size of the image in m."""

    pixels: npt.NDArray[np.uint8]
    width: float
    height: float


@dataclass(frozen=True)
class Frame:
    """The part of space that an image shows: a ball."""

    centre: Place
    radius: float


class Canvas:
    """An off-screen scene of ``size`` pixels with parallel projection and a white background."""

    def __init__(self, view: str, size: tuple[int, int] = PIXELS) -> None:
        import pyvista

        self._pyvista: Any = pyvista
        self._plotter: Any = self._pyvista.Plotter(off_screen=True, window_size=list(size), lighting="light kit")
        self._plotter.set_background("white")
        self._plotter.enable_anti_aliasing("ssaa")
        self.view = view

    def shell(self, surface: Surface, limits: Limits, edge_radius: float, quarter_cut: bool) -> None:
        """Add the shell with its edges; with ``quarter_cut`` the quarter x > 0, y < 0 is left out."""
        mesh = self._pyvista.PolyData(surface.points, np.insert(surface.triangles, 0, 3, axis=1).ravel())
        mesh.point_data["shell"] = surface.values
        mesh = mesh.clean(tolerance=1e-7).compute_normals(split_vertices=False, cell_normals=False)
        if quarter_cut:
            behind = mesh.clip(normal="y", origin=(0, 0, 0), invert=False)
            mesh = behind.merge(mesh.clip(normal="y", origin=(0, 0, 0)).clip(normal="x", origin=(0, 0, 0)))
            mesh = mesh.extract_surface(algorithm="dataset_surface").clean(tolerance=1e-5)
        self._plotter.add_mesh(
            mesh, scalars="shell", clim=limits, cmap=SHELL_COLOURS, smooth_shading=True, show_scalar_bar=False,
            ambient=0.48, diffuse=0.56, specular=0.12, specular_power=20,
        )  # fmt: skip
        edges = mesh.extract_feature_edges(
            boundary_edges=True, feature_edges=False, manifold_edges=False, non_manifold_edges=False
        )
        if edges.n_cells:
            tube = edges.strip(join=True).tube(radius=edge_radius, n_sides=12)
            self._plotter.add_mesh(tube, color=EDGE_COLOUR, ambient=0.4)

    def outline(self, surface: Surface, size: float) -> None:
        """Dash the outline of a shell where the picture's plane cuts it, or its edges if there is no such
        plane."""
        mesh = self._pyvista.PolyData(surface.points, np.insert(surface.triangles, 0, 3, axis=1).ravel())
        if self.view == "sheet":
            curves = mesh.clean(tolerance=1e-7).extract_feature_edges(feature_edges=False, manifold_edges=False)
        elif self.view == "cross-section":
            curves = mesh.slice(normal="z", origin=(0, 0, 1e-3 * size))
        else:
            curves = mesh.slice(normal="y", origin=(0, -1e-3 * size, 0)).clip(normal="-x", origin=(0, 0, 0))
        for curve in curves.strip(join=True, max_length=1 << 20).cell if curves.n_cells else ():
            for dash in _dashes(np.asarray(curve.points, float), DASH * size):
                tube = self._pyvista.lines_from_points(dash).tube(radius=0.0045 * size, n_sides=8)
                self._plotter.add_mesh(tube, color=EDGE_COLOUR, lighting=False)

    def section(self, section: Section, limits: Limits, size: float, lines: bool) -> None:
        """Add a plane with the field, and field ``lines``, for a shell of ``size``."""
        self._plotter.add_mesh(
            section_mesh(section), scalars="values", clim=limits, cmap=FIELD_COLOURS, lighting=False,
            show_scalar_bar=False,
        )  # fmt: skip
        for line in self._field_lines(section, SPACING * size) if lines else ():
            tube = self._pyvista.lines_from_points(line).tube(radius=0.005 * size, n_sides=8)
            self._plotter.add_mesh(tube, color=LINE_COLOUR, lighting=False)

    def _field_lines(self, section: Section, spacing: float) -> list[Floats]:
        """Field lines in the plane of a section, as points in space slightly in front of it."""
        across = 2 if self.view == "cross-section" else 1
        axes = [axis for axis in range(3) if axis != across]
        width = RASTER * spacing
        flat = section_mesh(section)
        flat.points = _in_plane(section.points, axes)
        low, high = np.asarray(flat.points).min(axis=0), np.asarray(flat.points).max(axis=0)
        columns, rows = (np.ceil((high - low) / width).astype(int) + 1)[:2]
        grid = self._pyvista.ImageData(
            dimensions=(columns, rows, 1), spacing=(width, width, width), origin=(low[0], low[1], 0.0)
        )
        vectors = np.asarray(grid.sample(flat, tolerance=1e-3 * width)["vectors"], float)[:, axes]
        if across == 1:
            vectors[np.asarray(grid.points)[:, 0] < 0.25 * spacing] = 0.0  # no lines on the edge of the cut
        placed = []
        for line in field_lines(Raster(vectors.reshape(rows, columns, 2)), 1 / RASTER):
            points = np.zeros((len(line), 3))
            points[:, axes] = low[:2] + width * line
            points[:, across] = (0.03 if across == 2 else -0.03) * spacing
            placed.append(points)
        return placed

    def draw(self, *, turned: bool = False, frame: Frame | None = None) -> Drawing:
        """Draw everything, cut the white border off, and close the scene.

        ``turned`` shows what lies below, as if all were turned over. With a ``frame`` the image shows that
        part of space, border and all: the images of an animation lie on each other.
        """
        position, up = VIEWS[self.view]
        if turned:
            position, up = (position[0], position[1], -position[2]), (-up[0], -up[1], -up[2])
        self._plotter.enable_parallel_projection()
        self._plotter.camera_position = [position, (0.0, 0.0, 0.0), up]
        self._plotter.reset_camera()
        if frame is not None:
            away = np.asarray(self._plotter.camera.position) - np.asarray(self._plotter.camera.focal_point)
            self._plotter.camera.focal_point = frame.centre
            self._plotter.camera.position = tuple(np.asarray(frame.centre) + away)
            self._plotter.camera.parallel_scale = frame.radius
            self._plotter.renderer.ResetCameraClippingRange()
        pixels = np.asarray(self._plotter.screenshot(None, return_img=True))
        metres = 2 * float(self._plotter.camera.parallel_scale) / pixels.shape[0]
        self._plotter.close()
        if frame is not None:
            return Drawing(pixels, metres * pixels.shape[1], metres * pixels.shape[0])
        used = pixels.min(axis=2) < WHITE
        rows, columns = (np.flatnonzero(used.max(axis=axis)) for axis in (1, 0))
        pixels = pixels[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
        return Drawing(pixels, metres * pixels.shape[1], metres * pixels.shape[0])


def _dashes(points: Floats, length: float) -> list[Floats]:
    """Pieces of a polyline of about ``length`` each, with gaps two thirds as long between them."""
    travelled = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    count = max(1, round(travelled[-1] / (5 / 3 * length)))
    pitch = travelled[-1] / count
    at = [np.linspace(number * pitch, (number + 0.6) * pitch, 5) for number in range(count)]
    return [np.column_stack([np.interp(a, travelled, points[:, axis]) for axis in range(3)]) for a in at]


def _in_plane(vectors: Floats, axes: list[int]) -> Floats:
    return np.column_stack([vectors[:, axes], np.zeros(len(vectors))])
