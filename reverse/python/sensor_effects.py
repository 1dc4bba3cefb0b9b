"""What functions of Python do that say what a sensor saw: their effects besides a value.

Whatever they give is among the model's choices.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator, Mapping

from rebsync.records import dataclass
from rebsync.reverse.build.built_python import files_of_import
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.python.import_effects import parsed
from rebsync.reverse.python.user_effects import UserEffects, names_in
from rebsync.source import Source, Span

_ASKED = "this runs when it is asked what a sensor saw"


def list_sensor_effects(
    sources: Mapping[str, Source], generated: Collection[str], findings: Findings
) -> None:
    """Lists what modules do where generated ones, by their paths, ask what a sensor saw."""
    trees = {path: parsed(source.text) or ast.Module([], []) for path, source in sources.items()}
    code = _SensorCode(sources, trees, frozenset(generated))
    asked = (path for path, source in sources.items() if source.path in generated)
    for path in asked:
        for looked in _asked(trees[path]):
            for source, node, why in code.acting(path, looked):
                start = source.start_of(node.lineno)
                line = source.text[start:].partition("\n")[0]
                findings.unreadable(source, Unread(Span(start, start + len(line)), why), "")


def _asked(tree: ast.Module) -> Iterator[ast.expr]:
    """What choices of the model are handed besides: what a sensor makes of its message."""
    for node in ast.walk(tree):
        match node:
            case ast.Call(func=ast.Attribute(attr="choose"), args=[_, given]):
                yield given
            case _:
                pass


@dataclass(frozen=True, slots=True)
class _SensorCode:
    """The modules of a package by their paths; `generated` are those of classes and run-time."""

    sources: Mapping[str, Source]
    trees: Mapping[str, ast.Module]
    generated: frozenset[str]

    def acting(
        self, path: str, given: ast.expr
    ) -> Iterator[tuple[Source, ast.expr | ast.stmt, str]]:
        """The places that may do more than to say what was seen."""
        source = self.sources[path]
        match given:
            case ast.Call(
                func=ast.Attribute(ast.Attribute(ast.Name("self"), member), "seen"), args=[looked]
            ) if member.endswith("_sensor"):
                pass
            case _:
                yield source, given, "no sensor is asked here"
                return
        waiting, names, reached = list[tuple[str, str]](), set[tuple[str, str]](), set[ast.stmt]()
        match looked:
            case ast.Name(name):
                waiting.append((path, name))
            case ast.Lambda():
                waiting += ((path, name) for name in names_in(looked))
                modelled = self._modelled(path) | {"self"}
                for at, why in UserEffects.of(self.trees[path], modelled).acting(looked):
                    yield source, at, f"{_ASKED}: {why}"
            case _:
                yield source, given, "only a function of a module says what a sensor saw"
        while waiting:
            if (place := waiting.pop()) in names:
                continue
            names.add(place)
            waiting += self._imported(*place)
            file = place[0]
            for node in self._declared(*place):
                if node not in reached:
                    reached.add(node)
                    waiting += ((file, name) for name in names_in(node))
                    for at, why in self._effects(file).acting(node):
                        yield self.sources[file], at, f"{_ASKED}: {why}"

    def _effects(self, path: str) -> UserEffects:
        return UserEffects.of(self.trees[path], self._modelled(path))

    def _declared(self, path: str, name: str) -> Iterator[ast.stmt]:
        """The statements of a module that bind a name, wherever they stand."""
        is_generated = self.sources[path].path in self.generated
        for node in ast.walk(self.trees[path]):
            match node:
                case ast.FunctionDef(name=own) | ast.ClassDef(name=own) if own == name:
                    yield node
                case ast.Assign() | ast.AnnAssign() if not is_generated and name in names_in(node):
                    yield node
                case _:
                    pass

    def _imported(self, path: str, name: str) -> Iterator[tuple[str, str]]:
        """What a module imports under a name from others of the package that users wrote."""
        for node in ast.walk(self.trees[path]):
            if isinstance(node, ast.ImportFrom):
                module = "." * node.level + (node.module or "")
                for item in (a.name for a in node.names if name == (a.asname or a.name)):
                    for file in files_of_import(module, path, self.trees):
                        if self.sources[file].path not in self.generated:
                            yield file, item

    def _modelled(self, path: str) -> frozenset[str]:
        """The names in a module that are of the package's classes and run-time part."""
        found = set[str]()
        for node in ast.walk(self.trees[path]):
            match node:
                case ast.Import(names=names):
                    whole = ((a, a.name.partition(".")[0]) for a in names)
                    found |= {a.asname or first for a, first in whole if self._is_own(first, path)}
                case ast.ImportFrom(module=of, names=names, level=level):
                    inside = "." * level + (of or "")
                    of_class = self._is_generated(inside, path)
                    found |= {
                        a.asname or a.name
                        for a in names
                        if of_class or self._is_generated(f"{inside}.{a.name}", path)
                    }
                case _:
                    pass
        return frozenset(found)

    def _is_own(self, module: str, path: str) -> bool:
        return any(True for _ in files_of_import(module, path, self.trees))

    def _is_generated(self, module: str, path: str) -> bool:
        files = files_of_import(module, path, self.trees)
        return any(self.sources[f].path in self.generated for f in files)
