"""The commands and their options. Heavy imports stay inside a command: help and errors are fast."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter

from embedding import __version__
from embedding.cli.bench import bench_app
from embedding.cli.files import UsageError, check_output, default_archive, whole_file
from embedding.cli.output import print_json, print_solution, solution_summary
from embedding.cli.plot import plot
from embedding.cli.questions import balance, compare, integrals, probe
from embedding.process import loading

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
    accuracy: Annotated[float | None, Parameter(help="Relative error allowed; chooses mesh, order and models.")] = None,
    of: Annotated[tuple[str, ...], Parameter(negative="", help="Scalar that is to have it. May be repeated.")] = (),
    overrides: Overrides = (),
    as_json: AsJson = False,
    progress: Annotated[bool, Parameter(help="Show the progress on standard error.")] = True,
    picture: Annotated[Path | None, Parameter(help="Also draw the last step into this PNG file.")] = None,
) -> None:
    """Solve a scene and write its archive.

    ParaView opens the views beside it; `embedding info` and `embedding plot` read it. A solve that fails
    leaves the accepted steps in it (exit code 3).
    """
    with loading():
        from embedding.scene import load_scene

        stated = load_scene(scene, (*overrides, *_accuracy(accuracy, of)))
    archive = check_output("--out", default_archive(stated.name) if out is None else out, ".vtkhdf", read=scene)
    if picture is not None:
        from embedding.view.rendering import require_rendering

        check_output("--picture", picture, ".png", read=scene)
        require_rendering()

    with loading():
        from embedding.api import solve
        from embedding.archive import Recorder  # noqa: F401
        from embedding.cli.interrupts import Interrupts

    with Interrupts() as interrupts:
        solution = solve(stated, archive=archive, progress=progress, listeners=[interrupts])
    if picture is not None:
        from embedding import view

        with whole_file(picture) as file:
            view.picture(archive, file)
    if as_json:
        print_json({**solution_summary(solution), "picture": picture})
    else:
        print_solution(solution, picture)


def _accuracy(relative: float | None, of: tuple[str, ...]) -> tuple[str, ...]:
    """The options as overrides of the scene."""
    names = (f"accuracy.of=[{', '.join(repr(name) for name in of)}]",) if of else ()
    return (*((f"accuracy.relative={relative!r}",) if relative is not None else ()), *names)


@app.command
def resume(
    archive: ArchiveFile,
    /,
    *,
    as_json: AsJson = False,
    progress: Annotated[bool, Parameter(help="Show the progress on standard error.")] = True,
) -> None:
    """Go on with a run that was killed, interrupted or failed, from its last accepted step, in the same archive.

    With the same versions, threads and machine everything comes out as it would have without the interruption.
    """
    with loading():
        from embedding.api import resume as go_on
        from embedding.archive import Recorder  # noqa: F401
        from embedding.cli.interrupts import Interrupts
        from embedding.cli.output import warnings_told

    with Interrupts() as interrupts, warnings_told():
        solution = go_on(archive, progress=progress, listeners=[interrupts])
    if as_json:
        print_json(solution_summary(solution))
    else:
        print_solution(solution, None)


@app.command
def explain(scene: SceneFile, /, *, overrides: Overrides = (), as_json: AsJson = False) -> None:
    """Say what will be modelled, what is left out and why, without solving anything."""
    from embedding.scene import load_scene

    stated = load_scene(scene, overrides)

    from embedding import plan as planning

    plan = planning.explain(stated)
    if as_json:
        print_json({"scene": stated.name, "decisions": [asdict(decision) for decision in plan.decisions]})
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


@app.command
def verify(
    archive: ArchiveFile,
    /,
    *,
    save: Annotated[Path | None, Parameter(help="Write the steps that are whole into this archive.")] = None,
    as_json: AsJson = False,
) -> None:
    """Compare everything in an archive with its checksums: is it what its run wrote, and can the run go on?

    Exit code 2 if it is damaged; the message says what is, and which steps can be saved.
    """
    if save is not None:
        check_output("--save", save, ".vtkhdf", new=True)

    from embedding.archive import salvage
    from embedding.archive import verify as look
    from embedding.cli.info import verification_summary
    from embedding.errors import DamageError

    found = look(archive)
    summary = verification_summary(found)
    if save is not None:
        salvage(archive, save)
        summary["saved"] = save
    if not found.sound:
        saved = f". They are in {save}" if save is not None else ""
        raise DamageError(found.message + saved, summary)
    if as_json:
        print_json(summary)
    else:
        print(found.message)


app.command(bench_app)
app.command(plot)
for question in (probe, integrals, balance, compare):
    app.command(question)


@app.command
def export(
    archive: ArchiveFile,
    /,
    *,
    out: Annotated[Path | None, Parameter(help="New folder; default the archive's name.")] = None,
) -> None:
    """Write an archive as .pvd and .vtu files, which every version of ParaView reads with its time steps."""
    from embedding.archive import open_archive
    from embedding.view.export import export as write

    for path in write(open_archive(archive), archive.with_suffix("") if out is None else out):
        print(path)


@app.command
def fit(
    data: Annotated[Path, Parameter(help="CSV file with the columns mode, stretch, nominal_stress [unit].")],
    /,
    *,
    law: Annotated[str, Parameter(help="neo-hookean, mooney-rivlin, yeoh, gent or ogden.")],
    terms: Annotated[int, Parameter(help="Terms of the ogden law; default 3.")] = 3,
    relative: Annotated[bool, Parameter(negative="", help="Weigh every point by its own stress.")] = False,
    picture: Annotated[Path | None, Parameter(help="Also draw data and curves into this PNG file.")] = None,
    as_json: AsJson = False,
) -> None:
    """Fit a law to tests of a material and print the material as it stands in a scene file.

    Modes are uniaxial, equibiaxial and pure-shear; nominal stress is force per undeformed area.
    """
    if picture is not None:
        from embedding.view.rendering import require_packages

        check_output("--picture", picture, ".png", read=data)
        require_packages()

    from embedding import fit as fitting
    from embedding.cli.fit import fit_summary, print_fit

    found = fitting.fit_law(law, fitting.read_measurements(data), terms=terms, relative=relative)
    if picture is not None:
        with whole_file(picture) as file:
            fitting.fit_picture(found, file)
    if as_json:
        print_json({**fit_summary(found), "picture": picture})
    else:
        print_fit(found, picture)


@app.command
def study(
    file: Annotated[Path, Parameter(help="Study file (TOML).")],
    /,
    *,
    folder: Annotated[Path | None, Parameter(help="Folder of the results; default the study file's name.")] = None,
    workers: Annotated[int | None, Parameter(help="Cases solved at once; default one for each processor.")] = None,
    scheduler: Annotated[str | None, Parameter(help="Address of a dask scheduler whose workers solve them.")] = None,
    as_json: AsJson = False,
    progress: Annotated[bool, Parameter(help="Show the progress on standard error.")] = True,
) -> None:
    """Solve the cases of a study that are not done yet, each in a process of its own.

    A case that fails is a row with its reason, and is tried again the next time.
    """
    if workers is not None and workers < 1:
        raise UsageError(f"--workers: {workers} is not allowed: must be at least 1")

    from embedding.cli.study import print_study, study_summary
    from embedding.studies import load_study, run_study

    target = Path(file.stem) if folder is None else folder
    result = run_study(load_study(file), target, workers=workers, scheduler=scheduler, progress=progress)
    if as_json:
        print_json(study_summary(result))
    else:
        print_study(result)


@app.command
def trade(
    scene: SceneFile,
    /,
    *,
    folder: Annotated[Path | None, Parameter(help="Folder of the rungs' archives; default NAME.trade.")] = None,
    overrides: Overrides = (),
    of: Annotated[str | None, Parameter(help="Scalar to compare; default the one whose error is estimated.")] = None,
    reference: Annotated[float | None, Parameter(help="Its exact value, SI; default that of the finest rung.")] = None,
    seconds: Annotated[float, Parameter(help="Longest wall time of a rung.")] = 600.0,
    csv: Annotated[Path | None, Parameter(help="Also write the table into this CSV file.")] = None,
    picture: Annotated[Path | None, Parameter(help="Also draw error against time into this PNG file.")] = None,
    as_json: AsJson = False,
    progress: Annotated[bool, Parameter(help="Show the progress on standard error.")] = True,
) -> None:
    """Measure what accuracy costs: solve a scene with other orders, meshes and models, and compare.

    Each rung has a process of its own, one after the other; what the folder has already is not solved again.
    """
    from embedding.scene import load_scene

    if not seconds > 0:
        raise UsageError(f"--seconds: {seconds:g} is not allowed: must be greater than 0")
    if csv is not None:
        check_output("--csv", csv, ".csv", read=scene)
    if picture is not None:
        check_output("--picture", picture, ".png", read=scene)
    stated = load_scene(scene, overrides)

    from embedding.cli.trade import print_trade, trade_summary
    from embedding.trade import measure_trade
    from embedding.trade.chart import trade_plot

    place = default_archive(stated.name).with_suffix(".trade") if folder is None else folder
    found = measure_trade(
        stated, place, quantity=of, reference=reference, seconds=seconds, progress=progress and not as_json
    )
    if csv is not None:
        with whole_file(csv) as file:
            found.to_csv(file)
    if picture is not None:
        with whole_file(picture) as file:
            trade_plot(found, file)
    if as_json:
        print_json(trade_summary(found))
    else:
        print_trade(found)


@app.command
def table(
    folder: Annotated[Path, Parameter(help="Folder written by `embedding study`.")],
    /,
    *,
    csv: Annotated[Path | None, Parameter(help="Also write the table into this CSV file.")] = None,
    parquet: Annotated[Path | None, Parameter(help="Also write the table into this Parquet file.")] = None,
    chart: Annotated[Path | None, Parameter(help="Also draw a chart into this PNG file.")] = None,
    of: Annotated[str | None, Parameter(help="The column to draw.")] = None,
    over: Annotated[tuple[str, ...], Parameter(negative="", help="Draw it over this column; twice: a map.")] = (),
    family: Annotated[str | None, Parameter(help="One line for each value of this column.")] = None,
    as_json: AsJson = False,
) -> None:
    """Print the table of a study, as far as it has come, in SI units; write it, or draw a chart of it."""
    if csv is not None:
        check_output("--csv", csv, ".csv")
    if parquet is not None:
        check_output("--parquet", parquet, ".parquet")
    if chart is not None:
        check_output("--chart", chart, ".png")
        if of is None or not 1 <= len(over) <= 2:
            raise UsageError("--chart: say --of COLUMN and --over COLUMN, or --over twice for a map")

    from embedding.cli.study import draw_study, print_table, study_summary
    from embedding.studies import open_study

    result = open_study(folder)
    for path, write in ((csv, result.to_csv), (parquet, result.to_parquet)):
        if path is not None:
            with whole_file(path) as file:
                write(file)
    if chart is not None and of is not None:
        with whole_file(chart) as file:
            draw_study(result, file, of, over, family)
    if as_json:
        print_json({**study_summary(result), "csv": csv, "parquet": parquet, "chart": chart})
    else:
        print_table(result)
