"""How sound a solution is: numbers to look at before it is believed, each with what it should be.

An error estimate says how far the answer is off; these say whether the mesh and the equations were fit to give one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BND, VOL, IfPos

from embedding.geometry.positions import reference_position
from embedding.solving.branches import BranchAsked
from embedding.solving.compression import ROUNDING as NONE
from embedding.solving.compression import may_wrinkle
from embedding.solving.energies import last_step
from embedding.solving.estimate import Estimates
from embedding.solving.events import StepRecord
from embedding.solving.problem import Problem
from embedding.solving.remeshing import WORN
from embedding.solving.solution import Check
from embedding.solving.stability import countable
from embedding.solving.state import State

Floats = npt.NDArray[np.float64]
UNBALANCED, ROUNDING = 1e-6, 1e-12
"""Nodal forces out of balance over those of the loads, and over the stiffness, below which rounding makes them."""
FLATTENED = 0.05
"""Quality of an element (1 if regular) from which on its matrix and its interpolation suffer."""
NEAR_LIMIT = 10.0
"""By what factor a relative change of the load may come back in the displacement."""
UNMET = "its load lies beyond the end of the stage, or its mode breaks a symmetry that the plan makes use of"
SINGULAR = 1e14
"""Condition of the tangent beyond which rounding reaches the answer's third digit, after one step of refinement."""


def check_health(
    problem: Problem, estimates: Estimates, steps: Sequence[StepRecord], branches: Sequence[BranchAsked] = ()
) -> tuple[Check, ...]:
    """All checks at the present, converged state, the last of ``steps``, of which ``estimates`` are known, and whether
    the path went over to the ``branches`` that were asked for."""
    balance = None if problem.plan.coupling == "once" else last_step(problem, steps)
    led = (of_branch(problem, branch) for branch in branches)
    return (*_checks(problem, estimates), *(() if balance is None else (balance,)), *led)


def _checks(problem: Problem, estimates: Estimates) -> Iterator[Check]:
    response, condition = estimates.response, estimates.condition
    yield _residual(problem, estimates.loads)
    if problem.system.motions:
        value, told = problem.system.min_jacobian, "smallest Jacobian of the space that moves with the shell"
        yield Check("space", value, "", f">= {WORN:g}", value >= WORN, told)
    worst = quality(problem)
    yield Check("elements", worst, "", f">= {FLATTENED:g}", worst >= FLATTENED, "quality of the flattest, 1 if regular")
    if response is not None:
        told = "by this factor a change of the load comes back in the displacement; infinite at a limit point"
        yield Check("limit point", response, "", f"<= {NEAR_LIMIT:g}", response <= NEAR_LIMIT, told)
    if problem.plan.bending:
        yield from of_bending(problem)
    elif may_wrinkle(problem):
        yield of_membrane(problem)
    if condition is not None:
        told = "largest over smallest eigenvalue of the tangent, to its order"
        yield Check("condition", condition, "", f"<= {SINGULAR:g}", condition <= SINGULAR, told)


def _residual(problem: Problem, loads: float) -> Check:
    """The forces that are not in balance, in N (plane strain: N/m), against the loads, or the stiffness without any
    and where loads are next to nothing."""
    system, scales = problem.system, problem.scales
    free = system.unknowns.trace.free
    rows = system.residual().FV().NumPy()[system.unknowns.range("u")][free]
    lengths = 1 if problem.reduction.name == "plane-strain" else 2
    size = float(np.linalg.norm(rows))
    natural = problem.scene.shell.thickest / scales.length
    unit = "N/m" if lengths == 1 else "N"
    allowed = max(UNBALANCED * loads, (ROUNDING if loads else UNBALANCED) * natural)
    allowed *= scales.stress * scales.length**lengths
    value = size * scales.stress * scales.length**lengths
    return Check("residual", value, unit, f"<= {allowed:.1g} {unit}", value <= allowed, "nodal forces out of balance")


def of_membrane(problem: Problem) -> Check:
    """Compression in a membrane, against what its own bending stiffness would bear."""
    value, allowed = _compression(problem)
    told = "stress of compression over the shear modulus: beyond it a membrane buckles or wrinkles, which is not seen"
    return Check("compression", value, "", f"<= {allowed:.1g}", value <= allowed, told)


def _compression(problem: Problem) -> tuple[float, float]:
    """The largest stress of compression in shear moduli, and half of that at which a shell buckles: a sphere at
    2 mu T / R (classical, incompressible), a strip of length L at about 3 mu (T / L)^2."""
    domain, slender = problem.domain, problem.scene.shell.thickest / problem.scales.length
    allowed = slender**2 if domain.is_flat else slender / min(domain.curvature_radius, 1.0)
    return max(0.0, -State(problem).smallest_stress), max(allowed, -NONE)


