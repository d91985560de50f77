"""Arithmetic in a few variables as text, read without running code.

The grammar: numbers, the variables (x, y, z unless stated otherwise), pi, + - * /, ** with a constant exponent,
brackets, and the functions sin, cos, exp, log, sqrt and tanh. It is evaluated on anything with arithmetic: floats,
arrays, finite element functions.
"""

from __future__ import annotations

import ast
import math
import operator
import re
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from embedding.scene.messages import nearest

MAX_LENGTH = 300
MAX_DEPTH = 100
MAX_EXPONENT = 16
VARIABLES = ("x", "y", "z")
Functions = Mapping[str, Callable[[Any], Any]]
FLOAT_FUNCTIONS: Functions = {
    "sin": math.sin, "cos": math.cos, "exp": math.exp, "log": math.log, "sqrt": math.sqrt, "tanh": math.tanh,
}  # fmt: skip
"""The functions of the grammar for floats; other objects need a mapping with the same names."""

_BINARY: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
}  # fmt: skip
_UNARY: Mapping[type[ast.unaryop], Callable[[Any], Any]] = {ast.UAdd: operator.pos, ast.USub: operator.neg}
_CHARACTERS = re.compile(r"[0-9A-Za-z_+\-*/()., \t]*")


@dataclass(frozen=True)
class Expression:
    """A checked expression in ``names``, of which it uses ``variables``; ``tree`` is for who takes it apart."""

    text: str
    variables: frozenset[str]
    names: tuple[str, ...] = VARIABLES
    tree: ast.expr = field(repr=False, compare=False, kw_only=True)

    def __call__(self, *values: Any, functions: Functions = FLOAT_FUNCTIONS) -> Any:
        """The value at ``values`` of the names, with the ``functions`` for them if they are no floats; constant
        expressions give a float."""
        named = dict(zip(self.names, values, strict=True))
        return _evaluate(self.tree, named | {"pi": math.pi}, functions)


@lru_cache(maxsize=64)
def parse_expression(text: str, names: tuple[str, ...] = VARIABLES) -> Expression:
    """Check ``text`` against the grammar with the variables ``names``.

    Raises:
        ValueError: outside the grammar, too long or too deep; the text says what is wrong.
    """
    if len(text) > MAX_LENGTH:
        raise ValueError(f"must have at most {MAX_LENGTH} characters")
    listed = " and ".join([", ".join(names[:-1]), names[-1]])
    if "^" in text:
        raise ValueError("powers are written with **")
    if not _CHARACTERS.fullmatch(text):
        raise ValueError(f"must be arithmetic in {listed} on one line")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, MemoryError, RecursionError) as error:
        raise ValueError(f"must be arithmetic in {listed}; this cannot be read") from error
    variables: set[str] = set()
    _check(tree, names, variables, MAX_DEPTH)
    return Expression(text, frozenset(variables), names, tree=tree)


def _check(node: ast.expr, names: tuple[str, ...], variables: set[str], depth: int) -> None:
    if depth == 0:
        raise ValueError(f"must not be nested deeper than {MAX_DEPTH} levels")
    match node:
        case ast.Constant(value=value):
            _number(value)
        case ast.Name(id=name):
            if name not in (*names, "pi"):
                raise ValueError(_unknown(name, names))
            variables.update({name} - {"pi"})
        case ast.UnaryOp(op=sign, operand=operand) if type(sign) in _UNARY:
            _check(operand, names, variables, depth - 1)
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            if abs(exponent_of(right)) > MAX_EXPONENT:
                raise ValueError(f"the exponent of ** must lie between -{MAX_EXPONENT} and {MAX_EXPONENT}")
            _check(left, names, variables, depth - 1)
        case ast.BinOp(left=left, op=symbol, right=right) if type(symbol) in _BINARY:
            _check(left, names, variables, depth - 1)
            _check(right, names, variables, depth - 1)
        case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]) if name in FLOAT_FUNCTIONS:
            _check(argument, names, variables, depth - 1)
        case ast.Call(func=ast.Name(id=name)) if name in FLOAT_FUNCTIONS:
            raise ValueError(f"{name} takes one argument")
        case ast.Call(func=ast.Name(id=name)):
            raise ValueError(_unknown(name, names))
        case _:
            functions = ", ".join(FLOAT_FUNCTIONS)
            raise ValueError(f"may use only numbers, {', '.join(names)}, pi, + - * / **, brackets, {functions}")


def _unknown(name: str, names: tuple[str, ...]) -> str:
    known = (*names, "pi", *FLOAT_FUNCTIONS)
    guess = nearest(name, known)
    hint = f"did you mean {guess}?" if guess else f"known are {', '.join(known)}"
    return f'unknown name "{name}": {hint}'


def _number(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ValueError("constants must be real numbers")
    number = float(value)  # the limit of the length keeps integers within the range of floats
    if not math.isfinite(number):
        raise ValueError("constants must be finite")
    return number


def exponent_of(node: ast.expr) -> float:
    """The constant that ``node`` is, an exponent; ValueError if it is none."""
    match node:
        case ast.UnaryOp(op=sign, operand=ast.Constant(value=value)) if type(sign) in _UNARY:
            return float(_UNARY[type(sign)](_number(value)))
        case ast.Constant(value=value):
            return _number(value)
    raise ValueError("the exponent of ** must be a number")


def _evaluate(node: ast.expr, values: Mapping[str, Any], functions: Functions) -> Any:
    match node:
        case ast.Constant(value=value):
            return _number(value)
        case ast.Name(id=name):
            return values[name]
        case ast.UnaryOp(op=sign, operand=operand):
            return _UNARY[type(sign)](_evaluate(operand, values, functions))
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            exponent = exponent_of(right)
            # whole exponents stay integers: negative bases are then fine on every kind of value
            power = int(exponent) if exponent.is_integer() else exponent
            return _evaluate(left, values, functions) ** power
        case ast.BinOp(left=left, op=symbol, right=right):
            combine = _BINARY[type(symbol)]
            return combine(_evaluate(left, values, functions), _evaluate(right, values, functions))
        case ast.Call(func=ast.Name(id=name), args=[argument]):
            return functions[name](_evaluate(argument, values, functions))
    raise ValueError("not an expression of the grammar")
