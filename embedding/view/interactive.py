"""A run as one page for a browser: the deformed shell to be turned by hand, its fields and its steps to choose from.

The page holds everything it needs, and asks for nothing: about 150 lines of WebGL stand in the file beside this one.
Libraries that do the same bring megabytes with them (plotly), or a server.
"""

from __future__ import annotations

import base64
import html
import json
import math
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive, open_archive
from embedding.errors import ArchiveError
from embedding.view.colours import SHELL_COLOURS, colour_limits
from embedding.view.labels import label, prefixed
from embedding.view.picture import caption_of, is_closed, telling
from embedding.view.rendering import require_packages
from embedding.view.surface import Surface, shell_surface

Floats = npt.NDArray[np.float64]
TEMPLATE = Path(__file__).with_suffix(".html")
FRAMES, TURNS = 40, 60
TRIANGLES, FINEST = 8000, 8  # about so many in a shell that is not revolved; pieces of an edge at most
ALONG = 5  # pieces of every element of a curve
LEFT_OUT = ("normal",)
SCALAR = (1, 3)  # components of a field that can be coloured: itself or its length


def interactive_page(
    archive: str | os.PathLike[str], output: str | os.PathLike[str], *, fields: Sequence[str] | None = None
) -> Path:
    """Write the deformed shell at all steps (at most 40, evenly chosen) into the HTML file ``output``.

    ``fields`` are those of the shell that can be chosen (default: all, that of :func:`embedding.view.picture` first;
    vectors by their length). Places are rounded to 3e-5 of the size of what is shown, colours to 2e-5 of their range.
    Neither a network nor OpenGL on this machine nor another file is needed.

    Raises:
        RenderError: matplotlib is not installed; the message says how to install it.
        ArchiveError: the archive cannot be read, or it has no accepted step or no such field.
        OSError: ``output`` cannot be written.
    """
    require_packages("matplotlib")
    opened = open_archive(archive)
    if not len(opened):
        raise ArchiveError(f"{opened.path}: no step was accepted, so there is nothing to draw")
    title = opened.run["name"].replace("_", " ")
    text = json.dumps(page_data(opened, fields), separators=(",", ":")).replace("</", "<\\/")
    page = TEMPLATE.read_text(encoding="utf-8").replace("@TITLE@", html.escape(title)).replace("@DATA@", text)
    Path(output).write_text(page, encoding="utf-8")
    return Path(output)


def page_data(archive: Archive, fields: Sequence[str] | None = None) -> dict[str, Any]:
    """What the page shows, as it stands in it."""
    from matplotlib import colormaps

    names = _fields(archive, fields)
    steps = np.unique(np.linspace(0, len(archive) - 1, min(FRAMES, len(archive))).round().astype(int)).tolist()
    shells = {name: [_surface(archive, name, step) for step in steps] for name in names}
    first = shells[names[0]]
    low, high = (f([f(shell.points, axis=0) for shell in first], axis=0) for f in (np.min, np.max))
    centre = (low + high) / 2
    radius = max(float(np.linalg.norm(shell.points - centre, axis=1).max()) for shell in first)
    limits = {name: colour_limits([shell.values for shell in shells[name]], name == "u", 1e-300) for name in names}
    return {
        "title": archive.run["name"].replace("_", " "),
        "triangles": _packed(first[0].triangles, "<u4"),
        "colours": _packed(255 * colormaps[SHELL_COLOURS](np.linspace(0, 1, 256))[:, :3], "<u1"),
        "fields": [_described(archive, name, limits[name]) for name in names],
        "steps": [
            {
                "caption": caption_of(archive, step),
                "places": _packed(32767 * (first[number].points - centre) / radius, "<i2"),
                "values": [_levels(shells[name][number].values, limits[name]) for name in names],
            }
            for number, step in enumerate(steps)
        ],
    }


def _surface(archive: Archive, field: str, step: int) -> Surface:
    turn = (0.0, 270.0) if is_closed(archive) else (0.0, 360.0)
    pieces = round(math.sqrt(TRIANGLES / len(archive.block("shell", step).cells)))
    steps = {1: ALONG, 2: min(max(pieces, 2), FINEST)}
    return shell_surface(archive, field, step, turn=turn, steps=steps, turns=TURNS)


def _fields(archive: Archive, fields: Sequence[str] | None) -> list[str]:
    block = archive.block("shell")
    if fields is not None:
        for name in fields:
            block.field(name)  # raises the error that lists what there is
        return list(fields)
    sizes = {name: block.field(name)[:1].size for name in block.fields}
    names = [name for name, size in sizes.items() if size in SCALAR and name not in LEFT_OUT]
    return sorted(names, key=lambda name: name != telling(archive, len(archive) - 1))


def _described(archive: Archive, name: str, limits: tuple[float, float]) -> dict[str, Any]:
    """A field's name and its range in a pleasant unit."""
    factor, unit = prefixed(max(map(abs, limits)), archive.block("shell").units[name])
    text = label(name, unit).replace("$", "").replace("_", "")
    return {"name": name, "label": text, "low": factor * limits[0], "high": factor * limits[1]}


def _levels(values: Floats, limits: tuple[float, float]) -> str:
    return _packed(65535 * np.clip((values - limits[0]) / (limits[1] - limits[0]), 0.0, 1.0), "<u2")


def _packed(values: npt.NDArray[Any], kind: str) -> str:
    whole = values if values.dtype.kind in "iu" else np.rint(np.nan_to_num(values))
    return base64.b64encode(np.ascontiguousarray(whole.astype(kind)).tobytes()).decode()
