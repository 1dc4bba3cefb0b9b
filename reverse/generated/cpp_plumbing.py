"""What generated code does around its bodies, and whether somebody has changed that.

The model says nothing of how a message is filled or unpacked, so what is there must be what was
generated. Anything else is listed: the model would not show it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Container, Iterable, Iterator, Mapping, Sequence
from functools import partial

from tree_sitter import Node

from rebsync.reverse.bodies.effects.cpp_form import CppForm
from rebsync.reverse.bodies.scope import Scope
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.generated.annotations import best_priority
from rebsync.reverse.generated.cpp_beside import Beside
from rebsync.reverse.generated.cpp_descriptors import number_of
from rebsync.reverse.generated.cpp_failures import failures
from rebsync.reverse.generated.cpp_idle import working
from rebsync.reverse.generated.cpp_initialisers import odd_handles, too_early
from rebsync.reverse.generated.cpp_names import declared_type
from rebsync.reverse.generated.cpp_queues import odd_queue
from rebsync.reverse.generated.cpp_roles import (
    OFFERING,
    Roles,
    call_in,
    held_by,
    odd_priorities,
)
from rebsync.reverse.generated.cpp_shims import Fields, odd_in_shim
from rebsync.reverse.generated.cpp_timers import idle_timers, makes, timers_of
from rebsync.reverse.generated.parameters import READS
from rebsync.reverse.generated.ros2_words import SETS_UP, arguments_in
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, calls_in
from rebsync.reverse.syntax.cpp_enclosing import locals_referred_to
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, part, text_of

_SETS_UP = SETS_UP | {"advertise", "advertiseAll", "unused"}
_LOST = "no subscription takes this in: the class only sends it to itself"
_LATE = "messages may be served by now: set this up before mailbox_.construct(...)"
_STARTING = frozenset({"construct", "start"})
_ONCE = frozenset({"construct", "onServed", "start"})
_CHANGES = ("assignment_expression", "update_expression", "delete_expression", "throw_statement")
_HANDLE = re.compile(r"const\s+ros::NodeHandle\s+(\w+)\s*(.*)", re.DOTALL)
_SUBSCRIBES = frozenset({"subscribe", "subscribeOnBridge"})
_ACTING = ("assignment_expression", "update_expression", "call_expression", "lambda_expression")
_TELLS = frozenset({"flatten", "publish"})


def check_plumbing(
    code: Code,
    form: CppForm,
    owner: CppClass,
    all_roles: Mapping[str, Roles],
    fields: Fields,
    by_hand: Callable[[], Scope],
    findings: Findings,
) -> None:
    """Lists what a class does outside of its bodies that the model cannot show.

    `fields` are those of each message type, in their order; `by_hand` is what people's bodies name.
    """
    roles, line = all_roles[owner.name], code.lineage(owner.name)
    for cpp, node, why in (
        *_odd_servers(code, roles),
        *_odd_fields(code, owner),
    ):
        findings.unreadable(cpp.source, Unread(cpp.span(node), why), owner.name)
    for cpp, place, why in form.odd_locks([f for c in line for f in code.functions_of(c)]):
        findings.unreadable(cpp.source, Unread(place, why), owner.name)
    lineage = [all_roles[c.name] for c in line]
    for function in code.functions_of(owner):
        if function.body is None:
            continue
        odd = _odd_in(code, owner, function, lineage, fields, by_hand)
        places = [(function.cpp.span(node), why) for node, why in odd]
        for place, why in (*places, *failures(code, form, owner, function)):
            unread = Unread(place, why)
            findings.unreadable(function.cpp.source, unread, f"{owner.name}.{function.name}")


def _odd_servers(code: Code, roles: Roles) -> Iterator[tuple[Cpp, Node, str]]:
    """Priorities and descriptors of servers that no generated code has."""
    for cpp, node in odd_priorities(code, roles):
        yield cpp, node, "a server has kNoPriority, priority(number) or globalPriority(number)"
    descriptors = [text_of(taken.call.arguments[0]) for taken in roles.taken]
    for taken, descriptor in zip(roles.taken, descriptors, strict=True):
        if descriptors.count(descriptor) > 1:
            why = "messages of two servers are received as those of one"
            yield taken.function.cpp, taken.call.arguments[0], why


def _odd_fields(code: Code, owner: CppClass) -> Iterator[tuple[Cpp, Node, str]]:
    """Members that hold something else than a state variable of their type does."""
    for member in owner.fields:
        storage = (c.text for c in member.node.children if c.type == "storage_class_specifier")
        if b"static" in storage and declared_type(code, member.type) is not None:
            why = "all objects of the class share this; in the model each rebec has its own"
            yield member.cpp, member.node, why
        if any(c.type == "bitfield_clause" for c in member.node.children):
            yield member.cpp, member.node, "this holds some of its bits only"


def _odd_in(
    code: Code,
    owner: CppClass,
    function: CppFunction,
    lineage: Sequence[Roles],
    fields: Fields,
    by_hand: Callable[[], Scope],
) -> Iterator[tuple[Node, str]]:
    """What in a function of a class is not as generated, if it is one of those around bodies.

    `lineage` is what the class and those above it do, its own first.
    """
    roles, name = lineage[0], function.name
    topics = {t for above in lineage for t in above.topics}
    odd: Iterable[Node] = ()
    why = ""
    if name == owner.name:
        odd = _odd_in_constructor(code, owner, function, roles, by_hand)
        odd = _not_outside(code, function, odd, by_hand)
        why = "a constructor of generated code only sets up; the model's own is construct()"
        if (told := _odd_priority(code, function, lineage)) is not None:
            yield told, "the mailbox is told of another priority than its most urgent server has"
        if (told := odd_queue(code, function)) is not None:
            yield told, "this is no number of messages that is known here"
        for told in inside(function.node, "lambda_expression"):
            if locals_referred_to(told, function):
                yield told, "this refers to what is gone when it is called"
        for told in odd_handles(owner, function):
            yield told, "this is not given the node that the others are of"
        for told in too_early(owner, function):
            yield told, "this is made before a member that it names"
    elif name in roles.shims and name not in topics:
        odd = (function.node,)
        why = "no subscription takes messages to this: those of others do not arrive"
    elif name in roles.shims:
        odd = odd_in_shim(code, owner, function, roles, fields)
        why = "this does more than to hand a message to its handler"
    elif name in roles.odd_sends:
        odd = roles.odd_sends[name]
        why = "this does more than to send its arguments"
    elif name == "publishState":
        odd = _odd_in_state(code, function, by_hand)
        why = "this does more than to tell the state"
    elif name == "construct" and not _is_constructed(code, owner):
        odd = (function.node,)
        why = "no constructor has this run"
    begun = _begun(function) if name == owner.name else ()
    for node in odd:
        yield node, _LOST if node.id in roles.lost else _LATE if node.id in begun else why


def _odd_priority(code: Code, function: CppFunction, lineage: Sequence[Roles]) -> Node | None:
    """The initialiser that tells the mailbox another best priority than that of its servers."""
    overloads = (each for roles in lineage for each in roles.annotations.values())
    best = best_priority(shown for each in overloads for shown in each)
    for initialiser in named(function.initialisers) if function.initialisers is not None else ():
        name, *_, values = named(initialiser)
        given = named(values)
        if text_of(name) == "mailbox_" and len(given) in (2, 3):
            told = given[2:]
        elif len(given) == 4 and text_of(given[0]).startswith("Inherited"):
            told = given[3:]
        else:
            continue
        if any(text_of(a) in ("queue_length", "best_priority") for a in given):
            continue  # what heirs hand on
        number = number_of(code, function.cpp, told[0]) if told else None
        if number != best or (told and number is None and text_of(told[0]) != "kNoPriority"):
            return initialiser
    return None


def _is_constructed(code: Code, owner: CppClass) -> bool:
    """Whether the model's constructor runs, or no node is of this class alone."""
    own = [f for f in code.functions_of(owner) if f.name == owner.name]
    concrete = any(f.name == "publishState" and not f.pure for f in owner.functions)
    return not concrete or any(c.name == "construct" for f in own for c in code.calls_of(f))


