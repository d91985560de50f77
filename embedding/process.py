"""A process that does one thing and ends: imports and the end without a look for garbage, which takes as long as the
import of ngsolve.

What is imported stays, and what is left at the end goes with the process.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager

_own = _abandoned = False
RARELY = 50_000
"""Objects that are made before garbage is looked for: a step makes some thousand, of which few are garbage."""


def begin() -> None:
    """This process is ours: what it has imported need never be looked at again, and the rest seldom."""
    global _own
    _own = True
    gc.set_threshold(RARELY, *gc.get_threshold()[1:])


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


def abandon() -> None:
    """A library was stopped half way and would stumble at the end of the process: then it is ended at once."""
    global _abandoned
    _abandoned = True


def leave(code: int) -> None:
    """This process ends with ``code``: nothing of it need be taken apart."""
    gc.freeze()
    if _abandoned:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
