"""Command lines with wrong words: ``python -m tests.doors.commands FOLDER FIRST COUNT``; the folder has what they name.

In a process of its own, which must not die of them.
"""

from __future__ import annotations

import contextlib
import io
import os
import random
import shutil
import sys
from pathlib import Path

from embedding.cli import main as command_line
from tests.doors.watch import in_time

SCENE, ARCHIVE, DATA, STUDY = "a scene, größer.toml", "ein Lauf.vtkhdf", "data.csv", "study.toml"
RIGHT: tuple[tuple[str, ...], ...] = (
    ("run", SCENE, "--no-progress", "--out", "new one.vtkhdf"),
    ("run", SCENE, "--no-progress", "--out", ARCHIVE, "--set", "shell.thickness=0.1 mm", "--json"),
    ("run", SCENE, "--no-progress", "--accuracy", "0.1", "--of", "stretch", "--set", "loads.pressure_bottom=x"),
    ("explain", SCENE, "--set", "shell.thickness=0.1 mm", "--json"),
    ("resume", ARCHIVE, "--no-progress"),
    ("info", ARCHIVE, "--json"),
    ("verify", ARCHIVE, "--save", "saved.vtkhdf"),
    (
        "probe",
        ARCHIVE,
        "--at",
        "0",
        "0",
        "0.05",
        "--field",
        "phi",
        "--side",
        "outside",
        "--step",
        "1",
        "--csv",
        "p.csv",
    ),
    ("probe", ARCHIVE, "--from", "0", "0", "30 mm", "--to", "0", "0", "0.05", "--points", "5"),
    ("probe", ARCHIVE, "--shell", "--at", "0", "0", "20 mm"),
    ("integrals", ARCHIVE, "--step", "1", "--csv", "i.csv"),
    ("balance", ARCHIVE, "--csv", "b.csv", "--json"),
    ("compare", ARCHIVE, ARCHIVE, "--tolerance", "1e-3", "--csv", "c.csv"),
    ("export", ARCHIVE, "--out", "exported"),
    ("plot", ARCHIVE, "--kind", "response", "--x", "stretch", "--y", "pressure_top", "--out", "r.png", "--step", "9"),
    ("fit", DATA, "--law", "gent", "--terms", "2", "--relative", "--json"),
    ("study", "missing.toml", "--folder", "results", "--workers", "1", "--no-progress"),
    (
        "trade",
        "missing.toml",
        "--folder",
        "rungs",
        "--of",
        "stretch",
        "--reference",
        "1.5",
        "--seconds",
        "10",
        "--csv",
        "t.csv",
    ),
    ("table", "results", "--csv", "t.csv", "--of", "a", "--over", "b", "--chart", "c.png"),
    ("bench", "missing.toml", "--set", "discretisation.order=2"),
)
WORDS = (
    "", " ", "-", "--", "---", "-x", "--json", "--help", "--version", "-1", "0", "1e999", "nan", "inf", "-inf",
    "abc", "1.5", "99999999999999999999",
    "missing.toml", "missing.vtkhdf", "no/such/folder/x.vtkhdf", ".", "..", "/", "/dev/null", "/dev/zero",
    "/proc/self/mem", "/proc/x.vtkhdf",
    "locked/x.vtkhdf", "locked/x.csv", SCENE, ARCHIVE, DATA, STUDY, "a folder", "a folder.vtkhdf", "empty.vtkhdf",
    "other.vtkhdf", "é😀.toml", "a\nb.toml",
    "x" * 5000, "x" * 300 + ".vtkhdf", "\x1b[31m.toml", "%s%n", "$(true)", "`true`", "; true", "--set", "--out",
    "--at", "--step", "--csv", "--picture",
    "p.png", "shell.thickness=nan", "shell=1", "a.b.c.d=1", "=", "a=", "=1", "shell.thickness=" + "[" * 500,
    ".".join("a" * 100) + "=1", "path.99.steps=3",
    "name='\x1b[2J'", "5 parsec", "0 0 0", "run", "info", "--no-json", "--progress=maybe", "--json=1",
    "--accuracy=0", "--workers=-1", "--seconds=nan",
    "--points=-1", "--points=0", "--points=100000000000", "--step=0", "--step=-1", "--tolerance=nan",
    "--tolerance=-1", "--kind=none", "--reach=nan", "--terms=0",
    "--terms=1000", "--law=none", "--save", ARCHIVE.upper(), f"./{ARCHIVE}", f"a folder/../{ARCHIVE}",
)  # fmt: skip


