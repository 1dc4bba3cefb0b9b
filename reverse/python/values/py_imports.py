"""What imports bring: modules of the files, or names of what is elsewhere."""

from __future__ import annotations

from rebsync.reverse.build.common_messages import COMMON
from rebsync.reverse.python.values.py_evaluator import PyEvaluator
from rebsync.reverse.python.values.py_worth import External, Module, Ways
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import PyCode, Scope, module_named, module_of
from rebsync.reverse.syntax.py_tree import field, text_of


def imported(values: PyEvaluator, binding: Binding, scope: Scope) -> Ways:
    """What an import binds to a name."""
    item = binding.value
    wanted = text_of(field(item, "name") if item.type == "aliased_import" else item)
    if binding.node.type == "import_statement":
        dotted = wanted if item.type == "aliased_import" else wanted.partition(".")[0]
        module = module_named(values.code, dotted, scope.module)
        return (Module(module) if module is not None else External(dotted),)
    source = module_of(binding.node)
    module = module_named(values.code, source, scope.module)
    if module is not None and wanted in module.names and module is not scope.module:
        return tuple(w for b in module.names[wanted] for w in values.bound(b, wanted, module))
    inner = module_named(values.code, f"{source.rstrip('.')}.{wanted}", scope.module)
    if source.endswith("."):
        inner = module_named(values.code, source + wanted, scope.module)
    return (Module(inner) if inner is not None else External(f"{source}.{wanted}"),)


def star_imported(code: PyCode, module: Scope, name: str) -> Module | External | None:
    """What `from x import *` may bring under a name: what is known comes before what is not."""
    others: list[str] = []
    for binding in module.names.get("*", []):
        source = module_of(binding.node)
        found = module_named(code, source, module)
        if found is not None and name in found.names:
            return Module(found)
        if found is None:
            others.append(source)
    if not name[:1].isupper():
        return None
    interfaces = [s for s in others if s.endswith((".msg", ".srv"))]
    known = [s for s in interfaces if f"{s.rpartition('.')[0]}/{name}" in COMMON]
    chosen = known or (interfaces if len(interfaces) == 1 else [])
    return External(f"{chosen[0]}.{name}") if chosen else None
