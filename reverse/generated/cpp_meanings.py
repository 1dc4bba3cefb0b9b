"""Names of generated code that somebody has given another meaning: by a macro, a type, a function.

What a body says is read by these names, so that the class in whose files they stand is not known.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from rebsync.names import CPP_KEYWORDS
from rebsync.records import dataclass
from rebsync.reserved import RESERVED, RUNTIME_CLASSES, RUNTIME_HEADERS
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.cpp_index import Code, CppClass
from rebsync.reverse.syntax.cpp_tree import Cpp, by_types, text_of

_MACROS = ("preproc_def", "preproc_function_def")
_ALIASES = ("alias_declaration", "type_definition")
_DECLARATORS = (
    "init_declarator",
    "parameter_declaration",
    "field_declaration",
    "function_declarator",
)
_NAME = re.compile(r"[A-Za-z_]\w*")
_WORD = re.compile(r"\w+\Z")
_RUNTIME = re.compile(rf"(?:^|/)(?:{'|'.join(RUNTIME_HEADERS)})\.h(?:pp)?\Z")
_HEADER = re.compile(r"\.(?:h|hh|hpp|hxx|inl|ipp|tpp)\Z", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Meaning:
    """A place that gives a name another meaning; a macro does so in what is included behind it."""

    name: str
    cpp: Cpp
    node: Node
    why: str
    is_macro: bool = False


def is_runtime_header(path: str) -> bool:
    """Whether a file is a header of the run-time part."""
    return _RUNTIME.search(path) is not None


def other_meanings(code: Code) -> tuple[Meaning, ...]:
    """All such places in what is not the run-time part."""
    own = [cpp for cpp in code.files if not is_runtime_header(cpp.source.path)]
    found = [m for cpp in own for m in _named_again(cpp)]
    macros = [m for cpp in own for m in _macros(cpp)]
    if macros:
        known = RESERVED | CPP_KEYWORDS
        known |= {name for cpp in own for name in (*_declared(cpp), *_of_others(cpp))}
        known |= {name for cpp in _of_runtime(code) for name in _NAME.findall(cpp.source.text)}
        found += [m for m in macros if m.name in known or m.name.startswith(libraries.logging())]
    for (owner, name), functions in code.definitions.items():
        if not owner and name in RESERVED:
            hiding = [f for f in functions if f.cpp in own and f.name != "main"]
            why = f'this stands beside the "{name}" of the run-time part'
            found += [Meaning(name, f.cpp, f.node, why) for f in hiding]
    for name in RUNTIME_CLASSES & code.all_classes.keys():
        why = f'this stands beside the "{name}" of the run-time part'
        found += [Meaning(name, c.cpp, c.node, why) for c in code.all_classes[name] if c.cpp in own]
    return tuple(found)


def in_files_of(code: Code, owner: CppClass, meaning: Meaning) -> bool:
    """Whether a name stands in the files of a class, and these may know the meaning."""
    files = {owner.cpp.source.path: owner.cpp}
    files |= {f.cpp.source.path: f.cpp for f in code.functions_of(owner)}
    place = meaning.cpp.source.path
    if not _HEADER.search(place) and place not in files:
        return False
    word = re.compile(rf"\b{meaning.name}\b")
    others = _of_runtime(code) if meaning.is_macro else []
    return any(word.search(cpp.source.text) for cpp in (*files.values(), *others))


def _of_runtime(code: Code) -> list[Cpp]:
    return [cpp for cpp in code.files if is_runtime_header(cpp.source.path)]


def _macros(cpp: Cpp) -> Iterator[Meaning]:
    for nodes in by_types(cpp.root, _MACROS).values():
        for node in nodes:
            name, value = node.child_by_field_name("name"), node.child_by_field_name("value")
            if name is not None and value is not None:
                why = f'what this macro makes of "{text_of(name)}" is not read'
                yield Meaning(text_of(name), cpp, node, why, is_macro=True)


def _declared(cpp: Cpp) -> Iterator[str]:
    """The names that declarations have in them: those of what they declare are among these."""
    for nodes in by_types(cpp.root, (*_DECLARATORS, "class_specifier", "enumerator")).values():
        for node in nodes:
            head = text_of(node).partition("{")[0].partition("=")[0]
            yield from _NAME.findall(head)


def _of_others(cpp: Cpp) -> Iterator[str]:
    """The names of what libraries have, or objects: `fill` of `std::fill` and of `array.fill`."""
    for nodes in by_types(cpp.root, ("qualified_identifier", "field_expression")).values():
        for node in nodes:
            yield from _NAME.findall(re.split(r"::|\.|->", text_of(node))[-1])


def _named_again(cpp: Cpp) -> Iterator[Meaning]:
    """Types under names that C++ or the run-time part has."""
    for nodes in by_types(cpp.root, _ALIASES).values():
        for node in nodes:
            for named in (node.child_by_field_name("name"), node.child_by_field_name("declarator")):
                name = text_of(named) if named is not None else ""
                if _WORD.match(name) and name in RESERVED:
                    yield Meaning(name, cpp, node, f'this makes "{name}" another type')
