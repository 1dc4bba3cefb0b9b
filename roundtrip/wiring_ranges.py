"""Where bodies in Python do not say that numbers wrap, as those of the model do.

Python's integers have no width, the model's have 32 bits or fewer. Generated code cuts each value
that may be too large, by `int32(...)` and its kin; what somebody writes by hand may not. Division
and remainder of Python are not those of the model either.
"""

from __future__ import annotations

import ast
import re
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from itertools import chain
from typing import TypeAlias

from rebsync.intervals import INT32, INTEGERS, Interval, exactly, of_binary, of_unary
from rebsync.roundtrip.python_trees import is_log

RANGE = "range"
Types: TypeAlias = Mapping[str, str]

_NAMED = {"int": INT32, "Byte": INTEGERS["byte"], "Short": INTEGERS["short"]}
_CUTS = {"int8": "Byte", "int16": "Short", "int32": "int"}
_CASTS = {"to_byte": "Byte", "to_short": "Short", "to_int": "int"}
_SUMS: Mapping[type[ast.operator], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.BitAnd: "&",
    ast.BitOr: "|",
    ast.BitXor: "^",
}
_SIGNS: Mapping[type[ast.unaryop], str] = {ast.USub: "-", ast.UAdd: "+", ast.Invert: "~"}
_DISTANCES = Interval(0, 31)  # of shifts
_CUT = re.compile(r"not cut to (8|16|32) bits")
_MANY = 2**16  # more values than an array has
_WITH_A_POINT = frozenset(
    {"bool", "float32", "float64", "to_float", "to_double", "to_boolean", "square_root", "power"}
)


def range_hint(text: str, why: str) -> str:
    """What to write for an expression, by why it is another than that of the model."""
    if (cut := _CUT.search(why)) is not None:
        return f"write int{cut[1]}({text})"
    return "let the model's own functions say it: int32(...), int8(...), divide, remainder"


def types_of_functions(tree: ast.Module) -> dict[str, str]:
    """What the functions of a module take and return, as `types_in` tells it of a class."""
    found = {}
    for function in tree.body:
        if isinstance(function, ast.FunctionDef):
            found[f"{function.name}()"] = ast.unparse(function.returns or ast.Constant("int"))
            for number, taken in enumerate(function.args.args):
                type_ = ast.unparse(taken.annotation) if taken.annotation else ""
                found[f"{function.name}({number})"] = type_
    return found


def types_in(owner: ast.ClassDef) -> dict[str, str]:
    """The types that a class gives its attributes, and its functions what they take and return.

    What it inherits may be a whole number: that is what "self." stands for.
    """
    found = {"self.": "int"} if {ast.unparse(b) for b in owner.bases} - {"ABC"} else {}
    for node in ast.walk(owner):
        match node:
            case ast.AnnAssign(ast.Attribute(ast.Name("self"), name), annotation):
                found[f"self.{name}"] = ast.unparse(annotation)
            case ast.FunctionDef(name=name, args=arguments, returns=returns):
                found[f"self.{name}()"] = ast.unparse(returns) if returns else ""
                is_static = any(ast.unparse(d) == "staticmethod" for d in node.decorator_list)
                for number, taken in enumerate(arguments.args[not is_static :]):
                    type_ = ast.unparse(taken.annotation) if taken.annotation else ""
                    found[f"self.{name}({number})"] = type_
                    found[f"{owner.name}.{name}({number})"] = type_
                found[f"{owner.name}.{name}()"] = found[f"self.{name}()"]
            case _:
                pass
    return found


def ranges_in(function: ast.FunctionDef, types: Types) -> Iterator[tuple[str, str, ast.expr]]:
    """Each expression of a body that Python may give another value, with what that is."""
    own = dict(types)
    for argument in function.args.args:
        own[argument.arg] = ast.unparse(argument.annotation) if argument.annotation else ""
    for node in ast.walk(function):
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            own[node.target.id] = ast.unparse(node.annotation)
    found = _Ranges(own)
    for node in ast.walk(function):
        for name, type_ in found.implied(node):
            own.setdefault(name, type_)
    inner: set[int] = set()
    for node in _evaluated(function):  # outer ones come first
        for value, type_ in chain(_stored(node, function, own), _used(node, inner)):
            if (why := found.odd(value, type_)) is not None:
                yield ast.unparse(value), why, value
        for operator in _operators(node):
            if (why := found.other(operator)) is not None:
                yield ast.unparse(operator), why, operator


