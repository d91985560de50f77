"""Fits: laws come back from their own stresses, uncertainties are honest, and what the data leave open is said."""

# ruff: noqa: E501 - one case per line, with the whole message

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from embedding import Gent, MooneyRivlin, NeoHookean, Ogden, Yeoh
from embedding.fit import MODES, FitError, Measurements, fit_law, nominal_stress
from embedding.shell.laws import law_of

MATERIALS: dict[str, Any] = {
    "neo-hookean": NeoHookean(shear_modulus=4e5),
    "mooney-rivlin": MooneyRivlin(c1=1.6e5, c2=3e4),
    "yeoh": Yeoh(c1=1.8e5, c2=-1.5e3, c3=40),
    "gent": Gent(shear_modulus=3e5, limit=60),
    "ogden": Ogden(moduli=(6.3e5, 1.2e3, -1e4), exponents=(1.3, 5, -2)),
}
STRETCHES = {"uniaxial": np.linspace(1.05, 6, 20), "equibiaxial": np.linspace(1.05, 4, 20), "pure-shear": np.linspace(0.7, 5, 20)}  # fmt: skip


def made(material: Any, modes: tuple[str, ...] = MODES, noise: float = 0.0, seed: int = 1) -> Measurements:
    """Stresses of a material with relative noise."""
    random, law = np.random.default_rng(seed), law_of(material, 1.0)
    tables = {}
    for mode in modes:
        stress = nominal_stress(law, mode, STRETCHES[mode])  # type: ignore[arg-type]
        tables[mode] = (STRETCHES[mode], stress * (1 + noise * random.standard_normal(stress.shape)))
    return Measurements.of(tables)


def values(material: Any) -> list[float]:
    fields = material.model_dump(exclude={"law"}).values()
    return [number for field in fields for number in (field if isinstance(field, tuple) else (field,))]


def test_nominal_stresses() -> None:
    """Neo-Hooke: mu (l - l^-2), mu (l - l^-5), mu (l - l^-3)."""
    law = law_of(NeoHookean(shear_modulus=3.0), 1.0)
    for mode, power in (("uniaxial", -2), ("equibiaxial", -5), ("pure-shear", -3)):
        for stretch in (0.6, 1.0, 2.0):
            expected = 3.0 * (stretch - stretch**power)
            assert nominal_stress(law, mode, stretch) == pytest.approx(expected, abs=1e-14)  # type: ignore[arg-type]


@pytest.mark.parametrize("relative", [False, True])
@pytest.mark.parametrize("law", MATERIALS)
def test_a_law_comes_back(law: str, relative: bool) -> None:
    fit = fit_law(law, made(MATERIALS[law]), relative=relative)
    assert values(fit.material) == pytest.approx(values(MATERIALS[law]), rel=1e-5)
    assert fit.rms < 1e-3
    assert fit.doubts == ()
    assert [error.mode for error in fit.errors] == list(MODES)
    assert max(error.largest_relative for error in fit.errors) < 1e-7
    assert [parameter.value for parameter in fit.parameters] == values(fit.material)


@pytest.mark.parametrize("law", ["mooney-rivlin", "gent"])
def test_uncertainties_are_those_of_repeated_tests(law: str) -> None:
    """Spread of the parameters over forty noisy repetitions, against the standard uncertainty of each."""
    fits = [fit_law(law, made(MATERIALS[law], noise=0.02, seed=seed), relative=True) for seed in range(40)]
    spread = np.std([values(fit.material) for fit in fits], axis=0)
    stated = np.mean([[parameter.uncertainty for parameter in fit.parameters] for fit in fits], axis=0)
    # A standard deviation from forty samples is itself known to 11 %.
    assert stated == pytest.approx(spread, rel=0.35)


def test_a_parameter_that_the_data_do_not_determine() -> None:
    """Chains far from locking: any large limit does."""
    stretch = np.linspace(1.02, 1.3, 12)
    stress = 4e5 * (stretch - stretch**-2) * (1 + 0.01 * np.random.default_rng(5).standard_normal(12))
    fit = fit_law("gent", Measurements.of({"uniaxial": (stretch, stress)}))
    assert [doubt.parameter for doubt in fit.doubts] == ["limit"]
    assert "limit" in fit.doubts[0].message
    assert fit.parameters[0].value == pytest.approx(4e5, rel=0.05)


def test_terms_that_cannot_be_told_apart() -> None:
    """Three terms for a law of one: the fit is right, and says that its parameters are not."""
    one = Ogden(moduli=(4e5,), exponents=(2,))
    fit = fit_law("ogden", made(one, ("uniaxial",), noise=0.01), terms=3)
    assert fit.rms < 3e4
    assert len(fit.doubts) >= 2


def test_a_parameter_on_its_limit() -> None:
    """Rubber that stiffens wants c2 < 0, which Mooney and Rivlin's law does not allow here."""
    fit = fit_law("mooney-rivlin", made(MATERIALS["yeoh"], ("uniaxial",)))
    assert isinstance(fit.material, MooneyRivlin)
    assert [(doubt.parameter, doubt.reason) for doubt in fit.doubts] == [("c2", "at-limit")]
    assert fit.material.c2 == 0.0
    assert "ask for another law" in fit.doubts[0].message


def test_compression_alone_is_enough_for_one_modulus() -> None:
    stretch = np.linspace(0.5, 0.95, 8)
    fit = fit_law("neo-hookean", Measurements.of({"uniaxial": (stretch, 2e5 * (stretch - stretch**-2))}))
    assert values(fit.material) == pytest.approx([2e5], rel=1e-8)


@pytest.mark.slow
def test_the_same_in_every_run() -> None:
    data = made(MATERIALS["ogden"], noise=0.05)
    assert fit_law("ogden", data).material == fit_law("ogden", data).material


POINTS: Any = {"uniaxial": ([1.0, 1.5, 2.0], [0.0, 1e5, 2e5])}


@pytest.mark.parametrize(
    ("law", "tables", "options", "message"),
    [
        ("ogdn", POINTS, {}, 'law: "ogdn" is not allowed: must be "neo-hookean", "mooney-rivlin", "yeoh", "gent" or "ogden"; did you mean "ogden"?'),
        ("ogden", POINTS, {"terms": 0}, "terms: 0 is not allowed: must be at least 1 and at most 6"),
        ("ogden", POINTS, {"terms": 1}, "2 points with stress cannot determine 2 parameters: measure more, or take a law with fewer parameters"),
        ("gent", {"uniaxial": ([1.0, 1.1], [0.0, 0.0])}, {}, "nominal_stress: all are 0: there is nothing to fit"),
    ],
)  # fmt: skip
def test_refusals(law: str, tables: Any, options: dict[str, Any], message: str) -> None:
    with pytest.raises(FitError) as raised:
        fit_law(law, Measurements.of(tables), **options)
    assert str(raised.value) == message


def test_stress_against_the_stretch_is_no_material() -> None:
    stretch = np.linspace(1.1, 2.0, 9)
    with pytest.raises(FitError, match="no admissible material of this law is near these data"):
        fit_law("ogden", Measurements.of({"uniaxial": (stretch, -1e5 * (stretch - 1))}), terms=1)
