"""`embedding bench`: every second of a run's process is in one part."""

from __future__ import annotations

import pytest

from embedding import SceneError
from embedding.bench import Spending, measure_spending
from embedding.bench.spending import DEFAULT_SCENE, END, REST, arranged
from embedding.scene import load_scene

SMALL = ("model.reduction=axisymmetric", "path.0.steps=1")


def test_parts_of_parts() -> None:
    known = {("b",): (1.0, 2), ("a", "c", "d"): (2.0, 1), ("a",): (4.0, 1), ("a", "c"): (8.0, 3), (): (16.0, 0)}
    found = {part.names: (part.seconds, part.own, part.calls) for part in arranged(known, 40.0)}
    assert found == {
        ("b",): (1.0, 1.0, 2),
        ("a",): (14.0, 4.0, 1),
        ("a", "c"): (10.0, 8.0, 3),
        ("a", "c", "d"): (2.0, 2.0, 1),
        (REST,): (16.0, 16.0, 0),
        (END,): (9.0, 9.0, 1),
    }
    assert list(found) == [("b",), ("a",), ("a", "c"), ("a", "c", "d"), (REST,), (END,)]


@pytest.fixture(scope="module")
def spent() -> Spending:
    return measure_spending(overrides=SMALL)


def test_the_parts_are_the_whole(spent: Spending) -> None:
    assert spent.result == "CONVERGED" and spent.steps == 1 and spent.reduction == "axisymmetric"
    outermost = [part for part in spent.parts if len(part.names) == 1]
    assert sum(part.seconds for part in outermost) == pytest.approx(spent.total, rel=1e-9)
    assert all(part.seconds > 0.0 for part in spent.parts)
    assert 0.0 < spent.unaccounted < 0.5 * spent.total


def test_the_parts_of_a_run(spent: Spending) -> None:
    names = {part.names for part in spent.parts}
    assert {
        ("import",), ("scene",), ("plan",), ("meshing",), ("forms", "spaces"), ("motion",), ("potential", "solution"),
        ("residual",), ("matrix",), ("solution", "factorisation"), ("stability",), ("scalars",), ("estimate",),
        ("archive",),
    } <= names  # fmt: skip
    calls = {part.names: part.calls for part in spent.parts}
    assert calls["matrix",] == calls["solution",] == calls["potential",] == spent.iterations


def test_a_scene_with_mistakes() -> None:
    with pytest.raises(SceneError, match="thicknes"):
        measure_spending(overrides=("shell.thicknes=1",))


def test_the_default_scene_is_in_space() -> None:
    assert load_scene(DEFAULT_SCENE).model.reduction == "3d"
