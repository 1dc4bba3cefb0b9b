"""What a model asks for that no ROS package can give, or gives only in part."""

from __future__ import annotations

from rebsync.config import Config
from rebsync.diagnostics import Diagnostic, Severity, did_you_mean
from rebsync.forward.clashes import clashes
from rebsync.forward.generate import is_taken, package_name
from rebsync.forward.headers import LICENSES
from rebsync.forward.offers import offer_annotation, replies, reply_names
from rebsync.forward.runtime_package import needs_own
from rebsync.forward.topics import Topics, declared_servers, signature
from rebsync.forward.view import view
from rebsync.model import (
    Annotation,
    Interface,
    KnownRebecs,
    MessageServer,
    Model,
    ReactiveClass,
)
from rebsync.reserved import KEEP_LAST
from rebsync.source import NOWHERE
from rebsync.static import Analysis


def limits(model: Model, analysis: Analysis, config: Config, stem: str) -> tuple[Diagnostic, ...]:
    """Errors where generation must stop, warnings where ROS does less than the model says."""
    found = [*_package(config, stem), *_sensors(model, config), *_instances(model, analysis)]
    found += [*_misplaced(model), *_targets(analysis, config), *_owners(config), *_licences(config)]
    topics = Topics(model, analysis)
    for c in model.classes:
        if isinstance(c, ReactiveClass):
            found += _known_arrays(c)
            found += _global_priorities(c)
        found += _offers(c, analysis, topics)
    if not analysis.errors and not any(d.severity is Severity.ERROR for d in found):
        found += _runtime(model, analysis, config, package_name(stem, config))
        found += clashes(model, analysis, config, package_name(stem, config))
    return tuple(sorted(found, key=lambda d: (d.span.start, d.code)))


def _package(config: Config, stem: str) -> list[Diagnostic]:
    name = package_name(stem, config)
    if not is_taken(name):
        return []
    return [
        Diagnostic(
            "RS702",
            NOWHERE,
            f'a package cannot be named "{name}": the name belongs to ROS, C or C++',
            "choose another `package` in rebsync.toml",
        )
    ]


def _runtime(model: Model, analysis: Analysis, config: Config, name: str) -> list[Diagnostic]:
    """What only a run-time part of the package's own can do."""
    if not config.shared_runtime:
        return []
    package, _ = view(model, analysis, config, name)
    needed = needs_own(package, config)
    message = f"the run-time part that packages share has nothing for {needed}"
    hint = "generate this package with a run-time part of its own: `--runtime own`"
    return [Diagnostic("RS713", NOWHERE, message, hint)] if needed else []


def _misplaced(model: Model) -> list[Diagnostic]:
    """`@Sensor`, `@Port` and `@KeepLast` where it is open what the node is to do."""
    instances = model.main.rebecs if model.main else ()
    annotated = [("a class", annotation) for c in model.classes for annotation in c.annotations]
    annotated += [("an instance", a) for rebec in instances for a in rebec.annotations]
    classes = (c for c in model.classes if isinstance(c, ReactiveClass))
    servers = (x for c in classes for x in c.members if isinstance(x, MessageServer))
    kept = [a for server in servers for a in server.annotations if a.name == KEEP_LAST]
    return [
        Diagnostic(
            "RS427",
            annotation.span,
            f"@{KEEP_LAST} cannot be generated: mailboxes lose nothing",
            "it is for models that stand for code with the queues of ROS",
        )
        for annotation in kept
    ] + [
        Diagnostic(
            "RS427",
            annotation.span,
            f"@{annotation.name} on {of} cannot be generated",
            "annotate the message server that takes the message",
        )
        for of, annotation in annotated
        if annotation.name in ("Sensor", "Port")
    ]


def _owners(config: Config) -> list[Diagnostic]:
    """What REP 149 wants of every package and only its owner knows."""
    year_and_holder = 'copyright = "2026 ACME Robotics"'
    missing = {
        'no `license`: package.xml says "TODO"': (config.license, 'license = "Apache-2.0"'),
        'no `maintainers`: package.xml says "TODO"': (
            config.maintainers,
            'maintainers = [{ name = "Ada", email = "ada@example.org" }]',
        ),
        "no `copyright`: sources have no header": (config.copyright, year_and_holder),
    }
    return [
        Diagnostic(
            "RS710",
            NOWHERE,
            f"rebsync.toml has {what}",
            f"write there `{hint}`, with what holds for the package",
            severity=Severity.WARNING,
        )
        for what, (given, hint) in missing.items()
        if not given
    ]


def _licences(config: Config) -> list[Diagnostic]:
    """A licence that ament_copyright would know by another name."""
    if config.copyright is None or config.license is None or config.license in LICENSES:
        return []
    hint = did_you_mean(config.license, LICENSES)
    message = f'ament_copyright has no header for the licence "{config.license}"'
    warning = Diagnostic("RS710", NOWHERE, message, hint, severity=Severity.WARNING)
    return [warning] if hint else []


def _targets(analysis: Analysis, config: Config) -> list[Diagnostic]:
    """Dialects of single classes that are not there, or do not go together."""
    found = []
    names = sorted(analysis.classes)
    for chosen in config.targets:
        if chosen.name not in analysis.classes:
            message = f'rebsync.toml gives a target to "{chosen.name}", which is no class'
            found.append(Diagnostic("RS709", NOWHERE, message, f"classes: {', '.join(names)}"))
    targets = {name: config.target_of(name) for name in names}
    if len(set(targets.values())) > 1 and not set(targets.values()) <= {"ros1-cpp", "ros1-py"}:
        message = "only ros1-cpp and ros1-py go together in one package"
        found.append(Diagnostic("RS709", NOWHERE, message, "change `[targets]` in rebsync.toml"))
    for name, info in analysis.classes.items():
        for above in info.ancestors:
            if targets.get(above) != targets[name]:
                message = f'"{name}" and its ancestor "{above}" must be in one language'
                found.append(Diagnostic("RS709", NOWHERE, message, "change `[targets]`"))
    return found


