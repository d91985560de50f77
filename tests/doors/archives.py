"""Archives of a stranger: things replaced, removed, linked in circles, with checksums that hold or do not.

``python -m tests.doors.archives FILE FIRST COUNT`` spoils copies of an archive, gives each to a command,
and prints what
came of it. In a process of its own, which must not die of it.
"""

from __future__ import annotations

import contextlib
import io
import json
import random
import resource
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from embedding.archive.digests import digest_of, fields_digest, record_digest, rows_digests, slot_digest
from embedding.archive.layout import LIBVER
from embedding.cli import main as command_line
from tests.doors.watch import in_time, watched

MEMORY = 8 << 30
NASTY_JSON = (
    "",
    "{}",
    "[]",
    "null",
    "1",
    '"x"',
    "nan",
    '{"result": 1}',
    "[" * 5000,
    '{"name": {}}',
    '{"decisions": [1], "text": 2}',
    "\x00",
    "\xff",
)
COMMANDS: tuple[tuple[str, ...], ...] = (
    ("info",), ("info", "--json"), ("verify",), ("verify", "--save", "saved.vtkhdf"), ("resume", "--no-progress"),
    ("integrals",),
    ("balance",), ("probe", "--at", "0", "0", "0.05"), ("probe", "--shell", "--at", "0", "0", "20 mm"),
    ("compare", "whole.vtkhdf"),
    ("export", "--out", "exported"),
)  # fmt: skip


def spoil(chance: random.Random, path: Path) -> str:
    """Change a few things in the file, and let its checksums hold again in some cases; returns what was done."""
    done = []
    with h5py.File(path, "r+", libver=LIBVER) as file:
        for _ in range(chance.choice((1, 1, 2, 4))):
            names: list[str] = []
            file.visit(names.append)
            if not names:
                break
            name, change = chance.choice(sorted(names)), chance.choice(CHANGES)
            done.append(f"{change.__name__} {name}")
            with contextlib.suppress(Exception):  # not everything can be done to everything
                change(chance, file, name)
        if chance.random() < 0.6:
            done.append("signed")
            with contextlib.suppress(Exception):
                sign(file)
    return ", ".join(done)


def sign(file: Any) -> None:
    """Make all checksums those of what is there now."""
    own = file["embedding"]
    for slot in own["checkpoint"].values():
        slot["digest"][...] = slot_digest(slot)
    data = own["finish/json"][: int(own["finish/length"][0])]
    own["finish/digest"][...] = digest_of(data)
    own["digest"][...] = record_digest(file)
    steps = int(own["committed"][0])
    for step in range(steps):
        own["steps/fields_digest"][step] = fields_digest(file, step)
    own["steps/rows_digest"][:steps] = list(rows_digests(own, 0, steps))


def _remove(chance: random.Random, file: Any, name: str) -> None:
    del file[name]


def _replace(chance: random.Random, file: Any, name: str) -> None:
    """Another type or shape in its place."""
    del file[name]
    kind = chance.randrange(7)
    if kind == 0:
        file.create_group(name)
    elif kind == 1:
        file[name] = chance.choice((5, -1, 2**62, 3.5, float("nan"), b"text", "text"))
    elif kind == 2:
        file[name] = np.zeros(
            chance.choice(((0,), (3,), (2, 2), (1, 1, 1))), chance.choice(("i8", "f4", "u1", "S3", "?"))
        )
    elif kind == 3:
        file.create_dataset(
            name, shape=(chance.choice((1 << 33, 1 << 50)),), dtype="f8", chunks=(1024,), maxshape=(None,)
        )
    elif kind == 4:
        file.create_dataset(name, data=["a", "b"], dtype=h5py.string_dtype())
    elif kind == 5:
        file.create_dataset(name, data=np.array([(1, 2.0)], [("a", "i4"), ("b", "f8")]))
    else:
        file.create_dataset(name, shape=None, dtype="f8")


def _values(chance: random.Random, file: Any, name: str) -> None:
    """Other numbers of the same type."""
    data = file[name]
    if data.dtype.kind == "f":
        data[...] = chance.choice((np.nan, np.inf, -1e300, 0.0))
    else:
        data[...] = chance.choice((0, 1, -1, 255, 2**62)) if data.dtype.kind == "i" else chance.randrange(256)


