"""Shells of several thicknesses and materials: strips in series, where every piece stretches on its own."""

# ruff: noqa: E501 - one message per line

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from netgen.occ import Glue, WorkPlane
from ngsolve import CF, Integrate

from embedding import Scene, explain, solve
from embedding.shell.kinematics import Kinematics
from embedding.shell.laws import KoiterLaw, MooneyRivlinLaw, PiecewiseLaw, piecewise
from embedding.solving.problem import Problem
from problems.common import Array, Positions
from tests.scene.samples import refusals

LENGTHS = {"left": 30.0, "middle": 20.0, "right": 50.0}
"""In mm, along x; 40 mm wide."""


@pytest.fixture
def bands(tmp_path: Path) -> str:
    """A file with three bands side by side, and the outer edges x0, x1 and the sides."""
    faces, start = [], 0.0
    for length in LENGTHS.values():
        faces.append(WorkPlane().MoveTo(start, 0).Rectangle(length, 40).Face())
        start += length
    glued = Glue(faces)
    for face, name in zip(sorted(glued.faces, key=lambda f: f.center.x), LENGTHS, strict=True):
        face.name = name
    for edge in glued.edges:
        name = {0.0: "x0", 100.0: "x1"}.get(round(edge.center.x, 9))
        edge.name = name or ("side" if edge.center.y in (0.0, 40.0) else "seam")
    file = tmp_path / "bands.step"
    glued.WriteStep(str(file))
    return str(file)


def sheet(file: str, material: dict[str, Any], regions: list[dict[str, Any]], **parts: Any) -> Scene:
    """The bands pulled along x in plane strain: y and z are held everywhere."""
    shell = {"shape": {"kind": "file", "path": file}, "thickness": "1 mm", "material": material, "regions": regions}
    shell["density"] = 1000.0
    held = [{"where": "surface", "fix": ["y", "z"]}, {"where": "x0", "fix": ["x"]}]
    return Scene(shell=shell, supports=held, discretisation={"order": 2, "shell_size": "15 mm"}, **parts)


def moved_along_x(scene: Scene) -> tuple[Array, Array]:
    places = Positions()
    solve(scene, listeners=[places])
    return places.reference[:, 0], (places.deformed - places.reference)[:, 0]


def piecewise_linear(x: Array, stretches: tuple[float, ...]) -> Array:
    """Displacement where each band has a stretch of its own."""
    ends = np.cumsum([0.0, *LENGTHS.values()]) * 1e-3
    values = np.cumsum([0.0, *(length * 1e-3 * (s - 1) for length, s in zip(LENGTHS.values(), stretches, strict=True))])
    return np.interp(x, ends, values)


def pulled(force: float) -> dict[str, Any]:
    return {"edge_tractions": [{"edge": "x1", "traction": [force, 0, 0]}]}


def test_bands_of_rubber(bands: str) -> None:
    """mu T (l - l^-3) = t in neo-Hookean bands; 2 (c1 + c2) T (l - l^-3) = t of Mooney-Rivlin in plane strain.

    The stretches 1.2, 1.5 and 2 are chosen, thickness and moduli follow.
    """
    force, modulus = 100.0, 1e5

    def share(stretch: float) -> float:
        return force / (stretch - stretch**-3)

    left, middle, right = (share(s) for s in (1.2, 1.5, 2.0))
    scene = sheet(
        bands,
        {"law": "neo-hookean", "shear_modulus": left / 1e-3},
        [
            {"faces": ["middle"], "thickness": middle / modulus, "material": rubber(modulus)},
            {"faces": ["right"], "material": {"law": "mooney-rivlin", "c1": right / 4e-3, "c2": right / 4e-3}},
        ],
        loads=pulled(force),
    )
    x, u = moved_along_x(scene)
    assert np.abs(u - piecewise_linear(x, (1.2, 1.5, 2.0))).max() < 1e-11


def rubber(modulus: float) -> dict[str, Any]:
    return {"law": "neo-hookean", "shear_modulus": modulus}


def test_bands_of_metal(bands: str) -> None:
    """St Venant-Kirchhoff in plane strain: Y / (1 - nu^2) T l (l^2 - 1) / 2 = t."""
    force, poissons, stretches = 1e4, (0.3, 0.2, 0.0), (1.001, 1.002, 1.004)
    moduli = [force / 1e-3 * 2 * (1 - nu**2) / (s * (s * s - 1)) for nu, s in zip(poissons, stretches, strict=True)]
    tables = [
        {"law": "st-venant-kirchhoff", "youngs_modulus": y, "poisson_ratio": nu}
        for y, nu in zip(moduli, poissons, strict=True)
    ]
    regions = [{"faces": [name], "material": m} for name, m in zip(("middle", "right"), tables[1:], strict=True)]
    x, u = moved_along_x(sheet(bands, tables[0], regions, loads=pulled(force)))
    assert np.abs(u - piecewise_linear(x, stretches)).max() < 1e-12


