"""All that the code of nodes asks ROS for: each call with its names and numbers as far as known."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.calls.beside import without_unused
from rebsync.reverse.calls.node_calls import asked_of_nodes
from rebsync.reverse.calls.receivers import names_parameter, says_enough
from rebsync.reverse.calls.ros_calls_facts import Facts
from rebsync.reverse.calls.ros_calls_shapes import (
    TEMPLATES,
    Asked,
    called_as,
    handed_on,
    is_used,
    objects_of,
    types_of,
)
from rebsync.reverse.calls.ros_calls_sites import owner_of, site_of
from rebsync.reverse.calls.unmodelled_calls import unmodelled_in
from rebsync.reverse.calls.words import Word, words_in
from rebsync.reverse.graph import Fact, Graph, UnmodelledFact
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.cpp_calls import calls as calls_of_libraries
from rebsync.reverse.libraries.routines import Routine
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.values.cpp_values import Values
from rebsync.reverse.values.cpp_values_ros2 import uses_flat

_BEHIND = (b"(", b"<", b"/", b"#", b"\\")


@dataclass(slots=True, eq=False)
class Asking:
    """What the files ask of ROS: the calls, and the graph that their arguments make of them."""

    code: Code
    _values: Values | None = None
    _calls: list[Asked] | None = None
    _graph: Graph | None = None

    def __del__(self) -> None:
        """Frees the trees at once, which else stay until what refers to itself is collected."""
        if self._values is not None:
            self._values.end()

    def calls(self) -> list[Asked]:
        """The calls, without those of the client library itself."""
        if self._calls is None:
            self._calls = list(_calls_in(self.code, self.values(), libraries.own_classes()))
        return self._calls

    def calls_outside(self, owners: Collection[str]) -> Iterator[Asked]:
        """Those of the calls that do not stand in functions of some classes."""
        return _calls_in(self.code, self.values(), libraries.own_classes().union(owners))

    def values(self) -> Values:
        """What finds the values of their arguments."""
        if self._values is None:
            self._values = Values(self.code)
        return self._values

    @property
    def graph(self) -> Graph:
        """What is asked for, in the order of files and places: made when it is first wanted."""
        if self._graph is None:
            facts = Facts(self.values())
            every = (fact for asked in self.calls() for fact in facts.of(asked))
            found = without_unused(every, self.code.files)
            used = without_unused(unmodelled_in(self.values()), self.code.files)
            self._graph = Graph(tuple(sorted(found, key=_order)), tuple(sorted(used, key=_order)))
        return self._graph


def _calls_in(code: Code, values: Values, without: Collection[str]) -> Iterator[Asked]:
    """The calls but for those in functions of some classes, or of that name."""
    flat = uses_flat(values)
    for cpp in code.files:
        for calls in calls_of_libraries():
            if calls.library.flat and not flat:
                continue
            for start, end, name in words_in(calls, cpp.original, cpp.words):
                if name not in calls.classes and not _may_be_called(cpp.original, end):
                    continue
                place = cpp.root.descendant_for_byte_range(start, end)
                if place is None or place.start_byte != start or place.named_child_count:
                    continue
                yield from _at(Word(calls, values, cpp, place, name), without)


def _may_be_called(data: bytes, end: int) -> bool:
    """Whether what stands behind a word may be the arguments of a call, or of its template.

    What else may stand between them is taken for such: comments, and lines of the preprocessor.
    """
    while data[end : end + 1].isspace():
        end += 1
    return data[end : end + 1] in _BEHIND


def _at(word: Word, without: Collection[str]) -> Iterator[Asked]:
    """What a word asks for where it was found in a file."""
    if owner_of(word.values.texts.function_around(word.cpp, word.place)) in without:
        return
    for asked in asked_of_nodes(word) if word.calls.library.flat else _asked(word):
        if asked.site.owner not in without:
            yield asked


def _order(fact: Fact | UnmodelledFact) -> tuple[str, int]:
    return fact.site.place.source.path, fact.site.place.span.start


def _asked(word: Word) -> Iterator[Asked]:
    """What a word of a library with node handles asks for where it stands, if anything."""
    if word.name in word.calls.macros:
        call = word.place.parent
        if call is not None and call.type == "call_expression":
            yield word.asked(word.calls.macros[word.name], call)
        return
    found = list(_object(word)) if word.name in word.calls.objects else []
    yield from found or word.as_called(_of_method, _of_function)


def _of_function(word: Word, node: Node, above: Node) -> Iterator[Asked]:
    called = called_as(node, above)
    if called is None:
        return
    scope, call = called
    ask = word.calls.functions.get((scope, word.name))
    if ask is None or _is_own(call, scope, word.calls.scopes):
        return
    has_all = len(named(part(call, "arguments"))) >= len(ask.arguments) - 1
    if scope or (has_all and not word.values.calls.functions(word.cpp, call)):
        yield word.asked(ask, call, types=types_of(node))


def _is_own(call: Node, scope: str, scopes: frozenset[str]) -> bool:
    """Whether a call stands in the scope of the function: in the client library's own code."""
    around = call
    for wanted in (frozenset({scope}), scopes):
        above = climb(around, lambda n: n.type == "namespace_definition") if scope else None
        name = above.child_by_field_name("name") if above is not None else None
        if above is None or name is None or text_of(name) not in wanted:
            return False
        around = above
    return True


