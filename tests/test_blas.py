"""Linear algebra where memory is short: told, and not waited for without end."""

from __future__ import annotations

import subprocess
import sys

import pytest

SHORT = """
import resource
import numpy, scipy.linalg
from embedding import blas
size = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (size + (16 << 20), resource.RLIM_INFINITY))
try:
    blas.{ready}()
except MemoryError:
    print("short")
"""


@pytest.mark.skipif(sys.platform != "linux", reason="sets a limit of the address space")
@pytest.mark.parametrize("ready", ["numpy_ready", "scipy_ready"])
def test_short_of_memory(ready: str) -> None:
    code = SHORT.format(ready=ready)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=True)
    assert done.stdout.strip() == "short"
