"""Every scalar a solve records has its unit in the archive's table, or is a plain number on purpose."""

from __future__ import annotations

from embedding import Ambient, Electrode, Faces, NeoHookean, Scene, Shell, Sphere, Stage, solve
from embedding.archive.units import scalar_unit

PLAIN = {"stretch", "stretch_max", "stretch_min", "volume_ratio", "min_jacobian", "unstable_modes", "remeshings"}


def test_no_scalar_without_its_unit() -> None:
    electrode = Electrode(voltage="50 kV")
    scene = Scene(
        shell=Shell(shape=Sphere(radius="20 mm"), thickness="1 mm", material=NeoHookean(shear_modulus="30 kPa")),
        ambient=Ambient(field="electric"),
        faces=Faces(top=electrode, bottom=electrode),
        path=(Stage(steps=1),),
    )
    names = set(solve(scene).steps[-1].scalars)
    assert {name for name in names if scalar_unit(name) == "1"} == PLAIN
    assert scalar_unit("held_force", per_length=True) == "N/m"
    assert [scalar_unit(name) for name in ("voltage_jump", "charge_body0", "force_body1_x", "torque_z")] == [
        "V", "C", "N", "N m"]  # fmt: skip
    assert [scalar_unit(name) for name in ("potential_body0", "flux_body0")] == ["A", "Wb"]
    assert scalar_unit("torque_z", per_length=True) == "N" and scalar_unit("flux_body0", per_length=True) == "Wb/m"
