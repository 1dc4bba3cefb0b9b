"""Elements and objects that generated C++ looks up, and that may not be there.

The language leaves undefined what such a statement does; the node may end. Members, variables of
the file and locals are looked at by their declarations: arrays beyond their ends, sequences that
may be empty, pointers and optionals that nothing sets, and texts that a pointer may not lead to. A
condition around, or before, that asks for them makes them sure.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from tree_sitter import Node

from rebsync.reverse.bodies.cpp_present import Question, is_asked
from rebsync.reverse.bodies.effects.cpp_formats import texts_in
from rebsync.reverse.bodies.effects.cpp_indices import Indices
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass
from rebsync.reverse.syntax.cpp_tree import inside, named, operator_of, part, squeezed, text_of

_QUALIFIERS = r"(?:static|const(?:expr)?|mutable|inline|thread_local)*"
_ARRAY = re.compile(_QUALIFIERS + r"(?:(?:std::)?array<.*,(\d+)>&?\w+|[\w:<>,]+\[(\d+)\])")
_SEQUENCE = re.compile(
    _QUALIFIERS + r"(?:std::)?(?:(?:vector|deque|list|(?:unordered_)?(?:multi)?(?:map|set)|stack"
    r"|(?:priority_)?queue)<|string[&\w]+)"
)
# What a constant sequence is made of: elements in braces that call nothing, or a text.
_GIVEN = re.compile(r"const.*?\w=?(?:\{+([^{}();]+)\}+|\(?\{?\"([^\"\\]*)\"[})]?);?")
_POINTER = re.compile(r"(?:std::)?(?:shared_ptr|unique_ptr|optional)<|[\w:]+\*")
_KINDS = (
    *("subscript_expression", "pointer_expression", "call_expression", "field_expression"),
    "declaration",
)
_ENVIRONMENT = re.compile(r"(?:std::)?getenv\(")
_OF_NUMBERS = re.compile(
    r"(?:static|const(?:expr)?|mutable|std::|unsigned)*"
    r"(?:u?int(?:8|16|32|64)_t|size_t|int|long|unsigned|float|double|bool)(?!.*\*)"
)
_NOTHING = ("", "nullptr", "std::nullopt", "{", "NULL", "0")
_ENDS = frozenset({"front", "back", "top", "pop", "pop_back", "pop_front"})
_FIRST = re.compile(r"(?:std::(?:next|prev)\()?(\w+)\.(?:c?begin|c?rbegin|c?end)\(\).*")
_SEARCH = re.compile(
    r"(?:std::)?(?:find|find_if|lower_bound|upper_bound)\(.*|\w+\.find\(.*|\w+\.lock\(\)"
)
_DECLARATORS = ("init_declarator", "array_declarator", "reference_declarator", "pointer_declarator")
_BODIES = ("function_definition", "lambda_expression")
_GREATEST = re.compile(r"(?:std::)?(?:max|min)_element\((\w+)\.c?begin\(\),.*")


def unsure_lookups(code: Code, owner: CppClass, log: Node) -> list[Node]:
    """What a statement, or a body, looks up and nothing shows to be there."""
    line = code.lineage(owner.name)
    declared = [d for above in line for d in inside(above.node, "field_declaration")]
    members = {text_of(n): squeezed(d) for d in declared for n in inside(d, "field_identifier")}
    members |= _variables(code, log)
    functions = (f for above in line for f in code.functions_of(above))
    texts = [text_of(f.node) for f in functions]
    look = _Lookups(members, texts, Indices(code, members))
    return [n for n in inside(log, *_KINDS) if look.is_unsure(n)]


def _variables(code: Code, log: Node) -> dict[str, str]:
    """The declarations of the variables that a log looks something up in, those of locals last."""
    names = {text_of(n) for look in inside(log, *_KINDS) for n in inside(look, "identifier")}
    found: dict[str, str] = {}
    around = climb(log, lambda above: above.type == "function_definition")
    for cpp in code.files if names else ():
        outside: dict[str, str] = {}
        locals_: dict[str, str] = {}
        for name in code.named(cpp, cpp.root, sorted(names)):
            declared = climb(name, lambda above: above.type not in _DECLARATORS)
            if declared is None or declared.type not in ("declaration", "parameter_declaration"):
                continue
            function = climb(name, lambda above: above.type == "function_definition")
            if function is None or function == around:
                kept = outside if function is None else locals_
                kept[text_of(name)] = squeezed(declared)
        found |= outside | locals_
    return found


def looked_up_in(lookup: Node) -> str:
    """The variable that something is looked up in: `holders` of `holders[0].x` and `*holders`."""
    found = re.search(r"\w+", squeezed(lookup).removeprefix("*").removeprefix("this->"))
    return found[0] if found is not None else ""


class _Lookups:
    """Looks up members and variables by their declarations, without layout.

    `texts` are those of functions.
    """

    def __init__(self, members: Mapping[str, str], texts: list[str], indices: Indices) -> None:
        self._members = members
        self._texts = texts
        self._indices = indices

    def is_unsure(self, node: Node) -> bool:
        """Whether what an expression looks up may not be there."""
        match node.type:
            case "subscript_expression":
                return self._beyond(node)
            case "pointer_expression" if text_of(node).startswith("*"):
                return self._of_nothing(node, part(node, "argument"))
            case "field_expression" if operator_of(node) == "->":
                return self._of_nothing(node, part(node, "argument"))
            case "call_expression" if any(map(self._is_no_text, named(part(node, "arguments")))):
                return True
            case "call_expression" if (call := call_of(node)) is not None and any(
                _OF_NUMBERS.match(self._declared(text)[1]) for text in texts_in(call)
            ):
                return True
            case "declaration" if re.search(r"\bstring\b", text_of(part(node, "type"))):
                values = (d.child_by_field_name("value") for d in named(node))
                return any(self._is_no_text(v) for v in values if v is not None)
            case "call_expression" if not named(part(node, "arguments")):
                function = part(node, "function")
                if function.type != "field_expression":
                    return False
                name, _ = self._declared(part(function, "argument"))
                return text_of(part(function, "field")) in _ENDS and self._is_empty(node, name)
            case _:
                return False

    def _declared(self, place: Node) -> tuple[str, str]:
        """The member that a place is, and how it is declared; empty for what is none."""
        name = squeezed(place).removeprefix("this->").removesuffix(".data()")
        return name, self._members.get(name, "")

    def _beyond(self, node: Node) -> bool:
        whole = named(node)[0]
        name, declared = self._declared(whole)
        index = squeezed(part(node, "indices")).strip("[]")
        found = _ARRAY.match(declared)
        if not index.isdecimal():  # of locals they are trusted, what comes and what is kept is not
            is_table = "map<" in declared
            return not is_table and (
                _is_untested_parameter(index, node) or self._indices.is_unsure(node)
            )
        if found is not None:
            return int(index) >= int(found[1] or found[2])
        is_table = re.search(r"(?:map|set)<", declared.partition("<")[0] + "<") is not None
        return not is_table and self._is_empty(node, name, int(index))

    def _is_empty(self, node: Node, name: str, at: int = 0) -> bool:
        """Whether a sequence, or a table, may have no element there."""
        declared = self._members.get(name, "")
        if _SEQUENCE.match(declared) is None or _length(declared) > at:
            return False
        return not is_asked(node, name, Question.ELEMENTS)

    def _of_nothing(self, node: Node, argument: Node) -> bool:
        """Whether there may be no object behind a pointer, or an iterator."""
        text = squeezed(argument)
        if "nullptr" in text:
            return True
        found = _FIRST.fullmatch(text) or _GREATEST.fullmatch(text)
        if found is not None:
            return self._is_empty(node, found[1])
        if _SEARCH.fullmatch(text):
            return True
        name, declared = self._declared(argument)
        if _POINTER.match(declared.removeprefix("const")) is None:
            return False
        return not self._is_set(name, declared) and not is_asked(node, name, Question.OBJECT)

    def _is_no_text(self, value: Node) -> bool:
        """Whether a pointer to a text, which a function or a string gets, may lead to none."""
        if _ENVIRONMENT.search(squeezed(value)) and value.type == "call_expression":
            return True
        name, declared = self._declared(value)
        if "char*" not in declared or value.type not in ("identifier", "field_expression"):
            return False
        return not self._is_set(name, declared) and not is_asked(value, name, Question.OBJECT)

    def _is_set(self, name: str, declared: str) -> bool:
        """Whether something gives a pointer or an optional what it points to."""
        given = re.search(rf"{name}(?:=|\{{|\()(.*?)[;}})]", declared)
        if given is not None and given[1] not in _NOTHING and not _ENVIRONMENT.match(given[1]):
            return True
        stores = (
            r"=(?!=)(?!\s*(?:nullptr|std::nullopt|NULL|0;))|\.(?:reset|emplace)\((?!\s*\))|\{|\("
        )
        sets = re.compile(rf"\b{name}\s*(?:{stores})")
        return any(sets.search(text) for text in self._texts)


def _length(declared: str) -> int:
    """How many elements a constant sequence has at least, by what it is declared with."""
    given = _GIVEN.fullmatch(declared)
    if given is None:
        return 0
    if given[1]:
        return 1 if "{{" in declared else given[1].count(",") + 1
    return len(given[2] or "")


def _is_untested_parameter(index: str, node: Node) -> bool:
    """Whether an index is a parameter of the function around, which nothing before it looks at."""
    function = climb(node, lambda above: above.type in _BODIES)
    if function is None or not index.isidentifier():
        return False
    names = inside(part(function, "declarator"), "parameter_declaration")
    if not any(index == text_of(n) for p in names for n in inside(p, "identifier")):
        return False
    before = text_of(function)[: node.start_byte - function.start_byte]
    body = before.partition("{")[2]
    return re.search(rf"\b{index}\b", body) is None
