"""Progress of a study on standard error: bars for the whole and the running cases, plain lines without a terminal."""

from __future__ import annotations

from collections.abc import Iterable
from types import TracebackType
from typing import Any, Self

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TaskID, TextColumn, TimeElapsedColumn

from embedding.studies.cases import Case
from embedding.studies.files import StudyFolder, read_json
from embedding.studies.record import DONE


class StudyDisplay:
    """Shows how many cases have ended, and how far the running ones are. Use as a context manager around the study."""

    def __init__(
        self, name: str, total: int, reused: int, quiet: bool = False, console: Console | None = None
    ) -> None:
        self.console = Console(stderr=True, quiet=quiet) if console is None else console
        columns = (
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
        )
        live = self.console.is_terminal and not self.console.quiet
        self.progress = Progress(*columns, console=self.console, transient=True, disable=not live)
        self.name, self.total, self.ended, self.reused = name, total, reused, reused
        self.whole = self.progress.add_task(name, total=total, completed=reused)
        self.bars: dict[str, TaskID] = {}

    def __enter__(self) -> Self:
        self.progress.start()
        known = f", {self.reused} known" if self.reused else ""
        self._line(f"{self.name}: {self.total} cases{known}")
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.progress.stop()

    def refresh(self, folder: StudyFolder, running: Iterable[Case]) -> None:
        """Look how far the running cases are."""
        if self.progress.disable:
            return
        for case in running:
            told = read_json(folder.case(case.key).progress)
            if told is not None:  # it has begun
                if case.key not in self.bars:
                    self.bars[case.key] = self.progress.add_task(_title(case), total=None)
                bar, title = self.bars[case.key], f"{_title(case)} {told['stage']}"
                self.progress.update(bar, description=title, total=told["planned"], completed=told["step"])

    def finished(self, case: Case, record: dict[str, Any]) -> None:
        """A case has ended."""
        self.ended += 1
        self.progress.update(self.whole, completed=self.ended)
        if case.key in self.bars:
            self.progress.remove_task(self.bars.pop(case.key))
        status = record["status"]
        if status == DONE:
            self._line(f"{self.ended}/{self.total} {_title(case)}: done in {record['seconds']:.1f} s")
        else:
            self._print(f"{self.ended}/{self.total} {_title(case)}: {status}: {record['reason']}")

    def _line(self, text: str) -> None:
        """A plain line where there are no bars."""
        if self.progress.disable:
            self._print(text)

    def _print(self, text: str) -> None:
        self.console.print(text, soft_wrap=True, markup=False, highlight=False)


def _title(case: Case) -> str:
    return f"case {case.number + 1}"
