"""What launch files of ROS 2 start: their actions played in order, without starting anything."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import field, replace
from shlex import split

from rebsync.records import dataclass
from rebsync.reverse.launch.graph_names import as_namespace, join, resolve
from rebsync.reverse.launch.launched import (
    NOT_GIVEN,
    Launch,
    LaunchedCommand,
    LaunchedNode,
    LaunchedRemap,
)
from rebsync.reverse.launch.parameter_sections import of_node
from rebsync.reverse.launch.parameters import Parameter
from rebsync.reverse.launch.ros2_actions import (
    Action,
    CommandAction,
    Condition,
    DeclareArgument,
    ForAll,
    Group,
    Include,
    Let,
    NodeAction,
    Only,
    Push,
    Unlisted,
)
from rebsync.reverse.launch.ros2_arguments import RosArguments
from rebsync.reverse.launch.ros2_parameters import Ros2Parameters
from rebsync.reverse.launch.ros2_scope import Ros2Scope
from rebsync.reverse.launch.ros2_words import Words, below_share
from rebsync.reverse.launch.ros2_worked import FALSE, TRUE
from rebsync.reverse.unknowns import Open, Text, Unknown
from rebsync.source import Source, Span
from rebsync.unions import assert_never

Load = Callable[[str], "Source | None"]
Actions = Callable[[Source], "tuple[Action, ...] | Unknown"]

_DEEPEST = 20


def nothing(_: str) -> Source | None:
    """No text at all."""
    return None


@dataclass(slots=True)
class Reader:
    """Plays the actions of files.

    `elsewhere` gives texts of other packages. `any_way`: nodes that arguments leave out count, too.
    """

    load: Load
    actions: Actions
    package: str = ""
    elsewhere: Load = nothing
    any_way: bool = False
    nodes: list[LaunchedNode] = field(default_factory=list)
    commands: list[LaunchedCommand] = field(default_factory=list)
    unknowns: list[Unknown] = field(default_factory=list)
    _parameters: Ros2Parameters = field(init=False)
    _common_to_others: dict[str, Parameter] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._parameters = Ros2Parameters(self._at, self.unknowns)

    def result(self, source: Source) -> Launch:
        """All that a file and those that it includes say."""
        scope = Ros2Scope(source, self.unknowns, {}, [], [], [])
        self._file(scope, 0)
        if not self.nodes:
            self._parameters.of_nobody(scope)
        return Launch(
            tuple(self.nodes),
            tuple((self._parameters.common or self._common_to_others).values()),
            tuple(self.unknowns),
            (source, *self._parameters.files.values()),
            tuple(self.commands),
        )

    def _file(self, scope: Ros2Scope, depth: int) -> None:
        found = self.actions(scope.source)
        if isinstance(found, Unknown):
            self.unknowns.append(found)
            return
        for action in found:
            self._action(action, scope, depth)

    def _action(self, action: Action, scope: Ros2Scope, depth: int) -> None:
        match action:
            case NodeAction():
                self.nodes.append(self._node(action, scope))
            case CommandAction(texts, span):
                told = _texts(texts, scope)
                self.commands.append(LaunchedCommand(told, scope.source, span))
                if not isinstance(told, Open) and told[:2] == ("ros2", "run") and len(told) >= 4:
                    self.nodes.append(self._node(_run_by(texts, span), scope))
            case DeclareArgument(name, default):
                self._declared(name, default, scope)
            case Let(name, value):
                self._set(name, scope.text(value), scope)
            case Push(namespace):
                scope.namespaces.append(scope.known(namespace, "a namespace"))
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
                scope.note(what, why, span)
            case _:
                assert_never(action)

    # --- arguments, conditions, and files -------------------------------------------------------

    def _declared(self, name: Words, default: Words | None, scope: Ros2Scope) -> None:
        key = scope.known(name, "the name of an argument")
        if isinstance(key, str) and key not in scope.variables:
            why = f"the argument `{key}` is not given, and has no default"
            scope.variables[key] = Open(why) if default is None else scope.text(default)

    def _set(self, name: Words, value: Text, scope: Ros2Scope) -> None:
        key = scope.known(name, "the name of an argument")
        if isinstance(key, str):
            scope.variables[key] = value

    def _only(self, condition: Condition, action: Action, scope: Ros2Scope, depth: int) -> None:
        value = scope.text(condition.words)
        word = value.strip().lower() if isinstance(value, str) else ""
        is_start = isinstance(action, NodeAction | CommandAction | Group | Include)
        if word in (FALSE if condition.holds else TRUE) and not (self.any_way and is_start):
            return
        decided = word in (*TRUE, *FALSE)
        # what is set only perhaps is set: a node with it is said to depend on the condition
        inner = scope.inner(False, () if decided else (condition.text,))
        self._action(action, inner, depth)

    def _include(self, include: Include, scope: Ros2Scope, depth: int) -> None:
        arguments = [(name, scope.text(value)) for name, value in include.arguments]
        for name, value in arguments:
            self._set(name, value, scope)
        path = scope.text(include.path)
        if isinstance(path, Open):
            scope.note("an included launch file", path.why, include.span)
            return
        inside, file = self._at(path)
        if file is None or depth > _DEEPEST:
            why = "it is not at hand" if file is None else "files include each other too deeply"
            scope.note("an included launch file", f"`{path}`: {why}", include.span)
            return
        self._parameters.files.setdefault(inside, file)
        self._file(replace(scope, source=file), depth + 1)

    # --- nodes ----------------------------------------------------------------------------------

    def _node(self, start: NodeAction, scope: Ros2Scope) -> LaunchedNode:
        name = _given(start.name, "the name of a node", scope)
        namespace = _namespace(start.namespace, scope)
        package = _given(start.package, "the package of a node", scope)
        program = _given(start.type, "the program of a node", scope)
        words = _command_line(start, scope)
        own = join(namespace, name)
        common = dict(self._parameters.common)
        sections = self._parameters.of_node(start, words, own, scope)
        if isinstance(package, str) and package != self.package:
            # what only a program of others is given, nodes of this package are not
            self._common_to_others |= self._parameters.common
            self._parameters.common = common
        if isinstance(words, RosArguments):  # they stand before what launch_ros adds
            name, namespace = words.name or name, as_namespace(words.namespace or namespace)
        return LaunchedNode(
            name=name,
            namespace=namespace,
            package=package,
            type=program,
            parameters=of_node(sections, join(namespace, name)),
            remaps=tuple(_first(_remaps(start, words, scope), namespace, name)),
            arguments=(),
            nodelet=None,
            test=False,
            anonymous=False,
            only_if=scope.only_if,
            markers=start.markers,
            source=scope.source,
            span=start.span,
            texts=_texts(start.texts, scope),
            sections=sections,
        )

    def _at(self, path: str) -> tuple[str, Source | None]:
        """The file of a path, and by which path it is known."""
        inside = below_share(path, self.package)
        file = self.load(inside) if inside is not None else None
        if inside is not None and file is not None:
            return inside, file
        return path, self.elsewhere(path)


def _run_by(words: tuple[Words, ...], span: Span) -> NodeAction:
    """The node that `ros2 run PACKAGE PROGRAM ...` starts."""
    _, _, package, program, *given = words
    return NodeAction(None, None, package, program, (), (), (), span, words, tuple(given))


def _given(words: Words | None, what: str, scope: Ros2Scope) -> Text:
    return Open(NOT_GIVEN) if words is None else scope.known(words, what)


def _namespace(given: Words | None, scope: Ros2Scope) -> Text:
    parts = list(scope.namespaces)
    if given is not None:
        parts.append(scope.known(given, "the namespace of a node"))
    found = "/"
    for part in parts:
        if isinstance(part, Open):
            return part
        found = f"{part}/" if part.startswith("/") else f"{found}{part}/"
        found = found.replace("//", "/")
    return found


def _texts(texts: tuple[Words, ...], scope: Ros2Scope) -> tuple[str, ...] | Open:
    """What a program is given; open where one of the texts is."""
    found = [scope.text(words) for words in texts]
    opens = (each for each in found if isinstance(each, Open))
    return next(opens, None) or tuple(each for each in found if isinstance(each, str))


def _command_line(start: NodeAction, scope: Ros2Scope) -> RosArguments | Open:
    """What the words that a node is given say to ROS."""
    words: list[str] = []
    for given, before in ((start.arguments, ()), (start.ros_arguments, ("--ros-args",))):
        texts = _texts(given, scope)
        if isinstance(texts, Open):
            return texts
        try:
            words += before
            words += (w for t in texts for w in split(t)) if start.is_split else texts
        except ValueError as error:
            return Open(f"the shell cannot split the arguments: {error}")
    return RosArguments.of(words)


def _remaps(
    start: NodeAction, words: RosArguments | Open, scope: Ros2Scope
) -> Iterator[LaunchedRemap]:
    """The remappings of a node, in the order of its command line."""
    for told in words.remaps if isinstance(words, RosArguments) else ():
        yield LaunchedRemap(*told, scope.source, start.span)
    for remap in (*scope.remaps, *start.remaps):
        if isinstance(remap, Unlisted):
            scope.note(remap.what, remap.why, remap.span)
            continue
        private = scope.known(remap.private, "a remapping")
        target = scope.known(remap.target, "a remapping")
        if isinstance(private, str):
            yield LaunchedRemap(private, target, scope.source, remap.span)


def _first(remaps: Iterator[LaunchedRemap], namespace: Text, name: Text) -> Iterator[LaunchedRemap]:
    """The first of the remappings of each name: rcl takes the first rule that matches."""
    seen: list[Text] = []
    for remap in remaps:
        meant = resolve(remap.private, namespace, name)
        if isinstance(meant, Open) or meant not in seen:
            seen.append(meant)
            yield remap
