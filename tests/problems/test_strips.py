"""Cantilevers under end shear and end moment: a strip in plane strain and a plate, against exact strips.

The strip that is solved takes Hooke's energy of the turn of its normals, `koiter_strip` with stretch power 0: nothing
is left but the discretisation, whose order is asserted. The plate of the same material is free to widen where it bends,
which moves its tip by O((T/L)^2), 2e-5 here.
"""

from __future__ import annotations

import pytest

from problems import cantilever_moment, cantilever_shear
from problems.common import LoadPath
from problems.published.case import Case
from tests.problems.measures import orders

SIZES = (5.0, 2.5, 1.25)
MOST = 150


def published(path: LoadPath, case: Case) -> dict[str, float]:
    """Largest difference from the published end values, relative to the length."""
    length = case.geometry["length"]
    return {name: abs(path.end(name) - case.end(name)) / length for name in path.values}


def test_end_shear() -> None:
    path = cantilever_shear.run()
    known, limit = cantilever_shear.reference(), cantilever_shear.inextensible()
    for name in ("shortening", "deflection"):
        assert path.end(name) == pytest.approx(known[name], rel=1e-7)
        assert path.end(name) == pytest.approx(limit[name], rel=1e-4), "(T/L)^2 = 1e-4"
    assert max(published(path, cantilever_shear.CASE).values()) < 5e-4
    assert path.solution.iterations <= MOST


def test_end_shear_converges() -> None:
    known, errors = cantilever_shear.reference(), []
    for size in SIZES:
        path = cantilever_shear.run(f"discretisation.shell_size={size} m")
        errors.append(abs(path.end("deflection") - known["deflection"]))
    assert min(orders(SIZES, errors)) > 5.0


def test_end_moment_rolls_it_up() -> None:
    path = cantilever_moment.run()
    for number, factor in enumerate(path.factors):
        exact = cantilever_moment.exact(float(factor))
        for name, value in exact.items():
            assert path.values[name][number] == pytest.approx(value, abs=1e-6)
    assert path.end("shortening") == pytest.approx(12.0, abs=1e-9)
    assert max(published(path, cantilever_moment.CASE).values()) < 1e-9
    assert path.solution.iterations <= MOST


def test_end_moment_converges() -> None:
    """Stopped at seven tenths of the load: the closed circle has no error at all."""
    errors, exact = [], cantilever_moment.exact(0.7)
    for size in SIZES:
        path = cantilever_moment.run(f"discretisation.shell_size={size} m", "path=[{mechanical = 0.7}]")
        errors.append(abs(path.end("deflection") - exact["deflection"]))
    assert min(orders(SIZES, errors)) > 5.5


def test_plate_under_end_shear() -> None:
    path = cantilever_shear.run(plate=True)
    strip = cantilever_shear.reference()
    for name in ("shortening", "deflection"):
        assert path.end(name) == pytest.approx(strip[name], rel=1e-4)
    assert max(published(path, cantilever_shear.CASE).values()) < 5e-4
    assert path.solution.iterations <= MOST


@pytest.mark.slow
def test_plate_under_end_moment() -> None:
    """The bent plate widens by (k T)^2 / 12 = 2.3e-4, k its curvature, and turns by twice that more than a strip: its
    tip, 2 pi 4.6e-4 beyond the full turn, is 0.0055 short of the clamp."""
    path = cantilever_moment.run(plate=True)
    assert path.end("shortening") == pytest.approx(12.0 - 0.0055, abs=3e-4)
    assert path.end("deflection") == pytest.approx(0.0, abs=1e-3)
    assert path.solution.iterations <= MOST
