"""Published Cauchy stresses of a sheet in uniaxial tension: the table's ten digits are what is compared."""

from __future__ import annotations

import numpy as np
import pytest

from problems import uniaxial_tension


@pytest.mark.parametrize("law", uniaxial_tension.MATERIALS)
def test_published_stresses(law: str) -> None:
    solution = uniaxial_tension.run(law)
    assert solution.scene.shell.material.shear_modulus == pytest.approx(1.5e6, rel=1e-15)
    assert len(solution.steps) == len(uniaxial_tension.STRETCHES)
    assert np.abs(solution["stretch_max"] / uniaxial_tension.STRETCHES - 1).max() < 1e-9
    assert uniaxial_tension.error(solution, law) < 1e-9
