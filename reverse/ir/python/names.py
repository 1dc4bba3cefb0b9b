"""What a name of Python stands for: a variable, a module, or what a library has."""

from __future__ import annotations

import builtins
from collections.abc import Iterator
from dataclasses import field as with_default

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir.python.symbols import Binder, ScopeKind, Symbols
from rebsync.reverse.ir.types import UNKNOWN, FunctionType, Type
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import CLASS, FUNCTION, PyCode, module_named, module_of
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import Py, field, named, text_in, text_of
from rebsync.source import Span

_OLD = {"raw_input", "unicode", "xrange", "long", "basestring", "reduce", "unichr", "execfile"}
BUILTINS = frozenset(dir(builtins)) | _OLD
_OF_MODULE = frozenset({"__name__", "__file__", "__doc__", "__package__", "__spec__"})


@dataclass(eq=False, slots=True)
class NameLookup:
    """The binders of all files, by their paths, which are also the names of the modules.

    `changing` are attributes that may be other than a method: what is stored under their names.
    """

    code: PyCode
    binders: dict[str, Binder] = with_default(default_factory=dict)
    changing: frozenset[str] | None = None
    _active: set[tuple[str, str]] = with_default(default_factory=set)

    def binder(self, path: str) -> Binder:
        """The binder of a file, made when it is first asked for."""
        found = self.binders.get(path)
        if found is None:
            found = self.binders[path] = Binder(self.code.modules[path].py, path)
        return found

    def resolve(self, name: str, scope: Symbols, place: Span) -> e.Expression:
        """What a use of a name in a scope stands for; `name` is mangled already."""
        binding = lookup(name, scope)
        if binding is scope and self._is_before(name, scope, place):
            binding = lookup(name, scope.parent) if scope.parent else None
        if binding is None:
            return self._free(name, module_scope(scope), place)
        if (found := self._import(name, binding)) is not None:
            return found
        if binding.kind is ScopeKind.CLASS:
            return e.Attribute(e.ClassReference(binding.name), name, dynamic=False, place=place)
        return variable(name, binding, scope, place)

    def _is_before(self, name: str, scope: Symbols, place: Span) -> bool:
        """Whether a use in the body of a class comes before what binds the name there."""
        if scope.kind is not ScopeKind.CLASS:
            return False
        py = self.binder(module_scope(scope).name).py
        end = scope.first[name]
        return place.start < py.characters(end, end).start

    def _free(self, name: str, module: Symbols, place: Span) -> e.Expression:
        """What no scope but the module may bind."""
        if self.binds_global(name, module):
            found = self._import(name, module)
            return found if found is not None else e.Global(module.name, name, place=place)
        binder = self.binder(module.name)
        if name in BUILTINS and not binder.star_imports:
            return e.LibraryReference(f"builtins.{name}", _type_of(name), place)
        return e.Global(module.name, name, place=place)

    def is_method(self, name: str) -> bool:
        """Whether an attribute of objects is a method of their classes as long as they live."""
        if self.changing is None:
            self.changing = _changing(self.code)
        return name not in self.changing and "*" not in self.changing

    def binds_global(self, name: str, module: Symbols) -> bool:
        """Whether a module binds a name, in its own body or in a function that says `global`."""
        if name in module.bound or name in _OF_MODULE:
            return True
        return name in self.binder(module.name).assigned_globals

    def _import(self, name: str, scope: Symbols) -> e.Expression | None:
        """What a name stands for that imports alone bind, all of them to the same."""
        imports = scope.imports.get(name, [])
        if not imports or scope.bound.get(name) != len(imports):
            return None
        module = module_scope(scope)
        if scope.parent is None and name in self.binder(module.name).assigned_globals:
            return None
        key = module.name, name
        if key in self._active:
            return None  # modules that import a name from each other
        self._active.add(key)
        found = {self.imported(node, item, module) for node, item in imports}
        self._active.discard(key)
        return found.pop() if len(found) == 1 else None

    def imported(self, node: Node, item: Node, module: Symbols) -> e.Expression | None:
        """What one part of an import brings: a module or a name of one."""
        wanted = text_of(field(item, "name") if item.type == "aliased_import" else item)
        if node.type == "future_import_statement":
            return e.LibraryReference(f"__future__.{wanted}")
        if node.type == "import_statement":
            whole = item.type == "aliased_import"
            return self.module(wanted if whole else wanted.partition(".")[0], module)
        source = module_of(node)
        found = self.module(source, module)
        if isinstance(found, e.ModuleReference) and found.name != module.name:
            inner = self.module_member(found, wanted)
            if inner is not None:
                return inner
        whole_name = source + wanted if source.endswith(".") else f"{source}.{wanted}"
        return self.module(whole_name, module)

    def module(self, dotted: str, module: Symbols) -> e.Expression:
        """The module of the program or of a library that a name stands for in a file."""
        found = module_named(self.code, dotted, self.code.modules[module.name])
        if found is None:
            return e.LibraryReference(dotted)
        return e.ModuleReference(found.py.source.path)

    def module_member(self, module: e.ModuleReference, name: str) -> e.Expression | None:
        """What a module of the program has under a name; None if its text does not say so."""
        scope = self.binder(module.name).module
        if not self.binds_global(name, scope):
            return None
        found = self._import(name, scope)
        is_own = isinstance(found, e.ModuleReference) and found.name == module.name
        return e.Global(module.name, name) if found is None or is_own else found


