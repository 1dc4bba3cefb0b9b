"""Carries out the commands of CMake files that decide what a package is made from."""

from __future__ import annotations

import posixpath
from collections.abc import Mapping, Sequence
from dataclasses import field
from fnmatch import fnmatchcase

from rebsync.records import dataclass
from rebsync.reverse.build.build_files import BuildFiles
from rebsync.reverse.build.cmake_targets import (
    EXECUTABLE,
    LIBRARY,
    TARGETLESS,
    TESTING,
    Folder,
    Invocation,
    Maker,
)
from rebsync.reverse.build.cmake_text import Command, CommandBlock, Item, Quote, read_cmake
from rebsync.reverse.build.cmake_values import CmakeVariables, known, sections
from rebsync.reverse.build.compiler_settings import CompilerSettings
from rebsync.reverse.files.packages import BESIDE
from rebsync.reverse.unknowns import Open, Text
from rebsync.source import Source, Span

BUILD = "CMakeLists.txt"
_MOST_STEPS = 20_000
_MOST_FILES = 200
_DEEPEST = 20
_TRUE = frozenset({"1", "on", "yes", "true", "y"})
_FALSE = frozenset({"0", "off", "no", "false", "n", "ignore", ""})
# ROS 1 is at home on Linux
_PLATFORM: dict[str, tuple[Text, ...]] = {
    **dict.fromkeys(("ANDROID", "APPLE", "MINGW", "MSVC", "WIN32"), ("FALSE",)),
    "UNIX": ("TRUE",),
}
_MODULES = "CMAKE_MODULE_PATH"
_IN_GLOBS = frozenset({"CONFIGURE_DEPENDS", "FOLLOW_SYMLINKS", "LIST_DIRECTORIES", "false"})


def build_of(files: Mapping[str, Source]) -> BuildFiles | None:
    """What the build files of a package say; None where it has none.

    `files` are those of the package that were read, by their paths in it: of these globs find some.
    """
    if BUILD not in files:
        return None
    return read_build(files[BUILD], Folder(files.get, lambda pattern: _found(files, pattern)))


def _found(files: Mapping[str, Source], pattern: str) -> list[str]:
    """The files that a pattern finds; `**/` stands for any folders, or none."""
    folder, deep, last = pattern.partition("**/")
    if not deep:
        folder, last = posixpath.split(pattern)
    own = (p for p in files if not p.startswith(BESIDE))
    near = (p for p in own if (p.startswith(folder) if deep else posixpath.dirname(p) == folder))
    return [path for path in near if fnmatchcase(posixpath.basename(path), last)]


def read_build(source: Source, folder: Folder | None = None) -> BuildFiles:
    """What the CMakeLists.txt of a package and those of its subdirectories say."""
    maker = Maker(folder or Folder())
    runner = _Runner(maker, [source])
    runner.file(source, CmakeVariables(values=dict(_PLATFORM)))
    if runner.steps > _MOST_STEPS:
        start = Command("", (), Span(0, 0))
        why = "too many commands are carried out; the rest is not read"
        maker.unknown("the build files", why, Invocation(start, [], CmakeVariables(), source))
    return BuildFiles(
        runner.project,
        tuple(maker.targets.values()),
        tuple(dict.fromkeys(maker.interfaces["msg"])),
        tuple(dict.fromkeys(maker.interfaces["srv"])),
        tuple(dict.fromkeys(maker.interfaces["action"])),
        tuple(dict.fromkeys(maker.programs)),
        tuple(maker.unknowns),
        tuple(runner.sources),
        frozenset(maker.foreign),
        frozenset(maker.packages),
        frozenset(maker.tests),
        tuple(runner.settings.macros),
        tuple(runner.settings.odd),
        runner.settings.written,
    )


