"""Programs that never serve the messages of a node that they make, listed.

A node that no executor spins, or that ends before its program spins, serves nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.graph import ServiceFact, SubscriptionFact, TimerFact
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.nodes.kept_objects import is_local_group
from rebsync.reverse.nodes.node_bodies import Bodies
from rebsync.reverse.nodes.node_loops import later, loops_in
from rebsync.reverse.nodes.node_reach import all_functions
from rebsync.reverse.nodes.node_units import Start
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_calls import CppCall, calls_in
from rebsync.reverse.syntax.cpp_enclosing import in_lambda
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, text_of

_NEVER = "this program never lets messages be served: the model serves them"
_OTHER = "this program lets only the messages of other nodes be served"
_ENDS = "the executor of the node may be ended here"
_REMOVED = "the node may be taken out of its executor here"
_NO_OWNER = "no member is known to keep this group: it ends, and what it has is never called"
_GROUP = "no executor is known to get this group: what it has may never be called"
_ENDED = "the node ends here, before its program lets messages be served"
_NAMES = ("identifier", "field_identifier", "type_identifier")
_EXITS = frozenset({"exit", "_exit", "_Exit", "quick_exit", "abort", "terminate"})
_INPUT = frozenset({"cin", "getchar", "getline", "scanf", "fgets"})  # may wait for somebody
_LOOPS = frozenset({"while_statement", "do_statement", "for_statement", "for_range_loop"})
_DECLARING = ("declaration", "field_declaration", "parameter_declaration")
_SCOPES = frozenset({"std", "boost"})
_POINTER = ("make_shared", "make_unique", "shared_ptr", "unique_ptr", "Ptr", "new ")
_SERVED = (SubscriptionFact, TimerFact, ServiceFact)
Serving: TypeAlias = "tuple[CppFunction, Node]"


def note_spinning(bodies: Bodies, start: Start | None) -> None:
    """Lists what keeps the program of a rebec from serving the rebec's messages."""
    main = start.program.main if start is not None and start.program is not None else None
    serves = any(isinstance(f, _SERVED) for f in bodies.unit.facts)
    if start is None or main is None or main.body is None or not serves:
        return
    program = _Spun(bodies.code, main, main.body, start.made.variable if start.made else "")
    if (ended := program.cancelled()) is not None:
        bodies.unread(*ended, _ENDS)
    elif (found := _unserved(program, start)) is not None:
        bodies.unread(main.cpp, *found)


def endings_before_serving(code: Code, start: Start) -> Iterator[Node]:
    """Where the `main` of a rebec may end, or pass by, before messages are served.

    The model serves them whatever the arguments and the input of the program are.
    """
    main = start.program.main if start.program is not None else None
    if main is None or main.body is None:
        return
    program = _Spun(code, main, main.body, start.made.variable if start.made else "")
    serving = [node for function, node in program.serving() if function is main]
    if not serving:
        return
    first = min(node.start_byte for node in serving)
    leaving = inside(main.body, "return_statement", "throw_statement", "goto_statement")
    leaving += [c.node for c in calls_in(main.body) if c.name.removeprefix("std::") in _EXITS]
    leaving += [n for n in inside(main.body, "identifier") if text_of(n) in _INPUT]
    for node in leaving:
        if node.start_byte < first and not in_lambda(node):
            yield node
    around = [{n.id: n for n in ancestors(s, lambda n: n == main.body)} for s in serving]
    for id_, node in around[0].items():
        if node.type == "if_statement" and all(id_ in each for each in around):
            yield node


def _unserved(program: _Spun, start: Start) -> tuple[Node, str] | None:
    """The place in `main` that keeps a node from being served, and why."""
    if (removed := program.taken_out()) is not None:
        return removed
    serving = list(program.serving())
    if not any(map(program.counts, serving)):
        return None if program.is_handed_on() else (program.body, _NEVER)
    made = start.made.statement if start.made is not None else None
    if start.made is None or made is None:
        return None
    own = [node for function, node in serving if function is program.main]
    if len(own) == len(serving) and (shut := program.shut_down(own)) is not None:
        return shut, _ENDED
    if len(own) == len(serving) and (ended := program.ended(made, own)) is not None:
        return ended, _ENDED
    if not any(c.roots for c in start.unit.lineage):
        return None  # it is served by a node that it gets
    if (first := program.spins_first(start.made.owner)) is not None:
        return first, _OTHER
    return (program.body, _OTHER) if program.spins_others(start.made.owner) else None


