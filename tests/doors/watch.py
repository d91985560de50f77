"""What no input may do: run code, start a process, unpickle, or take for ever."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

FORBIDDEN = ("exec", "os.system", "os.exec", "os.posix_spawn", "subprocess.Popen", "pickle.find_class", "ctypes.dlopen")
OF_TYPES = (
    "typing.py",
    "dataclasses.py",
    "collections/__init__.py",
    "attr/_make.py",
    "functools.py",
    "inspect.py",
    "scipy/optimize/_nonlin.py",
)
"""Modules that make classes, and types of annotations, out of texts of their own."""
LIMIT = 30.0
"""Seconds for one case; what is slow takes some tenths."""

_seen: list[str] | None = None
_hooked = False


def _hook(event: str, arguments: tuple[Any, ...]) -> None:
    if _seen is None or event not in FORBIDDEN:
        return
    name = getattr(arguments[0], "co_filename", "") if event == "exec" and arguments else ""
    caller = sys._getframe(1).f_code.co_filename
    if not name.endswith(".py") and "importlib" not in name and not caller.endswith(OF_TYPES):
        _seen.append(f"{event} {name} by {caller}")


@contextmanager
def watched() -> Iterator[list[str]]:
    """The forbidden things that the interpreter does meanwhile, as its audit events; none of them should be there."""
    global _seen, _hooked
    if not _hooked:
        sys.addaudithook(_hook)
        _hooked = True
    _seen = found = []
    try:
        yield found
    finally:
        _seen = None


@contextmanager
def in_time(seconds: float = LIMIT) -> Iterator[None]:
    """Raise TimeoutError where the block takes longer."""

    def late(number: int, frame: Any) -> None:
        raise TimeoutError(f"not done after {seconds:g} s")

    former = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, former)
