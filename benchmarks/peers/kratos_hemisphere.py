"""KratosMultiphysics: hemisphere with a hole of 18 degrees under P = 400, a quarter of it; prints one line of JSON.

``python kratos_hemisphere.py N ELEMENT STEPS [LINEAR_SOLVER]``, N elements along each side, in steps of equal load.
The linear solver is AMGCL, the fastest here of what the wheels offer (sparse LU, sparse QR, skyline LU).
Newton's method stops at a residual of 1e-6 of the first one, so that what is left is the error of the mesh. Of 3, 4, 5,
6, 8 and 10 steps 8 are the fewest in which the quadrilaterals 16 by 16 get there; the triangles do in 5.
"""

from __future__ import annotations

import json
import math
import sys
import time

import KratosMultiphysics as Kratos
import KratosMultiphysics.LinearSolversApplication  # registers its solvers
import KratosMultiphysics.StructuralMechanicsApplication as Structural
from KratosMultiphysics import python_linear_solver_factory

RADIUS, THICKNESS, HOLE, YOUNG, POISSON = 10.0, 0.04, math.radians(18.0), 6.825e7, 0.3
FORCE = 400.0
AXES = (Kratos.DISPLACEMENT, Kratos.ROTATION)


def components(kind: str) -> list:
    """The three scalar variables of DISPLACEMENT or ROTATION, or of their reactions."""
    return [Kratos.KratosGlobals.GetVariable(f"{kind}_{axis}") for axis in "XYZ"]


def quarter(model: Kratos.Model, n: int, element: str) -> Kratos.ModelPart:
    """Nodes on the mid-surface, equal angles apart; the equator is z = 0, the mirrors are y = 0 and x = 0."""
    part = model.CreateModelPart("shell")
    for variable in (*AXES, Kratos.REACTION, Kratos.REACTION_MOMENT, Structural.POINT_LOAD):
        part.AddNodalSolutionStepVariable(variable)
    part.SetBufferSize(2)
    part.ProcessInfo[Kratos.DOMAIN_SIZE] = 3
    for j in range(n + 1):
        up = (0.5 * math.pi - HOLE) * j / n
        for i in range(n + 1):
            turn = 0.5 * math.pi * i / n
            flat = RADIUS * math.cos(up)
            place = (flat * math.cos(turn), flat * math.sin(turn), RADIUS * math.sin(up))
            part.CreateNewNode(j * (n + 1) + i + 1, *place)
    properties = part.CreateNewProperties(1)
    for variable, value in (
        (Kratos.YOUNG_MODULUS, YOUNG),
        (Kratos.POISSON_RATIO, POISSON),
        (Kratos.THICKNESS, THICKNESS),
        (Kratos.DENSITY, 1.0),
    ):
        properties.SetValue(variable, value)
    properties.SetValue(Kratos.CONSTITUTIVE_LAW, Structural.LinearElasticPlaneStress2DLaw())
    number = 0
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i + 1
            square = (a, a + 1, a + n + 2, a + n + 1)
            halves = ((square[0], square[1], square[2]), (square[0], square[2], square[3]))
            for nodes in (square,) if element.endswith("4N") else halves:
                number += 1
                part.CreateNewElement(element, number, list(nodes), properties)
    return part


def hold_and_load(part: Kratos.ModelPart, n: int) -> None:
    """Mirror symmetry, one height, and a point load at either end of the equator."""
    reactions = (*components("REACTION"), *components("REACTION_MOMENT"))
    moves = (*components("DISPLACEMENT"), *components("ROTATION"))
    for variable, reaction in zip(moves, reactions, strict=True):
        Kratos.VariableUtils().AddDof(variable, reaction, part)
    for node in part.Nodes:
        column = (node.Id - 1) % (n + 1)
        if column == 0:  # mirror y = 0: u_y, rotation about x and z
            fixed = (1, 3, 5)
        elif column == n:  # mirror x = 0: u_x, rotation about y and z
            fixed = (0, 4, 5)
        else:
            continue
        for component in fixed:
            node.Fix(moves[component])
    part.Nodes[1].Fix(moves[2])
    for number, node in ((1, 1), (2, n + 1)):
        part.CreateNewCondition("PointLoadCondition3D1N", number, [node], part.Properties[1])


def strategy(part: Kratos.ModelPart, solver: str) -> Kratos.ResidualBasedNewtonRaphsonStrategy:
    """Newton's method with the whole tangent, one factorisation an iteration."""
    linear = python_linear_solver_factory.ConstructSolver(Kratos.Parameters(f'{{"solver_type": "{solver}"}}'))
    result = Kratos.ResidualBasedNewtonRaphsonStrategy(
        part,
        Kratos.ResidualBasedIncrementalUpdateStaticScheme(),
        Kratos.ResidualCriteria(1e-6, 1e-6),
        Kratos.ResidualBasedBlockBuilderAndSolver(linear),
        50,
        False,
        False,
        True,
    )
    result.SetEchoLevel(0)
    result.Check()
    return result


def main(n: int, element: str, steps: int, solver: str) -> None:
    """Solve and print."""
    Kratos.Logger.GetDefaultOutput().SetSeverity(Kratos.Logger.Severity.WARNING)
    begun, model = time.perf_counter(), Kratos.Model()
    part = quarter(model, n, element)
    hold_and_load(part, n)
    wall, cpu, iterations, met = time.perf_counter(), time.process_time(), 0, True
    setup = wall - begun
    newton = strategy(part, solver)
    newton.Initialize()
    for step in range(1, steps + 1):
        part.ProcessInfo[Kratos.STEP] = step
        part.CloneTimeStep(float(step))
        force = 0.5 * FORCE * step / steps
        part.Nodes[1].SetSolutionStepValue(Structural.POINT_LOAD, [force, 0.0, 0.0])
        part.Nodes[n + 1].SetSolutionStepValue(Structural.POINT_LOAD, [0.0, -force, 0.0])
        newton.InitializeSolutionStep()
        newton.Predict()
        met = newton.SolveSolutionStep() and met
        newton.FinalizeSolutionStep()
        iterations += part.ProcessInfo[Kratos.NL_ITERATION_NUMBER]
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    answer = {
        "outward": part.Nodes[1].GetSolutionStepValue(Kratos.DISPLACEMENT_X),
        "inward": -part.Nodes[n + 1].GetSolutionStepValue(Kratos.DISPLACEMENT_Y),
        "unknowns": newton.GetSystemMatrix().Size1(),
        "iterations": iterations,
        "steps": steps,
        "converged": met,
        "setup_wall": setup,
        "solve_wall": wall,
        "solve_cpu": cpu,
    }
    print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2], int(sys.argv[3]), sys.argv[4] if len(sys.argv) > 4 else "amgcl")
