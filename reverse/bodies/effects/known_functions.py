"""Functions of C++'s and ROS's libraries that are known by what they do to a node."""

from __future__ import annotations

import re
from functools import lru_cache

from tree_sitter import Node

from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries import effects
from rebsync.reverse.libraries.routines import Effect, Kind, Language
from rebsync.reverse.libraries.tables.standard import STREAMS
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_declarations import CppParameter
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, part, text_of

# Functions of the standard library that wait for somebody, start something, or end the program.
_WAITING = frozenset(
    {
        *("system", "popen", "getchar", "getc", "fgetc", "gets", "fgets", "scanf", "fscanf"),
        *("getline", "async", "call_once", "signal", "atexit", "at_quick_exit", "longjmp"),
    }
)
# Those of them that wait for a person, or for another program.
_TYPED = frozenset({"getchar", "scanf", "gets", "system"})
_DECLARATIONS = ("declaration", "field_declaration", "parameter_declaration")
_STATUS = re.compile(r"\bDiagnosticStatusWrapper\b")
_STATUS_METHODS = frozenset({"add", "addf", "summary", "summaryf", "mergeSummary"})
UNUSED = "unused"  # of the run-time part of generated code: says that nothing uses a parameter
# Of it as well: the type of what says when a send arrives and expires, and what makes it.
MOMENT = "When"
TIMES = ("after", "deadline")
# Types whose objects run what they get, now or later.
_RUNNING = frozenset(
    {"thread", "jthread", "thread_group", "packaged_task", "function", "scoped_thread"}
)
# Functions that a node of ROS 2 inherits, and that only tell of it.
_OF_NODE = frozenset({"get_clock", "get_name", "get_namespace", "get_fully_qualified_name"})
_CONVERSION = re.compile(
    r"(?:::)?(?:u?int(?:8|16|32|64)?(?:_t)?|float|double|bool|char|long|short|unsigned|size_t)\Z"
)
# Types whose objects keep references to what their constructors get; functions only take some.
_REFERRING = re.compile(
    r"&|\b(?:\w*reference(?:_t|_wrapper)?|atomic_ref|(?:md)?span|Map|Ref|iterator_range|\w+_insert_iterator)\b"
)
_PARAMETERS = re.compile(r"\([^()]*\)")
# Pointers to what is not constant.
_SHARED = re.compile(
    r"(?<!Const)(?<!ConstShared)(?<!ConstUnique)(?:Shared|Unique)?Ptr\b|\w+_ptr<(?!\s*const\b)"
)
# What makes an object of a type.
_MAKES = re.compile(r"(?:std|boost)::make_(?:shared|unique)<\s*(?:const\s+)?([\w:]+)")
_TEMPLATE = re.compile(r"<.*>", re.DOTALL)  # what may stand behind it is a function of the class
# Types whose objects, when they are called, give an element of themselves.
_MATRIX = re.compile(
    r"(?:const\s+)?(?:::)?Eigen::(?:Matrix|(?:Row)?Vector|Array)(?:X?\d?X?[dfi]|<.*>)\Z", re.DOTALL
)


def is_matrix(type_: str) -> bool:
    """Whether to call an object of a type only gives an element of it."""
    return _MATRIX.match(type_) is not None


def acts(cpp: Cpp, call: CppCall, is_generated: bool) -> str | None:
    """What a call does to the node by its name: it takes time, or ends it; None for others.

    In generated code, where parameters are constants of the model, to set one acts as well.
    """
    name = call.name.rpartition("::")[2]
    if is_generated and not libraries.setting().isdisjoint((name, call.name.removeprefix("::"))):
        return Effect.SETS.value
    if call.target is None and (name in libraries.named(Kind.POLL) or name in _TYPED):
        return Effect.WAITS.value
    if _awaits(cpp, call) or any(map(reads_input, call.arguments)):
        return Effect.WAITS.value
    return libraries.acting().get(name)


def _awaits(cpp: Cpp, call: CppCall) -> bool:
    """Whether a call gets the value of a future, and so waits until something sets it.

    Told by the words of its declaration in the file: `get` of a smart pointer does not wait.
    """
    if call.name != "get" or call.arguments or call.target is None:
        return False
    words = [text_of(n) for n in inside(call.target, "identifier", "field_identifier")]
    for declaration in inside(cpp.root, *_DECLARATIONS):
        if any(
            text_of(n) == words[-1] for n in inside(declaration, "identifier", "field_identifier")
        ):
            words.append(text_of(declaration))
    return any(word in text.lower() for text in words for word in ("future", "async"))


