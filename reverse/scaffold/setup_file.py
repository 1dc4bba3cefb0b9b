"""The facts of a `setup.py`: programs and files that are installed, and the packages of Python.

What it looks for in the folder, by `glob` and `find_packages`, are the files that are there.
"""

from __future__ import annotations

import ast
import posixpath
import re
from collections.abc import Collection, Iterable, Iterator
from fnmatch import fnmatchcase

from rebsync.records import dataclass
from rebsync.reverse.scaffold.fact import PYTHON_SETTING, Fact
from rebsync.reverse.scaffold.python_trees import bindings, plain, span_of
from rebsync.source import Source

_ENTRY = re.compile(r"\s*(\w+)\s*=\s*([\w.]+:\w+)\s*\Z")
_INIT = "/__init__.py"
_PACKAGE = "{package_name}"  # stands for the name of the package in paths
_TESTS = frozenset({"test", "tests"})
_OF_CATKIN = "generate_distutils_setup"
_SCRIPTS = frozenset({"console_scripts", "gui_scripts"})
_SETUP = frozenset({"setuptools.setup", "distutils.core.setup"})
# Arguments of `setup` by which other modules, or others in place of them, are installed.
BUILDING = frozenset(
    {"package_dir", "py_modules", "ext_modules", "cmdclass", "distclass", "scripts"}
    | {"options", "command_options", "script_args", "script_name"}
)


