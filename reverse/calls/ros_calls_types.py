"""Message and service types as code names them: `package/Type`."""

from __future__ import annotations

import re
from dataclasses import field

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.build.common_messages import COMMON
from rebsync.reverse.graph import Unresolved
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.values.cpp_flow import nearness
from rebsync.reverse.values.cpp_values import Values
from rebsync.reverse.values.cpp_values_plain import at

_INCLUDE = re.compile(rb'#[ \t]*include[ \t]*[<"](\w+)/(\w+)\.h[>"]')
# Begins with letters, for which the library searches much quicker than for the bound of a word.
_SPACE = re.compile(rb"namespace(?<!\wnamespace)\s+(\w+)\s*=\s*([\w:]+)\s*;")
_USED = re.compile(rb"using(?<!\wusing)\s+namespace\s+(\w+_msgs|std_srvs)\s*;")
# `using std_msgs::msg::String;`, and the headers of ROS 2, named in small letters.
_USING = re.compile(rb"using(?<!\wusing)\s+(\w+)::(?:msg|srv|action)::(\w+)\s*;")
_HEADER = re.compile(rb'#[ \t]*include[ \t]*[<"](\w+)/(?:msg|srv|action)/(\w+)\.hpp[>"]')
_KINDS = frozenset({"msg", "srv", "action"})
_OF_ROS2 = frozenset(kind.encode() for kind in _KINDS)
_WRAPPERS = frozenset({"shared_ptr", "MessageEvent", "ServiceEvent", "unique_ptr"})
_INNER = frozenset(
    {
        *("ConstPtr", "Ptr", "Request", "Response", "SharedPtr", "ConstSharedPtr", "UniquePtr"),
        *("ConstUniquePtr", "WeakPtr"),
    }
)
# Templates that make one type of a message of two others, the message last.
_ADAPTED = frozenset({"TypeAdapter"})
_ENDINGS = ("ConstPtr", "Ptr", "Request", "Response")


def is_interface(name: str) -> bool:
    """Whether a scoped name of C++ is of a message, service or action: `a::msg::B`."""
    return not _KINDS.isdisjoint("".join(name.split()).split("::")[:-1])


@dataclass(slots=True)
class CppMessageTypes:
    """Finds out which message a type of C++ is."""

    values: Values
    _includes: dict[int, dict[str, str]] = field(default_factory=dict)
    _including: dict[str, list[Cpp]] = field(default_factory=dict)  # files, by what they include
    _spaces: dict[int, dict[str, str]] = field(default_factory=dict)

    def of(self, cpp: Cpp, type_: Node, depth: int = 0) -> str | Unresolved:
        """The message type that a type of C++ stands for, or is a pointer or event of."""
        if type_.type in ("type_descriptor", "dependent_type"):
            inner = type_.child_by_field_name("type") or type_.named_children[-1]
            return self.of(cpp, inner, depth)
        parts, last = _parts(type_)
        if last.type in ("template_type", "template_function"):
            name, given = text_of(part(last, "name")), named(part(last, "arguments"))
            if name in _ADAPTED and len(given) == 2:
                return self.of(cpp, given[1], depth + 1)
            if name in _WRAPPERS and given:
                return self.of(cpp, given[0], depth + 1)
            parts = [*parts[:-1], name.removesuffix("_")]
        if type_.type == "placeholder_type_specifier" or depth > 8:
            return Unresolved("a type that is left to the compiler", at(cpp, type_))
        while len(parts) > 1 and parts[-1] in _INNER:
            parts.pop()
        return self._named(cpp, type_, parts, depth)

    def _named(self, cpp: Cpp, type_: Node, parts: list[str], depth: int) -> str | Unresolved:
        name = parts[-1]
        if len(parts) > 2 and parts[-2] in _KINDS:
            return f"{self._space(cpp, parts[-3])}/{name}"
        aliases = self.values.code.aliases.get(name, [])
        others = [a for a in aliases if a.type.id != type_.id]
        if others and (len(parts) == 1 or not self._package(cpp, name)):
            best = max(others, key=lambda a: nearness(a.cpp, cpp))
            return self.of(best.cpp, best.type, depth + 1)
        plain = name
        for ending in _ENDINGS:
            if name.endswith(ending) and name != ending:
                plain = name.removesuffix(ending)
                break
        if len(parts) > 1:
            known = self._package(cpp, name) == parts[-2]
            return f"{self._space(cpp, parts[-2])}/{name if known else plain}"
        if self._is_parameter(type_, name):
            return Unresolved(f"the parameter {name} of a template", at(cpp, type_))
        for candidate in (name, plain):
            if package := self._package(cpp, candidate):
                return f"{package}/{candidate}"
        used = {p.decode() for p in _USED.findall(cpp.original)}
        used = {p for p in used if f"{p}/{plain}" in COMMON} or used
        if len(used) == 1:
            return f"{used.pop()}/{plain}"
        return Unresolved(f"no message type {name} is included", at(cpp, type_))

    def _space(self, cpp: Cpp, name: str) -> str:
        """The namespace that another name for one stands for."""
        if id(cpp) not in self._spaces:
            found = _SPACE.findall(cpp.original)
            self._spaces[id(cpp)] = {k.decode(): f.decode().rpartition("::")[2] for k, f in found}
        return self._spaces[id(cpp)].get(name, name)

    def _package(self, cpp: Cpp, name: str) -> str | None:
        """The package whose header of a message a file includes, or one near to it."""
        own = self._included(cpp).get(name)
        if own is not None:
            return own
        if not self._including:
            for file in self.values.code.files:
                for each in self._included(file):
                    self._including.setdefault(each, []).append(file)
        others = self._including.get(name)
        if others is None:
            return None
        return self._included(max(others, key=lambda c: nearness(c, cpp)))[name]

    def _included(self, cpp: Cpp) -> dict[str, str]:
        if id(cpp) not in self._includes:
            data = cpp.original
            found = []
            if not cpp.words.isdisjoint(_OF_ROS2):
                found += [(p, _camel(n)) for p, n in _HEADER.findall(data)]
            found += _INCLUDE.findall(data)
            if b"using" in cpp.words and not cpp.words.isdisjoint(_OF_ROS2):
                found += _USING.findall(data)
            self._includes[id(cpp)] = {n.decode(): p.decode() for p, n in found}
        return self._includes[id(cpp)]

    def _is_parameter(self, type_: Node, name: str) -> bool:
        around = climb(type_, lambda n: n.type == "template_declaration")
        while around is not None:
            if name in text_of(part(around, "parameters")).replace(",", " ").strip("<>").split():
                return True
            around = climb(around, lambda n: n.type == "template_declaration")
        return False


def _camel(name: bytes) -> bytes:
    """The type whose header has a name: `PointCloud2` for `point_cloud2`."""
    return b"".join(word[:1].upper() + word[1:] for word in name.split(b"_"))


def _parts(type_: Node) -> tuple[list[str], Node]:
    """The names of a qualified name, and the node of the last."""
    parts: list[str] = []
    while type_.type == "qualified_identifier":
        scope = type_.child_by_field_name("scope")
        if scope is not None:
            text = text_of(scope).partition("<")[0]
            parts.append(text.removesuffix("_") if "<" in text_of(scope) else text)
        type_ = part(type_, "name")
    return [*parts, text_of(type_).partition("<")[0]], type_
