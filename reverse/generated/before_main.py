"""What a program of generated classes does besides its `main`, by what stands outside of functions.

Objects of namespace scope are initialised before `main` ([basic.start.dynamic]), as are static
members; a function may be a constructor of the program, or stand in place of one of a library
([replacement.functions]); a specialisation stands in place of a template of the run-time part. And
a destructor runs when a node ends. What of these is not known to do nothing is listed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.bodies.effects.known_functions import acts, is_known, starts_nothing
from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.generated.cpp_hand import is_passive
from rebsync.reverse.generated.cpp_idle import working
from rebsync.reverse.generated.cpp_meanings import is_runtime_header
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, calls_in
from rebsync.reverse.syntax.cpp_index import CONTAINERS, Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, part, text_of

_INITIALISED = "this is initialised before `main`: what it does then is not in the model"
_REPLACED = "this may stand in place of a function of a library or of the run-time part"
_OTHERWISE = "what the compiler makes of the code because of this is not in the model"
_ENDING = "this runs when the node ends: what it does is not in the model"
_REGISTERS = frozenset(
    {"RCLCPP_COMPONENTS_REGISTER_NODE", "PLUGINLIB_EXPORT_CLASS", "CLASS_LOADER_REGISTER_CLASS"}
)
_CLASSES = ("class_specifier", "struct_specifier", "union_specifier")
_PRAGMA = re.compile(
    r"#\s*pragma\s+(?!once\b|GCC\s+diagnostic|clang\s+diagnostic|warning\b|region\b|endregion\b)"
)
# Attributes that change neither when code runs, nor what it does, nor which of several is taken.
_CALM_ATTRIBUTE = re.compile(
    r"(?:(?:gnu|clang)::)?(?:_*(?:(?:maybe_)?unused|deprecated|nodiscard|warn_unused_result"
    r"|fallthrough|(?:un)?likely|noinline|always_inline|hot|cold|format|visibility)_*)\Z"
)
_ATTRIBUTES = ("attribute_specifier", "attribute_declaration", "ms_declspec_modifier")
_ASSEMBLED = "gnu_asm_expression"
_REPLACEABLE = re.compile(r"\boperator\s*(?:new|delete)\b")
_PLAIN = re.compile(
    r"(?:(?:std::)?(?:u?int(?:8|16|32|64)?(?:_t)?|size_t|float|double|bool|char|long|short|unsigned"
    r"|signed)\s*)+\Z|(?:std::)?(?:string_view|array<.*>|(?:unique|shared)_ptr<.*>"
    r"|mutex|atomic<.*>|chrono::[\w:<>, ]+)\Z",
    re.DOTALL,
)
_DEEPEST = 8  # of classes and names for types within each other
_REFERRING = ("pointer_declarator", "reference_declarator")
_TYPE_NAMES = ("type_identifier", "identifier")
_CONSTANT = ("constexpr", "constinit")
_STOP = "mailbox_.stop();"  # as it is generated
_WORDS = ("true", "false", "null")
_RUNNING = (
    *("new_expression", "delete_expression", "assignment_expression", "update_expression"),
    *("throw_statement", "co_await_expression"),
)
_CALLABLE = ("identifier", "qualified_identifier", "field_expression", "template_function")
_RUN_TIME = frozenset({"Server", "When"})  # the plain records of the run-time part


def beside_main(code: Code) -> Iterator[Finding]:
    """All such places in files that are not of the run-time part."""
    for cpp in code.files:
        if not is_runtime_header(cpp.source.path):
            for node, why in (*_told_to_compiler(cpp), *_outside(code, cpp, cpp.root)):
                yield Finding(Grade.UNREADABLE, cpp.source, cpp.span(node), why)


def at_the_end(code: Code, owner: CppClass) -> Iterator[Finding]:
    """The destructors of a class and of those above it that do anything."""
    for above in code.lineage(owner.name):
        for function in code.functions_of(above):
            ending = working(function.body) if function.name == f"~{above.name}" else ()
            if any(text_of(statement) != _STOP for statement in ending):
                span = function.cpp.span(function.node)
                yield Finding(
                    Grade.UNREADABLE, function.cpp.source, span, _ENDING, within=owner.name
                )


def _told_to_compiler(cpp: Cpp) -> Iterator[tuple[Node, str]]:
    """Attributes that are not known to be calm, and what is written for the assembler."""
    for node in inside(cpp.root, *_ATTRIBUTES, _ASSEMBLED):
        if node.type == _ASSEMBLED or not all(map(_CALM_ATTRIBUTE.match, _attributes(node))):
            yield node, _OTHERWISE


def _attributes(node: Node) -> list[str]:
    """The names of attributes, without their arguments."""
    if node.type == "attribute_declaration":
        return [text_of(each).partition("(")[0] for each in named(node)]
    within = text_of(node).partition("(")[2].removeprefix("(")
    return re.findall(r"[\w:]+", re.sub(r"\([^()]*\)", "", within))


def _outside(code: Code, cpp: Cpp, scope: Node) -> Iterator[tuple[Node, str]]:
    """What the declarations of a namespace do."""
    for node in named(scope):
        match node.type:
            case "declaration":
                yield from _declared(code, node)
            case "function_definition":
                yield from _function(node)
            case "expression_statement":
                call = call_of(named(node)[0]) if named(node) else None
                if call is not None and call.name not in _REGISTERS:
                    yield node, _INITIALISED
            case "preproc_call" if _PRAGMA.match(text_of(node)):
                yield node, _OTHERWISE
            case "template_declaration" if _is_specialisation(node):
                if not _is_of_own(code, node):
                    yield node, _REPLACED
                yield from _outside(code, cpp, node)
            case kind if kind in _CLASSES:
                yield from _static_members(code, node)
            case kind if kind in CONTAINERS:
                yield from _outside(code, cpp, node)
            case _:
                pass


def _function(node: Node) -> Iterator[tuple[Node, str]]:
    above = node.parent
    linkage = above.parent if above is not None and above.type == "declaration_list" else above
    is_c = linkage is not None and linkage.type == "linkage_specification"
    if is_c or _REPLACEABLE.search(text_of(node).partition("{")[0]):
        yield node, _REPLACED


def _declared(code: Code, node: Node) -> Iterator[tuple[Node, str]]:
    """A declaration of variables of which one is initialised by what may do anything."""
    declarators = node.children_by_field_name("declarator")
    initialised = any(d.type == "init_declarator" for d in declarators)
    if not initialised and any(_of_function(d) for d in declarators):
        return
    words = {text_of(child) for child in node.children}
    is_elsewhere = "extern" in words and not initialised
    if not declarators or is_elsewhere or not words.isdisjoint(_CONSTANT):
        return
    is_plain = _names_plain(code, node) and all(
        _is_plain_value(code, d.child_by_field_name("value")) for d in declarators
    )
    pointer = all(_inner(d).type == "pointer_declarator" for d in declarators)
    type_ = node.child_by_field_name("type")
    if not is_plain or not (pointer or (type_ is not None and _is_plain_type(code, type_))):
        yield node, _INITIALISED


def _names_plain(code: Code, node: Node) -> bool:
    """Whether the package's classes named in values, or given to templates, do nothing."""
    values = [d.child_by_field_name("value") for d in inside(node, "init_declarator")]
    given = (*inside(node, "template_argument_list"), *(v for v in values if v is not None))
    names = {text_of(name) for each in given for name in inside(each, *_TYPE_NAMES)}
    own = (c for name in names - _RUN_TIME for c in code.all_classes.get(name, ()))
    return all(_does_nothing(code, c) for c in own)


