"""A white page around a drawing: title, caption, colour bars with units, and a scale."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, TypeVar

from embedding.view.colours import Limits
from embedding.view.drawing import Drawing
from embedding.view.labels import label, prefixed, quantity

DPI = 160
Target = TypeVar("Target", Path, BinaryIO)
INK, GREY = "#22222a", "#555560"
LARGEST = (8.0, 6.3)  # of the drawing, in inches
MARGIN, HEAD, FOOT = 0.4, 1.0, 0.75
BAR_COLUMN, BAR_WIDTH, BAR_GAP = 1.75, 0.2, 0.75
LEAST_HEIGHT = 3.2  # room for a colour bar
LETTER = 0.079  # width of a letter of the caption


@dataclass(frozen=True)
class Bar:
    """A colour bar: its colours, its range and what it shows, in SI, and whether there is ``more`` above the range."""

    colours: str
    limits: Limits
    name: str
    unit: str
    more: bool = False


@dataclass(frozen=True)
class Page:
    """What surrounds a drawing; ``scale`` is the length in m of the scale below it, ``note`` stands beside
    it."""

    title: str
    caption: str
    bars: tuple[Bar, ...]
    scale: float
    note: str

    def save(self, drawing: Drawing, output: Target, dpi: int = DPI) -> Target:
        """Put everything on a page as large as it needs to be, and write it as a PNG file or into a stream."""
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        inches = min(LARGEST[0] / drawing.width, LARGEST[1] / drawing.height)
        wide, high = inches * drawing.width, inches * drawing.height
        width = 2 * MARGIN + max(wide + BAR_COLUMN, LETTER * len(self.caption))
        body = max(LEAST_HEIGHT, high)
        height = HEAD + body + FOOT
        figure = Figure(figsize=(width, height), dpi=dpi, facecolor="white")
        FigureCanvasAgg(figure)
        left = (width - BAR_COLUMN - wide) / 2
        bottom = FOOT + (body - high) / 2
        axes = figure.add_axes((left / width, bottom / height, wide / width, high / height))
        axes.imshow(drawing.pixels, extent=(0.0, wide, 0.0, high), interpolation="antialiased", aspect="auto")
        axes.axis("off")
        self._add_scale(axes, inches)
        self._add_bars(figure, width, height, body)
        figure.text(MARGIN / width, 1 - 0.38 / height, self.title, fontsize=17, color=INK, va="center")
        figure.text(MARGIN / width, 1 - 0.72 / height, self.caption, fontsize=11, color=GREY, va="center")
        figure.savefig(output, facecolor="white", format="png")
        return output

    def _add_bars(self, figure: Any, width: float, height: float, body: float) -> None:
        """Colour bars one above the other at the right."""
        from matplotlib.cm import ScalarMappable
        from matplotlib.colors import Normalize

        length = min((body - BAR_GAP * (len(self.bars) - 1)) / len(self.bars), 3.4)
        used = length * len(self.bars) + BAR_GAP * (len(self.bars) - 1)
        for number, bar in enumerate(self.bars):
            bottom = FOOT + (body + used) / 2 - length - number * (length + BAR_GAP)
            place = ((width - BAR_COLUMN + 0.1) / width, bottom / height, BAR_WIDTH / width, length / height)
            factor, unit = prefixed(max(map(abs, bar.limits)), bar.unit)
            low, high = (factor * limit for limit in bar.limits)
            colours = ScalarMappable(Normalize(low, high), bar.colours)
            extend = "max" if bar.more else "neither"
            drawn = figure.colorbar(colours, cax=figure.add_axes(place), extend=extend)
            drawn.set_label(label(bar.name, unit), fontsize=12, color=INK, labelpad=8)
            drawn.ax.tick_params(labelsize=10.5, colors=INK)
            drawn.ax.ticklabel_format(useOffset=False)
            drawn.outline.set_linewidth(0.6)

    def _add_scale(self, axes: Any, inches: float) -> None:
        """The scale, below the drawing at the left."""
        length = inches * self.scale
        axes.set_autoscale_on(False)
        axes.plot(
            [0, length], [-0.22, -0.22], color=INK, linewidth=2.2, solid_capstyle="butt", clip_on=False
        )
        words = quantity(self.scale, "m")
        axes.text(length / 2, -0.3, words, fontsize=11, color=INK, ha="center", va="top")
        axes.text(length + 0.35, -0.22, self.note, fontsize=10.5, color=GREY, ha="left", va="center")
