"""The door: every way a command can end becomes an exit code and one message, never a traceback."""

from __future__ import annotations

import os
import sys
from typing import Any

from cyclopts import CycloptsError

from embedding.cli.commands import app
from embedding.cli.output import print_json
from embedding.errors import DamageError, EmbeddingError, SceneError, SolveError, out_of_memory

BAD_INPUT, NO_MEMORY, INTERRUPTED, DEFECT = 2, 3, 130, 1
DEBUG = "EMBEDDING_DEBUG"


def enter(arguments: list[str]) -> int:
    """Run one command; returns its exit code and has printed either its output or one error message."""
    as_json = "--json" in arguments
    try:
        code = app(arguments, exit_on_error=False, print_error=False, result_action="return_value")
        sys.stdout.flush()
        return code if isinstance(code, int) else 0
    except CycloptsError as error:
        return _leave(BAD_INPUT, {"kind": "usage", "message": f"{error} (see embedding --help)"}, as_json)
    except SceneError as error:
        problems = [problem._asdict() for problem in error.problems]
        report = {"kind": "scene", "message": str(error), "problems": problems}
        return _leave(error.exit_code, report, as_json)
    except SolveError as error:
        return _solve_failed(error, as_json)
    except DamageError as error:
        return _leave(error.exit_code, {"kind": "archive", "message": str(error), **error.details}, as_json)
    except EmbeddingError as error:
        kind = type(error).__name__.removesuffix("Error").lower()
        return _leave(error.exit_code, {"kind": kind, "message": str(error)}, as_json)
    except KeyboardInterrupt:
        return _leave(INTERRUPTED, {"kind": "interrupted", "message": "interrupted"}, as_json)
    except BrokenPipeError:
        # The reader of our output has gone (`embedding info ... | head`); what it wanted, it has.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:
        return _leave(BAD_INPUT, {"kind": "file", "message": str(error)}, as_json)
    except Exception as error:
        if out_of_memory(error):
            message = f"there is not enough memory for this: {error}".removesuffix(": ")
            return _leave(NO_MEMORY, {"kind": "memory", "message": message}, as_json)
        if os.environ.get(DEBUG):
            raise
        message = (
            f"{type(error).__name__}: {error}\nThis is a defect of embedding, not of your input. "
            f"Set {DEBUG}=1 to see where it happened, and please report it."
        )
        return _leave(DEFECT, {"kind": "defect", "message": message}, as_json)


def _solve_failed(error: SolveError, as_json: bool) -> int:
    """Report a typed failure of the solver, with what is left of the run."""
    solution = error.solution
    result = getattr(getattr(solution, "result", None), "name", "failed")
    archive = getattr(solution, "archive", None)
    steps = len(getattr(solution, "steps", ()))
    message = str(error)
    if archive is not None:
        message += f"\nThe record of the run is in {archive}."
    report = {"kind": "solve", "message": message, "result": result, "steps": steps}
    if archive is not None:
        report["archive"] = str(archive)
    return _leave(INTERRUPTED if result.lower() == "interrupted" else error.exit_code, report, as_json)


def _leave(code: int, report: dict[str, Any], as_json: bool) -> int:
    """Print the one message of an error, as text on standard error or as JSON on standard output."""
    if as_json:
        print_json({"error": report})
    else:
        print(f"error: {report['message']}", file=sys.stderr)
    return code
