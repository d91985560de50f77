"""A chart of a fit: the measured points of every kind of test, and the law's curves through them."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np

from embedding.fit.fitting import Fit
from embedding.fit.stress import nominal_stress
from embedding.shell.laws import law_of
from embedding.view.history import DPI, INK
from embedding.view.labels import prefixed
from embedding.view.rendering import require_packages

SIZE = (8.0, 5.2)  # inches
LOOKS = {
    "uniaxial": ("uniaxial", "#c8553d", "o"),
    "equibiaxial": ("equibiaxial", "#2f6690", "s"),
    "pure-shear": ("pure shear", "#6d9a8b", "^"),
}


def fit_picture(fit: Fit, output: str | os.PathLike[str]) -> Path:
    """Draw measurements and fitted curves, nominal stress over stretch, into the PNG file ``output``; returns its path.

    Raises:
        RenderError: matplotlib or pyvista is not installed; the message says how to install them.
        OSError: ``output`` cannot be written.
    """
    require_packages()
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=SIZE, dpi=DPI, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    law = fit.material.law.replace("-", " ")
    axes.set_title(f"{law}: rms error {_with_prefix(fit.rms)}", fontsize=15, color=INK, loc="left", pad=10)
    largest = max(float(np.abs(series.nominal_stress).max()) for series in fit.measurements.series)
    factor, unit = prefixed(largest, "Pa")
    _draw(axes, fit, factor)
    axes.set_xlabel("stretch", fontsize=12, color=INK)
    axes.set_ylabel(f"nominal stress [{unit}]", fontsize=12, color=INK)
    figure.savefig(output, facecolor="white", format="png")
    return Path(output)


def _with_prefix(stress: float) -> str:
    factor, unit = prefixed(stress, "Pa")
    return f"{factor * stress:.3g} {unit}"


def _draw(axes: Any, fit: Fit, factor: float) -> None:
    law = law_of(fit.material, 1.0)
    for series in fit.measurements.series:
        words, colour, marker = LOOKS[series.mode]
        axes.plot(
            series.stretch, factor * series.nominal_stress, linestyle="none", color=colour, marker=marker,
            markersize=5.5, markerfacecolor="white", markeredgewidth=1.4, label=f"{words}, measured",
        )  # fmt: skip
        stretches = np.linspace(min(1.0, series.stretch.min()), max(1.0, series.stretch.max()), 400)
        curve = factor * nominal_stress(law, series.mode, stretches)
        axes.plot(stretches, curve, color=colour, linewidth=1.8, label=f"{words}, fitted")
    axes.grid(color="#e4e4ea", linewidth=0.8)
    axes.tick_params(colors=INK, labelsize=10.5)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.legend(frameon=False, fontsize=11, labelcolor=INK)
