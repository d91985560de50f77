"""What can go wrong with a study as a whole. A case that goes wrong is no error but a row with its reason."""

from __future__ import annotations

import importlib.util
from typing import ClassVar

from embedding.errors import EmbeddingError


class StudyError(EmbeddingError):
    """A study that cannot be run or read; the message says why and what to do."""

    exit_code: ClassVar[int] = 2


def require(*packages: str, extra: str = "studies") -> None:
    """Raise StudyError, saying by which ``extra`` to install them, if packages are missing."""
    missing = [name for name in packages if importlib.util.find_spec(name) is None]
    if missing:
        raise StudyError(f'studies need {" and ".join(missing)}: pip install "embedding[{extra}]"')
