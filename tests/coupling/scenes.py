"""Small coupled scenes in every reduction, with every kind of electrodes, as problems at a distorted state."""

from __future__ import annotations

from typing import Any

import numpy as np

from embedding import (
    Ambient,
    Discretisation,
    Electrode,
    Faces,
    InfiniteCylinder,
    Loads,
    Model,
    NeoHookean,
    PressureField,
    Scene,
    Shell,
    Sphere,
    Stage,
    explain,
)
from embedding.solving.problem import Problem
from tests.forms import set_on_shell, smooth

R = 0.02
MODULUS = 1e5
VOLT = R * (MODULUS / 8.8541878128e-12) ** 0.5
"""The voltage whose Maxwell stress over a shell radius is of the size of the modulus."""
FACES = {
    "conductor": (0.5, 0.5),
    "film": (0.1, 0.15),
    "top": (0.4, None),
    "bottom": (None, 0.4),
    "bare": (None, None),
}


def coupled(
    reduction: Any = "axisymmetric",
    faces: str = "conductor",
    interface: Any = "auto",
    *,
    symmetry: Any = "auto",
    varying: bool = False,
    controlled: bool = False,
    order: int = 2,
    size: float = 0.6,
    **parts: Any,
) -> Problem:
    """A sphere, or in plane strain a tube, in a field."""
    plane = reduction == "plane-strain"
    top, bottom = FACES[faces]
    voltages = {"top": top, "bottom": bottom}
    field = {"axisymmetric": (0, 0, 0.3), "3d": (0, 0, 0.3), "plane-strain": (0.3, 0, 0)}[reduction]
    pressure = PressureField(expression=f"1e4 + 2e4 * (z / {R})**2 + 1e4 * (x**2 + y**2) / {R * R}")
    if plane:
        pressure = PressureField(expression=f"1e4 + 2e4 * (x / {R})**2")
    scene = Scene(
        shell=Shell(
            shape=InfiniteCylinder(radius=R, axial_stretch=1.1) if plane else Sphere(radius=R),
            thickness=0.1 * R,
            material=NeoHookean(shear_modulus=MODULUS),
            relative_permittivity=3.0,
        ),
        loads=Loads(pressure_bottom=pressure if varying else 1e4, pressure_top=2e3),
        ambient=Ambient(
            field="electric",
            outer="grounded" if plane else "free-space",
            applied_field=tuple(c * VOLT / R for c in field) if faces == "bare" else (0, 0, 0),
        ),
        faces=Faces(**{name: Electrode(voltage=v * VOLT) for name, v in voltages.items() if v is not None}),
        path=(Stage(volume_ratio=1.5 if controlled else None),),
        model=Model(reduction=reduction, interface=interface, symmetry=symmetry),
        discretisation=Discretisation(order=order, shell_size=size * R),
        **parts,
    )
    return Problem(scene, explain(scene))


def distort(problem: Problem, amount: float = 0.15, volume: float | None = None) -> None:
    """Put the shell, its faces, the ambient and the potential of ``problem`` into a distorted state under load."""
    system = problem.system
    system.load(0.6, 0.8, volume, None if volume is not None else -0.05)
    unknowns = system.unknowns
    set_on_shell(unknowns.field("u"), smooth(problem.domain, amount), unknowns.trace.free, problem.domain)
    system.place_faces()
    assert system.follow()
    if system.potential is not None:
        system.potential.solve()
    rng = np.random.default_rng(11)
    for name in unknowns.names:
        if name.startswith(("tau", "rigid", "pressure")):
            vector = unknowns.field(name).vec.FV().NumPy()
            vector[:] = 0.05 * rng.uniform(-1, 1, len(vector))
