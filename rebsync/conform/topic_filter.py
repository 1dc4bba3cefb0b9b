"""Which messages of a recording are looked at: those of one run of the model."""

from __future__ import annotations

from typing import Protocol

from rebsync.conform.topics import Topic, Topics
from rebsync.diagnostics import RebsyncError


class TopicChoice(Protocol):
    """Which topics of a recording are read, and what makes events of their messages."""

    def topic(self, name: str, path: str) -> Topic | None:
        """The topic of a name on the wire; None: its messages are not looked at."""
        ...


class TopicFilter:
    """The topics of a model in one namespace: the chosen one, else the only one with states.

    `with_sent`: messages between rebecs, too.
    """

    def __init__(self, topics: Topics, namespace: str | None, with_sent: bool = False) -> None:
        self.topics = topics
        self.with_sent = with_sent
        self._is_chosen = namespace is not None
        self._namespace = None if namespace is None else namespace.strip("/")
        self.other_topics: set[str] = set()

    def topic(self, name: str, path: str) -> Topic | None:
        """The topic of a name on the wire; None when it is none of the run.

        RebsyncError: states are in a second namespace, and nobody has chosen.
        """
        found = self.topics.find(name, self.with_sent)
        if found is None:
            self.other_topics.add(name)
            return None
        namespace, topic = found
        if topic.is_state and self._namespace is None:
            self._namespace = namespace
        if topic.name == "clock" or self._namespace in (None, namespace):
            return topic
        if topic.is_state and not self._is_chosen:
            message = f'states are in the namespaces "/{self._namespace}" and "/{namespace}"'
            raise RebsyncError.of(path, "RS985", message, "choose one with --namespace")
        return None
