"""The index of a study: one line of JSON for every case that has ended; the last line of a case is the one that counts.

A line is appended by one write and synced: a process that is killed leaves whole lines and at most a torn last one,
which is dropped. Any tool reads it, while the study runs, too; an HDF5 file that is being appended to does not survive
a kill, and SQLite's locks are not to be trusted on the network folders of a cluster.
"""

from __future__ import annotations

import errno
import json
import os
import sys
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from embedding.studies.errors import StudyError
from embedding.studies.record import without_nan

Records = dict[str, dict[str, Any]]


def read_index(path: Path) -> Records:
    """The record of every case, by its hash; empty if there is no index yet.

    Raises:
        StudyError: a line that was written whole is damaged.
    """
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        return {}
    except OSError as error:
        raise StudyError(f"{path}: cannot be read: {error.strerror or error}") from error
    records: Records = {}
    for number, line in enumerate(data[: _whole(data)].splitlines(), start=1):
        try:
            record = json.loads(line)
            records[record["case"]] = record
            record["status"]
        except (ValueError, KeyError, TypeError) as error:
            advice = "remove it and run the study again; cases that are done are not solved again"
            raise StudyError(f"{path}: line {number} is damaged: {advice}") from error
    return records


class Index:
    """The index, open for one process that runs the study; others are refused. Use as a context manager.

    Raises:
        StudyError: another process runs this study, or the index is damaged or cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.records: Records = {}
        self._file = -1

    def __enter__(self) -> Self:
        try:
            self._file = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
        except OSError as error:
            raise StudyError(f"{self.path}: cannot be written: {error.strerror or error}") from error
        try:
            self._lock()
            self.records = read_index(self.path)
            os.ftruncate(self._file, _whole(self.path.read_bytes()))
        except BaseException:
            os.close(self._file)
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        os.close(self._file)

    def append(self, record: dict[str, Any]) -> None:
        """Add the record of a case; it is on the disk when this returns."""
        record = without_nan(record)
        line = json.dumps(record, allow_nan=False).encode() + b"\n"
        try:
            if os.write(self._file, line) != len(line):
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            os.fsync(self._file)
        except OSError as error:
            advice = "cases that are done are not solved again when the study is run again"
            raise StudyError(f"{self.path}: cannot be written: {error.strerror}; {advice}") from error
        self.records[record["case"]] = record

    def _lock(self) -> None:
        """Held by the file's descriptor, so that it goes with the process, however that ends."""
        if sys.platform == "win32":
            return
        import fcntl

        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise StudyError(f"{self.path.parent}: another process is running this study") from error


def _whole(data: bytes) -> int:
    """Bytes up to the end of the last whole line."""
    return data.rfind(b"\n") + 1
