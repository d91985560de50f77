"""Thickness over size from 2e-1 to 1e-7: membrane and bending, curved and flat."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial

from embedding.bench.extremes.cell import FAILED, RIGHT, TOLD, Cell, nothing
from embedding.bench.extremes.forms import rolled, thick_sphere_pressure, thick_tube_pressure
from embedding.bench.extremes.tables import Table, by_load, clamped, rubber, scene_of
from embedding.scene import Scene

RATIOS = (2e-1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
MODULUS, STRETCH, RADIUS = 1e5, 1.2, 0.02
SMALL = 1e-3
"""Deflections over thickness where theory is linear."""
QUICK = {
    ("inflated sphere, bending", 1e-3), ("inflated tube, membrane", 1e-7), ("pressed strip, clamped", 1e-1),
    ("pressed disc, clamped", 1e-7), ("cantilever rolled to a half circle", 1e-2),
    ("cantilever rolled to a half circle", 1e-7), ("cantilever pushed at its end", 1e-7), ("pinched ring", 1e-5),
}  # fmt: skip
"""Cells of the default tests."""
SHEAR_FACTOR = 5.0 / 6.0
"""Of the shear stiffness k G T of a plate (E. Reissner, J. Appl. Mech. 12 (1945) A69)."""


def cells() -> list[Cell]:
    """A row for each shape, load and theory, a column for each ratio."""
    found = []
    for ratio in RATIOS:
        for theory in ("membrane", "bending"):
            found += [inflated_sphere(theory, ratio), inflated_tube(theory, ratio)]
        found += [pressed_strip(ratio), pressed_disc(ratio), pressed_disc(ratio, "3d")]
        found += [rolled_strip(ratio), pushed_strip(ratio)]
        found += [pinched_ring(ratio), blown_strip(ratio)]
    order = list(dict.fromkeys(cell.row for cell in found))
    return sorted(found, key=lambda cell: order.index(cell.row))


def _cell(
    row: str, ratio: float, scene: Callable[[float], Scene], reference: Callable[[float], Mapping[str, float]],
    source: str, tolerance: float, expected: str = RIGHT, reasons: frozenset[str] = frozenset(),
) -> Cell:  # fmt: skip
    """Thin shells are off by the square of the ratio, or some part of it; meshes by ``tolerance``."""
    return Cell(
        "thickness", row, f"{ratio:.0e}", partial(scene, ratio), partial(reference, ratio) if not reasons else nothing,
        source, tolerance=max(ratio**2, tolerance), slow=(row, ratio) not in QUICK, expected=expected,
        reasons=reasons,
    )  # fmt: skip


def _told(ratio: float, least: float = 1e-2) -> str:
    """Thick walls shear and curl by more than the square of the ratio, which the error estimate says."""
    return TOLD if ratio >= least else RIGHT


# -- curved, inflated


def inflated_sphere(theory: str, ratio: float) -> Cell:
    """A balloon under the pressure that belongs to a stretch, against the thick-walled sphere."""

    def scene(ratio: float) -> Scene:
        pressure = MODULUS * thick_sphere_pressure(STRETCH, ratio)
        return _inflated({"kind": "sphere", "radius": RADIUS}, ratio, theory, pressure)

    return _cell(f"inflated sphere, {theory}", ratio, scene, _stretched, "the thick-walled sphere", 1e-6)


def inflated_tube(theory: str, ratio: float) -> Cell:
    """A long tube under the pressure that belongs to a stretch, against the thick-walled tube."""

    def scene(ratio: float) -> Scene:
        pressure = MODULUS * thick_tube_pressure(STRETCH, ratio)
        return _inflated({"kind": "infinite-cylinder", "radius": RADIUS}, ratio, theory, pressure)

    return _cell(f"inflated tube, {theory}", ratio, scene, _stretched, "the thick-walled tube", 1e-6)


def _inflated(shape: Table, ratio: float, theory: str, pressure: float) -> Scene:
    return scene_of(
        "inflated", shape, ratio * RADIUS, rubber(MODULUS),
        loads={"pressure_bottom": pressure}, path=by_load(3), model={"theory": theory},
    )  # fmt: skip


def _stretched(ratio: float) -> Mapping[str, float]:
    return {"stretch": STRETCH}


# -- flat, pressed a little


def pressed_strip(ratio: float) -> Cell:
    """A clamped strip under a small pressure, against the plate of Reissner and Mindlin in cylindrical bending:
    w = q L^4 / (384 D) + q L^2 / (8 k G T)."""

    def scene(ratio: float) -> Scene:
        pressure = 384.0 * _rigidity(ratio) * SMALL * ratio
        return scene_of(
            "pressed_strip", {"kind": "strip", "length": 1.0}, ratio, rubber(MODULUS),
            supports=clamped("x0", "x1"), loads={"pressure_bottom": pressure}, path=by_load(1),
            model={"theory": "bending"}, output={"points": {"middle": [0.5, 0.0, 0.0]}},
        )  # fmt: skip

    def reference(ratio: float) -> Mapping[str, float]:
        sheared = 48.0 * _rigidity(ratio) / (SHEAR_FACTOR * MODULUS * ratio)
        return {"u_middle_y": SMALL * ratio * (1.0 + sheared)}

    return _cell("pressed strip, clamped", ratio, scene, reference, "Reissner's plate", 5e-4, _told(ratio))


def pressed_disc(ratio: float, reduction: str = "axisymmetric") -> Cell:
    """A clamped disc under a small pressure, against Reissner and Mindlin's plate:
    w = q a^4 / (64 D) + q a^2 / (4 k G T)."""

    def scene(ratio: float) -> Scene:
        pressure = 64.0 * _rigidity(ratio) * SMALL * ratio
        return scene_of(
            "pressed_disc", {"kind": "disc", "radius": 1.0}, ratio, rubber(MODULUS),
            supports=clamped("rim"), loads={"pressure_bottom": pressure}, path=by_load(1),
            model={"theory": "bending", "reduction": reduction}, output={"points": {"middle": [0.0, 0.0, 0.0]}},
        )  # fmt: skip

    def reference(ratio: float) -> Mapping[str, float]:
        sheared = 16.0 * _rigidity(ratio) / (SHEAR_FACTOR * MODULUS * ratio)
        return {"u_middle_z": SMALL * ratio * (1.0 + sheared)}

    row = "pressed disc, clamped" + (", 3D" if reduction == "3d" else "")
    return _cell(row, ratio, scene, reference, "Reissner's plate", 1e-4, _told(ratio))


def _rigidity(thickness: float) -> float:
    """D of an incompressible plate, mu T^3 / 3."""
    return MODULUS * thickness**3 / 3.0


# -- flat, bent far


def rolled_strip(ratio: float) -> Cell:
    """A cantilever that an end moment rolls to a half circle, against Rivlin's block."""
    turn = math.pi

    def scene(ratio: float) -> Scene:
        moment = rolled(turn * ratio)[0] * MODULUS * ratio**2
        return scene_of(
            "rolled_strip", {"kind": "strip", "length": 1.0}, ratio, rubber(MODULUS),
            supports=clamped("x0"), loads={"edge_moments": [{"edge": "x1", "moment": moment}]},
            model={"theory": "bending"}, output={"points": {"tip": [1.0, 0.0, 0.0]}},
        )  # fmt: skip

    def reference(ratio: float) -> Mapping[str, float]:
        return {"u_tip_y": 2.0 * rolled(turn * ratio)[1] / turn}

    sharp = frozenset({"SHARPLY_BENT"}) if ratio == RATIOS[0] else frozenset()
    return _cell(
        "cantilever rolled to a half circle", ratio, scene, reference, "Rivlin's bent block", 1e-5,
        FAILED if sharp else _told(ratio), sharp,
    )  # fmt: skip


