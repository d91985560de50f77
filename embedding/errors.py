"""What can go wrong, as types. The text of every error is written for the person who runs the scene."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, ClassVar, NamedTuple


class Problem(NamedTuple):
    """One thing that is wrong with a scene: the dotted path of the field, and what is allowed there.

    ``path`` is empty when the scene as a whole is meant, for instance when its file cannot be read.
    """

    path: str
    message: str

    def __str__(self) -> str:
        return f"{self.path}: {self.message}" if self.path else self.message


class EmbeddingError(Exception):
    """Base of every error that the package raises on purpose; ``str(error)`` is the full message."""

    exit_code: ClassVar[int] = 1


class SceneError(EmbeddingError):
    """A scene that cannot be used.

    ``problems`` lists everything that was found, fields first; ``source`` names the file, if any.
    """

    exit_code: ClassVar[int] = 2

    def __init__(self, problems: Sequence[Problem], source: str | None = None) -> None:
        self.problems: tuple[Problem, ...] = tuple(problems)
        self.source = source
        super().__init__(self.problems, source)

    def __str__(self) -> str:
        if len(self.problems) == 1:
            prefix = f"{self.source}: " if self.source else ""
            return f"{prefix}{self.problems[0]}"
        title = f"{self.source or 'scene'}: {len(self.problems)} problems"
        return "\n".join([title, *(f"  {problem}" for problem in self.problems)])


class ArchiveError(EmbeddingError):
    """An archive that cannot be read, is not one of ours, or was never finished."""

    exit_code: ClassVar[int] = 2


class DamageError(ArchiveError):
    """An archive that was looked through and found damaged; ``details`` says what was found, as plain data."""

    def __init__(self, message: str, details: Mapping[str, Any]) -> None:
        self.details = dict(details)
        super().__init__(message, details)

    def __str__(self) -> str:
        return str(self.args[0])


class SolveError(EmbeddingError):
    """A solve that stopped early; ``solution`` holds the last good state and says what to try."""

    exit_code: ClassVar[int] = 3

    def __init__(self, message: str, solution: Any = None) -> None:
        self.solution = solution
        super().__init__(message, solution)

    def __str__(self) -> str:
        return str(self.args[0])


SHORT_OF_MEMORY = ("allocat", "out of memory", "not enough memory", "failed to map segment")
"""In the messages of ngsolve, netgen, HDF5 and the system where memory is what is missing."""


def out_of_memory(error: BaseException) -> bool:
    """Does ``error``, or what it comes from, say that memory is short?"""
    found: BaseException | None = error
    while found is not None:
        if isinstance(found, MemoryError) or any(word in str(found).lower() for word in SHORT_OF_MEMORY):
            return True
        found = found.__cause__ or found.__context__
    return False


@contextmanager
def memory_errors() -> Iterator[None]:
    """Whatever says within that memory is short is a MemoryError."""
    try:
        yield
    except EmbeddingError:
        raise
    except Exception as error:
        if isinstance(error, MemoryError) or not out_of_memory(error):
            raise
        raise MemoryError(" ".join(str(error).split())) from error
