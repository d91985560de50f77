"""Solves without the estimate of their error, which costs as much as the way to the solution, for tests that look at
the solution alone. Estimates have tests of their own, on many of the same scenes: tests/solving/test_effectivity."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from embedding.solving import driver
from embedding.solving.estimate import Estimates


@contextmanager
def unestimated() -> Iterator[None]:
    """Solutions found meanwhile have neither ``error``, ``errors`` nor ``health``."""
    with pytest.MonkeyPatch.context() as patched:  # not the test's own, which it may undo
        patched.setattr(driver, "estimate_errors", lambda *_: Estimates({}, None, None, 0.0))
        patched.setattr(driver, "check_health", lambda *_: ())
        yield
