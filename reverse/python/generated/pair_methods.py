"""Functions of generated Python that give what the model has no type for: several values, texts.

Where a method is called that only chooses between tuples, their elements stand in its place
(`tuples.parts`).
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from tree_sitter import Node

from rebsync.reverse.python.generated.module_variables import imported_as
from rebsync.reverse.python.generated.py_types import is_text, type_of
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import CLASS, PyCode, Scope, module_named
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import calls_in, field, named, text_of

_TIMES = frozenset({"When", "AT_ONCE"})
_BESIDE = frozenset({"string", "concatenated_string", "expression_list", "tuple"})


def is_alone(code: PyCode, function: Scope) -> bool:
    """Whether a method, or property, is the only one of its name, by which alone it runs."""
    is_written = [*function.decorators] in ([], ["property"])
    is_written = is_written or is_context(function.module, function)
    is_called = is_written and function.name[:2] != "__"
    others = [f for f in code.methods.get(function.name, ()) if f != function]
    return is_called and not any(f.module in _asking(code) for f in others)


def _asking(code: PyCode) -> list[Scope]:
    """The modules that may ask a node for its methods by name.

    The run-time part asks only those that it declares itself, for the classes that extend it.
    """
    found = [m for m in code.modules.values() if not is_runtime_file(m.py.source)]
    classes = [s for s in code.scopes.values() if s.kind == CLASS and s.module in found]
    for owner in classes:
        head = owner.node.child_by_field_name("superclasses")
        for base in named(head) if head is not None else ():
            if base.type not in ("keyword_argument", "subscript"):
                found += _of_base(code, owner.module, base)
    return found


def _of_base(code: PyCode, module: Scope, base: Node) -> Iterable[Scope]:
    """The modules that a base may be of, but the module itself."""
    whole, bound = imported_as(module, text_of(base)), module.names.get(text_of(base), ())
    if not whole and (base.type != "identifier" or any(b.how != "scope" for b in bound)):
        return code.modules.values()
    above = module_named(code, whole.rpartition(".")[0], module) if whole else None
    return () if above is None else (above,)


def is_context(module: Scope, function: Scope) -> bool:
    """Whether a function only makes contexts: `@contextmanager`."""
    whole = [imported_as(module, each) for each in function.decorators]
    return whole == ["contextlib.contextmanager"]


def takes_time(parameter: Node) -> bool:
    """Whether a parameter is said to be the time of a send, which no variable of a model holds."""
    said = (parameter.child_by_field_name(name) for name in ("type", "value"))
    words = (text_of(node).strip("\"'").rpartition(".")[2] for node in said if node is not None)
    return any(word in _TIMES for word in words)


def is_inlined(code: PyCode, function: Scope, callers: Iterable[Scope]) -> bool:
    """Whether what a method does stands where it is called: it takes a time of sends.

    All of the package that names it are calls of it by its object, in methods of the model.
    """
    is_async = any(child.type == "async" for child in function.node.children)
    if function.decorators or is_async or not any(map(takes_time, function.parameter_nodes)):
        return False
    asking = {id(m): m for m in _asking(code)}.values()
    named_so = sum(_names(function.name, m.node) for m in asking)
    calls = [text_of(field(call, "function")) for f in callers for call in calls_in(f.node)]
    return named_so == 1 + calls.count(f"self.{function.name}")


def _names(name: str, module: Node) -> int:
    """How often a module says a name, in code or in texts that may be asked for it."""
    word = re.compile(rf"\b{re.escape(name)}\b")
    said = (n for n in nodes_in(module) if n.type in ("identifier", "string"))
    said = (n for n in said if n.parent is None or not is_text(n.parent))
    return sum(1 for n in said if word.search(text_of(n)))


def is_beside(function: Scope) -> bool:
    """Whether a function gives what no variable of a model holds, such as a text: none has it.

    What it does where it is called is asked of the form.
    """
    said = function.node.child_by_field_name("return_type")
    if said is not None:
        return type_of(said) is None
    values = [v for r in function.returns for v in named(r)]
    return bool(values) and all(map(_is_beside, values))


def _is_beside(node: Node) -> bool:
    if node.type == "conditional_expression":
        then, _, otherwise = named(node)
        return _is_beside(then) and _is_beside(otherwise)
    return node.type in _BESIDE
