"""How long the queue of a class of generated C++ is: what its mailbox is told."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.generated.cpp_descriptors import number_of
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import default_of, named, text_of

PASSED = "queue_length"  # what a class hands on that others extend


def queue_length(code: Code, constructor: CppFunction) -> int | None:
    """The number given to the mailbox, or as default to the parameter that is passed on to it."""
    for queue in _queues(constructor):
        if (number := number_of(code, constructor.cpp, queue)) is not None:
            return number
    for parameter in constructor.parameters:
        default = default_of(parameter.node)
        if parameter.name == PASSED and default is not None:
            return number_of(code, constructor.cpp, default)
    return None


def odd_queue(code: Code, constructor: CppFunction) -> Node | None:
    """What is given to the mailbox for the length of its queue and is no number that is known."""
    for queue in _queues(constructor):
        if text_of(queue) != PASSED and number_of(code, constructor.cpp, queue) is None:
            return queue
    return None


def _queues(constructor: CppFunction) -> Iterator[Node]:
    """`mailbox_(node, 3)`, and what a class that is extended is given: `Base(Inherited(), ...)`."""
    if constructor.initialisers is None:
        return
    for initialiser in named(constructor.initialisers):
        name, *_, values = named(initialiser)
        given = named(values)
        if text_of(name) == "mailbox_" and len(given) in (2, 3):
            yield given[1]
        elif len(given) == 4 and text_of(given[0]).startswith(("Inherited", "inherited")):
            yield given[2]
