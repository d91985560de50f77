"""Is there room on the disk? Asked before a commit: HDF5 leaves a file whose end is missing where it runs out of it."""

from __future__ import annotations

import errno
import os
import sys
import uuid
from contextlib import suppress
from pathlib import Path

SPARE = 1 << 21
"""Bytes for tables, indices and texts of a step."""


def require_room(path: Path, more: int) -> None:
    """Raises OSError if ``more`` bytes, and some to spare, do not fit behind the end of the file at ``path``: the disk
    is full, a quota or a limit on the size of files is met, or the folder is gone.

    Asked with a file beside it, which is gone at once: nothing is done to one that others may read or write.
    """
    more += SPARE
    if sys.platform != "win32":
        import resource

        size = path.stat().st_size if path.exists() else 0
        limit = resource.getrlimit(resource.RLIMIT_FSIZE)[0]
        if limit != resource.RLIM_INFINITY and size + more > limit:
            raise OSError(errno.EFBIG, os.strerror(errno.EFBIG))
    trial = path.with_name(f".{uuid.uuid4().hex[:8]}.room")
    descriptor = os.open(trial, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    try:
        trial.unlink()
        if hasattr(os, "posix_fallocate"):
            _allocate(descriptor, more)
    finally:
        os.close(descriptor)
        with suppress(FileNotFoundError):
            trial.unlink()


def _allocate(descriptor: int, size: int) -> None:
    try:
        os.posix_fallocate(descriptor, 0, size)
    except OSError as error:
        if error.errno not in (errno.EOPNOTSUPP, errno.EINVAL, errno.ENOSYS):  # by a file system that cannot say
            raise
