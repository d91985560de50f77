"""The grammar of varying pressures: what it computes and what it refuses."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from embedding.scene import PressureField, parse_expression
from embedding.scene.differentiation import derivative
from embedding.scene.expression import FLOAT_FUNCTIONS, MAX_DEPTH, MAX_LENGTH
from embedding.shell.functions import NUMERIC


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1", 1.0),
        ("x + 2*y - z/4", 0.3 + 1.0 - 0.5),
        ("-x**2", -0.09),
        ("+x", 0.3),
        ("(-x)**3", -0.027),
        ("y**-2", 4.0),
        ("y**0.5", math.sqrt(0.5)),
        ("2**3", 8.0),
        ("  sin(pi*x) ", math.sin(math.pi * 0.3)),
        ("cos(x)*exp(-y)+sqrt(z)-tanh(x)", math.cos(0.3) * math.exp(-0.5) + math.sqrt(2) - math.tanh(0.3)),
        ("1e3*x", 300.0),
    ],
)
def test_values(text: str, value: float) -> None:
    assert parse_expression(text)(0.3, 0.5, 2.0) == pytest.approx(value, rel=1e-14)


def test_other_objects_than_floats() -> None:
    x = np.array([-0.2, 0.4])
    result = parse_expression("2*x**2 + sin(x) - 1/(3 + y)")(x, 1.0, 0.0, functions=NUMERIC)
    np.testing.assert_allclose(result, 2 * x**2 + np.sin(x) - 0.25)


def test_variables_and_pressure() -> None:
    assert parse_expression("sin(pi*x) + z").variables == {"x", "z"}
    assert parse_expression("pi").variables == frozenset()
    pressure = PressureField(expression="2*x", unit="kPa")
    assert pressure.factor == 1000.0
    assert pressure(0.5, 0.0, 0.0) == 1000.0


CANNOT_BE_READ = "this cannot be read"
MAY_USE_ONLY = "may use only numbers, x, y, z, pi"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", CANNOT_BE_READ),
        ("2+", CANNOT_BE_READ),
        ("x y", CANNOT_BE_READ),
        ("2x", CANNOT_BE_READ),
        ("x = 1", "on one line"),
        ("(" * 250, CANNOT_BE_READ),
        ("x^2", "powers are written with \\*\\*"),
        ("x if y else z", MAY_USE_ONLY),
        ("x and y", MAY_USE_ONLY),
        ("not x", MAY_USE_ONLY),
        ("x < y", "on one line"),
        ("x % y", "on one line"),
        ("x // y", MAY_USE_ONLY),
        ("x\ny", "on one line"),
        ("x, y", MAY_USE_ONLY),
        ("()", MAY_USE_ONLY),
        ("x.real", MAY_USE_ONLY),
        ("x()", 'unknown name "x": did you mean'),
        ("[x]", "on one line"),
        ("'x'", "on one line"),
        ("lambda x", CANNOT_BE_READ),
        ("lambda_", 'unknown name "lambda_": known are x, y, z, pi, sin'),
        ("__import__(x)", 'unknown name "__import__"'),
        ("sinh(x)", 'unknown name "sinh": did you mean sin\\?'),
        ("sim(x)", 'unknown name "sim": did you mean sin\\?'),
        ("X", 'unknown name "X": did you mean x\\?'),
        ("sin", 'unknown name "sin"'),
        ("sin()", "sin takes one argument"),
        ("sin(x, y)", "sin takes one argument"),
        ("sin(*x)", "sin takes one argument|may use only"),
        ("sin(x)(y)", MAY_USE_ONLY),
        ("True", "constants must be real numbers"),
        ("None", "constants must be real numbers"),
        ("2j", "constants must be real numbers"),
        ("...", "constants must be real numbers"),
        ("1e999", "constants must be finite"),
        ("x**y", "the exponent of \\*\\* must be a number"),
        ("x**(1/2)", "the exponent of \\*\\* must be a number"),
        ("x**17", "must lie between -16 and 16"),
        ("x**-1e9", "must lie between -16 and 16"),
        ("9**9**9", "the exponent of \\*\\* must be a number"),
        ("x" * (MAX_LENGTH + 1), f"at most {MAX_LENGTH} characters"),
        ("-" * (MAX_DEPTH + 1) + "x", f"nested deeper than {MAX_DEPTH}"),
        ("1_000..real", MAY_USE_ONLY),
        ("1if x else y", MAY_USE_ONLY),
    ],
)
def test_refusals(text: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        parse_expression(text)


@pytest.mark.parametrize("text", ["x*" * 98 + "x", "1" + "0" * 290 + "*x*1e-290", "((((((((((x))))))))))"])
def test_long_but_allowed(text: str) -> None:
    value: Any = parse_expression(text)(1.0, 0.0, 0.0)
    assert value == pytest.approx(1.0)


SMOOTH = (
    "3", "x", "-x*y", "x/y - z", "x**3 + y**-2", "x**0.5*z", "x**0 + x**1 + x**-16", "sin(x*y)*cos(z)",
    "exp(-x**2)/(1 + y)",
    "log(x + y*z)", "sqrt(x)*tanh(y - x)", "+(x - 2*(y - 3*x))/(z*z)",
)  # fmt: skip


@pytest.mark.parametrize("text", SMOOTH)
@pytest.mark.parametrize("name", ["x", "y", "z"])
def test_derivatives(text: str, name: str) -> None:
    """Against central differences, of second order in the step."""
    expression, place = parse_expression(text), dict(x=0.7, y=1.3, z=0.4)
    found = derivative(expression, name)(*place.values())
    for step in (1e-3, 1e-4):
        low, high = (expression(*{**place, name: place[name] + sign * step}.values()) for sign in (-1, 1))
        assert (high - low) / (2 * step) == pytest.approx(found, rel=500 * step**2, abs=1e-9)


def test_derivatives_of_all_functions_are_known() -> None:
    for function in FLOAT_FUNCTIONS:
        assert derivative(parse_expression(f"{function}(x)"), "y")(0.5, 0.0, 0.0) == 0.0
        assert derivative(parse_expression(f"{function}(x)"), "x")(0.5, 0.0, 0.0) != 0.0


def test_other_variables() -> None:
    """A short expression in others than the place; its errors name them."""
    assert parse_expression("I1*I2", ("I1", "I2"))(2.0, 3.0) == 6.0
    with pytest.raises(ValueError, match='unknown name "x": known are I1, I2, pi'):
        parse_expression("x", ("I1", "I2"))
    with pytest.raises(ValueError, match="must be arithmetic in I1 and I2"):
        parse_expression("I1;", ("I1", "I2"))
