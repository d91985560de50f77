"""Plates, strips, rings and columns that bend a little, against closed forms; a varying thickness; signs of moments."""

from __future__ import annotations

import pytest
from scipy.integrate import quad

from embedding.solving.stability import unstable_modes
from problems.exact import buckling, plates
from tests.bent import DISC, RUBBER, Bent, Table, clamped, mesh, metal, rigidity, young
from tests.problems.measures import orders

T = 0.01
STRIP: Table = {"kind": "strip", "length": 1.0}
PLATE: Table = {"kind": "plate", "length": 1.0, "width": 0.25}
MATERIALS = {"nu = 0": metal(0.0), "nu = 0.3": metal(0.3), "rubber": RUBBER}
either = pytest.mark.parametrize("material", list(MATERIALS.values())[1:], ids=list(MATERIALS)[1:])


@either
def test_supported_rectangle(material: Table) -> None:
    """Navier's series, off the centre."""
    D, shape = rigidity(material, T), {"kind": "plate", "length": 1.0, "width": 0.6}
    load = 1e-4 * D
    errors = []
    for size in (0.4, 0.1):
        bent = Bent(
            shape, T, material, supports=clamped("x0", "x1", "y0", "y1", kind="pinned"),
            loads={"surface_force": [0, 0, load]}, discretisation=mesh(3, size),
        )  # fmt: skip
        exact = plates.supported_rectangle(0.5, 0.3, load, (1.0, 0.6), D)
        errors.append(abs(bent.moved(0.5, 0.3, 0.0)[2] / exact - 1.0))
    assert errors[1] < 3e-6
    assert orders((0.4, 0.1), errors)[0] > 3.5


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS)
def test_cantilever_strip(material: Table, order: int) -> None:
    """Plane strain, an end force F: F L^3 / (3 D) at any order, but for the square of the deflection."""
    D, deflection = rigidity(material, T), 1e-5
    loads = {"edge_tractions": [{"edge": "x1", "traction": [0, 3 * D * deflection, 0]}]}
    bent = Bent(STRIP, T, material, supports=clamped("x0"), loads=loads, discretisation=mesh(order, 0.5))
    assert bent.moved(1.0, 0.0, 0.0)[1] == pytest.approx(deflection, rel=1e-9)


@pytest.mark.parametrize("shape", [STRIP, PLATE], ids=["strip", "plate"])
def test_tapered_cantilever(shape: Table) -> None:
    """T (1 - x/2), end force F: w = int F (1 - x)^2 / D(x) dx (nu = 0)."""
    D = rigidity(metal(), T)
    force, errors, sizes = 1e-5 * D, [], (0.5, 0.25)
    exact = force / D * quad(lambda x: (1 - x) ** 2 / (1 - x / 2) ** 3, 0, 1, epsabs=1e-14, epsrel=1e-13)[0]
    flat = shape["kind"] == "strip"
    loads = {"edge_tractions": [{"edge": "x1", "traction": [0, force, 0] if flat else [0, 0, force]}]}
    for size in sizes:
        bent = Bent(
            shape, {"expression": f"{T}*(1-x/2)"}, metal(), supports=clamped("x0"), loads=loads,
            discretisation=mesh(2, size),
        )  # fmt: skip
        errors.append(abs(bent.moved(1.0, 0.0, 0.0)[1 if flat else 2] / exact - 1.0))
    assert errors[-1] < 2e-6
    assert orders(sizes, errors)[0] > (4.5 if flat else 1.4)


@either
def test_pinched_ring(material: Table) -> None:
    """0.149 and 0.137 F R^3 / EI; both order 4, kinks of the moment under the forces included."""
    thickness, sizes = 1e-3, (0.4, 0.2)
    exact = buckling.pinched_ring(1.0, 1.0, rigidity(material, thickness))
    force = 1e-6 / exact.along
    loads = {
        "point_loads": [{"at": [0, 1, 0], "force": [0, -force, 0]}, {"at": [0, -1, 0], "force": [0, force, 0]}]
    }
    errors = []
    for size in sizes:
        bent = Bent(
            {"kind": "infinite-cylinder", "radius": 1.0}, thickness, material, loads=loads,
            discretisation=mesh(2, size),
        )  # fmt: skip
        along, across = -2 * bent.moved(0.0, 1.0, 0.0)[1], 2 * bent.moved(1.0, 0.0, 0.0)[0]
        errors.append(max(abs(along / exact.along / force - 1), abs(across / exact.across / force - 1)))
    assert errors[-1] < 1e-4
    assert orders(sizes, errors)[0] > 3.5


ENDS: dict[buckling.Ends, list[Table]] = {
    "clamped-free": clamped("x0"),
    "pinned-pinned": [{"where": "x0", "fix": ["x", "y"]}, {"where": "x1", "fix": ["y"]}],
    "clamped-pinned": [*clamped("x0"), {"where": "x1", "fix": ["y"]}],
    "clamped-clamped": [*clamped("x0"), {"where": "x1", "fix": ["y", "rotation"]}],
}


