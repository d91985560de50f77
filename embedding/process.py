"""A process that does one thing and ends: imports and the end without a look for garbage, which takes as long as the
import of ngsolve.

What is imported stays, and what is left at the end goes with the process.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

_own = False


def begin() -> None:
    """This process is ours: what it has imported need never be looked at again."""
    global _own
    _own = True


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
        if _own:
            gc.freeze()
        gc.enable()


def leave() -> None:
    """This process ends: nothing of it need be taken apart."""
    gc.freeze()
