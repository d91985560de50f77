"""Wrong scenes out of right ones: reproducible changes to the values of a table, and to the text of a file."""

from __future__ import annotations

import copy
import math
import random
from collections.abc import Callable, Iterator
from typing import Any

WORDS = (
    "", " ", "x", "nan", "inf", "-inf", "none", "1", "1 m", "-1 mm", "0 mm", "1e400 m", "1e-400 m", "5 parsec",
    "5 mm mm",
    "3 kPa", "2 MV", "1 m^-999", "1/0", "x/0*", "x**99", "sin(", "sqrt(-1)", "log(0)", "exp(exp(999))", "exp(x)" * 40,
    "(" * 150 + "x" + ")" * 150, "-" * 200 + "x", "1+" * 140 + "1", "x.__class__", "__import__('os').system('true')",
    "lambda: 0", "[x for x in y]", "{}", "%s%n", "{0.__class__}", "../../etc/passwd", "/dev/zero", "/dev/null",
    "\x00",
    "\n", "a\nb", "\t", "ß∂µ Ωm", "１ m", "١ m", "5\u00a0mm", "5 ㎜", "\u202emm 5", "😀", "a" * 100_000, "9" * 5000,
    "z1", "axis",
    "sphere", "neo-hookean", "load", "volume", "electric", "magnetic", "3d", "axisymmetric", "bending", "membrane",
    "true",
)  # fmt: skip
"""Texts that mean nothing, something else, or too much."""

NUMBERS = (
    0, 1, -1, 2, 3.5, 0.0, -0.0, math.nan, math.inf, -math.inf, 1e308, -1e308, 1e-308, 5e-324, 1e30, 1e-30, 2**31,
    2**63, -(2**63),
    10**30, 10**400, 1e6, 1e-6, True, False,
)  # fmt: skip
DEEP: list[Any] = []
for _ in range(60):
    DEEP = [DEEP]
CONTAINERS: tuple[Any, ...] = (
    [], {}, [[]], [{}], {"": 1}, {"a": {"b": {}}}, [1, 2, 3], ["x", 1, {}], [math.nan], DEEP, [0] * 20_000,
    {"kind": 5}, {"kind": []},
    {"kind": "sphere"}, {"law": "gent"}, [["x", "y"], ["z"]], {f"k{n}": n for n in range(500)},
)  # fmt: skip
NAMES = (
    "",
    " ",
    "kind",
    "law",
    "name",
    "x",
    "__class__",
    "model_config",
    "radius",
    "thicknes",
    "Thickness",
    "a.b",
    "é",
    "\n",
    "k" * 5000,
)

Place = tuple[Any, Any]


def places(table: Any) -> Iterator[Place]:
    """Every entry of nested tables and lists: what holds it, and its key there."""
    keys = list(table) if isinstance(table, dict) else range(len(table))
    for key in keys:
        yield table, key
        if isinstance(table[key], (dict, list)):
            yield from places(table[key])


def mutated_table(chance: random.Random, table: dict[str, Any], others: list[dict[str, Any]]) -> dict[str, Any]:
    """A copy of ``table`` with one to three changes, some of them with values out of ``others``."""
    changed = copy.deepcopy(table)
    for _ in range(chance.choice((1, 1, 1, 2, 3))):
        there = list(places(changed))
        if not there:
            break
        chance.choice(CHANGES)(chance, chance.choice(there), others)
    return changed


def _nasty(chance: random.Random, place: Place, others: list[dict[str, Any]]) -> None:
    holder, key = place
    pool: tuple[Any, ...] = chance.choice((WORDS, NUMBERS, NUMBERS, CONTAINERS))
    holder[key] = copy.deepcopy(chance.choice(pool))


def _scaled(chance: random.Random, place: Place, others: list[dict[str, Any]]) -> None:
    """A number, or the number of a quantity, times a power of ten or -1."""
    holder, key = place
    value, factor = holder[key], chance.choice((0.0, -1.0, 1e3, 1e-3, 1e9, 1e-9, 1e150, 1e-150, 1e300))
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        holder[key] = value * factor if abs(value) <= 1e300 else -value
    elif isinstance(value, str) and " " in value:
        number, unit = value.split(" ", 1)
        try:
            holder[key] = f"{float(number) * factor:g} {unit}"
        except ValueError:
            holder[key] = f"{value} {unit}"
    else:
        _nasty(chance, place, others)


