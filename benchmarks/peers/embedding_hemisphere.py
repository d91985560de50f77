"""This package: hemisphere with a hole of 18 degrees under P = 400; prints one line of JSON.

``python embedding_hemisphere.py ORDER SHELL_SIZE STEPS``: steps of equal load, 0 for the default, which follows the
path in steps of its own choice.
"""

from __future__ import annotations

import json
import sys
import time
from typing import Any

from embedding import (
    Discretisation,
    Hemisphere,
    Listener,
    Loads,
    PointLoad,
    Scene,
    Shell,
    Stage,
    StVenantKirchhoff,
    solve,
)
from embedding.scene.path import Until
from embedding.solving.places import displacement_row

RADIUS, FORCE = 10.0, 400.0


def scene(order: int, shell_size: float, steps: int) -> Scene:
    """The whole hemisphere; the plan meshes a quarter."""
    material = StVenantKirchhoff(youngs_modulus=6.825e7, poisson_ratio=0.3)
    shape = Hemisphere(radius=RADIUS, hole_half_angle="18 deg")
    forces = [PointLoad(at=(side * RADIUS, 0.0, 0.0), force=(side * FORCE, 0.0, 0.0)) for side in (1.0, -1.0)]
    forces += [PointLoad(at=(0.0, side * RADIUS, 0.0), force=(0.0, -side * FORCE, 0.0)) for side in (1.0, -1.0)]
    return Scene(
        shell=Shell(shape=shape, thickness=0.04, material=material),
        loads=Loads(point_loads=tuple(forces)),
        path=(Stage(steps=steps) if steps else Stage(),),
        discretisation=Discretisation(order=order, shell_size=shell_size),
    )


class Clock(Listener):
    """Seconds from the start to the ready problem, and from there to the last accepted state; two displacements."""

    def __init__(self) -> None:
        self.begun = self.now()

    def now(self) -> tuple[float, float]:
        """Wall and CPU seconds of this process."""
        return time.perf_counter(), time.process_time()

    def started(self, problem: Any) -> None:
        """The problem stands."""
        self.problem, self.ready = problem, self.now()

    def accepted(self, state: Any, record: Any) -> None:
        """A state is reached, perhaps the last."""
        self.state, self.done = state, self.now()

    def seconds(self) -> dict[str, float]:
        """For the table."""
        return {
            "setup_wall": self.ready[0] - self.begun[0],
            "solve_wall": self.done[0] - self.ready[0],
            "solve_cpu": self.done[1] - self.ready[1],
        }

    def displacement(self, where: tuple[float, float, float], axis: Any) -> float:
        """Of a point of the shell, in m."""
        row = displacement_row(self.problem, Until(where=where, axis=axis, value=1.0), 0)
        return float(row @ self.state.vectors()["u"]) * self.problem.scales.length


def main(order: int, shell_size: float, steps: int) -> None:
    """Solve and print."""
    clock = Clock()
    solution = solve(scene(order, shell_size, steps), listeners=[clock], throw=False)
    answer = {
        "outward": clock.displacement((RADIUS, 0.0, 0.0), "x"),
        "inward": -clock.displacement((0.0, RADIUS, 0.0), "y"),
        "unknowns": sum(solution.cost.unknowns.values()),
        "iterations": solution.iterations,
        "steps": len(solution.steps),
        "converged": solution.result.ok,
    }
    print(json.dumps(answer | clock.seconds()))


if __name__ == "__main__":
    main(int(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3]))