def lookup(name: str, scope: Symbols) -> Symbols | None:
    """The scope other than a module whose variable a name is in a scope."""
    at: Symbols | None = scope
    while at is not None and at.parent is not None:
        is_seen = at.kind is not ScopeKind.CLASS or at is scope
        if is_seen and name in at.globals:
            return None
        if is_seen and name in at.bound and name not in at.nonlocals:
            return at
        at = at.parent
    return None


def variable(name: str, binding: Symbols, scope: Symbols, place: Span) -> e.Local | e.Captured:
    """The variable of a function, seen from a scope in it."""
    own = binding.own_name(name)
    owner = binding.function
    if owner is scope.function:
        return e.Local(own, place=place)
    return e.Captured(owner.name, own, place=place)


def module_scope(scope: Symbols) -> Symbols:
    """The module that a scope stands in."""
    while scope.parent is not None:
        scope = scope.parent
    return scope


def free_variables(scope: Symbols) -> dict[tuple[str, str], e.Captured]:
    """The variables of enclosing functions that a scope and those in it use."""
    found: dict[tuple[str, str], e.Captured] = {}
    inside = {id(scope.function)}
    for at in _within(scope):
        inside.add(id(at.function))
        for name in sorted(at.uses | at.nonlocals | set(at.bound)):
            binding = lookup(name, at)
            if binding is None or binding.kind is ScopeKind.CLASS:
                continue
            owner = binding.function
            if id(owner) not in inside:
                own = binding.own_name(name)
                found[owner.name, own] = e.Captured(owner.name, own)
    return found


def captured_locals(scope: Symbols) -> frozenset[str]:
    """The locals of a function that functions within it share."""
    found: set[str] = set()
    for child in _functions_in(scope):
        found |= {own for owner, own in free_variables(child) if owner == scope.name}
    return frozenset(found)


def _functions_in(scope: Symbols) -> Iterator[Symbols]:
    """The functions and classes directly within a function."""
    for child in scope.children:
        if child.kind is ScopeKind.COMPREHENSION:
            yield from _functions_in(child)
        else:
            yield child


def _within(scope: Symbols) -> Iterator[Symbols]:
    yield scope
    for child in scope.children:
        yield from _within(child)


def _type_of(name: str) -> Type:
    found = getattr(builtins, name, None)
    return FunctionType() if callable(found) else UNKNOWN


_BY_NAME = (
    *(b"setattr", b"delattr", b"__dict__", b"__getattr__", b"__getattribute__", b"__class__"),
    b"vars",
)


def _changing(code: PyCode) -> frozenset[str]:
    """The names of attributes that are stored, computed or decorated anywhere; "*" for any."""
    found: set[str] = set()
    for scope in (*code.scopes.values(), *code.modules.values()):
        found.update(scope.attributes)
        found.update(name for _, name in scope.stores)
        if scope.kind == CLASS:
            found |= {
                name
                for name, bindings in scope.names.items()
                if len(bindings) > 1 or bindings[0].how != "scope"
            }
        elif scope.kind == FUNCTION and scope.is_method and scope.decorators:
            found.add(scope.name)
    # The run-time part stores by names only what `put` is handed, and only looks at the rest.
    own = [m.py for m in code.modules.values() if not is_runtime_file(m.py.source)]
    if any(word in py.plain.words for py in own for word in _BY_NAME):
        found.add("*")
    return frozenset(found).union(*(_put(py) for py in own if b"put" in py.plain.words))


def _put(py: Py) -> Iterator[str]:
    """The names of attributes that a file hands to `put`; "*" where that may be any."""
    for node in nodes_in(py.root):
        if node.type != "identifier" or text_of(node) != "put":
            continue
        call = node.parent
        if call is not None and call.type == "dotted_name":
            is_renamed = call.parent is not None and call.parent.type == "aliased_import"
            yield from "*" if is_renamed else ()
            continue
        is_called = call is not None and call.child_by_field_name("function") == node
        arguments = named(field(call, "arguments")) if call is not None and is_called else []
        yield (text_in(arguments[1]) if len(arguments) == 3 else None) or "*"
