"""Assembly of a bent surface, many elements at once and by symbolic forms: ms an element of one linearisation, 3D.

A hemisphere with a hole, of small strains; membrane strains are interpolated. "rest" is what assembly takes
beside its three energies: condensation, and the sum over elements. One thread. Target: half of the symbolic assembly.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from ngsolve import BND, BilinearForm, Variation

from benchmarks.newton_step import seconds
from embedding import Discretisation, Hemisphere, Model, Scene, Shell, StVenantKirchhoff
from embedding.coupling.elementwise import ElementwiseForm
from embedding.coupling.system import System
from embedding.plan import explain
from embedding.solving.problem import Problem

ELEMENT = 0.1
"""Size of the elements over the radius."""
PARTS = ("membrane", "bending", "edges", "rest", "assembly", "residual")
Times = dict[str, float]


def hemisphere(order: int) -> System:
    """The system of the hemisphere at rest."""
    metal = StVenantKirchhoff(youngs_modulus=6.825e7, poisson_ratio=0.3)
    scene = Scene(
        shell=Shell(shape=Hemisphere(radius=10.0, hole_half_angle=np.radians(18)), thickness=0.04, material=metal),
        model=Model(reduction="3d"),
        discretisation=Discretisation(order=order, shell_size=ELEMENT * 10.0),
    )
    system = Problem(scene, explain(scene)).system
    system.load(0.1, 0.0, None)
    return system


def symbolic(system: System) -> Times:
    """Seconds of the symbolic forms: of each energy on its own, and of all together."""
    unknowns, state = system.unknowns, system.unknowns.state.vec
    out = state.CreateVector()

    def assembling(form: Any) -> Callable[[], object]:
        form.Apply(state, out)  # without it NGSolve leaves out a part of the interpolated strain's second derivative
        return lambda: form.AssembleLinearization(state)

    bending, kinematics = unknowns.bending, system.lagrangian.kinematics(unknowns.trial)
    membrane = system.lagrangian.membrane
    if membrane is None or bending is None:
        raise RuntimeError("the timed shell bends")
    stretched = membrane.energy(kinematics, kinematics)  # small strains do not ask for the state
    bent, rest, edges, *_ = bending.energies(unknowns.trial, kinematics, 1.0)
    times = {}
    for name, terms in (("membrane", [stretched * membrane.integral]), ("bending", [bent, rest]), ("edges", [edges])):
        form = BilinearForm(unknowns.space, symmetric=True)
        for term in terms:
            form += Variation(term).Compile()
        times[name] = seconds(assembling(form))
    joint = system.lagrangian.joint_form()
    times["assembly"] = seconds(assembling(joint))
    times["residual"] = seconds(lambda: joint.Apply(state, out))
    return times


def together(system: System) -> Times:
    """Seconds of the elements assembled many at once."""
    form, state = system.form, system.unknowns.state.vec
    if not isinstance(form, ElementwiseForm) or system.unknowns.bending is None:
        raise RuntimeError("the timed shell is assembled many elements at once")
    out, memory, parts = state.CreateVector(), system.unknowns.bending.memory, form.shell.parts
    at = [part.unknowns(np.array(state.FV().NumPy())) for part in parts]
    return {
        "membrane": seconds(lambda: [p.membrane.matrix(u, None) for p, (u, _) in zip(parts, at, strict=True)]),
        "bending": seconds(lambda: [p.bending.matrices(p.places + u, m) for p, (u, m) in zip(parts, at, strict=True)]),
        "edges": seconds(
            lambda: [p.edges.matrices(p.places + u, m, p.frame(memory)) for p, (u, m) in zip(parts, at, strict=True)]
        ),
        "assembly": seconds(lambda: form.AssembleLinearization(state)),
        "residual": seconds(lambda: form.Apply(state, out)),
    }


def measure(order: int) -> Iterator[str]:
    """The lines of one order."""
    system = hemisphere(order)
    elements = system.domain.mesh.GetNE(BND)
    before, now = symbolic(system), together(system)
    for times in (before, now):
        times["rest"] = times["assembly"] - sum(times[name] for name in ("membrane", "bending", "edges"))
    load = system.unknowns.state.vec.CreateVector()
    load.FV().NumPy()[:] = 1.0

    def solving() -> None:
        system._solver.factor(system.form)
        system.solve(load)

    system.linearise()
    solve = seconds(solving)
    yield f"order {order}, {elements} triangles; factor and solve {1e3 * solve / elements:.3f}"
    for name in PARTS:
        a, b = (1e3 * times[name] / elements for times in (before, now))
        ratio = "" if name == "rest" else f"   ratio {a / b:5.1f}"
        yield f"  {name:9s} symbolic {a:6.3f}   together {b:6.3f}{ratio}"


def report() -> Iterator[str]:
    """The table, line by line."""
    for order in (1, 2, 3, 4):
        yield from measure(order)


if __name__ == "__main__":
    print(__doc__)
    for line in report():
        print(line, flush=True)
