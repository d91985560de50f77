"""Imports and the end of a process without a look for garbage, which takes longer than the import of ngsolve.

What is imported stays, and what is left at the end goes with the process.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def loading() -> Iterator[None]:
    """Import within: no garbage is looked for."""
    if not gc.isenabled():
        yield
        return
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def leave() -> None:
    """This process ends: nothing of it need be taken apart."""
    gc.freeze()
