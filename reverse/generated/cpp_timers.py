"""Timers that somebody has put into a class of generated code.

What a timer's callback posts to the mailbox waits there for its turn, as a message with `after`
does. Anything else that a callback does, it does while a body may run: that is listed.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from fractions import Fraction

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_expressions import CppExpressions
from rebsync.reverse.bodies.scope import Scope, TimerOf
from rebsync.reverse.bodies.subscripts import untested
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.generated.cpp_idle import working
from rebsync.reverse.generated.cpp_roles import Roles, call_in
from rebsync.reverse.libraries.generated_calls import is_period
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_numerals import numeral
from rebsync.reverse.syntax.cpp_tree import Cpp, last_name, named, part, text_of

MAKES = frozenset(
    {"createTimer", "createWallTimer", "createSteadyTimer", "create_timer", "create_wall_timer"}
)
_DURATIONS = frozenset(
    {
        *("ros::Duration", "ros::WallDuration", "ros::SteadyDuration"),
        *("rclcpp::Duration::from_seconds", "std::chrono::duration<double>"),
    }
)
_SPANS = {
    "minutes": Fraction(60),
    "seconds": Fraction(1),
    "milliseconds": Fraction(1, 1000),
    "min": Fraction(60),
    "s": Fraction(1),
    "ms": Fraction(1, 1000),
}
_SPAN = re.compile(r"(?:std::)?(?:chrono::)?(minutes|seconds|milliseconds)\Z")
_LITERAL = re.compile(r"([\d.']+)(min|s|ms)\Z")


@dataclass(frozen=True, slots=True)
class Timer:
    """A call that makes a timer: `function` has the call, `seconds` is the period, or, times
    `scale`, as many seconds.

    The callback is a function of the class, or a lambda; `posts` is the server to which it posts a
    message and does nothing else.
    """

    call: CppCall
    function: CppFunction
    seconds: Node
    one_shot: bool
    callback: str
    lambda_: Node | None
    posts: str | None
    scale: Fraction = Fraction(1)

    @property
    def at_start(self) -> bool:
        """Whether it is the class's constructor that makes it."""
        return self.function.name == self.function.owner


def timers_of(code: Code, owner: CppClass, roles: Roles) -> Iterator[Timer]:
    """The timers that the functions of a class make, but for those of which that is not plain."""
    for function in code.functions_of(owner):
        for call in code.calls_of(function):
            if makes(call) and (timer := _timer(code, owner, roles, function, call)):
                yield timer


def makes(call: CppCall) -> bool:
    """Whether a call makes a timer."""
    return call.name.removeprefix("rclcpp::") in MAKES


def idle_timers(code: Code, owner: CppClass) -> Iterator[CppCall]:
    """The calls that make timers whose callbacks do nothing but to log."""
    for function in code.functions_of(owner):
        for call in code.calls_of(function):
            body = _called_back(code, owner, call)[2] if makes(call) else None
            is_seldom = makes(call) and has_period(code, owner, function.cpp, call)
            if is_seldom and body is not None and named(body) and not working(body):
                yield call


def has_period(code: Code, owner: CppClass, cpp: Cpp, call: CppCall) -> bool:
    """Whether a timer's period is known to leave the thread that calls back time for others."""
    given = _arguments(call)
    lasts = _lasting(code, owner, cpp, given[0]) if given else None
    seconds = _seconds(*lasts) if lasts is not None else None
    return seconds is not None and is_period(seconds)


def _arguments(call: CppCall) -> list[Node]:
    """Period, callback and flags, without the node and the clock that a free function is given."""
    given = list(call.arguments)
    return given[2:] if call.name.startswith("rclcpp::") else given


def _called_back(
    code: Code, owner: CppClass, call: CppCall
) -> tuple[str, Node | None, Node | None, list[Node]]:
    """What a timer calls: a function by its name, or a lambda; its body; and flags behind it."""
    name, lambda_, flags = "", None, _arguments(call)
    if len(flags) < 2:
        return name, lambda_, None, flags
    _, callback, *flags = flags
    if callback.type == "lambda_expression":
        lambda_ = callback
    elif callback.type == "pointer_expression" and flags and flags[0].type == "this":
        name, flags = last_name(callback).lstrip("& "), flags[1:]
    elif (bound := call_in(callback)) is not None:
        name = bound[0]
    own = next((f for f in code.functions_of(owner) if f.name == name), None)
    body = part(lambda_, "body") if lambda_ is not None else None
    if own is not None and not _is_overridden(code, owner, name):
        body = own.body
    return name, lambda_, body, flags


