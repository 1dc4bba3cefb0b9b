"""The programs of a package, and the objects of node classes that each of them makes."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import field, replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.build.build_files import BuildFiles
from rebsync.reverse.build.cmake import build_of
from rebsync.reverse.calls.beside import used_names
from rebsync.reverse.graph import Graph, NodeFact
from rebsync.reverse.syntax.ancestors import ancestors, climb
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, text_of
from rebsync.source import Source

_LOOPS = frozenset({"for_statement", "while_statement", "do_statement", "for_range_loop"})


@dataclass(frozen=True, slots=True)
class Program:
    """An executable with its `main` and the paths of its sources."""

    name: str
    main: CppFunction
    sources: frozenset[str]
    node: NodeFact | None = None

    @property
    def stem(self) -> str:
        """The name of the file that its `main` is in, which programs often have."""
        return self.main.cpp.source.path.rpartition("/")[2].rpartition(".")[0]

    def has(self, cpp: Cpp) -> bool:
        """Whether a file is one of its sources."""
        return cpp.source.path in self.sources


@dataclass(frozen=True, slots=True)
class NodeObject:
    """An object of a node class, or None for the program itself: where it is made and with what.

    `statement` is the statement of `main` that makes it, if it is one; `variable` its name there.
    """

    owner: str
    statement: Node | None
    variable: str
    arguments: tuple[Node, ...]
    repeated: bool = False


def programs(code: Code, files: Mapping[str, Source]) -> tuple[Program, ...]:
    """The executables that the package makes, or what has a `main` where no CMake says so."""
    mains = code.definitions.get(("", "main"), [])
    build = build_of(files) if mains else None
    found = []
    for main in mains:
        path = main.cpp.source.path
        inside = next((p for p, s in files.items() if s is main.cpp.source), path)
        targets = [] if build is None else _targets(build, inside)
        stem = path.rpartition("/")[2].rpartition(".")[0]
        for name, sources in targets or [(stem, frozenset({inside}))]:
            paths = frozenset(files[p].path for p in sources if p in files) | {path}
            found.append(Program(name, main, paths))
    return tuple(found)


def with_nodes(found: tuple[Program, ...], graph: Graph) -> tuple[Program, ...]:
    """The programs, each with the node that it is."""
    nodes = [f for f in graph.facts if isinstance(f, NodeFact) and f.nodelet is None]
    return tuple(replace(p, node=_node(nodes, p.main, p.sources)) for p in found)


def _targets(build: BuildFiles, path: str) -> list[tuple[str, frozenset[str]]]:
    """The executables that a source belongs to, each with all of its sources."""
    found = []
    for target in build.targets:
        if target.executable and path in target.sources:
            name = target.file if isinstance(target.file, str) else target.name
            found.append((name, frozenset(build.sources_of(target))))
    return found


def _node(nodes: Sequence[NodeFact], main: CppFunction, paths: Collection[str]) -> NodeFact | None:
    """The node that a program is: made in its `main`, or in a function of its sources."""
    own = [f for f in nodes if f.site.place.source.path == main.cpp.source.path]
    others = [f for f in nodes if f.site.place.source.path in paths]
    return next(iter([*own, *others]), None)


# --- objects ------------------------------------------------------------------------------------


# Templates whose objects lead to others that are made elsewhere.
_POINTER = re.compile(r"ptr\b|Ptr\b")


@dataclass(slots=True)
class Objects:
    """Looks for the objects of some classes that a program makes."""

    code: Code
    wanted: Collection[str]
    _seen: set[str] = field(default_factory=set)
    _named: dict[int, frozenset[str]] = field(default_factory=dict)
    _names: frozenset[bytes] | None = None  # that are used, also in files of other packages

    def _used(self) -> frozenset[bytes]:
        if self._names is None:
            self._names = used_names(self.code.files)
        return self._names

    def made_by(self, program: Program) -> list[NodeObject]:
        """The objects that `main` makes, and those that functions and classes it uses make."""
        if not self.wanted:
            return []
        self._seen = set()
        found = list(self._in(program.main, True))
        for (owner, name), functions in self.code.definitions.items():
            if not owner and name != "main":
                for function in functions:
                    is_own = function.cpp.source.path in program.sources
                    if is_own or (function.cpp.is_beside and name.encode() in self._used()):
                        found += self._in(function, False)
        for name, variables in self.code.variables.items():
            for variable in (v for v in variables if program.has(v.cpp)):
                plain = variable.node.child_by_field_name("declarator")
                pointer = plain is None or "*" in text_of(plain) or not _is_plain(variable.type)
                if not pointer:
                    found += [
                        NodeObject(n, None, name, ())
                        for n in _types(variable.type)
                        if n in self.wanted
                    ]
        return found

    def made_by_class(self, owner: CppClass, entry: CppFunction | None) -> list[NodeObject]:
        """The objects that a class makes, a nodelet's; `entry` is the function that starts it."""
        self._seen = {owner.name}
        first = list(self._in(entry, True)) if entry is not None else []
        return first + list(self._members(owner, entry))

    def _in(self, function: CppFunction, in_main: bool) -> Iterator[NodeObject]:
        for node in self._types_in(function):
            name = text_of(node)
            if name in self.wanted:
                yield from _made(node, name, in_main)
            if name in self.code.classes and name not in self._seen and _makes(node):
                self._seen.add(name)
                yield from self._members(self.code.classes[name])

    def _types_in(self, function: CppFunction) -> list[Node]:
        """Where a function names classes."""
        cpp, body = function.cpp, function.body
        if body is None:
            return []
        if id(cpp) not in self._named:
            known = {*self.wanted, *self.code.classes}
            self._named[id(cpp)] = frozenset(n for n in known if n.encode() in cpp.words)
        found = self.code.named(cpp, body, self._named[id(cpp)])
        return [n for n in found if n.type == "type_identifier" or _is_called(n)]

    def _members(self, owner: CppClass, entry: CppFunction | None = None) -> Iterator[NodeObject]:
        """The objects that are members of another, or made by its functions."""
        for above in self.code.lineage(owner.name):
            for member in (*above.fields, *above.others):
                for name in _types(member.type) if _is_plain(member.type) else ():
                    if name in self.wanted and "*" not in text_of(member.node):
                        yield NodeObject(name, None, member.name, ())
            for function in self.code.functions_of(above):
                if entry is None or function.node.id != entry.node.id:
                    yield from self._in(function, False)


