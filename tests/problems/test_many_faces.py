"""Closed shells whose geometry is several faces: one inside, one volume, and the pressure of membrane theory."""

from __future__ import annotations

import math

import numpy as np
import pytest

from embedding import Cylinder, Discretisation, Model, NeoHookean, Scene, Shell, Solution, Stage, Torus, solve

MODULUS, THICKNESS = 1e5, 1e-3
RADIUS, TUBE = 0.1, 0.03


def inflated(
    shape: Torus | Cylinder, ratio: float, model: Model, *, order: int = 3, size: float | None = None
) -> Solution:
    return solve(
        Scene(
            shell=Shell(shape=shape, thickness=THICKNESS, material=NeoHookean(shear_modulus=MODULUS)),
            path=(Stage(steps=1, volume_ratio=ratio),),
            model=model,
            discretisation=Discretisation(order=order, shell_size=size),
        )
    )


def linear_torus_pressure(ratio: float) -> float:
    """Pressure at a small change of volume, by the membrane forces of a torus (Fluegge, Stresses in Shells, chapter 2).

    N_phi = p a (r + R) / 2r around the tube and N_theta = p a / 2 along it are in equilibrium whatever the material.
    The change of volume per pressure is the integral of N C N over the surface, with E = 3 mu and Poisson's ratio 1/2.
    """
    angles = 2 * math.pi * (np.arange(200) + 0.5) / 200
    r = RADIUS + TUBE * np.cos(angles)
    around, along = TUBE / 2 * (r + RADIUS) / r, TUBE / 2
    density = (around**2 + along**2 - around * along) / (3 * MODULUS * THICKNESS)
    compliance = float((density * 2 * math.pi * r).mean() * 2 * math.pi * TUBE)
    return (ratio - 1) * 2 * math.pi**2 * RADIUS * TUBE**2 / compliance


@pytest.mark.parametrize(("reduction", "symmetry"), [("axisymmetric", "auto"), ("3d", "auto"), ("3d", "none")])
def test_a_torus(reduction: str, symmetry: str) -> None:
    """Within the change of shape, of order 1e-3, of the linear membrane."""
    torus, model = Torus(radius=RADIUS, tube_radius=TUBE), Model(reduction=reduction, symmetry=symmetry)  # type: ignore[arg-type]
    scalars = inflated(torus, 1.001, model, order=2 if symmetry == "none" else 3).steps[-1].scalars
    assert scalars["volume_ratio"] == pytest.approx(1.001, rel=1e-9)
    assert scalars["pressure_difference"] == pytest.approx(linear_torus_pressure(1.001), rel=2e-3)


def test_a_capped_cylinder() -> None:
    """Flat caps bulge almost freely at first: hardly any pressure, but outwards, and the caps take up the volume."""
    cylinder = Cylinder(radius=0.1, length=0.2, ends="capped")
    scalars = inflated(cylinder, 1.005, Model()).steps[-1].scalars
    assert scalars["volume_ratio"] == pytest.approx(1.005, rel=1e-9)
    assert 0 < scalars["pressure_difference"] < 1e-4 * MODULUS * THICKNESS / 0.1
