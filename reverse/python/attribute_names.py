"""What attributes of generated classes are called in the model, private ones included.

Within a class `self.__x` is an attribute that no other code names: Python puts the name of the
class in front of such a name (The Python Language Reference, 6.2.1.1). So the same text means
another attribute in a class below, and in a function that is in no class.
"""

from __future__ import annotations

import re
from collections.abc import Collection

from rebsync.names import carry, uncarry
from rebsync.reserved import PYTHON_MEMBERS
from rebsync.reverse.python.py_index import PyCode, Scope, classes_in
from rebsync.reverse.python.py_tree import field, named, nodes_in, text_of


def is_private(name: str) -> bool:
    """Whether a class has the attribute of a name for itself."""
    return name.startswith("__") and not name.endswith("__")


def variable_name(code: PyCode, owner: Scope, attribute: str, markers: Collection[str]) -> str:
    """The model's name of an attribute, from its marker unless it was renamed."""
    if is_private(attribute) and _stands_alone(code, owner, attribute):
        attribute = attribute[1:]
    for marker in markers:
        kind, path, *_ = [*marker.split(), "", ""]
        name = path.rpartition(".")[2]
        carried = re.escape(carry(name, PYTHON_MEMBERS)) if name else ""
        if kind in ("statevar", "env", "knownrebec") and re.fullmatch(
            rf"_{carried}(_\d+)?", attribute
        ):
            return name
    return uncarry(attribute.removeprefix("_"), PYTHON_MEMBERS)


def _stands_alone(code: PyCode, owner: Scope, name: str) -> bool:
    """Whether a private name is all that its class calls so, and no class is below it."""
    attributes = (n for n in nodes_in(owner.node) if n.type == "attribute")
    others = {text_of(field(n, "attribute")) for n in attributes}
    return name[1:] not in others and not any(_is_below(c, owner) for c in classes_in(code))


def _is_below(below: Scope, owner: Scope) -> bool:
    bases = below.node.child_by_field_name("superclasses")
    words = (text_of(b).rpartition(".")[2] for b in (named(bases) if bases is not None else ()))
    return below is not owner and owner.name in words
