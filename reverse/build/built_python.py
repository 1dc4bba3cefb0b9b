"""Which modules of Python no program of a package imports, though another of their content is.

A copy of a module that is left beside says nothing of what the robot does. Where a program may
import by a name that is known at run time only, everything counts.
"""

from __future__ import annotations

import ast
import posixpath
import re
from collections.abc import Collection, Iterable, Iterator, Mapping

from rebsync.records import dataclass
from rebsync.reverse.build.cmake import BUILD
from rebsync.reverse.files.packages import BESIDE
from rebsync.reverse.files.python_files import LAUNCHES, SETUP, SUFFIX, is_launch, is_python
from rebsync.reverse.syntax.py_module import module_of
from rebsync.source import Source

_DYNAMIC = frozenset(
    {"importlib", "__import__", "runpy", "pkgutil", "imp", "exec", "eval", "execfile"}
)
_WORD = re.compile(r"[\w.]+")
_DEFINES = re.compile(r"^(?:class|def)[ \t]+(\w+)", re.MULTILINE)
_INIT = "__init__.py"


@dataclass(frozen=True, slots=True)
class _Module:
    """What a file imports, as names with dots, and the classes and functions that it defines.

    An import begins with a dot for each folder that it goes up, as in the text.
    """

    imports: frozenset[str]
    defined: frozenset[str]
    is_program: bool


def unbuilt_python(files: Mapping[str, Source]) -> frozenset[str]:
    """The modules that no program imports, and that define anew what an imported one defines."""
    paths = [p for p, s in files.items() if p != SETUP and is_python(p, s)]
    if not _is_any_twice(files[path].text for path in paths):
        return frozenset()
    read = {path: _read(files[path].text) for path in paths}
    modules = {path: module for path, module in read.items() if module is not None}
    programs = _programs(files, modules)
    if len(modules) < len(read) or not programs:
        return frozenset()
    taken = {path for path in modules if path.startswith(BESIDE)}
    reached, waiting = programs | taken, [*programs, *taken]
    while waiting:
        path = waiting.pop()
        fresh = {
            p for n in modules[path].imports for p in files_of_import(n, path, modules)
        } - reached
        reached |= fresh
        waiting += fresh
    defined = frozenset[str]().union(*(modules[p].defined for p in reached))
    left = (p for p in modules if p not in reached)
    return frozenset(p for p in left if not defined.isdisjoint(modules[p].defined))


def _is_any_twice(texts: Iterable[str]) -> bool:
    """Whether two modules may define the same: else none need be parsed for this."""
    names = [name for text in texts for name in set(_DEFINES.findall(text)) - {"main"}]
    return len(set(names)) < len(names)


def _read(text: str) -> _Module | None:
    """A module; None where it cannot be read, or may import whatever there is."""
    tree = module_of(text)
    if tree is None:
        return None
    nodes = list(ast.walk(tree))
    imports = frozenset(imported_by(tree))
    used = {node.id for node in nodes if isinstance(node, ast.Name)}
    used |= {node.attr for node in nodes if isinstance(node, ast.Attribute)}
    if not _DYNAMIC.isdisjoint(used | {name.partition(".")[0] for name in imports}):
        return None
    kinds = (ast.ClassDef, ast.FunctionDef)
    defined = frozenset(n.name for n in tree.body if isinstance(n, kinds) and n.name != "main")
    is_guarded = any(isinstance(n, ast.If) and "__main__" in ast.dump(n.test) for n in tree.body)
    return _Module(imports, defined, is_guarded or text.startswith("#!"))


def imported_by(tree: ast.Module) -> Iterator[str]:
    """The names of modules that a file may import, wherever it does."""
    return (name for node in _statements(tree) for name in _imported(node))


def _statements(node: ast.AST) -> Iterator[ast.AST]:
    """The statements of a module at every depth, without their expressions."""
    for field in ("body", "orelse", "finalbody", "handlers", "cases"):
        inner = getattr(node, field, ())
        for child in inner if isinstance(inner, list) else ():
            yield child
            yield from _statements(child)


def _imported(node: ast.AST) -> Iterator[str]:
    """The modules that a statement imports, and what may be modules in them."""
    match node:
        case ast.Import(names=names):
            yield from (alias.name for alias in names)
        case ast.ImportFrom(module=module, names=names, level=level):
            inside = "." * level + (module or "")
            yield inside
            join = "" if inside.endswith(".") else "."
            yield from (f"{inside}{join}{alias.name}" for alias in names)
        case _:
            pass


def _programs(files: Mapping[str, Source], modules: Mapping[str, _Module]) -> set[str]:
    """What is run itself: what launch and build files name, and else whatever can be run."""
    naming = [s.text for p, s in files.items() if is_launch(p) or p in (SETUP, BUILD)]
    words = {word for text in naming for word in _WORD.findall(text)}
    found = {p for p in modules if p.endswith(LAUNCHES) or posixpath.basename(p) in words}
    found |= {p for p, m in modules.items() if m.is_program and _stem(p) in words}
    named = {p for word in words if "." in word for p in files_of_import(word, SETUP, modules)}
    setup = files.get(SETUP)
    if setup is None or "console_scripts" not in setup.text:
        return found | named | {p for p, m in modules.items() if m.is_program}
    return found | named if named else set()


def _stem(path: str) -> str:
    return posixpath.basename(path).removesuffix(SUFFIX)


def files_of_import(name: str, path: str, modules: Collection[str]) -> Iterator[str]:
    """The files that an import in a file may mean, and those of the packages that they are in."""
    plain = name.lstrip(".")
    up = len(name) - len(plain)
    inside = plain.replace(".", "/")
    folder = path
    for _ in range(up):
        folder = posixpath.dirname(folder)
    whole = posixpath.normpath(posixpath.join(folder, inside)) if up else inside
    forms = (f"{whole}{SUFFIX}", posixpath.normpath(f"{whole}/{_INIT}"))
    for each in modules:
        if each in forms or (not up and each.endswith(tuple(f"/{form}" for form in forms))):
            yield each
            yield from _around(each, modules)


def _around(path: str, modules: Collection[str]) -> Iterator[str]:
    """What runs first, because a module is in these packages."""
    while path:
        path = posixpath.dirname(path)
        if (init := posixpath.join(path, _INIT)) in modules:
            yield init
