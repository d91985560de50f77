"""Unstable modes with a field: the count of pivots against eigenvalues of the shell's own reduced stiffness, in which
the field follows the shell, and against the energy of displaced states."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.linalg import null_space

from embedding import Scene
from embedding.ambient.sources import Electrodes, Source
from embedding.bench.extremes.fields import balloon_voltage, charged
from embedding.coupling.lagrangian import ANCHOR
from embedding.coupling.system import System
from embedding.solving.driver import Run, run
from embedding.solving.stability import unstable_modes
from tests.coupling.scenes import coupled, distort

pytestmark = pytest.mark.usefixtures("unestimated")

Array = Any
R, MU = 0.02, 3e4


def reduced_stiffness(system: System) -> tuple[Array, Array]:
    """The stiffness of the shell alone, by dense elimination in the order of the physics, and a basis of the motions
    that the multipliers allow: the field follows the faces, the faces follow the mid-surface (without the anchors)."""
    matrix = system.tangent()[0].toarray()
    names = np.concatenate([np.full(system.unknowns.field(name).vec.size, name) for name in system.unknowns.names])
    names = names[np.array(system.unknowns.free(system._held))]

    def block(rows: tuple[str, ...], columns: tuple[str, ...]) -> Array:
        return matrix[np.isin(names, rows)][:, np.isin(names, columns)]

    field, faces = ("phi", "jump"), tuple(system.unknowns.moved_by(face) for face in system.unknowns.opened)
    tau = tuple(f"tau_{face}" for face in system.unknowns.opened)
    moving = ("u", "axial")
    size = len(block(moving, moving))
    own = block((*moving, *faces), (*moving, *faces))
    if np.isin(names, field).any():
        assert np.linalg.eigvalsh(block(field, field)).max() < 0.0
        own = own - block((*moving, *faces), field) @ np.linalg.solve(
            block(field, field), block(field, (*moving, *faces))
        )
    if faces:
        pairing = block(tau, faces)
        assert abs(pairing - pairing.T).max() < 1e-12
        own[size:, size:] -= ANCHOR * pairing
        carried = np.vstack([np.eye(size), -np.linalg.solve(pairing, block(tau, moving))])
        own = carried.T @ own @ carried
    held = block(tuple(name for name in system.unknowns.names if name.startswith(("rigid", "pressure"))), moving)
    return (own + own.T) / 2, null_space(held) if len(held) else np.eye(size)


def negatives(system: System) -> int:
    stiffness, allowed = reduced_stiffness(system)
    return int((np.linalg.eigvalsh(allowed.T @ stiffness @ allowed) < 0.0).sum())


CASES = [
    ("axisymmetric", "conductor", "closed", False),
    ("axisymmetric", "conductor", "opened", True),
    ("axisymmetric", "film", "opened", False),
    ("axisymmetric", "bare", "closed", True),
    ("axisymmetric", "bare", "opened", False),
    ("plane-strain", "top", "opened", False),
    ("plane-strain", "bare", "closed", False),
    ("3d", "conductor", "closed", True),
    ("3d", "bottom", "opened", False),
    ("3d", "bare", "opened", True),
]


def counted(system: System, monkeypatch: pytest.MonkeyPatch) -> int | None:
    """Unstable modes, the same by elimination and, where few unknowns move, from the inverse."""
    counts = []
    for few in (0, 100):
        monkeypatch.setattr("embedding.coupling.system.FEW", few)
        counts.append(unstable_modes(system))
    assert counts[0] == counts[1]
    return counts[0]


@pytest.mark.parametrize(("reduction", "faces", "interface", "controlled"), CASES)
def test_at_any_state(
    reduction: str, faces: str, interface: str, controlled: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Distorted and compressed, not in equilibrium: some modes are unstable, and as many are counted."""
    problem = coupled(reduction, faces, interface, controlled=controlled, size=0.9)
    counts = set()
    for amount in (0.02, -0.05, -0.15):
        distort(problem, amount, 1.2 if controlled else None)
        problem.system.linearise()
        count = counted(problem.system, monkeypatch)
        assert count == negatives(problem.system)
        counts.add(count)
    assert len(counts) > 1, "the test tells states apart"


GIVEN_CHARGES = {
    "one conductor": Electrodes(top=Source(charge=2.0), joined=True),
    "both faces": Electrodes(top=Source(charge=2.0), bottom=Source(charge=-1.0)),
    "one of two faces": Electrodes(top=Source(charge=2.0), bottom=Source(voltage=0.3)),
}