def _not_outside(
    code: Code, function: CppFunction, odd: Iterable[Node], by_hand: Callable[[], Scope]
) -> Iterator[Node]:
    """Those of some statements of a constructor that may touch what the model has."""
    beside: Beside | None = None
    for statement in odd:
        beside = beside or Beside.of(code, function, by_hand())
        if not beside.takes(statement):
            yield statement


def _odd_in_constructor(
    code: Code, owner: CppClass, function: CppFunction, roles: Roles, by_hand: Callable[[], Scope]
) -> Iterator[Node]:
    """Statements that neither set up anything nor prepare that, or come too late for it."""
    timers = {t.call.node.id for t in timers_of(code, owner, roles)}
    timers |= {call.node.id for call in idle_timers(code, owner)}
    arguments = dict(arguments_in(function))
    fields = (f for c in code.lineage(owner.name) for f in c.fields)
    variables = {f.name for f in fields if declared_type(code, f.type) is not None} - roles.silent
    waiting, done = roles.globals.keys() - roles.asked.values(), set[str]()
    for statement in working(function.body):
        once = {c.name for c in calls_in(statement) if c.name in _ONCE and c.on == "mailbox_"}
        if statement.id in roles.reading and "start" not in done:
            continue
        is_late = not _STARTING.isdisjoint(done) and once != {"start"}
        if once & done or is_late or _changes_more(statement):
            yield statement
            continue
        done |= once
        given = text_of(statement).partition("=")[0].removeprefix("this->").strip()
        prepares = _is_handle(statement) or given in waiting
        prepares = prepares or statement.id in roles.asked
        prepares = prepares or _declared_by(statement) in arguments
        waiting.discard(given)
        observes = partial(_observes, code, function, by_hand)
        if not prepares and not _sets_up(statement, function, roles, timers, variables, observes):
            yield statement