def _known_arrays(declaration: ReactiveClass) -> list[Diagnostic]:
    return [
        Diagnostic(
            "RS703",
            known.span,
            "known rebecs cannot be arrays in a ROS package: each one has a topic of its own",
            "declare them one by one",
        )
        for member in declaration.members
        if isinstance(member, KnownRebecs)
        for known in member.declarations
        if known.type.dimensions
    ]


def _instances(model: Model, analysis: Analysis) -> list[Diagnostic]:
    found = []
    used: dict[str, set[int]] = {}
    for rebec in model.main.rebecs if model.main else ():
        for annotation in rebec.annotations:
            if annotation.name in ("priority", "globalPriority"):
                found.append(
                    Diagnostic(
                        "RS704",
                        annotation.span,
                        "ROS cannot order different nodes: this priority is not carried out",
                        "what was verified with it holds only while the order does not matter",
                        severity=Severity.WARNING,
                    )
                )
        chosen = used.setdefault(rebec.type.name, set())
        chosen.add(id(analysis.constructor_of(rebec)))
        if len(chosen) > 1:
            found.append(
                Diagnostic(
                    "RS705",
                    rebec.span,
                    f'the rebecs of "{rebec.type.name}" use different constructors, but its '
                    "node has one",
                    "give the class one constructor, or one class to each",
                )
            )
    return found


def _global_priorities(declaration: ReactiveClass) -> list[Diagnostic]:
    return [
        Diagnostic(
            "RS706",
            annotation.span,
            "ROS cannot order different nodes: this priority holds within each rebec only",
            "use @priority, or make sure that the order between rebecs does not matter",
            severity=Severity.WARNING,
        )
        for member in declaration.members
        if isinstance(member, MessageServer)
        for annotation in member.annotations
        if annotation.name == "globalPriority"
    ]


def _offers(
    declaration: ReactiveClass | Interface, analysis: Analysis, topics: Topics
) -> list[Diagnostic]:
    """Services and actions that cannot be offered, or that the model has no one reply to."""
    found = []
    for server in declared_servers(declaration):
        annotation = offer_annotation(server)
        if annotation is None:
            continue
        odd = _odd_offer(declaration.name, server, annotation, analysis, topics)
        if odd is not None:
            found.append(Diagnostic("RS711", annotation.span, *odd))
    return found


def _odd_offer(
    class_name: str,
    server: MessageServer,
    annotation: Annotation,
    analysis: Analysis,
    topics: Topics,
) -> tuple[str, str] | None:
    """What is wrong with a service or action, and what to do about it."""
    kind, names = annotation.name, reply_names(annotation)
    wanted = signature(server.name, server.parameters)
    first = topics.subscriber(class_name, wanted)
    if first != class_name or analysis.classes[class_name].is_interface:
        message = f'"{server.name}" of "{class_name}" is not where its {kind.lower()} is offered'
        return message, f'write @{kind} where a reactive class first has "{server.name}"'
    if not topics.of(class_name, wanted).message.carries_sender:
        message = f'"{server.name}" does not ask who its sender is, so nobody can be answered'
        hint = "or keep sender in a variable until it is answered"
        return message, f"send {names[0]} to sender, {hint}"
    if len(set(names)) < len(names):
        return f'"{names[0]}" is the reply, and so no feedback', "name another server for it"
    odd = (_odd_reply(class_name, kind, name, analysis, topics) for name in names)
    return next((found for found in odd if found is not None), None)


def _odd_reply(
    class_name: str, kind: str, reply: str, analysis: Analysis, topics: Topics
) -> tuple[str, str] | None:
    """What is wrong with the messages that go to a client."""
    sent = replies(class_name, reply, analysis, topics)
    if not sent:
        message = f'"{class_name}" sends no "{reply}" to its sender, nor to whom a variable holds'
        return message, f"answer with (({_answered(reply, analysis)})sender).{reply}(...)"
    if len(sent) > 1:
        roots = " and ".join(f'"{t.root}.{t.name}"' for t in sent)
        return f'"{reply}" is not one reply: {roots} have messages of their own', (
            "each of them has a type of its own: call one of them otherwise"
        )
    return None


def _answered(reply: str, analysis: Analysis) -> str:
    """A class that has the server, to cast `sender` to."""
    every = analysis.classes.items()
    return next((name for name, i in every if any(s.name == reply for s in i.servers)), "C")


def _sensors(model: Model, config: Config) -> list[Diagnostic]:
    """Bindings of rebsync.toml that no sensor server has."""
    servers = {
        f"{c.name}.{m.name}"
        for c in model.classes
        if isinstance(c, ReactiveClass)
        for m in c.members
        if isinstance(m, MessageServer) and any(a.name == "Sensor" for a in m.annotations)
    }
    return [
        Diagnostic(
            "RS707",
            NOWHERE,
            f'rebsync.toml binds "{binding.server}", which is no @Sensor server of the model',
            f"sensors: {', '.join(sorted(servers)) or 'none'}",
        )
        for binding in config.sensors
        if binding.server not in servers
    ]