def pushed_strip(ratio: float) -> Cell:
    """A cantilever under a dead force across its end, F L^2 / EI = 4, against the elastica."""

    def scene(ratio: float) -> Scene:
        force = 4.0 * _rigidity(ratio)
        return scene_of(
            "pushed_strip", {"kind": "strip", "length": 1.0}, ratio, rubber(MODULUS),
            supports=clamped("x0"), loads={"edge_tractions": [{"edge": "x1", "traction": [0.0, force, 0.0]}]},
            model={"theory": "bending"}, output={"points": {"tip": [1.0, 0.0, 0.0]}},
        )  # fmt: skip

    def reference(ratio: float) -> Mapping[str, float]:
        return {"u_tip_y": 0.6699642, "u_tip_x": -0.3289450}

    hidden = frozenset({"TOO_THIN"}) if ratio == RATIOS[-1] else frozenset()
    return _cell(
        "cantilever pushed at its end", ratio, scene, reference, "the elastica", 2e-5,
        FAILED if hidden else _told(ratio), hidden,
    )  # fmt: skip


def pinched_ring(ratio: float) -> Cell:
    """A ring pinched a little by two forces, against the curved bar of Winkler with shear and hoop force."""

    def scene(ratio: float) -> Scene:
        force = SMALL * ratio * _rigidity(ratio)
        return scene_of(
            "pinched_ring", {"kind": "infinite-cylinder", "radius": 1.0}, ratio, rubber(MODULUS),
            loads={"point_loads": [{"at": [1.0, 0.0, 0.0], "force": [-force, 0.0, 0.0]},
                                   {"at": [-1.0, 0.0, 0.0], "force": [force, 0.0, 0.0]}]},
            path=by_load(1), model={"theory": "bending"}, output={"points": {"side": [1.0, 0.0, 0.0]}},
        )  # fmt: skip

    def reference(ratio: float) -> Mapping[str, float]:
        return {"u_side_x": -0.5 * SMALL * ratio * (math.pi / 4.0 - 2.0 / math.pi)}

    known = RIGHT if ratio >= 1e-5 else TOLD
    return _cell("pinched ring", ratio, scene, reference, "the inextensible ring", 1e-4, known)


def blown_strip(ratio: float) -> Cell:
    """A strip of membrane between two pins, blown up to a half circle: N = T mu (l - l^-3) = p r with l = pi / 2."""

    def scene(ratio: float) -> Scene:
        stretch = math.pi / 2.0
        pressure = 2.0 * ratio * MODULUS * (stretch - stretch**-3)
        return scene_of(
            "blown_strip", {"kind": "strip", "length": 1.0}, ratio, rubber(MODULUS),
            supports=[{"where": edge, "kind": "pinned"} for edge in ("x0", "x1")],
            loads={"pressure_bottom": pressure}, model={"theory": "membrane"},
            output={"points": {"middle": [0.5, 0.0, 0.0]}},
        )  # fmt: skip

    def reference(ratio: float) -> Mapping[str, float]:
        return {"u_middle_y": 0.5, "stretch": math.pi / 2.0}

    return _cell("strip blown to a half circle, membrane", ratio, scene, reference, "the circle", 2e-4)