def _of_method(word: Word, call: Node, called: Node, target: Node) -> Iterator[Asked]:
    """What a method asks for, by the class of the object that it is called on."""
    calls, values, cpp, name = word.calls, word.values, word.cpp, word.name
    given = tuple(named(part(call, "arguments")))
    type_ = values.types.type_of(cpp, target).rpartition("::")[2]
    if type_ in calls.filters and name == "subscribe":
        variable = values.types.variable(cpp, target)
        types = types_of(variable.type) if variable is not None else ()
        asked = word.asked(calls.objects[type_][0], call, types=types)
        yield replace(asked, site=replace(asked.site, kept=text_of(target)))
        return
    ask = None
    on_handle = calls.on_handles.get(name)
    if type_ in libraries.handles():
        ask = on_handle
    elif type_ in calls.methods:
        ask = calls.methods[type_].get(name)
    elif type_ and (class_ := values.texts.class_near(type_, cpp)) is not None:
        lineage = values.texts.lineage(class_)
        descends = any(b in libraries.handles() for c in lineage for b in c.bases)
        ask = on_handle if descends else None
    elif on_handle is not None and not type_ and _is_undeclared(values, cpp, target):
        ask = on_handle if says_enough(values, cpp, on_handle, given) else None
    elif on_handle is not None and type_ not in calls.known:
        ask = on_handle if names_parameter(values, cpp, on_handle, given) else None
    if ask is not None:
        yield word.asked(ask, call, types=types_of(called), target=target)


def _is_undeclared(values: Values, cpp: Cpp, target: Node) -> bool:
    """Whether a name comes from outside of the files, as members of other packages' classes do.

    So may what a variable of no written type stands for.
    """
    if target.type == "pointer_expression":
        target = part(target, "argument")
    if target.type == "parenthesized_expression":
        return _is_undeclared(values, cpp, named(target)[-1])
    if target.type == "field_expression" and text_of(part(target, "argument")) == "this":
        target = part(target, "field")
    if target.type not in ("identifier", "field_identifier"):
        return False
    variable = values.types.variable(cpp, target)
    return variable is None or (variable.type is not None and text_of(variable.type) == "auto")


# --- objects that ask when they are made --------------------------------------------------------


def _object(word: Word) -> Iterator[Asked]:
    """`ros::Rate r(10)`, `new message_filters::Subscriber<T>(nh, "x", 1)`."""
    node, above = word.place, word.place.parent
    types: tuple[Node, ...] = ()
    scope = ""
    while above is not None and above.type in (*TEMPLATES, "qualified_identifier"):
        if above.type != "qualified_identifier":
            types = types_of(above)
        elif not scope:
            written = above.child_by_field_name("scope")
            scope = text_of(written) if written is not None else ""
        node, above = above, above.parent
    ask, scopes = word.calls.objects[word.name]
    is_filter = word.name in word.calls.filters
    is_open = not scope and (not is_filter or is_used(word.cpp, scopes, word.name))
    is_meant = scope in scopes or is_open
    if above is None or not is_meant:
        return
    if above.type == "field_declaration" and is_filter:
        yield from _initialised(word.values, above, ask, types)
        return
    for call, given in objects_of(node, above):
        if given and (is_filter or not handed_on(call)):
            asked = word.asked(ask, call, given, types)
            if is_filter and call.type == "init_declarator":
                kept = text_of(part(call, "declarator"))
                asked = replace(asked, site=replace(asked.site, kept=kept))
            yield asked


def _initialised(
    values: Values, declaration: Node, ask: Routine, types: tuple[Node, ...]
) -> Iterator[Asked]:
    """Members that constructors make with arguments."""
    for declarator in declaration.children_by_field_name("declarator"):
        for other, place in values.texts.everywhere(text_of(declarator)):
            above = place.parent
            if above is None or above.type != "field_initializer":
                continue
            variable = values.types.variable(other, place)
            lists = [n for n in above.named_children if n.type.endswith("_list")]
            if variable is None or variable.name != declaration or not lists:
                continue
            if given := tuple(named(lists[-1])):
                site = replace(site_of(values, other, place, above), kept=text_of(place))
                yield Asked(ask, site, given, types)
