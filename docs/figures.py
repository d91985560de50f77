"""Redraws the response figures of the article whose shell theory this project corrects, with exact answers.

Run from the checkout: ``python docs/figures.py`` writes docs/images/response_*.png. Three curves where they
apply: the article's formula, the corrected shell theory, and the exact three-dimensional one. Circles are
computed by the solver.
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

from embedding import (  # noqa: E402  (works in a checkout that is not installed, too)
    Discretisation,
    EdgeTraction,
    InfiniteCylinder,
    Loads,
    NeoHookean,
    Plate,
    Scene,
    Shell,
    Solution,
    Stage,
    Support,
    solve,
)
from problems.exact import cylinder, plate  # noqa: E402

# Widest at the bottom, so that curves which agree can all be seen.
PUBLISHED: dict[str, Any] = {"color": "#e59a8f", "linewidth": 5.5, "solid_capstyle": "butt"}
CORRECTED: dict[str, Any] = {"color": "#1f5fa8", "linewidth": 2.2}
EXACT: dict[str, Any] = {"color": "black", "linestyle": (0, (1, 2.2)), "linewidth": 2.2}
CLASSICAL: dict[str, Any] = {"color": "#7f8c8d", "linestyle": "-.", "linewidth": 1.6}
COMPUTED: dict[str, Any] = {
    "color": "#0b2545",
    "linestyle": "none",
    "markerfacecolor": "white",
    "markersize": 6,
}
RUBBER = NeoHookean(shear_modulus=1.0)  # everything is drawn over the shear modulus
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


def computed(shape: Plate | InfiniteCylinder, thickness: float, loads: Loads) -> Solution:
    """A solve in eight steps; a plate slides on two edges and stays in its plane."""
    supports = ()
    if isinstance(shape, Plate):
        held = (("x0", "x"), ("y0", "y"), ("surface", "z"))
        supports = tuple(Support(where=where, fix=(axis,)) for where, axis in held)
    return solve(
        Scene(
            shell=Shell(shape=shape, thickness=thickness, material=RUBBER),
            supports=supports,
            loads=loads,
            path=(Stage(steps=8),),
            discretisation=Discretisation(order=2, shell_size=0.5 if supports else 0.1),
        )
    )


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
        pull = EdgeTraction(edge="x1", traction=(2.7 * ratio, 0.0, 0.0))
        solution = computed(Plate(length=1.0, width=1.0), ratio, Loads(edge_tractions=(pull,)))
        loads = [2.7 * ratio * step.factor_mechanical for step in solution.steps]
        axes.plot(
            solution["stretch_max"], loads, "o", **COMPUTED, label="computed" if ratio == 1 / 20 else None
        )
        axes.plot(solution["stretch_min"], loads, "o", **COMPUTED)
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
    solution = computed(Plate(length=1.0, width=1.0), 0.05, Loads(pressure_top=2.3, pressure_bottom=2.3))
    axes.plot(solution["stretch"], solution["pressure_top"], "o", **COMPUTED, label="computed")
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
    for outer, marker in ((0.0, "o"), (0.08, "s")):
        loads = Loads(pressure_top=outer, pressure_bottom=outer + 0.95 * ratio)
        solution = computed(InfiniteCylinder(radius=1.0), ratio, loads)
        label = rf"computed, $p_t/\mu={outer:g}$"
        style = COMPUTED | {"markersize": 10 if outer else 5}
        axes.plot(
            solution["stretch"],
            solution["pressure_difference"],
            marker,
            **style,
            label=label,
            zorder=3 - outer,
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
