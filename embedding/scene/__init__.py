"""What the user states: shell, supports, loads, ambient, path, options; in SI units, checked at the door."""

from embedding.errors import Problem, SceneError
from embedding.scene.accuracy import Accuracy
from embedding.scene.ambient import Ambient, Electrode, Faces, LineCurrent
from embedding.scene.bodies import Body, BoxBody, CylinderBody, HalfSpace, SphereBody
from embedding.scene.expression import Expression, parse_expression
from embedding.scene.loads import EdgeMoment, EdgeTraction, LineLoad, Loads, PointLoad
from embedding.scene.materials import Gent, Material, MooneyRivlin, NeoHookean, Ogden, StVenantKirchhoff, Yeoh
from embedding.scene.options import Discretisation, Model, Solver
from embedding.scene.output import Output
from embedding.scene.path import Branch, Stage, Until
from embedding.scene.scales import EPSILON_0, MU_0, Scales
from embedding.scene.scene import Scene
from embedding.scene.shapes import (
    Annulus,
    Arch,
    Cap,
    Cone,
    Cylinder,
    Disc,
    Ellipsoid,
    Hemisphere,
    InfiniteCylinder,
    Plate,
    Shape,
    Sphere,
    Strip,
    Surface,
    SurfaceFile,
    Torus,
    TSection,
)
from embedding.scene.shell import Region, Shell
from embedding.scene.strain_energy import StrainEnergy
from embedding.scene.supports import Support
from embedding.scene.surface_fields import PressureField, ThicknessField
from embedding.scene.symmetry import axisymmetry_problems
from embedding.scene.toml_io import load_scene
from embedding.scene.vector_fields import AppliedField, ForceField, PolarisationField, RemanenceField

__all__ = [
    "EPSILON_0",
    "MU_0",
    "Accuracy",
    "Ambient",
    "Annulus",
    "AppliedField",
    "Arch",
    "Body",
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
    "Expression",
    "Faces",
    "ForceField",
    "Gent",
    "HalfSpace",
    "Hemisphere",
    "InfiniteCylinder",
    "LineCurrent",
    "LineLoad",
    "Loads",
    "Material",
    "Model",
    "MooneyRivlin",
    "NeoHookean",
    "Ogden",
    "Output",
    "Plate",
    "PointLoad",
    "PolarisationField",
    "PressureField",
    "Problem",
    "Region",
    "RemanenceField",
    "Scales",
    "Scene",
    "SceneError",
    "Shape",
    "Shell",
    "Solver",
    "Sphere",
    "SphereBody",
    "StVenantKirchhoff",
    "StrainEnergy",
    "Stage",
    "Strip",
    "Support",
    "Surface",
    "SurfaceFile",
    "TSection",
    "ThicknessField",
    "Torus",
    "Until",
    "Yeoh",
    "axisymmetry_problems",
    "load_scene",
    "parse_expression",
]