def _evaluated(function: ast.FunctionDef) -> Iterator[ast.AST]:
    """All nodes of a function but what is only logged."""
    waiting: deque[ast.AST] = deque([function])
    while waiting:
        node = waiting.popleft()
        match node:
            case ast.Expr(ast.Call() as call) if is_log(call):
                continue
            case ast.JoinedStr():
                continue  # a text, of any length
            case _:
                yield node
                waiting.extend(ast.iter_child_nodes(node))


class _Ranges:
    """The bounds of expressions, by the types of names; None for what is no whole number."""

    def __init__(self, types: Types) -> None:
        self.types = types

    def odd(self, value: ast.expr, type_: str) -> str | None:
        """Why a value is not that of the model where one of a type is wanted."""
        values, wanted = self.of(value), _NAMED.get(type_, INT32)
        if values is None or wanted.includes(values):
            return None
        return f"not cut to {(wanted.high + 1).bit_length()} bits"

    def other(self, node: ast.BinOp) -> str | None:
        """Why an operator is another than that of the model."""
        left, right = self.of(node.left), self.of(node.right)
        if left is None or right is None:
            return None
        match node.op:
            case ast.Div():
                return "a number with a point"
            case ast.Mod() if left.low < 0 or right.low < 0:
                return "never below zero"
            case ast.LShift() | ast.RShift() if not _DISTANCES.includes(right):
                return "shifted by any distance"
            case _:
                return None

    def implied(self, node: ast.AST) -> Iterator[tuple[str, str]]:
        """The types of variables that a statement sets without saying one.

        What nobody knows the type of may be a whole number.
        """
        match node:
            case ast.Assign(targets, value):
                for target in targets:
                    if isinstance(target, ast.Name):
                        yield target.id, self._implied(value)
            case ast.NamedExpr(ast.Name(name), value):
                yield name, self._implied(value)
            case ast.For(ast.Name(name), values) | ast.comprehension(ast.Name(name), values):
                of = self._type(values).partition("[")[2].partition(",")[0]
                yield name, of or "int"
            case _:
                pass

    def _implied(self, value: ast.expr) -> str:
        match value:
            case ast.Constant(bool()) | ast.Constant(float()) | ast.Constant(str()):
                return "of no width"
            case ast.Compare() | ast.BoolOp() | ast.UnaryOp(ast.Not()):
                return "of no width"
            case ast.Call(ast.Name(name)) if name in _WITH_A_POINT:
                return "of no width"
            case ast.Name() | ast.Attribute() | ast.Subscript():
                return self._type(value) or "int"
            case ast.BinOp() if self.of(value) is None:
                return "of no width"
            case _:
                return "int"

    def of(self, node: ast.expr) -> Interval | None:
        match node:
            case ast.Constant(bool()) | ast.Constant(float()) | ast.Constant(str()):
                return None
            case ast.Constant(int(number)):
                return exactly(number)
            case ast.UnaryOp(operator, operand) if sign := _SIGNS.get(type(operator)):
                of = self.of(operand)
                return of_unary(sign, of) if of is not None else None
            case ast.IfExp(_, one, other):
                return self._any_of([one, other])
            case ast.BinOp(left, operator, right) if not isinstance(operator, ast.Div):
                first, second = self.of(left), self.of(right)
                if first is None or second is None:
                    return None
                return _of_operator(operator, first, second)
            case ast.UnaryOp() | ast.BinOp():
                return None
            case ast.NamedExpr(_, value):
                return self.of(value)
            case ast.Call(ast.Name("min" | "max"), [_, _, *_] as given):
                return self._any_of(given)
            case ast.Call(ast.Name("abs"), [value]) if (inner := self.of(value)) is not None:
                return Interval(0, inner.magnitude)
            case ast.Call(ast.Name("sum"), _):
                return of_binary("*", INT32, exactly(_MANY))
            case _:
                return _NAMED.get(self._type(node))

    def _any_of(self, values: Sequence[ast.expr]) -> Interval | None:
        """What one of some expressions gives; None if one of them is no whole number."""
        found = [self.of(value) for value in values]
        known = [f for f in found if f is not None]
        return reduce(Interval.join, known) if len(known) == len(found) else None

    def _type(self, node: ast.expr) -> str:
        """The type of a name, an element or what is called, as it is written; empty if unknown."""
        match node:
            case ast.Subscript(of, _):
                return self._type(of).partition("[")[2].partition(",")[0]
            case ast.Call(ast.Name(name), _) if name in _CUTS:
                return _CUTS[name]
            case ast.Call(ast.Name(name), _):
                return _CASTS.get(name, "")
            case ast.Call(ast.Attribute(ast.Name(name), _), _) if name in _CUTS:
                return _CUTS[name]
            case ast.Call(of, _):
                return self.types.get(f"{ast.unparse(of)}()", "")
            case ast.Attribute(ast.Name("self"), name):
                inherited = self.types.get("self.", "")
                return self.types.get(f"self.{name}", inherited)
            case ast.Name(name):
                return self.types.get(name, "int")
            case ast.Attribute(ast.Name()):
                return "int"
            case _:
                return ""


