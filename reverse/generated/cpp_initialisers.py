"""What the constructors of generated classes give to the parts of the run-time part.

The mailbox, the drive and the sensors are of the node itself: with another handle they are on other
topics, and read other parameters. Members are made in the order of the class, whatever that of the
initialisers ([class.base.init]): what names a member that stands behind has nothing yet.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.syntax.cpp_index import CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, named, squeezed, text_of

_PARTS = ("Mailbox", "Drive")
_SENSOR = "Sensor<"


def odd_handles(owner: CppClass, constructor: CppFunction) -> Iterator[Node]:
    """The initialisers that give a part of the node another handle than the node's own."""
    types = {f.name: text_of(f.type) for f in owner.fields}
    handles = {p.name for p in constructor.parameters if "NodeHandle" in text_of(p.type)}
    listed = constructor.initialisers
    for initialiser in named(listed) if listed is not None else ():
        name, *_, values = initialiser.named_children
        type_, given = types.get(text_of(name), ""), named(values)
        if not (type_ in _PARTS or type_.startswith(_SENSOR)) or not given:
            continue
        is_own = squeezed(given[0]) in handles | {"*this"}
        if type_ == "Drive":
            is_own = is_own and [text_of(n) for n in given[1:]] == ["mailbox_"]
        if not is_own:
            yield initialiser


def too_early(owner: CppClass, constructor: CppFunction) -> Iterator[Node]:
    """The initialisers of members, and their own first values, that name a member behind them."""
    fields = sorted((*owner.fields, *owner.others), key=lambda f: f.node.start_byte)
    listed = named(constructor.initialisers) if constructor.initialisers is not None else ()
    given = {text_of(i.named_children[0]): i.named_children[-1] for i in listed}
    hidden = {p.name for p in constructor.parameters}
    for index, field in enumerate(fields):
        made = given.get(field.name, field.value)
        behind = {f.name for f in fields[index:]} - hidden
        if any(text_of(n) in behind for n in inside(made, "identifier", "field_identifier")):
            yield made or field.node
