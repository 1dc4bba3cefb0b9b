"""What the form of some files has at a place of their trees: calls, types, what was not read."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from tree_sitter import Node

from rebsync.reverse.analysis.unread_code import UnreadCode
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.classes import implicit_constructor
from rebsync.reverse.ir.cpp.functions import lambda_names
from rebsync.reverse.ir.cpp.lowering import CppLowering
from rebsync.reverse.ir.cpp.symbols import ClassSymbol, FunctionSymbol, VariableSymbol
from rebsync.reverse.ir.program import Program
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.effects import of_function
from rebsync.reverse.libraries.routines import Effect, Language
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of
from rebsync.source import Span

_FUNCTIONS = frozenset({"function_definition", "lambda_expression"})
_LOOKING = frozenset({Effect.NONE, Effect.CLOCK})

_AROUND = ("unary_expression", "parenthesized_expression", "condition_clause")
_DECLARING = ("init_declarator", "declaration", "field_declaration")


class FormPlaces:
    """Finds functions of the form, and what they do, by nodes of the trees."""

    def __init__(self, lowering: CppLowering, program: Program, unread: UnreadCode) -> None:
        self._symbols = lowering.world.symbols
        self._program = program
        self._unread = unread
        self._files = frozenset(map(id, self._symbols.code.files))

    # --- functions --------------------------------------------------------------------------------

    @cached_property
    def functions(self) -> dict[int, FunctionSymbol]:
        """The functions that have a body, by their nodes."""
        every = self._symbols.functions.values()
        return {f.code.node.id: f for f in every if f.code.body is not None}

    def owner(self, function: FunctionSymbol) -> ClassSymbol | None:
        """The class of a function."""
        return self._symbols.classes.get(function.owner or "")

    def symbol_around(self, node: Node) -> FunctionSymbol | None:
        """The function with a name that a node stands in."""
        found = (self.functions.get(n.id) for n in ancestors(node))
        return next((f for f in found if f is not None), None)

    def around(self, node: Node) -> str | None:
        """The name of the function or lambda that a node stands in; None if it is in none."""
        around = [n for n in ancestors(node) if n.type in _FUNCTIONS]
        symbol = self.symbol_around(node)
        if symbol is None:
            return None
        if around[0].type == "function_definition":
            return symbol.name
        return lambda_names(symbol, self.owner(symbol)).get(around[0].id)

    def _running(self, cpp: Cpp, node: Node) -> Iterator[str]:
        """The functions and lambdas that a node is a piece of, or that have it as a value."""
        if id(cpp) not in self._files:  # the text of a macro, which is looked at where it is used
            return
        around = self.symbol_around(node)
        if around is not None:
            yield from (around.name, *lambda_names(around, self.owner(around)).values())
            return
        owner_nodes = {n.id for n in ancestors(node)}
        owners = [c for c in self._symbols.classes.values() if c.node.id in owner_nodes]
        for owner in owners:
            for name in (implicit_constructor(owner), *(f.name for f in owner.constructors)):
                if name in self._program:
                    yield name
        if not owners and cpp.source.path in self._program:
            yield cpp.source.path

    # --- what stands at a place -------------------------------------------------------------------

    def unread(self, cpp: Cpp, node: Node, elsewhere: str | None = "") -> str | None:
        """What in a piece of code may run what no file has, and why.

        What a function of the name `elsewhere` does is looked at elsewhere; None is any.
        """
        whole = _whole(node)
        span = cpp.span(whole)
        for name in self._running(cpp, node):
            for found in self._unread.of(name):
                if not _is_in(found.place, span) or self._is_of(found.called, elsewhere):
                    continue
                text = cpp.source.text[found.place.start : found.place.end]
                what = _called(text if text[:1] != "(" else text_of(whole))
                return f'what "{what}" does is not known: {found.why}'
        return None

    def _is_of(self, called: str, name: str | None) -> bool:
        """Whether a function that is called has a name."""
        symbol = self._symbols.functions.get(called)
        simple = symbol.simple if symbol is not None else called
        return bool(called) and (name is None or name == simple)

    def unwritten(self, cpp: Cpp, node: Node) -> list[CppFunction]:
        """The functions that run in a piece of code though no call of them stands there."""
        span, text = cpp.span(_whole(node)), text_of(node)
        found = dict[str, CppFunction]()
        for name in self._running(cpp, node):
            for each in walk(self._program.function(name)):
                if _is_in(getattr(each, "place", Span(-1, -1)), span):
                    for run in self._run_by(each):
                        symbol = self._symbols.functions.get(run)
                        if symbol is not None and not _is_named(symbol, text):
                            found[run] = symbol.code
        return list(found.values())

    def _run_by(self, node: object) -> Iterator[str]:
        """The functions that a statement runs; of a constructor what is outside of its body."""
        match node:
            case s.Call() | s.Destroy():
                yield from self._unread.run(node)
            case s.Construct(_, _, _, str() as name) if name in self._program:
                symbol = self._symbols.functions.get(name)
                body = symbol.code.body if symbol is not None else None
                span = symbol.code.cpp.span(body) if symbol is not None and body else Span(-1, -1)
                for made in walk(self._program.function(name)):
                    if isinstance(made, s.Call | s.Construct) and not _is_in(made.place, span):
                        yield from self._run_by(made)
            case _:
                pass

    def called(self, cpp: Cpp, call: Node) -> list[CppFunction]:
        """The functions of the files that a call may be of."""
        found = (n for n in self._at(cpp, call) if isinstance(n, s.Call))
        names = {f for n in found for f in self._unread.functions(n.callee)}
        known = self._symbols.functions
        return [known[n].code for n in sorted(names) if n in known]

    def only_looks(self, cpp: Cpp, call: Node) -> bool:
        """Whether a call is of a function of a library that changes nothing, by its full name."""
        callees = [n.callee for n in self._at(cpp, call) if isinstance(n, s.Call)]
        return bool(callees) and all(
            isinstance(c, s.LibraryCallee) and of_function(Language.CPP, c.name).effect in _LOOKING
            for c in callees
        )

    def type_of(self, cpp: Cpp, node: Node) -> t.Type:
        """The type of an expression."""
        kinds = (e.Local, e.Captured, e.Global, e.Attribute, e.Index, e.Dereference)
        found = (n.type for n in self._at(cpp, node) if isinstance(n, kinds))
        return next(found, t.UNKNOWN)

    def variable(self, cpp: Cpp, node: Node) -> VariableSymbol | None:
        """The variable outside of functions that an expression names."""
        names = (n.name for n in self._at(cpp, node) if isinstance(n, e.Global))
        found = (v for name in names for v in self._symbols.variables.get(name, ()))
        return next(found, None)

    def operates(self, cpp: Cpp, node: Node) -> bool:
        """Whether an operator may be a function of the program, of an enumeration ([over.oper])."""
        operator = node.child_by_field_name("operator") or next(iter(node.children), node)
        if f"operator{text_of(operator)}" not in self._unread.objects.enum_operators:
            return False
        for each in self._at(cpp, node):
            match each:
                case s.Call(_, s.FunctionCallee(name) | s.LibraryCallee(name)):
                    if self._unread.objects.may_take_enum(name):
                        return True
                case e.Binary(_, left, right):
                    if not (_is_known(left) and _is_known(right)):
                        return True
                case e.Unary(_, of) if not _is_known(of):
                    return True
                case _:
                    pass
        return False

    @property
    def may_convert(self) -> bool:
        """Whether some object may be converted, or made, by what was not read."""
        owners = (n.partition("(")[0].rpartition("::")[0] for n in self._program.undefined)
        return not self._program.classes.keys().isdisjoint(owners)

    def _at(self, cpp: Cpp, node: Node) -> Iterator[object]:
        span = cpp.span(node)
        for name in self._running(cpp, node):
            for each in walk(self._program.function(name)):
                place = getattr(each, "place", None)
                if place is not None and (place.start, place.end) == (span.start, span.end):
                    yield each


def _is_known(value: e.Expression) -> bool:
    """Whether the type of an operand is known, or it is a part of a message: no enumeration."""
    is_of_message = any(isinstance(getattr(n, "type", None), t.RosMessage) for n in walk(value))
    return is_of_message or getattr(value, "type", t.UNKNOWN) != t.UNKNOWN


def _whole(node: Node) -> Node:
    """The declaration of a declarator, and what converts a value: the form has them as a whole."""
    while node.parent is not None and node.parent.type in _AROUND:
        node = node.parent
    while node.parent is not None and node.parent.type in _DECLARING:
        if any(node.parent.child_by_field_name(f) == node for f in ("value", "default_value")):
            return node
        node = node.parent
    return node


def _is_named(function: FunctionSymbol, text: str) -> bool:
    """Whether a call of a function may be written in a text, so that it is looked at there."""
    is_made = function.simple == (function.owner or "").rpartition("::")[2]
    return not is_made and function.simple in text


def _is_in(place: Span, span: Span) -> bool:
    return span.start <= place.start and place.end <= span.end


def _called(text: str) -> str:
    """What a call is of: its text without the arguments."""
    text, depth = " ".join(text.split()).rstrip("; "), 0
    for at in range(len(text) - 1, -1, -1) if text.endswith(")") else ():
        depth += {")": 1, "(": -1}.get(text[at], 0)
        if depth == 0:
            return text[:at] or text
    return text