# --- where values are used ----------------------------------------------------------------------


def _stored(
    node: ast.AST, function: ast.FunctionDef, types: Types
) -> Iterator[tuple[ast.expr, str]]:
    """What is stored in a variable or returned, with the type of that."""
    match node:
        case ast.Assign([target], value):
            yield value, types.get(ast.unparse(target), "")
        case ast.AnnAssign(_, annotation, value) if value is not None:
            yield value, ast.unparse(annotation)
        case ast.AugAssign(target, operator, value) if type(operator) in (*_SUMS, ast.LShift):
            place = ast.parse(ast.unparse(target), mode="eval").body
            whole = ast.copy_location(ast.BinOp(place, operator, value), node)
            yield whole, types.get(ast.unparse(target), "")
        case ast.Return(value) if value is not None:
            yield value, ast.unparse(function.returns) if function.returns else ""
        case ast.Call(ast.Attribute(ast.Name()) | ast.Name() as called, given):
            name = ast.unparse(called)
            for number, value in enumerate(given):
                if (type_ := types.get(f"{name}({number})")) is not None:
                    yield value, type_
        case _:
            pass


def _used(node: ast.AST, inner: set[int]) -> Iterator[tuple[ast.expr, str]]:
    """Operators whose value is used otherwise; `inner` are those that others go on from."""
    match node:
        case ast.Assign(_, value) | ast.AnnAssign(value=value) | ast.Return(value):
            inner.add(id(value))
        case ast.Expr(value):
            inner.add(id(value))  # nobody looks at it
        case ast.Call(ast.Name(name), [value]) if name in _CUTS or name in _CASTS:
            inner.add(id(value))
        case ast.Call(ast.Attribute(ast.Attribute(ast.Name("self"), "_drive"), "move"), given):
            inner |= {id(g) for g in given if isinstance(g, ast.UnaryOp)}  # a cell less
        case ast.Call(ast.Attribute(ast.Name("self"), _), given):
            inner |= set(map(id, given))
        case _:
            pass
    if not isinstance(node, (ast.BinOp, ast.UnaryOp, ast.IfExp)):
        return
    if id(node) not in inner:
        yield node, "int"
    match node:
        case ast.BinOp(left, operator, right) if type(operator) in _SUMS:
            inner |= {id(left), id(right)}
        case ast.BinOp(left, ast.LShift(), _):
            inner.add(id(left))
        case ast.UnaryOp(operand=operand):
            inner.add(id(operand))
        case ast.IfExp(_, one, other):
            inner |= {id(one), id(other)}
        case _:
            pass


def _operators(node: ast.AST) -> Iterator[ast.BinOp]:
    match node:
        case ast.BinOp():
            yield node
        case ast.AugAssign(target, operator, value):
            place = ast.parse(ast.unparse(target), mode="eval").body
            yield ast.copy_location(ast.BinOp(place, operator, value), node)
        case _:
            pass


def _of_operator(operator: ast.operator, left: Interval, right: Interval) -> Interval:
    """What Python makes of two whole numbers, or what the model has there."""
    if isinstance(operator, ast.LShift) and right.low == right.high and _DISTANCES.includes(right):
        return of_binary("<<", left, right)
    sign = _SUMS.get(type(operator))
    return of_binary(sign, left, right) if sign is not None else INT32
