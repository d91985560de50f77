"""Face tractions against exact fields around rigidly held shells: pressures, tangential tractions, resultants."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from ngsolve import CF, ET, IntegrationRule

from embedding import (
    Ambient,
    Discretisation,
    Electrode,
    Faces,
    InfiniteCylinder,
    Model,
    NeoHookean,
    Scene,
    Shell,
    Sphere,
    Stage,
    Support,
)
from embedding.scene.scales import EPSILON_0, MU_0
from embedding.solving import Listener, Solution, run
from embedding.solving.events import StepRecord
from embedding.solving.state import State
from problems.exact.permeable_cylinder import PermeableCylinder
from problems.exact.permeable_sphere import PermeableSphere
from problems.exact.three_regions import ThreeRegions
from tests.forms import Array

R, T = 0.02, 0.002
HELD = (Support(where="surface", fix=("x", "y", "z")),)
MATERIAL = NeoHookean(shear_modulus=1e5)


class Last(Listener):
    """Keeps the last accepted state."""

    state: State

    def accepted(self, state: State, record: StepRecord) -> None:
        self.state = state


def held(shape: Any, **parts: Any) -> tuple[Solution, State]:
    """Solve the field around a shell whose mid-surface is held."""
    properties = {name: parts.pop(name) for name in ("relative_permittivity", "relative_permeability") if name in parts}
    scene = Scene(
        shell=Shell(shape=shape, thickness=T, material=MATERIAL, **properties),
        supports=HELD,
        path=(Stage(steps=1),),
        **parts,
    )
    last = Last()
    solution = run(scene, [last])
    assert solution.result.ok, solution.message
    return solution, last.state


@pytest.mark.parametrize("interface", ["auto", "opened", "closed"])
@pytest.mark.parametrize("reduction", ["axisymmetric", "3d"])
def test_suction_on_a_conductor(reduction: Any, interface: Any) -> None:
    """p_t = - eps (V / b)^2 / 2 on the outer face, nothing on the inner one; b is where the interface puts the face."""
    voltage, b = 2e3, R if interface == "closed" else R + T / 2
    solution, _ = held(
        Sphere(radius=R),
        ambient=Ambient(field="electric"),
        faces=Faces(top=Electrode(voltage=voltage), bottom=Electrode(voltage=voltage)),
        model=Model(reduction=reduction, interface=interface),
    )
    top, bottom = (float(values[-1]) for values in solution.pressures)
    exact = -0.5 * EPSILON_0 * (voltage / b) ** 2
    assert top == pytest.approx(exact, rel=3e-3)
    assert bottom == pytest.approx(0.0, abs=1e-6 * abs(exact))
    assert solution["charge"][-1] == pytest.approx(4 * math.pi * EPSILON_0 * b * voltage, rel=1e-3)


BODIES: dict[str, tuple[Any, Any, tuple[float, float, float], type[ThreeRegions]]] = {
    "axisymmetric": (Sphere(radius=R), Model(), (0.0, 0.0, 1e4), PermeableSphere),
    "octant": (Sphere(radius=R), Model(reduction="3d"), (1e4, 0.0, 0.0), PermeableSphere),
    "quarter ring": (InfiniteCylinder(radius=R), Model(), (0.0, 1e4, 0.0), PermeableCylinder),
    "ring": (InfiniteCylinder(radius=R), Model(symmetry="none"), (6e3, 8e3, 0.0), PermeableCylinder),
}


def fields_on_the_shell(state: State, *names: str) -> tuple[Array, dict[str, Array]]:
    """Directions from the centre (n, 3) and the named fields at points of the shell."""
    problem = state.problem
    rule = IntegrationRule(ET.TRIG if problem.mesh.dim == 3 else ET.SEGM, 3)
    points = problem.mesh.MapToAllElements(rule, problem.blocks["shell"].region)
    place = problem.embed(np.asarray(problem.reduction.position(points)))
    values = {
        f.name: np.asarray(CF(f.values)(points)) for f in state.fields() if f.block == "shell" and f.name in names
    }
    vectors = {name: problem.embed_vector(v) if v.shape[1] > 1 else v.ravel() for name, v in values.items()}
    return place / np.linalg.norm(place, axis=1)[:, None], vectors


@pytest.mark.parametrize("name", [pytest.param(n, marks=pytest.mark.slow) if n == "octant" else n for n in BODIES])
def test_all_four_tractions_on_a_permeable_shell(name: str) -> None:
    """Pressures and tangential tractions on both faces, mu_r = 10, T/R = 0.1, against the exact three regions."""
    shape, model, field, regions = BODIES[name]
    _, state = held(
        shape,
        relative_permeability=10.0,
        ambient=Ambient(field="magnetic", applied_field=field),
        model=model,
        discretisation=Discretisation(shell_size=0.2 * R),
    )
    strength = float(np.linalg.norm(field))
    exact = regions(R - T / 2, R + T / 2, 10.0, applied_field=strength, permeability=MU_0)
    n, got = fields_on_the_shell(state, "p_t", "p_b", "t_t", "t_b")
    along = np.array(field) / strength
    cosine = n @ along
    tractions = [exact.tractions(float(math.acos(c))) for c in cosine]
    # e_theta points away from the field
    away = (cosine[:, None] * n - along) / np.sqrt(1 - cosine**2)[:, None]
    scale = MU_0 * strength**2
    assert np.abs(got["p_t"] - [t.p_t for t in tractions]).max() < 0.02 * scale
    assert np.abs(got["p_b"] - [t.p_b for t in tractions]).max() < 0.02 * scale
    assert np.abs(got["t_t"] - np.array([t.tau_t for t in tractions])[:, None] * away).max() < 0.02 * scale
    assert np.abs(got["t_b"] - np.array([t.tau_b for t in tractions])[:, None] * away).max() < 0.02 * scale


@pytest.mark.parametrize("reduction", ["axisymmetric", "3d"])
@pytest.mark.parametrize("voltage", [0.0, 500.0])
def test_force_on_a_charge(voltage: float, reduction: Any) -> None:
    """A conductor of charge Q in a field E0: the resultant is Q E0."""
    field = 2e4
    solution, _ = held(
        Sphere(radius=R),
        ambient=Ambient(field="electric", applied_field=(0.0, 0.0, field)),
        faces=Faces(top=Electrode(voltage=voltage), bottom=Electrode(voltage=voltage)),
        model=Model(reduction=reduction),
    )
    scale = 4 * math.pi * EPSILON_0 * R * R * field**2
    if "force_z" in solution.steps[-1].scalars:  # on a mirror plane nothing can pull across it
        assert solution["force_z"][-1] == pytest.approx(solution["charge"][-1] * field, abs=1e-3 * scale)
    else:
        assert voltage == 0.0
    if voltage:
        assert solution["force_z"][-1] > 0.5 * scale
