"""Decorators of generated Python that only log: a function does the same with them as without."""

from __future__ import annotations

from dataclasses import replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.python.model_logs import Looks, looks_in, only_logs
from rebsync.reverse.python.model_types import expression_in, stored_into
from rebsync.reverse.python.module_variables import hidden_names, imported_as, is_clock, loggers_of
from rebsync.reverse.python.plain_functions import function_named
from rebsync.reverse.python.py_callbacks import body_of
from rebsync.reverse.python.told_locals import told_locals
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_tree import field, named, parse, text_of
from rebsync.source import Source

_PLAIN = frozenset({"string", "integer", "float", "true", "false", "none"})
_WRAPS = ("wraps", "functools.wraps")


def is_transparent(code: PyCode, module: Scope, decorator: str) -> bool:
    """Whether a decorator only logs, and calls the function with all that it is given.

    It may be made by a function of literals: `@timed("way")`.
    """
    name, _, given = decorator.partition("(")
    made = function_named(code, module, name) if name.isidentifier() else None
    if made is None or made.decorators:
        return False
    if not given:
        return _only_tells(code, module, made)
    call = named(parse(Source("", decorator)).root)[0]
    arguments = named(field(named(call)[0], "arguments"))
    inner = _given_back(code, made)
    values = [n.child_by_field_name("value") or n for n in arguments]
    return (
        inner is not None
        and len(arguments) == len(made.parameters)
        and all(v.type in _PLAIN for v in values)
        and not inner.decorators
        and _only_tells(code, module, inner)
    )


def _only_tells(code: PyCode, module: Scope, made: Scope) -> bool:
    """Whether what a decorator puts in place of a function does that function, and tells of it."""
    function = _given_back(code, made) if len(made.parameters) == 1 else None
    if function is None:
        return False
    name = made.parameters[0].name
    stars = [p.star for p in function.parameters]
    passed = [f"{'*' * p.star}{p.name}" for p in function.parameters]
    known = {f"{n}({name})" for n in _WRAPS if _whole(made.module, n) == "functools.wraps"}
    is_same = known.issuperset(function.decorators)
    call = f"{name}({', '.join(passed)})"
    if not is_same or stars not in ([1, 2], [1], [0, 1, 2], [0, 1], [0]):
        return False
    looks = _looks(code, module, made.module)
    told = told_locals(function, frozenset(), looks)
    return _Around(function, call, looks, told).gives(body_of(function))


def _whole(module: Scope, name: str) -> str:
    """What a name with dots is by the imports of a module."""
    head, _, rest = name.partition(".")
    return ".".join(filter(None, (imported_as(module, head), rest)))


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


def _looks(code: PyCode, user: Scope, module: Scope) -> Looks:
    """What names stand for in the module of a decorator, which a class of another module uses."""
    hidden = hidden_names(code, module)
    return replace(
        looks_in(code, [*{id(m): m for m in (module, user)}.values()], frozenset()),
        loggers=loggers_of(module) - hidden,
        clocks=frozenset(n for n in module.names if is_clock(module, n)) - hidden,
    )


@dataclass(frozen=True, slots=True)
class _Around:
    """The function that a decorator gives, and the call of the one that it is of."""

    function: Scope
    call: str
    looks: Looks
    told: frozenset[str]

    def gives(self, body: list[Node]) -> bool:
        """Whether statements do the call once, give what it gives, and else only tell people."""
        left = [s for s in body if not self._tells(s)]
        match [text_of(s) for s in left]:
            case [one] if left[0].type == "try_statement":
                return bool(one) and self._tries(left[0])
            case [one]:
                return one == f"return {self.call}"
            case [one, last]:
                result = stored_into(expression_in(left[0]))
                bound = self.function.names.get(result, ())
                is_kept = one == f"{result} = {self.call}" and last == f"return {result}"
                return is_kept and len(bound) == 1
            case _:
                return False

    def _tries(self, statement: Node) -> bool:
        """`try: return f(x)` with a `finally` that only tells people."""
        parts = [c for c in named(statement) if c.type.endswith("_clause")]
        ends = [c for c in parts if c.type == "finally_clause"]
        inside = [s for end in ends for block in named(end) for s in named(block)]
        body = [s for s in named(field(statement, "body")) if s.type != "comment"]
        return len(ends) == len(parts) == 1 and all(map(self._tells, inside)) and self.gives(body)

    def _tells(self, node: Node) -> bool:
        if node.type in ("comment", "pass_statement") or only_logs(node, self.looks):
            return True
        inner = expression_in(node)
        value = inner.child_by_field_name("right") if inner is not None else None
        return value is not None and stored_into(inner) in self.told and self.looks.is_pure(value)
