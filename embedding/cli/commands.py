"""The commands and their options. Heavy imports stay inside a command: help and errors are fast."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter

from embedding import __version__
from embedding.cli.files import check_output, check_pictures, default_archive
from embedding.cli.output import print_json, print_solution, solution_summary

app = App(
    name="embedding",
    help="Nonlinear hyperelastic shells inside a free space with electric or magnetic fields.",
    version=__version__,
    suppress_keyboard_interrupt=False,  # the door answers for interrupts
    default_parameter=Parameter(show_default=False),
)

SceneFile = Annotated[Path, Parameter(help="Scene file (TOML).")]
ArchiveFile = Annotated[Path, Parameter(help="Archive (.vtkhdf) written by `embedding run`.")]
Overrides = Annotated[
    tuple[str, ...],
    Parameter(name="--set", negative="", help="Override a field: shell.thickness='0.1 mm'. May be repeated."),
]
AsJson = Annotated[bool, Parameter(name="--json", negative="", help="Print one JSON object instead of text.")]


@app.command
def run(
    scene: SceneFile,
    /,
    *,
    out: Annotated[Path | None, Parameter(help="Archive to write; default NAME.vtkhdf.")] = None,
    overrides: Overrides = (),
    as_json: AsJson = False,
    progress: Annotated[bool, Parameter(help="Show the progress on standard error.")] = True,
    picture: Annotated[Path | None, Parameter(help="Also draw the last step into this PNG file.")] = None,
) -> None:
    """Solve a scene and write its archive.

    ParaView opens the views beside it; `embedding info` and `embedding plot` read it. A solve that fails
    leaves the accepted steps in it (exit code 3).
    """
    from embedding.scene import load_scene

    stated = load_scene(scene, overrides)
    archive = check_output("--out", default_archive(stated.name) if out is None else out, ".vtkhdf")
    if picture is not None:
        check_pictures("--picture")
        check_output("--picture", picture, ".png")

    from embedding.api import solve

    solution = solve(stated, archive=archive, progress=progress)
    if picture is not None:
        pass
    if as_json:
        print_json({**solution_summary(solution), "picture": picture})
    else:
        print_solution(solution)
        if picture is not None:
            print(f"  picture: {picture}")


@app.command
def explain(scene: SceneFile, /, *, overrides: Overrides = (), as_json: AsJson = False) -> None:
    """Say what will be modelled, what is left out and why, without solving anything."""
    from embedding.scene import load_scene

    stated = load_scene(scene, overrides)

    from embedding import plan as planning

    plan = planning.explain(stated)
    if as_json:
        decisions = [{"topic": d.topic, "choice": d.choice, "reason": d.reason} for d in plan.decisions]
        print_json({"scene": stated.name, "decisions": decisions})
    else:
        print(plan.text())


@app.command
def info(archive: ArchiveFile, /, *, as_json: AsJson = False) -> None:
    """Tell what is in an archive: how the run ended, its steps, its error estimate and its cost."""
    from embedding.archive import open_archive
    from embedding.cli.info import archive_summary, print_archive

    opened = open_archive(archive)
    if as_json:
        print_json(archive_summary(opened))
    else:
        print_archive(opened)