def _operates(code: Code, value: Node) -> bool:
    """Whether a value may be made by an operator, or a conversion, that does more than that."""
    if value.type.endswith("_literal") or value.type in _WORDS:
        return value.type == "user_defined_literal"
    members = (f for found in code.all_classes.values() for c in found for f in c.functions)
    every = (*members, *(f for found in code.definitions.values() for f in found))
    own = (f for f in every if f.name.startswith("operator") and not _is_ours(f))
    return any(not _only_gives(f) for f in own)


def _of_function(declarator: Node) -> bool:
    return declarator.type == "function_declarator" or bool(
        inside(declarator, "function_declarator")
    )


def _inner(declarator: Node) -> Node:
    if declarator.type == "init_declarator":
        return part(declarator, "declarator")
    return declarator


def _static_members(code: Code, owner: Node) -> Iterator[tuple[Node, str]]:
    body = owner.child_by_field_name("body")
    for field in named(body) if body is not None else ():
        if field.type != "field_declaration":
            continue
        words = {text_of(child) for child in field.children}
        value = field.child_by_field_name("default_value")
        if "static" in words and value is not None and not _is_plain_value(code, value):
            yield field, _INITIALISED


def _is_plain_value(code: Code, value: Node | None) -> bool:
    """Whether to evaluate an expression does nothing but to give its value."""
    if value is None:
        return True
    if inside(value, *_RUNNING, "compound_statement") and not _only_lambda(value):
        return False
    if _operates(code, value):
        return False
    called = (c.child_by_field_name("function") for c in inside(value, "call_expression"))
    if any(f is not None and f.type not in _CALLABLE for f in called):
        return False
    return _only_lambda(value) or all(_is_plain_call(code, call) for call in calls_in(value))


