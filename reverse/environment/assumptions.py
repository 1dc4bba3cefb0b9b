"""What was assumed where a package was read, a sentence for each."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rebsync.reverse.findings import Grade
from rebsync.reverse.graph import ParameterFact, PublisherFact, Resolved
from rebsync.reverse.libraries.routines import Access
from rebsync.reverse.nodes.node_joined import Joined
from rebsync.reverse.nodes.node_spinning import endings_before_serving
from rebsync.reverse.nodes.node_values import Instance
from rebsync.reverse.nodes.node_wiring import nobody_publishes, nobody_subscribes
from rebsync.reverse.recovery import Extracted
from rebsync.reverse.report import different
from rebsync.reverse.scaffold.others import handed
from rebsync.reverse.unknowns import Open

_READ = (Access.GET, Access.DECLARE)
_PLAIN_CHAR = re.compile(r"(?<!signed )\bchar[ \t]+\w+[ \t]*[=;{]")
_CHANGED = (Access.SET, Access.DELETE)
_NAMES = re.compile(r"[\w/]+")
# What says in a launch file that whoever starts it may choose.
_ARGUMENTS = ("<arg", "DeclareLaunchArgument", "$(env", "$(optenv", "EnvironmentVariable")


def assumed(extracted: Extracted) -> Iterator[str]:
    """What the extraction assumed, and the values of parameters that were taken.

    Who is at the other end of topics is left out: the environment is.
    """
    closed_ends = _closed_ends(extracted.joined)
    for finding in different(extracted.findings):
        if finding.grade is Grade.ASSUMED and finding.why not in closed_ends:
            yield f"{finding.place}: {finding.why}"
    yield from dict.fromkeys(_parameters(extracted.joined))
    if inner := sorted(_topics_inside(extracted.joined)):
        yield f"nobody outside publishes to {', '.join(inner)}, and no message there is lost"
    yield from _launched(extracted.joined)
    texts = (cpp.source.text for cpp in extracted.asking.code.files if b"char" in cpp.words)
    if any(_PLAIN_CHAR.search(text) for text in texts):
        yield "a char that does not say it has a sign, as on x86"
    if extracted.asking.code.files:
        yield "no reference of C++ outlives what it leads to, and numbers fit into their types"
    yield from dict.fromkeys(_programs(extracted))
    yield "no callback ends by an exception"


def _programs(extracted: Extracted) -> Iterator[str]:
    """Where programs of started nodes of C++ may end before they let messages be served."""
    for instance in extracted.joined.wiring.instances:
        program = instance.start.program
        for node in endings_before_serving(extracted.asking.code, instance.start):
            if program is not None and not instance.idle:
                line = node.start_point.row + 1
                path = program.main.cpp.source.path
                yield f"{path}:{line}: the program gets past this, and lets messages be served"


def _closed_ends(joined: Joined) -> set[str]:
    topics = {
        topic
        for instance in joined.wiring.instances
        for fact in instance.start.unit.facts
        if isinstance(topic := instance.topic(getattr(fact, "topic", "")), str)
    }
    return {f(topic) for topic in topics for f in (nobody_publishes, nobody_subscribes)}


def _topics_inside(joined: Joined) -> set[str]:
    """The topics by which started nodes send to each other."""
    found = set()
    for instance in joined.wiring.instances:
        for number, _, _ in joined.wiring.edges[instance.name] if not instance.idle else ():
            fact = instance.start.unit.facts[number]
            topic = instance.topic(fact.topic) if isinstance(fact, PublisherFact) else None
            if isinstance(topic, str):
                found.add(topic)
    return found


def _launched(joined: Joined) -> Iterator[str]:
    """What decides what a launch file starts, where it can be started in several ways."""
    launches = {id(i.launch): i.launch for i in joined.wiring.instances if i.launched is not None}
    for launch in filter(None, launches.values()):
        if any(word in source.text for source in launch.sources for word in _ARGUMENTS):
            path = launch.sources[0].path
            yield f"{path} is started with the defaults of its arguments, and no other environment"
        for unknown in launch.unknowns:
            yield f"what is not known of launch files starts and renames nothing: {unknown}"


def _parameters(joined: Joined) -> Iterator[str]:
    """The parameters that started nodes read, with what a launch file or their defaults say."""
    for instance in joined.wiring.instances:
        for fact in instance.start.unit.facts if not instance.idle else ():
            if isinstance(fact, ParameterFact) and fact.access in (*_READ, Access.HAS):
                yield from _parameter(instance, fact)


def _parameter(instance: Instance, fact: ParameterFact) -> Iterator[str]:
    name, found = instance.value(fact.name), instance.parameter(fact.name)
    default = instance.value(fact.default) if fact.default is not None else None
    value = found.value if found is not None else default
    if found is None and fact.access is Access.HAS and not isinstance(name, Open):
        yield f"the parameter {name} of {instance.node} is not set, whenever it is asked for"
        return
    if isinstance(name, Open) or value is None or isinstance(value, Open):
        return
    how = "as a launch file sets it" if found is not None else "its default"
    shown = str(value).lower() if isinstance(value, bool) else value
    yield f"the parameter {name} of {instance.node} is {shown}, {how}, whenever it is read"


def parameters_changed(extracted: Extracted) -> Iterator[str]:
    """What sets or deletes parameters that started nodes read: their values are not those taken.

    Names are compared by their last parts, as a program may be in any namespace.
    """
    facts = [f for f in extracted.graph.facts if isinstance(f, ParameterFact)]
    for fact in (f for f in facts if f.access in _CHANGED):
        changed = _last_part(fact.name)
        for instance in extracted.joined.wiring.instances:
            read = (f for f in instance.start.unit.facts if isinstance(f, ParameterFact))
            names = {_last_part(f.name) for f in read if f.access not in _CHANGED}
            if not instance.idle and (changed in names or (None in (changed, *names) and names)):
                place = fact.site.place
                where = f"{place.source.path}:{place.line}"
                yield f"{where} sets a parameter that {instance.node} reads"


def others_reach(extracted: Extracted) -> Iterator[str]:
    """Nodes of other packages that launch files hand a topic by which started nodes are joined."""
    joined = extracted.joined
    topics = _topics_inside(joined)
    launches = {id(i.launch): i.launch for i in joined.wiring.instances if i.launched is not None}
    own = [i.launched for i in joined.wiring.instances if i.launched is not None]
    for launch in filter(None, launches.values()) if topics else ():
        for fact in handed(launch, own):
            place = f"{fact.source.path}:{fact.source.position(fact.span.start).line}"
            for name in _NAMES.findall(fact.value):
                end = name if name.startswith("/") else f"/{name}"
                for topic in (t for t in topics if t == name or t.endswith(end)):
                    yield f"{place} hands {topic} to a node that may publish to it"


def _last_part(name: Resolved) -> str | None:
    return name.rpartition("/")[2].lstrip("~") if isinstance(name, str) else None
