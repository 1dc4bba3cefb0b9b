"""What stands in the list of initialisers of a constructor of C++."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.syntax.cpp_declarations import CppClass, unscoped
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, text_of


def hands_on(owner: CppClass, initialiser: Node) -> bool:
    """Whether an initialiser is another constructor of the class ([class.base.init]).

    A base may have the class's name in another scope: `class Node : public rclcpp::Node`.
    """
    name = initialiser.named_children[0]
    bases = {base.rpartition("::")[2] for base in (*owner.bases, *owner.roots)}
    is_base = name.type == "qualified_identifier" and owner.name in bases
    return unscoped(name) == owner.name and not is_base


def initialised_in(cpp: Cpp) -> set[str]:
    """The names of members and bases that constructors of a file initialise."""
    return {text_of(n.named_children[0]) for n in inside(cpp.root, "field_initializer")}
