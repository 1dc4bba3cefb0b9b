"""What the model calls the functions of generated Python."""

from __future__ import annotations

from rebsync.names import carry, uncarry
from rebsync.reserved import PYTHON_FUNCTIONS
from rebsync.reverse.python.generated.py_types import markers_above
from rebsync.reverse.syntax.py_index import Scope


def plain_name(function: Scope) -> str:
    """The model's name of a function, from its marker unless it was renamed.

    Overloads have the types of their parameters behind two underscores.
    """
    name = function.name
    for marker in markers_above(function.py, function.node):
        kind, path, *_ = [*marker.split(), "", ""]
        told = path.rpartition(".")[2]
        carried = carry(told, PYTHON_FUNCTIONS) if told else ""
        if kind in ("msgsrv", "method") and (name == carried or name.startswith(f"{carried}__")):
            return told
    found = uncarry(name, PYTHON_FUNCTIONS)
    if carry(found, PYTHON_FUNCTIONS) == name and ("__" not in name or name.endswith("_v")):
        return found
    return uncarry(name.rpartition("__")[0] or name, PYTHON_FUNCTIONS)
