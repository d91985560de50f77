"""Text at the door: one printable line, not empty."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import BeforeValidator
from pydantic_core import PydanticCustomError


@dataclass(frozen=True)
class Line:
    """Validator of one line of printable text."""

    limit: int = 100

    @property
    def allowed(self) -> str:
        """What may stand here, in words."""
        return f"must be text on one line, of 1 to {self.limit} printable characters"

    def __call__(self, value: Any) -> str:
        if not isinstance(value, str) or not value.isprintable() or not 0 < len(value.strip()) <= len(value) <= self.limit:
            raise PydanticCustomError("refused", "{reason}", {"reason": self.allowed, "unit": ""})
        return value


Name = Annotated[str, BeforeValidator(Line())]