UNITS = ("m", "mm", "kPa", "V", "T", "deg", "rad", "N/m", "m^2", "s", "%", "", "Mm", "µm", "C/m^2")


def _united(chance: random.Random, place: Place, others: list[dict[str, Any]]) -> None:
    """Another unit, or one where none belongs."""
    holder, key = place
    number = str(holder[key]).split(" ", 1)[0][:50]
    holder[key] = f"{number} {chance.choice(UNITS)}"


def _deleted(chance: random.Random, place: Place, others: list[dict[str, Any]]) -> None:
    holder, key = place
    del holder[key]


def _renamed(chance: random.Random, place: Place, others: list[dict[str, Any]]) -> None:
    holder, key = place
    if isinstance(holder, dict):
        value = holder.pop(key)
        letters = list(str(key)) or ["a"]
        chance.shuffle(letters)
        holder[chance.choice((*NAMES, "".join(letters), str(key)[:-1]))] = value
    else:
        holder.append(copy.deepcopy(holder[key]))


def _added(chance: random.Random, place: Place, others: list[dict[str, Any]]) -> None:
    """An unknown key, or one of another scene with its value there."""
    holder, _ = place
    other, name = chance.choice(list(places(chance.choice(others))))
    value = copy.deepcopy(other[name])
    if isinstance(holder, dict):
        holder[name if isinstance(name, str) and chance.random() < 0.7 else chance.choice(NAMES)] = value
    else:
        holder.insert(0, value)


def _transplanted(chance: random.Random, place: Place, others: list[dict[str, Any]]) -> None:
    """The value under the same name in another scene, or any value of one."""
    holder, key = place
    found = list(places(chance.choice(others)))
    same = [(other, name) for other, name in found if name == key]
    other, name = chance.choice(same or found)
    holder[key] = copy.deepcopy(other[name])


def _wrapped(chance: random.Random, place: Place, others: list[dict[str, Any]]) -> None:
    holder, key = place
    holder[key] = chance.choice(([holder[key]], {key: holder[key]}, [holder[key], holder[key]], {"kind": holder[key]}))


Change = Callable[[random.Random, Place, list[dict[str, Any]]], None]
CHANGES: tuple[Change, ...] = (
    _nasty, _nasty, _scaled, _scaled, _united, _deleted, _renamed, _added, _transplanted, _transplanted, _wrapped,
)  # fmt: skip

PIECES = (
    "=", "[", "]", "[[", "]]", "{", "}", '"', "'", '"""', "'''", ",", "#", "\n", "\r", "\x00", "\ufeff", "\\",
    "\\u0000", "\\ud800", "nan", "inf",
    "-", "1e999", "0x", "0b2", "1979-05-27", "1979-05-27T07:32:00Z", "true", "é", "😀", "[" * 3000, "{a=" * 2000,
    "a=1\na=1\n",
    "[shell]\n", "[shell]\n[shell]\n", "a." * 3000 + "a=1\n", "9" * 10_000, " ", "\t", "x = ", "name = ",
    '= "1 m"\n', "\x7f", "\u2028",
)  # fmt: skip


def mutated_text(chance: random.Random, text: str) -> bytes:
    """The text with one to four pieces lost, doubled, moved, put in or flipped: the bytes of a file."""
    data = text.encode()
    for _ in range(chance.choice((1, 1, 2, 3, 4))):
        begin = chance.randrange(len(data) + 1)
        end = min(len(data), begin + int(chance.expovariate(1 / 12)) + 1)
        kind = chance.randrange(7)
        if kind == 0:
            data = data[:begin] + data[end:]
        elif kind == 1:
            data = data[:end] + data[begin:end] * chance.choice((1, 2, 50)) + data[end:]
        elif kind == 2:
            target = chance.randrange(len(data) + 1)
            data = data[:target] + data[begin:end] + data[target:]
        elif kind in (3, 4):
            data = data[:begin] + chance.choice(PIECES).encode("utf-8", "surrogatepass") + data[begin:]
        elif kind == 5 and data:
            flipped = bytearray(data)
            flipped[begin % len(data)] ^= 1 << chance.randrange(8)
            data = bytes(flipped)
        elif chance.random() < 0.3:
            data = data[:begin]
    return data
