"""A conducting balloon at a voltage inside a grounded sphere of four times its radius: a limit, the pull-in voltage.

Physics: as the charged balloon, with E = V R_o / (b (R_o - b)) on the outer face at b. The pull grows faster than the
elastic resistance; past the pull-in voltage there is no equilibrium, and the solve ends with Result.PULL_IN.

Reference: `problems.exact.charged_balloon`, thick sphere (opened interface) and membrane with the field at its
mid-surface (closed): eps V^2 / (4 mu T R) = (l - l^-5) (1 - l R / R_o)^2, pull-in at l = 1.616 for R_o = 4 R.

Run: about a second.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from embedding import Listener, Scene, Solution, load_scene, solve
from problems.charged_balloon import error, exact, reference
from problems.common import print_files, print_steps

SCENE = Path(__file__).with_suffix(".toml")

__all__ = ["at_voltage", "error", "exact", "reference", "run", "scene"]


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"ambient.radius=60 mm"``."""
    return load_scene(SCENE, changes)


def at_voltage(voltage: float) -> tuple[str, ...]:
    """Overrides for another voltage, in V."""
    return f"faces.top.voltage={voltage!r}", f"faces.bottom.voltage={voltage!r}"


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = (), throw: bool = True) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners, throw=throw)


if __name__ == "__main__":
    solution = run(archive=Path("grounded_balloon.vtkhdf"))
    columns = {"voltage / kV": solution["voltage"] / 1e3, "stretch": solution["stretch"]}
    print_steps(columns | {"exact": reference(solution), "p_t / Pa": solution["pressure_top"]})
    print(f"largest error of the stretch: {error(solution):.1e}")
    limit = exact(scene()).pull_in()
    beyond = run(*at_voltage(400e3), throw=False)
    if limit is not None:
        print(f"pull-in: exact {limit.load / 1e3:.2f} kV at stretch {limit.stretch:.3f}; on the way to 400 kV:")
        print(f"  {beyond.result.name} after {beyond['voltage'][-1] / 1e3:.2f} kV, stretch {beyond['stretch'][-1]:.3f}")
    print_files(solution)
