"""Redraws the response figures of the article whose shell theory this project corrects, with exact answers.

Run from the checkout: ``python docs/figures.py`` writes docs/images/response_*.png. Three curves where they
apply: the article's formula, the corrected shell theory, and the exact three-dimensional solution.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from problems.exact import cylinder, plate  # noqa: E402  (the checkout is not installed)

# Widest at the bottom, so that curves which agree can all be seen.
PUBLISHED: dict[str, Any] = {"color": "#e59a8f", "linewidth": 5.5, "solid_capstyle": "butt"}
CORRECTED: dict[str, Any] = {"color": "#1f5fa8", "linewidth": 2.2}
EXACT: dict[str, Any] = {"color": "black", "linestyle": (0, (1, 2.2)), "linewidth": 2.2}
CLASSICAL: dict[str, Any] = {"color": "#7f8c8d", "linestyle": "-.", "linewidth": 1.6}
REDS = ("#7b241c", "#c0392b", "#e67e6b")


def three_curves(
    axes: Any, stretches: Any, published: Any, corrected: Any, exact: Any, label: bool = True
) -> None:
    """The article's, the corrected shell's and the exact response on top of each other."""
    for values, style, name in (
        (published, PUBLISHED, "as published"),
        (corrected, CORRECTED, "corrected shell"),
        (exact, EXACT, "exact 3D"),
    ):
        axes.plot(stretches, values, label=name if label else None, **style)


def plate_traction(axes: Any) -> None:
    """Uniaxial traction, figure 1(c): edge force t over mu L against both stretches, two thicknesses.

    The shell's edge condition with an exact thickness stretch is the exact answer itself, so all three agree.
    """
    stretches = np.linspace(1.0, 3.0, 81)
    for ratio, mark in ((1 / 20, "1/20"), (1 / 30, "1/30")):
        shell = ratio * (stretches - stretches**-2)
        exact = [ratio * plate.traction(float(one)) for one in stretches]
        three_curves(axes, stretches, shell, shell, exact, label=ratio == 1 / 20)
        three_curves(axes, stretches**-0.5, shell, shell, exact, label=False)
        axes.text(2.55, shell[63] + 0.003, f"$T/L={mark}$", ha="right", va="bottom")
    axes.text(0.60, 0.035, r"$\lambda_2$", fontsize=13)
    axes.text(1.75, 0.035, r"$\lambda_1$", fontsize=13)
    axes.set(
        xlabel=r"stretches $\lambda_1$, $\lambda_2$", ylabel=r"$t_\ell/(\mu L)$", title="Plate under traction"
    )


def plate_squeeze(axes: Any) -> None:
    """Equal pressures on both faces, figure 1(d): p over mu against the in-plane stretch."""
    stretches = np.linspace(1.0, 1.6, 61)
    shell = stretches**2 - stretches**-4
    three_curves(axes, stretches, shell, shell, [plate.squeeze(float(one)) for one in stretches])
    axes.axvline(1.0, label="net pressure on the mid-surface:\nno response", **CLASSICAL)
    axes.set(
        xlabel=r"in-plane stretch $\lambda_1=\lambda_2$",
        ylabel=r"$p/\mu$",
        title="Plate squeezed by equal pressures",
    )


def cylinder_inflation(axes: Any, ratio: float, mark: str) -> None:
    """Inflation of an infinite cylinder, figure 2(b): pressure difference over mu, hoop stretch."""
    stretches = np.linspace(1.0, 2.2, 121)
    for outer, red in zip((0.0, 0.04, 0.08), REDS, strict=True):
        printed = [cylinder.printed_pressure(float(one), ratio, outer) for one in stretches]
        axes.plot(stretches, printed, label=rf"as published, $p_t/\mu={outer:g}$", color=red, linewidth=1.6)
    axes.plot(
        stretches,
        [cylinder.membrane_pressure(float(one), ratio) for one in stretches],
        label="corrected shell, any $p_t$",
        **CORRECTED,
    )
    axes.plot(
        stretches,
        [cylinder.thick_pressure(float(one), ratio) for one in stretches],
        label="exact 3D, any $p_t$",
        **EXACT,
    )
    axes.set(
        xlabel=r"hoop stretch $\lambda_\theta$",
        ylabel=r"$(p_b-p_t)/\mu$",
        title=f"Cylinder inflation, $T/R={mark}$",
    )


def main() -> None:
    """Write the three pictures."""
    folder = HERE / "images"
    folder.mkdir(exist_ok=True)
    for name, panels in {
        "response_plate_traction": [(plate_traction, ())],
        "response_plate_squeeze": [(plate_squeeze, ())],
        "response_cylinder": [(cylinder_inflation, (1 / 20, "1/20")), (cylinder_inflation, (1 / 30, "1/30"))],
    }.items():
        figure, axes = plt.subplots(
            1, len(panels), figsize=(5.2 * len(panels), 3.9), layout="constrained", squeeze=False
        )
        for (draw, arguments), one in zip(panels, axes[0], strict=True):
            draw(one, *arguments)
            one.set_ylim(bottom=0.0)
            one.grid(alpha=0.25)
            one.legend(fontsize=8, framealpha=0.9)
        figure.savefig(folder / f"{name}.png", dpi=130)
        plt.close(figure)
        print(folder / f"{name}.png")


if __name__ == "__main__":
    main()
