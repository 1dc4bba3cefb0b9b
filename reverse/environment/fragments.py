"""An environment that people write: classes of Timed Rebeca that name the topics of a package.

`@Publish msgsrv bumper(boolean data) { }` is the topic `/bumper`: what its class sends to itself
there is published. `@Subscribe msgsrv cmd_vel(double linear_x) { ... }` serves what the package
publishes to `/cmd_vel`. A parameter is the field of that path. One rebec of each class is started.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import field

from rebsync import model as m
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, did_you_mean
from rebsync.grammars.parser import parse_model
from rebsync.records import dataclass
from rebsync.reverse.build.message_types import Fields
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.nodes.node_joined import Observed
from rebsync.reverse.nodes.node_names import model_word
from rebsync.source import Source, Span
from rebsync.static import analyse
from rebsync.static.annotations import KNOWN_ANNOTATIONS

PUBLISH, SUBSCRIBE = "Publish", "Subscribe"
_SHOWN = 6
_HINTS = {PUBLISH: "subscribes to", SUBSCRIBE: "publishes"}


@dataclass(frozen=True, slots=True)
class TopicServer:
    """A server of an environment's class that stands for a topic, with the fields that it names."""

    owner: str
    server: str
    topic: str
    paths: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Fragment:
    """An environment, as its file says it; each server is one of the classes'."""

    heads: tuple[m.Head, ...]
    classes: tuple[m.ReactiveClass, ...]
    published: tuple[TopicServer, ...]
    heard: tuple[TopicServer, ...]

    @property
    def observed(self) -> Observed:
        """The fields of what the package publishes that the environment gets, by topics."""
        found: dict[str, dict[str, None]] = {}
        for each in self.heard:
            found.setdefault(each.topic, {}).update(dict.fromkeys(each.paths))
        return {topic: tuple(paths) for topic, paths in found.items()}


def read_fragment(
    source: Source, heard: Mapping[str, Fields], published: Mapping[str, Fields], taken: set[str]
) -> Fragment:
    """The environment that a file says. RebsyncError: it has mistakes, or does not fit the package.

    `heard` are the topics to which the package subscribes, `published` those to which it publishes,
    with the fields of their messages; the names of its classes are `taken`.
    """
    parsed = parse_model(source)
    analysis = analyse(parsed.model, fragment=True, incomplete=not parsed.ok)
    _refuse(source, (*parsed.diagnostics, *analysis.diagnostics))
    reader = _FragmentReader({PUBLISH: heard, SUBSCRIBE: published}, taken)
    fragment = reader.read(parsed.model)
    _refuse(source, reader.mistakes)
    return fragment


def _refuse(source: Source, found: Iterable[Diagnostic]) -> None:
    findings = Findings(source, tuple(dict.fromkeys(found)))
    if findings.errors:
        raise RebsyncError([Findings(source, findings.errors)])


