"""The nodes of generated packages: by which topics their classes have the mailbox join them.

The run-time part makes these ends by names that each class hands it. The facts of the scaffold say
which, in the same words for all dialects; what people have added to a class stays beside them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain

from rebsync.records import dataclass
from rebsync.reverse.files.packages import CODE
from rebsync.reverse.files.python_files import is_launch, is_python
from rebsync.reverse.graph import Place, Resolved, Unresolved
from rebsync.reverse.scaffold.cpp import facts_in_cpp
from rebsync.reverse.scaffold.fact import PROGRAM, Fact
from rebsync.reverse.scaffold.python import facts_in_python
from rebsync.reverse.scaffold.runtime_cpp import HEADER
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.rosgraph.closed import is_closed
from rebsync.rosgraph.ends import End, NodeCode, ParameterUse, Role
from rebsync.rosgraph.facts import distinct
from rebsync.rosgraph.naming import OWN_NAME
from rebsync.source import Source

_JOINTS = frozenset({"publisher", "subscription", "sensor", "service", "set-up"})
# What is offered: whether as an action, on the bridge, the type in C++, its name, or in Python.
_OFFER = re.compile(
    r"offer(_?[Aa]ction)?(_?[Oo]n_?[Bb]ridge)?"
    r'(?:<(?:\w+::)*(\w+)[^(]*>)?\("+(?:~/?)?([\w/]+)"+, *"+\w*"+(?:, *(\w+))?'
)
_BASES = re.compile(r"\bclass (\w+)(?: : public |\()(?:\w+(?:::|\.))*(\w+)\b")
_VALUE = re.compile(r'(\w+)(?:<(?:\w+::)*(\w+)>\(| (\w+) | )"([^"]*)"(?:, ?"([^"]*)")?')
_SHIM = re.compile(r"&\s*(?:\w+\s*::\s*)+(\w+)")
_FAR = 400  # characters within which a subscription names its handler


def with_mailboxes(
    nodes: Sequence[NodeCode], files: Mapping[str, Source], package: str
) -> Iterator[NodeCode]:
    """The nodes of a package; those of generated classes with the ends of their mailboxes."""
    facts = list(_facts(files, package))
    joined = {fact.owner for fact in facts if fact.kind == "subscription"}
    programs = {f.owner: f.value for f in facts if f.kind == PROGRAM and f.value in joined}
    if not programs:
        yield from nodes
        return
    runtime = frozenset(s.path for path, s in files.items() if _is_runtime(path, s))
    generated = _Generated(package, files, facts, runtime, joined, programs)
    apart = [node for node in nodes if not generated.has(node)]
    parts = [node for node in nodes if generated.has(node)]
    yield from apart
    for program in programs:
        yield generated.node(program, parts)


def _facts(files: Mapping[str, Source], package: str) -> Iterator[Fact]:
    for path, source in files.items():
        if path.endswith(tuple(CODE)):
            yield from facts_in_cpp(path.rpartition("/")[2].rpartition(".")[0], source)
        elif is_python(path, source) and not is_launch(path):
            yield from facts_in_python(path, source, package)


def _is_runtime(path: str, source: Source) -> bool:
    return HEADER.match(path) is not None or is_runtime_file(source)


@dataclass(frozen=True, slots=True)
class _Generated:
    """The generated part of a package: what joins its classes, and which program runs which."""

    package: str
    files: Mapping[str, Source]
    facts: Sequence[Fact]
    runtime: frozenset[str]
    joined: set[str]
    programs: Mapping[str, str]

    def has(self, node: NodeCode) -> bool:
        """Whether a node is one of a generated class, or code of the run-time part."""
        places = {end.place.source.path for end in node.ends}
        places |= {use.place.source.path for use in node.parameters}
        is_program = bool(node.executables & self.programs.keys())
        is_runtime = bool(places) and places <= self.runtime
        return node.label in self.joined or is_program or is_runtime

    def node(self, program: str, parts: Sequence[NodeCode]) -> NodeCode:
        """The node of a program; `parts` are what was read of all generated code."""
        class_ = self.programs[program]
        own = [n for n in parts if n.label == class_ or program in n.executables]
        named = [n for n in own if n.name is not None]
        lineage = self._lineage(class_)
        joints = [f for f in self.facts if f.kind in _JOINTS and f.owner in lineage]
        paths = {fact.source.path for fact in joints}
        ends = [e for n in parts for e in n.ends if self._is_of(e, lineage, paths)]
        sources = [s for s in self.files.values() if s.path in paths | self.runtime]
        uses: Iterable[ParameterUse] = (p for n in parts for p in n.parameters)
        return NodeCode(
            package=self.package,
            label=class_,
            name=named[0].name if named else None,
            executables=frozenset({program, class_}),
            ends=tuple(distinct(chain((self._typed(e) for e in ends), self._ends(joints)))),
            parameters=tuple(distinct(uses)),
            place=own[0].place if own else None,
            is_node=True,
            is_flat=any(n.is_flat for n in parts),
            closed=is_closed(sources, (self.package, f"{self.package}_interfaces")),
        )

    def _lineage(self, class_: str) -> frozenset[str]:
        """A class with those that it extends."""
        pairs = (m.groups() for s in self.files.values() for m in _BASES.finditer(s.text))
        above: dict[str, list[str]] = {}
        for name, base in pairs:
            above.setdefault(name, []).append(base)
        found, waiting = set[str](), [class_]
        while waiting:
            name = waiting.pop()
            if name not in found:
                found.add(name)
                waiting += above.get(name, ())
        return frozenset(found)

    def _is_of(self, end: End, lineage: frozenset[str], paths: set[str]) -> bool:
        """Whether an end that was read is one of a class; of the run-time part if it is named."""
        path = end.place.source.path
        if path not in self.runtime:
            return end.within in lineage or path in paths
        if not isinstance(end.name, str):
            return False
        is_used = any(re.search(rf"\b{end.within}\b[ (]", s.text) for s in self._of(paths))
        return not end.name.startswith("~") or (end.within == "Drive" and is_used)

    def _of(self, paths: set[str]) -> Iterator[Source]:
        """The files of a class, headers included."""
        stems = {p.rpartition("/")[2].partition(".")[0] for p in paths}
        for source in self.files.values():
            if source.path.rpartition("/")[2].partition(".")[0] in stems:
                yield source

    def _typed(self, end: End) -> End:
        """The end with the package of its type, where the code leaves it to its namespace.

        Who hears of states and velocities is outside, if anybody does.
        """
        type_ = end.type
        if isinstance(type_, str) and type_.startswith("msg/"):
            type_ = f"{self.package}/{type_.removeprefix('msg/')}"
        last = re.split("[~/]", end.name)[-1] if isinstance(end.name, str) else ""
        is_lone = last == "state" or end.place.source.path in self.runtime
        return replace(end, type=type_, is_lone=is_lone)

    # --- joints ---------------------------------------------------------------------------------

    def _ends(self, joints: Iterable[Fact]) -> Iterator[End]:
        """The ends that facts stand for."""
        for fact in joints:
            place = Place(fact.source, fact.span)
            if fact.kind == "sensor":
                name = fact.value.strip('"')
                name = name if name.startswith("/") else f"~{name}"
                known = self._sensed(fact, place)
                yield End(Role.SUBSCRIPTION, name, known, place, fact.owner)
                continue
            if (offered := _OFFER.match(fact.value)) is not None:
                is_action, bridge, in_cpp, name, in_python = offered.groups()
                known = self._type(fact.source, in_cpp or in_python or "", place)
                role = Role.ACTION_SERVER if is_action else Role.SERVER
                name = f"control_bridge/{OWN_NAME}/{name}" if bridge else f"~{name}"
                yield End(role, name, known, place, fact.owner, is_lone=True)
            if fact.kind in ("service", "set-up"):
                continue
            match = _VALUE.match(fact.value.removeprefix("again "))
            if match is None:
                continue
            word, given, other, topic, server = match.groups()
            message = given or other or self._taken(fact)
            is_publisher = fact.kind == "publisher"
            role = Role.PUBLISHER if is_publisher else Role.SUBSCRIPTION
            known = self._type(fact.source, message, place)
            for each in self._names(word, topic, server, place):
                yield End(role, each, known, place, fact.owner, is_lone=not is_publisher)

    def _names(self, word: str, topic: str, server: str | None, place: Place) -> Iterator[Resolved]:
        """The topics that a call asks for; those to all of a class are in the launch files."""
        if word.endswith("_elsewhere"):
            yield topic
        elif word == "advertiseAll":
            pattern = re.compile(rf"~/?{re.escape(topic)}/(\w+)/{re.escape(server or '')}\b")
            launches = [s for path, s in self.files.items() if is_launch(path) or ".launch" in path]
            rebecs = dict.fromkeys(m[1] for s in launches for m in pattern.finditer(s.text))
            yield from (f"~{topic}/{rebec}/{server}" for rebec in rebecs)
            if not rebecs:
                why = f"one for each {topic} that a launch file lists"
                yield Unresolved(why, place, f"~{topic}/*/{server}")
        elif word == "subscribeOnBridge":
            yield f"control_bridge/{OWN_NAME}/{topic}"
        else:
            yield f"~{topic}"

    def _taken(self, fact: Fact) -> str:
        """The type of the messages that a subscription of C++ hands on."""
        text = fact.source.text
        shim = _SHIM.search(text, fact.span.start, fact.span.end + _FAR)
        head = rf"::\s*{shim[1]}\(\s*const\s+(?:\w+::)*?(\w+)::Const" if shim else r"\Z"
        found = re.search(head, text)
        return found[1] if found is not None and found.groups() else ""

    def _sensed(self, fact: Fact, place: Place) -> Resolved:
        """The type of the messages of a sensor: of the member, or handed to its constructor."""
        name = fact.name.strip("_").removesuffix("_sensor")
        of_member = re.compile(rf"\bSensor<(?:(\w+)::)?(?:msg::)?(\w+)>\s+{name}\w*;")
        handed = re.compile(rf"_{name}\w* = Sensor\([^)]*\b(\w+)\)")
        for source in self._of({fact.source.path}):
            if (found := of_member.search(source.text)) is not None:
                package = found[1] if found[1] not in (None, "msg") else self.package
                return f"{package}/{found[2]}"
            if (found := handed.search(source.text)) is not None:
                imported = rf"^from (\w+)\.msg import (?:[^()\n]*|\([^)]*)\b{found[1]}\b"
                package = re.search(imported, source.text, re.MULTILINE)
                return f"{package[1] if package is not None else self.package}/{found[1]}"
        return Unresolved("its class is not in the files of its node", place)

    def _type(self, source: Source, name: str, place: Place) -> Resolved:
        if not name:
            return Unresolved("what takes it in is not in the file", place)
        beside = f"{self.package}_interfaces"
        return f"{beside if f'{beside}.' in source.text else self.package}/{name}"
