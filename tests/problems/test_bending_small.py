"""Shells that bend a little, against closed forms: plates, edge layers of tubes, thickness down to a millionth."""

from __future__ import annotations

import pytest

from problems.exact import plates
from problems.exact.edge_bending import Tube
from tests.bent import DISC, ONE_STEP, RUBBER, Bent, Table, clamped, mesh, metal, rigidity, young
from tests.problems.measures import orders

THIN = 1e-3
METALS: tuple[Table, ...] = (metal(0.3), RUBBER)


@pytest.mark.parametrize("material", METALS, ids=["metal", "rubber"])
@pytest.mark.parametrize("reduction", ["axisymmetric", "3d"])
@pytest.mark.parametrize("kind", ["clamped", "pinned"])
def test_disc_under_uniform_load(material: Table, reduction: str, kind: str) -> None:
    """Off by the load's own nonlinearity and by (T/R)^2, 1e-6 here."""
    D = rigidity(material, THIN)
    load = 1e-6 * D
    bent = Bent(
        DISC, THIN, material, supports=clamped("rim", kind=kind), loads={"surface_force": [0.0, 0.0, load]},
        model={"reduction": reduction}, discretisation=mesh(3, 0.25),
    )  # fmt: skip
    if kind == "clamped":
        exact = plates.clamped_circle(0.0, load, 1.0, D)
    else:
        exact = plates.supported_circle(0.0, load, 1.0, D, young(material)[1])
    assert bent.moved(0.0, 0.0, 0.0)[2] == pytest.approx(exact, rel=3e-4 if reduction == "3d" else 2e-5)


def test_a_plate_converges_with_its_order() -> None:
    """Clamped disc in three dimensions: at least h^2k - 2 at order k, the geometry of the rim included."""
    for order, expected in ((2, 1.7), (3, 3.0)):
        D, errors = rigidity(metal(0.3), THIN), []
        for size in (0.5, 0.25):
            bent = Bent(
                DISC, THIN, metal(0.3), supports=clamped("rim"), loads={"surface_force": [0.0, 0.0, 1e-6 * D]},
                model={"reduction": "3d"}, discretisation=mesh(order, size),
            )  # fmt: skip
            errors.append(abs(bent.moved(0.0, 0.0, 0.0)[2] / plates.clamped_circle(0.0, 1e-6 * D, 1.0, D) - 1.0))
        assert errors[0] / errors[1] > 2**expected


@pytest.mark.parametrize("material", METALS, ids=["metal", "rubber"])
def test_edge_layer_of_a_tube(material: Table) -> None:
    """A radial line force on the end of a long tube decays within sqrt(R T): u = Q / (2 beta^3 D) at the end."""
    thickness = 0.01
    E, nu = young(material)
    force = 1e-9 * E
    bent = Bent(
        {"kind": "cylinder", "radius": 1.0, "length": 2.0}, thickness, material,
        loads={"edge_tractions": [{"edge": "end1", "traction": [0.0, 0.0, force], "frame": "edge"}]},
        supports=[{"where": "end0", "fix": ["z"]}], model={"reduction": "axisymmetric"},
        discretisation=mesh(3, 0.04),
    )  # fmt: skip
    exact = Tube(1.0, thickness, E, nu).free_edge(0.0, force)
    assert bent.moved(1.0, 0.0, 1.0)[0] == pytest.approx(exact, rel=2 * thickness)


RATIOS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)


def waved(ratio: float, shape: Table, locking: str, element: float = 0.5) -> float:
    """Deflection over load E T^3 of a shell that a cos 2 phi load bends without stretching it."""
    size = 1e-4
    load = size * ratio**3
    force = [f"{load!r}*x*(x**2-y**2)", f"{load!r}*y*(x**2-y**2)", "0*x"]
    bent = Bent(
        shape, ratio, metal(0.0), loads={"surface_force": {"expression": force, "unit": "Pa"}}, path=ONE_STEP,
        model={"reduction": "3d"}, discretisation=mesh(3, element, locking=locking),
    )  # fmt: skip
    return float(bent.moved(1.0, 0.0, 0.0)[0] / size)


def test_nothing_locks_on_a_cylinder() -> None:
    """Exact 12/9 for a ring of nu = 0. At one fixed mesh the error is the same from T/R = 1e-2 to 1e-6."""
    tube: Table = {"kind": "cylinder", "radius": 1.0, "length": 1.0}
    errors = [abs(waved(ratio, tube, "auto") / (12.0 / 9.0) - 1.0) for ratio in RATIOS]
    assert max(errors) < 2.0 * min(errors)
    assert max(errors) < 2e-3
    assert waved(1e-3, tube, "as it is") < 0.7 * 12.0 / 9.0, "what the cure is for"


def test_nothing_locks_on_a_hemisphere() -> None:
    """Free at its rim it bends without stretching, too; edge layers of width sqrt(R T) fade from T/R = 1e-3 on."""
    dome: Table = {"kind": "hemisphere", "radius": 1.0}
    deflections = [waved(ratio, dome, "auto") for ratio in RATIOS[1:]]
    fine = Bent(
        dome, RATIOS[1], metal(0.0), path=ONE_STEP, model={"reduction": "3d"}, discretisation=mesh(4, 0.2),
        loads={"surface_force": {"expression": [f"{1e-4 * RATIOS[1] ** 3!r}*x*(x**2-y**2)",
                                                f"{1e-4 * RATIOS[1] ** 3!r}*y*(x**2-y**2)", "0*x"], "unit": "Pa"}},
    ).moved(1.0, 0.0, 0.0)[0] / 1e-4  # fmt: skip
    errors = [abs(deflection / fine - 1.0) for deflection in deflections]
    assert max(errors) < 2.0 * min(errors)
    assert max(errors) < 0.1
    assert waved(1e-4, dome, "as it is") < 0.2 * fine, "what the cure is for"


def test_a_hemisphere_bends_as_rayleigh_says() -> None:
    """Without stretching there is one motion with two waves: outwards A (2 + cos f) tan^2(f/2) at the angle f from the
    pole, with the energy 21 pi D (1 - nu) A^2 (Lord Rayleigh, Proc. London Math. Soc. 13 (1881) 4). The load does the
    work 3/5 pi p A, so that w = 12/35 p R^4 / (E T^3) at the rim for nu = 0. The rim's edge layer adds a part
    O((T/R)^(1/2)), and where it is thinner than an element a part O(h): order one, from above."""
    dome: Table = {"kind": "hemisphere", "radius": 1.0}
    errors = [waved(1e-6, dome, "auto", size) / (12.0 / 35.0) - 1.0 for size in (0.4, 0.2, 0.1)]
    assert 0.0 < errors[2] < 8e-3
    assert orders((0.4, 0.2, 0.1), errors) == pytest.approx([1.0, 1.0], abs=0.25)
