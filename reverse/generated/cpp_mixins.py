"""Base classes without state, which give a class of generated code nothing but helper functions."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from rebsync.reserved import RUNTIME_FUNCTIONS
from rebsync.reverse.bodies.cpp_users import is_logging
from rebsync.reverse.generated.cpp_free import free_beside, is_method
from rebsync.reverse.generated.cpp_names import has_mailbox, is_given
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_declarations import unscoped
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction, function_of
from rebsync.reverse.syntax.cpp_tree import named, text_of

# Bases of libraries that add nothing that runs.
_EMPTY = re.compile(r"boost::noncopyable|std::enable_shared_from_this<\w+>")
_BETWEEN = frozenset({"access_specifier", "comment"})
_ASSIGNS = "operator="


def without_mixins(code: Code) -> Code:
    """The same code with base classes that have no state left out of the classes with a mailbox.

    Their functions are like free ones: see `functions_beside`.
    """
    classes = {
        name: replace(owner, bases=tuple(b for b in owner.bases if b not in dropped))
        if (dropped := set(_mixins_of(code, owner)))
        else owner
        for name, owner in code.classes.items()
    }
    return replace(code, classes=classes)


def functions_beside(code: Code, owner: CppClass) -> list[CppFunction]:
    """The free functions, and helpers of base classes without state, that a class calls first."""
    return free_beside(code, owner, {f.name: f for f in _helpers_of(code, owner)})


def methods_beside(code: Code, owner: CppClass) -> list[CppFunction]:
    """Those of them that are methods of the model: something else than a log calls them."""
    return [f for f in functions_beside(code, owner) if not _only_told(code, owner, f)]


def _only_told(code: Code, owner: CppClass, function: CppFunction) -> bool:
    """Whether nothing but statements that log names a function, but for bodies of other classes."""
    lineage = {c.name for c in code.lineage(owner.name)}
    others = {
        f.node.id
        for (of, _), found in code.definitions.items()
        if of and of not in lineage
        for f in found
    }
    uses = [
        [node, *ancestors(node)]
        for cpp in code.files
        for node in code.named(cpp, cpp.root, [function.name])
    ]
    uses = [
        around
        for around in uses
        if function.node not in around and not any(n.id in others for n in around)
    ]
    return bool(uses) and all(any(map(is_logging, around)) for around in uses)


def _helpers_of(code: Code, owner: CppClass) -> Iterator[CppFunction]:
    """The helper functions that a class and those above it have of base classes without state."""
    for above in code.lineage(owner.name):
        for name in _mixins_of(code, above):
            if (mixin := code.classes.get(name)) is not None:
                yield from (f for f in code.functions_of(mixin) if not _is_special(mixin, f))


def _mixins_of(code: Code, owner: CppClass) -> Iterator[str]:
    """The bases of a class of generated code that have no state, by their names."""
    if not has_mailbox(code, owner):
        return
    for clause in owner.node.named_children:
        for base in clause.named_children if clause.type == "base_class_clause" else ():
            name = unscoped(base)
            if name in code.classes:
                if _is_mixin(code, owner, code.classes[name]):
                    yield name
            elif _EMPTY.fullmatch("".join(text_of(base).split())):
                yield name


def _is_mixin(code: Code, owner: CppClass, base: CppClass) -> bool:
    """Whether a base has no state, overrides nothing, and hides nothing that the class calls."""
    body = base.node.child_by_field_name("body")
    alone = len(code.all_classes.get(base.name, ())) == 1 and not (base.bases or base.roots)
    if body is None or not alone or base.markers:
        return False
    members = [n for n in named(body) if n.type not in _BETWEEN]
    functions = [function_of(base.cpp, n, base.name) for n in members]
    own = {f.name for c in code.lineage(owner.name) if c is not base for f in c.functions}
    taken = own | RUNTIME_FUNCTIONS | {name for of, name in code.definitions if not of}
    return all(
        f is not None and (_is_empty(f) if _is_special(base, f) else _is_helper(code, f, taken))
        for f in functions
    )


def _is_special(owner: CppClass, function: CppFunction) -> bool:
    """Whether it makes, copies or ends objects."""
    return function.name in (owner.name, f"~{owner.name}") or function.name.startswith("operator")


def _is_empty(function: CppFunction) -> bool:
    if is_given(function):
        return "".join(function.name.split()) == _ASSIGNS or "operator" not in function.name
    plain = function.body is not None and not named(function.body)
    return plain and function.initialisers is None and "operator" not in function.name


def _is_helper(code: Code, function: CppFunction, taken: set[str]) -> bool:
    kinds = {c.type for c in function.node.children}
    inside = function.body is not None and function.body.type == "compound_statement"
    is_known = is_method(function) or _is_unused(code, function)
    return inside and "virtual" not in kinds and function.name not in taken and is_known


def _is_unused(code: Code, function: CppFunction) -> bool:
    """Whether nothing but its own definition has the name of a function."""
    name = re.compile(rb"\b%s\b" % re.escape(function.name.encode()))
    return sum(len(name.findall(cpp.data)) for cpp in code.files) == 1
