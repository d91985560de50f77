"""Loads with closed forms: discs pulled outwards, strips that hang under their weight."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from embedding import Scene, solve
from problems.common import Array, Positions

MU, SIZE = 1e5, 0.1


def solved(shape: dict[str, Any], thickness: Any, **parts: Any) -> tuple[Any, Positions]:
    places = Positions()
    scene = Scene(
        shell={
            "shape": shape,
            "thickness": thickness,
            "material": {"law": "neo-hookean", "shear_modulus": MU},
            "density": 1000.0,
        },
        **parts,
    )
    return solve(scene, listeners=[places]), places


@pytest.mark.parametrize("kind", ["dead", "follower"])
@pytest.mark.parametrize("reduction", ["axisymmetric", "3d"])
def test_a_disc_pulled_outwards(reduction: str, kind: str) -> None:
    """Equibiaxial stretch l: t = T mu (l - l^-5) (Ogden, Non-linear Elastic Deformations, 1984); nu stays nu."""
    stretch, thickness = 2.0, 1e-3
    pull = thickness * MU * (stretch - stretch**-5)
    solution, _ = solved(
        {"kind": "disc", "radius": SIZE},
        thickness,
        supports=[{"where": "surface", "fix": ["z"]}],
        loads={"edge_tractions": [{"edge": "rim", "traction": [pull, 0, 0], "frame": "edge", "kind": kind}]},
        model={"reduction": reduction},
    )
    # In 3D the mesh's rim is not quite round; in axisymmetry the answer is exact.
    within = 1e-9 if reduction == "axisymmetric" else 2e-4
    assert solution["stretch"][-1] == pytest.approx(stretch, rel=within)
    # Principal stretches that are equal are the double root of a square equation: half of the digits.
    assert solution["stretch_max"][-1] == pytest.approx(stretch, rel=max(within, 1e-7))


def stretch_of(stress: Array) -> Array:
    """The l > 0 with l - l^-3 = stress / mu: plane strain of a neo-Hookean strip."""
    stretch = np.ones_like(stress)
    for _ in range(60):
        stretch -= (stretch - stretch**-3 - stress / MU) / (1 + 3 * stretch**-4)
    return stretch


def displacement(places: Array, stress: Any) -> Array:
    """u(X) = int_0^X (l(stress(s)) - 1) ds, by Gauss quadrature."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    s = 0.5 * places[:, None] * (1 + nodes)
    return np.asarray(0.5 * places * ((stretch_of(stress(s)) - 1) @ weights))


@pytest.mark.parametrize("load", ["gravity", "body_force", "surface_force"])
def test_a_strip_under_its_weight(load: str) -> None:
    """P(X) = rho g (L - X), whatever way the weight is stated: g = 100 m/s^2, 1000 kg/m^3, 1 mm."""
    weight = {"gravity": [100, 0, 0], "body_force": [1e5, 0, 0], "surface_force": [100, 0, 0]}
    _, places = solved(
        {"kind": "strip", "length": SIZE},
        1e-3,
        supports=[{"where": "x0", "fix": ["x"]}, {"where": "surface", "fix": ["y"]}],
        loads={load: [10 * w for w in weight[load]]},
        discretisation={"order": 4, "shell_size": SIZE / 10},
    )
    moved = (places.deformed - places.reference)[:, 0]
    exact = displacement(places.reference[:, 0], lambda s: 1e6 * (SIZE - s))
    assert exact.max() > 0.14 * SIZE
    assert np.abs(moved - exact).max() < 1e-8 * exact.max()


@pytest.mark.parametrize("expression", ["1e-3 * (1 + 4*x)", "1e-3 * exp(-5*x) + 2e-4"])
def test_a_strip_whose_thickness_varies(expression: str) -> None:
    """The same force N/m everywhere: T(X) mu (l - l^-3) = t."""
    pull = 60.0
    thickness: dict[str, Any] = {"expression": expression}
    _, places = solved(
        {"kind": "strip", "length": SIZE},
        thickness,
        supports=[{"where": "x0", "fix": ["x"]}, {"where": "surface", "fix": ["y"]}],
        loads={"edge_tractions": [{"edge": "x1", "traction": [pull, 0, 0]}]},
        discretisation={"order": 4, "shell_size": SIZE / 10},
    )
    moved = (places.deformed - places.reference)[:, 0]
    at = eval(f"lambda x: {expression}", {"exp": np.exp})
    exact = displacement(places.reference[:, 0], lambda s: pull / at(s))
    assert exact.max() > 0.14 * SIZE
    assert np.abs(moved - exact).max() < 1e-8 * exact.max()


def test_a_strip_drawn_out() -> None:
    """The displacement of the end is given, the force it takes is t: T(X) mu (l - l^-3) = t inside, too."""
    pull = 80.0

    def stress(s: Array) -> Array:
        return np.asarray(pull / (1e-3 * (1 + 4 * s)))

    end = float(displacement(np.array([SIZE]), stress)[0])
    _, places = solved(
        {"kind": "strip", "length": SIZE},
        {"expression": "1e-3 * (1 + 4*x)"},
        supports=[
            {"where": "x0", "fix": ["x"]},
            {"where": "x1", "fix": ["x"], "displacement": [end, 0, 0]},
            {"where": "surface", "fix": ["y"]},
        ],
        discretisation={"order": 4, "shell_size": SIZE / 10},
    )
    moved = (places.deformed - places.reference)[:, 0]
    exact = displacement(places.reference[:, 0], stress)
    assert end > 0.15 * SIZE
    assert np.abs(moved - exact).max() < 1e-8 * end


def test_the_weight_of_a_strip_goes_with_its_thickness() -> None:
    """Weight and strength are both in proportion to T: with T = T_0 exp(-a X) and the end at L

    P(X) = rho g (1 - exp(-a (L - X))) / a.
    """
    a, weight = 5.0, 1e6
    _, places = solved(
        {"kind": "strip", "length": SIZE},
        {"expression": f"exp(-{a}*x)", "unit": "mm"},
        supports=[{"where": "x0", "fix": ["x"]}, {"where": "surface", "fix": ["y"]}],
        loads={"gravity": [weight / 1000, 0, 0]},
        discretisation={"order": 4, "shell_size": SIZE / 10},
    )
    moved = (places.deformed - places.reference)[:, 0]
    exact = displacement(places.reference[:, 0], lambda s: weight * (1 - np.exp(-a * (SIZE - s))) / a)
    assert np.abs(moved - exact).max() < 1e-8 * exact.max()


def test_a_strip_pulled_at_a_point() -> None:
    """A force at its middle stretches the half that carries it: mu T (l - l^-3) = F per metre, and 1 beyond."""
    stretch, thickness = 1.5, 1e-3
    force = thickness * MU * (stretch - stretch**-3)
    _, places = solved(
        {"kind": "strip", "length": SIZE},
        thickness,
        supports=[{"where": "x0", "fix": ["x"]}, {"where": "surface", "fix": ["y"]}],
        loads={"point_loads": [{"at": [SIZE / 2, 0, 0], "force": [force, 0, 0]}]},
        discretisation={"order": 2, "shell_size": SIZE / 10},
    )
    x = places.reference[:, 0]
    moved = (places.deformed - places.reference)[:, 0]
    assert moved == pytest.approx((stretch - 1) * np.minimum(x, SIZE / 2), abs=1e-12)