def _is_called(name: Node) -> bool:
    """Whether a name stands where a function is called, or an object is made: `Talker(nh)`."""
    above = name.parent
    if above is None or above.type != "call_expression" or name.type != "identifier":
        return False
    return above.child_by_field_name("function") == name


def _types(node: Node) -> list[str]:
    return [text_of(n) for n in inside(node, "type_identifier")]


def _is_plain(node: Node) -> bool:
    """Whether a type is that of an object itself, not of a pointer or container."""
    return node.type in ("type_identifier", "qualified_identifier") and "<" not in text_of(node)


def _makes(node: Node) -> bool:
    """Whether a type's name stands where an object is made, not for a parameter or a cast."""
    inner = ("qualified_identifier", "template_argument_list")
    around = climb(node, lambda n: n.type not in inner)
    return around is not None and around.type not in (
        "parameter_declaration",
        "cast_expression",
        "lambda_expression",
    )


def _made(node: Node, name: str, in_main: bool) -> Iterator[NodeObject]:
    """The objects that are made where a class's name stands."""
    pointer = several = False
    for around in ancestors(node, lambda n: n.type.endswith("statement")):
        match around.type:
            case "new_expression":
                arguments = around.child_by_field_name("arguments")
                yield _object(around, name, named(arguments) if arguments else [], in_main)
                return
            case "call_expression" if "make_" in text_of(around).partition("(")[0]:
                arguments = around.child_by_field_name("arguments")
                yield _object(around, name, named(arguments) if arguments else [], in_main)
                return
            case "template_type":
                pointer = pointer or _POINTER.search(text_of(around.children[0])) is not None
                several = True
            case "parameter_declaration" | "cast_expression" | "lambda_expression":
                return
            case "declaration":
                for declarator in around.children_by_field_name("declarator"):
                    made = _declared(around, declarator, name, in_main) if not pointer else None
                    if made is not None:
                        made = replace(made, variable=_declared_name(declarator))
                        yield replace(made, arguments=(), repeated=True) if several else made
                return


def _declared(node: Node, declarator: Node, name: str, in_main: bool) -> NodeObject | None:
    """`Talker t;`, `Talker t(nh);` (which may parse as a function), `Talker t{nh};`."""
    if declarator.type in ("pointer_declarator", "reference_declarator"):
        return None
    if declarator.type == "init_declarator":
        inner = declarator.child_by_field_name("declarator")
        if inner is None or inner.type not in ("identifier", "array_declarator"):
            return None
        value = declarator.child_by_field_name("value")
        given = _given(value, name) if value is not None else []
        if given is None or inner.type != "identifier":
            return replace(_object(node, name, [], in_main), repeated=True)
        return _object(node, name, given, in_main)
    if declarator.type == "array_declarator":
        return replace(_object(node, name, [], in_main), repeated=True)
    if declarator.type == "function_declarator":
        parameters = declarator.child_by_field_name("parameters")
        return _object(node, name, named(parameters) if parameters else [], in_main)
    return _object(node, name, [], in_main)


def _given(value: Node, name: str) -> list[Node] | None:
    """What an object is made with; None where that is not written there."""
    match value.type:
        case "argument_list" | "initializer_list":
            return named(value)
        case "call_expression" if _is_of(value.child_by_field_name("function"), name):
            arguments = value.child_by_field_name("arguments")
            return named(arguments) if arguments is not None else []
        case "compound_literal_expression" if _is_of(value.child_by_field_name("type"), name):
            listed = value.child_by_field_name("value")
            return named(listed) if listed is not None else []
        case _:
            return None


def _is_of(written: Node | None, name: str) -> bool:
    return written is not None and text_of(written).rpartition("::")[2] == name


def _object(node: Node, name: str, arguments: list[Node], in_main: bool) -> NodeObject:
    statement: Node | None = node
    while statement is not None and not (
        statement.type.endswith("_statement") or statement.type == "declaration"
    ):
        statement = statement.parent
    around = [statement, *ancestors(statement)] if statement is not None else []
    repeated = any(n.type in _LOOPS for n in around)
    variable = _variable(statement) if statement is not None else ""
    return NodeObject(name, statement if in_main else None, variable, tuple(arguments), repeated)


def _variable(statement: Node) -> str:
    """The variable that a statement declares, assigns or resets."""
    if statement.type == "expression_statement" and statement.named_children:
        inner = statement.named_children[0]
        call = call_of(inner)
        if call is not None:
            return call.on.removeprefix("this->") if call.name == "reset" else ""
        at = inner.child_by_field_name("left")
        return text_of(at).removeprefix("this->") if at is not None else ""
    return _declared_name(statement)


def _declared_name(node: Node) -> str:
    """The name that a declaration, or a declarator of it, declares."""
    at: Node | None = node
    while at is not None and at.type != "identifier":
        inner_ = at.child_by_field_name("declarator")
        last = at.named_children[-1] if at.type == "reference_declarator" else None
        at = inner_ if inner_ is not None else last
    return text_of(at) if at is not None else ""
