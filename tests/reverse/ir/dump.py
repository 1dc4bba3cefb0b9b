"""The intermediate form as text, for tests, documents and people: one statement a line."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.dump_types import dump_type
from rebsync.reverse.ir.expressions import Expression
from rebsync.reverse.ir.program import Class, Function, FunctionKind, Parameter, ParameterKind
from rebsync.reverse.ir.types import UNKNOWN
from rebsync.unions import assert_never
from tests.reverse.ir.dump_expressions import dump_expression, dump_operator


def dump_function(function: Function) -> str:
    """A function with its body."""
    inner = ", ".join(map(_parameter, function.parameters))
    result = "" if function.result == UNKNOWN else f" -> {dump_type(function.result)}"
    kind = "" if function.kind is FunctionKind.FUNCTION else f"{function.kind.value} "
    owner = "" if function.owner is None else f" of {function.owner}"
    head = f"{kind}{function.name}({inner}){result}{owner}\n"
    return head + "".join(f"  {line}\n" for line in _body(function.body))


def dump_body(body: s.Body) -> str:
    """Some statements."""
    return "".join(f"{line}\n" for line in _body(body))


def dump_class(class_: Class) -> str:
    """What a class declares."""
    bases = ", ".join(base or "?" for base in class_.bases)
    lines = [f"class {class_.name}({bases}){'' if class_.complete else ' and more'}"]
    lines += [f"  {'shared ' * f.is_shared}{f.name}: {dump_type(f.type)}" for f in class_.fields]
    lines += [f"  {name} = {function}" for name, function in class_.methods]
    for found in class_.properties:
        parts = (("get", found.getter), ("set", found.setter), ("delete", found.deleter))
        shown = ", ".join(f"{word} {function}" for word, function in parts if function)
        lines.append(f"  property {found.name}: {shown}")
    return "".join(f"{line}\n" for line in lines)


def _parameter(parameter: Parameter) -> str:
    stars = {ParameterKind.REST: "*", ParameterKind.NAMED_REST: "**"}.get(parameter.kind, "")
    type_ = "" if parameter.type == UNKNOWN else f": {dump_type(parameter.type)}"
    return f"{stars}{parameter.name}{type_}{'=' if parameter.has_default else ''}"


def _body(body: s.Body) -> Iterator[str]:
    for statement in body:
        if isinstance(statement, s.Structured):
            yield from _structured(statement)
        else:
            yield _simple(statement)


def _indented(head: str, body: s.Body) -> Iterator[str]:
    yield head
    for line in _body(body):
        yield f"  {line}"


def _part(head: str, body: s.Body) -> Iterator[str]:
    """A part that is left out where nothing is in it."""
    if body:
        yield from _indented(head, body)


def _simple(statement: s.Simple) -> str:
    match statement:
        case s.Evaluate(value):
            return f"evaluate {dump_expression(value)}"
        case s.Assign(target, value):
            return f"{dump_expression(target)} = {dump_expression(value)}"
        case s.CompoundAssign(target, operator, value, dynamic):
            sign = dump_operator(operator, dynamic)
            return f"{dump_expression(target)} {sign}= {dump_expression(value)}"
        case s.Unpack(targets, value, rest):
            shown = (f"{'*' * (n == rest)}{dump_expression(x)}" for n, x in enumerate(targets))
            return f"unpack {', '.join(shown)} = {dump_expression(value)}"
        case s.Insert(container, value, key):
            at = "" if key is None else f" at {dump_expression(key)}"
            return f"insert {dump_expression(value)} into {dump_expression(container)}{at}"
        case s.Declare(target, type_, value):
            begin = "" if value is None else f" = {dump_expression(value)}"
            return f"declare {dump_expression(target)}: {dump_type(type_)}{begin}"
        case s.Delete(target):
            return f"delete {dump_expression(target)}"
        case s.Import(target, module, name, is_program):
            kind = "module" if is_program else "library"
            part = "" if name is None else f" {name} of"
            return f"{_stored(target)}import{part} {kind} {module}"
        case s.Return(value):
            return "return" if value is None else f"return {dump_expression(value)}"
        case s.Raise(value, cause):
            shown_value = "" if value is None else f" {dump_expression(value)}"
            return f"raise{shown_value}{'' if cause is None else f' from {dump_expression(cause)}'}"
        case s.Break():
            return "break"
        case s.Continue():
            return "continue"
        case _:
            return _effect(statement)


def _effect(
    statement: s.Call | s.Construct | s.Destroy | s.DefineClass | s.Yield | s.Await | s.Unsupported,
) -> str:
    match statement:
        case s.Call(target, callee, arguments):
            return f"{_stored(target)}call {_callee(callee)}({_arguments(arguments)})"
        case s.Construct(target, class_name, arguments, constructor):
            by = "" if constructor is None else f" by {constructor}"
            return f"{_stored(target)}construct {class_name}({_arguments(arguments)}){by}"
        case s.Destroy(target, class_name):
            kind = "" if class_name is None else f" as {class_name}"
            return f"destroy {dump_expression(target)}{kind}"
        case s.DefineClass(target, class_name, bases):
            return f"{_stored(target)}define class {class_name}({_arguments(bases)})"
        case s.Yield(target, value, delegates):
            return f"{_stored(target)}yield {'all of ' * delegates}{dump_expression(value)}"
        case s.Await(target, value):
            return f"{_stored(target)}await {dump_expression(value)}"
        case s.Unsupported(reason, reads, writes, target):
            shown = [
                f" {word} {', '.join(map(dump_expression, names))}"
                for word, names in (("reads", reads), ("writes", writes))
                if names
            ]
            return f"{_stored(target)}unsupported: {reason}{''.join(shown)}"
        case _:
            assert_never(statement)


def _structured(statement: s.Structured) -> Iterator[str]:
    match statement:
        case s.Assert(test, message, text, dynamic):
            head = f"assert{'?' * dynamic} {dump_expression(test)}"
            yield from _indented(head, message)
            if text is not None:
                yield f"  with {dump_expression(text)}"
        case s.Block(body):
            yield from _indented("block", body)
        case s.If(test, then, otherwise, dynamic):
            yield from _indented(f"if{'?' * dynamic} {dump_expression(test)}", then)
            yield from _part("else", otherwise)
        case s.Loop(test, body, prelude, step, otherwise, body_first, dynamic):
            first = ", body first" if body_first else ""
            yield from _indented(f"loop{'?' * dynamic} {dump_expression(test)}{first}", body)
            yield from _part("before each test", prelude)
            yield from _part("step", step)
            yield from _part("else", otherwise)
        case s.ForEach(target, iterable, body, otherwise):
            waits = "await " if statement.waits else ""
            element = f"{waits}{'&' * statement.by_reference}{dump_expression(target)}"
            mark = "?" * statement.dynamic
            yield from _indented(f"for{mark} {element} in {dump_expression(iterable)}", body)
            yield from _part("else", otherwise)
        case s.Switch(value, cases):
            yield f"switch {dump_expression(value)}"
            for case_ in cases:
                values = [dump_expression(v) for v in case_.values] + ["else"] * case_.is_default
                yield from (f"  {x}" for x in _indented(f"case {', '.join(values)}", case_.body))
        case s.Try(body, handlers, otherwise, final):
            yield from _indented("try", body)
            for handler in handlers:
                yield from _part("before handler", handler.prelude)
                yield from _indented(_handler(handler), handler.body)
            yield from _part("else", otherwise)
            yield from _part("finally", final)
        case s.With(context, target, body, waits):
            start = "await " if waits else ""
            head = f"{_stored(target)}{start}with {dump_expression(context)}"
            yield from _indented(head, body)
        case s.Unsequenced(parts):
            yield "in any order"
            for part in parts:
                yield from (f"  {x}" for x in _indented("part", part))
        case _:
            assert_never(statement)


def _handler(handler: s.Handler) -> str:
    types = handler.types
    what = "" if types is None else f" {', '.join(map(dump_expression, types))}"
    return (
        f"handle{what}{'' if handler.target is None else f' as {dump_expression(handler.target)}'}"
    )


def _stored(target: Expression | None) -> str:
    return "" if target is None else f"{dump_expression(target)} = "


def _callee(callee: s.Callee) -> str:
    match callee:
        case s.FunctionCallee(name):
            return f"function {name}"
        case s.LibraryCallee(name, receiver):
            of = "" if receiver is None else f" of {dump_expression(receiver)}"
            return f"library {name}{of}"
        case s.MethodCallee(receiver, name, declared, after, dynamic):
            start = "" if declared is None else f"({declared})"
            behind = "" if after is None else f" behind {after}"
            return f"method {start}{dump_expression(receiver)}{'?' * dynamic}.{name}{behind}"
        case s.ValueCallee(value):
            return dump_expression(value)
        case _:
            assert_never(callee)


def _arguments(arguments: tuple[s.CallArgument, ...]) -> str:
    return ", ".join(
        f"{'*' * a.stars}{'' if a.name is None else f'{a.name}='}{dump_expression(a.value)}"
        for a in arguments
    )
