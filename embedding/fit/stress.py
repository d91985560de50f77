"""Nominal stress of an incompressible law in the three kinds of test, by the law the solver itself uses."""

from __future__ import annotations

from typing import Any

from embedding.fit.measurements import Mode
from embedding.shell.laws import Law


def nominal_stress(law: Law, mode: Mode, stretch: Any) -> Any:
    """Force per undeformed area along ``stretch``, number or array, in the units of ``law``.

    Second in-plane stretch: stretch^(-1/2) in uniaxial tension, the same stretch in equibiaxial tension, and 1 in
    pure shear (Treloar, The Physics of Rubber Elasticity, ch. 5).
    """
    second = {"uniaxial": stretch**-0.5, "equibiaxial": stretch, "pure-shear": 0 * stretch + 1}[mode]
    return law.principal_stresses(stretch, second)[0] / stretch
