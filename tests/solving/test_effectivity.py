"""Error estimates against true errors, wherever an answer is known."""

from __future__ import annotations

import pytest

from embedding import solve
from problems import charged_balloon
from problems.known import Known, all_known

QUICK = (
    "charged balloon T/R 0.1", "charged balloon, charge", "grounded balloon", "dielectric tube",
    "inflated tube T/R 0.1",
    "inflated balloon T/R 0.05", "varying pressure", "capacitance: sphere", "capacitance: oblate spheroid 1:3",
    "capacitance: disc", "capacitance: bowl of 90 degrees", "two spheres: force", "sphere in a field: pull",
    "permeable sphere T/R 0.1", "blown-up membrane", "cantilever: deflection",
)  # fmt: skip
ROUNDING = 1e-12


def effectivity(known: Known, *changes: str) -> float:
    """Estimate over true error; 1 where both are rounding."""
    solution = solve(known.scene.with_overrides(changes))
    error, estimate = known.error(solution), known.estimate(solution)
    return 1.0 if max(error, estimate) < ROUNDING else estimate / error


@pytest.mark.parametrize("known", [k for k in all_known() if k.name in QUICK], ids=lambda known: known.name)
def test_an_estimate_is_near_the_error(known: Known) -> None:
    assert 0.5 < effectivity(known) < 5.0


@pytest.mark.slow
@pytest.mark.parametrize("order", [2, 3])
def test_nine_in_ten_are(order: int) -> None:
    """Those apart whose reference itself is not sure enough."""
    known = [one for one in all_known() if one.scatter == 0.0]
    found = {one.name: effectivity(one, f"discretisation.order={order}") for one in known}
    good = [name for name, value in found.items() if 0.5 < value < 5.0]
    assert len(good) >= 0.9 * len(found), {name: value for name, value in found.items() if name not in good}


@pytest.mark.parametrize("order", [2, 3])
def test_parts_are_those_of_their_sources(order: int) -> None:
    """Finer elements reduce what is of the mesh, a thinner wall what is of the wall, and nothing else."""
    coarse, fine, thin = (
        charged_balloon.run(*charged_balloon.at(ratio, 1.2), f"discretisation.order={order}", change).errors["charge"]
        for ratio, change in (
            (0.1, "discretisation.shell_size=7 mm"),
            (0.1, "discretisation.shell_size=3 mm"),
            (0.025, "discretisation.shell_size=3 mm"),
        )
    )
    assert fine.discretisation < 0.4 * coarse.discretisation
    assert fine.parts["thickness"] == pytest.approx(coarse.parts["thickness"], rel=0.5)
    assert thin.parts["opened faces"] < 0.2 * fine.parts["opened faces"]


def test_far_away_is_told_by_the_solution() -> None:
    """Robin's condition is exact for the net charge of a sphere in the middle, and not for a spheroid."""
    known = {one.name: one for one in all_known()}
    sphere, spheroid = (known[f"capacitance: {name}"] for name in ("sphere", "oblate spheroid 1:3"))
    near_by = ("ambient.radius=45 mm", "model.far_field=robin")
    round_one, flat_one = (solve(one.scene.with_overrides(near_by)) for one in (sphere, spheroid))
    assert round_one.errors["charge"].parts["far field"] < 1e-9
    told = flat_one.errors["charge"].parts["far field"]
    assert 0.3 * spheroid.error(flat_one) < told < 5.0 * spheroid.error(flat_one)
