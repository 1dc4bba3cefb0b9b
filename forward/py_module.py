"""The module of one class of nodes in Python, and that of what its sensors have seen."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from rebsync.forward.py_class import PyClass
from rebsync.forward.py_imports import imports, words_of
from rebsync.forward.py_layout import INDENT, indented
from rebsync.forward.py_messages import sends, server_constants, shims
from rebsync.forward.py_types import py_type, py_value
from rebsync.forward.py_wiring import PyWords, class_lines, publish_state
from rebsync.package import Draw, Sensor
from rebsync.printing import print_line

VALUES = (
    *("AT_ONCE", "NO_PRIORITY", "NULL", "Array", "Byte", "Float", "Rebec", "Server", "Short"),
    *("When", "array", "before", "block", "boolean", "copied", "divide", "flatten", "float32"),
    *("float64", "global_priority", "int8", "int16", "int32", "modulus", "power", "priority"),
    *("put", "put_item", "quotient", "remainder", "rounds", "shift_left", "shift_right"),
    *("square_root", "switch", "text", "to_boolean", "to_byte", "to_double", "to_float", "to_int"),
    *("to_rebec", "to_short", "unflatten"),
)
_MAILBOX = ("KEPT", "QUEUE_SIZE", "Mailbox", "Served", "declare_array", "read_array", "to")


def class_module(
    c: PyClass, words: PyWords, model_name: str, ros: Mapping[str, Iterable[str]]
) -> str:
    """`src/<package>/<class>.py`; `ros` are the names of the client library that it may use."""
    body, constants = _class(c, words), server_constants(c)
    used = words_of([*constants, *body])
    text = [f'"""The {_kind(c)} {c.node.name} of {model_name}{_role(c)}."""']
    text += ["", "from __future__ import annotations", "", *_imports(c, words, used, ros)]
    if constants:
        text += [*constants, ""]
    return "\n".join([*text, "", *body]) + "\n"


def _kind(c: PyClass) -> str:
    return "interface" if c.node.interface else "reactive class"


def _role(c: PyClass) -> str:
    return ": one ROS node for each of its rebecs" if c.node.executable else ""


def _imports(
    c: PyClass, words: PyWords, used: set[str], ros: Mapping[str, Iterable[str]]
) -> list[str]:
    package = c.package.name
    others = _other_classes(c, used)
    typing = {"Any", "Literal"} & used | ({"TYPE_CHECKING"} if others else set())
    groups = [
        imports(used, {"abc": ("ABC", "abstractmethod")}) + imports(typing, {"typing": typing}),
        [*_of_library(used, ros), *_messages_of_others(c, used)],
        imports(used, _own_modules(c, words)),
    ]
    lines = [line for g in groups if g for line in (*g, "")]
    if others:
        files = {f"{package}.{file}": (name,) for name, file in others.items()}
        lines += ["if TYPE_CHECKING:", *imports(others, files, INDENT), ""]
    return lines


def _of_library(used: set[str], ros: Mapping[str, Iterable[str]]) -> list[str]:
    """What is used of the client library; a module without names is imported whole."""
    lines = [f"import {module}" for module, names in ros.items() if not names and module in used]
    return [*lines, *imports(used, ros)]


def _own_modules(c: PyClass, words: PyWords) -> Mapping[str, Iterable[str]]:
    package = c.package.name
    messages = {m.name for m in c.package.messages} | {n.state.name for n in c.package.classes}
    messages |= {s.type for s in c.node.sensors if s.stands_in} | {"Timing"}
    modules: dict[str, Iterable[str]] = {
        f"{package}.drive": ("Drive",),
        f"{package}.lifecycle": ("RebecNode",),
        f"{package}.mailbox": _MAILBOX,
        words.messages(package): messages,
        words.offers(package, False): [words.offer(s) for s in c.package.services],
        f"{package}.sensor": ("Sensor",),
        f"{package}.startup": ("declared",),
        f"{package}.values": VALUES,
    }
    place, actions = words.offers(package, True), c.package.actions
    modules[place] = {*modules.get(place, ()), *map(words.offer, actions)}
    types = c.statements.expressions.class_types
    for base in c.node.bases:
        modules[f"{package}.{c.package.node_class(base).file}"] = (types[base],)
    seen = [n for names in c.names.seen.values() for n in names]
    if seen:
        modules[f"{package}.{c.node.file}_sensors"] = seen
    return dict(sorted(modules.items()))


def _messages_of_others(c: PyClass, used: set[str]) -> list[str]:
    """The message types of bound sensors."""
    modules: dict[str, list[str]] = {}
    for type_ in sorted({s.type for s in c.node.sensors if not s.stands_in}):
        package, _, name = type_.rpartition("/")
        modules.setdefault(f"{package}.msg", []).append(name)
    return imports(used, modules)


def _other_classes(c: PyClass, used: set[str]) -> dict[str, str]:
    """The other classes that annotations name, and their files."""
    types = c.statements.expressions.class_types
    return {
        types[n.name]: n.file
        for n in sorted(c.package.classes, key=lambda n: n.file)
        if types[n.name] in used and n.name != c.node.name and n.name not in c.node.bases
    }


def _class(c: PyClass, words: PyWords) -> list[str]:
    markers = [f"annotation {print_line(a).strip()}" for a in c.node.annotations]
    markers.append(f"{'interface' if c.node.interface else 'reactiveclass'} {c.node.name}")
    functions = class_lines(c, words)
    if c.owns_mailbox:
        functions.append(_mailbox())
    functions += [*c.constructs(), *c.handlers(), *c.functions()]
    if not c.node.interface:
        functions += [*shims(c), *sends(c)]
    if c.node.executable:
        functions.append(publish_state(c))
    bases = [words.base()] if c.owns_mailbox and words.base() else []
    bases += c.base_types
    if c.is_abstract:
        bases.append("ABC")
    head = f"class {c.type_name}({', '.join(bases)}):" if bases else f"class {c.type_name}:"
    lines = [*(f"# rebsync: {m}" for m in markers), head]
    for i, function in enumerate(functions):
        lines += [*([""] if i else []), *indented(function)]
    return lines if functions else [*lines, "    pass"]


def _mailbox() -> list[str]:
    return ["@property", "def mailbox(self) -> Mailbox:", "    return self._mailbox"]


def sensors_module(c: PyClass, words: PyWords) -> str:
    """`<class>_sensors.py`: the user's part of the sensors."""
    functions: list[str] = []
    for sensor in c.node.sensors:
        named = zip(sensor.draws, c.names.seen[sensor.server], strict=True)
        for index, (draw, name) in enumerate(named):
            type_ = sensor.type.rpartition("/")[2]
            head = f"def {name}(msg: {type_}) -> {py_type(draw.type)}:"
            functions += [*([""] * 2 if functions else []), head]
            functions.append(f"    return {_read(sensor, draw, index)}")
    own = {s.type for s in c.node.sensors if s.stands_in}
    used = words_of(functions)
    modules = {words.messages(c.package.name): own, f"{c.package.name}.values": VALUES}
    groups = [_messages_of_others(c, used), imports(used, dict(sorted(modules.items())))]
    text = [
        f'"""What the sensors of {c.node.name} have seen, as the model\'s values.',
        "",
        "Yours to write: regeneration keeps it.",
        '"""',
        "",
        "from __future__ import annotations",
        "",
        *(line for g in groups if g for line in (*g, "")),
        "",
        f"# rebsync: user {c.node.name}.sensors",
        *functions,
        "",
        "",
        "# rebsync: end",
    ]
    return "\n".join(text) + "\n"


def _read(sensor: Sensor, draw: Draw, index: int) -> str:
    if sensor.stands_in:
        return f"msg.{draw.field}"
    if sensor.seen and index == 0:
        return sensor.seen
    return py_value(draw.alternatives[0]) if draw.alternatives else f"{py_type(draw.type)}()"
