"""Ctrl-C: the first ends the solve in good order, the second at once."""

from __future__ import annotations

import signal

import pytest

from embedding.cli.interrupts import Interrupts
from tests.cli.pretend import iteration


def test_the_first_waits_for_the_iteration(capfd: pytest.CaptureFixture[str]) -> None:
    before = signal.getsignal(signal.SIGINT)
    with Interrupts() as interrupts:
        interrupts.iterated(1, {}, iteration(1))
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            interrupts.iterated(1, {}, iteration(2))
        interrupts.iterated(1, {}, iteration(3))
    assert signal.getsignal(signal.SIGINT) is before
    assert capfd.readouterr().err == "", "only somebody at a terminal is told"


def test_the_second_does_not_wait() -> None:
    with pytest.raises(KeyboardInterrupt), Interrupts():
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)


def test_one_that_found_no_occasion_is_not_lost() -> None:
    with pytest.raises(KeyboardInterrupt), Interrupts():
        signal.raise_signal(signal.SIGINT)


def test_another_error_is_not_hidden() -> None:
    with pytest.raises(ZeroDivisionError), Interrupts():
        signal.raise_signal(signal.SIGINT)
        raise ZeroDivisionError
