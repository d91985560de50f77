"""The command line, `embedding run|explain|info|...`: a thin layer over the library."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from embedding.process import begin, leave, loading


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line (default: ``sys.argv``) and return the exit code.

    0 fine, 2 bad input, 3 the solve failed, 130 interrupted; 1 is left for defects of the program itself.
    """
    if arguments is None:
        begin()
    with loading():
        from embedding.cli.door import enter
    code = enter(list(sys.argv[1:] if arguments is None else arguments))
    if arguments is None:
        leave(code)
    return code
