"""The words of a library where they stand in a file, and what the calls there ask for."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.calls.ros_calls_shapes import Asked
from rebsync.reverse.calls.ros_calls_sites import site_of
from rebsync.reverse.libraries.cpp_calls import Calls
from rebsync.reverse.libraries.routines import Routine
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part
from rebsync.reverse.syntax.cpp_words import places_of
from rebsync.reverse.values.cpp_values import Values

_WHITE = frozenset(b" \t\n\r\f\v")
_CALLED = frozenset({"template_method", "template_function", "dependent_name"})


@dataclass(frozen=True, eq=False, slots=True)
class Word:
    """A word of a library, at the place of its name in a file."""

    calls: Calls
    values: Values
    cpp: Cpp
    place: Node
    name: str

    def asked(
        self,
        ask: Routine,
        call: Node,
        given: tuple[Node, ...] | None = None,
        types: tuple[Node, ...] = (),
        target: Node | None = None,
    ) -> Asked:
        """What a call asks for: with the arguments that stand in it, if none are given."""
        site = site_of(self.values, self.cpp, self.place, call)
        arguments = tuple(named(part(call, "arguments"))) if given is None else given
        return Asked(ask, site, arguments, types, target)

    def as_called(
        self,
        of_method: Callable[[Word, Node, Node, Node], Iterator[Asked]],
        of_function: Callable[[Word, Node, Node], Iterator[Asked]],
    ) -> Iterator[Asked]:
        """What is asked for by the call of a method, or of a function, whose name this is.

        A method gets the call, its own name and its object; a function its name and what is around.
        """
        node, above = self.place, self.place.parent
        while above is not None and above.type in _CALLED:
            node, above = above, above.parent
        if above is None:
            return
        if above.type != "field_expression" or part(above, "field") != node:
            yield from of_function(self, node, above)
            return
        call = above.parent
        if call is not None and call.type == "call_expression" and part(call, "function") == above:
            yield from of_method(self, call, node, part(above, "argument"))


def words_in(calls: Calls, data: bytes, words: frozenset[bytes]) -> list[tuple[int, int, str]]:
    """The places of the words of a library in a text whose words are known, from the first.

    Start, end, and the word; of words that count only after a scope, those that stand so.
    """
    found = [(at, word) for word in calls.words & words for at in places_of(data, word)]
    for word in calls.scoped_words & words:
        found += ((at, word) for at in places_of(data, word) if _is_scoped(data, at))
    return [(at, at + len(word), word.decode()) for at, word in sorted(found)]


def _is_scoped(data: bytes, at: int) -> bool:
    """Whether a scope stands before a place: `::`, and maybe white space."""
    while at > 0 and data[at - 1] in _WHITE:
        at -= 1
    return data.endswith(b"::", 0, at)