def mutated(chance: random.Random) -> list[str]:
    """A right command line with one to three words lost, doubled, swapped, put in or replaced."""
    words = list(chance.choice(RIGHT))
    for _ in range(chance.choice((1, 1, 2, 3))):
        place = chance.randrange(1, max(len(words), 2)) if chance.random() < 0.95 else 0
        kind = chance.choice((0, 1, 2, 3, *[4] * 12))
        if place >= len(words) or kind == 0:
            words.insert(place, chance.choice(WORDS))
        elif kind == 1:
            del words[place]
        elif kind == 2:
            words.insert(place, words[place])
        elif kind == 3:
            other = chance.choice(RIGHT)
            words[place:place] = other[chance.randrange(len(other)) :][:2]
        else:  # a value rather than the name of an option
            values = [k for k, word in enumerate(words) if k and not word.startswith("--")]
            words[chance.choice(values or [place])] = chance.choice(WORDS)
    return [word for word in words if "\x00" not in word]


def prepare(folder: Path, archive: Path) -> None:
    """Everything that the words name: an archive, a scene that is solved at once, other files, a locked folder."""
    from tests.balloons import SMALLEST

    shutil.copy(archive, folder / ARCHIVE)
    (folder / SCENE).write_text(SMALLEST)
    (folder / DATA).write_text(
        "mode,stretch,nominal_stress [kPa]\n" + "".join(f"uniaxial,{1 + k / 10},{k}\n" for k in range(1, 9))
    )
    (folder / STUDY).write_text(f'scene = "{SCENE}"\nquantities = {{}}\n[parameters]\n')
    for name in ("a folder", "a folder.vtkhdf", "locked"):
        (folder / name).mkdir()
    (folder / "empty.vtkhdf").touch()
    (folder / "other.vtkhdf").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(500))
    (folder / "locked").chmod(0o555)


def state(folder: Path) -> dict[str, bytes]:
    """Every file there, and what is in it."""
    return {str(path): path.read_bytes() if path.is_file() else b"" for path in sorted(folder.rglob("*"))}


def main() -> None:
    """Try many command lines and print what came of each."""
    folder, first, count = Path(sys.argv[1]).resolve(), int(sys.argv[2]), int(sys.argv[3])
    kept = state(folder)
    with contextlib.chdir(folder):
        for number in range(first, first + count):
            words = mutated(random.Random(number))
            print(f"{number}: {words!r:.300}: ", end="", flush=True)
            out, err = io.StringIO(), io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), in_time(60.0):
                try:
                    code = command_line(words)
                except SystemExit as ended:
                    code = int(ended.code or 0)
            now = state(folder)
            said = (err.getvalue() or out.getvalue()).splitlines() or [""]
            left = f" LEFT {sorted(set(now) ^ set(kept))}"[:200] if code == 2 and now != kept else ""
            print(f"code {code}{left} {said[0][:200]}", flush=True)
            for path in set(now) - set(kept):
                shutil.rmtree(path, ignore_errors=True)
                Path(path).unlink(missing_ok=True)
            for path, content in kept.items():
                if now.get(path) != content:
                    Path(path).write_bytes(content)
    os.chmod(folder / "locked", 0o755)


if __name__ == "__main__":
    main()