def _observes(
    code: Code, function: CppFunction, by_hand: Callable[[], Scope], call: CppCall
) -> bool:
    return Beside.of(code, function, by_hand()).observes(call)


def _begun(constructor: CppFunction) -> frozenset[int]:
    """The statements after the one with which messages begin to be served."""
    statements = list(working(constructor.body))
    starts = (
        any(c.name in _STARTING and c.on == "mailbox_" for c in calls_in(s)) for s in statements
    )
    first = next((i for i, starting in enumerate(starts) if starting), len(statements))
    return frozenset(each.id for each in statements[first + 1 :])


def _changes_more(statement: Node) -> bool:
    """Whether it changes something beside what it gives a value to, but for the bodies in it."""
    expression = named(statement)[0] if statement.type == "expression_statement" else None
    found = (n for n in inside(statement, *_CHANGES) if n != expression)
    return any(not _is_in_body(node, statement) for node in found)


def _is_in_body(node: Node, statement: Node) -> bool:
    """Whether a lambda in a statement does it, when that is called."""
    return any(n.type == "compound_statement" for n in ancestors(node, lambda n: n == statement))


def _is_handle(statement: Node) -> bool:
    """Whether it declares a handle; those that parameters of the model are read by are plain."""
    found = _HANDLE.match(text_of(statement))
    return found is not None and (found[1] not in ("global", "node") or found[2] == ";")


def _declared_by(statement: Node) -> str:
    """The variable that a statement declares, if it declares one."""
    declarators = statement.children_by_field_name("declarator")
    if statement.type != "declaration" or len(declarators) != 1:
        return ""
    (declarator,) = declarators
    return text_of(declarator.child_by_field_name("declarator") or declarator)


