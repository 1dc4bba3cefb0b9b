"""The functions of a class of generated Python as the model has them: what they take, do and give.

Methods that no class above with a mailbox has, functions of modules, and static ones are among
those of each class that calls them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field as with_default
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.intervals import INT32, INTEGERS, Interval
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals.invariants import Body, BodyStart, failed
from rebsync.reverse.analysis.intervals.needs import Mark
from rebsync.reverse.analysis.intervals.writes import own as hidden
from rebsync.reverse.bodies.overloads import Served
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.generated.sensors import list_unseen
from rebsync.reverse.python.bodies.body_form import PyForm
from rebsync.reverse.python.generated import arguments
from rebsync.reverse.python.generated.expressions import Expressions
from rebsync.reverse.python.generated.filled import fillings_of
from rebsync.reverse.python.generated.function_names import plain_name
from rebsync.reverse.python.generated.helpers import (
    called_in,
    first_of,
    own_name,
    without_object,
)
from rebsync.reverse.python.generated.kinds import literal_kind
from rebsync.reverse.python.generated.marks import is_constructor
from rebsync.reverse.python.generated.named_constants import CodeConstants, NamedConstants
from rebsync.reverse.python.generated.names import Filling, Helper, ModelNames
from rebsync.reverse.python.generated.overloads import resolved
from rebsync.reverse.python.generated.posts import own_posts
from rebsync.reverse.python.generated.py_types import passed_on, type_of
from rebsync.reverse.python.generated.results import without_result
from rebsync.reverse.python.generated.roles import PyRoles, PySends
from rebsync.reverse.python.generated.slicing.silent import silent_in
from rebsync.reverse.python.generated.statements import Statements
from rebsync.reverse.python.generated.widths import WidthContext, hint_of, wanted_of
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.py_index import BY_NAME, PyCode, Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of
from rebsync.source import Source, Span

_HINT = "say its type, as `: int` or `-> int`"


@dataclass(frozen=True, slots=True)
class _Noted:
    """A body that was read, and what is told of its integers whatever the others do."""

    body: Body
    told: Sequence[Mark]
    source: Source
    within: str

    @property
    def marks(self) -> set[Mark]:
        return {need.mark for needs in self.body.needs.values() for need in needs}


@dataclass(eq=False)
class ModelBodies:
    """Reads functions; `line` are a class and those above it, `roles` what members are for.

    `served` is the server of a function, if it serves one, `types` are the names of classes and
    messages, `serving` what classes serve, and `fields` what messages have in the model's types.
    `constants` are the integers that some names of the model always stand for, `named` those of
    the code.
    """

    code: PyCode
    form: PyForm
    findings: Findings
    line: Callable[[Scope], list[Scope]]
    roles: Callable[[Scope], PyRoles]
    served: Callable[[Scope, Scope], str | None]
    types: frozenset[str]
    serving: Served
    fields: Mapping[str, Mapping[str, m.Type | None]]
    constants: Mapping[str, Interval]
    named: CodeConstants
    known: dict[int, ModelNames] = with_default(default_factory=dict)
    passed: dict[int, Mapping[str, Sequence[m.Type | None]]] = with_default(default_factory=dict)
    noted: dict[int, list[_Noted]] = with_default(default_factory=dict)

    def parameters(self, owner: Scope, function: Scope, within: str) -> tuple[m.Parameter, ...]:
        """What a function takes, without its object."""
        found, reader = [], self.reader(owner, function, within)
        for node, type_ in self._taken(owner, function):
            span = function.py.span(node)
            if type_ is None:
                why = f'the model has no type for "{text_of(node)}"'
                self.findings.unreadable(function.py.source, Unread(span, why, _HINT), within)
            found.append(m.Parameter(type_ or m.Type("int"), reader.local(_plain(node)), span))
        return tuple(found)

    def body(self, owner: Scope, function: Scope, within: str) -> m.Block | None:
        """What a function does; None for one that is only declared."""
        if "abstractmethod" in function.decorators:
            return None
        reader = self.reader(owner, function, within)
        for node, type_ in self._taken(owner, function):
            name = _plain(node)
            reader.expressions.locals[name] = reader.local(name)
            if type_ is not None:
                reader.expressions.types[reader.local(name)] = type_
        self.findings.statements[within] += 0
        found = reader.block(body_of(function), field(function.node, "body"))
        self._note(owner, function, reader, found)
        if self.served(owner, function) in self.roles(owner).sensors:
            list_unseen(found, within, function.py.source, self.findings)
        return found

    def _note(self, owner: Scope, function: Scope, reader: Statements, body: m.Block) -> None:
        """Keeps a body until all of its class are there: what its integers may be they tell."""
        names, cuts = reader.expressions.names, reader.expressions.cuts
        said = function.node.child_by_field_name("return_type")
        result = (type_of(said) if said is not None else None) or m.Type("int")
        own = {reader.local(_plain(n)): t for n, t in self._taken(owner, function) if t is not None}
        known = WidthContext(
            {**names.types, **own},
            names.results,
            self._passed_types(owner),
            *(cuts.of, cuts.rounded, cuts.called, cuts.floored),
        )
        source = function.py.source
        wanted = wanted_of(body, result, source.path, known)
        is_server = self.served(owner, function) is not None
        read = Body(
            reader.within.rpartition(".")[2],
            BodyStart.BETWEEN if is_server else BodyStart.WITHIN,
            body.statements,
            known.types,
            [reader.local(_plain(n)) for n, _ in self._taken(owner, function)],
            names.results,
            {key: cut.bounds for key, cut in cuts.of.items()},
            wanted.needs,
        )
        noted = _Noted(read, wanted.told, source, reader.within)
        self.noted.setdefault(id(owner), []).append(noted)

    def list_beyond(self, owner: Scope, constructors: Sequence[m.Constructor] | None) -> None:
        """Lists the integers of a class's bodies that may be others than those of the model.

        Given the constructors, with all that runs before them, these bodies are all that changes
        the state variables, so that it can be told what these hold.
        """
        noted = self.noted.pop(id(owner), [])
        bodies, state = [each.body for each in noted], None
        if constructors is not None:
            state = {name: type_ for name, type_, _ in self.roles(owner).state.values()}
            bodies += self._first(owner, constructors, bodies)
        marks = failed(bodies, state, self.constants)
        for each in noted:
            for mark in sorted({*each.told, *marks & each.marks}):
                span = Span(mark[1], mark[2])
                unread = Unread(span, mark[3], hint_of(each.source.slice(span), mark[3]))
                self.findings.unreadable(each.source, unread, each.within)

    def _first(
        self, owner: Scope, constructors: Sequence[m.Constructor], bodies: Sequence[Body]
    ) -> Iterator[Body]:
        """The constructors as the first bodies that run."""
        names = self.names(owner)
        cuts = {key: cut for body in bodies for key, cut in body.cuts.items()}
        for each in constructors:
            types = {p.name: p.type for p in each.parameters}
            statements = each.body.statements if each.body is not None else ()
            known = {**names.types, **types}
            yield Body(each.name, BodyStart.FIRST, statements, known, types, names.results, cuts)

    def _passed_types(self, owner: Scope) -> Mapping[str, Sequence[m.Type | None]]:
        """What functions of the code take, those that send as well; of several the narrowest."""
        if id(owner) not in self.passed:
            found: dict[str, Sequence[m.Type | None]] = {}
            names = self.names(owner)
            for above in self.line(owner):
                for function in self.roles(above).functions.values():
                    if function.name in names.functions:
                        types = [t for _, t in self._taken(above, function)]
                        _narrow(found, function.name, types)
            for name, helper in names.helpers.items():
                found[name] = [t for _, t in self._taken(owner, helper.function)]
            found |= {name: sends.types for name, sends in names.sends.items()}
            self.passed[id(owner)] = found
        return self.passed[id(owner)]

    def result(self, owner: Scope, function: Scope, within: str) -> m.Type:
        """The type of what a function gives."""
        said = function.node.child_by_field_name("return_type")
        variables = _variables(self.names(owner))
        found = type_of(said) if said is not None else result_of(function, variables)
        if found is None:
            span = function.py.span(field(function.node, "name"))
            why = f'the model has no type for what "{function.name}" gives'
            self.findings.unreadable(function.py.source, Unread(span, why, _HINT), within)
        elif found.name != "void" and "abstractmethod" not in function.decorators:
            for unread in without_result(self.form, function):
                self.findings.unreadable(function.py.source, unread, within)
        return found or m.Type("void")

    def reader(self, owner: Scope, function: Scope, within: str) -> Statements:
        """What reads statements of a function."""
        names = self.names(owner)
        if function.module is not owner.module:
            names = replace(names, constants=NamedConstants(self.named, function.module))
        expressions = Expressions(function.py, names, own=self._own(owner, function))
        return Statements(expressions, self.findings, within, self.types)

    def helpers(self, owner: Scope) -> Iterator[Scope]:
        """The functions of modules that a class calls."""
        called = {id(h.function): h.function for h in self.names(owner).helpers.values()}
        yield from (f for f in called.values() if not f.is_method)

    # --- what is taken --------------------------------------------------------------------------

    def _own(self, owner: Scope, function: Scope) -> str:
        """What a function calls the object of the class."""
        if function.is_method:
            return own_name(function)
        called = (h for h in self.names(owner).helpers.values() if h.function is function)
        return next((h.own for h in called if h.own), "\0")

    def _taken(self, owner: Scope, function: Scope) -> Iterator[tuple[Node, m.Type | None]]:
        """The parameters with their types, those of a server as its message says if need be."""
        first = first_of(function)
        if not function.is_method:
            first = int(self._own(owner, function) != "\0")
        nodes = function.parameter_nodes[first:]
        types = self._of_message(owner, function, len(nodes))
        is_bound = self.served(owner, function) is None and not is_constructor(function.name)
        for node, type_, of in zip(nodes, types, function.parameters[first:], strict=True):
            said = node.child_by_field_name("type")
            is_plain = node.type in ("identifier", "typed_parameter")
            if arguments.has_constant(node):
                is_plain = is_bound or self._is_given_all(owner, function, len(nodes))
            is_plain &= is_bound or of.by != BY_NAME
            found = (type_of(said) if said is not None else type_) if is_plain else None
            yield node, found

    def _of_message(self, owner: Scope, function: Scope, count: int) -> list[m.Type | None]:
        """The types of what the message of a server has, in the order of its parameters."""
        for above in self.line(owner):
            roles = self.roles(above)
            for shim, handler in roles.handler_names.items():
                if handler == function.name and shim in roles.functions:
                    types = list(self._passed(roles.functions[shim]))
                    return types if len(types) == count else [None] * count
        return [None] * count

    def _is_given_all(self, owner: Scope, function: Scope, count: int) -> bool:
        """Whether a function serves messages, and whoever names it gives it all that it takes."""
        bodies = (f.node for c in self.line(owner) for f in self.roles(c).functions.values())
        is_server = self.served(owner, function) is not None
        return is_server and arguments.is_given_all(function.name, bodies, count)

    def _passed(self, shim: Scope) -> Iterator[m.Type | None]:
        message = named(field(shim.node, "parameters"))[-1]
        type_ = message.child_by_field_name("type")
        fields = self.fields.get(text_of(type_), {}) if type_ is not None else {}
        known = {name: of for name, of in fields.items() if of is not None and not of.dimensions}
        holder = f"{shim.parameters[-1].name}."
        for call in (s for s in body_of(shim) if "receive(" in text_of(s)):
            arguments = named(field(named(call)[0], "arguments"))
            _, values = passed_on(arguments[-1]) or ("", [])
            yield from (known.get(text_of(v).removeprefix(holder)) for v in values)

    # --- names ----------------------------------------------------------------------------------

    def names(self, owner: Scope) -> ModelNames:
        """What the names in a class stand for."""
        if id(owner) not in self.known:
            self.known[id(owner)] = self._names(owner)
        return self.known[id(owner)]

    def _names(self, owner: Scope) -> ModelNames:
        variables: dict[str, str] = {}
        sends: dict[str, PySends] = {}
        types: dict[str, m.Type] = {}
        for above in reversed(self.line(owner)):
            roles = self.roles(above)
            variables |= {a: v[0] for a, v in (roles.state | roles.known).items()}
            variables |= {a: e.name for a, e in roles.env.items()}
            types |= {v[0]: v[1] for v in (roles.state | roles.known).values()}
            types |= {e.name: e.type for e in roles.env.values()}
            given = ((f, s, roles.functions[f]) for f, s in roles.sends.items())
            sends |= {f: resolved(self.serving, owner, s, of) for f, s, of in given}
        types |= {hidden(name): type_ for name, type_ in types.items()}
        constants = NamedConstants(self.named, owner.module, self.line(owner))
        names = ModelNames(variables, sends, {}, constants, types=types)
        return self._with_messages(owner, self._with_functions(owner, names))

    def _with_functions(self, owner: Scope, names: ModelNames) -> ModelNames:
        functions: dict[str, str] = {}
        servers: set[str] = set()
        results: dict[str, m.Type] = {}
        properties: set[str] = set()
        helpers: dict[str, Helper] = {}
        scopes: list[Scope] = []
        for above in reversed(self.line(owner)):
            roles = self.roles(above)
            for name, function in roles.functions.items():
                if roles.is_plumbing(name):
                    continue
                scopes.append(function)
                if name == "construct" or name.startswith("construct__"):
                    continue
                served = self.served(above, function)
                functions[name] = served or plain_name(function)
                servers |= {name} if served is not None else set()
                properties |= {name} if "property" in function.decorators else set()
                self._add_result(results, functions[name], function, names)
            helpers |= without_object(above, roles.functions)
        taken = {*functions.values(), *names.variables.values(), *self.types}
        for name, helper in called_in(self.named, scopes, taken).items():
            helpers[name] = helper
            self._add_result(results, helper.name, helper.function, names)
        return replace(
            names,
            functions=functions,
            servers=frozenset(servers),
            results=results,
            properties=frozenset(properties),
            helpers=helpers,
            parameters={f.name: arguments.shared(self.code, self.line, f) for f in scopes},
        )

    def _add_result(
        self, results: dict[str, m.Type], name: str, function: Scope, names: ModelNames
    ) -> None:
        said = function.node.child_by_field_name("return_type")
        found = type_of(said) if said is not None else result_of(function, _variables(names))
        results.pop(name, None)
        if found is not None:
            results[name] = found

    def _with_messages(self, owner: Scope, names: ModelNames) -> ModelNames:
        """The same with what publishers send, and what is posted."""
        imported = {
            name: text_of(b.value) if b.value is not None else ""
            for name, bindings in owner.module.names.items()
            for b in bindings
            if len(bindings) == 1 and b.how == "import" and _is_at_the_top(b.node)
        }
        line = self.line(owner)
        posting = (f for c in line for f in self.roles(c).functions.values())
        posts = {call.id: p for f in posting for call, p in own_posts(line, self.roles, f)}
        fillings: dict[str, Filling] = {}
        for above in reversed(self.line(owner)):
            fillings |= fillings_of(self.roles(above), names.sends)
        silent = silent_in(self.code, self.form, line, [*map(self.roles, line)])
        known = replace(names, imported=imported, posts=posts, fillings=fillings)
        own = self.roles(owner)
        return replace(known, silent=silent, beside=own.beside, inlined=own.inlined)


def result_of(function: Scope, variables: Callable[[str], m.Type | None]) -> m.Type | None:
    """The type of what a function without a type gives, if its text tells; None: it does not."""
    values = [v for r in function.returns for v in named(r)[:1] if v.type != "none"]
    kinds = {literal_kind(value, variables) for value in values}
    return m.Type("void") if not values else kinds.pop() if len(kinds) == 1 else None


def _variables(names: ModelNames) -> Callable[[str], m.Type | None]:
    """The types of attributes."""
    return lambda attribute: names.types.get(names.variables.get(attribute, ""))


def _narrow(
    found: dict[str, Sequence[m.Type | None]], name: str, types: Sequence[m.Type | None]
) -> None:
    """Adds what one of several functions or servers of a name takes."""
    before = found.get(name, types)
    narrow = [b if _width(b) < _width(t) else t for b, t in zip(before, types, strict=False)]
    found[name] = narrow if len(narrow) == len(before) == len(types) else []


def _width(type_: m.Type | None) -> int:
    return INTEGERS.get(type_.name, INT32).high if type_ is not None else INT32.high


def _plain(node: Node) -> str:
    """The name of a parameter."""
    if node.type == "typed_parameter":
        return text_of(named(node)[0])
    return text_of(node.child_by_field_name("name") or node)


def _is_at_the_top(node: Node) -> bool:
    """Whether a module is imported whatever happens, and not only for who checks types."""
    around = node.parent
    return node.type == "import_statement" and around is not None and around.type == "module"
