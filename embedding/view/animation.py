"""A run as a moving picture: the steps one after another, on one scale of colours and seen from one place."""

from __future__ import annotations

import importlib.util
import io
import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np

from embedding.archive import Archive, open_archive
from embedding.errors import ArchiveError
from embedding.view.drawing import WHITE, Drawing, Frame
from embedding.view.labels import round_length
from embedding.view.picture import REACH, StepView, telling
from embedding.view.rendering import RenderError, require_rendering

FRAMES = 60  # most of them; a longer run is thinned out
PER_SECOND = 8.0
LAST = 1.5  # s for which the last frame stays
PIXELS = (1100, 1100)
DPI = 80
ROOM = 1.06  # around what is shown, relative to it


def animation(
    archive: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    shell_field: str | None = None,
    ambient_field: str | None = None,
    lines: bool = True,
    reach: float = REACH,
    per_second: float = PER_SECOND,
    kind: Literal[".gif", ".mp4"] | None = None,
) -> Path:
    """Draw all steps of an archive (at most 60 of them, evenly chosen) into the GIF or MP4 file ``output``.

    Fields as in :func:`embedding.view.picture`; the default is that of the last step. Colours, camera and the size of
    the page are those that suit all frames. ``kind`` is the kind of file, if the name of ``output`` does not say it.

    Raises:
        RenderError: drawing is impossible here, or an MP4 is asked for and imageio-ffmpeg is missing.
        ArchiveError: the archive cannot be read, or it has no accepted step or no such field.
        OSError: ``output`` cannot be written.
    """
    film = (kind or Path(output).suffix) == ".mp4"
    if film:
        require_ffmpeg()
    require_rendering()
    opened = open_archive(archive)
    if not len(opened):
        raise ArchiveError(f"{opened.path}: no step was accepted, so there is nothing to draw")
    images = frames(opened, shell_field, ambient_field, lines, reach)
    write = _write_mp4 if film else _write_gif
    write(images, Path(output), per_second)
    return Path(output)


def require_ffmpeg() -> None:
    """Raise RenderError, saying how to install it, if what writes MP4 files is missing."""
    if importlib.util.find_spec("imageio_ffmpeg") is None:
        raise RenderError("MP4 files need imageio-ffmpeg: pip install 'embedding[movies]'; a GIF needs nothing more")


def frames(
    archive: Archive, shell_field: str | None, ambient_field: str | None, lines: bool, reach: float
) -> list[Any]:
    """The images, as Pillow images of one size."""
    from PIL import Image

    steps = np.unique(np.linspace(0, len(archive) - 1, min(FRAMES, len(archive))).round().astype(int)).tolist()
    field = shell_field or telling(archive, steps[-1])
    largest = max(StepView.of(archive, step, field, ambient_field, reach).size for step in (steps[0], steps[-1]))
    views = [StepView.of(archive, step, field, ambient_field, reach, reach * largest) for step in steps]
    limits = views[-1].limits(views)
    frame = _frame(views)
    pages = [replace(view.page(limits), scale=round_length(largest)) for view in views]
    letters = max(len(page.caption) for page in pages)
    images = []
    drawings = cropped_alike([view.draw(limits, lines, frame=frame, pixels=PIXELS) for view in views])
    for drawing, page in zip(drawings, pages, strict=True):
        held = io.BytesIO()
        replace(page, caption=page.caption.ljust(letters)).save(drawing, held, dpi=DPI)
        held.seek(0)
        images.append(Image.open(held).convert("RGB"))
    return images


def cropped_alike(drawings: Sequence[Drawing]) -> list[Drawing]:
    """Drawings of one frame without the border that is white in all of them."""
    used = np.min([drawing.pixels.min(axis=2) for drawing in drawings], axis=0) < WHITE
    rows, columns = (np.flatnonzero(used.max(axis=axis)) for axis in (1, 0))
    kept = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
    metre = drawings[0].width / used.shape[1]
    high, wide = used[kept].shape
    return [Drawing(drawing.pixels[kept], metre * wide, metre * high) for drawing in drawings]


def _frame(views: Sequence[StepView]) -> Frame:
    """The ball around everything that the views show."""
    parts = [points for view in views for points in (view.surface.points, *(plane.points for plane in view.planes))]
    low = np.min([part.min(axis=0) for part in parts], axis=0)
    high = np.max([part.max(axis=0) for part in parts], axis=0)
    centre = (low + high) / 2
    radius = max(float(np.linalg.norm(part - centre, axis=1).max()) for part in parts)
    return Frame((float(centre[0]), float(centre[1]), float(centre[2])), ROOM * radius)


def _write_gif(images: Sequence[Any], output: Path, per_second: float) -> None:
    """Every frame with the 256 colours that suit it."""
    small = [image.quantize(256) for image in images]
    times = [round(1000 / per_second)] * (len(small) - 1) + [round(1000 * LAST)]
    small[0].save(
        output, format="GIF", save_all=True, append_images=small[1:], duration=times, loop=0, optimize=True
    )


def _write_mp4(images: Sequence[Any], output: Path, per_second: float) -> None:
    import imageio_ffmpeg

    width, height = (size - size % 2 for size in images[0].size)  # what most players ask for
    stay = max(1, round(LAST * per_second))
    writer = imageio_ffmpeg.write_frames(
        str(output), (width, height), fps=per_second, codec="libx264", macro_block_size=2,
        output_params=["-f", "mp4"], ffmpeg_log_level="error",
    )  # fmt: skip
    writer.send(None)
    for image in [*images, *[images[-1]] * stay]:
        writer.send(np.ascontiguousarray(np.asarray(image)[:height, :width]))
    writer.close()
