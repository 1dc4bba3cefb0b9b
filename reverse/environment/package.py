"""The closed model of a package: what its code does, in an environment that may do anything."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import reduce
from typing import Literal, TypeAlias

from rebsync import model as m
from rebsync.config import FILE_NAME
from rebsync.properties import Formula, Properties, Tctl, state_expressions, subformulas
from rebsync.questions import LeadsTo, Question, texts_in
from rebsync.records import dataclass
from rebsync.reverse.build.manifests import package_name
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.environment.asking import TopicVocabulary
from rebsync.reverse.environment.assumptions import assumed, others_reach, parameters_changed
from rebsync.reverse.environment.closing import ClosedModel, closed, without_open
from rebsync.reverse.environment.fragment_wiring import (
    constructor_publishes,
    hearers,
    with_fragment,
)
from rebsync.reverse.environment.fragments import Fragment, read_fragment
from rebsync.reverse.environment.observation import (
    ANY,
    COUNT,
    Hearers,
    Observation,
    observations,
    observed_fields,
    parameter_of,
    unread_fields,
    with_observations,
)
from rebsync.reverse.environment.overwriting import overwritten
from rebsync.reverse.findings import Finding
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.nodes.node_joined import Joined, Observed
from rebsync.reverse.nodes.node_system import unit_of_time
from rebsync.reverse.nodes.node_times import common_measure
from rebsync.reverse.nodes.open_ends import OpenEnd, open_ends, receivers
from rebsync.reverse.recovery import Extracted, extract
from rebsync.reverse.report import different
from rebsync.source import Source
from rebsync.static.constants import single

_ROUNDS = 4

# What comes from outside: anything, nothing, or what a file says.
EnvironmentChoice: TypeAlias = Literal["free", "none"] | Source


@dataclass(frozen=True, slots=True)
class ClosedPackage:
    """A package as a closed model, with what the code was read to.

    A unit of the model's time takes `unit` seconds. What is said of the model is true of the code
    under the `assumptions`; because of the `gaps` nothing is proved. `texts` are those of the code
    by their numbers, and which variables hold one: the rebec, a server or nothing, the name.
    """

    model: m.Model
    findings: tuple[Finding, ...]
    unit: Fraction
    assumptions: tuple[str, ...]
    gaps: tuple[str, ...]
    texts: tuple[tuple[str, ...], frozenset[tuple[str, str, str]]]


@dataclass(frozen=True, slots=True)
class ReadPackage:
    """The files of a package, with settings whose unit of time fits, and what they were read to."""

    files: Mapping[str, Source]
    extracted: Extracted


def closed_package(
    read: ReadPackage, properties: Properties, choice: EnvironmentChoice
) -> ClosedPackage:
    """The model of a package with its environment, where properties can name its topics."""
    files, extracted = read.files, read.extracted
    types = message_types(files)
    wanted = tuple(_wanted(extracted, types, properties))
    fragment = _fragment(extracted, types, choice)
    observed = _together(observed_fields(wanted), fragment.observed)
    if observed:  # rebecs of one class whose topics are observed apart become two classes
        extracted = extract(files, observed=observed, texts=extracted.texts)
        wanted = tuple(_wanted(extracted, types, properties))
    joined = extracted.joined
    fields = _fields(joined)
    model = extracted.model
    rebecs, heard = hearers(fragment, model)
    classes = tuple(
        with_observations(c, wanted, observed, fields.get(c.name, {}), _counted(properties), heard)
        if isinstance(c, m.ReactiveClass)
        else c
        for c in model.classes
    )
    more = unread_fields(wanted, fields)
    ends, fed = (
        tuple(replace(e, fields=(*e.fields, *more.get((e.owner, e.server), ()))) for e in found)
        for found in (open_ends(joined), receivers(joined))
    )
    topics = {s.topic for s in fragment.published}
    fed = tuple(e for e in fed if e.name in topics)
    opened = replace(model, classes=classes)
    if fragment.classes and opened.main is not None:
        opened = with_fragment(opened, fragment, rebecs, fed)
    ends = tuple(e for e in ends if e.name not in topics or e.is_service)
    around = _surrounded(opened, (ends, fed), properties, choice, types, extracted.texts)
    unit = unit_of_time(files)
    simulated = any("use_sim_time" in source.text for source in files.values())
    clock = ("a simulation publishes /clock as time passes",) if simulated else ()
    assumptions = (*assumed(extracted), *clock, *around.assumptions)
    assumptions = (*assumptions, *_time(unit, around), *_rounded(properties))
    gaps = (*around.gaps, *_overwritten(model, wanted, observed), *_unheard(model, heard))
    gaps = (*gaps, *dict.fromkeys(parameters_changed(extracted)))
    gaps = (*gaps, *dict.fromkeys(others_reach(extracted)))
    gaps = (*gaps, *dict.fromkeys(_waiting(model, wanted, properties)))
    findings = tuple(different(extracted.findings))
    texts = extracted.texts, frozenset(_texts(extracted, wanted))
    return ClosedPackage(around.model, findings, unit, assumptions, gaps, texts)


def asked_of(
    files: Mapping[str, Source], text: Source, question: Question
) -> tuple[ReadPackage, str]:
    """A package, read in a unit of time that fits a question, and the question as a property."""
    within = question.within if isinstance(question, LeadsTo) else None
    read = in_fitting_unit(files, () if within is None else (within,))
    types = message_types(read.files)
    seen = tuple(observations(read.extracted.joined, types))
    texts = dict.fromkeys((*read.extracted.texts, *texts_in(question)))
    numbers = {t: n for n, t in enumerate(texts)}
    asked = TopicVocabulary(text, seen, types.constants(), numbers, unit_of_time(read.files))
    if len(texts) > len(read.extracted.texts):  # of which a text that is not known may be each
        read = replace(read, extracted=extract(read.files, texts=tuple(texts)))
    return read, asked.property_text(question)


def _surrounded(
    model: m.Model,
    given: tuple[tuple[OpenEnd, ...], tuple[OpenEnd, ...]],
    properties: Properties,
    choice: EnvironmentChoice,
    types: MessageTypes,
    texts: tuple[str, ...],
) -> ClosedModel:
    ends, fed = given
    if choice != "none":
        around = closed(model, ends, properties, types, texts, fed)
        path = choice.path if isinstance(choice, Source) else ""
        names = dict.fromkeys(f"{end.name} comes as {path} says" for end in fed)
        return replace(around, assumptions=(*names, *around.assumptions))
    names = dict.fromkeys(end.name or f"{end.rebec}.{end.server}" for end in ends)
    told = (f"nothing comes from outside: {', '.join(names)}",) if names else ()
    classes = tuple(without_open(c) for c in model.classes)
    return ClosedModel(replace(model, classes=classes), told)


def _fragment(extracted: Extracted, types: MessageTypes, choice: EnvironmentChoice) -> Fragment:
    """The environment that a file says; one of nothing where there is no file."""
    if not isinstance(choice, Source):
        return Fragment((), (), (), ())
    heard, published = {}, dict[str, dict[str, m.Type | None]]()
    for end in receivers(extracted.joined):
        if end.name is not None and end.type is not None:
            heard[end.name] = types.fields(end.type) or {}
    for _, seen in observations(extracted.joined, types):
        if not seen.server:
            of_topic = published.setdefault(seen.topic, {})
            if seen.path not in (ANY, COUNT):
                of_topic[seen.path] = seen.type
    names = {c.name for c in extracted.model.classes}
    return read_fragment(choice, heard, published, names)


def _together(one: Observed, other: Observed) -> Observed:
    """The fields of both, by topics."""
    topics = dict.fromkeys((*one, *other))
    return {t: tuple(dict.fromkeys((*one.get(t, ()), *other.get(t, ())))) for t in topics}


def _unheard(model: m.Model, heard: Hearers) -> Iterator[str]:
    """What nodes publish while they start, which an environment does not get."""
    for owner in (c for c in model.classes if isinstance(c, m.ReactiveClass)):
        for topic in dict.fromkeys(constructor_publishes(owner, heard)):
            yield f"what {owner.name} publishes to {topic} while it starts comes to nobody here"


# --- the unit of time ---------------------------------------------------------------------------


def message_types(files: Mapping[str, Source]) -> MessageTypes:
    """The message types that a package knows."""
    return MessageTypes.of(files, package_name(files))


def in_fitting_unit(files: Mapping[str, Source], times: Collection[Fraction] = ()) -> ReadPackage:
    """The files, read in a unit of time that divides all their times, and some `times` in seconds.

    That is a second, or less where there are others, unless `rebsync.toml` says it.
    """
    extracted = extract(files)
    settings = files.get(FILE_NAME)
    if settings is not None and "time_unit" in settings.text:
        return ReadPackage(files, extracted)
    text, path = (settings.text, settings.path) if settings is not None else ("", FILE_NAME)
    unit = reduce(common_measure, times, Fraction(1))
    for _ in range(_ROUNDS):
        unit = reduce(common_measure, extracted.times, unit)
        if unit == unit_of_time(files):
            break
        files = {**files, FILE_NAME: Source(path, f"time_unit = {float(unit)!r}\n{text}")}
        extracted = extract(files)
    return ReadPackage(files, extracted)


def _time(unit: Fraction, around: ClosedModel) -> Iterator[str]:
    if around.assumptions or unit != 1:
        yield f"a unit of time is {float(unit):g} s"


# --- what properties name -----------------------------------------------------------------------


def _wanted(
    extracted: Extracted, types: MessageTypes, properties: Properties
) -> Iterator[Observation]:
    """The observations that the properties name, each once."""
    named = set(_named(properties))
    found = {o: None for r, o in observations(extracted.joined, types) if (r, o.variable) in named}
    return iter(found)


def _named(properties: Properties) -> Iterator[tuple[str, str]]:
    """The state variables that properties look at, with the rebecs that have them."""
    formulas: list[Formula] = [d.value for d in properties.defines]
    formulas += [p.formula for p in properties.all]
    for formula in formulas:
        for expression in state_expressions(formula):
            for node in m.walk(expression):
                match node:
                    case m.Member(m.Name(rebec), variable):
                        yield rebec, variable


def _overwritten(
    model: m.Model, wanted: Collection[Observation], observed: Observed
) -> Iterator[str]:
    """Topics of which properties look at fields, and of which not all messages are seen."""
    asked = {(o.owner, o.topic) for o in wanted if not o.server and o.path not in (ANY, COUNT)}
    for owner, topic in overwritten(model, observed):
        if (owner, topic) in asked:
            yield f"{owner} may publish to {topic} twice in one step: only the last is seen"


def _waiting(
    model: m.Model, wanted: Collection[Observation], properties: Properties
) -> Iterator[str]:
    """Messages that may wait while a callback takes time, where properties say how long at most."""
    formulas = (each for p in properties.tctl for each in subformulas(p.formula))
    if not any(isinstance(each, Tctl) and each.bound is not None for each in formulas):
        return
    calls = {c.name: [n for n in m.walk(c) if isinstance(n, m.Call)] for c in model.classes}
    for seen in wanted:
        if seen.server and any(c.name == "delay" for c in calls.get(seen.owner, ())):
            yield f"a message of {seen.topic} may wait while a callback of {seen.owner} takes time"


def _rounded(properties: Properties) -> Iterator[str]:
    """Numbers of properties that are not those which are written: a float is near to them."""
    formulas = (*(d.value for d in properties.defines), *(p.formula for p in properties.all))
    parts = (n for f in formulas for e in state_expressions(f) for n in m.walk(e))
    for text in dict.fromkeys(n.text for n in parts if isinstance(n, m.FloatLiteral)):
        value = float(text.rstrip("dDfF"))
        if text[-1] not in "dD" and single(value) != value:
            yield f"{text} is the nearest number that 32 bits hold, as in a field of float32"


def _texts(extracted: Extracted, wanted: Collection[Observation]) -> Iterator[tuple[str, str, str]]:
    """The variables of rebecs, and the parameters of their servers, that hold texts."""
    seen = {(o.owner, "", o.variable) for o in wanted if o.type == TEXT}
    seen |= {(o.owner, o.server, parameter_of(o)) for o in wanted if o.type == TEXT and o.server}
    main = extracted.model.main
    for rebec in main.rebecs if main is not None else ():
        for owner, server, name in seen | extracted.text_variables:
            if owner == rebec.type.name:
                yield rebec.name, server, name


def _counted(properties: Properties) -> int:
    """A number above all that properties name: up to this messages are counted."""
    formulas = (*(d.value for d in properties.defines), *(p.formula for p in properties.all))
    parts = (n for f in formulas for e in state_expressions(f) for n in m.walk(e))
    return 1 + max((n.value for n in parts if isinstance(n, m.IntLiteral)), default=0)


def _fields(joined: Joined) -> dict[str, dict[str, tuple[str, ...]]]:
    """By class and server the paths of the fields that are handed on."""
    found: dict[str, dict[str, tuple[str, ...]]] = {}
    for instance in joined.wiring.instances:
        of_class = found.setdefault(joined.class_of(instance), {})
        for server in joined.wiring.servers[instance.start.unit.name]:
            of_class[server.name] = joined.taken(instance.start.unit.name, server)
    return found
