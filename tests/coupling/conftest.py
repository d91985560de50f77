"""No test of the coupling looks at an error estimate."""

from __future__ import annotations

import pytest


@pytest.fixture(autouse=True)
def _of_solutions_alone(unestimated: None) -> None:
    """All of them."""
