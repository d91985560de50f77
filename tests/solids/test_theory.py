"""Which load the shell theory needs, judged by thick solids: only the consistent one is of second order."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from problems.exact import cylinder, sphere
from tests.solids import MidSurface, constant, referee_load
from tests.solids.membrane import Variant, membrane_ring, membrane_sphere
from tests.solids.thick import thick_ring, thick_sphere

Surface = Callable[..., MidSurface]
VARIANTS: tuple[Variant, ...] = ("embedding-aware", "net", "as-published")


def distances(membrane: Surface, solid: Surface, net: float, mean: float) -> dict[str, list[float]]:
    """Largest distance of each variant's mid-surface from the solid's, for walls getting thinner."""
    found: dict[str, list[float]] = {variant: [] for variant in VARIANTS}
    for t in (0.1, 0.05, 0.025):
        load = referee_load(t, net, mean)
        reference = solid(t, *load)
        for variant, row in found.items():
            row.append(membrane(t, *load, variant).distance(reference))
    return found


def orders(errors: list[float]) -> list[float]:
    return [math.log2(a / b) for a, b in zip(errors, errors[1:], strict=False)]


@pytest.mark.parametrize(
    ("membrane", "solid", "net", "mean"),
    [
        (membrane_sphere, thick_sphere, 1.0, -0.2),
        (membrane_ring, thick_ring, 0.4, 0.1),
        (membrane_ring, thick_ring, 0.4, -0.1),
    ],
)
def test_only_the_consistent_load_converges(
    membrane: Surface, solid: Surface, net: float, mean: float
) -> None:
    found = distances(membrane, solid, net, mean)
    aware = found["embedding-aware"]
    assert orders(aware) == pytest.approx([2.0, 2.0], abs=0.05)
    for variant in ("net", "as-published"):
        assert orders(found[variant])[-1] < 0.3
        assert found[variant][-1] > 20.0 * aware[-1]


def test_numbers_of_the_referee_load() -> None:
    """Largest distance from the solid under `referee_load`, and second order of the consistent load."""
    found = distances(membrane_sphere, thick_sphere, 1.0, 0.3)
    assert found["embedding-aware"] == pytest.approx([6.17e-4, 1.55e-4, 3.87e-5], rel=0.01)
    assert found["net"] == pytest.approx([5.38e-2, 5.35e-2, 5.34e-2], rel=0.01)
    assert found["as-published"] == pytest.approx([3.44e-2, 3.47e-2, 3.48e-2], rel=0.01)
    assert orders(found["embedding-aware"]) == pytest.approx([2.0, 2.0], abs=0.02)


@pytest.mark.parametrize("outside", [0.0, 0.4])
@pytest.mark.parametrize("variant", VARIANTS)
def test_uniform_pressures_against_closed_forms(variant: Variant, outside: float) -> None:
    t, stretch = 0.05, 1.2
    for membrane, body in ((membrane_sphere, sphere), (membrane_ring, cylinder)):
        if variant == "as-published":
            net = body.as_published_pressure(stretch, t, outside)
        else:
            net = body.membrane_pressure(stretch, t)
        found = membrane(t, constant(outside), constant(outside + net), variant)
        assert found.r**2 + found.z**2 == pytest.approx(stretch**2, abs=1e-9)
