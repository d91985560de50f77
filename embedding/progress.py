"""Progress of a solve on standard error: a live panel on a terminal, plain lines elsewhere.

What draws the panel is imported on a terminal only.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from types import TracebackType
from typing import TYPE_CHECKING, Self

from embedding.solving.events import Iteration, Listener, StepRecord
from embedding.solving.path import in_words, planned_steps

if TYPE_CHECKING:
    from rich.console import Console, Group
    from rich.live import Live
    from rich.table import Table

    from embedding.solving.problem import Problem
    from embedding.solving.solution import Solution
    from embedding.solving.state import State


class ProgressDisplay(Listener):
    """Shows stage, load, step, the Newton history of the present step and the time passed.

    Use as a context manager around the solve, so that an exception leaves the terminal as it was.
    """

    def __init__(self, console: Console | None = None, clock: Callable[[], float] = time.monotonic) -> None:
        self.console = console if console is not None or not sys.stderr.isatty() else _terminal()
        self.clock = clock
        self.began = clock()
        self.title, self.planned, self.stage_ends = "", 0, list[tuple[int, str]]()
        self.accepted_steps, self.step_number = 0, 1
        self.target: dict[str, float] = {}
        self.ramped: tuple[str, ...] = ()
        self.counted = True
        self.heading, self.counts = "Newton", "iterations"
        self.newton: list[Iteration] = []
        self.last: StepRecord | None = None
        self.note = ""
        self.live: Live | None = None

    def __enter__(self) -> Self:
        if self.console is not None and self.console.is_terminal:
            from rich.live import Live

            self.live = Live(get_renderable=self.panel, console=self.console, refresh_per_second=5, transient=True)
            self.live.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self.live is not None:
            self.live.stop()
            self.live = None

    # What the solver tells.

    def started(self, problem: Problem) -> None:
        """The problem is meshed: say what will be solved."""
        stages = problem.scene.path
        self.ramped = problem.scene.ramped
        with_field = problem.scene.ambient is not None
        joint = problem.plan.coupling == "joint"
        if problem.plan.coupling == "staggered":
            self.heading, self.counts = "turn", "turns"
        counts = [planned_steps(stage, with_field=with_field, joint=joint) for stage in stages]
        self.stage_ends = []
        for stage, count in zip(stages, counts, strict=True):
            if count is None:
                break
            self.planned += count
            self.stage_ends.append((self.planned, stage.name))
        self.counted = None not in counts
        steps = f"{self.planned} steps" if self.counted else "steps of its own choice"
        self.title = f"{problem.scene.name}: {problem.reduction.name}, {steps}"
        self._line(self.title)

    def iterated(self, step_number: int, target: dict[str, float], iteration: Iteration) -> None:
        """Keep the Newton history of the present step."""
        if step_number != self.step_number or iteration.number <= (self.newton[-1].number if self.newton else -1):
            self.newton = []
        self.step_number, self.target = step_number, dict(target)
        self.newton.append(iteration)

    def accepted(self, state: State, record: StepRecord) -> None:
        """A step is done."""
        self.accepted_steps, self.last, self.note = self.accepted_steps + 1, record, ""
        # On a path the load is an unknown: what the last iteration aimed at is not where the step ended.
        ended = {"mechanical": record.factor_mechanical, "field": record.factor_field}
        self.target |= {name: value for name, value in ended.items() if name in self.target}
        self._line(
            f"step {self._of(record.number)} ({record.stage}): {self._load()}, "
            f"{len(record.iterations)} {self.counts}{self._stretch(record)}, {self._elapsed()}"
        )

    def cut(self, step_number: int, fraction: float, reason: str) -> None:
        """A step failed and is tried again, shorter."""
        self.newton = []
        self.note = f"step {step_number} is retried at {fraction:.4g} of its length: {reason}"
        self._line(self.note)

    def remeshed(self, problem: Problem) -> None:
        """The space around the shell has a new mesh."""
        self.newton = []
        self._line(f"the space around the shell is meshed anew: {problem.mesh.ne} elements")

    def finished(self, solution: Solution) -> None:
        """The path has ended."""
        result = solution.result.name.lower().replace("_", " ")
        self._line(f"{result}, {self._elapsed()}")

    # What people see.

    def panel(self) -> Group:
        """The live picture: a bar over the steps, the present load and its Newton history."""
        from rich.console import Group
        from rich.progress_bar import ProgressBar
        from rich.table import Table
        from rich.text import Text

        total = max(self.planned, self.accepted_steps, 1)
        head = Table.grid(padding=(0, 2))
        head.add_row(
            Text(self.title or "preparing", style="bold"),
            ProgressBar(total=total if self.counted else None, completed=self.accepted_steps, width=24),
            f"{self._of(self.accepted_steps)} steps",
            self._elapsed(),
        )
        parts: list[Table | Text] = [head]
        if self.newton:
            parts.append(Text(f"step {self.step_number}, {self._stage()}: {self._load()}"))
            parts.append(self._history())
        if self.last is not None:
            parts.append(Text(f"last accepted: step {self.last.number}{self._stretch(self.last)}", style="dim"))
        if self.note:
            parts.append(Text(self.note, style="yellow"))
        return Group(*parts)

    def _history(self) -> Table:
        """Newton steps of the present load step, the newest eight."""
        from rich.table import Table

        table = Table(box=None, padding=(0, 2), header_style="dim")
        for heading in (self.heading, "update", "residual", "p_t [Pa]", "p_b [Pa]"):
            table.add_column(heading, justify="right")
        for one in self.newton[-8:]:
            table.add_row(
                str(one.number),
                f"{one.update:.2e}",
                f"{one.residual:.2e}",
                f"{one.pressure_top:.5g}",
                f"{one.pressure_bottom:.5g}",
            )
        return table

    def _stage(self) -> str:
        """Name of the stage the present step belongs to."""
        for end, name in self.stage_ends:
            if self.step_number <= end:
                return name
        if not self.counted and self.last is not None:
            return self.last.stage
        return self.stage_ends[-1][1] if self.stage_ends else ""

    def _of(self, number: int) -> str:
        """A step among those that are planned, where they are."""
        return f"{number}/{max(self.planned, number)}" if self.counted else f"{number}"

    def _load(self) -> str:
        """The load of the present step in words, without what the scene does not have."""
        return in_words(self.target, self.ramped).replace("_", " ")

    def _stretch(self, record: StepRecord) -> str:
        """The mean stretch of an accepted step, if the solver gave one."""
        return f", stretch {record.scalars['stretch']:.6g}" if "stretch" in record.scalars else ""

    def _elapsed(self) -> str:
        minutes, rest = divmod(int(self.clock() - self.began), 60)
        return f"{minutes:d}:{rest:02d}"

    def _line(self, text: str) -> None:
        """A plain line where there is no terminal to draw on."""
        if self.console is None:
            print(text, file=sys.stderr, flush=True)
        elif self.live is None:
            self.console.print(text, soft_wrap=True, markup=False, highlight=False)


def _terminal() -> Console:
    from rich.console import Console

    return Console(stderr=True)
