"""Each problem as a script: it prints what it found beside the reference, and leaves an archive behind."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

from embedding import open_archive
from problems import plate_squeeze

FOLDER = Path(plate_squeeze.__file__).parent
SCRIPTS = ("plate_traction", "uniaxial_tension", "plate_squeeze", "cylinder_inflation", "open_tube", "dielectric_film",
           "dielectric_film_held", "charged_disc", "sphere_in_field", "magnetised_disc", "hard_magnetic_ring",
           "inflated_in_a_field", "cantilever_shear", "cantilever_moment", "t_cantilever", "cap_snap_through",
           "torus_inflation")  # fmt: skip
LONG = ("charged_balloon", "dielectric_balloon", "dielectric_tube", "capacitances", "permeable_sphere",
        "permeable_cylinder", "permeable_disc", "magnetised_sphere", "hard_magnetic_cantilever", "circular_membrane",
        "membrane_pull_in", "plate_pull_in", "sphere_inflation", "varying_pressure_sphere", "grounded_balloon",
        "turned_in_a_field", "hinged_roof")  # fmt: skip
"""Several solves each, which their own tests do as well."""


@pytest.mark.estimated
@pytest.mark.parametrize("name", [*SCRIPTS, *(pytest.param(name, marks=pytest.mark.slow) for name in LONG)])
def test_script(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(FOLDER / f"{name}.py"), run_name="__main__")
    out = capsys.readouterr().out
    assert "e-" in out, "an error as a number"
    assert out.endswith(f"archive: {name}.vtkhdf; a picture of it: embedding plot {name}.vtkhdf\n")
    archive = open_archive(f"{name}.vtkhdf")
    assert archive.result.name == "CONVERGED"
    assert archive.scene_object().name == name
