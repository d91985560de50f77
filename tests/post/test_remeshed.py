"""Questions to a run whose space was meshed anew on the way: the same answers on every mesh."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from embedding import open_archive
from embedding.post import energy_balance, integrals, probe, probe_shell
from embedding.scene.scales import EPSILON_0
from embedding.solving import session
from problems import grounded_balloon, turned_in_a_field

pytestmark = pytest.mark.usefixtures("unestimated")

OUTER = 0.08  # radius of the grounded sphere


@pytest.mark.slow
def test_a_spherical_capacitor_on_several_meshes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """phi = V (1/r - 1/R) / (1/b - 1/R) between the outer face, at b, and the ground; Q = 4 pi eps V / (1/b - 1/R)."""
    monkeypatch.setattr(session, "WORN", 1.0)
    path = tmp_path / "run.vtkhdf"
    solution = grounded_balloon.run("path=[{control='load', steps=5}]", archive=path)
    archive = open_archive(path)
    assert len({len(archive.block("outside", step).points) for step in range(len(archive))}) > 1
    face = probe_shell(archive, [[0.02, 0.0, 0.0]], fields=["u", "thickness"])
    b = 0.02 + face["u_x"] + face["thickness"] / 2
    volts = solution["voltage"]
    across = 1 / b - 1 / OUTER

    for radius in (0.035, 0.06):
        table = probe(archive, [[0.0, radius, 0.0]])
        assert set(table["where"]) == {"outside"}
        np.testing.assert_allclose(table["phi"], volts * (1 / radius - 1 / OUTER) / across, rtol=1e-3)
        np.testing.assert_allclose(table["E_y"], volts / radius**2 / across, rtol=3e-3)
    on_top = probe_shell(archive, [[0.0, 0.0, 0.02]], side="top")
    np.testing.assert_allclose(on_top["phi"], volts, rtol=1e-6)

    charge = 4 * math.pi * EPSILON_0 * volts / across
    table = integrals(archive)
    np.testing.assert_allclose(table["charge_top"], charge, rtol=2e-3)
    np.testing.assert_allclose(table["field_energy"], charge * volts / 2, rtol=3e-3)
    assert (np.abs(table["charge_top"] - solution["charge"]) <= table["charge_top_error"]).all()
    balance = energy_balance(archive)
    assert np.abs(balance["residual_cubic"]).max() < 1e-2 * balance["stored"].max()


@pytest.mark.slow
def test_faces_of_a_strip_that_is_held(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its clamped end does not move, and is at one place on all meshes: the other nodes of a face are found too."""
    tables = []
    for worn, name in ((session.WORN, "once"), (1.0, "often")):
        monkeypatch.setattr(session, "WORN", worn)
        turned_in_a_field.run("path=[{control='load', steps=3}]", archive=tmp_path / f"{name}.vtkhdf")
        tables.append(integrals(tmp_path / f"{name}.vtkhdf", steps=[1, 2]))
    assert open_archive(tmp_path / "often.vtkhdf").scalars["remeshings"][1] > 0
    once, often = tables
    for name in ("flux_top", "flux_bottom"):
        assert (np.abs(often[name]) > 0.0).all()
        assert (np.abs(once[name] - often[name]) <= once[f"{name}_error"] + often[f"{name}_error"]).all()
