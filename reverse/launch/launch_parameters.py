"""The tags `<param>` and `<rosparam>` of launch files: which parameters they set to what.

Names are as they are written: relative to the scope or node that the tag stands in, `/` or `~` in
front for others.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from rebsync.reverse.launch.graph_names import canonical, join
from rebsync.reverse.launch.launch_scope import LaunchScope
from rebsync.reverse.launch.launch_values import stored
from rebsync.reverse.launch.parameter_sections import ANY
from rebsync.reverse.launch.parameters import Parameter, Parameters, read_parameters
from rebsync.reverse.launch.xml_tree import XmlElement
from rebsync.reverse.unknowns import Open, Text
from rebsync.source import Span

_CONTENTS = ("value", "textfile", "binfile", "command")
_PARAM = frozenset({"name", "type", *_CONTENTS})
_ROSPARAM = frozenset({"command", "file", "ns", "param", "subst_value"})


def settings(element: XmlElement, scope: LaunchScope) -> tuple[Parameter, ...]:
    """What a `<param>` or `<rosparam>` sets; open where its condition is."""
    param = element.name.lower() == "param"
    scope.check(element, _PARAM if param else _ROSPARAM)
    condition = scope.condition(element)
    if condition is False:
        return ()
    found = _param(element, scope) if param else _rosparam(element, scope)
    if condition is True:
        return found
    unsure = Open(f"it is set only `{condition[0]}`")
    return tuple(replace(parameter, value=unsure) for parameter in found)


# --- <param> --------------------------------------------------------------------------------------


def _param(element: XmlElement, scope: LaunchScope) -> tuple[Parameter, ...]:
    given = [a for a in _CONTENTS if a in element.attributes]
    name = scope.needed(element, "name")
    if name is None:
        return _any_of("", "its name is not known", scope, element.span)
    name = canonical(name.strip())
    what = f"the parameter `{name}`"
    if len(given) != 1 or not name:
        why = f"it needs one of {', '.join(_CONTENTS)}" if name else "its name is empty"
        scope.unknown(what, why, element.span)
        return ()
    kind = (element.get("type") or "auto").lower().strip()
    place = element.place_of(given[0])
    text = _content(element, given[0], scope)
    if kind == "yaml" and isinstance(text, str) and text.strip():
        return _named(name, _read(read_parameters(scope.source, text, lambda _: place), scope))
    value = text if isinstance(text, Open) else stored(text, kind)
    found = (Parameter(name, value, scope.source, place),)
    if not isinstance(value, Open):
        return found
    scope.unknown(what, value.why, place)
    return found + (_any_of(name, value.why, scope, place) if kind == "yaml" else ())


def _any_of(name: str, why: str, scope: LaunchScope, place: Span) -> tuple[Parameter, ...]:
    """What may set any parameter below a name."""
    below = f"{canonical(name).rstrip('/')}/{ANY}" if name else ANY
    return (Parameter(below, Open(why), scope.source, place),)


def _content(element: XmlElement, kind: str, scope: LaunchScope) -> Text:
    given = scope.text(element, kind)
    if given is None or isinstance(given, Open):
        return given or Open("it has no value")
    match kind:
        case "value":
            return given.strip()
        case "textfile":
            file = scope.reading.load(given)
            return Open(f"the file `{given}` is not at hand") if file is None else file.text
        case "binfile":
            return Open("the content of a binary file is not read")
        case _:
            return Open("the output of a command is known only when it runs")


def _read(read: Parameters, scope: LaunchScope) -> tuple[Parameter, ...]:
    scope.reading.unknowns.extend(read.unknowns)
    return read.entries


def _named(name: str, entries: tuple[Parameter, ...]) -> tuple[Parameter, ...]:
    return tuple(replace(entry, name=_below(name, entry.name)) for entry in entries)


def _below(name: str, inner: str) -> str:
    joined = join(name, inner) if inner else name
    return canonical(joined) if isinstance(joined, str) else name


# --- <rosparam> -----------------------------------------------------------------------------------


def _rosparam(element: XmlElement, scope: LaunchScope) -> tuple[Parameter, ...]:
    """`dump` and `delete` set nothing: they act before roslaunch sets any parameter."""
    command = scope.text(element, "command") or "load"
    if command in ("dump", "delete"):
        return ()
    name = join(scope.text(element, "ns") or "", scope.text(element, "param") or "")
    if isinstance(command, Open) or command != "load":
        why = command.why if isinstance(command, Open) else f"roslaunch has no `{command}`"
        scope.unknown("a <rosparam>", why, element.place_of("command"))
        return _any_of("", why, scope, element.span) if isinstance(command, Open) else ()
    if isinstance(name, Open) or name.startswith("~"):
        why = name.why if isinstance(name, Open) else "`~` stands for roslaunch itself here"
        scope.unknown("the name of a <rosparam>", why, element.span)
        return _any_of("", why, scope, element.span) if isinstance(name, Open) else ()
    read = _rosparam_content(element, scope)
    if isinstance(read, Open):
        what = f"the parameter `{name}`" if name else "the parameters of a <rosparam>"
        scope.unknown(what, read.why, element.place_of("file"))
        return _any_of(name, read.why, scope, element.span)
    entries = _read(read, scope)
    if not name and any(not entry.name for entry in entries):
        why = "a value that is no mapping needs the attribute `param`"
        scope.unknown("a <rosparam>", why, element.span)
        return ()
    return _named(name, entries) if name else entries


def _rosparam_content(element: XmlElement, scope: LaunchScope) -> Parameters | Open:
    path = scope.text(element, "file")
    if isinstance(path, Open):
        return path
    file = scope.reading.load(path) if path else None
    if path and file is None:
        return Open(f"the file `{path}` is not at hand")
    text = file.text if file else element.text
    substituted = _substituted(element, text, scope)
    if isinstance(substituted, Open):
        return substituted
    place: Callable[[Span], Span]
    if file is not None:
        place = (lambda span: span) if substituted == text else (lambda _: Span(0, 0))
        return read_parameters(file, substituted, place)
    place = element.place_in_text if substituted == text else (lambda _: element.span)
    return read_parameters(scope.source, substituted, place)


def _substituted(element: XmlElement, text: str, scope: LaunchScope) -> Text:
    """The text with `$(...)` replaced, where the tag asks for that."""
    wanted = scope.text(element, "subst_value")
    if isinstance(wanted, Open):
        return wanted
    match (wanted or "false").lower():
        case "false":
            return text
        case "true":
            return scope.substituted(text)
        case _:
            return Open("`subst_value` is neither true nor false")