def _only_lambda(value: Node) -> bool:
    return value.type == "lambda_expression"


def _is_plain_call(code: Code, call: CppCall) -> bool:
    if acts(code.file_of(call.node), call, is_generated=True) is not None:
        return False
    name = call.name.rpartition("::")[2]
    if name in code.all_classes:
        return name in _RUN_TIME or all(_does_nothing(code, c) for c in code.all_classes[name])
    own = code.definitions.get(("", call.name), ())
    known = is_known(call)
    return all(_only_gives(f) or (known and _is_ours(f)) for f in own) if own else known


def _only_gives(function: CppFunction) -> bool:
    """Whether a function does nothing but to give a value of its parameters."""
    body = function.body
    return body is not None and not inside(body, *_RUNNING, "call_expression")


def _is_ours(function: CppFunction) -> bool:
    """Whether a function is of the run-time part."""
    return is_runtime_header(function.cpp.source.path)


def _is_plain_type(code: Code, type_: Node, depth: int = 0) -> bool:
    """Whether to make an object of a type runs nothing that is not known."""
    is_class = type_.type in _CLASSES
    called = type_.child_by_field_name("name") if is_class else type_
    text = " ".join(text_of(called).split()) if called is not None else ""
    name = text.partition("<")[0].rpartition("::")[2]
    if is_class and name not in code.all_classes:
        return not any(True for _ in calls_in(type_))
    if name in code.all_classes and name not in _RUN_TIME:
        return all(_does_nothing(code, c, depth) for c in code.all_classes[name])
    if (others := code.aliases.get(name)) and name not in _RUN_TIME:
        return depth < _DEEPEST and all(_is_plain_type(code, a.type, depth + 1) for a in others)
    is_known_name = name in _RUN_TIME or "auto" in text
    return is_known_name or bool(_PLAIN.match(text)) or is_passive(text) or not _runs(text)


def _runs(type_: str) -> bool:
    """Whether a type is no enumeration or plain one by its looks: it is of ROS, or runs code."""
    return "::" in type_ or not starts_nothing(type_)


def _does_nothing(code: Code, owner: CppClass, depth: int = 0) -> bool:
    """Whether to make an object of a class stores values alone."""
    special = (owner.name, f"~{owner.name}")
    made = [f for f in inside(owner.node, "function_definition") if _name_of(f) in special]
    declared = [f for f in owner.functions if f.name in special]
    own = all(f.body is not None and not named(f.body) for f in declared)
    initialised = inside(owner.node, "field_initializer_list")
    values = [f.value for f in owner.fields if f.value is not None]
    stores = not any(True for node in (*initialised, *values) for _ in calls_in(node))
    parts = (_is_plain_type(code, type_, depth + 1) for type_ in _member_types(owner))
    is_plain = own and stores and all(not named(part(f, "body")) for f in made)
    return not owner.bases and is_plain and depth < _DEEPEST and all(parts)


def _member_types(owner: CppClass) -> Iterator[Node]:
    """The types of the objects that are made with an object."""
    for field in inside(owner.node, "field_declaration"):
        declarators = field.children_by_field_name("declarator")
        held = (d for d in declarators if d.type not in _REFERRING and not _of_function(d))
        if any(True for _ in held):
            yield part(field, "type")


def _name_of(function: Node) -> str:
    declarator = function.child_by_field_name("declarator")
    return text_of(declarator).partition("(")[0].strip() if declarator is not None else ""


def _is_specialisation(node: Node) -> bool:
    parameters = node.child_by_field_name("parameters")
    return parameters is not None and not named(parameters)


def _is_of_own(code: Code, node: Node) -> bool:
    """Whether a template is specialised that people wrote in the package."""
    head = text_of(node).partition(">")[2].partition("{")[0].partition("(")[0].partition("<")[0]
    name = re.findall(r"\w+", head)[-1:] or [""]
    own = (c for c in code.all_classes.get(name[0], ()) if not is_runtime_header(c.cpp.source.path))
    functions = (f for (o, n), all_ in code.definitions.items() if n == name[0] for f in all_)
    return any(True for c in own if c.node.parent != node) or any(
        f.node.parent != node and not is_runtime_header(f.cpp.source.path) for f in functions
    )
