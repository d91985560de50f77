"""The timers: parts inside parts, nothing lost, nothing done while nobody looks."""

from __future__ import annotations

import pytest

from embedding.timing import Watch, part, watching


class Clock:
    """A clock that goes on as it is told."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


@part("inner")
def inner(clock: Clock, seconds: float) -> float:
    clock.now += seconds
    return seconds


def test_every_second_is_of_one_part() -> None:
    clock = Clock()
    watch = Watch(clock)
    with watching(watch):
        clock.now += 1.0
        with part("outer"):
            clock.now += 2.0
            assert inner(clock, 4.0) == 4.0
            assert inner(clock, 8.0) == 8.0
            clock.now += 16.0
        inner(clock, 32.0)
    clock.now += 64.0
    watch.charge()
    assert watch.seconds == {(): 65.0, ("outer",): 18.0, ("outer", "inner"): 12.0, ("inner",): 32.0}
    assert watch.calls == {("outer",): 1, ("outer", "inner"): 2, ("inner",): 1}


def test_a_part_ends_with_an_error() -> None:
    clock = Clock()
    with watching(Watch(clock)) as watch:
        with pytest.raises(ValueError), part("outer"):
            clock.now += 1.0
            raise ValueError
        clock.now += 2.0
        watch.charge()
    assert watch.seconds == {(): 2.0, ("outer",): 1.0}


def test_nobody_looks() -> None:
    clock = Clock()
    watch = Watch(clock)
    assert inner(clock, 1.0) == 1.0
    with part("outer"):
        pass
    assert not watch.calls


def test_begun_before_anybody_looked() -> None:
    begun = part("outer")
    begun.__enter__()
    with watching(Watch(Clock())) as watch:
        begun.__exit__(None, None, None)
    assert not watch.calls