def _sets_up(
    statement: Node,
    function: CppFunction,
    roles: Roles,
    timers: Container[int],
    variables: Container[str],
    observes: Callable[[CppCall], bool],
) -> bool:
    """Whether it is one call that sets something up, whose value may be kept.

    The `variables` of the model get what parameters say only as constants and known rebecs.
    """
    inner, kept = statement, ""
    if statement.type == "expression_statement":
        inner = named(statement)[0]
    if inner.type == "assignment_expression":
        kept = text_of(part(inner, "left")).removeprefix("this->")
        inner = part(inner, "right")
    call = call_of(inner)
    if call is None:
        return False
    match call.name:
        case _ if makes(call):
            return call.node.id in timers
        case "onServed":
            return _hands_on(call, "publishState", None) or observes(call)
        case "construct":
            given = [*(p.name for p in function.parameters), *dict(arguments_in(function))]
            return _hands_on(call, "construct", given)
        case name if name in OFFERING:
            return call.node.id in roles.wired
        case name if name in _SUBSCRIBES:
            callback = call.arguments[-1] if call.arguments else None
            lambda_ = callback is not None and callback.type == "lambda_expression"
            taken = any(callback == t.shim for t in roles.taken)
            return call.node.id in roles.wired and (taken or not lambda_)
        case "readArray":
            return text_of(call.arguments[-1]) in roles.globals
        case "param" if len(call.arguments) > 2:
            return False
        case name if name in READS:
            return kept in roles.known or kept in roles.globals or kept not in variables
        case name:
            return name in _SETS_UP


def _hands_on(call: CppCall, function: str, given: Sequence[str] | None) -> bool:
    """Whether a lambda only calls this function, with the last of what is given in its order."""
    found = call_in(call.arguments[-1]) if call.arguments else None
    passed = [text_of(a) for a in found[1]] if found is not None else []
    in_order = given is None or passed == list(given)[len(given) - len(passed) :]
    if found is None or found[0] != function or not in_order:
        return False
    lambda_ = call.arguments[-1]
    return given is None or lambda_.type != "lambda_expression" or not held_by(lambda_)


def _odd_in_state(
    code: Code, function: CppFunction, by_hand: Callable[[], Scope]
) -> Iterator[Node]:
    """What of `publishState` fills no message and publishes none, but for what others are told."""
    statements = working(function.body)
    names = {_declared_by(s) for s in statements if _is_state(s)}
    odd = [s for s in statements if not _tells(s, names)]
    beside = Beside.of(code, function, by_hand()) if odd else None
    for statement in statements:
        is_beside = beside is not None and beside.is_outside(statement)
        if statement in odd and not is_beside:
            yield statement


def _is_state(statement: Node) -> bool:
    """Whether a statement declares the message that tells the state."""
    if statement.type != "declaration":
        return False
    type_ = text_of(part(statement, "type"))
    return type_.rstrip("0123456789").endswith("State")  # one of several of a name has a number


def _tells(statement: Node, messages: Collection[str]) -> bool:
    if statement.type == "declaration":
        return _is_state(statement) and _only_looks(statement)
    expression = named(statement)[0] if named(statement) else statement
    if expression.type == "assignment_expression":
        target, value = part(expression, "left"), part(expression, "right")
        is_field = text_of(target).partition(".")[0] in messages
        return is_field and _only_looks(value)
    call = call_of(expression)
    if call is None or call.name not in _TELLS or not call.arguments:
        return False
    told = text_of(call.arguments[-1]).partition(".")[0]
    return told in messages and all(map(_only_looks, call.arguments))


def _only_looks(node: Node) -> bool:
    """Whether to evaluate something changes nothing: it stores nowhere, and calls nothing."""
    return not inside(node, *_ACTING)
