"""Scenes as TOML files. Whatever is wrong with a file is one line that names it."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import tomli_w

from embedding.errors import Problem, SceneError
from embedding.scene.depth import TOO_DEEP, too_deep
from embedding.scene.overrides import apply_overrides
from embedding.scene.scene import Scene

MAX_BYTES = 4_000_000


def load_scene(path: str | os.PathLike[str], overrides: Sequence[str] = ()) -> Scene:
    """Read a scene file, then apply ``overrides`` such as ``"shell.thickness=0.1 mm"`` in their order.

    Raises:
        SceneError: the file cannot be read, is not TOML, or is not a scene; or an override does not fit.
    """
    source = os.fspath(path)
    table = read_table(read_text(source), source)
    return Scene.from_table(apply_overrides(table, overrides, source), source)


def read_table(text: str, source: str | None = None) -> dict[str, Any]:
    """Parse TOML.

    Raises:
        SceneError: not TOML; the message gives line and column.
    """
    try:
        table = tomllib.loads(text)
    except RecursionError:
        raise _unreadable(TOO_DEEP, source) from None
    except ValueError as error:  # TOMLDecodeError, and numbers or dates that Python refuses
        reason = " ".join(str(error).split())
        raise _unreadable(f"not valid TOML: {reason}", source) from error
    if too_deep(table):
        raise _unreadable(TOO_DEEP, source)
    return table


def write_table(table: Mapping[str, Any]) -> str:
    """Nested tables as TOML text."""
    return tomli_w.dumps(table)


def read_text(source: str) -> str:
    """The text of a file of this package.

    Raises:
        SceneError: the file cannot be read, is too large, or is not UTF-8.
    """
    try:
        with Path(source).open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except FileNotFoundError:
        raise _unreadable("there is no such file", source) from None
    except IsADirectoryError:
        raise _unreadable("this is a directory, not a scene file", source) from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise _unreadable(f"cannot be read: {reason}", source) from error
    if len(data) > MAX_BYTES:
        raise _unreadable(f"too large for a scene file: more than {MAX_BYTES} bytes", source)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise _unreadable(f"not UTF-8 text: byte {error.start} cannot be decoded", source) from error


def _unreadable(message: str, source: str | None) -> SceneError:
    return SceneError([Problem("", message)], source)
