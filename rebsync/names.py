"""Names of the model as ROS, C++ and Python can carry them, by rules that can be reversed.

`carry` keeps a name as it is where that is possible; a reserved one gains `_v`, so does a name
that looks like a carried one, which makes the rule injective. `graph_name` escapes what ROS graph
names (and C++) do not allow. `field_names` are lower_snake, as message fields have to be in ROS 2;
their originals stay in the signature of the handler, matched by position.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

CPP_KEYWORDS = frozenset(
    """
    alignas alignof and and_eq asm assert auto bitand bitor bool boolean break case catch char
    char16_t char32_t char8_t class co_await co_return co_yield compl concept const const_cast
    consteval constexpr constinit continue decltype default delete do double dynamic_cast else
    enum errno explicit export extern false float for friend goto if inline int linux long main
    mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public
    register reinterpret_cast requires return short signed sizeof static static_assert static_cast
    struct switch template this thread_local throw true try typedef typeid typename union unix
    unsigned using virtual void volatile wchar_t while xor xor_eq NULL EOF INT_MAX INT_MIN M_PI
    int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t
    alloca offsetof stdin stdout stderr timeradd timercmp timersub va_arg va_copy va_end va_start
    BIG_ENDIAN BUFSIZ BYTE_ORDER CHAR_BIT CHAR_MAX CHAR_MIN DOMAIN EXIT_FAILURE EXIT_SUCCESS
    FILENAME_MAX HUGE_VAL INFINITY INT8_MAX INT8_MIN INT16_MAX INT16_MIN INT32_MAX INT32_MIN
    INT64_MAX INT64_MIN LITTLE_ENDIAN LONG_MAX LONG_MIN MAXFLOAT M_E NAN NZERO OVERFLOW PATH_MAX
    RAND_MAX SHRT_MAX SHRT_MIN UINT8_MAX UINT16_MAX UINT32_MAX UINT_MAX UNDERFLOW
    """.split()
)
PYTHON_KEYWORDS = frozenset(
    """
    False None True and as assert async await break case class continue def del elif else except
    exec finally for from global if import in is lambda match nonlocal not or pass print raise
    return self try type while with yield
    """.split()
)
_MESSAGE_METHODS = frozenset(
    {"serialize", "serialize_numpy", "deserialize", "deserialize_numpy"}  # of Python's messages
)
# Nodes and parameters of ROS itself and of the run-time part.
TAKEN_NODES = frozenset(
    {
        *("control_bridge", "drive", "mailbox", "master", "rosdistro", "roslaunch", "rosout"),
        *("rosversion", "run_id", "use_sim_time"),
    }
)
_RESERVED_IN_CPP = re.compile(r"_[A-Z]|.*__")
_LEGAL_GRAPH_NAME = re.compile(r"[A-Za-z](_?[A-Za-z0-9])*_?\Z")
_ESCAPED = "esc_"
_CARRIED = re.compile(r"(.+?)((?:_v)*)\Z", re.DOTALL)


def carry(name: str, reserved: Collection[str]) -> str:
    """The name itself, or the name with `_v` behind it where `reserved` forbids it.

    A trailing underscore is reserved as well: it marks members.
    """
    plain = name if _is_word(name) else graph_name(name)
    return f"{plain}_v" if _stem_is_reserved(plain, reserved) else plain


def uncarry(carried: str, reserved: Collection[str]) -> str:
    """The model's name behind a carried one."""
    plain = carried
    if carried.endswith("_v") and _stem_is_reserved(carried[:-2], reserved):
        plain = carried[:-2]
    return original(plain)


def _stem_is_reserved(name: str, reserved: Collection[str]) -> bool:
    match = _CARRIED.match(name)
    stem = match.group(1) if match else name
    return stem in reserved or stem.endswith("_")


def _is_word(name: str) -> bool:
    legal = name.isascii() and "$" not in name and not _RESERVED_IN_CPP.match(name)
    return legal and not name.startswith(_ESCAPED)


def graph_name(name: str) -> str:
    """A name that every ROS graph and every C++ compiler accepts; `original` reverses it."""
    if _LEGAL_GRAPH_NAME.match(name) and not name.startswith(_ESCAPED):
        return name
    return _ESCAPED + "".join(_escape(c) for c in name)


def _escape(char: str) -> str:
    if char == "z":
        return "zz"
    return char if char.isascii() and char.isalnum() else f"z{ord(char):x}z"


def original(name: str) -> str:
    """The name that `graph_name` was given."""
    if not name.startswith(_ESCAPED):
        return name
    return re.sub(
        r"z([0-9a-f]*)z",
        lambda m: chr(int(m.group(1), 16)) if m.group(1) else "z",
        name[len(_ESCAPED) :],
    )


def free_name(name: str, taken: Collection[str]) -> str:
    """A graph name, with `_v` behind it where others have taken it; `uncarry` reverses it too."""
    plain = graph_name(name)
    match = _CARRIED.match(plain)
    return f"{plain}_v" if match and match.group(1) in taken else plain


def node_name(rebec: str) -> str:
    """The name of a rebec's node."""
    return free_name(rebec, TAKEN_NODES)


def snake_case(name: str) -> str:
    """`moveForward`, `R_1`, `HTTPServer` as `move_forward`, `r_1`, `http_server`."""
    plain = graph_name(name)
    parts = re.sub(r"([a-z0-9])([A-Z])|([A-Z])(?=[A-Z][a-z])", r"\1\3_\2", plain)
    return re.sub(r"_+", "_", parts).strip("_").lower()


def camel_case(name: str) -> str:
    """`moveForward`, `R_1` as `MoveForward`, `R1`: message types allow letters and digits only."""
    plain = graph_name(name)
    return "".join(part[:1].upper() + part[1:] for part in plain.split("_") if part)


def message_name(class_name: str, key: str) -> str:
    """The message type of a server, if no other has that name: its class and topic's last part."""
    return camel_case(class_name) + camel_case(key)


def message_class(message: str, key: str) -> str | None:
    """The class whose server a message type is named after, if the name tells it."""
    name = message.removesuffix(camel_case(key))
    return name if name and name != message and message_name(name, key) == message else None


def header_stem(name: str) -> str:
    """What rosidl calls the header of a message type: `HTTPState` has `http_state`."""
    words = re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", name)
    return re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", words).lower()


def field_names(names: Iterable[str], taken: Collection[str] = ()) -> tuple[str, ...]:
    """Message fields for parameters or variables, distinct from each other and from `taken`."""
    reserved = CPP_KEYWORDS | PYTHON_KEYWORDS | _MESSAGE_METHODS
    used = set(taken)
    fields = []
    for name in names:
        field = snake_case(name) or "value"
        if not field[0].isalpha():
            field = f"f_{field}"
        if field in reserved:
            field = f"{field}_value"
        fields.append(unique(field, used))
    return tuple(fields)


def unique(name: str, used: set[str], separator: str = "_") -> str:
    """The name, or the name with the first free number behind it; it is added to `used`."""
    candidate, number = name, 2
    while candidate in used:
        candidate = f"{name}{separator}{number}"
        number += 1
    used.add(candidate)
    return candidate
