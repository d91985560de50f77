"""The shallow cap: small loads by linear theory, and what does not depend on the degree."""

from __future__ import annotations

import pytest

from problems.exact.shallow_cap import ShallowCap


def test_a_flat_plate() -> None:
    """For lambda to 0 the cap is a clamped plate: w_0 = p a^4 / (64 D), or w_0 / H = lambda^2 P / 8... in rises."""
    small = 1e-3
    for parameter in (0.05, 0.1):
        # p a^4 / (64 D) over H, with p = P 2 E T^2 / (R^2 s), D = E T^3 / (4 s^2) and lambda^2 = 2 s a^2 / (R T).
        assert small / ShallowCap(parameter).pressure(small) == pytest.approx(parameter**2 / 8.0, rel=1e-4)


def test_limit_points_do_not_depend_on_the_degree() -> None:
    coarse, fine = ShallowCap(5.0, degree=28).limit_points(), ShallowCap(5.0, degree=40).limit_points()
    for one, other in zip(coarse, fine, strict=True):
        assert one.pressure == pytest.approx(other.pressure, abs=1e-9)


def test_a_flat_cap_does_not_snap() -> None:
    """Snap-through begins at a rise parameter of about 3.3 (Budiansky 1960)."""
    assert ShallowCap(3.0).limit_points() == ()
    assert len(ShallowCap(3.6).limit_points()) == 2