def _document(chance: random.Random, file: Any, name: str) -> None:
    """Another text in place of a document, or of how the run ended."""
    text = chance.choice(NASTY_JSON)
    if chance.random() < 0.5:
        name = f"embedding/{chance.choice(('scene', 'plan', 'scales', 'versions', 'run'))}"
        if chance.random() < 0.5:
            text = spoilt_json(chance, bytes(file[name][()]).decode())
        del file[name]
        file[name] = np.bytes_(text.encode("latin1", "replace") or b" ")
        return
    own = file["embedding/finish"]
    if chance.random() < 0.7:
        text = spoilt_json(chance, own["json"][: int(own["length"][0])].tobytes().decode())
    data = np.frombuffer(text.encode("latin1", "replace"), "u1")
    own["json"].resize(max(len(data), 1), axis=0)
    own["json"][: len(data)] = data
    own["length"][...] = [len(data), ~len(data)]


def spoilt_json(chance: random.Random, text: str) -> str:
    """JSON with one value of another type; of other texts a part."""
    try:
        value = json.loads(text)
    except ValueError:
        return text[: chance.randrange(len(text))]
    holder, key = chance.choice(list(_places(value)))
    holder[key] = chance.choice((None, 1, -1.5, "x", [], {}, [1], True, 1e300, "a" * 5000))
    return json.dumps(value)


def _places(value: Any) -> Any:
    for key in list(value) if isinstance(value, dict) else range(len(value)):
        yield value, key
        if isinstance(value[key], (dict, list)):
            yield from _places(value[key])


def _attribute(chance: random.Random, file: Any, name: str) -> None:
    """Another value of an attribute, or none."""
    item = file if chance.random() < 0.2 else file[name]
    which = chance.choice(sorted(item.attrs))
    if chance.random() < 0.3:
        del item.attrs[which]
    else:
        item.attrs[which] = chance.choice((5, -1, 1e300, "text", b"km", [1, 2, 3], ["a", "b"], 2**62))


def _circle(chance: random.Random, file: Any, name: str) -> None:
    """A group in itself, or links to nowhere, to itself, to another file."""
    group = file[name] if isinstance(file[name], h5py.Group) else file[name].parent
    kind = chance.randrange(5)
    if kind == 0:
        group["again"], group["once more"] = group, file
    elif kind == 1:
        del file[name]
        file[name] = h5py.SoftLink(f"/{name}")
    elif kind == 2:
        del file[name]
        file[name] = h5py.ExternalLink("/etc/passwd", "/")
    elif kind == 3:
        del file[name]
        file[name] = h5py.ExternalLink("whole.vtkhdf", f"/{name}")
    else:
        space = file
        del file[name]
        space.create_dataset(name, (100,), "u1", external=[("/etc/passwd", 0, 100)])


def _counted(chance: random.Random, file: Any, name: str) -> None:
    """Another number of steps."""
    number = chance.choice((0, 1, 2, 3, 4, 1000, 2**40))
    file["embedding/committed"][...] = [number, ~number]


Change = Callable[[random.Random, Any, str], None]
CHANGES: tuple[Change, ...] = (
    _remove,
    _replace,
    _replace,
    _values,
    _values,
    _document,
    _document,
    _attribute,
    _circle,
    _counted,
)


def main() -> None:
    """Spoil an archive in many ways and print what came of each: the exit code and the first line of the message."""
    whole, first, count = Path(sys.argv[1]).resolve(), int(sys.argv[2]), int(sys.argv[3])
    with contextlib.chdir(whole.parent), contextlib.redirect_stdout(io.StringIO()):
        for words in COMMANDS:  # what they load late
            shutil.copy(whole, "spoilt.vtkhdf")
            command_line([words[0], "spoilt.vtkhdf", *words[1:]])
            shutil.rmtree("exported", ignore_errors=True)
    with contextlib.chdir(whole.parent), watched() as found:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        for number in range(first, first + count):
            chance = random.Random(number)
            spoilt = Path("spoilt, größer.vtkhdf")
            shutil.copy(whole, spoilt)
            done = spoil(chance, spoilt)
            words = chance.choice(COMMANDS)
            print(f"{number}: {' '.join(words)}: {done}: ", end="", flush=True)
            before = spoilt.read_bytes()
            out, err = io.StringIO(), io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), in_time(120.0):
                code = command_line([words[0], str(spoilt), *words[1:]])
            said = (err.getvalue().splitlines() or [""])[0]
            changed = " CHANGED" if code == 2 and spoilt.read_bytes() != before else ""
            print(f"code {code}{changed} {said[:300]}", flush=True)
            shutil.rmtree("exported", ignore_errors=True)
            for file in [*whole.parent.glob("saved.*"), *whole.parent.glob("spoilt*")]:
                file.unlink()
            for folder in whole.parent.glob("spoilt*"):
                shutil.rmtree(folder)
    print(f"ran: {len(found)} {found[:5]}", flush=True)


if __name__ == "__main__":
    main()
