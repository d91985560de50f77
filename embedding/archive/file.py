"""Opening an archive for reading, whatever state it is in, and saying plainly what is wrong with it if it
is useless."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import h5py

from embedding.archive.layout import SCHEMA
from embedding.archive.views import viewed_archive
from embedding.errors import ArchiveError, EmbeddingError

SIGNATURE = b"\x89HDF\r\n\x1a\n"
PATIENCE, PAUSE, ATTEMPTS = 0.5, 0.02, 200  # s: a live run closes its file soon after it last wrote to it


@contextmanager
def reading(path: Path) -> Iterator[Any]:
    """The HDF5 file at ``path``, open for reading; also one that a killed run left open.

    HDF5 marks a file as "open for writing" and refuses it from then on if the writer died. What was
    committed is whole nevertheless (see ``writer.py``), so the mark is passed by, which a Python file
    object allows.

    Raises ArchiveError, naming ``path`` and what is wrong with it: missing, a folder, not HDF5, truncated,
    damaged, not written by this package, or written by a newer version of it.
    """
    check_signature(path)
    with ExitStack() as stack:
        try:
            file = stack.enter_context(opened_for_reading(path, stack))
        except OSError as error:
            raise ArchiveError(f"{path}: {_reason(error)}") from error
        try:
            check_origin(path, file)
            yield file
        except EmbeddingError:
            raise
        except Exception as error:  # where bytes are wrong, HDF5 and h5py fail in many ways
            raise ArchiveError(f"{path}: the archive is damaged: {error}") from error


def opened_for_reading(path: Path, stack: ExitStack) -> Any:
    """The HDF5 file at ``path``, whether or not it is marked as open for writing; ``stack`` closes what is below it.
    Raises OSError."""
    for _ in range(ATTEMPTS):
        try:
            return h5py.File(path, "r", locking=False)
        except OSError as error:
            if "already open" not in str(error) and "truncated" not in str(error):
                raise
        if abs(time.time() - path.stat().st_mtime) > PATIENCE:
            break
        time.sleep(PAUSE)
    return h5py.File(stack.enter_context(path.open("rb")), "r")


def check_target(target: str | os.PathLike[str]) -> Path:
    """Return ``target`` as a path if an archive can be written there.

    Raises ArchiveError if it is a folder, if its folder does not exist, or if writing is not permitted.
    """
    path = Path(target)
    if path.is_dir():
        raise ArchiveError(f"{path}: is a folder; an archive needs the name of a file")
    if not path.parent.is_dir():
        raise ArchiveError(f"{path}: the folder {path.parent} does not exist")
    if not os.access(path.parent, os.W_OK):
        raise ArchiveError(f"{path}: no permission to write into the folder {path.parent}")
    return path


def check_signature(path: Path) -> None:
    """Raises ArchiveError if the file is missing, or not HDF5."""
    if path.is_dir():
        raise ArchiveError(f"{path}: is a folder, not an archive")
    try:
        with path.open("rb") as stream:
            signature = stream.read(len(SIGNATURE))
    except FileNotFoundError:
        raise ArchiveError(f"{path}: no such archive") from None
    except OSError as error:
        raise ArchiveError(f"{path}: cannot be read: {error.strerror}") from error
    if signature != SIGNATURE:
        raise ArchiveError(f"{path}: {'is not an HDF5 file, so not an archive' if signature else 'is empty'}")


def check_origin(path: Path, file: Any) -> None:
    """Raises ArchiveError if the HDF5 file is not an archive of this version."""
    record = file.get("embedding")
    if record is None or "schema" not in record.attrs:
        archive = viewed_archive(path)
        hint = f"; it is a view file of {archive}, open that" if archive else ""
        raise ArchiveError(f"{path}: is an HDF5 file, but not an archive of embedding{hint}")
    schema = int(record.attrs["schema"])
    if schema != SCHEMA:
        raise ArchiveError(f"{path}: has layout {schema}; this version of embedding reads layout {SCHEMA}")


def _reason(error: OSError) -> str:
    text = str(error)
    if "truncated" in text:
        return "the archive is truncated, its end is missing"
    return f"the archive is damaged: {text}"
