"""Sends, method calls and built-in functions."""

from __future__ import annotations

from rebsync.model import BoolLiteral, Call, Expression, Type
from rebsync.records import dataclass
from rebsync.static.constants import constant
from rebsync.static.conversions import check_condition
from rebsync.static.facts import Delay, Invocation, Send
from rebsync.static.overloads import Arguments, select
from rebsync.static.scope import FUNCTIONS, Body, Kind
from rebsync.static.symbols import (
    BuiltinFunctionSymbol,
    Callable,
    ClassInfo,
    MethodSymbol,
    ServerSymbol,
)
from rebsync.static.types import REFUSED, STRING, VOID, is_integer, is_numeric, is_rebec

_REFUSED = {
    "startTimer": REFUSED["Timer"],
    "stopTimer": REFUSED["Timer"],
    "getTimerValue": REFUSED["Timer"],
    "getAllActors": "name the rebecs under knownrebecs",
}


@dataclass(frozen=True, slots=True)
class Receiver:
    """What stands before the dot of a call; `implicit` when nothing does."""

    type: Type | None
    implicit: bool = False
    to_self: bool = False
    to_super: bool = False

    @property
    def is_own(self) -> bool:
        return self.implicit or self.to_self or self.to_super


def call_type(call: Call, receiver: Receiver, arguments: Arguments, body: Body) -> Type | None:
    """The type of a call whose parts have been typed: `void` for a send."""
    info = _class(call, receiver, body)
    if info is None and not receiver.implicit:
        return None
    candidates = info.callables.get(call.name, ()) if info is not None else ()
    if candidates:
        symbol = select(
            candidates, arguments, call.arguments, call.name, call.name_span, body.facts
        )
        return _use(call, symbol, receiver, body) if symbol is not None else None
    if receiver.implicit and call.name in FUNCTIONS:
        return _builtin(call, FUNCTIONS[call.name], arguments, body)
    _unknown(call, receiver, info, body)
    return None


def _class(call: Call, receiver: Receiver, body: Body) -> ClassInfo | None:
    """The class whose server or method a call names; reports a receiver that has none."""
    if receiver.implicit or receiver.to_self:
        return body.owner
    type_ = receiver.type
    if type_ is None or call.target is None:
        return None
    if type_.name == "ReactiveClass" and not type_.dimensions:
        message = f'the class that has "{call.name}" is not known here'
        hint = f"name it with a cast: ((C) sender).{call.name}(...)"
        body.facts.error("RS319", call.target.span, message, hint)
        return None
    if not is_rebec(type_):
        message = f'a value of type "{type_}" takes no messages'
        body.facts.error("RS318", call.target.span, message)
        return None
    return body.facts.classes.get(type_.name)


def _unknown(call: Call, receiver: Receiver, info: ClassInfo | None, body: Body) -> None:
    facts, span = body.facts, call.name_span
    if info is not None and info.partial:
        return
    if receiver.implicit and call.name in _REFUSED:
        message = f'the function "{call.name}" is not supported'
        facts.error("RS110", span, message, _REFUSED[call.name])
        return
    if receiver.implicit:
        own = set(info.callables) if info is not None else set()
        message = f'unknown message server or method "{call.name}"'
        facts.unknown("RS204", span, message, call.name, own | set(FUNCTIONS))
    elif info is not None:
        legal = set(info.callables) if receiver.is_own else {s.name for s in info.servers}
        kind = "message server or method" if receiver.is_own else "message server"
        message = f'"{info.name}" has no {kind} "{call.name}"'
        facts.unknown("RS204", span, message, call.name, legal)


def _use(call: Call, symbol: Callable, receiver: Receiver, body: Body) -> Type | None:
    body.facts.symbols[id(call)] = symbol
    if isinstance(symbol, MethodSymbol):
        return _invoke(call, symbol, receiver, body)
    return _send(call, symbol, receiver, body)


def _invoke(call: Call, symbol: MethodSymbol, receiver: Receiver, body: Body) -> Type | None:
    if not receiver.is_own:
        message = f'the method "{symbol.name}" of another rebec cannot be called'
        hint = "only its message servers can be reached"
        body.facts.error("RS211", call.name_span, message, hint)
    _check_untimed(call, "method", body)
    body.events.append(Invocation(symbol, call))
    return symbol.type


