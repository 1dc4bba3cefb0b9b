"""What a command line gives a node of ROS 2: `--ros-args` up to `--`.

After "ROS Command Line Arguments" of design.ros2.org.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import field

from rebsync.records import dataclass

_OWN = "--ros-args"
_WITH_VALUE = frozenset(
    {"-r", "--remap", "-p", "--param", "--params-file", "-e", "--enclave"}
    | {"--log-level", "--log-config-file"}
)
_NAMES, _SPACE = ("__node", "__name"), "__ns"


@dataclass(slots=True)
class RosArguments:
    """Remappings, parameters and their files in their order; what is no argument of ROS is left.

    A setting is the name of the node it is for, `*` for all, the parameter, and its text as YAML.
    Of `name` and `namespace` the first counts.
    """

    remaps: list[tuple[str, str]] = field(default_factory=list)
    settings: list[tuple[str, str, str] | str] = field(default_factory=list)
    name: str | None = None
    namespace: str | None = None
    left: list[str] = field(default_factory=list)

    @classmethod
    def of(cls, words: Sequence[str]) -> RosArguments:
        """Those among the arguments of a program; a file of settings stands as its path alone."""
        found = cls()
        for option, value in _options(words, found.left):
            match option:
                case "-r" | "--remap":
                    found._remap(value)
                case "-p" | "--param":
                    node, name, text = _rule(value)
                    found.settings.append((node, name, text))
                case "--params-file":
                    found.settings.append(value)
                case _:
                    pass
        return found

    def _remap(self, rule: str) -> None:
        _, name, target = _rule(rule)
        if name in _NAMES:
            self.name = self.name or target
        elif name == _SPACE:
            self.namespace = self.namespace or target
        else:
            self.remaps.append((name, target))


def _options(words: Sequence[str], left: list[str]) -> Iterator[tuple[str, str]]:
    """The options of ROS with their values; the other words go to `left`."""
    is_own = False
    waiting = iter(words)
    for word in waiting:
        if word == _OWN:
            is_own = True
        elif not is_own:
            left.append(word)
        elif word == "--":
            is_own = False
        elif word in _WITH_VALUE:
            yield word, next(waiting, "")


def _rule(text: str) -> tuple[str, str, str]:
    """A rule `node:name:=value`, as its three parts; for all nodes where it names none."""
    before, _, value = text.partition(":=")
    node, separator, name = before.rpartition(":")
    if not separator or node in ("rostopic", "rosservice"):
        return "*", name, value
    return node, name, value
