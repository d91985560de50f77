"""Print every benchmark: ``python -m benchmarks`` (about ten minutes on one core)."""

from __future__ import annotations

import resource

from benchmarks import (
    archive_writing,
    continuation,
    coupled_step,
    coupling_rungs,
    disc_capacitance,
    far_field,
    newton_step,
    shell_step,
    start_up,
)


def main() -> None:
    """Run and print all benchmarks, and the peak memory of this process."""
    for benchmark in (
        newton_step, coupled_step, coupling_rungs, far_field, disc_capacitance, shell_step, continuation,
        archive_writing, start_up,
    ):  # fmt: skip
        print((benchmark.__doc__ or "").splitlines()[0])
        for line in benchmark.report():
            print(f"  {line}", flush=True)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"Peak memory of this process: {peak:.0f} MB")


if __name__ == "__main__":
    main()
