"""Checks of constants when a node of generated Python starts, which the constants pass."""

from __future__ import annotations

import re
from collections.abc import Mapping

from tree_sitter import Node

from rebsync.intervals import Interval
from rebsync.reverse.launch.arithmetic import Scalar, evaluate
from rebsync.reverse.python.generated.roles import EnvUse
from rebsync.reverse.python.generated.slicing.logs import only_logs
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_tree import field, is_label, named, text_of
from rebsync.reverse.unknowns import Open

_OWN = re.compile(r"\bself\.")


def is_passed(
    statement: Node, env: Mapping[str, EnvUse], constants: Mapping[str, Interval]
) -> bool:
    """Whether a statement only raises if constants are not as they are: `if self._n < 1: raise`.

    `env` are the attributes that hold constants of the model, `constants` the numbers of these.
    """
    found = {n: constants[use.name] for n, use in env.items() if use.name in constants}
    known = {f"self_{name}": i.low for name, i in found.items() if i.low == i.high}
    if statement.type == "assert_statement":
        return _value(named(statement)[0], known) is True
    if statement.type != "if_statement" or statement.children_by_field_name("alternative"):
        return False
    body = named(field(statement, "consequence"))
    only_raises = all(s.type == "raise_statement" or only_logs(s) for s in body)
    return only_raises and _value(field(statement, "condition"), known) is False


def _value(node: Node, known: Mapping[str, int]) -> Scalar | Open:
    """What an expression of constants gives."""
    free = (n for n in nodes_in(node) if n.type == "identifier" and not is_label(n))
    if any(text_of(n) != "self" for n in free):
        return Open("it is about more than constants")
    return evaluate(_OWN.sub("self_", text_of(node)), known, {})
