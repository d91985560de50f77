"""Inflated tube against the exact thick-walled one: second order in T/R, and blind to p_t alone."""

from __future__ import annotations

import pytest

from problems import cylinder_inflation
from problems.exact import cylinder
from tests.problems.measures import LAWS, as_field, orders

RATIOS = (0.1, 0.05, 0.01)
MU = 100e3  # Pa


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("axial_stretch", [1.0, 1.2])
def test_second_order_in_the_thickness(law: str, axial_stretch: float) -> None:
    changes = (law, f"shell.shape.axial_stretch={axial_stretch}")
    solutions = [cylinder_inflation.run(*changes, *cylinder_inflation.at_thickness(t)) for t in RATIOS]
    errors = [cylinder_inflation.error(solution) for solution in solutions]
    assert orders(RATIOS, errors) == pytest.approx([2.0, 2.0], abs=0.02)
    if axial_stretch == 1.0:
        assert errors == pytest.approx([1.825e-3, 4.564e-4, 1.826e-5], rel=1e-3)


@pytest.mark.parametrize("ratio", RATIOS)
def test_the_discretisation_is_below_the_theory(ratio: float) -> None:
    """What is solved is the membrane, at every step."""
    solution = cylinder_inflation.run(*cylinder_inflation.at_thickness(ratio))
    known = [cylinder.membrane_stretch(float(p), ratio * MU) for p in solution["pressure_difference"]]
    assert solution["stretch"] == pytest.approx(known, abs=1e-8)


@pytest.mark.parametrize(("order", "expected"), [(2, 4.0), (3, 4.0), (4, 6.0)])
def test_convergence_with_the_mesh(order: int, expected: float) -> None:
    """At even orders twice the order of the elements; at odd ones the curved geometry is the limit."""
    sizes, errors = (8.0, 4.0, 2.0), []
    for size in sizes:
        mesh = (f"discretisation.order={order}", f"discretisation.shell_size={size} mm")
        found = cylinder_inflation.run(*mesh)["stretch"][-1]
        errors.append(abs(float(found) - cylinder.membrane_stretch(0.04, 0.05)))
    assert orders(sizes, errors)[0] == pytest.approx(expected, abs=0.3)
    assert orders(sizes, errors)[1] == pytest.approx(expected, abs=0.3)


@pytest.mark.parametrize("as_fields", [False, True])
@pytest.mark.parametrize("outside", [0.0, 0.5 * MU, 10.0 * MU])
def test_the_outer_pressure_alone_does_nothing(outside: float, as_fields: bool) -> None:
    """Also when both pressures are assembled face by face, as fields that might vary."""
    values = {"pressure_top": outside, "pressure_bottom": outside + 4e3}
    state = as_field if as_fields else lambda name, value: f"loads.{name}={value!r}"
    found = cylinder_inflation.run(*(state(name, value) for name, value in values.items()))
    assert found["stretch"] == pytest.approx(cylinder_inflation.run()["stretch"], abs=1e-9)


@pytest.mark.parametrize("outside", [0.0, 0.5 * MU])
def test_the_published_load_depends_on_the_outer_pressure(outside: float) -> None:
    """The difference that holds a stretch of 1.5 is then another one: by how much is known in closed form."""
    ratio = 0.05
    difference = MU * cylinder.as_published_pressure(1.5, ratio, outside / MU)
    pressures = (f"loads.pressure_top={outside!r}", f"loads.pressure_bottom={outside + difference!r}")
    published = cylinder_inflation.run(*pressures, "loads.variant=as-published")
    assert published["stretch"][-1] == pytest.approx(1.5, abs=1e-7)
    consistent = cylinder_inflation.run(*pressures)
    assert consistent["stretch"][-1] == pytest.approx(cylinder.membrane_stretch(difference / MU, ratio), abs=1e-7)
    assert abs(consistent["stretch"][-1] - 1.5) > (5e-3 if outside == 0.0 else 0.1)


def test_no_limit_point_on_the_way_to_stretch_five() -> None:
    """Under pressure control; the printed formula would have its maximum at 5^(1/4) = 1.495."""
    full = 30e3 + MU * cylinder.membrane_pressure(5.0, 0.05)
    solution = cylinder_inflation.run(f"loads.pressure_bottom={full!r}", "path.0.steps=40")
    known = [cylinder.membrane_pressure(float(x), 1.0) for x in solution["stretch"]]
    assert solution["pressure_difference"] / (MU * 0.05) == pytest.approx(known, abs=1e-8)
    assert solution["stretch"][-1] == pytest.approx(5.0, abs=1e-4)
