"""What a thin shell asks of numbers: small strains with all their digits, terms of one size, stress in balance."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from embedding.shell.membrane import Strained
from embedding.solving.estimate.bent import Bent
from tests.bent import DISC, RUBBER, clamped, mesh, metal, problem_of
from tests.bent import Bent as Solved
from tests.forms import Array


@dataclass(frozen=True)
class Seen:
    """What :class:`Strained` takes of kinematics on a curve."""

    dimension: int = 2
    projector: Any = None


def strained(first: float, second: float) -> Any:
    """A curve with these strains, in numbers."""
    state = Strained(Seen(), None, second)  # type: ignore[arg-type]
    state.__dict__["_trace"] = first + second
    state.__dict__["_determinant"] = first * second
    return state


@pytest.mark.parametrize("size", [0.3, 1e-3, 1e-9, 1e-14])
def test_small_strains_keep_their_digits(size: float) -> None:
    """I_1 - 3 and I_2 - 3 against their definitions where those have digits, and the law of small strains below:
    4 (a^2 + a b + b^2)."""
    a, b = size, -0.4 * size
    state = strained(a, b)
    if size > 1e-6:
        first, second = 1 + 2 * a, 1 + 2 * b
        across = 1 / (first * second)
        expected = first + second + across - 3, first * second + across * (first + second) - 3
        allowed = 1e-15 / size**2
    else:
        expected = 2 * (4 * (a * a + a * b + b * b),)
        allowed = 20 * size
    assert (state.excess, state.second_excess) == pytest.approx(expected, rel=max(allowed, 1e-14))


def coupling(thickness: float) -> Array:
    """The matrix of a disc at rest between displacements and moments, over the stiffness of bending."""
    problem = problem_of(DISC, thickness, RUBBER, supports=clamped("rim"), discretisation=mesh(2, 0.3))
    system = problem.system
    system.linearise()
    rows, columns = (
        [i for i in np.flatnonzero(system._solver.mask) if i in range(*system.unknowns.range(name).indices(10**6))]
        for name in ("u", "moment")
    )
    kept = list(np.flatnonzero(system._solver.kept))
    matrix = system._solver.matrix().toarray()
    found = matrix[np.ix_([kept.index(i) for i in rows], [kept.index(i) for i in columns])]
    return np.asarray(found / thickness**3)


def test_moments_and_displacements_meet_however_thin_the_shell() -> None:
    """With moments in their own unit the matrix scales by T^3; else terms would be lost beside the compliance T^-3."""
    thick, thin = coupling(1e-2), coupling(1e-7)
    assert np.abs(thick).max() > 1.0
    assert np.abs(thin - thick).max() < 1e-9 * np.abs(thick).max()


@pytest.mark.parametrize("size", [0.3, 0.15])
@pytest.mark.parametrize("shape", ["strip", "disc"])
def test_energy_of_shear(shape: str, size: float) -> None:
    """60 D / (k G T L^2) of a clamped strip under pressure, 24 D / (k G T a^2) of a clamped disc."""
    T = 0.01
    strip = {"kind": "strip", "length": 1.0}
    body, edges = (strip, ("x0", "x1")) if shape == "strip" else (DISC, ("rim",))
    pressed = Solved(
        body, T, supports=clamped(*edges), loads={"pressure_bottom": 1e-9}, discretisation=mesh(3, size)
    ).converged()
    D, stiff = T**3 / 3, 5 / 6 * T
    expected = (60 if shape == "strip" else 24) * D / stiff
    assert Bent(pressed.problem).shear == pytest.approx(expected, rel=2e-2)


def test_shear_on_triangles() -> None:
    """The same disc in three dimensions."""
    T = 0.01
    options = {"model": {"reduction": "3d"}, "discretisation": mesh(3, 0.3)}
    pressed = Solved(DISC, T, supports=clamped("rim"), loads={"pressure_bottom": 1e-9}, **options).converged()
    assert Bent(pressed.problem).shear == pytest.approx(24 * T**2 / 3 / (5 / 6), rel=0.2)


@pytest.mark.parametrize("ratio", [1e-2, 2e-2])
def test_curling_of_rubber(ratio: float) -> None:
    """A strip bent to t = T / R: 1.2 t^2 of its moment are missing, and all of its energy is bending's."""
    moment = ratio * ratio**2 / 3
    rolled = Solved(
        {"kind": "strip", "length": 1.0}, ratio, supports=clamped("x0"),
        loads={"edge_moments": [{"edge": "x1", "moment": moment}]}, path=({},), discretisation=mesh(3, 0.2),
    ).converged()  # fmt: skip
    bent = Bent(rolled.problem)
    assert bent.curling == pytest.approx(1.2 * ratio**2, rel=2e-2)
    assert bent.sharpest == pytest.approx(ratio, rel=1e-2)
    assert bent.shear < 1e-6


def test_bending_strains_of_a_law_of_small_strains() -> None:
    """A strip rolled to a full circle: half the thickness over the radius on either face, none in its middle."""
    T = 0.01
    rolled = Solved(
        {"kind": "strip", "length": 1.0}, T, metal(), supports=clamped("x0"),
        loads={"edge_moments": [{"edge": "x1", "moment": 2 * math.pi * T**3 / 12}]}, path=({},),
        discretisation=mesh(3, 0.2),
    ).converged()  # fmt: skip
    assert Bent(rolled.problem).strain == pytest.approx(math.pi * T, rel=1e-4)
