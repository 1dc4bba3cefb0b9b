"""Whether loops end that change nothing of the model, as far as the form shows."""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.reverse.bodies.scope import Scope
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, text_of

_LIST = re.compile(r"const\s+std::vector<")
ENDLESS = "nothing shows that this loop ends"


def ends(scope: Scope, cpp: Cpp, loop: Node) -> bool:
    """Whether a loop or `switch` ends, if what stands in it does.

    Macros, which have no form, are `do { ... } while (0)`.
    """
    test = loop.child_by_field_name("condition") if loop.type == "do_statement" else None
    if loop.type == "switch_statement" or (test is not None and text_of(test) == "(0)"):
        return True
    return _is_over_given(loop) or (scope.form is not None and scope.form.ends(cpp, loop))


def _is_over_given(loop: Node) -> bool:
    """Whether it goes over a constant that a lambda is given, which nothing changes meanwhile."""
    over = loop.child_by_field_name("right")
    if loop.type != "for_range_loop" or over is None or over.type != "identifier":
        return False
    around = next((n for n in ancestors(loop) if n.type == "lambda_expression"), None)
    declarator = around.child_by_field_name("declarator") if around is not None else None
    given = inside(declarator, "parameter_declaration")
    return any(
        _LIST.match(text_of(p)) is not None
        and text_of(over) in map(text_of, inside(p, "identifier"))
        for p in given
    )
