"""What launch files of ROS 2 start: their actions played in order, without starting anything."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import field, replace

import yaml

from rebsync.records import dataclass
from rebsync.reverse.launch.launched import (
    NOT_GIVEN,
    Launch,
    LaunchedCommand,
    LaunchedNode,
    LaunchedRemap,
)
from rebsync.reverse.launch.parameters import Parameter, ParameterValue, read_parameters
from rebsync.reverse.launch.ros2_actions import (
    Action,
    CommandAction,
    Condition,
    DeclareArgument,
    ForAll,
    FromFile,
    Group,
    Include,
    LaunchParameter,
    Let,
    NodeAction,
    Only,
    ParameterSource,
    Push,
    Remapping,
    Unlisted,
)
from rebsync.reverse.launch.ros2_words import LaunchContext, Words, below_share, evaluated
from rebsync.reverse.launch.ros2_worked import FALSE, TRUE
from rebsync.reverse.unknowns import Open, Text, Unknown
from rebsync.source import Source, Span
from rebsync.unions import assert_never

Load = Callable[[str], "Source | None"]
Actions = Callable[[Source], "tuple[Action, ...] | Unknown"]

_WILDCARD = "/**/ros__parameters/"
_MIDDLE = "/ros__parameters/"
_DEEPEST = 20
_COMPUTED = "it is computed when the file runs"


def nothing(_: str) -> Source | None:
    """No text at all."""
    return None


@dataclass(frozen=True, slots=True)
class _Scope:
    """What holds for the actions of one group or file."""

    source: Source
    variables: dict[str, Text]
    namespaces: list[Text]
    parameters: list[ParameterSource]
    remaps: list[Remapping]
    only_if: tuple[str, ...] = ()

    def inner(self, scoped: bool, only_if: tuple[str, ...] = ()) -> _Scope:
        """The scope of what is inside; what is set there stays there, if it is scoped."""
        conditions = self.only_if + only_if
        if not scoped:
            return replace(self, only_if=conditions)
        return _Scope(
            self.source,
            dict(self.variables),
            list(self.namespaces),
            list(self.parameters),
            list(self.remaps),
            conditions,
        )

    def text(self, words: Words) -> Text:
        return evaluated(words, LaunchContext(self.variables, self.source.path))


@dataclass(slots=True)
class Reader:
    """Plays the actions of files; `common` are the parameters that files give all nodes.

    `elsewhere` gives texts of other packages. `any_way`: nodes that arguments leave out count, too.
    """

    load: Load
    actions: Actions
    package: str = ""
    elsewhere: Load = nothing
    any_way: bool = False
    nodes: list[LaunchedNode] = field(default_factory=list)
    commands: list[LaunchedCommand] = field(default_factory=list)
    common: dict[str, Parameter] = field(default_factory=dict)
    files: dict[str, Source] = field(default_factory=dict)
    unknowns: list[Unknown] = field(default_factory=list)

    def result(self, source: Source) -> Launch:
        """All that a file and those that it includes say."""
        scope = _Scope(source, {}, [], [], [])
        self._file(scope, 0)
        for each in (
            () if self.nodes else scope.parameters
        ):  # a system of no nodes has constants, too
            tuple(self._parameters(each, "", "", scope))
        return Launch(
            tuple(self.nodes),
            tuple(self.common.values()),
            tuple(self.unknowns),
            (source, *self.files.values()),
            tuple(self.commands),
        )

    def _file(self, scope: _Scope, depth: int) -> None:
        found = self.actions(scope.source)
        if isinstance(found, Unknown):
            self.unknowns.append(found)
            return
        for action in found:
            self._action(action, scope, depth)

    def _action(self, action: Action, scope: _Scope, depth: int) -> None:
        match action:
            case NodeAction():
                self.nodes.append(self._node(action, scope))
            case CommandAction(texts, span):
                told = _given(texts, scope)
                self.commands.append(LaunchedCommand(told, scope.source, span))
            case DeclareArgument(name, default):
                self._declared(name, default, scope)
            case Let(name, value):
                self._set(name, scope.text(value), scope)
            case Push(namespace):
                scope.namespaces.append(self._text(namespace, "a namespace", scope))
            case ForAll(parameters, remaps):
                scope.parameters.extend(parameters)
                scope.remaps.extend(remaps)
            case Group(actions, scoped):
                inner = scope.inner(scoped)
                for each in actions:
                    self._action(each, inner, depth)
            case Include():
                self._include(action, scope, depth)
            case Only(condition, inner_action):
                self._only(condition, inner_action, scope, depth)
            case Unlisted(what, span, why):
                self._unknown(what, why, span, scope)
            case _:
                assert_never(action)

    # --- arguments, conditions, and files -------------------------------------------------------

    def _declared(self, name: Words, default: Words | None, scope: _Scope) -> None:
        key = self._text(name, "the name of an argument", scope)
        if isinstance(key, str) and key not in scope.variables:
            why = f"the argument `{key}` is not given, and has no default"
            scope.variables[key] = Open(why) if default is None else scope.text(default)

    def _set(self, name: Words, value: Text, scope: _Scope) -> None:
        key = self._text(name, "the name of an argument", scope)
        if isinstance(key, str):
            scope.variables[key] = value

    def _only(self, condition: Condition, action: Action, scope: _Scope, depth: int) -> None:
        value = scope.text(condition.words)
        word = value.strip().lower() if isinstance(value, str) else ""
        is_start = isinstance(action, NodeAction | CommandAction | Group | Include)
        if word in (FALSE if condition.holds else TRUE) and not (self.any_way and is_start):
            return
        decided = word in (*TRUE, *FALSE)
        # what is set only perhaps is set: a node with it is said to depend on the condition
        inner = scope.inner(False, () if decided else (condition.text,))
        self._action(action, inner, depth)

    def _include(self, include: Include, scope: _Scope, depth: int) -> None:
        arguments = [(name, scope.text(value)) for name, value in include.arguments]
        for name, value in arguments:
            self._set(name, value, scope)
        path = scope.text(include.path)
        if isinstance(path, Open):
            self._unknown("an included launch file", path.why, include.span, scope)
            return
        inside, file = self._at(path)
        if file is None or depth > _DEEPEST:
            why = "it is not at hand" if file is None else "files include each other too deeply"
            self._unknown("an included launch file", f"`{path}`: {why}", include.span, scope)
            return
        self.files.setdefault(inside, file)
        self._file(replace(scope, source=file), depth + 1)

    # --- nodes ----------------------------------------------------------------------------------

    def _node(self, start: NodeAction, scope: _Scope) -> LaunchedNode:
        name = self._given(start.name, "the name of a node", scope)
        namespace = self._namespace(start.namespace, scope)
        package = self._given(start.package, "the package of a node", scope)
        program = self._given(start.type, "the program of a node", scope)
        own: dict[str, Parameter] = {}
        for source in (*scope.parameters, *start.parameters):
            for parameter in self._parameters(source, name, namespace, scope):
                own[parameter.name] = parameter
        return LaunchedNode(
            name=name,
            namespace=namespace,
            package=package,
            type=program,
            parameters=tuple(own.values()),
            remaps=tuple(self._remaps((*scope.remaps, *start.remaps), scope)),
            arguments=(),
            nodelet=None,
            test=False,
            anonymous=False,
            only_if=scope.only_if,
            markers=start.markers,
            source=scope.source,
            span=start.span,
            texts=_given(start.texts, scope),
        )

    def _namespace(self, given: Words | None, scope: _Scope) -> Text:
        parts = list(scope.namespaces)
        if given is not None:
            parts.append(self._text(given, "the namespace of a node", scope))
        found = "/"
        for part in parts:
            if isinstance(part, Open):
                return part
            found = f"{part}/" if part.startswith("/") else f"{found}{part}/"
            found = found.replace("//", "/")
        return found

    def _remaps(
        self, given: tuple[Remapping | Unlisted, ...], scope: _Scope
    ) -> Iterator[LaunchedRemap]:
        for remap in given:
            if isinstance(remap, Unlisted):
                self._unknown(remap.what, remap.why, remap.span, scope)
                continue
            private = self._text(remap.private, "a remapping", scope)
            target = self._text(remap.target, "a remapping", scope)
            if isinstance(private, str):
                yield LaunchedRemap(private, target, scope.source, remap.span)

    # --- parameters -----------------------------------------------------------------------------

    def _parameters(
        self, source: ParameterSource, name: Text, namespace: Text, scope: _Scope
    ) -> Iterator[Parameter]:
        """The node's own; those of files for all nodes go to `common`."""
        match source:
            case LaunchParameter():
                found = self._parameter(source, scope)
                if found is not None:
                    yield found
            case FromFile(path):
                yield from self._from_file(path, name, namespace, scope)
            case Unlisted(what, span, why):
                self._unknown(what, why, span, scope)
            case _:
                assert_never(source)

    def _parameter(self, given: LaunchParameter, scope: _Scope) -> Parameter | None:
        name = self._text(given.name, "the name of a parameter", scope)
        if isinstance(name, Open):
            return None
        path = name.replace(".", "/")
        value: ParameterValue | Open
        if given.value is None:
            value = Open(_COMPUTED)
            self._unknown(f"the parameter `{path}`", _COMPUTED, given.span, scope)
        elif isinstance(given.value, Words):
            text = self._text(given.value, f"the parameter `{path}`", scope)
            value = text if isinstance(text, Open) or given.typed else from_yaml(text)
        else:
            value = given.value
        return Parameter(path, value, scope.source, given.span)

    def _from_file(
        self, words: Words, name: Text, namespace: Text, scope: _Scope
    ) -> Iterator[Parameter]:
        path = scope.text(words)
        if isinstance(path, Open):
            self._unknown("parameters of a node", path.why, words.span, scope)
            return
        inside, file = self._at(path)
        if file is None:
            why = f"`{path}` is not at hand"
            self._unknown("parameters of a node", why, words.span, scope)
            return
        if isinstance(name, Open) and _names_nodes(file):
            why = "which of its sections is for the node, whose name is not known here, is open"
            self._unknown("parameters of a node", why, words.span, scope)
        yield from self.parameter_file(inside, file, name, namespace)

    def parameter_file(
        self, path: str, file: Source, name: Text, namespace: Text
    ) -> Iterator[Parameter]:
        """What a file sets for one node; what it sets for all goes to `common`."""
        read = read_parameters(file)
        if path not in self.files:
            self.files[path] = file
            self.unknowns += read.unknowns
        for entry in read.entries:
            node, found, key = entry.name.partition(_MIDDLE)
            if not found:
                continue
            key = key.replace(".", "/")
            if entry.name.startswith(_WILDCARD):
                self.common[f"/{key}"] = replace(entry, name=f"/{key}")
            elif _is_for(node.replace("//", "/"), name, namespace):
                yield replace(entry, name=key)

    def _at(self, path: str) -> tuple[str, Source | None]:
        """The file of a path, and by which path it is known."""
        inside = below_share(path, self.package)
        file = self.load(inside) if inside is not None else None
        if inside is not None and file is not None:
            return inside, file
        return path, self.elsewhere(path)

    # --- texts and unknowns ---------------------------------------------------------------------

    def _given(self, words: Words | None, what: str, scope: _Scope) -> Text:
        return Open(NOT_GIVEN) if words is None else self._text(words, what, scope)

    def _text(self, words: Words, what: str, scope: _Scope) -> Text:
        found = scope.text(words)
        if isinstance(found, Open):
            self._unknown(what, found.why, words.span, scope)
        return found

    def _unknown(self, what: str, why: str, span: Span, scope: _Scope) -> None:
        unknown = Unknown(what, why, scope.source, span)
        if unknown not in self.unknowns:
            self.unknowns.append(unknown)


