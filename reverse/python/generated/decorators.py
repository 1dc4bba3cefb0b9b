"""What is around functions and statements of generated Python, and only logs: decorators, contexts.

These do the same with it as without.
"""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.python.generated.helpers import plain_function
from rebsync.reverse.python.generated.module_variables import (
    hidden_names,
    imported_as,
    looks_of,
)
from rebsync.reverse.python.generated.named_constants import CodeConstants
from rebsync.reverse.python.generated.pair_methods import is_context
from rebsync.reverse.python.generated.py_types import expression_in, is_text, stored_into
from rebsync.reverse.python.generated.slicing.logs import Looks, only_logs
from rebsync.reverse.python.generated.slicing.silent import Silent
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.python.values.py_worth import Class, Function
from rebsync.reverse.syntax.py_index import PyCode, PyParameter, Scope
from rebsync.reverse.syntax.py_tree import field, named, parse, text_of
from rebsync.source import Source

_PLAIN = frozenset({"string", "integer", "float", "true", "false", "none"})
_CONTEXT = frozenset({"__init__", "__enter__", "__exit__"})
_PASSING = frozenset({"none", "false"})
_WRAPS = ("wraps", "functools.wraps")


def is_transparent(
    constants: CodeConstants, function: Scope, decorator: str, silent: Silent
) -> bool:
    """Whether a decorator only logs, and calls the function with all that it is given.

    It may be made by a function of literals: `@timed("way")`.
    """
    module, has_result = function.module, any(named(r) for r in function.returns)
    name, _, given = decorator.partition("(")
    code, made = constants.code, plain_function(constants.of(module, name))
    if made is None:
        return False
    if not given:
        return _only_tells(code, module, made, silent, has_result)
    call = named(parse(Source("", decorator)).root)[0]
    arguments = named(field(named(call)[0], "arguments"))
    inner = _given_back(code, made)
    values = [n.child_by_field_name("value") or n for n in arguments]
    return (
        inner is not None
        and len(arguments) == len(made.parameters)
        and all(v.type in _PLAIN for v in values)
        and not inner.decorators
        and _only_tells(code, module, inner, silent, has_result)
    )


def context_of(
    constants: CodeConstants, module: Scope, statement: Node, silent: Silent
) -> Node | None:
    """What is done within `with timed("question"):`, if the context only tells people of it."""
    head = next((c for c in named(statement) if c.type == "with_clause"), statement)
    items = [i for i in named(head) if i.type == "with_item"]
    call = field(items[0], "value") if len(items) == 1 else statement
    name = text_of(field(call, "function")) if call.type == "call" else ""
    code = constants.code
    is_own, methods = name.startswith("self."), code.methods.get(name[5:], [])
    made = methods[0] if is_own and len(methods) == 1 else None
    match constants.of(module, name):
        case Function(found) if not is_own:
            made = found
        case Class(owner) if not is_own and _is_told_class(code, owner, call, silent):
            return field(statement, "body")
        case _:
            pass
    if made is None or not is_context(made.module, made):
        return None
    is_known = _is_given(call, made.parameters[is_own:])
    is_telling = is_known and _tells_around(code, module, made, silent)
    return field(statement, "body") if is_telling else None


def _is_given(call: Node, parameters: Sequence[PyParameter]) -> bool:
    """Whether a call gives literals alone, as many as are taken."""
    given = named(field(call, "arguments"))
    needed = [p for p in parameters if p.default is None]
    values = [n.child_by_field_name("value") or n for n in given]
    is_whole = len(needed) <= len(given) <= len(parameters)
    is_whole = is_whole and all(p.star == 0 for p in parameters)
    return is_whole and all(v.type in _PLAIN for v in values)


def _is_told_class(code: PyCode, owner: Scope, call: Node, silent: Silent) -> bool:
    """Whether contexts of a class only tell people of what is within, and let exceptions pass."""
    effects, body = silent.effects, named(field(owner.node, "body"))
    written = [n for n in body if n.type == "function_definition"]
    rest = [n for n in body if n not in written and n.type != "comment" and not is_text(n)]
    methods = {f.name: f for f in (code.scope_of(n, owner.py) for n in written)}
    if rest or len(methods) < len(written) or methods.keys() | {"__init__"} != _CONTEXT:
        return False
    begins, ends = methods["__enter__"], methods["__exit__"]
    taken = [[p.star for p in f.parameters[1:]] for f in (begins, ends)]
    is_kept = all(n.type in _PASSING for r in ends.returns for n in named(r))
    is_called = taken in ([[], [0, 0, 0]], [[], [1]]) and not owner.decorators
    made = methods["__init__"].parameters[1:] if "__init__" in methods else ()
    return (
        (is_kept and is_called and _is_given(call, made) and effects is not None)
        and effects.tells_around(owner.py, owner.py.span(ends.node))
        and not any(silent.exceptions.raises(n) for f in methods.values() for n in body_of(f))
    )


