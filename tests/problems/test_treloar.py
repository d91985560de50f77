"""Treloar's data by Ogden's law: his published parameters, and ours from the same data."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np
import pytest

from problems import treloar


def test_the_published_parameters_reproduce_the_data() -> None:
    uniaxial, equibiaxial = treloar.measurements().series
    error = np.abs(treloar.errors(treloar.PUBLISHED, uniaxial))
    assert error[uniaxial.stretch[1:] < 7.55].max() < 0.14
    assert error.max() < 0.19
    error = np.abs(treloar.errors(treloar.PUBLISHED, equibiaxial))
    assert error[1:].max() < 0.09
    assert error[0] < 0.24


def test_a_fit_from_scratch_is_at_least_as_good() -> None:
    fit = treloar.fitted()
    for series in treloar.measurements().series:
        ours, published = (np.mean(treloar.errors(m, series) ** 2) for m in (fit.material, treloar.PUBLISHED))
        assert ours < published
    assert fit.doubts == ()
    # What Ogden found by hand lies within three standard uncertainties of every parameter.
    known = (*treloar.PUBLISHED.moduli, *treloar.PUBLISHED.exponents)
    for parameter, value in zip(fit.parameters, known, strict=True):
        assert abs(parameter.value - value) < 3 * parameter.uncertainty, parameter


def test_script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(treloar.DATA.with_suffix(".py")), run_name="__main__")
    assert "uniaxial: largest error 1.0e-01" in capsys.readouterr().out
    assert (tmp_path / "treloar.png").stat().st_size > 10_000