def _given(texts: tuple[Words, ...], scope: _Scope) -> tuple[str, ...] | Open:
    """What a program is given; open where one of the texts is."""
    found = [scope.text(words) for words in texts]
    opens = (each for each in found if isinstance(each, Open))
    return next(opens, None) or tuple(each for each in found if isinstance(each, str))


def _names_nodes(file: Source) -> bool:
    """Whether a parameter file has a section that is not for all nodes."""
    names = [e.name for e in read_parameters(file).entries]
    return any(_MIDDLE in n and not n.startswith(_WILDCARD) for n in names)


def _is_for(section: str, name: Text, namespace: Text) -> bool:
    """Whether a section of a parameter file is that of a node; `*` stands for one name."""
    if isinstance(name, Open):
        return False
    wanted = section.lstrip("/")
    if wanted in (name, f"**/{name}"):
        return True
    full = f"{namespace}{name}".lstrip("/") if isinstance(namespace, str) else name
    return wanted == full or (wanted == "*" and "/" not in full)


def from_yaml(text: str) -> ParameterValue | Open:
    """A text as the value of a parameter: as YAML has it, if that is a plain value."""
    try:
        found = yaml.safe_load(text)
    except yaml.YAMLError:
        return text
    return found if isinstance(found, bool | int | float | str) else _listed(found, text)


def _listed(found: object, text: str) -> ParameterValue | Open:
    if isinstance(found, list) and all(isinstance(v, bool | int | float | str) for v in found):
        return tuple(found)
    return text if found is None else Open("this is no value of a parameter")
