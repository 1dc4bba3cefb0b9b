"""The tags `<param>` and `<rosparam>` of launch files: which parameters they set to what."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from rebsync.reverse.graph_names import canonical, join
from rebsync.reverse.launch_scope import Scope
from rebsync.reverse.launch_values import stored
from rebsync.reverse.parameters import Parameter, Parameters, read_parameters
from rebsync.reverse.unknowns import Open, Text, Unknown
from rebsync.reverse.xml_tree import Element
from rebsync.source import Source, Span

_SOURCES = ("value", "textfile", "binfile", "command")


@dataclass(frozen=True, slots=True)
class Setting:
    """What one tag sets: parameters by names as they are written, relative to their scope."""

    parameters: tuple[Parameter, ...] = ()
    unknowns: tuple[Unknown, ...] = ()
    sources: tuple[Source, ...] = ()


def resolved(element: Element, attribute: str, scope: Scope) -> Text | None:
    """The value of an attribute with its `$(...)` replaced; None where there is none."""
    value = element.get(attribute)
    return None if value is None else scope.substitution().of(value)


def _unknown(what: str, why: str, scope: Scope, span: Span) -> Setting:
    return Setting(unknowns=(Unknown(what, why, scope.source, span),))


# --- <param> --------------------------------------------------------------------------------------


def param(element: Element, scope: Scope) -> Setting:
    """What a `<param>` sets."""
    given = [a for a in _SOURCES if a in element.attributes]
    written = element.get("name")
    if len(given) != 1 or written is None:
        why = "it needs a name" if written is None else f"it needs one of {', '.join(_SOURCES)}"
        return _unknown("a <param>", why, scope, element.span)
    name = scope.substitution().of(written.strip())
    if isinstance(name, Open) or not name:
        why = name.why if isinstance(name, Open) else "it is empty"
        return _unknown("the name of a parameter", why, scope, element.place_of("name"))
    kind = (element.get("type") or "auto").lower().strip()
    text, sources = _content(element, given[0], scope)
    if kind == "yaml" and not isinstance(text, Open):
        return _yaml(name, text, sources, element.place_of(given[0]), scope)
    value = text if isinstance(text, Open) else stored(text, kind)
    place = element.place_of(given[0])
    entry = Parameter(canonical(name), value, scope.source, place)
    unknowns = (
        (Unknown(f"the parameter `{name}`", value.why, scope.source, place),)
        if isinstance(value, Open)
        else ()
    )
    return Setting((entry,), unknowns, sources)


def _content(element: Element, kind: str, scope: Scope) -> tuple[Text, tuple[Source, ...]]:
    given = resolved(element, kind, scope)
    if given is None or isinstance(given, Open):
        return given or Open("it has no value"), ()
    match kind:
        case "value":
            return given.strip(), ()
        case "textfile":
            file = scope.surroundings.load(given)
            if file is None:
                return Open(f"the file `{given}` is not at hand"), ()
            return file.text, (file,)
        case "binfile":
            return Open("the content of a binary file is not read"), ()
        case _:
            return Open("the output of a command is known only when it runs"), ()


def _yaml(name: str, text: str, sources: tuple[Source, ...], place: Span, scope: Scope) -> Setting:
    read = read_parameters(scope.source, text, lambda _: place)
    if not text.strip():
        return _unknown(f"the parameter `{name}`", "its YAML is empty", scope, place)
    entries = tuple(replace(e, name=_below(name, e.name)) for e in read.entries)
    return Setting(entries, read.unknowns, sources)


def _below(name: str, inner: str) -> str:
    joined = join(name, inner) if inner else name
    return canonical(joined) if isinstance(joined, str) else name


# --- <rosparam> -----------------------------------------------------------------------------------


def rosparam(element: Element, scope: Scope) -> Setting:
    """What a `<rosparam>` sets; `dump` and `delete` act before parameters are set."""
    command = resolved(element, "command", scope)
    if command in ("dump", "delete"):
        return Setting()
    if isinstance(command, Open) or command not in (None, "", "load"):
        why = command.why if isinstance(command, Open) else f"roslaunch has no `{command}`"
        return _unknown("a <rosparam>", why, scope, element.place_of("command"))
    namespace, name = (resolved(element, a, scope) or "" for a in ("ns", "param"))
    full = join(namespace, name)
    if isinstance(full, Open):
        return _unknown("the name of a <rosparam>", full.why, scope, element.span)
    read = _rosparam_content(element, scope)
    if isinstance(read, Open):
        return _unknown(_content_of(full), read.why, scope, element.place_of("file"))
    return _named(full, read[0], read[1], element, scope)


def _content_of(name: str) -> str:
    return f"the parameter `{name}`" if name else "the parameters of a <rosparam>"


def _rosparam_content(
    element: Element, scope: Scope
) -> tuple[Parameters, tuple[Source, ...]] | Open:
    path = resolved(element, "file", scope)
    if isinstance(path, Open):
        return path
    file = scope.surroundings.load(path) if path else None
    if path and file is None:
        return Open(f"the file `{path}` is not at hand")
    substituted = _substituted(element, file.text if file else element.text, scope)
    if isinstance(substituted, Open):
        return substituted
    place: Callable[[Span], Span]
    if file is not None:
        place = _exact if substituted == file.text else lambda _: Span(0, 0)
        return read_parameters(file, substituted, place), (file,)
    place = element.place_in_text if substituted == element.text else lambda _: element.span
    return read_parameters(scope.source, substituted, place), ()


def _exact(span: Span) -> Span:
    return span


def _substituted(element: Element, text: str, scope: Scope) -> Text:
    """The text with `$(...)` replaced, where the tag asks for that."""
    wanted = resolved(element, "subst_value", scope)
    if isinstance(wanted, Open):
        return wanted
    match (wanted or "false").lower():
        case "false":
            return text
        case "true":
            return scope.substitution().of(text)
        case _:
            return Open("`subst_value` is neither true nor false")


def _named(
    name: str, read: Parameters, sources: tuple[Source, ...], element: Element, scope: Scope
) -> Setting:
    if not name and any(not e.name for e in read.entries):
        why = "a value that is no mapping needs the attribute `param`"
        return _unknown("a <rosparam>", why, scope, element.span)
    entries = tuple(replace(e, name=_below(name, e.name) if name else e.name) for e in read.entries)
    return Setting(entries, read.unknowns, sources)
