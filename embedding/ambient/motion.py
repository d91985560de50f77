"""Motion of the ambient mesh around the shell: it follows the faces, and no element turns over.

Each face carries its displacement y into the elements that touch it (the shell's own basis functions); the interior
motion w, piecewise quadratic, takes up the rest by lowering a hyperelastic energy that is stiff where elements are
small. Any admissible w gives the same physics up to the discretisation error, so w takes one linearised step whenever
the face has moved noticeably and rests otherwise: with w at rest Newton's method on shell and field is quadratic. What
matters is that det F stays positive, and that is measured after every move.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import (
    BND,
    ET,
    BilinearForm,
    Det,
    Grad,
    GridFunction,
    Id,
    InnerProduct,
    IntegrationRule,
    Variation,
    VectorH1,
    log,
    specialcf,
)

from embedding.ambient.inverse import Inverter, Linear, norm
from embedding.ambient.stiffening import StiffeningForm
from embedding.geometry.domain import Domain
from embedding.geometry.spaces import as_bits, plane_mask, scalar_mask
from embedding.threads import shared

Array = npt.NDArray[np.float64]
INTERIOR_ORDER = 2
VOLUME_PRICE = {2: 0.3, 3: 0.02}
GUARD = 0.02
MOST_SUBSTEPS = 16
MOST_RELAXATIONS, MOST_HALVINGS = 6, 6
LOOSE, SETTLED = 0.05, 1e-3
COMFORTABLE = 0.3
PROBE = 1e-6
ACCURATE = 1e-8
NOTICEABLE = 2e-2
OUTDATED = 0.15
SERVES = 0.3
"""Guard on det F. ``ACCURATE`` is what an iteration leaves of a step. A matrix of the extension is good enough while
det F is above ``COMFORTABLE``, the face has moved by less than ``OUTDATED`` (shell sizes) since, and a step with it
leaves at most the part ``SERVES`` of the residual. With a new one the interior is relaxed until a step brings less than
``LOOSE`` of its energy, or ``SETTLED`` where it is not comfortable. A face that moved less than ``NOTICEABLE`` (mesh
sizes) does not disturb the interior."""


class AmbientMotion:
    """The motion y + w of the ambient on one or both sides: face displacements ``y`` by side, interior motion ``w``.

    ``faces`` holds the space of the face's displacement for each side ("outside", "inside"). Around an open shell both
    sides are one space; a closed one parts them, and each side has a motion of its own. ``linear`` says how its
    equations are solved. On a mesh made around a deformed shell, y is the displacement from there, and ``rest`` that of
    the shell there, by side.
    """

    def __init__(self, domain: Domain, faces: Mapping[str, Any], linear: Linear = "auto") -> None:
        mesh = domain.mesh
        self._domain = domain
        self.materials = "|".join(domain.materials(side) for side in faces)
        interior = VectorH1(mesh, order=INTERIOR_ORDER, definedon=mesh.Materials(self.materials))
        self.y = {side: GridFunction(space) for side, space in faces.items()}
        self.rest = {side: _rest(domain, y) for side, y in self.y.items()}
        self.w = GridFunction(interior)
        self._settled = np.zeros(self._face().size)
        self._assembled_at, self._assembled_with = self._settled.copy(), np.zeros(interior.ndof)
        self._inverse: Any = None
        self._noticeable = NOTICEABLE * domain.sizes.shell
        self.rule = {element: IntegrationRule(element, 2 * INTERIOR_ORDER) for element in (ET.TET, ET.TRIG)}
        if mesh.dim == 3 and domain.base is None:
            self._form: Any = StiffeningForm(
                domain, interior, dict(self._parts(domain)), VOLUME_PRICE[3], self.rule[ET.TET]
            )
        else:
            self._form = self.symbolic_form()
        self.free = as_bits(_interior_mask(domain, interior))
        self.linear, self._inverter = linear, Inverter(interior, self.free, linear, ACCURATE)
        self._samples = [
            (Det(gradient).Compile(), mesh.MapToAllElements(_sampling(mesh.dim, order), mesh.Materials(materials)))
            for materials, gradient, order in self._gradients(domain)
        ]

    def symbolic_form(self) -> BilinearForm:
        """The energy of the extension as NGSolve's form in w."""
        domain, interior = self._domain, self.w.space
        form, trial = BilinearForm(interior, symmetric=True), interior.TrialFunction()
        for materials, y in self._parts(domain):
            strain = extension_energy(Id(domain.mesh.dim) + (Grad(trial) if y is None else Grad(y) + Grad(trial)))
            form += Variation(strain * domain.volume(materials, self.rule)).Compile()
        return form

    def _parts(self, domain: Domain) -> list[tuple[str, Any]]:
        """Patterns of materials with the face displacement that reaches into them, None where none does."""
        parts: list[tuple[str, Any]] = [(domain.near(side), y) for side, y in self.y.items()]
        return parts + [(far, None) for far in map(domain.far, self.y) if far is not None]

    def _gradients(self, domain: Domain) -> list[tuple[str, Any, int]]:
        """F by pattern of materials, with the order of the sampling rule: fine where the motion of a face reaches."""
        unmoved = Id(domain.mesh.dim) + Grad(self.w)
        order = 2 * domain.sizes.order
        return [
            (materials, unmoved, INTERIOR_ORDER) if y is None else (materials, unmoved + Grad(y), order)
            for materials, y in self._parts(domain)
        ]

    @property
    def min_jacobian(self) -> float:
        """Smallest det F over the sample points (1 for the undeformed mesh)."""
        with self._domain.in_ambient():
            return min(float(np.min(jacobian(points))) for jacobian, points in self._samples)

    def vectors(self) -> list[Any]:
        """The vectors that make up the state of the motion: faces, interior, and where the faces were last settled."""
        return [*(y.vec.FV().NumPy() for y in self.y.values()), self.w.vec.FV().NumPy(), self._settled]

    def save(self) -> Array:
        """All of :meth:`vectors` in one, for :meth:`restore`."""
        return np.concatenate(self.vectors())

    def restore(self, saved: Array) -> None:
        """Go back to what :meth:`save` returned."""
        vectors = self.vectors()
        self._restore(np.split(saved, np.cumsum([vector.size for vector in vectors])[:-1]))

    def memory(self) -> Array | None:
        """Faces and interior at which the matrix at hand was assembled, in one vector; None if there is none yet. The
        next motion starts from that matrix, so it belongs to what a run goes on from."""
        known = self._inverse is not None
        return np.concatenate([self._assembled_at, self._assembled_with]) if known else None

    def recall(self, memory: Array | None) -> None:
        """Have the matrix again that had this :meth:`memory`; the present motion is left as it is."""
        if memory is None:
            return
        present = self.save()
        faces, interior = np.split(memory, [self._assembled_at.size])
        self._place(faces)
        self.w.vec.FV().NumPy()[:] = interior
        self._assemble(faces)
        self.restore(present)

    def continue_from(self, other: AmbientMotion, faces: Mapping[str, Array]) -> None:
        """Take over the interior that ``other``, on the same mesh, has around ``faces``, displacements by side."""
        self.w.vec.data = other.w.vec
        self._settled[:] = np.concatenate([faces[side] - self._at_rest(side) for side in self.y])
        self._place(self._settled)

    def _face(self) -> Array:
        return np.concatenate([np.array(y.vec.FV().NumPy()) for y in self.y.values()])

    def follow(self, faces: Mapping[str, Array]) -> bool:
        """Move the faces to the displacements ``faces``, unknowns by side; False (and nothing moved) if elements would
        turn over."""
        saved = [vector.copy() for vector in self.vectors()]
        start, target = self._face(), np.concatenate([faces[side] - self._at_rest(side) for side in self.y])
        if np.abs(target - self._settled).max(initial=0.0) <= self._noticeable and self._place(target):
            return True
        substeps = 1
        while substeps <= MOST_SUBSTEPS:
            self._restore(saved)
            if self._walk(start, target, substeps):
                self._settled[:] = target
                return True
            substeps *= 4
        self._restore(saved)
        return False

    def _at_rest(self, side: str) -> Any:
        rest = self.rest[side]
        return 0.0 if rest is None else rest.vec.FV().NumPy()

    def _walk(self, start: Any, target: Any, substeps: int) -> bool:
        """Move the faces in equal substeps, the interior with them."""
        stops = [start + i / substeps * (target - start) for i in range(1, substeps)] + [target]
        return all(self._settle(stop) for stop in stops)

    def _restore(self, saved: list[Any]) -> None:
        for vector, values in zip(self.vectors(), saved, strict=True):
            vector[:] = values

    def _place(self, faces: Array) -> bool:
        """Move the faces alone."""
        parts = np.split(faces, np.cumsum([y.vec.size for y in self.y.values()])[:-1])
        for y, part in zip(self.y.values(), parts, strict=True):
            y.vec.FV().NumPy()[:] = part
        return self.min_jacobian > GUARD

    def _settle(self, faces: Array) -> bool:
        """Move the faces, and the interior as the tangent at hand predicts; relax it where that is not good enough."""
        start, known = self.save(), self._inverse is not None and self._is_current(faces)
        if not known:
            self._assemble(self._face())
        before = self._predict(faces)
        if before is None and known:  # the matrix may be that of a wild guess, with an interior of its own
            self.restore(start)
            self._assemble(self._face())
            before = self._predict(faces)
        if before is None:
            return False
        if self._is_current(faces) and self._remainder() < SERVES * before and self.min_jacobian > COMFORTABLE:
            return True
        for _ in range(MOST_RELAXATIONS):
            self._assemble(faces)
            if not self._descend():
                break
        return self.min_jacobian > GUARD

    def _is_current(self, faces: Array) -> bool:
        return bool(np.abs(faces - self._assembled_at).max(initial=0.0) < OUTDATED)

    def _assemble(self, faces: Array) -> None:
        with shared():
            self._form.AssembleLinearization(self.w.vec)
        self._inverse = self._inverter(self._form.mat)
        self._assembled_at, self._assembled_with = faces.copy(), np.array(self.w.vec.FV().NumPy())

    def _predict(self, faces: Array) -> float | None:
        """Move the faces, and the interior by - K_ww^{-1} (r + K_wy dy) with the residual r that it has; returns the
        size of its step, None where elements turn over."""
        present = self._face()
        rest, load, step = (self.w.vec.CreateVector() for _ in range(3))
        self._form.Apply(self.w.vec, rest)
        self._place(present + PROBE * (faces - present))
        self._form.Apply(self.w.vec, load)
        load.data -= (1 - PROBE) * rest
        load.data *= 1 / PROBE
        step.data = self._inverse * load
        self.w.vec.data -= step
        return math.sqrt(abs(InnerProduct(step, load))) if self._place(faces) else None

    def _remainder(self) -> float:
        """What is left of the residual, in the norm of the matrix at hand."""
        residual = self.w.vec.CreateVector()
        self._form.Apply(self.w.vec, residual)
        return norm(self._inverse, residual)

    def _descend(self) -> bool:
        """One step with the matrix at hand, halved until it lowers the energy; False if it is not worth another."""
        step, size = self._preconditioned_residual()
        before, energy = self.w.vec.FV().NumPy().copy(), self._energy()
        if not math.isfinite(size):
            return False
        for halving in range(MOST_HALVINGS):
            self.w.vec.FV().NumPy()[:] = before - 0.5**halving * step.FV().NumPy()
            if self.min_jacobian > GUARD and self._energy() < energy:
                return bool(size * size > (LOOSE if self.min_jacobian > COMFORTABLE else SETTLED) * energy)
        self.w.vec.FV().NumPy()[:] = before
        return False

    def _energy(self) -> float:
        with self._domain.in_ambient():  # NGSolve's energies know only of the mesh's own deformation
            return float(self._form.Energy(self.w.vec))

    def _preconditioned_residual(self) -> tuple[Any, float]:
        residual, step = self.w.vec.CreateVector(), self.w.vec.CreateVector()
        self._form.Apply(self.w.vec, residual)
        step.data = self._inverse * residual
        return step, math.sqrt(abs(InnerProduct(step, residual)))