@pytest.mark.parametrize("charged", GIVEN_CHARGES)
@pytest.mark.parametrize("reduction", ["axisymmetric", "3d"])
def test_at_given_charges(reduction: str, charged: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The potential that answers to a charge is one more unknown in which the energy is greatest."""
    problem = coupled(reduction, "film", "opened", size=0.9)
    physics = problem.system.physics
    assert physics.field is not None
    field = replace(physics.field, electrodes=GIVEN_CHARGES[charged])
    problem.system = System(problem.domain, replace(physics, field=field))
    counts = set()
    for amount in (0.02, -0.15):
        distort(problem, amount)
        problem.system.linearise()
        count = counted(problem.system, monkeypatch)
        assert count == negatives(problem.system)
        counts.add(count)
    assert len(counts) > 1


BALLOON: dict[str, Any] = {
    "shell": {
        "shape": {"kind": "sphere", "radius": R},
        "thickness": 0.05 * R,
        "material": {"law": "neo-hookean", "shear_modulus": MU},
    },
    "discretisation": {"order": 2, "shell_size": R / 3},
}
GROUNDED: dict[str, Any] = {
    "scene": {
        "ambient": {"field": "electric", "outer": "grounded", "radius": 4 * R},
        "faces": {"top": {"voltage": 4e5}, "bottom": {"voltage": 4e5}},
    }
}
MAGNETISED: dict[str, Any] = {
    "scene": {
        "shell": {**BALLOON["shell"], "relative_permeability": 4.0},
        "ambient": {"field": "magnetic", "applied_field": [0.0, 0.0, 2e4]},
        "loads": {"pressure_bottom": 0.075 * MU},
    },
    "before": [{"mechanical": 0.6, "field": 0.0}, {"mechanical": 0.6}],
}


def at_pole(stretch: float, **changes: Any) -> dict[str, Any]:
    return {"until": {"where": [0.0, 0.0, R], "axis": "z", "value": (stretch - 1) * R}, **changes}


def stopped(parts: dict[str, Any], stretches: tuple[float, ...], interface: str, reduction: str) -> list[System]:
    """The system at each of the ends in turn."""
    systems = []
    for stretch in stretches:
        path = [*parts.get("before", []), at_pole(stretch)]
        model = {"interface": interface, "reduction": reduction}
        made = Run(Scene.from_table({**BALLOON, **parts["scene"], "path": path, "model": model}), [])
        solution = made.solve()
        assert solution.result.ok, solution.message
        made.problem.system.linearise()  # the last tangent may be that of a critical point
        assert solution.steps[-1].scalars["unstable_modes"] == negatives(made.problem.system)
        systems.append(made.problem.system)
    return systems


@pytest.mark.parametrize("interface", ["closed", "opened"])
@pytest.mark.parametrize("parts", [GROUNDED, MAGNETISED], ids=["grounded", "magnetised"])
def test_both_sides_of_a_limit_point(parts: dict[str, Any], interface: str) -> None:
    """Pull-in of the conductor at a stretch of 1.6; the pressure's maximum of a permeable balloon in a fixed field."""
    below, above = stopped(parts, (1.3, 1.7), interface, "axisymmetric")
    assert (negatives(below), negatives(above)) == (0, 1)


@pytest.mark.slow
def test_both_sides_in_3d() -> None:
    """The meshed octant allows the sphere's own mode."""
    below, above = stopped(GROUNDED, (1.3, 1.68), "closed", "3d")
    assert (negatives(below), negatives(above)) == (0, 1)


def curvature_of_energy(system: System, mode: Array, step: float) -> float:
    """Second difference of the potential energy along ``mode``, with the interior moved and the field solved anew."""
    lagrangian, unknowns = system.lagrangian, system.unknowns
    values = {name: unknowns.field(name) for name in unknowns.names}
    where, free = unknowns.range("u"), np.array(unknowns.free())[unknowns.range("u")]
    saved, energies = system.save(), []
    for sign in (-1.0, 0.0, 1.0):
        system.restore(saved)
        unknowns.state.vec.FV().NumPy()[where][free] += sign * step * mode
        assert system.follow()
        assert system.potential is not None
        system.potential.solve()
        energies.append(lagrangian.elastic_energy(values) - system.potential.energy())
    system.restore(saved)
    return (energies[0] - 2 * energies[1] + energies[2]) / step**2


def test_the_interior_that_newton_freezes_is_an_error_of_the_mesh() -> None:
    """The matrix knows nothing of the motion of the interior, the energy does: both have the same curvature, the less
    than nothing beyond pull-in included. The rest is that of a mesh of second order with three elements a quadrant."""
    for system in stopped(GROUNDED, (1.3, 1.7), "closed", "axisymmetric"):
        stiffness, allowed = reduced_stiffness(system)
        values, modes = np.linalg.eigh(allowed.T @ stiffness @ allowed)
        for number in (0, 2):
            curvature = curvature_of_energy(system, allowed @ modes[:, number], 1e-3)
            assert curvature == pytest.approx(values[number], rel=1e-5)


@pytest.mark.estimated
@pytest.mark.slow
def test_soft_modes_beside_robins_condition() -> None:
    """A charged membrane bears the pull of its field by tension alone, as a drop at Rayleigh's limit (Phil. Mag. 14
    (1882) 184) that rubber holds a little: it is stable at every voltage. Robin's condition too near tips its softest
    mode over, and the solution says so; the infinite map does not."""
    path = [{"until": {"where": [0, 0, R], "axis": "z", "value": 1.3 * R}}]
    table = charged({"voltage": balloon_voltage(5.3)}, path=path)
    for far_field, count in (("robin", 1), ("infinite", 0)):
        model = {"interface": "closed", "far_field": far_field}
        solution = run(Scene.from_table({**table, "model": model}))
        assert solution.result.ok and len(solution.critical_points) == count
        told = [one for one in solution.assumptions if one.topic == "stability"]
        assert [one.held for one in told] == [False] * count
