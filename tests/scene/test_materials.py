"""Messages about materials, their spellings in a file, and their shear moduli."""

# ruff: noqa: E501 - one case per line, with the whole message

from __future__ import annotations

from typing import Any

import pytest

from embedding.scene import Gent, Ogden, Scene, StrainEnergy, StVenantKirchhoff, Yeoh
from tests.scene.samples import refusals, shell


@pytest.mark.parametrize(
    ("build", "line"),
    [
        (lambda: Yeoh(c1=1, c2=-2, c3=1), "c2: -2.0 Pa is not allowed: must be greater than -sqrt(3 c1 c3) = -1.73205 Pa, or dW/dI1 becomes negative"),
        (lambda: Yeoh(c1=1, c2=-1, c3=0), "c2: -1.0 Pa is not allowed: must be greater than -sqrt(3 c1 c3) = -0 Pa, or dW/dI1 becomes negative"),
        (lambda: Yeoh(c1=1, c2=0, c3="-1 kPa"), "c3: -1 kPa is not allowed: must be at least 0"),
        (lambda: Gent(shear_modulus=1, limit="97 %"), "limit: 97 % is not allowed: must be a number greater than 0"),
        (lambda: Ogden(moduli=1, exponents=[2]), "moduli: 1 is not allowed: must be a list of one number a term"),
        (lambda: Ogden(moduli=[], exponents=[2]), "moduli: [] is not allowed: must be a list of one number a term"),
        (lambda: Ogden(moduli=[1, "2 m"], exponents=[2, 1]), 'moduli.1: 2 m is not allowed: "m" is a unit of length: must be a pressure, such as "100 kPa"'),
        (lambda: Ogden(moduli=[1], exponents=[0]), "exponents.0: 0 is not allowed: must not be 0"),
        (lambda: Ogden(moduli=[1], exponents=["2 m"]), "exponents.0: 2 m is not allowed: must be a number"),
        (lambda: Ogden(moduli=[1], exponents=[2, 3]), "exponents: [2.0, 3.0] is not allowed: must hold as many numbers as moduli, 1"),
        (lambda: Ogden(moduli=[1, 2], exponents=[2, -3]), "moduli: [1.0, 2.0] is not allowed: the shear modulus, half the sum of moduli times exponents, is -2 Pa and must be positive"),
        (lambda: StVenantKirchhoff(youngs_modulus="2 GPa", poisson_ratio=0.6), "poisson_ratio: 0.6 is not allowed: must be greater than -1 and at most 0.5"),
        (lambda: StVenantKirchhoff(youngs_modulus="2 GPa", poisson_ratio=-1), "poisson_ratio: -1 is not allowed: must be greater than -1 and at most 0.5"),
        (lambda: StrainEnergy(expression="x", unit="kPa"), 'expression: x is not allowed: unknown name "x": known are I1, I2, pi, sin, cos, exp, log, sqrt, tanh'),
        (lambda: StrainEnergy(expression=3.0, unit="kPa"), "expression: 3.0 is not allowed: must be text"),
        (lambda: StrainEnergy(expression="I1", unit="mm"), 'unit: mm is not allowed: "mm" is a unit of length: must be a unit of pressure, such as kPa'),
        (lambda: StrainEnergy(expression="-I1"), "expression: -I1 is not allowed: the shear modulus at rest, 2 (dW/dI1 + dW/dI2) at I1 = I2 = 3, is -2 Pa and must be positive"),
        (lambda: StrainEnergy(expression="log(I1 - 3)"), "expression: log(I1 - 3) is not allowed: the shear modulus at rest, 2 (dW/dI1 + dW/dI2) at I1 = I2 = 3, is nan Pa and must be positive"),
        (lambda: StrainEnergy(expression="exp(1e9*I1)"), "expression: exp(1e9*I1) is not allowed: the shear modulus at rest, 2 (dW/dI1 + dW/dI2) at I1 = I2 = 3, is nan Pa and must be positive"),
    ],
)  # fmt: skip
def test_a_material(build: Any, line: str) -> None:
    assert refusals(build) == [line]


def test_shear_moduli() -> None:
    assert Yeoh(c1=1, c2=-0.1, c3=0.1).shear_modulus == 2.0
    assert Ogden(moduli=("0.63 MPa", 1200, -1e4), exponents=(1.3, 5, -2)).shear_modulus == pytest.approx(422500)
    assert StrainEnergy(expression="(I1 - 3)**2 + 3*I1/4 + 3*log(I2)", unit="kPa").shear_modulus == 3500.0
    assert StVenantKirchhoff(youngs_modulus=3, poisson_ratio=0.5).shear_modulus == 1.0


@pytest.mark.parametrize(
    "material",
    [
        {"law": "yeoh", "c1": "0.2 MPa", "c2": -2e3, "c3": 50},
        {"law": "gent", "shear_modulus": "0.4 MPa", "limit": 97.2},
        {"law": "ogden", "moduli": ["0.63 MPa", "1.2 kPa", -1e4], "exponents": [1.3, 5, -2]},
        {"law": "st-venant-kirchhoff", "youngs_modulus": "210 GPa", "poisson_ratio": 0.3},
        {"law": "strain-energy", "expression": "3*I1 + log(I2)/2", "unit": "kPa"},
    ],
    ids=lambda material: str(material["law"]),
)
def test_a_file_and_back(material: dict[str, Any]) -> None:
    scene = Scene(name="sheet", shell=shell(material=material))
    assert Scene.from_toml(scene.to_toml()) == scene


def test_a_wrong_material_hides_no_other_problem() -> None:
    material = {"law": "ogden", "moduli": [1, "x"], "exponents": [2]}
    lines = refusals(lambda: Scene(name="sheet", shell=shell(thickness=-1, material=material)))
    assert [line.partition(":")[0] for line in lines] == ["shell.thickness", "shell.material.moduli.1"]
