"""`embedding probe|integrals|balance|compare`: questions to archives, answered by tables."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from embedding.cli.files import UsageError, check_output, whole_file

if TYPE_CHECKING:
    from embedding.post import Table

ArchiveFile = Annotated[Path, Parameter(help="Archive (.vtkhdf) written by `embedding run`.")]
AsJson = Annotated[bool, Parameter(name="--json", negative="", help="Print one JSON object instead of text.")]
Csv = Annotated[Path | None, Parameter(help="Also write the table into this CSV file.")]
StepNumber = Annotated[int | None, Parameter(help="One step, as `embedding info` numbers them; default all.")]
Point = tuple[str, str, str]
LEFT_OUT = ("factor_mechanical", "factor_field")
DIFFERENT = 4


def probe(
    archive: ArchiveFile,
    /,
    *,
    at: Annotated[
        list[Point] | None,
        Parameter(allow_leading_hyphen=True, negative="", help="A point X Y Z, in m or as '5 mm'. May be repeated."),
    ] = None,
    start: Annotated[
        Point | None, Parameter(name="--from", allow_leading_hyphen=True, help="Where a line begins, X Y Z.")
    ] = None,
    end: Annotated[Point | None, Parameter(name="--to", allow_leading_hyphen=True, help="Where it ends.")] = None,
    points: Annotated[int, Parameter(help="Points of the line; default 101.")] = 101,
    shell: Annotated[
        bool, Parameter(negative="", help="Points are material ones of the undeformed mid-surface.")
    ] = False,
    side: Annotated[str | None, Parameter(help="outside (top) or inside (bottom).")] = None,
    field: Annotated[list[str] | None, Parameter(negative="", help="A field; default all. May be repeated.")] = None,
    step: StepNumber = None,
    csv: Csv = None,
    picture: Annotated[Path | None, Parameter(help="Also draw the line, or the points over the steps: PNG.")] = None,
    as_json: AsJson = False,
) -> None:
    """Read the field at points of the deformed space, or on the shell, at every step.

    A point has no value in the shell, in a body or beyond the meshed space, and the table says which.
    """
    from embedding import post
    from embedding.cli.tables import save_csv

    if (at is None) == (start is None and end is None):
        raise UsageError("--at: give points with --at, or a line with --from and --to")
    if at is None and (start is None or end is None):
        raise UsageError("--from: a line needs both --from and --to")
    if shell and at is None:
        raise UsageError("--shell: give material points with --at")
    _check(csv, ".csv", "--csv")
    _check(picture, ".png", "--picture")
    opened = post.opened(archive)
    steps = _steps(len(opened), step)
    if at is not None:
        places = [_place("--at", point) for point in at]
        ask = post.probe_shell if shell else post.probe
        table = ask(opened, places, fields=field, side=side, steps=steps)
    elif start is not None and end is not None:
        ends = _place("--from", start), _place("--to", end)
        table = post.line(opened, *ends, count=points, fields=field, side=side, steps=steps)
    save_csv(table, csv)
    if picture is not None:
        from embedding.view import probe_plot

        with whole_file(picture) as file:
            probe_plot(table, file, title=str(opened.run["name"]))
    _tell(table, as_json, {"archive": archive, "csv": csv, "picture": picture})


def integrals(
    archive: ArchiveFile, /, *, step: StepNumber = None, csv: Csv = None, as_json: AsJson = False
) -> None:
    """Area, volume, force, torque, charge, energy and capacitance at every step, from the fields, with errors."""
    from embedding import post
    from embedding.cli.tables import save_csv

    _check(csv, ".csv", "--csv")
    opened = post.opened(archive)
    table = post.integrals(opened, steps=_steps(len(opened), step))
    save_csv(table, csv)
    _tell(table, as_json, {"archive": archive, "csv": csv})


def balance(archive: ArchiveFile, /, *, csv: Csv = None, as_json: AsJson = False) -> None:
    """The work of loads, supports and sources against the stored energy, step by step."""
    from embedding import post
    from embedding.cli.tables import save_csv

    _check(csv, ".csv", "--csv")
    table = post.energy_balance(archive)
    save_csv(table, csv)
    _tell(table, as_json, {"archive": archive, "csv": csv}, (*LEFT_OUT, "work_explicit", "residual_explicit"))


def compare(
    first: ArchiveFile,
    second: ArchiveFile,
    /,
    *,
    tolerance: Annotated[float, Parameter(help="Relative difference that counts as none; default 1e-6.")] = 1e-6,
    csv: Csv = None,
    as_json: AsJson = False,
) -> int:
    """Compare two archives at their common loads: scene, scalars, fields. Exit code 0: the same, 4: different."""
    from embedding.cli.compare import print_comparison, summary
    from embedding.cli.output import print_json
    from embedding.cli.tables import save_csv
    from embedding.post import compare as compared

    _check(csv, ".csv", "--csv")
    found = compared(first, second, tolerance=tolerance)
    save_csv(found.table, csv)
    if as_json:
        print_json({"first": first, "second": second, **summary(found)})
    else:
        print_comparison(first, second, found)
    return 0 if found.same else DIFFERENT


def _tell(
    table: Table, as_json: bool, files: dict[str, Path | None], leave_out: tuple[str, ...] = LEFT_OUT
) -> None:
    from embedding.cli.output import print_json
    from embedding.cli.tables import print_table, table_summary

    if as_json:
        print_json({**files, **table_summary(table)})
    else:
        print_table(table, leave_out)


def _check(path: Path | None, suffix: str, option: str) -> None:
    if path is not None:
        check_output(option, path, suffix)
        if suffix == ".png":
            from embedding.view.rendering import require_packages

            require_packages()


def _steps(count: int, step: int | None) -> list[int] | None:
    if step is None:
        return None
    if not 1 <= step <= count:
        raise UsageError(f"--step: {step} is not allowed: the archive has steps 1 to {count}")
    return [step - 1]


def _place(option: str, point: Point) -> list[float]:
    """A point in m from numbers or texts with a unit."""
    try:
        return [_metres(text) for text in point]
    except ValueError as error:
        raise UsageError(f"{option}: {' '.join(point)} is not a point: {error}") from error


def _metres(text: str) -> float:
    from embedding.scene.units import parse_quantity

    try:
        return float(text)
    except ValueError:
        return parse_quantity(text, "m")
