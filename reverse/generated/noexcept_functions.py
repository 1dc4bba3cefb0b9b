"""Functions of C++ out of which an exception ends the program ([except.spec]).

In generated code an exception that leaves a body ends the body: the mailbox reports it and serves
the next message, and so does the model with an index that is out of range or a time that is
negative. Where a function around it is `noexcept` the node ends instead; so it does when it is told
to stop during a delay, which an exception ends. So such a function has only what throws nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.generated.cpp_meanings import is_runtime_header
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_exceptions import is_noexcept
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside

_WHY = "an exception that leaves this ends the node; in the model it ends the body only"
_MAY_SAY = re.compile(r"\bnoexcept\b|\bthrow\s*\(\s*\)")
_THROWING = ("throw_statement", "new_expression")
# Calls that throw nothing: times of sends, sensors, whose functions are looked into, casts, what
# only looks at or moves values, and logging.
_QUIET = re.compile(
    r"after\Z|deadline\Z|text\Z|seen\Z"
    r"|(?:std::)?(?:min|max|abs|move|forward|exchange|swap|size|empty|begin|end|cbegin|cend"
    r"|isfinite|isnan|isinf|floor|ceil|round|sqrt|fabs)\Z"
    r"|(?:static|const|reinterpret)_cast\Z|narrow\Z|unused\Z"
    r"|(?:bool|char|int|float|double|(?:std::)?u?int(?:8|16|32|64)_t)\Z"
    r"|(?:ROS|RCLCPP)_(?:DEBUG|INFO|WARN|ERROR|FATAL)\w*\Z|get_logger\Z|get_clock\Z|c_str\Z"
)


def ending_the_node(code: Code) -> Iterator[Finding]:
    """The calls in functions and lambdas that are `noexcept` out of which an exception may come."""
    found = _Throwing(code)
    for function in found.functions:
        cpp = function.cpp
        body = function.body
        if body is None or not _MAY_SAY.search(cpp.source.text):
            continue
        lambdas = [n for n in inside(body, "lambda_expression") if is_noexcept(n)]
        around = [body] if is_noexcept(function.node) else lambdas
        for node in (n for each in around for n in found.throwing(function, each)):
            within = ".".join(filter(None, (function.owner, function.name)))
            yield Finding(Grade.UNREADABLE, cpp.source, cpp.span(node), _WHY, "", within)


class _Throwing:
    """Which calls may throw, by the functions of the package that they may reach."""

    def __init__(self, code: Code) -> None:
        defined = [f for found in code.definitions.values() for f in found]
        inside_classes = (c for found in code.all_classes.values() for c in found)
        defined += [f for c in inside_classes for f in c.functions if f.body is not None]
        own = {f.node.id: f for f in defined if not is_runtime_header(f.cpp.source.path)}
        self.functions = tuple(own.values())
        self._code = code
        self._named: dict[str, list[CppFunction]] = {}
        for function in self.functions:
            self._named.setdefault(function.name, []).append(function)

    def throwing(self, function: CppFunction, body: Node) -> Iterator[Node]:
        """The first places in a body that may throw, of each kind."""
        yield from inside(body, *_THROWING)
        for call in self._run_in(function, body):
            if self._may_throw(call, set()):
                yield call.node

    def _run_in(self, function: CppFunction, body: Node) -> Iterator[CppCall]:
        """The calls in a body, but for those in what is posted, which the mailbox runs later."""
        calls = self._code.calls_in(function.cpp, body)
        later = [
            range(a.start_byte, a.end_byte)
            for call in calls
            if call.name == "post" and call.on == "mailbox_"
            for a in call.arguments
            if a.type == "lambda_expression"
        ]
        yield from (c for c in calls if not any(c.node.start_byte in place for place in later))

    def _may_throw(self, call: CppCall, asked: set[str]) -> bool:
        reached = self._named.get(call.name, ()) if call.on in ("", "this") else ()
        if call.on == "mailbox_":
            return call.name == "delay"
        if not reached:
            is_constant = all(a.type == "number_literal" for a in call.arguments)
            return _QUIET.match(call.name) is None and not (call.name == "at" and is_constant)
        if call.name in asked:
            return False  # those that call each other throw what the others do
        asked.add(call.name)
        return any(self._throws(function, asked) for function in reached)

    def _throws(self, function: CppFunction, asked: set[str]) -> bool:
        if is_noexcept(function.node):
            return False  # what is in it is listed itself
        body = function.body
        assert body is not None
        if inside(body, *_THROWING):
            return True
        return any(self._may_throw(call, asked) for call in self._run_in(function, body))
