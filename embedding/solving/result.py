"""How a solve ended: an enum whose text is advice."""

from __future__ import annotations

from enum import Enum


class Result(Enum):
    """The outcome of a solve; ``advice`` says what to do next."""

    CONVERGED = "the whole path was solved"
    LIMIT_POINT = (
        "a limit point under the prescribed loads: beyond it no equilibrium is near. "
        'Follow the path beyond it (control = "arc-length" in a stage), prescribe how far a point moves (until), '
        "or the volume of a closed shell under pressure (volume_ratio)"
    )
    PULL_IN = (
        "a limit point under the prescribed field: beyond it no equilibrium is near. "
        'Follow the path beyond it (control = "arc-length" in a stage), stop at a lower field, '
        "or give an electrode its charge in place of its voltage"
    )
    COMPRESSIVE_MEMBRANE = (
        "the membrane is in compression, where it has no stiffness of its own and wrinkles. "
        'Inflate or stretch it first, or give it bending stiffness (model.theory = "bending")'
    )
    INVERTED_AMBIENT = (
        "elements of the ambient would turn over as the shell moves, and a new mesh of it does not help. "
        "See whether the shell comes to touch itself or a body; "
        "else make the ambient larger, or the mesh on the shell finer"
    )
    LINEAR_SOLVER_FAILED = (
        "the linear system is singular: a motion is held by nothing. "
        'Add supports (a flat membrane without tension needs {where = "surface", fix = ["z"]}), or tension first'
    )
    MAX_STEPS = (
        "the path was followed for the most steps allowed without meeting the end of the stage. "
        "Allow more (solver.max_steps), or end the stage at a displacement it reaches (until)"
    )
    MAX_ARC = (
        "the path was followed for the longest way allowed without meeting the end of the stage: past a limit point "
        "the load may never be reached. Allow a longer way (solver.max_arc), "
        "or end the stage at a displacement it reaches (until)"
    )
    FIELD_VANISHED = (
        "the path went back to where the field vanishes: past a limit point what the stage prescribes is not reached. "
        "End the stage at a displacement (until) before that"
    )
    STAGGERED_DIVERGED = (
        "field and shell, solved in turn, do not settle: each changes what the other does too much. "
        'Solve them together (model.coupling = "joint"), or accelerate the turns (solver.acceleration = "iqn-ils")'
    )
    TOO_THIN = (
        "the shell is so thin against its size that rounding hides its bending stiffness, which is (T/L)^2 of that "
        "against stretching. Make it a thousand times thicker and scale the loads that bend it by the cube of that: it "
        'takes the same shape; or leave bending out (model.theory = "membrane")'
    )
    SHARPLY_BENT = (
        "the shell bends to a radius near its own thickness, where the theory of thin shells ends, and follows no more "
        "what a wall of this rubber does. Take the load back, or model the wall as a three-dimensional solid"
    )
    STEP_BELOW_MINIMUM = (
        "Newton's method did not converge with the smallest step allowed. "
        "Make the mesh on the shell finer, add steps, or start from an inflated state"
    )
    BEYOND_THE_MODEL = (
        "what the model itself leaves out is more than the accuracy asked for, on any mesh. "
        "Ask for less (accuracy), take back what was pinned where the parts of the error say so, "
        "or model the wall as a three-dimensional solid"
    )
    ACCURACY_NOT_REACHED = (
        "the accuracy asked for was not reached with the unknowns allowed. "
        "Ask for less (accuracy.relative), or allow more (accuracy.max_unknowns)"
    )
    OUT_OF_MEMORY = (
        "there is not enough memory. Coarsen the mesh, lower its order, let the scene reduce itself further "
        '(model.reduction = "auto", model.symmetry = "auto"), or run it where there is more'
    )
    INTERRUPTED = "interrupted; every accepted step is kept"

    @property
    def advice(self) -> str:
        """What happened and what to try, in words."""
        return str(self.value)

    @property
    def ok(self) -> bool:
        """Did the solve reach the end of its path?"""
        return self is Result.CONVERGED