@dataclass(frozen=True, slots=True)
class SetupFile:
    """A `setup.py` of a package of a name; `files` are the paths of those in its folder."""

    source: Source
    tree: ast.Module
    package: str
    files: Collection[str]

    def facts(self) -> Iterator[Fact]:
        """All of them."""
        always = list(_always_run(self.tree.body))
        for node in ast.walk(self.tree):
            full = self._full(node.func) if isinstance(node, ast.Call) else ""
            if isinstance(node, ast.Call) and (full in _SETUP or full.endswith(_OF_CATKIN)):
                if full in _SETUP:
                    value = "called" if node in always else "called at times"
                    yield self._fact(PYTHON_SETTING, "setup", value, node)
                for given in node.keywords:
                    yield from self._given(given)

    def _given(self, given: ast.keyword) -> Iterator[Fact]:
        """What an argument of `setup` says."""
        match given:
            case ast.keyword("entry_points", value):
                yield from self._programs(value)
            case ast.keyword("data_files", ast.List(listed)):
                for each in listed:
                    for name, text in self._installed(each):
                        # elsewhere it may come in place of a program or a module
                        kind = "installed file" if name.startswith("share/") else PYTHON_SETTING
                        yield self._fact(kind, name, text, each)
            case ast.keyword("packages", value):
                yield self._fact("Python package", "packages", self._packages(value), value)
            case ast.keyword(str(name), value) if name in BUILDING:
                yield self._fact(PYTHON_SETTING, name, plain(value), value)
            case ast.keyword(None, value) if not self._is_of_catkin(value):
                yield self._fact(PYTHON_SETTING, "**", plain(value), value)
            case _:
                pass

    def _programs(self, points: ast.expr) -> Iterator[Fact]:
        """The programs of `console_scripts`; other entry points no node is started by."""
        table = self._bound(points)
        if not isinstance(table, ast.Dict):
            yield self._fact(PYTHON_SETTING, "entry_points", plain(table), points)
            return
        for key, value in zip(table.keys, table.values, strict=True):
            group = self._text(key) if key is not None else None
            listed = self._listed(self._bound(value)) if group in _SCRIPTS else []
            if group is None or listed is None:
                yield self._fact(PYTHON_SETTING, "entry_points", plain(value), value)
            for entry in filter(None, map(_ENTRY.match, listed or ())):
                target = re.sub(rf"^{re.escape(self.package)}\.", "", entry[2])
                yield self._fact("installed program", entry[1], target, self._place(value, entry))

    def _place(self, listed: ast.expr, entry: re.Match[str]) -> ast.expr:
        texts = (n for n in ast.walk(listed) if isinstance(n, ast.Constant))
        return next((n for n in texts if n.value == entry.string), listed)

    def _fact(self, kind: str, name: str, value: str, node: ast.AST) -> Fact:
        return Fact(kind, "", name, value, self.source, span_of(self.source, node))

    def _installed(self, entry: ast.expr) -> Iterator[tuple[str, str]]:
        """Where files are installed to, and what they are; one by one where they are known."""
        match entry:
            case ast.Tuple([to, from_]):
                folder, files = self._text(to), self._listed(from_)
                if folder is not None:
                    for file in [plain(from_)] if files is None else files:
                        last = file.rpartition("/")[2]
                        path = posixpath.normpath(f"{folder}/{last}")
                        yield self._named(path), self._named(file)
                    return
            case _:
                pass
        yield plain(entry), ""

    def _named(self, path: str) -> str:
        return re.sub(rf"\b{re.escape(self.package)}(?![^/.])", _PACKAGE, path)

    def _listed(self, node: ast.expr) -> list[str] | None:
        """The files that a list, or a look into the folder, gives."""
        match node:
            case ast.List(elements):
                texts = [self._text(e) for e in elements]
                return [t for t in texts if t is not None] if None not in texts else None
            case ast.Call(ast.Name("sorted"), [files], []) if "sorted" not in bindings(self.tree):
                return self._listed(files)
            case ast.Call(function, [pattern], []) if self._full(function) == "glob.glob":
                text = self._text(pattern)
                return [f for f in self.files if _matches(f, text)] if text is not None else None
            case _:
                return None

    def _packages(self, node: ast.expr) -> str:
        """The packages of Python that are installed; those of tests do not count."""
        match node:
            case ast.Call(function, [], keywords) if self._full(
                function
            ) == "setuptools.find_packages" and all(k.arg == "exclude" for k in keywords):
                excluded = [self._listed(k.value) for k in keywords]
                if None not in excluded:
                    return self._found({e for each in excluded if each for e in each})
            case _:
                pass
        return plain(node).replace(f"'{self.package}'", "package_name")

    def _found(self, excluded: Collection[str]) -> str:
        folders = {f.removesuffix(_INIT) for f in self.files if f.endswith(_INIT)}
        whole = (f for f in folders if all(above in folders for above in _above(f)))
        names = sorted(f.replace("/", ".") for f in whole)
        found = [n for n in names if not any(fnmatchcase(n, pattern) for pattern in excluded)]
        plain_ = [n for n in found if n.partition(".")[0] not in (*_TESTS, self.package)]
        is_whole = {n for n in names if n.partition(".")[0] == self.package} <= {*found}
        return "[package_name]" if is_whole and not plain_ and self.package in found else str(found)

    def _text(self, node: ast.expr) -> str | None:
        """The text that an expression gives, as far as it is known."""
        match node:
            case ast.Constant(str(text)):
                return text
            case ast.Name(name):
                return self._constant(name)
            case ast.JoinedStr(values):
                parts = [self._text(v) for v in values]
                return "".join(p for p in parts if p is not None) if None not in parts else None
            case ast.FormattedValue(value, -1, None):
                return self._text(value)
            case ast.BinOp(left, ast.Add(), right):
                first, second = self._text(left), self._text(right)
                return first + second if first is not None and second is not None else None
            case ast.Call(function, arguments, []) if self._full(function) == "os.path.join":
                parts = [self._text(a) for a in arguments]
                known = [p for p in parts if p is not None]
                return posixpath.join(*known) if known and None not in parts else None
            case _:
                return None

    def _is_of_catkin(self, value: ast.expr) -> bool:
        """Whether all that `setup` gets is what catkin makes of the manifest: as is usual."""
        made = self._value(value.id) if isinstance(value, ast.Name) else value
        return made is not None and ast.unparse(made).startswith(f"{_OF_CATKIN}(")

    def _bound(self, node: ast.expr) -> ast.expr:
        """What a name that is bound once stands for, or the expression itself."""
        value = self._value(node.id) if isinstance(node, ast.Name) else None
        return node if value is None else value

    def _constant(self, name: str) -> str | None:
        """The text that a name of the file stands for, if it is bound once."""
        match self._value(name):
            case ast.Constant(str(text)):
                return text
            case _:
                return None

    def _value(self, name: str) -> ast.expr | None:
        """What a name of the file stands for, if it is bound once."""
        stores = [
            n
            for n in ast.walk(self.tree)
            if isinstance(n, ast.Name) and n.id == name and not isinstance(n.ctx, ast.Load)
        ]
        for statement in self.tree.body if len(stores) == 1 else ():
            match statement:
                case ast.Assign([ast.Name(own)], value) if own == name:
                    return value
                case _:
                    pass
        return None

    def _full(self, function: ast.expr) -> str:
        """The full name of what is called, by the imports."""
        first, _, rest = ast.unparse(function).partition(".")
        of = bindings(self.tree).get(first) if first not in _defined(self.tree) else None
        return ".".join(filter(None, (of[0] if of is not None else "", rest)))


def _always_run(body: Iterable[ast.stmt]) -> Iterator[ast.expr]:
    """The expressions that stand alone as statements and run whenever the file is a program."""
    for statement in body:
        match statement:
            case ast.Expr(value):
                yield value
            case ast.If(test, inner, []) if ast.unparse(test) == "__name__ == '__main__'":
                yield from _always_run(inner)
            case _:
                pass


def _defined(tree: ast.Module) -> Iterator[str]:
    """The names that functions, classes, and assignments anywhere in a file may bind."""
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef(name) | ast.AsyncFunctionDef(name) | ast.ClassDef(name):
                yield name
            case ast.Name(name, ast.Store() | ast.Del()):
                yield name
            case _:
                pass


def _above(folder: str) -> list[str]:
    """The folders that one is in."""
    parts = folder.split("/")
    return ["/".join(parts[:n]) for n in range(1, len(parts))]


def _matches(file: str, pattern: str) -> bool:
    """Whether `glob` finds a file: no name that begins with a dot, and a star within one name."""
    names, patterns = file.split("/"), pattern.split("/")
    return len(names) == len(patterns) and all(
        fnmatchcase(n, p) and (not n.startswith(".") or p.startswith("."))
        for n, p in zip(names, patterns, strict=True)
    )
