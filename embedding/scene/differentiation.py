"""Derivatives of the expressions of a scene, as expressions."""

from __future__ import annotations

import ast
from dataclasses import replace

from embedding.scene.expression import Expression, exponent_of

ZERO, ONE = ast.Constant(0.0), ast.Constant(1.0)


def derivative(expression: Expression, name: str) -> Expression:
    """The derivative in the variable ``name``; on the same variables, and valid where the expression is smooth."""
    return replace(expression, text=f"d({expression.text})/d{name}", tree=_slope(expression.tree, name))


def _slope(node: ast.expr, name: str) -> ast.expr:
    match node:
        case ast.Name(id=found):
            return ONE if found == name else ZERO
        case ast.UnaryOp(op=sign, operand=operand):
            return ast.UnaryOp(sign, _slope(operand, name))
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            power = exponent_of(right)
            if power == 0.0:
                return ZERO
            lower = ast.BinOp(left, ast.Pow(), ast.Constant(power - 1.0)) if power != 1.0 else ONE
            return _times(_times(ast.Constant(power), lower), _slope(left, name))
        case ast.BinOp(left=left, op=(ast.Add() | ast.Sub()) as sign, right=right):
            return ast.BinOp(_slope(left, name), sign, _slope(right, name))
        case ast.BinOp(left=left, op=ast.Mult(), right=right):
            return ast.BinOp(_times(_slope(left, name), right), ast.Add(), _times(left, _slope(right, name)))
        case ast.BinOp(left=left, op=ast.Div(), right=right):
            above = ast.BinOp(_slope(left, name), ast.Sub(), _times(node, _slope(right, name)))
            return ast.BinOp(above, ast.Div(), right)
        case ast.Call(func=ast.Name(id=function), args=[argument]):
            return _times(_outer(function, argument), _slope(argument, name))
    return ZERO


def _outer(function: str, argument: ast.expr) -> ast.expr:
    """Derivative of a function of the grammar at its argument."""

    def call(other: str) -> ast.expr:
        return ast.Call(ast.Name(other), [argument], [])

    match function:
        case "sin":
            return call("cos")
        case "cos":
            return ast.UnaryOp(ast.USub(), call("sin"))
        case "exp":
            return call("exp")
        case "log":
            return ast.BinOp(ONE, ast.Div(), argument)
        case "sqrt":
            return ast.BinOp(ast.Constant(0.5), ast.Div(), call("sqrt"))
        case "tanh":
            return ast.BinOp(ONE, ast.Sub(), ast.BinOp(call("tanh"), ast.Pow(), ast.Constant(2.0)))
    raise ValueError(f"no derivative of {function} is known")


def _times(left: ast.expr, right: ast.expr) -> ast.expr:
    """The product, 0 where a factor is: quotients of 0 never come to be."""
    return ZERO if ZERO in (left, right) else ast.BinOp(left, ast.Mult(), right)
