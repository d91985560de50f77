"""The road along a stage: proposals, cutbacks, and what lies between two targets."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from embedding import SceneError, Stage
from embedding.solving.path import Stepper, Target, followed, planned_steps, stage_target


def walk(stepper: Stepper, solvable: Callable[[float, float], bool], most: int = 10_000) -> tuple[list[float], bool]:
    """Accepted fractions, and whether the end was reached; ``solvable(start, stop)`` says if a step can be solved."""
    accepted: list[float] = []
    for count, fraction in enumerate(stepper.proposals()):
        assert count < most
        assert stepper.accepted < fraction <= 1.0
        if solvable(stepper.accepted, fraction):
            stepper.accept()
            accepted.append(fraction)
        elif not stepper.cut():
            return accepted, False
    return accepted, True


@pytest.mark.parametrize("steps", [1, 2, 3, 7, 10, 1000])
def test_as_many_steps_as_planned(steps: int) -> None:
    accepted, arrived = walk(Stepper(steps, 1e-4), lambda start, stop: True)
    assert arrived and len(accepted) == steps and accepted[-1] == 1.0
    assert accepted == pytest.approx([(i + 1) / steps for i in range(steps)])


def test_a_hard_place_is_passed_in_small_steps_and_left_in_large_ones() -> None:
    """Between 0.4 and 0.5 only steps of 1/40 can be solved."""

    def solvable(start: float, stop: float) -> bool:
        outside = stop <= 0.4 or start >= 0.5
        return outside or stop - start <= 0.025 + 1e-12

    accepted, arrived = walk(Stepper(10, 1e-2), solvable)
    lengths = [b - a for a, b in zip([0.0, *accepted], accepted, strict=False)]
    assert arrived
    assert max(lengths) <= 0.1 + 1e-12 and min(lengths) < 0.026
    assert lengths[-3:-1] == pytest.approx([0.1, 0.1])  # back to the planned length; the last one is what is left


@pytest.mark.parametrize("min_step", [0.3, 0.1, 1e-3])
def test_a_wall_ends_the_road_at_the_smallest_step(min_step: float) -> None:
    """Nothing beyond 0.55 can be solved: the last good place is within the smallest step of it."""
    stepper = Stepper(5, min_step)
    accepted, arrived = walk(stepper, lambda start, stop: stop <= 0.55)
    assert not arrived
    assert 0.55 - accepted[-1] < 2 * min_step * 0.2
    assert stepper.accepted == accepted[-1]


def test_what_cannot_even_start_gives_up() -> None:
    accepted, arrived = walk(Stepper(4, 0.2), lambda start, stop: False, most=4)
    assert accepted == [] and not arrived


def test_relative_length() -> None:
    stepper = Stepper(4, 1e-3)
    road = stepper.proposals()
    next(road)
    assert stepper.relative_length == 1.0
    assert stepper.cut() and stepper.relative_length == 0.5
    next(road)
    assert stepper.cut() and stepper.relative_length == 0.25


def test_between_targets() -> None:
    start, end = Target(0.2, 1.0, None, 3.0), Target(1.0, 0.0, None, -1.0)
    between = end.between(start, 0.25)
    assert between.mechanical == pytest.approx(0.4)
    assert (between.field, between.volume, between.pressure) == (0.75, None, 2.0)
    assert end.between(start, 1.0) == Target(1.0, 0.0, None, -1.0)
    assert end.between(start, 0.25, squared=True).field == pytest.approx(0.75**0.5)
    reversed_field = Target(0.0, -2.0, None).between(Target(0.0, -1.0, None), 0.5, squared=True)
    assert reversed_field.field == pytest.approx(-(2.5**0.5))
    controlled = Target(1.0, 1.0, 8.0)
    assert controlled.between(Target(0.0, 0.0, 1.0), 0.5).volume == 4.5
    assert controlled.between(Target(0.0, 0.0, None), 0.5).volume == 8.0


def test_a_stage_names_its_end() -> None:
    assert stage_target(Stage(mechanical=0.5, field=2.0), None) == Target(0.5, 2.0, None, None)
    assert stage_target(Stage(mechanical=0.5), -4.0) == Target(0.5, 1.0, None, -2.0)
    assert stage_target(Stage(volume_ratio=3.0), -4.0).volume == 3.0


def test_a_target_reports_what_it_controls() -> None:
    assert Target(0.5, 1.0, None).report() == {"mechanical": 0.5, "field": 1.0}
    assert Target(0.5, 1.0, 2.0).report() == {"mechanical": 0.5, "field": 1.0, "volume_ratio": 2.0}


@pytest.mark.parametrize(
    ("stage", "with_field", "expected"),
    [
        ({}, False, None),
        ({}, True, None),
        ({"steps": 7}, False, 7),
        ({"steps": 7, "control": "arc-length"}, True, None),
        ({"control": "load"}, False, 10),
        ({"volume_ratio": 2.0}, False, 10),
        ({"volume_ratio": 2.0, "control": "arc-length"}, False, None),
        ({"until": {"where": [0, 0, 1], "axis": "z", "value": 1}}, True, None),
        ({"steps": 3, "branch": {}}, False, None),
    ],
)
def test_which_stages_are_followed(stage: dict[str, Any], with_field: bool, expected: int | None) -> None:
    assert planned_steps(Stage(**stage), with_field=with_field) == expected


def test_a_load_that_is_held_needs_no_path() -> None:
    here = Target(1.0, 0.0, None)
    assert not followed(Stage(), here, Target(1.0, 0.0, None), with_field=False)
    assert not followed(Stage(), here, Target(1.0, 1.0, None), with_field=False)
    assert followed(Stage(), here, Target(1.0, 1.0, None), with_field=True)
    assert followed(Stage(field=0.0), Target(0.0, 0.0, None), here, with_field=True)


@pytest.mark.parametrize(
    ("stage", "words"),
    [
        ({"control": "volume"}, "needs volume_ratio"),
        ({"control": "load", "volume_ratio": 2.0}, "the volume is what is controlled"),
        ({"control": "displacement"}, "needs until"),
        ({"volume_ratio": 2.0, "until": {"where": [0, 0, 1], "axis": "z", "value": 1}}, "a stage ends at"),
        ({"control": "load", "branch": {}}, 'use control = "arc-length"'),
        ({"branch": {"amplitude": 0.0}}, "must not be 0"),
        ({"branch": {"amplitude": 0.6}}, "at most 0.5"),
    ],
)
def test_what_does_not_fit_together(stage: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneError, match=words):
        Stage(**stage)
