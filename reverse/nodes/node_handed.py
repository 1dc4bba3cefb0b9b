"""Messages that a node may change after it has published them by a pointer, listed.

Inside a process callbacks get what the pointer leads to, later, and not a copy of it
(http://wiki.ros.org/roscpp/Overview/Publishers%20and%20Subscribers#Intraprocess_Publishing).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_messages import is_pointer
from rebsync.reverse.bodies.effects.cpp_pointees import is_only_read, leads_to, made_in
from rebsync.reverse.graph import PublisherFact
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.nodes.node_bodies import Bodies
from rebsync.reverse.nodes.node_joined import OBSERVER
from rebsync.reverse.syntax.ancestors import ancestors, holds
from rebsync.reverse.syntax.cpp_calls import CppCall, calls_in
from rebsync.reverse.syntax.cpp_index import CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, named, part, text_of

_CHANGED = "this message is published by a pointer, and may be changed before callbacks get it"
_DEEPEST = 4
_LOOPS = ("while_statement", "do_statement", "for_statement", "for_range_loop")


def note_handed(bodies: Bodies) -> None:
    """Lists where a node publishes by a pointer what it may change afterwards.

    Only what nodes of the package receive counts: others get a copy.
    """
    unit = bodies.unit
    functions = [*unit.functions, *([unit.program.main] if unit.program is not None else [])]
    types = {t for fact in _received(bodies) if isinstance(t := fact.type, str)}
    fields = {p.partition(".")[0] for t in types for p in bodies.state.types.fields(t) or {}}
    pointers = set(_pointers(bodies))
    for function in functions if fields else ():
        for call in calls_in(function.body) if function.body is not None else ():
            handed = _Handed.of(call, function, functions, fields, pointers)
            if handed is not None and handed.may_change():
                bodies.unread(function.cpp, call.node, _CHANGED)


def _received(bodies: Bodies) -> Iterator[PublisherFact]:
    """The publishers of which nodes of the package get messages."""
    for number, fact in enumerate(bodies.unit.facts):
        targets = bodies.targets.get(number, ())
        if isinstance(fact, PublisherFact) and any(t.known != OBSERVER for t in targets):
            yield fact


def _pointers(bodies: Bodies) -> Iterator[str]:
    """The variables of objects, and of files, that may be pointers."""
    owned = (f for c in bodies.unit.lineage for f in (*c.fields, *c.others))
    free = (f for each in bodies.code.variables.values() for f in each)
    for variable in (*owned, *free):
        text = text_of(variable.node)
        if is_pointer(text_of(variable.type)) or "*" in text or "_ptr" in text:
            yield variable.name


@dataclass(frozen=True, slots=True)
class _Handed:
    """A call that publishes the message of a variable, in the body of a function."""

    name: str
    call: Node
    body: Node
    function: CppFunction
    functions: Sequence[CppFunction]
    fields: Collection[str]
    pointers: Collection[str]

    @staticmethod
    def of(
        call: CppCall,
        function: CppFunction,
        functions: Sequence[CppFunction],
        fields: Collection[str],
        pointers: Collection[str],
    ) -> _Handed | None:
        """The variable that a call publishes; None for other calls."""
        plain = call.name.rpartition("::")[2]
        if plain not in libraries.named(Kind.PUBLISH) or len(call.arguments) != 1:
            return None
        name = _moved(text_of(call.arguments[0])).removeprefix("this->")
        if not name.isidentifier() or function.body is None:
            return None
        body = _lambda_with(call.node, name) or function.body
        return _Handed(name, call.node, body, function, functions, fields, pointers)

    def may_change(self, depth: int = 0) -> bool:
        """Whether something may store through a pointer to the message after it is published."""
        declared = [d for d in inside(self.body, "init_declarator") if self._declares(d)]
        is_own = len(declared) == 1 and "static" not in text_of(_around(declared[0])).split()
        if not self._is_pointer(declared):
            return False
        is_given = any(p.name == self.name for p in self.function.parameters)
        is_local = is_own or is_given or self.body.type == "lambda_expression"
        is_kept = any(map(self._keeps, inside(self.body, "assignment_expression")))
        for function in self.functions if is_kept or not is_local else ():
            is_other = function.body is not None and not (is_local and function is self.function)
            if is_other and self._stores(function, function.body or self.body, []):
                return True
        if any(self._is_named_late(n) for n in inside(self.body, "init_declarator")):
            return True
        is_called = is_given and self.body.type != "lambda_expression"
        if is_called and any(depth > _DEEPEST or c.may_change(depth + 1) for c in self._callers()):
            return True
        late = [n for n in ancestors(self.call, self._is_body) if n.type in _LOOPS]
        late = [n for n in late if not any(holds(n, d) for d in declared)]
        late += [n for n in inside(self.body, "lambda_expression") if not holds(n, self.call)]
        return self._stores(self.function, self.body, late, self.call.end_byte)

    def _callers(self) -> Iterator[_Handed]:
        """The calls that give the function the pointer, which is a parameter of it."""
        names = [p.name for p in self.function.parameters]
        place = names.index(self.name)
        for function in self.functions:
            for call in calls_in(function.body) if function.body is not None else ():
                called = call.name.rpartition("::")[2]
                if called != self.function.name or len(call.arguments) <= place:
                    continue
                name = _moved(text_of(call.arguments[place])).removeprefix("this->")
                if name.isidentifier() and function.body is not None:
                    body = _lambda_with(call.node, name) or function.body
                    yield replace(self, name=name, call=call.node, body=body, function=function)

    def _stores(
        self, function: CppFunction, body: Node, late: Sequence[Node], since: int = -1
    ) -> bool:
        """Whether a body may change the message behind a place of it, or in some loops."""
        others = made_in(body) - {self.name}
        for node in inside(body, "field_expression", "pointer_expression", "argument_list"):
            if node.start_byte < since and not any(holds(n, node) for n in late):
                continue
            if node.type == "argument_list":
                if self._is_given(node):
                    return True
            elif (
                leads_to(node, self.fields)
                and text_of(part(node, "argument")) not in others
                and not is_only_read(node, function, self.functions)
            ):
                return True
        return False

    def _is_given(self, arguments: Node) -> bool:
        """Whether a function that does more than to publish it gets the pointer."""
        above = arguments.parent
        if not any(text_of(n).removeprefix("this->") == self.name for n in named(arguments)):
            return False
        if above is None or above.type != "call_expression":
            return True
        called = text_of(part(above, "function"))
        name = called.rpartition("::")[2].rpartition(".")[2].rpartition("->")[2]
        return name not in libraries.named(Kind.PUBLISH) and not called.startswith(
            libraries.logging()
        )

    def _is_pointer(self, declared: Sequence[Node]) -> bool:
        """Whether it is a pointer: a message itself is published as a copy."""
        given = [p for p in self.function.parameters if p.name == self.name]
        words = ("*", "Ptr", "_ptr", "make_shared", "make_unique", "new ")
        declarator = self.body.child_by_field_name("declarator")
        if self.body.type == "lambda_expression" and declarator is not None:
            return any(word in text_of(declarator) for word in words)
        if declared or given:
            texts = [text_of(_around(d)) for d in declared] + [text_of(p.node) for p in given]
            return any(word in text for word in words for text in texts)
        return self.name in self.pointers or f"{self.name}->" in text_of(self.body).replace(" ", "")

    def _keeps(self, node: Node) -> bool:
        """Whether another variable gets the pointer."""
        return text_of(part(node, "right")).removeprefix("this->") == self.name

    def _is_named_late(self, declared: Node) -> bool:
        """Whether another name for the message stands behind the call: `auto& r = *m;`."""
        declarator, value = part(declared, "declarator"), part(declared, "value")
        text = text_of(value).removeprefix("this->")
        is_place = declarator.type in ("reference_declarator", "pointer_declarator")
        if not self._names(value, self.name) or not (is_place or text == self.name):
            return False
        alias = text_of(declarator).strip("*& ")
        names = inside(self.body, "identifier")
        return any(text_of(n) == alias and n.start_byte >= self.call.end_byte for n in names)

    def _names(self, node: Node, name: str) -> bool:
        return any(text_of(n) == name for n in inside(node, "identifier"))

    def _declares(self, node: Node) -> bool:
        return text_of(part(node, "declarator")).strip("*& ") == self.name

    def _is_body(self, node: Node) -> bool:
        return node.id == self.body.id


def _lambda_with(node: Node, name: str) -> Node | None:
    """The function without a name around a node that has a parameter of some name."""
    for above in ancestors(node, lambda n: n.type == "function_definition"):
        declarator = above.child_by_field_name("declarator")
        names = [text_of(n) for n in inside(declarator, "identifier")]
        if above.type == "lambda_expression" and name in names:
            return above
    return None


def _moved(text: str) -> str:
    """What is handed over by `std::move`."""
    return text.removeprefix("std::move(").removesuffix(")") if "move(" in text else text


def _around(node: Node) -> Node:
    return node.parent if node.parent is not None else node
