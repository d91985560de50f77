"""Pull-in over a rigid electrode: published values, the differential equation, both branches."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from problems.exact import mems

# Pelesko and Bernstein (2002), Guo, Pan and Ward (2005): loads at centres, recomputed to ten digits.
TABLE = [
    (0.02, 0.1547079234, 0.07761778228),
    (0.1, 0.6718302177, 0.3422251846),
    (0.3, 1.339921053, 0.7202792584),
    (0.45, 1.373806572, 0.7891328233),
    (0.7, 0.8634824881, 0.6359475631),
]


@pytest.mark.parametrize(("centre", "strip", "disc"), TABLE)
def test_published_branches(centre: float, strip: float, disc: float) -> None:
    assert mems.strip_load(centre) == pytest.approx(strip, abs=1e-9)
    assert mems.disc_load(centre) == pytest.approx(disc, abs=1e-9)


def test_published_pull_in() -> None:
    assert mems.strip_pull_in() == pytest.approx((0.388346718913, 1.40001647737), abs=1e-11)
    assert mems.disc_pull_in() == pytest.approx((0.444292284, 0.789229268), abs=1e-9)
    x = np.linspace(0.0, 1.0, 100001)
    loads = np.array([mems.plate_load(float(value)) for value in x])
    assert (x[loads.argmax()], loads.max()) == pytest.approx(mems.PLATE, abs=1e-5)


@pytest.mark.parametrize("centre", [0.2, 0.6])
def test_shapes_solve_the_boundary_value_problem(centre: float) -> None:
    """By collocation, with nothing of the closed forms but the load and a start."""
    load = mems.strip_load(centre)
    x = np.linspace(-0.5, 0.5, 41)
    start = np.array([[mems.strip_shape(centre, float(p)) for p in x], np.zeros(41)])
    start[1] = np.gradient(start[0], x)
    found = solve_bvp(
        lambda x, y: np.vstack([y[1], load / (1.0 + y[0]) ** 2]), lambda a, b: np.array([a[0], b[0]]), x, start,
        tol=1e-10, max_nodes=20000,
    )  # fmt: skip
    assert found.sol(x)[0] == pytest.approx(start[0], abs=1e-8)
    load = mems.disc_load(centre)
    r = np.linspace(0.0, 1.0, 41)
    start = np.array([[mems.disc_shape(centre, float(p)) for p in r], np.zeros(41)])
    start[1] = np.gradient(start[0], r)
    singular = np.array([[0.0, 0.0], [0.0, -1.0]])
    found = solve_bvp(
        lambda x, y: np.vstack([y[1], load / (1.0 + y[0]) ** 2]), lambda a, b: np.array([a[1], b[0]]), r, start,
        S=singular, tol=1e-9, max_nodes=20000,
    )  # fmt: skip
    assert found.sol(r)[0] == pytest.approx(start[0], abs=1e-8)
    assert start[0][0] == pytest.approx(-centre, abs=1e-14)


@pytest.mark.parametrize("body", ["plate", "strip", "disc"])
def test_two_deflections_at_one_load(body: str) -> None:
    limits = {"plate": mems.PLATE, "strip": mems.strip_pull_in(), "disc": mems.disc_pull_in()}
    loads = {"plate": mems.plate_load, "strip": mems.strip_load, "disc": mems.disc_load}
    load = 0.8 * limits[body].load
    below, above = mems.centre_at(load, body), mems.centre_at(load, body, "unstable")  # type: ignore[arg-type]
    assert below < limits[body].centre < above
    assert [loads[body](c) for c in (below, above)] == pytest.approx([load, load], rel=1e-10)
    with pytest.raises(ValueError, match="exceeds the pull-in"):
        mems.centre_at(1.01 * limits[body].load, body)  # type: ignore[arg-type]


def test_small_loads_are_linear() -> None:
    """-u = load / 8 in the strip, load / 4 in the disc."""
    assert mems.strip_load(1e-6) == pytest.approx(8e-6, rel=1e-5)
    assert mems.disc_load(1e-6) == pytest.approx(4e-6, rel=1e-5)
    with pytest.raises(ValueError, match="centre"):
        mems.disc_load(0.999)
    with pytest.raises(ValueError, match="ends"):
        mems.strip_shape(0.1, 0.6)


@pytest.mark.parametrize("body", ["strip", "disc"])
def test_the_weight_of_the_fringes(body: str) -> None:
    """The two means of `fringe`, from differences of shapes about the fold: f = du/dcentre."""
    limit, shape, half = {
        "strip": (mems.strip_pull_in(), mems.strip_shape, 0.5), "disc": (mems.disc_pull_in(), mems.disc_shape, 1.0),
    }[body]  # fmt: skip
    nodes, weights = np.polynomial.legendre.leggauss(24)
    x, w, step = half * (nodes + 1.0) / 2.0, half * weights / 2.0, 1e-5

    def mode(x: float) -> float:
        return (shape(limit.centre + step, x) - shape(limit.centre - step, x)) / (2.0 * step)

    measure = x if body == "disc" else np.ones(24)
    mean = w @ (measure * [mode(p) / (1.0 + shape(limit.centre, p)) ** 2 for p in x])
    at_edge = (mode(half) - mode(half - 1e-4)) / 1e-4
    assert mems.fringe(limit) == pytest.approx(-at_edge / (np.pi**2 * mean), rel=1e-3)