def _send(call: Call, symbol: ServerSymbol, receiver: Receiver, body: Body) -> Type:
    facts = body.facts
    to_self = receiver.implicit or receiver.to_self
    if receiver.to_super:
        message = f'the message server "{symbol.name}" cannot be sent to through super'
        facts.error("RS318", call.span, message, f"write self.{symbol.name}(...)")
    elif body.kind is Kind.CONSTRUCTOR and not to_self:
        message = f'a constructor cannot send "{symbol.name}" to another rebec'
        hint = "send a message to self and send from there, or send from a method called here"
        facts.error("RS424", call.span, message, hint)
    _check_deadline(call, body)
    owner = body.owner.name if body.owner is not None else ""
    target = owner if to_self or receiver.type is None else receiver.type.name
    body.events.append(Send(symbol, call, target, to_self))
    return VOID


def _check_deadline(call: Call, body: Body) -> None:
    if call.deadline is None or call.after is None:
        return
    after, deadline = body.facts.value(call.after), body.facts.value(call.deadline)
    if isinstance(after, int) and isinstance(deadline, int) and 0 <= deadline < after:
        message = f'"{call.name}" arrives after {after}, its deadline {deadline} is over by then'
        hint = "both count from the sending: the deadline must not be shorter"
        body.facts.warn("RS506", call.deadline.span, message, hint)


def check_time(time: Expression, type_: Type | None, word: str, body: Body) -> None:
    """Checks the argument of `after`, `deadline` or `delay`."""
    if type_ is None:
        return
    if not is_integer(type_):
        message = f'{word} takes whole units of time, not "{type_}"'
        body.facts.error("RS312", time.span, message)
        return
    value = body.facts.value(time)
    if value is not None and value < 0:
        body.facts.error("RS425", time.span, f"{word} cannot be negative: this is {value}")


def _check_untimed(call: Call, kind: str, body: Body) -> None:
    for time, word in ((call.after, "after"), (call.deadline, "deadline")):
        if time is not None:
            message = f'"{call.name}" is a {kind}: {word} belongs to messages only'
            body.facts.error("RS423", time.span, message)


# --- built-in functions ------------------------------------------------------------------------


def _builtin(
    call: Call, symbol: BuiltinFunctionSymbol, arguments: Arguments, body: Body
) -> Type | None:
    body.facts.symbols[id(call)] = symbol
    _check_untimed(call, "built-in function", body)
    if not any(len(s) == len(arguments) for s in symbol.signatures):
        counts = " or ".join(str(len(s)) for s in symbol.signatures)
        many = "" if counts == "1" else "s"
        message = f'"{call.name}" takes {counts} argument{many}, not {len(arguments)}'
        body.facts.error("RS310", call.name_span, message)
    elif call.name == "delay":
        check_time(call.arguments[0], arguments[0], "delay", body)
        body.events.append(Delay(call))
    elif call.name == "assertion":
        _check_assertion(call, arguments, body)
    else:
        _check_numbers(call, arguments, body)
    return symbol.type


def _check_assertion(call: Call, arguments: Arguments, body: Body) -> None:
    condition = call.arguments[0]
    check_condition(condition, arguments[0], "assertion", body)
    value = constant(condition)
    # `assertion(false)` on its own is the way to say that a place must not be reached.
    if isinstance(value, bool) and condition != BoolLiteral(False):
        always = "never fails" if value else "always fails"
        body.facts.warn("RS510", condition.span, f"this assertion {always}")
    text = arguments[1] if len(arguments) > 1 else None
    if text is not None and text != STRING:
        message = f'argument 2 of "assertion" must be a text, not "{text}"'
        body.facts.error("RS310", call.arguments[1].span, message)


def _check_numbers(call: Call, arguments: Arguments, body: Body) -> None:
    for i, (argument, type_) in enumerate(zip(call.arguments, arguments, strict=True)):
        if type_ is not None and not is_numeric(type_):
            message = f'argument {i + 1} of "{call.name}" must be a number, not "{type_}"'
            body.facts.error("RS310", argument.span, message)
