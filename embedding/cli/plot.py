"""`embedding plot`: every picture that can be drawn of an archive."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from embedding.cli.files import UsageError, check_output, whole_file

if TYPE_CHECKING:
    from embedding.archive import Archive

Kind = Literal["picture", "slice", "faces", "response", "history", "animation", "page"]
SUFFIXES: dict[str, tuple[str, ...]] = {"animation": (".gif", ".mp4"), "page": (".html",)}
"""Of the files of a kind; all others are PNG. The first is the default."""
OPTIONS: dict[str, tuple[str, ...]] = {
    "picture": ("step", "field", "ambient_field", "lines", "reach"),
    "slice": ("step", "ambient_field", "lines", "reach"),
    "faces": ("step",),
    "response": ("x", "y"),
    "history": (),
    "animation": ("field", "ambient_field", "lines", "reach"),
    "page": ("field",),
}
"""Which options a kind of picture takes."""


def plot(
    archive: Annotated[Path, Parameter(help="Archive (.vtkhdf) written by `embedding run`.")],
    /,
    *,
    kind: Annotated[
        Kind,
        Parameter(help="picture (default), slice, faces, response, history, animation or page."),
    ] = "picture",
    out: Annotated[Path | None, Parameter(help="File to write; default beside the archive.")] = None,
    step: Annotated[int | None, Parameter(help="Step to draw, as `embedding info` numbers them.")] = None,
    field: Annotated[str | None, Parameter(help="Field of the shell that colours it: p_t, stretch, u, ...")] = None,
    ambient_field: Annotated[str | None, Parameter(help="Field of the ambient: E, H, phi, ...")] = None,
    lines: Annotated[bool | None, Parameter(help="Draw field lines.")] = None,
    reach: Annotated[float | None, Parameter(help="How much of the ambient is shown, in sizes of the shell.")] = None,
    x: Annotated[str | None, Parameter(help="Scalar along x of a response.")] = None,
    y: Annotated[str | None, Parameter(help="Scalar along y of a response.")] = None,
    history: Annotated[bool, Parameter(negative="", help="The same as --kind history.")] = False,
) -> None:
    """Draw an archive.

    A step in space (picture), the field in a plane (slice) or the pressures on both faces (faces); all steps as a
    response curve with its stability, a history, a moving picture (animation: GIF or MP4), or a page for a browser
    (page: HTML).
    """
    from embedding.archive import open_archive

    chosen = "history" if history else kind
    stated = {"step": step, "field": field, "ambient_field": ambient_field, "lines": lines, "reach": reach}
    given = {name: value for name, value in {**stated, "x": x, "y": y}.items() if value is not None}
    _refuse_others(chosen, given)
    if reach is not None and not 1.0 <= reach <= 100.0:
        raise UsageError(f"--reach: {reach:g} is not allowed: must be from 1 to 100 sizes of the shell")
    opened = open_archive(archive)
    if len(opened) == 0:
        raise UsageError(f"{archive}: no step was accepted, so there is nothing to draw")
    if step is not None and not 1 <= step <= len(opened):
        raise UsageError(f"--step: {step} is not allowed: the archive has steps 1 to {len(opened)}")
    _check_names(opened, given)
    target = _target(archive, chosen, out)
    draw, options = _drawing(chosen, target, given)
    with whole_file(target) as file:
        draw(archive, file, **options)
    print(target)


def _refuse_others(kind: str, given: dict[str, Any]) -> None:
    for name in given:
        if name not in OPTIONS[kind]:
            option, takes = name.replace("_", "-"), ", ".join(f"--{one.replace('_', '-')}" for one in OPTIONS[kind])
            if (kind, name) == ("history", "step"):
                raise UsageError("--step: a history shows all steps; leave out one of --step and --history")
            raise UsageError(f"--{option}: a {kind} does not take it; it takes {takes or 'no options'}")


def _check_names(archive: Archive, given: dict[str, Any]) -> None:
    """Whether fields and scalars exist, before anything is drawn."""
    for name, block in (("field", "shell"), ("ambient_field", "outside")):
        if name in given:
            there = archive.block(block, 0).fields if block in archive.blocks else ()
            if given[name] not in there:
                option = f"--{name.replace('_', '-')}"
                told = f"there are {', '.join(there)}" if there else "nothing is meshed around the shell"
                raise UsageError(f"{option}: no field {given[name]!r} in the block {block}; {told}")
    for name in ("x", "y"):
        if name in given and given[name] not in ("step", *archive.scalars):
            raise UsageError(f"--{name}: no scalar {given[name]!r}; there are step, {', '.join(archive.scalars)}")


def _target(archive: Path, kind: str, out: Path | None) -> Path:
    suffixes = SUFFIXES.get(kind, (".png",))
    if out is None:
        middle = "" if kind in ("picture", "page", "animation") else f".{kind}"
        return check_output("--out", archive.with_suffix(f"{middle}{suffixes[0]}"), suffixes[0])
    return check_output("--out", out, out.suffix if out.suffix in suffixes else suffixes[0])


def _drawing(kind: str, target: Path, given: dict[str, Any]) -> tuple[Callable[..., Any], dict[str, Any]]:
    """What draws it, and its options."""
    from embedding import view

    options = dict(given)
    if "step" in options:
        options["step"] -= 1
    if kind == "page":
        return view.interactive_page, {"fields": [options["field"]]} if "field" in options else {}
    if kind in ("picture", "animation") and "field" in options:
        options["shell_field"] = options.pop("field")
    if kind == "slice" and "ambient_field" in options:
        options["field"] = options.pop("ambient_field")
    if kind == "animation":
        options["kind"] = target.suffix
    draws: dict[str, Callable[..., Any]] = {
        "picture": view.picture,
        "slice": view.slice_plot,
        "faces": view.faces_plot,
        "response": view.response_plot,
        "history": view.history_plot,
        "animation": view.animation,
    }
    return draws[kind], options
