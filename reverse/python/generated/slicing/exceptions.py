"""Exceptions that leave statements of generated Python which only tell people something.

A message server ends there, with what it has done by then; a callback that runs beside the bodies
may end the node. So what is told to people counts as nothing only if it raises nothing.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import field as with_default

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.python.bodies.body_form import PyForm
from rebsync.reverse.python.generated.slicing.messages import ToldMessages
from rebsync.reverse.python.generated.slicing.runtime_attributes import RuntimeAttributes
from rebsync.reverse.syntax.ancestors import ancestors, holds
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_tree import Py, field, named, text_of
from rebsync.source import Span

# What the model has of an operation: it violates what the model forbids where Python raises these.
_MODELLED = frozenset({"builtins.IndexError", "builtins.KeyError", "builtins.ZeroDivisionError"})

_NO_ELEMENT = "builtins.IndexError"
_DIVIDING = frozenset({"/", "//", "%", "<<", ">>", "**"})


@dataclass(frozen=True, eq=False, slots=True)
class ToldExceptions:
    """What the statements of a class may raise; `variables` are its state, by attributes,
    `messages` those for people.
    """

    form: PyForm | None = None
    files: Mapping[int, Py] = with_default(default_factory=dict)
    variables: Mapping[str, m.Type] = with_default(default_factory=dict)
    messages: ToldMessages | None = None
    runtime: RuntimeAttributes = RuntimeAttributes({}, frozenset())

    @staticmethod
    def of(code: PyCode, form: PyForm, messages: ToldMessages) -> ToldExceptions:
        """Those of a class of some code."""
        files = {s.node.id: s.py for s in code.modules.values()}
        runtime = RuntimeAttributes.of(code)
        return ToldExceptions(form, files, messages.variables, messages, runtime)

    def file_of(self, node: Node) -> Py | None:
        """The file that something is in."""
        return self.files.get(_root(node).id)

    def raises(self, node: Node) -> bool:
        """Whether an exception may leave a part of a function."""
        return any(self.reasons(node))

    def reasons(
        self, node: Node, modelled: Collection[Span] = (), methods: Collection[str] = ()
    ) -> Iterator[str]:
        """Why exceptions may leave a part of a function, but for what the model has of it.

        `modelled` are the places of the operations that the model has, and `methods` its methods,
        which are read themselves.
        """
        if self.form is None:
            return
        if self.messages is not None and not self.messages.fit(node):
            yield "a message has no such field, or one that does not take this"
        py = self.file_of(node)
        if py is None:
            yield "nobody knows what this does"
            return
        if any(self.runtime.lacking(_root(node), node)):
            yield "the run-time part has no such attribute"
        for problem, scope in self.form.raised(py, py.span(node)):
            is_here = scope.py is py and holds(scope.node, node)
            if scope.name in methods and not is_here:
                continue
            is_modelled = is_here and problem.place in modelled
            is_tested = problem.raises == _NO_ELEMENT and _is_tested_at(scope, problem.place)
            if not (is_tested or (is_modelled and problem.raises in _MODELLED)):
                yield problem.why

    def is_within(self, element: Node) -> bool:
        """Whether an element of an array of the state is there, whatever the state is."""
        head, _, name = text_of(field(element, "value")).partition(".")
        type_, py = self.variables.get(name), self.file_of(element)
        if head != "self" or type_ is None or len(type_.dimensions) != 1 or py is None:
            return False
        place = py.span(element)
        raised = self.form.raised(py, place) if self.form is not None else ()
        return not any(problem.place == place for problem, _ in raised)

    def races(self, node: Node) -> bool:
        """Whether something beside the bodies may fail for a variable that these change meanwhile.

        A test of it says nothing: it may have another value where it is asked again.
        """
        return any(
            n.type == "attribute" and text_of(field(n, "attribute")) in self.variables
            for critical in map(_decides, nodes_in(node))
            if critical is not None
            for n in nodes_in(critical)
        )


def raising_again(statement: Node) -> tuple[list[Node], list[Node]] | None:
    """The body of a `try` whose handlers raise again what they caught, and what they do before."""
    clauses = [c for c in named(statement) if c.type.endswith("_clause")]
    if statement.type != "try_statement" or any(c.type != "except_clause" for c in clauses):
        return None
    handlers = [[n for n in named(named(c)[-1]) if n.type != "comment"] for c in clauses]
    if not all(text_of(h[-1]) == "raise" if h else False for h in handlers):
        return None
    return named(field(statement, "body")), [n for h in handlers for n in h[:-1]]


def _is_tested_at(scope: Scope, place: Span) -> bool:
    """`names[i] if 0 <= i < len(names) else i`, where `i` is a local."""
    nodes = (n for n in nodes_in(scope.node) if n.type == "subscript")
    return any(_is_tested(n) for n in nodes if scope.py.span(n) == place)


def _is_tested(element: Node) -> bool:
    index, of = field(element, "subscript"), text_of(field(element, "value"))
    wanted = f"0<={text_of(index)}<len({of})"
    return index.type == "identifier" and any(
        holds(then, element) and "".join(text_of(condition).split()) == wanted
        for above in ancestors(element)
        if above.type == "conditional_expression"
        for then, condition, _ in [named(above)]
    )


def _decides(node: Node) -> Node | None:
    """The operand that decides whether an operation fails, where one does."""
    if node.type == "binary_operator" and text_of(field(node, "operator")) in _DIVIDING:
        is_text = field(node, "left").type in ("string", "concatenated_string")
        return None if is_text else field(node, "right")
    return field(node, "subscript") if node.type == "subscript" else None


def _root(node: Node) -> Node:
    while node.parent is not None:
        node = node.parent
    return node
