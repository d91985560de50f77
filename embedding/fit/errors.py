"""The one error of this folder."""

from __future__ import annotations

from typing import ClassVar

from embedding.errors import EmbeddingError


class FitError(EmbeddingError):
    """Data that cannot be read or do not suffice, or a law that cannot be fitted; the message says which and why."""

    exit_code: ClassVar[int] = 2
