"""Spaces of the shell's unknowns: where their functions live, what is held, and how they number their unknowns."""

from __future__ import annotations

import numpy as np
import pytest
from ngsolve import BND, CF, BitArray, Grad, GridFunction, Integrate, dx

from embedding.geometry.spaces import TraceSpace, as_bits, as_mask, scalar_mask
from tests.forms import body

NAMES = ("octant", "axisymmetric sphere", "ring")


def test_masks_and_bits() -> None:
    mask = np.array([True, False, False, True, True])
    bits = as_bits(mask)
    assert isinstance(bits, BitArray) and len(bits) == 5 and bits.NumSet() == 3
    assert np.array_equal(as_mask(bits), mask)


@pytest.mark.parametrize("name", NAMES)
def test_reach(name: str) -> None:
    """A field of ones on the shell: in the elements of its reach it fades, elsewhere it is zero."""
    domain = body(name, 0.5, 2, radius=3.0)

    def volume_energy(space: TraceSpace, side: str) -> float:
        field = GridFunction(space.space)
        field.Set(CF(1.0), BND, definedon=domain.shell)
        assert domain.shell_integral(field) == pytest.approx(domain.shell_integral(1.0))
        return float(Integrate(Grad(field) * Grad(field) * dx(domain.materials(side)), domain.mesh))

    spaces = {
        reach: TraceSpace(domain.mesh, 2, vector=False, reach=reach) for reach in ("", "outside.*", "inside.*", "shell")
    }
    sides = ("outside", "inside")
    seen = {reach: tuple(volume_energy(space, side) > 0 for side in sides) for reach, space in spaces.items()}
    assert seen == {"": (True, True), "outside.*": (True, False), "inside.*": (False, True), "shell": (False, False)}


@pytest.mark.parametrize("name", NAMES)
def test_numbering_does_not_depend_on_the_reach(name: str) -> None:
    domain = body(name, 0.5, 3, radius=3.0)
    trace = TraceSpace(domain.mesh, 3)
    place = domain.reduction.position
    fields = [GridFunction(space) for space in (trace.space, trace.reaching("shell"), trace.reaching("outside.*"))]
    for field in fields:
        field.Set(place * place[0], BND, definedon=domain.shell)
    for other in fields[1:]:
        assert np.abs(fields[0].vec.FV().NumPy() - other.vec.FV().NumPy()).max() < 1e-12
        other.vec.FV().NumPy()[:] = fields[0].vec.FV().NumPy()
        gap = fields[0] - other
        assert domain.shell_integral(gap * gap) < 1e-24


@pytest.mark.parametrize("name", NAMES)
def test_as_many_unknowns_as_the_shell_has(name: str) -> None:
    domain = body(name, 0.5, 3, radius=3.0)
    trace = TraceSpace(domain.mesh, 3)
    on_shell = int(scalar_mask(trace.scalar, domain.shell).sum())
    assert trace.space.ndof == domain.mesh.dim * on_shell
    assert len(trace.free) == trace.space.ndof
    assert trace.free.all()


def test_components_are_held_one_by_one() -> None:
    """Held in component 1 on the rim: there it stays zero, the other components and the interior are free."""
    domain = body("disc", 0.4, 3)
    trace = TraceSpace(domain.mesh, 3)
    rim = scalar_mask(trace.scalar, domain.mesh.BBoundaries("rim"))
    trace.fix(1, rim)
    assert int((~trace.free).sum()) == int(rim.sum())
    field = GridFunction(trace.space)
    field.Set(CF((1.0, 1.0, 1.0)), BND, definedon=domain.shell)
    field.vec.FV().NumPy()[~trace.free] = 0.0
    line = dx(definedon=domain.mesh.BBoundaries("rim"))
    length = Integrate(CF(1.0) * line, domain.mesh)
    shares = [Integrate(field[i] * line, domain.mesh) / length for i in range(3)]
    assert shares == pytest.approx([1.0, 0.0, 1.0], abs=1e-10)


@pytest.mark.parametrize("reach", ["", "outside.*"])
def test_one_value_on_a_plateau(reach: str) -> None:
    """The one unknown of a plateau that covers the shell: a constant."""
    domain = body("octant", 0.5, 3, radius=3.0)
    trace = TraceSpace(domain.mesh, 3, vector=False, reach=reach, plateaus=[domain.shell])
    assert trace.free.sum() == 1
    field = GridFunction(trace.space)
    field.vec[trace.plateau_unknown(domain.shell)] = 1.0
    gap = field - 1.0
    assert domain.shell_integral(gap * gap) < 1e-24
    trace.fix_unknown(trace.plateau_unknown(domain.shell))
    assert not trace.free.any()
