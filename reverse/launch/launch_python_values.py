"""Values in launch files in Python: texts, parameters and remappings, as far as they are written.

A name that is bound once stands for what it is bound to.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator, Mapping

from rebsync.reverse.launch.comprehensions import (
    COMPREHENSIONS,
    Comprehension,
    written_out,
)
from rebsync.reverse.launch.python_arguments import called, literal, named_arguments
from rebsync.reverse.launch.ros2_actions import (
    FromFile,
    LaunchParameter,
    ParameterSource,
    Remapping,
    Unlisted,
)
from rebsync.reverse.launch.ros2_words import (
    Computed,
    Environment,
    Here,
    LaunchVariable,
    Path,
    Share,
    Word,
    Words,
    Worked,
)
from rebsync.reverse.launch.ros2_worked import CLASSES
from rebsync.source import Source, Span

COMPUTED = Computed("it is computed when the file runs")
_MARKER = re.compile(r"\s*#\s*rebsync:\s*(.*?)\s*\Z")
_FOLDERS = frozenset({"FindPackageShare", "get_package_share_directory", "get_package_share_path"})
_DEEPEST = 40


class PythonValues:
    """What expressions of one file stand for."""

    def __init__(self, source: Source, names: Mapping[str, ast.expr]) -> None:
        self._source = source
        self._names = names
        self._lines = source.text.split("\n")
        self._lists: dict[ast.expr, ast.expr] = {}
        self.originals: dict[ast.Call, ast.Call] = {}

    def bound(self) -> Iterable[ast.expr]:
        """The values of all names that are bound once."""
        return self._names.values()

    def resolved(self, value: ast.expr) -> ast.expr:
        """What a name that is bound once stands for, and a comprehension over what is written."""
        for _ in self._names:
            if not isinstance(value, ast.Name) or value.id not in self._names:
                break
            value = self._names[value.id]
        return self._written_out(value) if isinstance(value, COMPREHENSIONS) else value

    def _written_out(self, value: Comprehension) -> ast.expr:
        """The list of a comprehension, the same one each time; itself where it is computed."""
        if value not in self._lists:
            self._lists[value] = value  # one that needs itself
            if (found := written_out(value, self.resolved)) is not None:
                self._lists[value] = found.value
                self.originals.update(found.originals)
        return self._lists[value]

    def walk(self, node: ast.AST) -> Iterator[ast.AST]:
        """All that stands in a tree, with what comprehensions give in place of them."""
        found = self.resolved(node) if isinstance(node, COMPREHENSIONS) else node
        yield found
        for child in ast.iter_child_nodes(found):
            yield from self.walk(child)

    def elements(self, value: ast.expr, depth: int = 0) -> list[ast.expr] | None:
        """The elements of a list, and of those unpacked in it or added; None: it is computed.

        What is unpacked and computed stays a `*`, of which nobody knows what it is.
        """
        if depth > _DEEPEST:
            return None
        match self.resolved(value):
            case ast.List(elts=items) | ast.Tuple(elts=items):
                inner = ((i, self._unpacked(i, depth)) for i in items)
                return [e for item, found in inner for e in ([item] if found is None else found)]
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                first, last = (self.elements(side, depth + 1) for side in (left, right))
                return None if first is None or last is None else [*first, *last]
            case _:
                return None

    def _unpacked(self, item: ast.expr, depth: int) -> list[ast.expr] | None:
        return self.elements(item.value, depth + 1) if isinstance(item, ast.Starred) else None

    # --- arguments ------------------------------------------------------------------------------

    def keywords(self, call: ast.Call) -> dict[str, ast.expr]:
        """The arguments that are given by name, and by `**` of tables that are written out."""
        return {
            name: value for name, value in named_arguments(call, self.resolved) if name is not None
        }

    def is_whole(self, call: ast.Call) -> bool:
        """Whether all arguments of a call are known, each of them once."""
        names = [name for name, _ in named_arguments(call, self.resolved)]
        is_spread = any(isinstance(a, ast.Starred) for a in call.args)
        return not is_spread and None not in names and len(set(names)) == len(names)

    # --- texts ----------------------------------------------------------------------------------

    def words_of(self, value: ast.expr | None) -> Words | None:
        """A text that may be missing."""
        return None if value is None else self.words(value)

    def words(self, value: ast.expr) -> Words:
        """A text; what is not understood of it is computed."""
        return Words(tuple(self._parts(value, 0)), self.span(value))

    def given_texts(self, given: Mapping[str, ast.expr], *names: str) -> tuple[Words, ...]:
        """What an action gives a program: lists by their names, and values of its environment."""
        lists = [self.resolved(given[name]) for name in names if name in given]
        tables = [self.resolved(given[n]) for n in ("env", "additional_env") if n in given]
        items = [i for each in lists for i in getattr(each, "elts", [each])]
        items += [i for each in tables for i in getattr(each, "values", [each])]
        return tuple(map(self.words, items))

    def listed(self, value: ast.expr | None) -> tuple[Words, ...]:
        """The texts of a list; one that is computed where it is none."""
        if value is None or (isinstance(value, ast.Constant) and value.value is None):
            return ()
        found = self.elements(value)
        return (self.computed(value),) if found is None else tuple(map(self.words, found))

    def computed(self, value: ast.expr) -> Words:
        """A text of which nothing is known."""
        return Words((COMPUTED,), self.span(value))

    def _parts(self, given: ast.expr, depth: int) -> list[Word]:
        value = self.resolved(given)
        if depth > _DEEPEST:
            return [COMPUTED]
        match value:
            case ast.Constant(value=str() as text):
                return [text]
            case ast.List(elts=items) | ast.Tuple(elts=items):
                return [p for item in items for p in self._parts(item, depth + 1)]
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                return [*self._parts(left, depth + 1), *self._parts(right, depth + 1)]
            case ast.BinOp(left=left, op=ast.Div(), right=right):
                return [self._joined([left, right], depth)]
            case ast.JoinedStr(values=pieces):
                return [p for piece in pieces for p in self._parts(piece, depth + 1)]
            case ast.FormattedValue(value=inner, conversion=-1, format_spec=None):
                number = literal(self.resolved(inner))
                if isinstance(number, int) and not isinstance(number, bool):
                    return [str(number)]
                return self._parts(inner, depth + 1)
            case ast.Call():
                return [self._substituted(value, depth)]
            case ast.Attribute(value=ast.Name(id="os"), attr="sep"):
                return ["/"]
            case ast.Attribute(attr="parent") | ast.Name(id="__file__"):
                return [self._place(value)]
            case _:
                return [COMPUTED]

    def _place(self, value: ast.expr) -> Word:
        """The launch file, `Path(__file__).resolve()`, or its folder, `dirname(__file__)`."""
        match self.resolved(value):
            case ast.Name(id="__file__"):
                return Here(False)
            case ast.Attribute(value=inner, attr="parent") if self._place(inner) == Here(False):
                return Here(True)
            case ast.Call(args=[inner]) as call:
                found = self._place(inner)
                if called(call) == "dirname":
                    return Here(True) if found == Here(False) else COMPUTED
                return found if called(call) in ("Path", "realpath", "abspath", "str") else COMPUTED
            case ast.Call(func=ast.Attribute(value=inner, attr="resolve" | "absolute"), args=[]):
                return self._place(inner)
            case _:
                return COMPUTED

    def _substituted(self, call: ast.Call, depth: int) -> Word:
        name, args, given = called(call), call.args, self.keywords(call)
        if not self.is_whole(call):
            return COMPUTED
        first = args[0] if args else None

        def inner(value: ast.expr | None) -> Words | None:
            if value is None or (isinstance(value, ast.Constant) and value.value is None):
                return None
            return Words(tuple(self._parts(value, depth + 1)), self.span(value))

        match name:
            case "LaunchConfiguration":
                key = inner(first or given.get("variable_name"))
                return LaunchVariable(key, inner(given.get("default"))) if key else COMPUTED
            case "EnvironmentVariable":
                key = inner(first or given.get("name"))
                default = given.get("default_value", args[1] if len(args) > 1 else None)
                return Environment(key, inner(default)) if key else COMPUTED
            case "TextSubstitution":
                return self._single(inner(given.get("text", first)))
            case "FindExecutable":
                return self._single(inner(given.get("name", first)))
            case "ThisLaunchFileDir" | "ThisLaunchFile":
                return Here(name.endswith("Dir"))
            case "PathJoinSubstitution" if first is not None:
                listed = self.resolved(first)
                return self._joined(getattr(listed, "elts", [listed]), depth)
            case "join" if args:
                return self._joined(args, depth)
            case "dirname" | "resolve" | "realpath" | "abspath" | "absolute":
                return self._place(call)
            case _ if name in CLASSES:
                given_ = [*args, *given.values()]
                return Worked(CLASSES[name], tuple(w for a in given_ if (w := inner(a))))
            case "str" if not args:
                return ""
            case "str" if isinstance(first, ast.Constant) and isinstance(first.value, int | float):
                return str(first.value)
            case "Path" | "str" if len(args) == 1 and (place := self._place(call)) != COMPUTED:
                return place
            case "Path" | "str" if len(args) == 1:
                return self._single(inner(first))
            case _ if name in _FOLDERS:
                package = inner(first or given.get("package") or given.get("package_name"))
                return Share(package) if package else COMPUTED
            case _:
                return COMPUTED

    def compared(self, call: ast.Call) -> Words | None:
        """What `LaunchConfigurationEquals(name, text)` and its contrary compare."""
        by_name = dict(zip(("name", "value"), call.args, strict=False)) | self.keywords(call)
        names = {"launch_configuration_name": "name", "expected_value": "value"}
        given = {names.get(key, key): value for key, value in by_name.items()}
        known = called(call) in ("LaunchConfigurationEquals", "LaunchConfigurationNotEquals")
        if not known or "name" not in given or "value" not in given:
            return None
        variable = Words((LaunchVariable(self.words(given["name"])),), self.span(call))
        return Words((Worked("same", (variable, self.words(given["value"]))),), self.span(call))

    def _single(self, words: Words | None) -> Word:
        """A text as one of its parts."""
        return Path((words,)) if words is not None else COMPUTED

    def _joined(self, items: list[ast.expr], depth: int) -> Word:
        return Path(tuple(Words(tuple(self._parts(i, depth + 1)), self.span(i)) for i in items))

    # --- parameters and remappings --------------------------------------------------------------

    def parameters(self, value: ast.expr | None) -> Iterator[ParameterSource]:
        """What the parameters of a node come from."""
        if value is None:
            return
        listed = self.elements(value)
        for item in [self.resolved(value)] if listed is None else listed:
            found = self._unwrapped(self.resolved(item))
            if isinstance(found, ast.Dict):
                yield from self._table(found, "")
            elif self._is_path(found):
                yield FromFile(Words(tuple(self._parts(found, 0)), self.span(item)))
            else:
                yield Unlisted("parameters of a node", self.span(item))

    def _unwrapped(self, value: ast.expr) -> ast.expr:
        """What is in `ParameterFile(...)`."""
        if isinstance(value, ast.Call) and called(value) == "ParameterFile":
            file = value.args[0] if value.args else self.keywords(value).get("param_file", value)
            return self.resolved(file)
        return value

    def _is_path(self, value: ast.expr) -> bool:
        match value:
            case ast.Call():
                return self._substituted(value, 0) != COMPUTED
            case ast.Constant(value=str()) | ast.BinOp() | ast.List() | ast.JoinedStr():
                return True
            case ast.Attribute(attr="parent"):
                return self._place(value) != COMPUTED
            case _:
                return False

    def _table(self, table: ast.Dict, prefix: str) -> Iterator[ParameterSource]:
        for key, item in zip(table.keys, table.values, strict=True):
            name = literal(self.resolved(key)) if key is not None else None
            if not isinstance(name, str):
                yield Unlisted("the name of a parameter", self.span(key or item))
                continue
            path, value = prefix + name.replace(".", "/"), self.resolved(item)
            if isinstance(value, ast.Dict):
                yield from self._table(value, f"{path}/")
            else:
                yield self.given(Words((path,), self.span(key or item)), item)

    def given(self, name: Words, item: ast.expr) -> LaunchParameter:
        """A parameter with the value that an expression gives it."""
        value, span = self.resolved(item), self.span(item)
        found = literal(value)
        if isinstance(value, ast.Constant) and isinstance(found, str):  # launch_ros: YAML
            return LaunchParameter(name, Words((found,), span), span)
        if found is not None:
            return LaunchParameter(name, found, span)
        typed = False
        if isinstance(value, ast.Call) and called(value) == "ParameterValue" and value.args:
            kind = self.keywords(value).get("value_type")
            typed = isinstance(kind, ast.Name) and kind.id == "str"
            value = self.resolved(value.args[0])
        parts = tuple(self._parts(value, 0))
        known = parts != (COMPUTED,) and not isinstance(value, ast.Constant)
        return LaunchParameter(name, Words(parts, span) if known else None, span, typed)

    def remaps(self, value: ast.expr | None) -> Iterator[Remapping | Unlisted]:
        """The remappings of a node."""
        if value is None:
            return
        found = self.resolved(value)
        listed = found.elts if isinstance(found, ast.Set) else self.elements(found)
        if listed is None:
            yield Unlisted("the remappings of a node", self.span(value))
            return
        for given in listed:
            item = self.resolved(given)
            if isinstance(item, ast.Tuple | ast.List) and len(item.elts) == 2:
                yield self.remap(item.elts[0], item.elts[1], item)
            else:
                yield Unlisted("a remapping", self.span(given))

    def remap(self, private: ast.expr, target: ast.expr, place: ast.expr) -> Remapping:
        """One remapping."""
        return Remapping(self.words(private), self.words(target), self.span(place))

    def arguments(self, value: ast.expr | None) -> tuple[tuple[Words, Words], ...] | None:
        """The arguments for an included file; None where they are computed."""
        if value is None:
            return ()
        found = self.resolved(value)
        if isinstance(found, ast.Call) and called(found) == "items":
            holder = found.func.value if isinstance(found.func, ast.Attribute) else found
            found = self.resolved(holder)
        if isinstance(found, ast.Dict):
            pairs = zip(found.keys, found.values, strict=True)
            named = [(self.words(k), self.words(v)) for k, v in pairs if k is not None]
            return tuple(named) if None not in found.keys else None
        if isinstance(found, ast.List | ast.Tuple):
            items = [self.resolved(i) for i in found.elts]
            two = [i.elts for i in items if isinstance(i, ast.Tuple) and len(i.elts) == 2]
            if len(two) == len(items):
                return tuple((self.words(k), self.words(v)) for k, v in two)
        return None

    # --- places ---------------------------------------------------------------------------------

    def markers(self, line: int) -> list[str]:
        """The comments `rebsync: ...` right above a line, which is counted from 1."""
        found: list[str] = []
        for text in reversed(self._lines[: line - 1]):
            match = _MARKER.match(text)
            if match is None:
                break
            found.insert(0, match[1])
        return found

    def shown(self, node: ast.expr) -> str:
        """An expression as the file writes it, on one line."""
        return " ".join(self._source.slice(self.span(node)).split())

    def span(self, node: ast.expr | ast.stmt) -> Span:
        """The place of an expression or a statement."""
        end_line, end_column = node.end_lineno or node.lineno, node.end_col_offset or 0
        return Span(self._at(node.lineno, node.col_offset), self._at(end_line, end_column))

    def _at(self, line: int, column: int) -> int:
        """The offset of a place whose column counts bytes."""
        before = self._lines[line - 1].encode()[:column].decode(errors="ignore")
        return self._source.start_of(line) + len(before)
