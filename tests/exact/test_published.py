"""Published tables: consistent in themselves, and with the exact solutions where there are any."""

from __future__ import annotations

import pytest

from problems.exact.elastica import end_force, end_moment
from problems.published import sze_cylinders, sze_roof, sze_strips, t_cantilever
from problems.published.case import Case, columns

CASES = [
    sze_strips.END_SHEAR,
    sze_strips.END_MOMENT,
    sze_strips.SLIT_ANNULUS,
    *sze_cylinders.ALL,
    sze_roof.THICK_ROOF,
    sze_roof.THIN_ROOF,
    t_cantilever.T_CANTILEVER,
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_tables_are_complete(case: Case) -> None:
    assert set(case.table) == {"factor", *case.quantities}
    assert len({len(column) for column in case.table.values()}) == 1
    for values in case.others.values():
        for quantity, value in values.items():
            assert value == pytest.approx(case.end(quantity), rel=0.03)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_loads_grow_and_end_at_the_full_load(case: Case) -> None:
    factors = case.table["factor"]
    if case in (sze_roof.THICK_ROOF, sze_roof.THIN_ROOF):
        assert factors[-1] > 1.0
    else:
        assert list(factors) == sorted(factors) and factors[-1] == 1.0


def test_strips_agree_with_the_elastica() -> None:
    case = sze_strips.END_SHEAR
    for factor in case.table["factor"]:
        exact = end_force(4.0 * factor)
        assert case.at(factor, "shortening") == pytest.approx(10.0 * exact.shortening, abs=3.6e-3)
        assert case.at(factor, "deflection") == pytest.approx(10.0 * exact.deflection, abs=2.8e-3)
    case = sze_strips.END_MOMENT
    for factor in case.table["factor"]:
        exact = end_moment(2.0 * 3.141592653589793 * factor)
        assert case.at(factor, "exact_shortening") == pytest.approx(12.0 * exact.shortening, abs=6e-4)
        assert case.at(factor, "exact_deflection") == pytest.approx(12.0 * exact.deflection, abs=6e-4)


def test_hemisphere_starts_at_the_linear_value() -> None:
    """At a hundredth of the load the mean displacement is that of the linear obstacle course, 0.093 a force of 2."""
    small = sze_cylinders.HEMISPHERE_SMALL_LOAD
    mean = 0.25 * (small["outward"] + small["inward"])
    assert 0.0930 < mean < 0.0940
    linear = mean * sze_cylinders.HEMISPHERE.largest_load * 0.05 / 2.0
    first = 0.5 * (sze_cylinders.HEMISPHERE.at(0.05, "outward") + sze_cylinders.HEMISPHERE.at(0.05, "inward"))
    assert first == pytest.approx(linear, rel=0.05)


def test_roofs_turn_where_they_should() -> None:
    """Sabir and Lock's roofs: limit loads near 2.2 kN and 0.58 kN, snap-back of the thin one only."""
    thick, thin = (case.table for case in (sze_roof.THICK_ROOF, sze_roof.THIN_ROOF))
    assert 3000.0 * max(thick["factor"][:12]) == pytest.approx(2226.0, abs=1.0)
    assert 3000.0 * max(thin["factor"][:12]) == pytest.approx(586.0, abs=1.0)
    assert list(thick["centre"]) == sorted(thick["centre"])
    assert list(thin["centre"]) != sorted(thin["centre"])


def test_columns() -> None:
    assert columns("a b", "1 2\n3 4") == {"a": (1.0, 3.0), "b": (2.0, 4.0)}
