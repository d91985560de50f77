"""This package: a neo-Hookean balloon under inner pressure; prints one line of JSON.

``python embedding_balloon.py REDUCTION THEORY ORDER SHELL_SIZE RATIO PRESSURE [VARIANT]``: sizes in mid radii, PRESSURE
in shear moduli, in one step; VARIANT is that of the loads.
"""

from __future__ import annotations

import json
import sys
from typing import Any

from embedding_hemisphere import Clock

from embedding import Discretisation, Loads, Model, NeoHookean, Scene, Shell, Sphere, Stage, solve


def main(reduction: Any, theory: Any, order: int, size: float, ratio: float, pressure: float, variant: Any) -> None:
    """Solve and print."""
    scene = Scene(
        shell=Shell(shape=Sphere(radius=1.0), thickness=ratio, material=NeoHookean(shear_modulus=1.0)),
        model=Model(reduction=reduction, theory=theory),
        loads=Loads(pressure_bottom=pressure, variant=variant),
        path=(Stage(steps=1),),
        discretisation=Discretisation(order=order, shell_size=size),
    )
    clock = Clock()
    solution = solve(scene, listeners=[clock], throw=False)
    answer = {
        "stretch": float(solution["stretch"][-1]),
        "unknowns": sum(solution.cost.unknowns.values()),
        "iterations": solution.iterations,
        "steps": len(solution.steps),
        "converged": solution.result.ok,
    }
    print(json.dumps(answer | clock.seconds()))


if __name__ == "__main__":
    words = sys.argv[1:]
    main(*words[:2], int(words[2]), *map(float, words[3:6]), words[6] if len(words) > 6 else "embedding-aware")
