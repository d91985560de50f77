"""Boundary elements, to verify the far field by another way: capacitances from a surface mesh alone."""

from __future__ import annotations

from typing import Any

from netgen.occ import OCCGeometry
from ngsolve import BilinearForm, InnerProduct, LinearForm, Mesh, SurfaceL2, ds
from ngsolve.bem import LaplaceSL
from ngsolve.solvers import CG


def capacitance(surface: Any, size: float, order: int) -> tuple[float, int]:
    """Charge at voltage 1 (permittivity 1) of a conductor with this OCC ``surface``, and the number of unknowns.

    The single layer's density of ``order`` on elements of ``size``, curved one order higher, by Galerkin's method: the
    charge is a bound from below up to the error of the geometry.
    """
    mesh = Mesh(OCCGeometry(surface).GenerateMesh(maxh=size))
    mesh.Curve(order + 1)
    space = SurfaceL2(mesh, order=order, dual_mapping=True)
    density, test = space.TnT()
    layer = LaplaceSL(density * ds) * test * ds
    one = LinearForm(test * ds).Assemble()
    mass = BilinearForm(density * test * ds).Assemble()
    inverse = mass.mat.Inverse(inverse="sparsecholesky")
    found = CG(mat=layer.mat, pre=inverse, rhs=one.vec, tol=1e-10, maxsteps=400, printrates=False)
    return float(InnerProduct(found, one.vec)), space.ndof
