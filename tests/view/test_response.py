"""Response curves: what is solid, what is dashed, and where the limit point is."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from embedding import Scene, open_archive, solve
from embedding.errors import ArchiveError
from embedding.view import response_plot
from embedding.view.response import Response, response_figure

RADIUS, THICKNESS, MODULUS = 0.02, 2e-4, 1e5
BALLOON = f"""
name = "past_the_limit"
[shell]
thickness = {THICKNESS}
shape = {{ kind = "sphere", radius = {RADIUS} }}
material = {{ law = "neo-hookean", shear_modulus = {MODULUS} }}
[loads]
pressure_bottom = "1 kPa"
[[path]]
until = {{ where = ["20 mm", "0 mm", "0 mm"], axis = "x", value = "20 mm" }}
[discretisation]
shell_size = "10 mm"
"""


@pytest.fixture(scope="module")
def balloon(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A balloon that is followed to twice its size."""
    path = tmp_path_factory.mktemp("response") / "run.vtkhdf"
    solve(Scene.from_toml(BALLOON), archive=path, progress=False)
    return path


def test_a_balloon_past_its_limit(balloon: Path, tmp_path: Path) -> None:
    """Stable to the stretch 7^(1/6), p = 2 mu T / R (1/l - 1/l^7), unstable beyond (neo-Hookean membrane sphere)."""
    figure = response_figure(open_archive(balloon))
    (axes,) = figure.axes
    lines = {line.get_label(): line for line in axes.lines}
    assert [text.get_text() for text in axes.get_legend().get_texts()] == [
        "stable", "unstable", "accepted steps", "limit point"]  # fmt: skip
    assert not lines["stable"].is_dashed() and lines["unstable"].is_dashed()
    at = 7 ** (1 / 6)
    pressure = 2 * MODULUS * THICKNESS / RADIUS * (1 / at - 1 / at**7)
    (x,), (y,) = lines["limit point"].get_data()
    assert (x, y) == (pytest.approx(at, rel=2e-3), pytest.approx(pressure / 1e3, rel=1e-4))
    assert lines["stable"].get_xdata()[-1] == lines["unstable"].get_xdata()[0] == x
    assert axes.get_xlabel() == "mean stretch" and axes.get_ylabel() == "inflating pressure $p_b - p_t$ [kPa]"
    assert axes.get_title(loc="left") == "past the limit"
    assert response_plot(balloon, tmp_path / "r.png").stat().st_size > 10_000


def test_any_scalar_over_any_other(balloon: Path) -> None:
    archive = open_archive(balloon)
    response = Response.of(archive, "step", "elastic_energy")
    assert response.units == ("1", "J")
    np.testing.assert_array_equal(response.steps[:, 0], np.arange(1, len(archive) + 1))
    assert response.critical == () and {kind for kind, _ in response.pieces} == {"stable", "unstable"}
    with pytest.raises(ArchiveError, match="no scalar 'voltage'; there are step, displacement"):
        response_figure(archive, x="voltage")


def faked(counts: list[float], pressures: list[float], critical: tuple[Any, ...] = ()) -> Any:
    """The face of an archive of a balloon."""
    steps = len(counts)
    scalars = {
        "pressure_difference": np.array(pressures),
        "stretch": np.linspace(1.0, 2.0, steps),
        "volume_ratio": np.ones(steps),
        "unstable_modes": np.array(counts),
    }
    stages = [SimpleNamespace(stage="one")] * steps
    units = dict.fromkeys(scalars, "1")
    return type("Faked", (), {
        "scalars": scalars, "steps": stages, "scalar_units": units, "critical_points": critical,
        "path": Path("x"), "run": {"name": "x"}, "__len__": lambda self: steps,
    })()  # fmt: skip


def test_a_branch_point_and_unknown_stability() -> None:
    point = SimpleNamespace(
        kind="bifurcation", before_step=3, unstable=(0, 2), factor_mechanical=1.0, factor_field=1.0,
        scalars={"stretch": 1.4, "pressure_difference": 2.5},
    )  # fmt: skip
    response = Response.of(faked([0, 0, 2, np.nan], [1.0, 2.0, 3.0, 4.0], (point,)))
    assert [kind for kind, _ in response.pieces] == ["stable", "unstable", "stability not known"]
    assert response.critical == (("bifurcation", 1.4, 2.5),)
    figure = response_figure(faked([0, 0, 2, np.nan], [1.0, 2.0, 3.0, 4.0], (point,)))
    assert "bifurcation point" in [text.get_text() for text in figure.axes[0].get_legend().get_texts()]


def test_a_load_that_turns_by_itself() -> None:
    """Under a given volume no state is critical; where the pressure is largest is marked: a parabola's vertex."""
    stretch = np.linspace(1.0, 2.0, 6)
    response = Response.of(faked([0] * 6, list(3.0 - (stretch - 1.45) ** 2)))
    ((kind, x, y),) = response.critical
    assert (kind, x, y) == ("turning", pytest.approx(1.45), pytest.approx(3.0))


def test_one_step_alone() -> None:
    assert Response.of(faked([0], [1.0]), "stretch", "pressure_difference").pieces[0][0] == "stable"