@dataclass(slots=True)
class _FragmentReader:
    """Finds the topics of an environment; collects its mistakes."""

    topics: Mapping[str, Mapping[str, Fields]]
    taken: set[str]
    mistakes: list[Diagnostic] = field(default_factory=list)

    def read(self, model: m.Model) -> Fragment:
        classes = tuple(c for c in model.classes if isinstance(c, m.ReactiveClass))
        if model.main is not None:
            self._misfit(model.main.span, "main is that of the package", "leave it out")
        for each in model.classes:
            if isinstance(each, m.Interface) or each.abstract or each.extends:
                self._misfit(each.span, f'"{each.name}" is no class by itself', "write one class")
            elif each.name in self.taken:
                why = f'the package has a class "{each.name}" as well'
                self._misfit(each.name_span, why, "give it another name")
        names = {c.name for c in classes}
        found = {kind: tuple(self._servers(classes, kind)) for kind in (PUBLISH, SUBSCRIBE)}
        for each in classes:
            self._check(each, names, {s.server for s in found[PUBLISH] if s.owner == each.name})
        if not self.mistakes and not any(found.values()):
            hint = "mark a message server by the name of a topic: @Publish or @Subscribe"
            self._mistake("RS915", model.span, "nothing here is of a topic of the package", hint)
        return Fragment(model.heads, classes, found[PUBLISH], found[SUBSCRIBE])

    def _servers(self, classes: Iterable[m.ReactiveClass], kind: str) -> Iterator[TopicServer]:
        for owner in classes:
            for server in (x for x in owner.members if isinstance(x, m.MessageServer)):
                marked = any(a.name == kind for a in server.annotations)
                topic = self._topic(server, kind) if marked else None
                if topic is not None:
                    fields = self.topics[kind][topic]
                    paths = (self._path(p, topic, fields) for p in server.parameters)
                    known = tuple(p for p in paths if p is not None)
                    yield TopicServer(owner.name, server.name, topic, known)

    def _check(
        self, owner: m.ReactiveClass, names: Collection[str], published: Collection[str]
    ) -> None:
        """Lists what a class of an environment cannot have."""
        known = (*KNOWN_ANNOTATIONS, PUBLISH, SUBSCRIBE)
        for node in m.walk(owner):
            match node:
                case m.Annotation(name) if name not in known:
                    hint = did_you_mean(name, known) or "@Publish and @Subscribe name topics"
                    self._misfit(node.span, f"@{name} has no meaning here", hint)
                case m.Constructor(parameters=parameters):
                    if parameters:
                        why = "one rebec is started, without arguments"
                        self._misfit(node.span, why, "declare env variables")
                    for call in (n for n in m.walk(node) if isinstance(n, m.Call)):
                        if call.name in published:
                            why = "a constructor publishes nothing: nobody hears it yet"
                            self._misfit(call.span, why, "send a server of its own, that does")
                case m.KnownRebecs(declarations):
                    for each in (d for d in declarations if d.type.name not in names):
                        hint = "send to nodes by topics: @Publish msgsrv TOPIC(...) { }"
                        self._misfit(
                            each.span, f'"{each.type.name}" is no class of this file', hint
                        )
                case m.MessageServer(name, body=body) if name in published:
                    if body is not None and body.statements:
                        why = "what is published is served by the package"
                        self._misfit(node.name_span, why, "leave its body empty")
                case m.Call(m.Name(_), name) if any(name == p for p in published):
                    self._misfit(node.span, "only the class itself publishes", f"self.{name}(...)")
                case _:
                    pass

    def _topic(self, server: m.MessageServer, kind: str) -> str | None:
        """The topic that a server is named by: its words, or the last of them."""
        known, name = self.topics[kind], server.name
        whole = [t for t in known if model_word(t.strip("/")) == name]
        found = whole if len(whole) == 1 else [t for t in known if name in _words(t)]
        if len(found) == 1:
            return found[0]
        if found:
            hint = f"name one: {', '.join(model_word(t.strip('/')) for t in found[:_SHOWN])}"
            self._mistake("RS914", server.name_span, f'"{name}" is several topics', hint)
            return None
        words = sorted({model_word(t.strip("/")) for t in known})
        there = f"there are: {', '.join(words[:_SHOWN])}" if words else "there is none"
        why = f'the package {_HINTS[kind]} no topic "{name}"'
        self._mistake("RS915", server.name_span, why, did_you_mean(name, words) or there)
        return None

    def _path(self, parameter: m.Parameter, topic: str, fields: Fields) -> str | None:
        """The field that a parameter is named by."""
        by_name = {path.replace(".", "_"): path for path in fields}
        path = by_name.get(parameter.name)
        if path is None:
            hint = did_you_mean(parameter.name, by_name)
            hint = hint or f"there are: {', '.join([*by_name][:_SHOWN])}"
            why = f'messages of {topic} have no field "{parameter.name}"'
            self._mistake("RS915", parameter.span, why, hint)
            return None
        type_ = fields[path]
        if type_ is None or type_ == TEXT or type_.dimensions:
            self._misfit(parameter.span, f"the model has no value of {path}", "leave it out")
        elif type_ != parameter.type:
            why = f"{path} of {topic} is no {parameter.type.name}"
            self._misfit(parameter.span, why, f"write {type_.name} {parameter.name}")
        return path

    def _misfit(self, span: Span, why: str, hint: str) -> None:
        self._mistake("RS916", span, why, hint)

    def _mistake(self, code: str, span: Span, why: str, hint: str) -> None:
        self.mistakes.append(Diagnostic(code, span, why, hint))


def _words(topic: str) -> Iterator[str]:
    """What a topic can be called: all its words, or the last."""
    words = topic.strip("/").split("/")
    return (model_word("/".join(words[first:])) for first in range(len(words)))