@either
@pytest.mark.parametrize("ends", ENDS)
def test_columns(ends: buckling.Ends, material: Table) -> None:
    """A strip is stable just below Euler's load, and has one unstable mode just above. It shortens first, by e = P / A,
    and stiffens with it: the load is P (1 + e) for Hooke's law and P (1 + 7 e) for rubber, e < 4e-6 here."""
    thickness = 1e-3
    euler = buckling.column_force(1.0, rigidity(material, thickness), ends)
    for factor, expected in ((1 - 2e-4, 0), (1 + 2e-4, 1)):
        bent = Bent(
            STRIP, thickness, material, supports=ENDS[ends], discretisation=mesh(3, 0.2),
            loads={"edge_tractions": [{"edge": "x1", "traction": [-factor * euler, 0, 0]}]},
        ).converged()  # fmt: skip
        bent.problem.system.linearise()
        assert unstable_modes(bent.problem.system) == expected


@pytest.mark.parametrize(("material", "power"), [(metal(0.3), 1), (RUBBER, 7)], ids=["metal", "rubber"])
def test_a_thick_column_is_shortened_before_it_buckles(material: Table, power: int) -> None:
    """The strip's own bifurcation load at T/L = 0.05: P = E(l) with P l^power = Euler's, found between 1 +- 4e-5."""
    thickness = 0.05
    euler = buckling.column_force(1.0, rigidity(material, thickness), "clamped-free")
    E, nu = young(material)

    def force(l: float) -> float:  # noqa: E741
        return thickness * (E / (1 - nu**2) * l * (1 - l * l) / 2 if power == 1 else l**-3 - l)

    low, high = 0.9, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if force(middle) * middle**power < euler else (middle, high)
    assert 1e-4 < force(low) / euler - 1 < 0.01
    for factor, expected in ((1 - 4e-5, 0), (1 + 4e-5, 1)):
        bent = Bent(
            STRIP, thickness, material, supports=clamped("x0"), discretisation=mesh(3, 0.2),
            loads={"edge_tractions": [{"edge": "x1", "traction": [-factor * force(low), 0, 0]}]},
        ).converged()  # fmt: skip
        bent.problem.system.linearise()
        assert unstable_modes(bent.problem.system) == expected


@pytest.mark.parametrize("reduction", ["axisymmetric", "3d"])
def test_signs_of_moments_on_circles(reduction: str) -> None:
    """A positive one lifts the outside of the rim towards the top, so the middle sinks: M R^2 / (2 (1 + nu) D)."""
    moment, D = 1e-11, rigidity(RUBBER, T)
    bent = Bent(
        DISC, T, model={"reduction": reduction}, supports=[{"where": "rim", "fix": ["z"]}],
        discretisation=mesh(3, 0.25),
        loads={"edge_moments": [{"edge": "rim", "moment": moment}]},
    )  # fmt: skip
    assert bent.moved(0.0, 0.0, 0.0)[2] == pytest.approx(-moment / (2 * 1.5 * D), rel=1e-4)


@pytest.mark.parametrize("reduction", ["axisymmetric", "3d"])
def test_signs_of_moments_on_both_edges_of_a_ring(reduction: str) -> None:
    """The same M on both edges is a uniform moment and bends an annulus like a disc: its outer edge, seen from the
    inner one, rises by M (R^2 - r^2) / (2 (1 + nu) D)."""
    moment, D = 1e-11, rigidity(RUBBER, T)
    bent = Bent(
        {"kind": "annulus", "inner_radius": 0.5, "outer_radius": 1.0}, T, model={"reduction": reduction},
        supports=[{"where": "outer", "fix": ["z"]}], discretisation=mesh(3, 0.25),
        loads={"edge_moments": [{"edge": edge, "moment": moment} for edge in ("inner", "outer")]},
    )  # fmt: skip
    assert bent.moved(0.5, 0.0, 0.0)[2] == pytest.approx(-moment * 0.75 / (2 * 1.5 * D), rel=1e-4)


@pytest.mark.parametrize("shape", [STRIP, PLATE], ids=["strip", "plate"])
@pytest.mark.parametrize("edge", ["x0", "x1"])
def test_signs_of_moments_on_straight_edges(shape: Table, edge: str) -> None:
    """Clamped at the other end, the loaded edge of either end rises: M L^2 / (2 D)."""
    moment, up = 1e-11, 1 if shape["kind"] == "strip" else 2
    bent = Bent(
        shape, T, metal(), supports=clamped("x1" if edge == "x0" else "x0"), discretisation=mesh(2, 0.25),
        loads={"edge_moments": [{"edge": edge, "moment": moment}]},
    )  # fmt: skip
    assert bent.moved(float(edge == "x1"), 0.0, 0.0)[up] == pytest.approx(moment / (2 * rigidity(metal(), T)), rel=1e-6)