def _is_overridden(code: Code, owner: CppClass, name: str) -> bool:
    """Whether a class below has a function by the name of one of a class."""
    below = (c for c in code.classes.values() if c is not owner and owner in code.lineage(c.name))
    return any(f.name == name for c in below for f in code.functions_of(c))


def _timer(
    code: Code, owner: CppClass, roles: Roles, function: CppFunction, call: CppCall
) -> Timer | None:
    given = _arguments(call)
    lasts = _lasting(code, owner, function.cpp, given[0]) if len(given) > 1 else None
    name, lambda_, body, flags = _called_back(code, owner, call)
    if lasts is None or (flags and call.name.removeprefix("rclcpp::").startswith("create_")):
        return None
    is_logging = body is not None and bool(named(body)) and not working(body)
    if is_logging and has_period(code, owner, function.cpp, call):
        return None
    own = next((f for f in code.functions_of(owner) if f.name == name), None)
    one_shot = text_of(flags[0]) if flags else "false"
    if (lambda_ is None and own is None) or one_shot not in ("true", "false") or len(flags) > 1:
        return None
    seconds, scale = lasts
    statements = working(body)
    stops = [s for s in statements if _stops(s, _kept(call))]
    posts = _posts(roles, [s for s in statements if s not in stops])
    once = one_shot == "true" or (bool(stops) and posts is not None)
    return Timer(call, function, seconds, once, name, lambda_, posts, scale)


def _kept(call: CppCall) -> str:
    """The member that keeps a timer."""
    above = call.node.parent
    is_kept = above is not None and above.type == "assignment_expression"
    return text_of(part(above, "left")).removeprefix("this->") if above and is_kept else ""


def _stops(statement: Node, timer: str) -> bool:
    """Whether a statement is `timer->cancel();`, or `timer.stop();`."""
    text = "".join(text_of(statement).split()).removeprefix("this->")
    return bool(timer) and text in (f"{timer}->cancel();", f"{timer}.stop();")


def _lasting(code: Code, owner: CppClass, cpp: Cpp, period: Node) -> tuple[Node, Fraction] | None:
    """The number that says how long something lasts, and how many seconds its unit has."""
    given = call_of(period)
    if given is None:
        literal = _LITERAL.match(text_of(period))
        if literal is not None:
            return period, _SPANS[literal[2]]
        return _named_span(code, owner, cpp, text_of(period).removeprefix("this->"))
    if len(given.arguments) != 1:
        return None
    scale = _scale(given.name)
    if scale is None:
        return None
    (number,) = given.arguments
    constant = code.constant(cpp, text_of(number)) if number.type == "identifier" else None
    if constant is not None and (value := _number(constant[1])) is not None:
        return value, scale
    return number, scale


def _named_span(code: Code, owner: CppClass, cpp: Cpp, name: str) -> tuple[Node, Fraction] | None:
    """The same of a constant or a member that is a span of time, and that nothing writes."""
    field = next((f for f in owner.fields if f.name == name), None)
    constant = code.constant(cpp, name) if field is None else None
    if field is not None and field.value is not None:
        writes = re.compile(rf"\b{name}\s*(?:[-+*/]?=[^=]|\.)")
        texts = (text_of(f.body) for f in code.functions_of(owner) if f.body is not None)
        declared, value = field.type, field.value
        if any(writes.search(text) for text in texts):
            return None
    elif constant is not None:
        value = constant[1]
        above = climb(value, lambda n: n.type in ("declaration", "field_declaration"))
        if above is None:
            return None
        declared = part(above, "type")
    else:
        return None
    scale, number = _scale(text_of(declared)), _number(value)
    if scale is not None and number is not None:
        return number, scale
    return _lasting(code, owner, cpp, value) if call_of(value) or _is_span(value) else None