def test_weight_thickness_and_volume_of_regions(bands: str) -> None:
    """Totals over the bands: volume, and the weight with a density of its own on the right."""
    shell_regions = [
        {"faces": ["left", "middle"], "thickness": {"expression": "1 + 10*x", "unit": "mm"}},
        {"faces": ["right"], "density": 3000.0},
    ]
    scene = sheet(bands, rubber(1e5), shell_regions, loads={"gravity": [10, 0, 0]})
    made = Problem(scene, explain(scene))
    physics, scales = made.system.physics, made.scales
    volume = made.domain.shell_integral(physics.thickness) * scales.volume
    thick = 0.04 * (0.05 + 10 * 0.05**2 / 2) * 1e-3
    assert volume == pytest.approx(thick + 0.04 * 0.05 * 1e-3, rel=1e-12)
    weight = made.domain.shell_integral(physics.thickness * physics.loads.body_force[0]) * scales.force
    assert weight == pytest.approx(1e4 * thick + 3e4 * 0.04 * 0.05 * 1e-3, rel=1e-12)


def test_a_held_face(bands: str) -> None:
    """The middle is glued down: only the right band stretches, t = mu T (l - l^-3)."""
    scene = sheet(bands, rubber(1e5), [], loads=pulled(1e-3 * 1e5 * (2 - 1 / 8)))
    glued = [*scene.supports[:1], {"where": "middle", "fix": ["x"]}, {"where": "left", "fix": ["x"]}]
    x, u = moved_along_x(scene.model_copy(update={"supports": glued}))
    assert np.abs(u - piecewise_linear(x, (1.0, 1.0, 2.0))).max() < 1e-12


def test_what_a_law_in_pieces_tells(bands: str) -> None:
    """Stresses and bending moduli of each region at rest and at the stretches 2 and 1.5."""
    modulus = {"left": 1e5, "middle": 3e5, "right": 2e5}
    softer = {"law": "mooney-rivlin", "c1": 0.75e5, "c2": 0.25e5}
    regions = [{"faces": ["middle"], "material": rubber(3e5)}, {"faces": ["right"], "material": softer}]
    scene = sheet(bands, rubber(1e5), regions)
    made = Problem(scene, explain(scene))
    law, domain = made.system.physics.law, made.domain
    assert isinstance(law, PiecewiseLaw)
    rest = Kinematics(domain.reduction, domain.normal, made.system.unknowns.field("u"))
    at_rest, stress = law.bending_modulus(rest), law.principal_stresses(CF(2.0), CF(1.5))[0]
    for name, value in modulus.items():
        region = domain.face(name)
        area = Integrate(CF(1.0), made.mesh, definedon=region)
        c2 = 0.25e5 if name == "right" else 0.0
        exact = 2 * ((value / 2 - c2) + c2 * 1.5**2) * (4 - 1 / 9)
        assert Integrate(at_rest, made.mesh, definedon=region) * 1e5 == pytest.approx(value * area)
        assert Integrate(stress, made.mesh, definedon=region) * 1e5 == pytest.approx(exact * area)
    with pytest.raises(TypeError, match="small strains"):
        piecewise(CF(1.0), MooneyRivlinLaw(1.0), KoiterLaw(1.0, 0.3))


@pytest.mark.parametrize(
    ("regions", "line"),
    [
        ([{"faces": ["centre"], "density": 1}], 'shell.regions.0.faces.0: "centre" is not allowed: must be "left", "middle" or "right"'),
        ([{"faces": ["left"], "density": 1}, {"faces": ["right", "left"], "density": 2}], 'shell.regions.1.faces.1: "left" is not allowed: it is part of another region'),
        ([{"faces": []}], 'shell.regions.0.faces: [] is not allowed: must be a list of different names of faces, such as ["web"]'),
        (
            [{"faces": ["left"]}],
            "shell.regions.0.faces: [left] is not allowed: a region needs a thickness, a material or another property of"
            " its own",
        ),
        ([{"faces": ["left"], "thickness": {"expression": "x - 0.01"}}], "shell.regions.0.thickness.expression: x - 0.01 is not allowed: must be greater than 0, and is -0.01 m at x = 0 m, y = 0 m, z = 0 m"),
        ([{"faces": ["left"], "material": {"law": "st-venant-kirchhoff", "youngs_modulus": 1e9, "poisson_ratio": 0.3}}], 'shell.regions.0.material.law: "st-venant-kirchhoff" is not allowed beside "neo-hookean": incompressible laws and st-venant-kirchhoff cannot be mixed in one shell'),
    ],
)  # fmt: skip
def test_refusals(bands: str, regions: list[dict[str, Any]], line: str) -> None:
    found = refusals(lambda: sheet(bands, rubber(1e5), regions))
    assert found == [line]
