"""Scenes as Python objects: immutable, comparable, picklable, validated; the errors and the scales."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
from math import sqrt

import pytest
from pydantic import ValidationError

import embedding.scene
from embedding.errors import ArchiveError, EmbeddingError, Problem, SceneError, SolveError
from embedding.scene import EPSILON_0, MU_0, Scales, Scene, Shell, Sphere
from tests.scene.samples import refusals, scene


def test_scenes_do_not_change() -> None:
    built = scene()
    with pytest.raises(ValidationError, match="frozen"):
        built.name = "other"
    with pytest.raises(ValidationError, match="frozen"):
        built.shell.thickness = 1.0
    with pytest.raises(AttributeError):
        built.path.append(1)  # type: ignore[attr-defined]
    assert built == scene() and hash(built) == hash(scene())
    assert built != scene("disc")


def test_copies() -> None:
    built = scene("infinite-cylinder", path=[{"volume_ratio": 2.0}])
    assert pickle.loads(pickle.dumps(built)) == built
    assert copy.deepcopy(built) == copy.copy(built) == built
    assert built.model_copy(update={"name": "b"}).name == "b"
    assert refusals(lambda: built.shell.model_copy(update={"thickness": 0})) == [
        "thickness: 0 m is not allowed: must be greater than 0"
    ]
    assert refusals(lambda: built.model_copy(update={"nmae": "b"})) == [
        'nmae: unknown key: did you mean "name"?'
    ]


def test_objects_and_tables_may_be_mixed() -> None:
    built = Scene(
        shell=Shell(
            shape=Sphere(radius="2 cm"), thickness=2e-4, material={"law": "neo-hookean", "shear_modulus": 1e5}
        )
    )
    assert built == scene()


def test_errors() -> None:
    single = SceneError([Problem("a.b", "wrong")], "file")
    assert str(single) == "file: a.b: wrong"
    assert str(SceneError([Problem("", "wrong")])) == "wrong"
    assert str(SceneError([Problem("a", "x"), Problem("b", "y")])) == "scene: 2 problems\n  a: x\n  b: y"
    again = pickle.loads(pickle.dumps(single))
    assert (str(again), again.problems, again.source) == (str(single), single.problems, "file")
    stopped = SolveError("stopped", solution=3)
    assert (str(stopped), stopped.solution, stopped.exit_code) == ("stopped", 3, 3)
    assert pickle.loads(pickle.dumps(stopped)).solution == 3
    assert (str(ArchiveError("not ours")), ArchiveError.exit_code) == ("not ours", 2)
    assert all(issubclass(error, EmbeddingError) for error in (SceneError, ArchiveError, SolveError))
    assert EmbeddingError.exit_code == 1


@pytest.mark.parametrize("shape", ["plate", "disc", "sphere", "infinite-cylinder"])
def test_scales_follow_from_three(shape: str) -> None:
    scales = Scales.of(scene(shape))
    assert scales == Scales(0.1 if shape == "plate" else 0.02, 1e5, EPSILON_0)
    assert scales.volume * scales.stress == pytest.approx(scales.energy, rel=1e-15)
    assert scales.force == pytest.approx(scales.line_force * scales.length)
    assert scales.force_density * scales.volume == pytest.approx(scales.force)
    assert scales.potential == pytest.approx(scales.length * sqrt(scales.stress / EPSILON_0))
    assert scales.flux_density * scales.field == pytest.approx(scales.stress)
    assert scales.charge * scales.potential == pytest.approx(scales.energy)
    assert scales.area == scales.length**2


def test_magnetic_scales() -> None:
    magnetic = scene(ambient={"field": "magnetic"}, of_shell={"relative_permeability": 5})
    assert Scales.of(magnetic).permittivity == MU_0


def test_public_names_exist() -> None:
    assert all(hasattr(embedding.scene, name) for name in embedding.scene.__all__)


def test_import_is_light() -> None:
    """The door must open without the solver and without the unit library."""
    heavy = ("ngsolve", "pint", "numpy", "h5py")
    code = f"import embedding.scene, sys; print([name for name in {heavy} if name in sys.modules])"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout.strip() == "[]"