@dataclass(frozen=True, slots=True)
class _Spun:
    """A `main` with the name that it has for a node."""

    code: Code
    main: CppFunction
    body: Node
    variable: str

    def serving(self) -> Iterator[Serving]:
        """Where `main`, or what it leads to by the names in it, names what serves messages."""
        by_name: dict[str, list[CppFunction]] = {}
        for function in all_functions(self.code):
            by_name.setdefault(function.name, []).append(function)
        words = libraries.named(Kind.SPIN, Kind.SERVE)
        by_name.pop("main", None)  # those of other programs, too
        seen, waiting = {self.main.node.id}, [self.main]
        while waiting:
            function = waiting.pop()
            for node in inside(function.node, *_NAMES):
                name = text_of(node)
                if (name in words or "spin" in name.lower()) and not (
                    name in by_name and self._is_own(node)
                ):
                    yield function, node
                for each in by_name.get(name, ()):
                    if each.node.id not in seen:
                        seen.add(each.node.id)
                        waiting.append(each)

    def _is_own(self, node: Node) -> bool:
        """Whether a name is that of a function of the code, not of a library."""
        above = node.parent
        if above is None or above.type == "qualified_identifier":
            return False
        target = above.child_by_field_name("argument")
        return target is None or text_of(target) in ("this", self.variable)

    def counts(self, serving: Serving) -> bool:
        """Whether it may serve again and again: not behind a loop without end, or only once."""
        function, node = serving
        if function is not self.main:
            return True
        around = [node, *ancestors(node, lambda n: n.id == self.body.id)]
        once = text_of(node) in libraries.named(Kind.SERVE)
        if once and not any(n.type in (*_LOOPS, "lambda_expression") for n in around):
            return False
        ids = {n.id for n in around}
        return not any(
            after.id in ids
            for loop in loops_in(self.main, ())
            if not loop.guard and not inside(loop.node, "break_statement", "return_statement")
            for after in later(loop.node)
        )

    def taken_out(self) -> tuple[Node, str] | None:
        """What takes the node out of an executor, or makes a group that is in none."""
        names = {"remove_node", "create_callback_group", "add_callback_group"}
        functions = (f for f in all_functions(self.code) if f.body is not None)
        within = [(c, f) for f in functions for c in self.code.calls_of(f) if c.name in names]
        calls = [call for call, _ in within]
        for call, function in within:
            is_made = call.name == "create_callback_group"
            if is_made and function.name != "main" and is_local_group(call.node, function.body):
                return call.node, _NO_OWNER
        if not any(c.name == "add_callback_group" for c in calls):
            for call in calls:
                apart = len(call.arguments) > 1 and text_of(call.arguments[1]) != "true"
                if call.name == "create_callback_group" and apart:
                    return call.node, _GROUP
        return next(((c.node, _REMOVED) for c in calls if c.name == "remove_node"), None)

    def cancelled(self) -> tuple[Cpp, Node] | None:
        """What ends an executor, but for timers and goals, which are cancelled too."""
        mains = {f.cpp.source.path for f in all_functions(self.code) if f.name == "main"}
        others = mains - {self.main.cpp.source.path}  # those of other programs
        files = [cpp for cpp in self.code.files if cpp.source.path not in others]
        ending = [cpp for cpp in files if b"cancel" in cpp.words]
        if not ending:
            return None
        declared = (d for cpp in files for d in inside(cpp.root, *_DECLARING))
        names = {text_of(n) for d in declared for n in _executors(d)}
        calls = ((cpp, call) for cpp in ending for call in calls_in(cpp.root))
        for cpp, call in calls:
            if call.name == "cancel" and call.on.removeprefix("this->") in names:
                return cpp, call.node
        return None

    def shut_down(self, serving: list[Node]) -> Node | None:
        """What shuts the client library down before all places that serve messages."""
        first = min(node.start_byte for node in serving)
        words = libraries.named(Kind.SHUTDOWN)
        for call in calls_in(self.body):
            if call.name.rpartition("::")[2] not in words or call.node.start_byte > first:
                continue
            around = [
                n
                for n in ancestors(call.node, lambda n: n.id == self.body.id)
                if n.id != self.body.id
            ]
            if not any(n.type == "lambda_expression" or _leaves(n, call.node) for n in around):
                return call.node
        return None

    def is_handed_on(self) -> bool:
        """Whether something that is not known may let messages be served."""
        known = {f.name for f in all_functions(self.code)} | libraries.waiting()
        return any(
            (call.on == self.variable or any(self._has(a) for a in call.arguments))
            if call.target is not None
            else not call.name.startswith(libraries.scopes())
            and call.name.partition("::")[0] not in _SCOPES
            for call in calls_in(self.body)
            if call.name.rpartition("::")[2] not in known | self.code.classes.keys()
            and not call.name.isupper()
        )

    def _has(self, node: Node) -> bool:
        return bool(self.variable) and any(
            text_of(n) == self.variable for n in inside(node, "identifier")
        )

    def ended(self, made: Node, serving: list[Node]) -> Node | None:
        """What ends the object before the last place that serves messages."""
        last = max(node.start_byte for node in serving)
        block = made.parent
        if block is not None and block.type == "compound_statement" and block.id != self.body.id:
            served = any(made.end_byte <= n.start_byte < block.end_byte for n in serving)
            if made.type == "declaration" and not served and not self._is_kept(made, block):
                return made
        if made.type == "expression_statement" and not self.variable:
            whole = named(made)[0]
            if whole.type == "call_expression" and "make_" in text_of(whole).partition("(")[0]:
                return made
            if whole.type == "compound_literal_expression":
                return made
        for node in inside(self.body, "delete_expression", "call_expression", _ASSIGNS):
            if made.end_byte <= node.start_byte < last and self._drops(node):
                return node
        return None

    def _is_kept(self, made: Node, block: Node) -> bool:
        """Whether others may keep what a pointer in a block points to."""
        if not any(word in text_of(made) for word in _POINTER):
            return False
        return sum(text_of(n) == self.variable for n in inside(block, "identifier")) > 1

    def _drops(self, node: Node) -> bool:
        """`delete n`, `n.reset()`, `n = nullptr`."""
        if not self.variable:
            return False
        if node.type == "delete_expression":
            return text_of(named(node)[-1]) == self.variable
        if node.type == "call_expression":
            function = node.child_by_field_name("function")
            return function is not None and text_of(function) == f"{self.variable}.reset"
        left = node.child_by_field_name("left")
        return left is not None and text_of(left) == self.variable

    # --- executors --------------------------------------------------------------------------------

    def spins_first(self, owner: str) -> Node | None:
        """What in `main` serves only another node before anything serves this one."""
        words = libraries.named(Kind.SPIN)
        if not self.variable or any(in_lambda(n) for n in self._spinning()):
            return None
        calls = list(calls_in(self.body))
        first = next((c for c in calls if c.name.rpartition("::")[2] in words), None)
        if first is None:
            return None
        added = [c for c in calls if c.name == "add_node" and c.on and c.on == first.on]
        served = [c.arguments[0] for c in (*added, first) if c.arguments]
        return first.node if served and not any(self._may_be(n, owner) for n in served) else None

    def _spinning(self) -> Iterator[Node]:
        return (n for n in inside(self.body, *_NAMES) if "spin" in text_of(n).lower())

    def spins_others(self, owner: str) -> bool:
        """Whether all that `main` spins, or adds to executors, is certainly not the node."""
        if not self.variable:
            return False
        calls = list(calls_in(self.body))
        words = libraries.named(Kind.SPIN, Kind.SERVE)
        if any(c.on == self.variable and c.name in words for c in calls):
            return False
        spun = [c for c in calls if _is_spinning(c) and c.arguments]
        if any(self._may_be(c.arguments[0], owner) for c in spun):
            return False
        handed = (c for c in calls if not _is_spinning(c))
        return not any(self._has(a) for c in handed for a in c.arguments) and not self._renamed()

    def _renamed(self) -> bool:
        """Whether the node gets another name, or a function without a name may spin it."""
        values = (
            value
            for node in inside(self.body, "init_declarator", _ASSIGNS)
            for field in ("value", "right")
            if (value := node.child_by_field_name(field)) is not None
        )
        return any(self._has(v) for v in values) or any(
            self._has(n) for n in inside(self.body, "lambda_expression", "for_range_loop")
        )

    def _may_be(self, node: Node, owner: str) -> bool:
        """Whether an argument may be the node: all but another object that `main` makes."""
        if node.type != "identifier":
            return True
        for declared in inside(self.body, "init_declarator"):
            name, value = (declared.child_by_field_name(f) for f in ("declarator", "value"))
            if name is not None and value is not None and text_of(name) == text_of(node):
                names = {text_of(n) for n in inside(value, "type_identifier", "identifier")}
                return "make_shared" not in names or owner in names or self.variable in names
        return True


_ASSIGNS = "assignment_expression"


def _leaves(block: Node, call: Node) -> bool:
    """Whether a block in which a call stands ends the function behind it."""
    behind = (n for n in named(block) if n.start_byte > call.start_byte)
    return block.type == "compound_statement" and any(
        n.type in ("return_statement", "throw_statement") for n in behind
    )


def _executors(declaration: Node) -> Iterator[Node]:
    """The names that a declaration gives to executors."""
    type_ = declaration.child_by_field_name("type")
    if type_ is not None and "xecutor" in text_of(type_):
        for declarator in declaration.children_by_field_name("declarator"):
            yield from inside(declarator, "identifier", "field_identifier")


def _is_spinning(call: CppCall) -> bool:
    name = call.name.rpartition("::")[2]
    return name == "add_node" or "spin" in name
