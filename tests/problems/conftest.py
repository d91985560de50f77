"""Problems are compared with what is known of them: nearly none of these tests looks at an error estimate."""

from __future__ import annotations

import pytest


@pytest.fixture(autouse=True)
def _of_solutions_alone(unestimated: None) -> None:
    """But for tests marked ``estimated``."""
