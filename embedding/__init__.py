"""Thin hyperelastic shells as interfaces inside the electric and magnetic fields around them.

The public names below are loaded when they are first used, so that stating and checking a scene stays fast.
"""

from __future__ import annotations

import importlib
import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from embedding.api import resume, solve
    from embedding.archive import open_archive, verify
    from embedding.errors import ArchiveError, EmbeddingError, SceneError, SolveError
    from embedding.plan import explain
    from embedding.scene import (
        Ambient,
        Annulus,
        AppliedField,
        Arch,
        BoxBody,
        Branch,
        Cap,
        Cone,
        Cylinder,
        CylinderBody,
        Disc,
        Discretisation,
        EdgeMoment,
        EdgeTraction,
        Electrode,
        Ellipsoid,
        Faces,
        ForceField,
        Gent,
        HalfSpace,
        Hemisphere,
        InfiniteCylinder,
        LineCurrent,
        LineLoad,
        Loads,
        Model,
        MooneyRivlin,
        NeoHookean,
        Ogden,
        Output,
        Plate,
        PointLoad,
        PolarisationField,
        PressureField,
        Region,
        RemanenceField,
        Scene,
        Shell,
        Solver,
        Sphere,
        SphereBody,
        Stage,
        StrainEnergy,
        Strip,
        StVenantKirchhoff,
        Support,
        SurfaceFile,
        ThicknessField,
        Torus,
        TSection,
        Until,
        Yeoh,
        load_scene,
    )
    from embedding.solving import Listener, Result, Solution

__version__ = "0.1.0"

# Read once, when ngsolve loads OpenBLAS: more threads slow the many small dense blocks down, and change last digits.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

_HOMES = {
    "embedding.api": ("resume", "solve"),
    "embedding.archive": ("open_archive", "verify"),
    "embedding.errors": ("ArchiveError", "EmbeddingError", "SceneError", "SolveError"),
    "embedding.plan": ("explain",),
    "embedding.scene": (
        "Ambient", "Annulus", "AppliedField", "Arch", "BoxBody", "Branch", "Cap", "Cone", "Cylinder",
        "CylinderBody", "Disc", "Discretisation", "EdgeMoment", "EdgeTraction", "Electrode", "Ellipsoid",
        "Faces", "ForceField", "Gent", "HalfSpace", "Hemisphere", "InfiniteCylinder", "LineCurrent", "LineLoad",
        "Loads", "Model", "MooneyRivlin", "NeoHookean", "Ogden", "Output", "Plate", "PointLoad",
        "PolarisationField", "PressureField", "Region", "RemanenceField", "Scene", "Shell", "Solver", "Sphere",
        "SphereBody", "StVenantKirchhoff", "Stage", "StrainEnergy", "Strip", "Support", "SurfaceFile", "TSection",
        "ThicknessField", "Torus", "Until", "Yeoh", "load_scene",
    ),
    "embedding.solving": ("Listener", "Result", "Solution"),
}  # fmt: skip
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "Ambient",
    "Annulus",
    "AppliedField",
    "Arch",
    "ArchiveError",
    "BoxBody",
    "Branch",
    "Cap",
    "Cone",
    "Cylinder",
    "CylinderBody",
    "Disc",
    "Discretisation",
    "EdgeMoment",
    "EdgeTraction",
    "Electrode",
    "Ellipsoid",
    "EmbeddingError",
    "Faces",
    "ForceField",
    "Gent",
    "HalfSpace",
    "Hemisphere",
    "InfiniteCylinder",
    "LineCurrent",
    "LineLoad",
    "Listener",
    "Loads",
    "Model",
    "MooneyRivlin",
    "NeoHookean",
    "Ogden",
    "Output",
    "Plate",
    "PointLoad",
    "PolarisationField",
    "PressureField",
    "Region",
    "RemanenceField",
    "Result",
    "Scene",
    "SceneError",
    "Shell",
    "Solution",
    "SolveError",
    "Solver",
    "Sphere",
    "SphereBody",
    "StVenantKirchhoff",
    "StrainEnergy",
    "Stage",
    "Strip",
    "Support",
    "SurfaceFile",
    "TSection",
    "ThicknessField",
    "Torus",
    "Until",
    "Yeoh",
    "explain",
    "load_scene",
    "open_archive",
    "resume",
    "solve",
    "verify",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(_HOME_OF[name]), name)