def _tells_around(code: PyCode, module: Scope, made: Scope, silent: Silent) -> bool:
    """Whether a context manager does nothing but to tell people, before and behind its block."""
    hidden = hidden_names(code, made.module)
    looks = looks_of(code, (made.module, module), frozenset(), hidden)
    told = _own_locals(made)
    around = _Around(made, "yield", looks, told, silent)
    return around.yields(body_of(made))


def _only_tells(code: PyCode, module: Scope, made: Scope, silent: Silent, has_result: bool) -> bool:
    """Whether what a decorator puts in place of a function does that function, and tells of it."""
    function = _given_back(code, made) if len(made.parameters) == 1 else None
    if function is None:
        return False
    name = made.parameters[0].name
    stars = [p.star for p in function.parameters]
    passed = [f"{'*' * p.star}{p.name}" for p in function.parameters]
    known = {f"{n}({name})" for n in _WRAPS if imported_as(made.module, n) == "functools.wraps"}
    is_same = known.issuperset(function.decorators)
    call = f"{name}({', '.join(passed)})"
    if not is_same or stars not in ([1, 2], [1], [0, 1, 2], [0, 1], [0]):
        return False
    hidden = hidden_names(code, made.module)
    looks = looks_of(code, (made.module, module), frozenset(), hidden)
    told = _own_locals(function)
    around = _Around(function, call, looks, told, silent, has_result)
    return around.gives(body_of(function))


def _own_locals(function: Scope) -> frozenset[str]:
    """The locals of a function that it was not given."""
    given = {p.name for p in function.parameters} | function.outer
    return frozenset(function.names).difference(given)


def is_cast(module: Scope, called: str) -> bool:
    """Whether a function only tells who checks types what a value is: `cast(int, x)`."""
    return imported_as(module, called) == "typing.cast"


def _given_back(code: PyCode, made: Scope) -> Scope | None:
    """The function that a function defines and gives back, if it does nothing else."""
    inner = [s for s in body_of(made) if s.type in ("function_definition", "decorated_definition")]
    rest = [text_of(s) for s in body_of(made) if s not in inner]
    if len(inner) != 1:
        return None
    of = inner[0].child_by_field_name("definition") or inner[0]
    function = code.scope_of(of, made.py)
    is_plain = not any(c.type == "async" for c in of.children)
    return function if rest == [f"return {function.name}"] and is_plain else None


@dataclass(frozen=True, slots=True)
class _Around:
    """The function that a decorator gives, and the call of the one that it is of.

    One that has no result need not be given back.
    """

    function: Scope
    call: str
    looks: Looks
    told: frozenset[str]
    silent: Silent
    has_result: bool = True

    def gives(self, body: list[Node]) -> bool:
        """Whether statements do the call once, give what it gives, and else only tell people."""
        left = [s for s in body if not self._tells(s)]
        match [text_of(s) for s in left]:
            case [one] if left[0].type == "try_statement":
                return bool(one) and self._tries(left[0])
            case [one]:
                return one == f"return {self.call}" or (one == self.call and not self.has_result)
            case [one, last]:
                result = stored_into(expression_in(left[0]))
                bound = self.function.names.get(result, ())
                is_kept = one == f"{result} = {self.call}" and last == f"return {result}"
                return is_kept and len(bound) == 1
            case _:
                return False

    def yields(self, body: list[Node]) -> bool:
        """Whether statements wait once for what is within, and else only tell people."""
        left = [s for s in body if not self._tells(s)]
        if len(left) != 1:
            return False
        if left[0].type == "try_statement":
            return self._tries(left[0])
        return text_of(left[0]) == self.call == "yield"

    def _tries(self, statement: Node) -> bool:
        """`try: return f(x)` with a `finally` that only tells people."""
        parts = [c for c in named(statement) if c.type.endswith("_clause")]
        ends = [c for c in parts if c.type == "finally_clause"]
        inside = [s for end in ends for block in named(end) for s in named(block)]
        body = [s for s in named(field(statement, "body")) if s.type != "comment"]
        does = self.yields if self.call == "yield" else self.gives
        return len(ends) == len(parts) == 1 and all(map(self._tells, inside)) and does(body)

    def _tells(self, node: Node) -> bool:
        if node.type in ("comment", "pass_statement"):
            return True
        if self.silent.exceptions.raises(node):
            return False
        if self.function.is_method:
            return self.silent.tells(node)
        if only_logs(node, self.looks):
            return True
        effects, py = self.silent.effects, self.function.py
        is_context = self.call == "yield"  # others are given what the model has, and may change it
        if is_context and effects is not None and effects.computes(py, py.span(node)):
            return True
        inner = expression_in(node)
        value = inner.child_by_field_name("right") if inner is not None else None
        return value is not None and stored_into(inner) in self.told and self.looks.is_pure(value)
