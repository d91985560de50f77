"""Mirror planes in a field: what is its own image up to the sign of the potential, and what is not."""

from __future__ import annotations

from typing import Any

import pytest

from embedding import Scene, explain
from tests.scene.samples import MATERIAL

R = 0.02
SPHERE: dict[str, Any] = {"kind": "sphere", "radius": R}
TUBE = {"kind": "infinite-cylinder", "radius": R}
SOFT = {"relative_permeability": 10.0}
BALL = {"kind": "sphere", "centre": [0, 0, 3 * R], "radius": R / 2}
FLOOR = {"kind": "half-space", "level": -2 * R, "voltage": 1.0}


def planes(ambient: dict[str, Any], shape: Any = SPHERE, faces: Any = None, **of_shell: Any) -> tuple[str, str]:
    """Names of the mirror planes of a scene in 3D (or plane strain), and of those with an odd potential."""
    body = {"shape": shape, "thickness": 1e-3, "material": MATERIAL} | of_shell
    reduction = "3d" if shape is SPHERE else "plane-strain"
    plan = explain(Scene(shell=body, ambient=ambient, faces=faces or {}, model={"reduction": reduction}))
    return "".join(plan.reduction.planes), "".join(plan.odd_planes)


def magnetic(expected: tuple[str, str], shape: Any = SPHERE, remanence: Any = None, **ambient: Any) -> Any:
    of_shell = SOFT if remanence is None else {"remanence": remanence}
    return expected, {"ambient": {"field": "magnetic"} | ambient, "shape": shape} | of_shell


def electric(expected: tuple[str, str], faces: Any = None, **ambient: Any) -> Any:
    return expected, {"ambient": {"field": "electric"} | ambient, "faces": faces, "relative_permittivity": 3.0}


@pytest.mark.parametrize(
    ("expected", "parts"),
    [
        magnetic(("xyz", "")),
        magnetic(("xyz", "z"), applied_field=[0, 0, 1]),
        magnetic(("z", ""), applied_field=[1, 1, 0]),
        # a uniform magnetisation is odd across its direction, and so is the potential
        magnetic(("xyz", "z"), remanence=[0, 0, 1]),
        magnetic(("xyz", "z"), remanence=[0, 0, 1], applied_field=[0, 0, -5]),
        magnetic(("y", ""), remanence=[0, 0, 1], applied_field=[1, 0, 0]),
        # one that points outwards everywhere is its own image, one that turns around an axis the opposite of it
        magnetic(("xyz", ""), remanence={"expression": ["x", "y", "z"]}),
        magnetic(("xyz", "xy"), remanence={"expression": ["-y", "x", "0"]}),
        magnetic(("yz", ""), remanence={"expression": ["1 + x", "0", "0"]}),
        magnetic(("xy", ""), remanence={"expression": ["x", "y", "z"]}, applied_field=[0, 0, 1]),
        # fields in space
        magnetic(("xyz", ""), applied_field={"expression": ["x", "y", "-2*z"]}),
        magnetic(("xyz", "xz"), applied_field={"expression": ["z", "0", "x"]}),
        magnetic(("xy", ""), applied_field={"expression": ["-x/2", "-y/2", "1 + z"]}),
        # undefined where no shell is, on one side only
        magnetic(("xy", ""), applied_field={"expression": ["0", "0", "sqrt(0.025 + z)"]}),
        magnetic(("", ""), line_currents=[{"through": [0, 0, 1], "along": [1, 0, 0], "current": 1}]),
        # bodies beside the shell
        magnetic(("xy", ""), bodies=[BALL | SOFT]),
        magnetic(("xyz", ""), bodies=[BALL | SOFT | {"centre": [0, 0, 0], "radius": R / 2}]),
        magnetic(("xy", ""), bodies=[BALL | SOFT, BALL | SOFT | {"centre": [0, 0, -3 * R]}]),
        magnetic(("x", ""), bodies=[BALL | SOFT | {"centre": [0, R, 3 * R]}]),
        magnetic(("xy", ""), bodies=[BALL | {"remanence": [0, 0, 1]}]),
        magnetic(("xy", "x"), bodies=[BALL | {"remanence": [1, 0, 0]}]),
        magnetic(("y", ""), bodies=[BALL | {"remanence": [1, 0, 0]}], applied_field=[0, 0, 1]),
        magnetic(("xy", ""), shape=TUBE, bodies=[{"kind": "sphere", "centre": [0, 0, 9], "radius": R / 2} | SOFT]),
        magnetic(("", ""), shape=TUBE, bodies=[{"kind": "half-space", "level": -2 * R, "potential": 0.0}]),
        magnetic(("xy", "x"), shape=TUBE, remanence=[1, 0, 0]),
        # conductors are even, unless they are neutral or at zero
        electric(("xyz", "z"), applied_field=[0, 0, 1], faces={"both": {"charge": 0}}),
        electric(("xyz", "z"), applied_field=[0, 0, 1], faces={"both": {"voltage": 0}}),
        electric(("xy", ""), applied_field=[0, 0, 1], faces={"both": {"charge": 1e-9}}),
        electric(("xyz", ""), faces={"top": {"voltage": 1}, "bottom": {"charge": 0}}),
        electric(("xy", ""), bodies=[FLOOR]),
        electric(("y", ""), bodies=[FLOOR], applied_field=[1, 0, 0]),
        electric(("xy", "x"), bodies=[FLOOR | {"voltage": 0}], applied_field=[1, 0, 0]),
    ],
)
def test_mirror_planes(expected: tuple[str, str], parts: dict[str, Any]) -> None:
    assert planes(**parts) == expected
