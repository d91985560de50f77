"""Remanent shells and the field around them: closed, with and without poles, and open."""

from __future__ import annotations

from embedding.scene.scales import MU_0
from problems import magnetised_disc, magnetised_sphere
from problems.magnetised_sphere import ALONG_NORMAL, FINE, at
from tests.problems.measures import orders


def test_uniform_remanence() -> None:
    """A dipole outside, to the mesh; in the cavity what is left is of second order in the thickness."""
    ratios = (0.1, 0.05)
    found = [magnetised_sphere.run(at(ratio), *FINE)[1] for ratio in ratios]
    assert max(fields.outside for fields in found) < 1e-4
    assert min(orders(ratios, [fields.cavity for fields in found])) > 1.85
    assert found[1].cavity < 1e-3


def test_remanence_along_the_normal() -> None:
    """No field on either side: to the mesh by default, to rounding on a fine one."""
    solution, coarse = magnetised_sphere.run(ALONG_NORMAL)
    assert coarse.outside < 2e-5 and coarse.cavity < 3e-3
    assert max(magnetised_sphere.run(ALONG_NORMAL, *FINE)[1]) < 1e-8
    assert abs(solution["force_z"][-1]) < 1e-6


def test_disc() -> None:
    """The field of a ring current: to the mesh, whatever the size of the elements at the rim, which carry it."""
    solution, default = magnetised_disc.run()
    assert default.thick < 5e-4
    current = magnetised_disc.REMANENCE / MU_0 * solution.scene.shell.thickest
    assert abs(solution["force_z"][-1]) < 1e-3 * MU_0 * current**2, "no force from its own field"
    for thicknesses in (6.0, 1.0, 0.5):
        size = 1e3 * thicknesses * solution.scene.shell.thickest
        assert magnetised_disc.run(f"discretisation.edge_size={{rim='{size} mm'}}")[1].thick < 5e-4
    assert magnetised_disc.run("discretisation.order=4")[1].thick < 2e-4
