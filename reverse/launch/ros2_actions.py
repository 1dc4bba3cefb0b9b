"""What launch files of ROS 2 say, however they are written: actions in their order."""

from __future__ import annotations

from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.launch.parameters import ParameterValue
from rebsync.reverse.launch.ros2_words import Words
from rebsync.source import Span


@dataclass(frozen=True, slots=True)
class Condition:
    """What must hold for an action: that `words` is true, or that it is not.

    `text` is how the file writes it, for people.
    """

    words: Words
    holds: bool
    text: str


@dataclass(frozen=True, slots=True)
class LaunchParameter:
    """A parameter; a text that is not `typed` is read as YAML, as launch_ros does.

    None as the value: it is computed.
    """

    name: Words
    value: ParameterValue | Words | None
    span: Span
    typed: bool = False


@dataclass(frozen=True, slots=True)
class FromFile:
    """Parameters from a file."""

    path: Words


@dataclass(frozen=True, slots=True)
class Unlisted:
    """Parameters, remappings or actions that only running the file tells."""

    what: str
    span: Span
    why: str = "it is computed when the file runs"


ParameterSource: TypeAlias = "LaunchParameter | FromFile | Unlisted"


@dataclass(frozen=True, slots=True)
class Remapping:
    """A name of the node, and what it stands for."""

    private: Words
    target: Words
    span: Span


@dataclass(frozen=True, slots=True)
class NodeAction:
    """A node, or a component that a container runs; None for what is not given.

    `texts` are those of its command line and of its environment. `arguments` are the words of its
    command line, `ros_arguments` those behind `--ros-args`; with `is_split` a shell splits them.
    """

    name: Words | None
    namespace: Words | None
    package: Words | None
    type: Words | None
    parameters: tuple[ParameterSource, ...]
    remaps: tuple[Remapping | Unlisted, ...]
    markers: tuple[str, ...]
    span: Span
    texts: tuple[Words, ...] = ()
    arguments: tuple[Words, ...] = ()
    ros_arguments: tuple[Words, ...] = ()
    is_split: bool = False


@dataclass(frozen=True, slots=True)
class CommandAction:
    """A program that is started as a shell does it, by its command line."""

    texts: tuple[Words, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class DeclareArgument:
    """An argument, with its default."""

    name: Words
    default: Words | None


@dataclass(frozen=True, slots=True)
class Let:
    """A configuration that is set from here on."""

    name: Words
    value: Words


@dataclass(frozen=True, slots=True)
class Push:
    """A namespace for the nodes that follow."""

    namespace: Words


@dataclass(frozen=True, slots=True)
class ForAll:
    """Parameters and remappings for the nodes that follow."""

    parameters: tuple[ParameterSource, ...] = ()
    remaps: tuple[Remapping, ...] = ()


@dataclass(frozen=True, slots=True)
class Group:
    """Actions together; what they set ends with them, if `scoped`."""

    actions: tuple[Action, ...]
    scoped: bool = True


@dataclass(frozen=True, slots=True)
class Include:
    """Another launch file, with arguments for it."""

    path: Words
    arguments: tuple[tuple[Words, Words], ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Only:
    """An action that depends on a condition."""

    condition: Condition
    action: Action


Action: TypeAlias = (
    "NodeAction | CommandAction | DeclareArgument | Let | Push | ForAll | Group | Include | Only"
    " | Unlisted"
)
