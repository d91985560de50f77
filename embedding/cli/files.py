"""Files the user names: checked first, so that a long solve cannot end at a mistyped folder."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import ClassVar

from embedding.errors import EmbeddingError


class UsageError(EmbeddingError):
    """The command line asks for what cannot be done; the message names the option, the value and why."""

    exit_code: ClassVar[int] = 2


def default_archive(name: str) -> Path:
    """Archive of a scene called ``name``: ``name.vtkhdf`` in this folder, unfit characters replaced."""
    stem = re.sub(r"[^\w.+-]+", "_", name).strip("._") or "scene"
    return Path(f"{stem}.vtkhdf")


def check_output(option: str, path: Path, suffix: str, *, read: Path | None = None, new: bool = False) -> Path:
    """Return ``path`` if a file with ``suffix`` can be written there: not over the one that is ``read``, and over none
    if it is to be ``new``.

    Raises:
        UsageError: wrong suffix, missing folder, a file or a folder of that name, or no permission.
    """
    folder = path.parent
    if path.suffix != suffix:
        raise UsageError(f"{option}: {str(path)!r} must end in {suffix!r}")
    if not folder.is_dir():
        raise UsageError(f"{option}: the folder {str(folder)!r} of {str(path)!r} does not exist")
    if path.is_dir():
        raise UsageError(f"{option}: {str(path)!r} is a folder, a file name is needed")
    if read is not None and path.exists() and read.exists() and path.samefile(read):
        raise UsageError(f"{option}: {str(path)!r} is the file that is read, and would be lost: name another")
    if new and path.exists():
        raise UsageError(f"{option}: {str(path)!r} exists already, and would be lost: name another")
    if not os.access(path if path.exists() else folder, os.W_OK):
        raise UsageError(f"{option}: no permission to write {str(path)!r}")
    return path


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A place to write to, which becomes ``path`` only if the block ends well: nothing is left half-written."""
    partial = path.with_name(f".{path.name}.partial")
    try:
        yield partial
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)
