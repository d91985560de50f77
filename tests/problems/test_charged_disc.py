"""Charged disc: its charge, the force on its rim, the stretch by it, and no net force."""

from __future__ import annotations

import pytest

from problems import charged_disc


def finer(size: float) -> str:
    return f"discretisation.edge_size={{rim = '{size} mm'}}"


def test_charge_by_default() -> None:
    """The field is singular at the rim: the error goes with the size of the elements there."""
    assert abs(charged_disc.charge_error(charged_disc.run(charged_disc.HELD))) < 1e-3


def test_charge_converges() -> None:
    """First order in the size of the elements at the rim; they are not all refined alike."""
    coarse, fine = (charged_disc.charge_error(charged_disc.run(charged_disc.HELD, finer(size))) for size in (0.4, 0.02))
    assert coarse == pytest.approx(1.1e-3, rel=0.1)
    assert 0.0 < fine < 1e-4


def test_force_on_the_rim() -> None:
    """Net outward force dC/dR V^2 / 2, which pressures on the faces know nothing of."""
    assert abs(charged_disc.force_error()) < 2e-4
    assert abs(charged_disc.force_error(finer(0.4))) < 1e-3
    assert abs(charged_disc.force_error("discretisation.order=4")) < 1e-4


def test_the_thin_wall_in_its_true_place() -> None:
    """With the faces opened, T/R = 1e-3: the charge of a disc that has a thickness is larger, by about
    T / (2 pi R) (1 + ln(8 pi R / T)) for a square rim, 1.8e-3, less here, where the faces meet in the rim."""
    opened = charged_disc.run(charged_disc.HELD, "model.interface=opened")
    assert 5e-4 < charged_disc.charge_error(opened) < 2.3e-3
    assert charged_disc.force_error("model.interface=opened") == pytest.approx(0.0, abs=0.01)


def test_the_rim_stretches_the_disc() -> None:
    solution = charged_disc.run()
    assert solution["stretch"] - 1.0 == pytest.approx(charged_disc.known_strain(solution), rel=2e-3)
    assert solution["stretch_max"][-1] - solution["stretch_min"][-1] < 0.02 * (solution["stretch"][-1] - 1.0)


@pytest.mark.parametrize("interface", ["closed", "opened"])
def test_no_net_force_on_itself(interface: str) -> None:
    """Beside the force on the rim, 4 eps0 V^2 = 3.5e-5 N."""
    solution = charged_disc.run(f"model.interface={interface}")
    assert abs(solution["force_z"]).max() < 1e-5 * 3.54e-5
