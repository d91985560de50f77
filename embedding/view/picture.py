"""One picture of a step: the deformed shell in space, the field around it in a plane, colour bars with
units."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from embedding.archive import Archive, open_archive
from embedding.scene.scales import EPSILON_0
from embedding.view.colours import FIELD_COLOURS, SHELL_COLOURS, Limits, colour_limits
from embedding.view.drawing import PIXELS, Canvas, Drawing, Frame
from embedding.view.labels import quantity, round_length
from embedding.view.page import Bar, Page
from embedding.view.rendering import require_rendering
from embedding.view.section import Section, field_limits, planes_with_field, vector_field
from embedding.view.surface import Surface, shell_surface

VIEW = {"sphere": "meridian", "infinite-cylinder": "cross-section"}
"""How shapes are looked at; all others are sheets."""
REACH = 2.4  # how much of the ambient is shown, in sizes of the shell
MOVED = 0.02  # how far a shell must have moved, relative to its size, for its old outline to be shown
BENT = 0.05  # how little a shell is stretched, relative to how far it has moved, for its displacement to be shown
SPACED = 0.5  # the size that the spacing of lines in an animation is meant for, in radii of its frame
MORE = 1.5  # from which part of the range of colours on a value above it is told of
UNFELT = 1e-5  # of the field that a voltage would make: what is left beside a shell whose field is all in its wall
ROUNDING = 1e-7  # relative to the scales of a run
CAPTION = {
    "voltage": "voltage",
    "pressure_difference": "inflating pressure",
    "volume_ratio": "volume ratio",
    "stretch": "mean stretch",
}


def picture(
    archive: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    step: int = -1,
    shell_field: str | None = None,
    ambient_field: str | None = None,
    lines: bool = True,
    reach: float = REACH,
) -> Path:
    """Draw a step of an archive into the PNG file ``output``, and return its path.

    The shell is shown deformed and coloured by ``shell_field`` (default: the stretch, or how far it has moved if it has
    hardly been stretched), with a quarter of a closed shell cut away;
    the plane that the cut opens shows ``ambient_field`` (default: the strength of the electric or magnetic
    field) and field ``lines``, out to ``reach`` sizes of the shell. Axisymmetric results are revolved,
    plane-strain results extruded, mirrored parts completed. A side of the ambient that is free of field is
    left open.

    Raises:
        RenderError: drawing is impossible here; the message says what to install.
        ArchiveError: the archive cannot be read, or it has no such step or field.
        OSError: ``output`` cannot be written.
    """
    require_rendering()
    opened = open_archive(archive)
    view = StepView.of(opened, opened.index(step), shell_field, ambient_field, reach)
    limits = view.limits([view])
    return view.page(limits).save(view.draw(limits, lines), Path(output))


@dataclass(frozen=True)
class StepView:
    """What a picture of one step shows: the deformed shell and, if there is a field, the planes of the ambient.

    ``size`` is that of the deformed shell in m, ``planes`` the sides that have a field.
    """

    archive: Archive
    step: int
    shell_field: str
    ambient_field: str | None
    surface: Surface
    size: float
    planes: tuple[Section, ...]

    @staticmethod
    def of(
        archive: Archive,
        step: int,
        shell_field: str | None,
        ambient_field: str | None,
        reach: float,
        radius: float | None = None,
    ) -> StepView:
        """The view of a step; the ambient is shown out to ``reach`` sizes of the shell, or to a ``radius`` in m."""
        kind = _kind(archive)
        field = shell_field or telling(archive, step)
        surface = shell_surface(archive, field, step, turn=(0.0, 270.0) if kind == "sphere" else (0.0, 360.0))
        across = surface.points[:, :2] if VIEW.get(kind) == "cross-section" else surface.points - surface.centre
        size = float(np.linalg.norm(across, axis=1).max())
        if "outside" not in archive.blocks:
            return StepView(archive, step, field, None, surface, size, ())
        name = ambient_field or vector_field(archive.block("outside", step))
        planes = planes_with_field(archive, name, step, radius or reach * size)
        if name in ("E", "D") and max(plane.strength for plane in planes) < UNFELT * _driving(archive, name, step):
            return StepView(archive, step, field, None, surface, size, ())
        return StepView(archive, step, field, name, surface, size, tuple(planes))

    def limits(self, views: Sequence[StepView]) -> tuple[Limits, Limits | None]:
        """Colours of the shell and of the ambient that suit all ``views``."""
        shell = self.archive.block("shell", self.step).units[self.shell_field]
        surfaces = [view.surface.values for view in views]
        of_shell = colour_limits(surfaces, from_zero=self.shell_field == "u", noise=noise_of(self.archive, shell))
        if self.ambient_field is None:
            return of_shell, None
        unit = self.archive.block("outside", self.step).units[self.ambient_field]
        planes = [plane for view in views for plane in view.planes]
        return of_shell, field_limits(planes, noise_of(self.archive, unit))[0]

    @property
    def moved(self) -> bool:
        """Has the shell moved far enough for its undeformed outline to be shown?"""
        u = self.archive.block("shell", self.step).field("u")
        return float(np.linalg.norm(u, axis=1).max()) > MOVED * self.size

    def draw(
        self,
        limits: tuple[Limits, Limits | None],
        lines: bool,
        frame: Frame | None = None,
        pixels: tuple[int, int] = PIXELS,
    ) -> Drawing:
        """Draw the view, cropped, or in a ``frame`` on so many ``pixels``, with lines as far apart as suits it."""
        kind = _kind(self.archive)
        canvas = Canvas(VIEW.get(kind, "sheet"), size=pixels)
        edge = 0.004 * self.size if kind not in VIEW else _edge_radius(self.archive, self.step, self.size)
        cut = kind == "sphere" and self.archive.run["reduction"] == "3d"
        canvas.shell(self.surface, limits[0], edge, quarter_cut=cut)
        if self.moved:
            canvas.outline(shell_surface(self.archive, self.shell_field, self.step, deformed=False), self.size)
        for plane in self.planes:
            with_lines = lines and plane.strength > 0
            size = self.size if frame is None else SPACED * frame.radius
            canvas.section(plane, limits[1] or (0.0, 1.0), size, with_lines)
        return canvas.draw(frame=frame)

    def page(self, limits: tuple[Limits, Limits | None]) -> Page:
        """The page around the drawing."""
        shell = self.archive.block("shell", self.step).units[self.shell_field]
        bars = [Bar(SHELL_COLOURS, limits[0], self.shell_field, shell)]
        if self.ambient_field is not None and limits[1] is not None:
            unit = self.archive.block("outside", self.step).units[self.ambient_field]
            largest = max(float(plane.values.max()) for plane in self.planes)
            bars.append(Bar(FIELD_COLOURS, limits[1], self.ambient_field, unit, largest > MORE * limits[1][1]))
        title, note = self.archive.run["name"].replace("_", " "), "dashed: undeformed" if self.moved else ""
        return Page(title, caption_of(self.archive, self.step), tuple(bars), round_length(self.size), note)


def is_closed(archive: Archive) -> bool:
    """Is the shell shown with a quarter of it cut away?"""
    return _kind(archive) == "sphere"


def _kind(archive: Archive) -> str:
    return str(archive.scene_table()["shell"]["shape"]["kind"])


def telling(archive: Archive, step: int) -> str:
    """The stretch, or the displacement of a shell that is bent more than it is stretched."""
    shell = archive.block("shell", step)
    stretched = float(np.abs(shell.field("stretch", step) - 1.0).max())
    moved = float(np.linalg.norm(shell.field("u", step), axis=1).max()) / archive.scales.length
    return "u" if stretched < BENT * moved else "stretch"


def _edge_radius(archive: Archive, step: int, size: float) -> float:
    """Half the thickness of the shell, as its cut is drawn; a thin shell is drawn thick enough to be seen."""
    stated = archive.scene_table()["shell"]["thickness"]
    thickness = float(stated) if isinstance(stated, (int, float)) else 0.0  # one that varies is drawn as a line
    shell = archive.block("shell", step)
    if "thickness_stretch" in shell.units:
        thickness *= float(shell.field("thickness_stretch", step).max())
    return max(thickness / 2, 0.006 * size)


def noise_of(archive: Archive, unit: str) -> float:
    """What cannot be told from zero in a quantity of this unit: a small part of the run's own scale."""
    scales = archive.scales
    size = {"m": scales.length, "Pa": scales.stress, "V": scales.potential, "A": scales.potential}
    return ROUNDING * (size | {"V/m": scales.field, "A/m": scales.field}).get(unit, 1.0)


def _driving(archive: Archive, name: str, step: int) -> float:
    """The field that the largest voltage of a step would make over the size of the shell, in the unit of ``name``."""
    volts = [abs(values[step]) for scalar, values in archive.scalars.items() if scalar.startswith("voltage")]
    strength = max(volts, default=0.0) / archive.scales.length
    return float(strength * (EPSILON_0 if name == "D" else 1.0))


def caption_of(archive: Archive, step: int) -> str:
    """Which step, and the scalars that say something about it."""
    parts = [f"step {step + 1} of {len(archive)}"]
    for name, words in CAPTION.items():
        value = float(archive.scalars.get(name, np.zeros(len(archive)))[step])
        if np.isfinite(value) and abs(value) > noise_of(archive, archive.scalar_units.get(name, "1")):
            parts.append(f"{words} {quantity(value, archive.scalar_units[name])}")
    return "  ·  ".join(parts)