@dataclass(slots=True)
class _Runner:
    maker: Maker
    sources: list[Source]
    project: str | None = None
    macros: dict[str, tuple[CommandBlock, Source]] = field(default_factory=dict)
    settings: CompilerSettings = field(default_factory=CompilerSettings)
    depth: int = 0
    steps: int = 0

    def file(self, source: Source, variables: CmakeVariables) -> None:
        read = read_cmake(source)
        self.maker.unknowns += read.unknowns
        self._run(read.items, variables, source)

    def _run(self, items: Sequence[Item], variables: CmakeVariables, source: Source) -> None:
        for item in items:
            self.steps += 1
            if self.steps > _MOST_STEPS:
                return
            if isinstance(item, Command):
                self._command(item, variables, source)
            elif item.head.name == "if":
                self._if(item, variables, source)
            elif item.head.name == "foreach":
                self._foreach(item, variables, source)
            elif item.head.name == "while":
                self._branches([("while", item.body)], variables, source)
            elif item.head.arguments:
                self.macros[item.head.arguments[0].text.lower()] = item, source

    # --- blocks -----------------------------------------------------------------------------------

    def _if(self, block: CommandBlock, variables: CmakeVariables, source: Source) -> None:
        branches: list[tuple[str, tuple[Item, ...]]] = []
        opening = " ".join(source.slice(block.head.span).split())
        for head, body in ((block.head, block.body), *block.others):
            decided = head.name == "else" or _decided(head, variables)
            if decided and not branches:
                self._run(body, variables, source)
                return
            if decided is not False:
                condition = " ".join(source.slice(head.span).split())
                branches.append((f"{opening} ... {condition}" if branches else condition, body))
            if decided:
                break
        self._branches(branches, variables, source)

    def _branches(
        self,
        branches: Sequence[tuple[str, tuple[Item, ...]]],
        variables: CmakeVariables,
        source: Source,
    ) -> None:
        """Carries out each of the bodies; what they set differently is open afterwards."""
        before, conditions = dict(variables.values), self.maker.only_if
        for condition, body in branches:
            self.maker.only_if = (*conditions, condition)
            inside = CmakeVariables(variables.folder, dict(before))
            self._run(body, inside, source)
            for name in before.keys() | inside.values.keys():
                if before.get(name) != inside.values.get(name):
                    why = f"`${{{name}}}` is set only `{condition}`"
                    variables.values[name] = (Open(why),)
            unsure = Open(f"it is set only `{condition}`")
            variables.exported |= dict.fromkeys(inside.exported, (unsure,))
        self.maker.only_if = conditions

    def _foreach(self, block: CommandBlock, variables: CmakeVariables, source: Source) -> None:
        words = variables.words(block.head.arguments)
        if not words or isinstance(words[0], Open):
            return
        name, items = words[0], words[1:]
        match known(items[:1]):
            case ["RANGE"]:
                items = [Open("loops over numbers are not read")]
            case ["IN"]:
                parts = sections(items[1:], ("LISTS", "ITEMS"))
                lists = known(parts.get("LISTS", []))
                items = [w for name_ in lists for w in variables.get(name_)]
                items += parts.get("ITEMS", [])
        before = variables.values.get(name)
        for item in items:
            variables.values[name] = (item,)
            self._run(block.body, variables, source)
        if before is None:
            variables.values.pop(name, None)
        else:
            variables.values[name] = before

    def _macro(self, block: CommandBlock, source: Source, call: Invocation) -> None:
        """Carries out a macro or function; parameters are variables in it."""
        if self.depth >= _DEEPEST:
            self.maker.unknown(f"`{call.command.name}(...)`", "it calls itself too often", call)
            return
        names = [argument.text for argument in block.head.arguments[1:]]
        given: dict[str, tuple[Text, ...]] = {f"ARGV{i}": (w,) for i, w in enumerate(call.words)}
        given |= {name: (word,) for name, word in zip(names, call.words, strict=False)}
        given |= {"ARGV": tuple(call.words), "ARGN": tuple(call.words[len(names) :])}
        given["ARGC"] = (str(len(call.words)),)
        inside = call.variables.copy()
        inside.values |= given
        self.depth += 1
        self._run(block.body, inside, source)
        self.depth -= 1
        call.variables.values |= inside.exported
        if block.head.name == "macro":
            set_ = {n: v for n, v in inside.values.items() if n not in given}
            call.variables.values |= set_

    # --- commands ---------------------------------------------------------------------------------

    def _command(self, command: Command, variables: CmakeVariables, source: Source) -> None:
        words = variables.words(command.arguments)
        call = Invocation(command, words, variables, source)
        self.settings.read(call, self.maker)
        match command.name:
            case "project":
                self._project(words, variables)
            case "set":
                _set(words, variables)
            case "unset":
                for name in known(words[:1]):
                    variables.values.pop(name, None)
            case "list" | "file" | "get_filename_component":
                self._value(command.name, words, variables)
            case "add_subdirectory":
                self._subdirectory(call)
            case "include":
                self._include(call)
            case name if name in self.macros:
                self._macro(*self.macros[name], call)
            case _:
                self._make(call)

    def _make(self, call: Invocation) -> None:
        match call.command.name:
            case name if name in EXECUTABLE | LIBRARY:
                self.maker.target(call)
            case "target_sources" | "target_link_libraries":
                self.maker.extend(call)
            case "set_target_properties":
                parts = sections(call.words, ("PROPERTIES",))
                self.maker.rename(call, parts[""], parts.get("PROPERTIES", []))
            case "set_property" if call.words[:1] == ["TARGET"]:
                parts = sections(call.words, ("TARGET", "PROPERTY"))
                self.maker.rename(call, parts["TARGET"], parts.get("PROPERTY", [])[:2])
            case "add_message_files" | "add_service_files" | "add_action_files":
                self.maker.interface(call)
            case "find_package":
                self.maker.packages.update(w for w in known(call.words) if not w.isupper())
            case "rosidl_generate_interfaces":
                self.maker.rosidl(call)
            case "install" | "catkin_install_python":
                self.maker.install(call)
            case name:
                call.variables.blur(known(call.words), f"`{name}(...)` may have set it")
                if name in TESTING:
                    folder = call.variables.folder
                    paths = (posixpath.join(folder, w) for w in known(call.words[1:]))
                    self.maker.tests.update(map(posixpath.normpath, paths))
                if name not in TARGETLESS:
                    self.maker.foreign.add(name)

    def _project(self, words: list[Text], variables: CmakeVariables) -> None:
        name = words[0] if words else Open("`project()` has no name")
        variables.values["PROJECT_NAME"] = (name,)
        if not variables.folder:
            variables.values["CMAKE_PROJECT_NAME"] = (name,)
            if isinstance(name, str) and self.project is None:
                self.project = name

    def _value(self, command: str, words: list[Text], variables: CmakeVariables) -> None:
        """Commands that work a variable out."""
        match command, words:
            case "list", ["APPEND" | "PREPEND" as way, str(name), *values]:
                old = variables.values.get(name, ())
                variables.set(name, [*old, *values] if way == "APPEND" else [*values, *old])
            case "file", ["GLOB" | "GLOB_RECURSE" as way, str(name), *patterns]:
                variables.set(name, self._glob(way, patterns, variables))
            case "get_filename_component", [str(name), path, str(part), *_]:
                variables.set(name, [_part(path, part)])
            case _:
                variables.blur(known(words), f"`{command}(...)` may have changed it")

    def _glob(self, way: str, patterns: list[Text], variables: CmakeVariables) -> list[Text]:
        if "RELATIVE" in patterns:
            at = patterns.index("RELATIVE")
            patterns = patterns[:at] + patterns[at + 2 :]
        found: list[Text] = []
        for pattern in patterns:
            if pattern in _IN_GLOBS:
                continue
            path = pattern if isinstance(pattern, Open) else variables.path(pattern)
            if isinstance(path, str) and way == "GLOB_RECURSE":
                path = posixpath.join(posixpath.dirname(path), "**", posixpath.basename(path))
            paths = None if isinstance(path, Open) else self.maker.folder.glob(path)
            if paths is None:
                found.append(Open(f"which files `{_shown(pattern)}` finds is not known"))
            else:
                found += [posixpath.relpath(p, variables.folder or ".") for p in sorted(paths)]
        return found

    def _subdirectory(self, call: Invocation) -> None:
        word = call.words[0] if call.words else Open("it has no name")
        folder = word if isinstance(word, Open) else call.variables.path(word)
        if isinstance(folder, Open):
            self.maker.unknown("a subdirectory", folder.why, call)
            return
        path = posixpath.join(folder, BUILD)
        inner = self.maker.folder.load(path)
        if inner is None or len(self.sources) >= _MOST_FILES:
            self.maker.unknown(f"the file `{path}`", "it is not at hand", call)
            return
        self.sources.append(inner)
        inside = call.variables.copy(folder)
        self.file(inner, inside)
        call.variables.values |= inside.exported

    def _include(self, call: Invocation) -> None:
        """Modules of CMake do not matter here; files of the package are carried out."""
        name = call.words[0] if call.words else ""
        inner = self._module(name, call) if isinstance(name, str) else None
        if inner is not None and self.depth < _DEEPEST and len(self.sources) < _MOST_FILES:
            self.sources.append(inner)
            self.depth += 1
            self.file(inner, call.variables)
            self.depth -= 1
            return
        if _MODULES in call.variables.values:
            self.maker.foreign.add("include")  # it may be a module of the package
        if isinstance(name, Open) or "." in name or "/" in name:
            what = " ".join(call.source.slice(call.command.span).split())
            self.maker.unknown(f"`{what}`", "included files are not read", call)
            for variable in call.variables.values:
                call.variables.values[variable] = (Open("an included file may have set it"),)

    def _module(self, name: str, call: Invocation) -> Source | None:
        """The file of the package that is included by a path, or by a name that is looked for."""
        folders = [w for w in call.variables.values.get(_MODULES, ()) if isinstance(w, str)]
        wanted = [name, *(posixpath.join(folder, f"{name}.cmake") for folder in folders)]
        paths = (call.variables.path(each) for each in wanted if each)
        found = (self.maker.folder.load(path) for path in paths if isinstance(path, str))
        return next(filter(None, found), None)


