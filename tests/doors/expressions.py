"""Expressions out of the grammar of scenes and out of other languages, and what becomes of them."""

from __future__ import annotations

import random

FUNCTIONS = ("sin", "cos", "exp", "log", "sqrt", "tanh")
FOREIGN = (
    "abs(x)", "max(x, y)", "x if y else z", "x.real", "x[0]", "[x]", "(x,)", "x, y", "lambda: x", "x := 1", "x = 1",
    "x == y",
    "x and y", "not x", "~x", "x // y", "x % y", "x @ y", "x << 2", "x | y", "1j", "0x10", "1_000", "x ** y",
    "x ** (2)", "2 ** 99",
    "x ** 1e9", "x ** -x", "9 ** 9 ** 9", "True", "None", "...", "'x'", "f'{x}'", "b'x'", "print(x)", "eval(x)",
    "exec(x)",
    "__import__(x)", "x.__class__.__mro__", "(lambda: x)()", "[x for x in y]", "yield x", "await x", "*x",
    "sin(*x)", "sin(x=1)",
    "sin()", "sin(x, y)", "sin", "sin sin", "pi()", "x x", "x^2", "x;y", "x\ny", "x#y", "x\\y", "\x00", "é",
    "x\u00d7y", "１", "\uff58",
    "1e999", "-1e999", "1e308*10", "1/0", "log(0)", "sqrt(-1)", "exp(exp(exp(9)))", "(" * 99,
    "(" * 148 + "x" + ")" * 148,
    "-" * 299 + "x", "sin(" * 70 + "x" + ")" * 70, "x" * 301, "1+" * 149 + "1", "x*" * 149 + "x", "x**2**2",
    "x**16**16", "0**-1", "",
    " ", "  x  ", "\t", "import os", "os.system(1)", "open(1)", "globals()", "x.y(1)", "0777", "1.2.3", "1e", "e",
    ".", "..", "-", "()",
)  # fmt: skip


def expression(chance: random.Random, names: tuple[str, ...], depth: int = 4) -> str:
    """Something the grammar knows."""
    kind = chance.randrange(8) if depth else chance.randrange(2)
    if kind == 0:
        return chance.choice((*names, "pi"))
    if kind == 1:
        return chance.choice(("0", "1", "2.5", "1e-9", "1e9", "1e300", "1e-300", f"{chance.uniform(-3, 3):.3g}"))
    inner = expression(chance, names, depth - 1)
    if kind == 2:
        return f"{chance.choice(FUNCTIONS)}({inner})"
    if kind == 3:
        return f"({inner})**{chance.choice(('2', '0.5', '-1', '-2.5', '16', '0'))}"
    if kind == 4:
        return f"-({inner})"
    return f"({inner}) {chance.choice('+-*/')} ({expression(chance, names, depth - 1)})"


def text(chance: random.Random, names: tuple[str, ...]) -> str:
    """An expression, whole, spoilt, or of another language."""
    kind = chance.randrange(5)
    if kind == 0:
        return chance.choice(FOREIGN)
    found = expression(chance, names)
    if kind < 3:
        return found
    place = chance.randrange(len(found) + 1)
    if kind == 3:
        return found[:place] + chance.choice((*FOREIGN, *"+-*/()., ")) + found[place:]
    return found[:place] + found[place + chance.randrange(4) :]