def of_bending(problem: Problem) -> Iterator[Check]:
    """Regions in compression, and the layers along edges in which a curved shell bends."""
    state, domain = State(problem), problem.domain
    curved = not domain.is_flat and math.isfinite(domain.curvature_radius)
    layer = math.sqrt(domain.curvature_radius * problem.scene.shell.thickest / problem.scales.length) if curved else 0.0
    share = domain.shell_integral(IfPos(state.min_principal_stress, 0.0, 1.0)) / domain.area
    value, allowed = _compression(problem)
    seen = not curved or domain.sizes.shell / domain.sizes.order <= layer or value <= allowed
    told = "part of the area in compression, which bending stiffness carries: finer waves than elements are not seen"
    if not seen:
        told += f", and a stress of {value:.1g} shear moduli makes waves of the length sqrt(R T)"
    yield Check("compression", share, "", "" if seen else "in finer elements", seen, told)
    if not domain.rims:
        return
    size = max(domain.sizes.along(edge) for edge in domain.rims) / domain.sizes.order
    if curved:
        told = "element along edges, over its order, against the bending layer sqrt(R T)"
        yield Check("bending layer", size / layer, "", "<= 1", size <= layer, told)
    turned = magnetic_layer(problem)
    if math.isfinite(turned):
        told = "element along edges, over its order, against the layer T (mu / (3 B_r H))^1/2 where a magnet turns"
        yield Check("magnetic layer", size / turned, "", "<= 1", size <= turned, told)


def of_branch(problem: Problem, asked: BranchAsked) -> Check:
    """Whether the path was left for a branch: if not, the answer is on another one than was asked for."""
    told = f'bifurcations met in the stage "{asked.stage}", which asks for the branch of number {asked.number}'
    if not asked.left:
        if not countable(problem.system):
            why = "unstable modes are not counted here, so that no bifurcation is seen"
        else:
            why = "no state on it was found" if asked.met >= asked.number else UNMET
        told += f"; the answer is not on that branch: {why}"
    return Check("branch", asked.met, "", f">= {asked.number}, and left there", asked.left, told)


def magnetic_layer(problem: Problem) -> float:
    """Over the size of the shape: the length in which a held hard-magnetic shell turns into the applied field, root of
    its bending stiffness mu T^3 / 3 (incompressible, width held) over the moment T B_r H an area; inf without both.

    The elastica of such a strip, t'' = a sin(t - angle), has the layer L / a^(1/2) (Zhao et al., J. Mech. Phys. Solids
    124 (2019) 244).
    """
    scene, scales = problem.scene, problem.scales
    remanence = scene.shell.constant_vectors.get("remanence")
    applied = (0.0,) if scene.ambient is None else scene.ambient.uniform_field
    if remanence is None or not any(remanence) or not any(applied):
        return math.inf
    moment = math.hypot(*remanence) * math.hypot(*applied)
    return scene.shell.thickest / scales.length * math.sqrt(scales.stress / (3.0 * moment))


def quality(problem: Problem) -> float:
    """Of the flattest element: volume over that of the regular one with the same edges, root mean square."""
    mesh = problem.mesh
    kinds = [VOL, BND] if problem.domain.has_ambient else [BND]
    found = [quality_of(_corners(mesh, kind)) for kind in kinds]
    return min((float(values.min()) for values in found if len(values)), default=1.0)


def _corners(mesh: Any, kind: Any) -> Floats:
    """Corners (n, k, d) of all simplices of a kind."""
    simplices = (e for e in mesh.Elements(kind) if len(e.vertices) in (2, 3, 4) and len(e.vertices) <= mesh.dim + 1)
    corners = [[reference_position(mesh, v) for v in e.vertices] for e in simplices]
    sizes = {len(corner) for corner in corners}
    return np.array([corner for corner in corners if len(corner) == max(sizes)]) if corners else np.zeros((0, 2, 2))


def quality_of(corners: Floats) -> Floats:
    """The same (n,) of simplices with ``corners`` (n, k, d)."""
    count, k = corners.shape[:2]
    if k < 3:  # a segment has no shape
        return np.ones(count)
    sides = corners[:, 1:] - corners[:, :1]
    gram = np.einsum("nid,njd->nij", sides, sides)
    volume = np.sqrt(np.maximum(np.linalg.det(gram), 0.0))
    pairs = [(i, j) for i in range(k) for j in range(i)]
    squares = np.mean([((corners[:, i] - corners[:, j]) ** 2).sum(axis=1) for i, j in pairs], axis=0)
    regular = math.sqrt(3) / 2 if k == 3 else 1 / math.sqrt(2)
    return np.asarray(volume / (regular * squares ** ((k - 1) / 2)))
