"""What functions are as methods of the model, which is the same for all classes of a package."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from dataclasses import field

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.types.cpp_types import carried
from rebsync.reverse.nodes.node_views import is_header
from rebsync.reverse.syntax.cpp_declarations import with_defaults
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import text_of


@dataclass(frozen=True, slots=True)
class Signature:
    """What a method takes and gives back, None for nothing."""

    takes: tuple[m.Type, ...]
    returns: m.Type | None


@dataclass(frozen=True, slots=True)
class _Group:
    """The functions of one name outside of classes; `paths` are all files that have one.

    `shared` are those functions that stand in headers.
    """

    functions: tuple[CppFunction, ...]
    paths: frozenset[str]
    shared: frozenset[int]


@dataclass(slots=True)
class Signatures:
    """The signatures of functions, and those functions that stand outside of classes."""

    enums: frozenset[str]
    # By the ids of the functions' nodes; each function is kept, so that its tree is.
    _known: dict[int, tuple[CppFunction, Signature | None]] = field(default_factory=dict)
    # By the ids of codes, each kept too.
    _free: dict[int, tuple[Code, tuple[_Group, ...]]] = field(default_factory=dict)

    def of(self, function: CppFunction) -> Signature | None:
        """That of a function, if its parameters and result are of the model's types."""
        key = function.node.id
        if key not in self._known:
            self._known[key] = function, self._read(function)
        return self._known[key][1]

    def _read(self, function: CppFunction) -> Signature | None:
        takes = []
        for parameter in function.parameters:
            type_ = carried(parameter.type, self.enums)
            declarator = parameter.node.child_by_field_name("declarator")
            plain = declarator is not None and declarator.type == "identifier"
            if type_ is None or type_.bits or type_.why or not plain:
                return None
            takes.append(type_.type)
        result = carried(function.result, self.enums) if function.result else None
        void = function.result is not None and text_of(function.result) == "void"
        if not void and (result is None or result.bits or result.why):
            return None
        return Signature(tuple(takes), result.type if result else None)

    def free(self, code: Code, near: Set[str]) -> Iterator[CppFunction]:
        """The functions outside of classes that functions in files `near` each other can call."""
        for group in self._groups(code):
            if len(group.paths) == 1 or group.paths.isdisjoint(near):
                yield from group.functions
                continue
            for function in group.functions:
                if function.cpp.source.path in near or function.node.id in group.shared:
                    yield function

    def _groups(self, code: Code) -> tuple[_Group, ...]:
        if id(code) not in self._free:
            groups = [
                all_of
                for (owner, name), all_of in code.definitions.items()
                if not owner and name != "main"
            ]
            self._free[id(code)] = code, tuple(map(_group, groups))
        return self._free[id(code)][1]


def _group(functions: Sequence[CppFunction]) -> _Group:
    paths = frozenset({f.cpp.source.path for f in functions})
    shared = frozenset({f.node.id for f in functions if is_header(f.cpp)})
    own = tuple(with_defaults(f, ()) for f in functions if f.body is not None)
    return _Group(own, paths, shared)