def reads_input(node: Node) -> bool:
    """Whether an expression is, or begins with, what a person types."""
    while node.type == "binary_expression":
        node = part(node, "left")
    return text_of(node).removeprefix("::").removeprefix("std::") in ("cin", "wcin", "stdin")


def is_known(call: CppCall) -> bool:
    """Whether a free function of a library acts on nothing but what it gets, and ends soon."""
    plain = call.name.partition("<")[0].rpartition("::")[2]
    if plain in _WAITING:
        return False
    of_node = call.name in (*_OF_NODE, UNUSED, MOMENT, *TIMES) or call.name in libraries.looking()
    if effects.of_function(Language.CPP, call.name.removeprefix("::")).effect is Effect.NONE:
        return True
    return of_node or takes_values(call) or _is_of_library(call.name)


def streams(node: Node) -> bool:
    """Whether an expression writes to the console: `std::cout << x << std::endl`."""
    while node.type == "binary_expression" and text_of(part(node, "operator")) == "<<":
        node = part(node, "left")
    return text_of(node) in STREAMS


def logs(node: Node) -> bool:
    """Whether an expression is for people to read, by how it is written."""
    if node.type != "call_expression":
        return streams(node)
    name = text_of(part(node, "function"))
    return name.startswith(libraries.logging()) or name in libraries.names_of(Kind.LOG)


def starts_nothing(type_: str) -> bool:
    """Whether to make an object of a library's type runs no code that somebody has given it."""
    return type_.rpartition("::")[2] not in _RUNNING


def is_harmless_object(name: str) -> bool:
    """Whether an object by a name is of a library, and waits for nobody."""
    waits = name.rpartition("::")[2] in ("cin", "wcin")
    return name in (*STREAMS, "stdout", "stderr") or (_is_of_library(name) and not waits)


def takes_values(call: CppCall) -> bool:
    """Whether a function is known to change none of its arguments."""
    return _takes_values(call.name, call.target is not None) or _tells_status(call)


def _tells_status(call: CppCall) -> bool:
    """Whether it is a method of the status that a diagnostics updater has a callback fill."""
    if call.target is None or call.name.rpartition("::")[2] not in _STATUS_METHODS:
        return False
    nodes = (
        p
        for n in ancestors(call.node)
        for p in _parameters(n)
        if _STATUS.search(text_of(p)) is not None
    )
    return any(text_of(n) == text_of(call.target) for p in nodes for n in inside(p, "identifier"))


def _parameters(function: Node) -> list[Node]:
    """The parameters of a function, or a lambda; none of other nodes."""
    declarator = function.child_by_field_name("declarator")
    if function.type not in ("function_definition", "lambda_expression") or declarator is None:
        return []
    return [p for n in inside(declarator, "parameter_list") for p in named(n)]


@lru_cache(maxsize=1024)  # the same few names are called again and again
def _takes_values(called: str, of_object: bool) -> bool:
    made = _MAKES.match(called)
    name = made[1] if made is not None else _TEMPLATE.sub("", called)
    plain = name.rpartition("::")[2]
    if called.startswith(libraries.logging()) or _CONVERSION.match(called):
        return True
    if plain in libraries.keeping_arguments():
        return True
    if of_object:
        return plain in libraries.copying()
    return plain[:1].isupper() and type_takes_values(name)


def may_change(parameter: CppParameter) -> bool:
    """Whether a function may change what it gets for a parameter: also through a pointer."""
    if type_refers(text_of(parameter.type)):
        return True
    return parameter.may_change or _SHARED.search(text_of(parameter.type)) is not None


def type_takes_values(name: str) -> bool:
    """Whether objects of a type are known to change nothing that their constructors get."""
    if _CONVERSION.match(name) is not None:
        return True
    return _is_of_library(name) and not type_refers(name)


def type_refers(name: str) -> bool:
    """Whether a variable of a type may be another name for what it is made of."""
    return "decltype" in name or _REFERRING.search(_PARAMETERS.sub("", name)) is not None


def _is_of_library(name: str) -> bool:
    """Whether a type is of a library whose constructors only copy."""
    scope = name.removeprefix("::").partition("::")
    return bool(scope[1]) and (
        scope[0] in libraries.copying_scopes() or scope[0].endswith(("_msgs", "_srvs"))
    )
