"""What holds for the actions of one group or file of a launch description of ROS 2."""

from __future__ import annotations

from dataclasses import replace

from rebsync.records import dataclass
from rebsync.reverse.launch.ros2_actions import ParameterSource, Remapping
from rebsync.reverse.launch.ros2_words import LaunchContext, Words, evaluated
from rebsync.reverse.unknowns import Open, Text, Unknown
from rebsync.source import Source, Span


@dataclass(frozen=True, slots=True)
class Ros2Scope:
    """The configurations, namespaces, parameters and remappings that are set where an action is.

    `unknowns` collects what is not known, of all scopes of a reading.
    """

    source: Source
    unknowns: list[Unknown]
    variables: dict[str, Text]
    namespaces: list[Text]
    parameters: list[ParameterSource]
    remaps: list[Remapping]
    only_if: tuple[str, ...] = ()

    def inner(self, scoped: bool, only_if: tuple[str, ...] = ()) -> Ros2Scope:
        """The scope of what is inside; what is set there stays there, if it is scoped."""
        conditions = self.only_if + only_if
        if not scoped:
            return replace(self, only_if=conditions)
        return Ros2Scope(
            self.source,
            self.unknowns,
            dict(self.variables),
            list(self.namespaces),
            list(self.parameters),
            list(self.remaps),
            conditions,
        )

    def text(self, words: Words) -> Text:
        """The text that words stand for here."""
        return evaluated(words, LaunchContext(self.variables, self.source.path))

    def known(self, words: Words, what: str) -> Text:
        """The same; that it is open is noted."""
        found = self.text(words)
        if isinstance(found, Open):
            self.note(what, found.why, words.span)
        return found

    def note(self, what: str, why: str, span: Span) -> None:
        """Notes something that is not known, once."""
        unknown = Unknown(what, why, self.source, span)
        if unknown not in self.unknowns:
            self.unknowns.append(unknown)
