"""Fields by name: every one against its definition, through a solve into an archive and back, and refusals."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from embedding import InfiniteCylinder, Loads, NeoHookean, Output, Scene, Shell, Sphere, Stage, open_archive, solve
from embedding.scene.output import parsed
from embedding.scene.quantities import QUANTITIES
from embedding.shell.laws import MooneyRivlinLaw
from embedding.solving.outputs import ALONE, IN_BOTH, Shown, quantity
from tests.scene.samples import refusals, scene
from tests.shell.bodies import CASES, THICKNESS, meshed
from tests.shell.test_tables import distance

pytestmark = pytest.mark.usefixtures("unestimated")

PLACE = 0.3
OF_STRESS = {"stress", "stress_nn", "pressure_3d", "hydrostatic_pressure"}
EVERY = tuple(f"{name}@{PLACE}" if entry.place else name for name, entry in QUANTITIES.items())
FIRST, SECOND = 2e-4, 3e-2
"""Errors of the meshes below in first and second derivatives (test_tables has their orders)."""


@pytest.mark.parametrize("case", ["twisted tube", "sphere", "disc", "meridian", "ring"])
def test_every_name_has_its_meaning(case: str) -> None:
    """The named quantity is the one that the definitions give, in numpy, from the formula of the deformation."""
    body = meshed(CASES[case], 0.2 if case in ("meridian", "ring") else 0.3, 4)
    coordinates = CASES[case].coordinates
    assert coordinates is not None
    shown = Shown.of(body.derivatives, coordinates, THICKNESS, MooneyRivlinLaw(0.5), (0.0, 0.0))
    exact = CASES[case].shell().quantities(body.p, body.q, PLACE)
    for face, place in (("top", 0.5), ("bottom", -0.5)):
        exact[f"{face}_stretch"] = CASES[case].shell().quantities(body.p, body.q, place)["layer_stretch"]
    assert set(exact) == set(QUANTITIES) - OF_STRESS
    for name, values in exact.items():
        entry = QUANTITIES[name]
        found = body(quantity(f"{name}@{PLACE}" if entry.place else name, shown))
        assert distance(found, values) < (SECOND if entry.bends else FIRST), name


def test_every_name_is_made() -> None:
    both = {f"{name}_{c}" for name in IN_BOTH for c in ("reference", "deformed")}
    assert both | set(ALONE) == set(QUANTITIES)


def test_the_page_lists_every_name() -> None:
    """Names with both configurations appear once, without the suffix."""
    page = (Path(__file__).parents[2] / "docs" / "fields.md").read_text()
    listed = set(re.findall(r"`([a-z0-9_]+)(?:@)?`", page))
    assert set(IN_BOTH) | set(ALONE) <= listed


def inflated(shape: Any, **parts: Any) -> Scene:
    """A balloon or a tube, blown up a little."""
    shell = Shell(shape=shape, thickness=1e-3, material=NeoHookean(shear_modulus=1e5))
    return Scene(shell=shell, loads=Loads(pressure_top=100.0, pressure_bottom=1e3), path=(Stage(steps=1),), **parts)


@pytest.mark.parametrize("reduction", ["axisymmetric", "3d", "plane-strain"])
def test_through_an_archive_and_back(reduction: str, tmp_path: Path) -> None:
    """All names at once, on a shell with an axis or poles too: finite, in SI units, and right where it is known."""
    shape = InfiniteCylinder(radius=0.02) if reduction == "plane-strain" else Sphere(radius=0.02)
    model, output = {"reduction": reduction}, Output(fields=EVERY)
    solution = solve(inflated(shape, model=model, output=output), archive=tmp_path / "run.vtkhdf")
    block = open_archive(tmp_path / "run.vtkhdf").block("shell")
    assert set(EVERY) <= set(block.fields)
    for name in EVERY:
        values = block.field(name)
        assert block.units[name] == QUANTITIES[parsed(name)[0]].unit
        assert np.isfinite(values).all(), name
    stretch = float(solution["stretch"][-1])
    curvature = -1 / (0.02 * stretch * (2 if reduction == "plane-strain" else 1))
    found = block.field("mean_curvature_deformed")
    assert found.mean() == pytest.approx(curvature, rel=0.05)  # the curvature of a coarse cubic mesh
    assert block.field("stress_nn@0.3") == pytest.approx(-550.0 + 0.3 * 900.0, rel=1e-6)
    normal, stress = block.field("normal"), block.field("stress@0.3").reshape(-1, 3, 3)
    assert np.einsum("ni,nij,nj->n", normal, stress, normal) == pytest.approx(-280.0, rel=2e-2)
    assert block.field("projector_deformed").reshape(-1, 3, 3) == pytest.approx(
        np.eye(3) - np.einsum("ni,nj->nij", normal, normal), abs=2e-2
    )


def test_viewers_find_nine_components(tmp_path: Path) -> None:
    solve(inflated(Sphere(radius=0.02), output=Output(fields=("curvature_deformed",))), archive=tmp_path / "a.vtkhdf")
    with h5py.File(tmp_path / "a.vtkhdf") as file:
        data = file["VTKHDF/shell/PointData/curvature_deformed"]
        assert data.shape[1:] == (9,)
    pyvista = pytest.importorskip("pyvista")
    grid = pyvista.read(tmp_path / "a.shell.vtkhdf")
    assert grid.point_data["curvature_deformed"].shape[1] == 9


def test_through_toml() -> None:
    asked = scene(output={"fields": ["shifter_deformed@0.5"], "coordinates": "spherical", "direction": [0, 0, 1]})
    assert Scene.from_toml(asked.to_toml()) == asked


@pytest.mark.parametrize(
    ("field", "reason"),
    [
        ("mean_curvatur_deformed", 'did you mean "mean_curvature_deformed"? docs/fields.md lists all names'),
        ("colour", "no such field; docs/fields.md lists all names"),
        ("christoffel_reference@0.5", 'does not depend on the place in the thickness: write "christoffel_reference"'),
        ("stress", "must name a place in the thickness from -0.5 to 0.5"),
        ("stress@0.6", "must name a place in the thickness from -0.5 to 0.5"),
        ("stress@top", "must name a place in the thickness from -0.5 to 0.5"),
        (7, "must be the name of a field"),
    ],
)
def test_refused_names(field: Any, reason: str) -> None:
    (line,) = refusals(lambda: scene(output={"fields": ["normal_deformed", field]}))
    assert line.startswith("output.fields.1: ")
    assert reason in line


def test_refused_combinations() -> None:
    (line,) = refusals(lambda: scene(output={"fields": ["christoffel_deformed"]}, discretisation={"order": 1}))
    assert "output.fields.0" in line
    assert "discretisation.order must be at least 2" in line
    stiff = {"law": "st-venant-kirchhoff", "youngs_modulus": 1e9, "poisson_ratio": 0.3}
    (line,) = refusals(lambda: scene(of_shell={"material": stiff}, output={"fields": ["pressure_3d@0"]}))
    assert "compressible" in line
    assert refusals(lambda: scene(output={"fields": ["stress@0", "stress@0"]}))
    assert refusals(lambda: scene(output={"direction": [0, 0, 0]}))
