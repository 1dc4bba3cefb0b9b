"""Publishers in dictionaries, lists and tuples, by keys that stand in the code."""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.reverse.graph import Fact
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_scope import Frame
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_tree import field, text_of

_KEYS = frozenset({"string", "integer"})
_READING = frozenset({"get", "items", "keys", "values"})
_QUOTED = re.compile(r"""["']""")


def element(reading: Reading, node: Node, frame: Frame) -> tuple[int, Fact] | None:
    """What an element of a container was asked for with, if that is always the same."""
    container, key = field(node, "value"), field(node, "subscript")
    if not _is_filled_once(reading, container, frame):
        return None
    place = f"{text_of(container)}[{_plain(text_of(key))}]"
    found = [n for n, f in enumerate(reading.unit.unit.facts) if _plain(f.site.kept) == place]
    if key.type in _KEYS and len(found) == 1:
        return found[0], reading.unit.unit.facts[found[0]]
    return reading.made_by(node, frame) if not found else None


def _plain(text: str) -> str:
    return _QUOTED.sub('"', text)


def _is_filled_once(reading: Reading, container: Node, frame: Frame) -> bool:
    """Whether all that is done with a container is to make it, to read it, and to fill it.

    That is to set elements, whose keys stand in the code, to what is asked for there.
    """
    if container.type not in ("identifier", "attribute"):
        return False
    name, made = text_of(container), 0
    for node in nodes_in(frame.scope.module.node):
        if node.type != container.type or text_of(node) != name:
            continue
        above = node.parent
        match above.type if above is not None else "":
            case "assignment" if above is not None and above.child_by_field_name("left") == node:
                made += 1
            case "subscript" if above is not None and above.child_by_field_name("value") == node:
                if not (_is_only_read(above) or _is_asked_for(reading, above, frame)):
                    return False
            case "attribute" if above is not None and _is_read(above):
                continue
            case "comparison_operator" | "for_statement" | "for_in_clause":
                continue
            case _:
                return False
    return made == 1


def _is_only_read(element_: Node) -> bool:
    above = element_.parent
    match above.type if above is not None else "":
        case "attribute" | "argument_list" | "comparison_operator" | "return_statement":
            return True
        case "assignment":
            return above is not None and above.child_by_field_name("right") == element_
        case _:
            return False


def _is_asked_for(reading: Reading, element_: Node, frame: Frame) -> bool:
    """Whether a statement sets an element, by a key that stands here, to what it asks ROS for."""
    above = element_.parent
    if (
        above is None
        or above.type != "assignment"
        or field(element_, "subscript").type not in _KEYS
    ):
        return False
    value = above.child_by_field_name("right")
    return value is not None and (frame.scope.py.source.path, value.id) in reading.unit.calls


def _is_read(attribute: Node) -> bool:
    return text_of(field(attribute, "attribute")) in _READING
