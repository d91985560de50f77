"""What every test starts from: one BLAS thread before ngsolve is loaded, and fixed random numbers."""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # read once, when ngsolve loads OpenBLAS

import gc
import random
from collections.abc import Iterator
from contextlib import nullcontext
from typing import Any

import numpy as np
import pytest
from hypothesis import settings

settings.register_profile("reproducible", derandomize=True, deadline=None)
settings.load_profile("reproducible")


def pytest_collection_finish() -> None:
    """What is imported and collected stays: no garbage need be looked for in it."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, *gc.get_threshold()[1:])


@pytest.fixture(autouse=True)
def fixed_random_numbers() -> Iterator[None]:
    """Same numbers in every run and in every order of the tests."""
    random.seed(20240229)
    np.random.seed(20240229)
    yield


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: Any, log: Any) -> Any:
    """Runs of tests stay on one process, which keeps what a module solves once; the idle one takes from the end."""
    from xdist.scheduler import WorkStealingScheduling

    return WorkStealingScheduling(config, log)


@pytest.fixture(name="unestimated")
def _unestimated(request: pytest.FixtureRequest) -> Iterator[None]:
    """The test solves ``unestimated``, unless it is marked ``estimated``."""
    from tests.unestimated import unestimated

    with nullcontext() if request.node.get_closest_marker("estimated") else unestimated():
        yield
