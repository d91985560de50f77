"""One picture of a step: the deformed shell in space, the field around it in a plane, colour bars with
units."""

from __future__ import annotations

import os
import tomllib
from pathlib import Path

import numpy as np

from embedding.archive import Archive, open_archive
from embedding.view.drawing import FIELD_COLOURS, SHELL_COLOURS, Canvas, colour_limits
from embedding.view.labels import quantity, round_length
from embedding.view.page import Bar, Page
from embedding.view.rendering import require_rendering
from embedding.view.section import cropped, sections, vector_field
from embedding.view.surface import shell_surface

REACH = 2.4  # how much of the ambient is shown, in sizes of the shell
FIELD_FREE = 1e-3  # a side whose field is weaker than this part of the other's is left out
MOVED = 0.02  # how far a shell must have moved, relative to its size, for its old outline to be shown
BENT = 0.05  # how little a shell is stretched, relative to how far it has moved, for its displacement to be shown
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
    number = opened.index(step)
    shell_field = shell_field or _telling(opened, number)
    kind = tomllib.loads(opened.scene)["shell"]["shape"]["kind"]
    closed = kind == "sphere"
    view = {"sphere": "meridian", "infinite-cylinder": "cross-section"}.get(kind, "sheet")
    surface = shell_surface(opened, shell_field, number, turn=(0.0, 270.0) if closed else (0.0, 360.0))
    across = surface.points[:, :2] if view == "cross-section" else surface.points - surface.centre
    size = float(np.linalg.norm(across, axis=1).max())
    unit = opened.block("shell").units[shell_field]
    limits = colour_limits([surface.values], from_zero=shell_field == "u", noise=_noise(opened, unit))
    canvas = Canvas(view)
    edge = 0.004 * size if view == "sheet" else _edge_radius(opened, number, size)
    canvas.shell(surface, limits, edge, quarter_cut=closed and opened.run["reduction"] == "3d")
    moved = float(np.linalg.norm(opened.block("shell", number).field("u"), axis=1).max()) > MOVED * size
    if moved:
        canvas.outline(shell_surface(opened, shell_field, number, deformed=False), size)
    bars = [Bar(SHELL_COLOURS, limits, shell_field, unit)]
    if "outside" in opened.blocks:
        bars.append(_add_ambient(canvas, opened, ambient_field, number, size, reach, lines))
    title, note = opened.run["name"].replace("_", " "), "dashed: undeformed" if moved else ""
    page = Page(title, _caption(opened, number), tuple(bars), round_length(size), note)
    return page.save(canvas.draw(), Path(output))


def _telling(archive: Archive, step: int) -> str:
    """The stretch, or the displacement of a shell that is bent more than it is stretched."""
    shell = archive.block("shell", step)
    stretched = float(np.abs(shell.field("stretch", step) - 1.0).max())
    moved = float(np.linalg.norm(shell.field("u", step), axis=1).max()) / archive.scales.length
    return "u" if stretched < BENT * moved else "stretch"


def _add_ambient(
    canvas: Canvas, archive: Archive, field: str | None, step: int, size: float, reach: float, lines: bool
) -> Bar:
    """Add the planes of all sides that have a field; returns their common colour bar."""
    name = field or vector_field(archive.block("outside"))
    planes = [cropped(plane, reach * size) for plane in sections(archive, name, step).values()]
    strongest = max(plane.strength for plane in planes)
    planes = [plane for plane in planes if plane.strength >= FIELD_FREE * strongest]
    unit = archive.block("outside").units[name]
    limits = colour_limits([plane.values for plane in planes], from_zero=True, noise=_noise(archive, unit))
    for plane in planes:
        canvas.section(plane, limits, size, lines and strongest > 0)
    return Bar(FIELD_COLOURS, limits, name, unit)


def _edge_radius(archive: Archive, step: int, size: float) -> float:
    """Half the thickness of the shell, as its cut is drawn; a thin shell is drawn thick enough to be seen."""
    stated = tomllib.loads(archive.scene)["shell"]["thickness"]
    thickness = float(stated) if isinstance(stated, (int, float)) else 0.0  # one that varies is drawn as a line
    shell = archive.block("shell", step)
    if "thickness_stretch" in shell.units:
        thickness *= float(shell.field("thickness_stretch", step).max())
    return max(thickness / 2, 0.006 * size)


def _noise(archive: Archive, unit: str) -> float:
    """What cannot be told from zero in a quantity of this unit: a small part of the run's own scale."""
    scales = archive.scales
    size = {"m": scales.length, "Pa": scales.stress, "V": scales.potential, "A": scales.potential}
    return ROUNDING * (size | {"V/m": scales.field, "A/m": scales.field}).get(unit, 1.0)


def _caption(archive: Archive, step: int) -> str:
    """Which step, and the scalars that say something about it."""
    parts = [f"step {step + 1} of {len(archive)}"]
    for name, words in CAPTION.items():
        value = float(archive.scalars.get(name, np.zeros(len(archive)))[step])
        if np.isfinite(value) and value != 0.0:
            parts.append(f"{words} {quantity(value, archive.scalar_units[name])}")
    return "  ·  ".join(parts)
