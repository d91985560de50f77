"""Text at the door: one printable line, not empty."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import BeforeValidator

from embedding.scene.messages import refusal


@dataclass(frozen=True)
class Line:
    """Validator of one line of printable text."""

    limit: int = 100

    @property
    def allowed(self) -> str:
        """What may stand here, in words."""
        return f"must be text on one line, of 1 to {self.limit} printable characters"

    def __call__(self, value: Any) -> str:
        if not isinstance(value, str) or not value.isprintable():
            raise refusal(self.allowed)
        if not value.strip() or len(value) > self.limit:
            raise refusal(self.allowed)
        return value


def _different(value: Any) -> Any:
    if not isinstance(value, (list, tuple)) or len(set(map(str, value))) < len(value):
        raise refusal('must be a list of different names of faces, such as ["web"]')
    return value


Name = Annotated[str, BeforeValidator(Line())]
Names = Annotated[tuple[Name, ...], BeforeValidator(_different)]
FilePath = Annotated[str, BeforeValidator(Line(1000))]
