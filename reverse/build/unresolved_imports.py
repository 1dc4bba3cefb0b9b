"""Imports that fail: of modules and names that neither the package, Python nor a dependency has."""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator, Mapping

from rebsync.records import dataclass
from rebsync.reverse.build.built_python import files_of_import, imported_by
from rebsync.reverse.build.common_messages import WHOLE
from rebsync.reverse.build.dependencies import gives_module
from rebsync.reverse.build.manifests import name_in, read_manifest
from rebsync.reverse.build.standard_modules import gives, has_module, is_standard
from rebsync.reverse.files.packages import MANIFEST
from rebsync.reverse.files.python_files import SETUP, SUFFIX, is_python
from rebsync.reverse.syntax.py_module import bound_in, module_of
from rebsync.source import Source, Span

_INTERFACES = ("msg", "srv", "action")
_CAUGHT = frozenset({"ImportError", "ModuleNotFoundError", "Exception", "BaseException"})
_BY_PLATFORM = ("TYPE_CHECKING", "sys.version_info", "sys.platform", "os.name")
_MADE_OF = {
    ".msg": ("",),
    ".srv": ("", "Request", "Response"),
    ".action": (
        "",
        *(f"{a}{b}" for a in ("", "Action") for b in ("Goal", "Result", "Feedback")),
        "Action",
    ),
}


def unresolved_imports(
    files: Mapping[str, Source], changed: Collection[str], generated: Collection[str]
) -> Iterator[tuple[Source, Span, str]]:
    """The imports that fail when a generated package is run, each with why.

    `files` are all of it by their paths; of these `changed` are not as generated, and `generated`
    were once. What is as generated imports only that, so that its imports are looked at where they
    name a module that has changed.
    """
    packages = Importable.of(files)
    waiting = [path for path in packages.modules if path in generated]
    reached = set(waiting)
    while waiting:
        path = waiting.pop()
        tree = module_of(packages.modules[path].text) if path in changed else None
        names = imported_by(tree) if tree is not None else ()
        fresh = {p for n in names for p in files_of_import(n, path, packages.modules)} - reached
        reached |= fresh
        waiting += fresh
    stems = [path.removesuffix(SUFFIX).rpartition("/")[2] for path in changed]
    for path in sorted(reached):
        source = packages.modules[path]
        if path in changed or any(stem in source.text for stem in stems):
            yield from ((source, *found) for found in packages.unresolved(path))


@dataclass(frozen=True, slots=True)
class Importable:
    """What the modules of a package can import.

    `modules` are its files of Python by their paths, `interfaces` the names of its messages,
    services and actions by the packages that have them, and `depends` what package.xml names.
    """

    modules: Mapping[str, Source]
    interfaces: Mapping[str, Collection[str]]
    depends: Collection[str]

    @staticmethod
    def of(files: Mapping[str, Source]) -> Importable:
        """What the packages in a folder have."""
        manifests = {p: s for p, s in files.items() if p.rpartition("/")[2] == MANIFEST}
        interfaces: dict[str, set[str]] = {}
        for path, manifest in manifests.items():
            of = interfaces.setdefault(name_in(manifest) or "", set())
            for other in files:
                stem, _, kind = other.rpartition("/")[2].rpartition(".")
                if other.startswith(path.removesuffix(MANIFEST)):
                    of.update(f"{stem}{end}" for end in _MADE_OF.get(f".{kind}", ()))
        modules = {p: s for p, s in files.items() if is_python(p, s) and not p.endswith(SETUP)}
        depends = {d for manifest in manifests.values() for d in read_manifest(manifest).depends}
        return Importable(modules, interfaces, depends)

    def unresolved(self, path: str) -> Iterator[tuple[Span, str]]:
        """The imports of a module that fail, each with why.

        Nothing of those that catch it, or that are made on some platforms and versions only.
        """
        source = self.modules[path]
        tree = module_of(source.text)
        for node in _sure(tree.body) if tree is not None else ():
            for why in self._why(node, path):
                start = source.start_of(node.lineno)
                line = source.text[start:].partition("\n")[0]
                yield Span(start, start + len(line)), why

    def _why(self, node: ast.Import | ast.ImportFrom, path: str) -> Iterator[str]:
        match node:
            case ast.Import(names=names):
                for alias in names:
                    if not self._has_module(alias.name, path):
                        yield f'nothing here has the module "{alias.name}"'
            case ast.ImportFrom(module=module, names=names, level=level):
                whole = "." * level + (module or "")
                if not self._has_module(whole, path):
                    yield f'nothing here has the module "{whole}"'
                    return
                for alias in names:
                    if not self._gives(whole, alias.name, path):
                        yield f'"{whole}" does not define "{alias.name}"'

    def _has_module(self, name: str, path: str) -> bool:
        if name.startswith(".") or self._files(name, path):
            return not name.strip(".") or bool(self._files(name, path))
        top, _, inside = name.partition(".")
        if top in self.interfaces:
            return inside in ("", *_INTERFACES)
        if is_standard(name):
            return has_module(name)
        return gives_module(self.depends, top)

    def _gives(self, module: str, name: str, path: str) -> bool:
        if name == "*":
            return True
        top, _, inside = module.partition(".")
        if top in self.interfaces and inside in _INTERFACES:
            return name in self.interfaces[top]
        if own := self._files(module, path):
            join = "" if module.endswith(".") else "."
            return bool(self._files(f"{module}{join}{name}", path)) or any(
                bound is None or name in bound
                for bound in (bound_in(self.modules[f].text) for f in own)
            )
        if top in WHOLE and inside == "msg":
            return name in WHOLE[top]
        return not is_standard(module) or gives(module, name)

    def _files(self, name: str, path: str) -> list[str]:
        """The files that a name with dots may be, without the packages around them."""
        last = name.rpartition(".")[2]
        ends = (f"{last}{SUFFIX}", f"{last}/__init__{SUFFIX}")
        return [f for f in files_of_import(name, path, self.modules) if f.endswith(ends)]


def _sure(body: Collection[ast.stmt]) -> Iterator[ast.Import | ast.ImportFrom]:
    """The imports among some statements, and inside of them, that fail if what they name is not."""
    for node in body:
        match node:
            case ast.ImportFrom(module="__future__"):
                pass
            case ast.Import() | ast.ImportFrom():
                yield node
            case ast.If(test=test) if any(word in ast.unparse(test) for word in _BY_PLATFORM):
                pass
            case ast.Try(body=inner, handlers=handlers, orelse=others, finalbody=last):
                caught = any(map(_catches, handlers))
                yield from () if caught else _sure(inner)
                yield from _sure([*(s for h in handlers for s in h.body), *others, *last])
            case ast.With(items=items) if any("suppress(" in ast.unparse(i) for i in items):
                pass
            case _:
                for name in ("body", "orelse"):
                    yield from _sure(getattr(node, name, ()))


def _catches(handler: ast.ExceptHandler) -> bool:
    match handler.type:
        case None:
            return True
        case ast.Tuple(elts=kinds):
            return any(ast.unparse(kind) in _CAUGHT for kind in kinds)
        case kind:
            return ast.unparse(kind) in _CAUGHT