def _is_span(value: Node) -> bool:
    return _LITERAL.match(text_of(value)) is not None


def _number(value: Node) -> Node | None:
    """The number in parentheses or braces."""
    while value.type in ("initializer_list", "argument_list") and len(named(value)) == 1:
        value = named(value)[0]
    return value if value.type == "number_literal" else None


def _scale(type_: str) -> Fraction | None:
    """The seconds that a unit of a type has, or of what a function makes a span of time of."""
    span = _SPAN.match(type_)
    if span is not None:
        return _SPANS[span[1]]
    return Fraction(1) if type_ in _DURATIONS else None


def _posts(roles: Roles, statements: list[Node]) -> str | None:
    """The server to which a callback posts a message without arguments, if that is all."""
    inner = named(statements[0]) if len(statements) == 1 else []
    call = call_of(inner[0]) if len(inner) == 1 else None
    plain = call is not None and (call.target is None or call.target.type == "this")
    called = (call.name, list(call.arguments)) if call is not None and plain else None
    sends = roles.sends.get(called[0]) if called is not None and not called[1] else None
    return sends.server if sends is not None and sends.known == "self" else None


def checked(timer: Timer, within: str, findings: Findings) -> None:
    """Lists a timer whose callback may run in the middle of a body."""
    if timer.posts is None:
        why = "this callback does not wait until a body has run: the model serves one at a time"
        hint = "let it post a message to the mailbox, and do nothing else"
        unread = Unread(timer.function.cpp.span(timer.call.node), why, hint)
        findings.unreadable(timer.function.cpp.source, unread, within)


def ticking(timers: Iterable[Timer]) -> int:
    """The places in the queue that timers' own messages need beside those of the code."""
    return sum(not t.one_shot for t in timers)


def server_of_timer(timer: Timer, name: str) -> TimerOf:
    """What making the timer in a body stands for; `name` is the server that the callback is."""
    server = timer.posts if timer.one_shot and timer.posts is not None else name
    return TimerOf(server, not timer.one_shot)


def sent_later(timer: Timer, server: str, scope: Scope) -> m.Statement:
    """`self.server() after(period)`; `Unread` where the model has no such time."""
    cpp = timer.function.cpp
    span = cpp.span(timer.call.node)
    call = m.Call(m.Self(span), server, (), _time(timer, scope), None, span)
    return m.ExpressionStatement(call, (), span)


def _time(timer: Timer, scope: Scope) -> m.Expression:
    cpp, node = timer.function.cpp, timer.seconds
    if node.type == "number_literal" or _is_span(node):
        seconds = _seconds(node, timer.scale)
        units = seconds / scope.unit if seconds is not None else None
        if units is None or units.denominator != 1:
            why = f"{text_of(node)} s is no multiple of the model's unit of time"
            raise Unread(cpp.span(node), why, "change `time_unit`")
        return m.IntLiteral(int(units), cpp.span(node))
    if scope.unit != timer.scale:
        raise Unread(cpp.span(node), "this time is in seconds, which are no units of the model")
    reader = CppExpressions(cpp, scope)
    read = reader.read(node)
    untested(reader.subscripts)
    return read


def _seconds(node: Node, scale: Fraction) -> Fraction | None:
    """How many seconds a number of a unit, or with a unit, are; None of what is no number."""
    literal = _LITERAL.match(text_of(node))
    number = numeral(literal[1] if literal else text_of(node))
    return number.exact * scale if number is not None else None


def with_rearming(body: m.Block, again: m.Statement) -> m.Block:
    """The body of a periodic timer's callback, which sends itself the next tick.

    First where it may not come to its end, or is late there: the timer ticks all the same.
    """
    leaves = any(isinstance(n, m.Return) or _may_delay(n) for n in m.walk(body))
    all_of = (again, *body.statements) if leaves else (*body.statements, again)
    return m.Block(all_of, body.annotations, body.span)


def _may_delay(node: m.Node) -> bool:
    return isinstance(node, m.Call) and node.target is None and node.name != "assertion"
