"""Whether loops end that change nothing of the model, as far as the form shows."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.bodies.scope import Scope
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of

ENDLESS = "nothing shows that this loop ends"


def ends(scope: Scope, cpp: Cpp, loop: Node) -> bool:
    """Whether a loop or `switch` ends, if what stands in it does.

    Macros, which have no form, are `do { ... } while (0)`.
    """
    test = loop.child_by_field_name("condition") if loop.type == "do_statement" else None
    if loop.type == "switch_statement" or (test is not None and text_of(test) == "(0)"):
        return True
    return scope.form is not None and scope.form.ends(cpp, loop)