def _set(words: list[Text], variables: CmakeVariables) -> None:
    if not words or isinstance(words[0], Open):
        return
    name, values = words[0], words[1:]
    if values and values[-1] == "PARENT_SCOPE":
        variables.exported[name] = tuple(values[:-1])
        return
    if "CACHE" in values:
        values = values[: values.index("CACHE")]
    if values:
        variables.set(name, values)
    else:
        variables.values.pop(name, None)


def _decided(head: Command, variables: CmakeVariables) -> bool | None:
    """The value of a condition that is a constant, also in a variable or behind NOT."""
    arguments = head.arguments
    negated = bool(arguments) and arguments[0].text == "NOT"
    if len(arguments) != 1 + negated:
        return None
    text = variables.text(arguments[-1])
    if isinstance(text, str) and arguments[-1].quote is Quote.NONE and text in variables.values:
        words = variables.values[text]
        text = words[0] if len(words) == 1 else Open("it is a list")
    if isinstance(text, Open):
        return None
    word = text.lower()
    return (word in _TRUE) is not negated if word in _TRUE | _FALSE else None


def _shown(pattern: Text) -> str:
    return pattern if isinstance(pattern, str) else "*"


def _part(path: Text, part: str) -> Text:
    if isinstance(path, Open):
        return path
    name = posixpath.basename(path)
    match part:
        case "NAME":
            return name
        case "NAME_WE":
            return name.partition(".")[0]
        case "DIRECTORY" | "PATH":
            return posixpath.dirname(path)
        case _:
            return Open(f"the part {part} of a path is not read")
