"""`embedding fit`: a material on standard output, a picture beside it, and one message for what is wrong."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from problems import treloar
from tests.cli.conftest import Outcome

Call = Callable[..., Outcome]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_material_for_a_scene_file(folder: Path, call: Call) -> None:
    outcome = call("fit", treloar.DATA, "--law", "ogden", "--terms", 3, "--relative", "--picture", "fit.png")
    assert outcome.code == 0
    material = tomllib.loads(outcome.out)["shell"]["material"]
    assert material["law"] == "ogden"
    assert material["moduli"] == pytest.approx(treloar.fitted().material.moduli, rel=1e-7)  # type: ignore[union-attr]
    assert "# uniaxial: 25 points, rms 155.6" in outcome.out
    assert "largest relative error 10.3 %" in outcome.out
    assert "# exponents.0 = 1.30864 +- 0.11\n" in outcome.out
    assert "warning" not in outcome.out
    pixels = imread(folder / "fit.png")[:, :, :3]
    assert pixels.shape[:2] == (832, 1280)
    for colour in ("c8553d", "2f6690"):  # both kinds of test are there
        wanted = np.array([int(colour[i : i + 2], 16) for i in (0, 2, 4)]) / 255
        assert (np.abs(pixels - wanted).max(axis=2) < 0.02).sum() > 1000


def test_as_json_with_a_warning(folder: Path, call: Call) -> None:
    outcome = call("fit", treloar.DATA, "--law", "mooney-rivlin", "--json")
    found = json.loads(outcome.out)
    assert found["material"]["law"] == "mooney-rivlin"
    assert [parameter["name"] for parameter in found["parameters"]] == ["c1", "c2"]
    assert [error["mode"] for error in found["errors"]] == ["uniaxial", "equibiaxial"]
    assert found["doubts"][0]["parameter"] == "c2"
    assert "# warning: c2 lies on the limit" in call("fit", treloar.DATA, "--law", "mooney-rivlin").out


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (("none.csv", "--law", "ogden"), "none.csv: there is no such file"),
        ((treloar.DATA, "--law", "ogdn"), 'did you mean "ogden"?'),
        ((treloar.DATA, "--law", "ogden", "--terms", "9"), "terms: 9 is not allowed"),
        ((treloar.DATA,), "--law"),
        ((treloar.DATA, "--law", "gent", "--picture", "fit.jpg"), "--picture: 'fit.jpg' must end in '.png'"),
    ],
)
def test_bad_words(folder: Path, call: Call, words: tuple[object, ...], part: str) -> None:
    outcome = call("fit", *words)
    assert outcome.code == 2
    assert outcome.out == ""
    assert outcome.err.startswith("error: ")
    assert part in outcome.err
    assert list(folder.iterdir()) == []
