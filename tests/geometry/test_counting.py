"""Meshes that are too large are known as such before they are made; those that are not are made."""

from __future__ import annotations

from typing import Any

import pytest

from embedding import Scene, SceneError
from embedding.bench.extremes.fields import SPHERE, STIFF, conductor
from embedding.geometry import counting
from embedding.plan import explain
from embedding.solving.problem import Problem

PLATE = {"kind": "plate", "length": 1.0, "width": 1.0}


def problem_of(table: dict[str, Any]) -> Problem:
    scene = Scene.from_table(table)
    return Problem(scene, explain(scene))


def shell(**discretisation: Any) -> dict[str, Any]:
    held = [{"where": "x0", "kind": "clamped"}]
    bent = {"theory": "bending"}
    body = {"shape": PLATE, "thickness": 1e-3, "material": STIFF}
    return {"shell": body, "supports": held, "model": bent, "discretisation": discretisation}


@pytest.mark.parametrize(
    ("table", "field"),
    [
        (shell(shell_size=1e-3), "shell_size"),
        (shell(shell_size=0.2, edge_size={"x0": 1e-5}), "edge_size"),
        (conductor(SPHERE, {}, discretisation={"shell_size": 1e-5}), "shell_size"),
        (conductor(SPHERE, {}, discretisation={"ambient_size": 2e-3}), "ambient_size"),
        (conductor(SPHERE, {}, discretisation={"ambient_size": 0.02}, model={"reduction": "3d"}), "ambient_size"),
    ],
)
def test_too_large(table: dict[str, Any], field: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """With memory of 10 MB; what is out of all proportion is refused before (tests/doors)."""
    monkeypatch.setattr(counting, "free_memory", lambda: 1e7)
    with pytest.raises(SceneError, match="unknowns or more; there is memory for") as caught:
        problem_of(table)
    assert [problem.path for problem in caught.value.problems] == [f"discretisation.{field}"]


@pytest.mark.parametrize(
    ("reduction", "size"), [("axisymmetric", 0.4), ("axisymmetric", 0.1), ("3d", 0.4), ("3d", 0.2)]
)
def test_never_more_than_there_are(reduction: str, size: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """With memory for as many as the mesh has there is no refusal."""
    model = {"interface": "closed", "reduction": reduction}
    table = conductor(SPHERE, {}, model=model, discretisation={"shell_size": size})
    system = problem_of(table).system
    dimension = 2 if reduction == "axisymmetric" else 3
    room = system.unknowns.count["phi"] * counting.BYTES[dimension]
    monkeypatch.setattr(counting, "free_memory", lambda: room)
    assert problem_of(table).mesh.nv > 0


def test_memory_is_what_is_left() -> None:
    assert 1e8 < counting.free_memory() < 1e15
