"""The scene that is timed: the charged balloon at several mesh sizes, in 3D an octant."""

from __future__ import annotations

from embedding import Ambient, Discretisation, Electrode, Faces, Model, NeoHookean, Scene, Shell, Solver, Sphere, Stage

RADIUS = 0.02
VOLTAGE = 3.5e5


def balloon(
    *,
    shell_size: float,
    ambient_size: float = 2.0,
    interface: str = "auto",
    steps: int = 4,
    linear: str = "auto",
    reduction: str = "3d",
) -> Scene:
    """A charged balloon at order 3, in 3D by default; mesh sizes relative to the radius."""
    shell = Shell(shape=Sphere(radius=RADIUS), thickness=1e-3, material=NeoHookean(shear_modulus=3e4))
    return Scene(
        shell=shell,
        ambient=Ambient(field="electric"),
        faces=Faces(top=Electrode(voltage=VOLTAGE), bottom=Electrode(voltage=VOLTAGE)),
        path=(Stage(steps=steps),),
        model=Model(reduction=reduction, interface=interface),
        discretisation=Discretisation(order=3, shell_size=shell_size * RADIUS, ambient_size=ambient_size * RADIUS),
        solver=Solver(linear=linear),
    )