def _sampling(dimension: int, order: int) -> IntegrationRule:
    return IntegrationRule(ET.TET if dimension == 3 else ET.TRIG, order)


def _rest(domain: Domain, y: GridFunction) -> GridFunction | None:
    """The displacement of the shell at which the mesh was made, in the space of ``y``; None where that is none."""
    if domain.base is None:
        return None
    rest = GridFunction(y.space)
    rest.Set(domain.base.displacement, BND, definedon=domain.shell)
    return rest


def _interior_mask(domain: Domain, interior: Any) -> Any:
    scalar = interior.components[0]
    held = scalar_mask(scalar, domain.mesh.Boundaries("shell|outer|body.*"))
    on_side = np.fromiter((bool(f) for f in scalar.FreeDofs()), bool, scalar.ndof)
    free = np.tile(on_side & ~held, (domain.mesh.dim, 1))
    for axis in symmetry_components(domain):
        free[axis] &= ~plane_mask(scalar, axis)
    return free.ravel()


def symmetry_components(domain: Domain) -> tuple[int, ...]:
    """Displacement components that vanish where their own coordinate does: mirror planes, and r on the axis."""
    if domain.reduction.name == "axisymmetric":
        return (0,)
    return tuple("xyz".index(axis) for axis in domain.reduction.planes)


def extension_energy(F: Any) -> Any:
    """Isochoric shape change plus a polyconvex price on the volume change, stiffer the smaller the element (h^-3).

    log(J)^2 in place of (J^2 - 1) / 2 - log(J) would lose convexity where elements expand beyond J = e. Volume is
    cheap: elements at an inflating face shall grow with it in all directions, not be flattened (prices by measurement).
    """
    dimension = F.dims[0]
    J = Det(F)
    shape = InnerProduct(F, F) * J ** (-2 / dimension) - dimension
    return specialcf.mesh_size ** (-3) * 0.5 * (shape + VOLUME_PRICE[dimension] * (J**2 - 1 - 2 * log(J)))
