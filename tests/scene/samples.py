"""Small scenes for the tests, and the sentences of a refusal."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from embedding.errors import SceneError
from embedding.scene import Scene

MATERIAL = {"law": "neo-hookean", "shear_modulus": 1e5}
SHAPES: dict[str, dict[str, Any]] = {
    "plate": {"kind": "plate", "length": 0.1, "width": 0.05},
    "disc": {"kind": "disc", "radius": 0.02},
    "sphere": {"kind": "sphere", "radius": 0.02},
    "infinite-cylinder": {"kind": "infinite-cylinder", "radius": 0.02},
    "strip": {"kind": "strip", "length": 0.1},
    "t-section": {"kind": "t-section", "length": 0.1},
}


def shell(name: str = "sphere", /, **changes: Any) -> dict[str, Any]:
    """The table of a shell."""
    return {"shape": SHAPES[name], "thickness": 2e-4, "material": MATERIAL} | changes


def scene(shape: str = "sphere", *, of_shell: dict[str, Any] | None = None, **parts: Any) -> Scene:
    """A scene from tables; ``of_shell`` changes its shell."""
    return Scene(**({"shell": shell(shape, **(of_shell or {}))} | parts))


def refusals(build: Callable[[], object]) -> list[str]:
    """The problems with which ``build`` is refused, as the lines a user reads."""
    with pytest.raises(SceneError) as caught:
        build()
    assert caught.value.exit_code == 2
    lines = [str(problem) for problem in caught.value.problems]
    assert all(line in str(caught.value) and "\n" not in line for line in lines)
    return lines
