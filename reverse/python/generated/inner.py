"""Functions within bodies of Python: what they do stands where they are called (inlining).

Such a function is bound once, and known to the end of its block. Its parameters are
locals, or stand for the arguments where it only gives a value.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.python.generated import idioms
from rebsync.reverse.python.generated.arguments import in_order
from rebsync.reverse.python.generated.callees import callee, evaluated, is_method
from rebsync.reverse.python.generated.closures import arguments_of
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.helpers import own_name
from rebsync.reverse.python.generated.lazy import DISPLAYS, is_iterator
from rebsync.reverse.python.generated.names import Callee, ChosenCallee, Closure
from rebsync.reverse.python.generated.pair_methods import takes_time
from rebsync.reverse.python.generated.py_types import call_parts, type_of
from rebsync.reverse.python.generated.statement_reader import ModelStatementReader
from rebsync.reverse.python.generated.tuples import table_asked
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_tree import SCOPES, calls_in, field, is_label, named, text_of
from rebsync.static.types import BOOLEAN, INT

_LEAVING = frozenset({"return_statement", "break_statement", "continue_statement"})
_NOT_INLINED = "only a method that gives nothing, and has no locals, stands for what it does"
_LOOPS = frozenset({"for_statement", "while_statement"})


def declare(reader: ModelStatementReader, node: Node) -> list[m.Statement]:
    """A function in a body, which stands for what it does where it is called."""
    name, body = text_of(field(node, "name")), field(node, "body")
    parameters = _parameters(node)
    calls = {text_of(field(c, "function")) for c in calls_in(body)}
    if parameters is None or name in calls or not _is_bound_once(node, name):
        why = "only a function that is bound once, and has no defaults, stands for what it does"
        raise reader.expressions.unread(node, why)
    if (value := _only_value(body)) is not None:
        reader.expressions.closures[name] = Closure(parameters, value)
        return []
    if leaves(body) or any(not name.startswith("self.") for name in idioms.stored_in(body)):
        why = "only a function that gives nothing, and has no locals, stands for what it does"
        raise reader.expressions.unread(node, why)
    reader.inner[name] = Closure(parameters, body)
    return []


def named_lambda(reader: ModelStatementReader, left: Node, value: Node) -> bool:
    """Whether `f = lambda x: e` was taken for a function that gives that, or does it."""
    if value.type != "lambda" or left.type != "identifier":
        return False
    name, parameters = text_of(left), _parameters(value)
    body = field(value, "body")
    if parameters is None or not _is_bound_once(value, name):
        return False
    known = reader.expressions.closures if idioms.is_quiet(body) else reader.inner
    known[name] = Closure(parameters, body)
    return True


def kept_send(reader: ModelStatementReader, left: Node, value: Node) -> list[m.Statement] | None:
    """`send = self.send_self_m`, another name of what sends, or of one of two that a local tells.

    None for another assignment.
    """
    expressions, name, made = reader.expressions, text_of(left), list[m.Statement]()
    if left.type != "identifier" or not _is_send(expressions, value):
        return None
    if not _is_bound_once(value, name):
        return None
    expressions.kept_sends[name] = _kept_callee(
        reader, name, callee(expressions, value), value, made
    )
    return made


def _kept_callee(
    reader: ModelStatementReader, name: str, found: Callee, value: Node, made: list[m.Statement]
) -> Callee:
    """A function that is chosen now and called later: locals keep what decides it."""
    if not isinstance(found, ChosenCallee):
        return found
    local = reader.free(f"{name}_then", pattern=f"{name}_then{{}}")
    made.append(reader.declaration(f"kept as {local}", local, BOOLEAN, found.asked, value))
    ways = (_kept_callee(reader, name, f, value, made) for f in (found.then, found.otherwise))
    return ChosenCallee(m.Name(local), *ways)


def _is_send(expressions: ModelExpressionReader, value: Node) -> bool:
    """Whether a value is a function that sends, or another of the object, or one of several."""
    if (asked := table_asked(expressions, value)) is not None:
        _, arguments = call_parts(value) or ("", [])
        return is_table_of_functions(expressions, asked[0]) and all(
            _is_send(expressions, each) for each in arguments[1:]
        )
    if value.type == "conditional_expression":
        then, _, otherwise = named(value)
        plain = (n for n in (then, otherwise) if n.type == "attribute")
        return [_is_send(expressions, each) for each in plain] == [True, True]
    is_server = text_of(value).removeprefix("self.") in expressions.names.servers
    return expressions.own == "self" and is_method(expressions, value) and not is_server


def is_table_of_functions(expressions: ModelExpressionReader, table: Node) -> bool:
    """Whether a table has functions of the object alone."""
    values = [each.child_by_field_name("value") for each in named(table)]
    return bool(values) and all(v is not None and _is_send(expressions, v) for v in values)


def kept_table(reader: ModelStatementReader, left: Node, value: Node) -> bool:
    """Whether `table = {1: a, 2: b}` was taken for what is looked up.

    Nothing of what the table holds changes until then: it holds functions, or only the next
    statement looks up something.
    """
    if left.type == "identifier" and is_shown(reader.expressions, value):
        others = [each for each in _mentions(value, text_of(left)) if each != left]
        if not all(_is_gone_through(reader.expressions, each) for each in others):
            return False
        reader.expressions.kept_tables[text_of(left)] = value
        return True
    if value.type != "dictionary" or left.type != "identifier":
        return False
    name, asked = text_of(left), _value_behind(value)
    called, _ = call_parts(asked) or ("", [])
    mentions = _mentions(value, name)
    if not (called == f"{name}.get" and len(mentions) == 2):
        others = [each for each in mentions if each != left]
        is_asked = len(others) < len(mentions) and all(map(_is_looked_up, others))
        if not is_asked or not is_table_of_functions(reader.expressions, value):
            return False
    reader.expressions.kept_tables[name] = value
    return True


def is_shown(expressions: ModelExpressionReader, value: Node) -> bool:
    """Whether a tuple or list has functions of the object, be it in pairs with literals."""
    listed = named(value) if value.type in DISPLAYS else []
    parts = [p for each in listed for p in (named(each) if each.type == "tuple" else [each])]
    functions = [each for each in parts if is_method(expressions, each)]
    is_same = all(each in functions or idioms.is_literal(expressions, each) for each in parts)
    return bool(functions) and is_same


def _is_gone_through(expressions: ModelExpressionReader, use: Node) -> bool:
    """Whether a use of a display is that of a loop, or of an iterator."""
    above = use.parent
    if above is None or above.type != "argument_list":
        return above is not None and above.type == "for_statement" and field(above, "right") == use
    return is_iterator(expressions, above.parent)


def _is_looked_up(use: Node) -> bool:
    """Whether a use of a table is `table.get(...)`, or a call of `table[...]`."""
    above = use.parent
    called = above.parent if above is not None else None
    if above is None or called is None or called.type != "call":
        return False
    is_get = above.type == "attribute" and text_of(field(above, "attribute")) == "get"
    return field(called, "function") == above and (is_get or above.type == "subscript")


def _value_behind(value: Node) -> Node | None:
    """What the statement behind that of a value stores or returns."""
    statement = climb(value, lambda node: node.type == "expression_statement")
    following = statement.next_named_sibling if statement is not None else None
    while following is not None and following.type == "comment":
        following = following.next_named_sibling
    inner = named(following)[:1] if following is not None else []
    if following is None or not inner:
        return None
    if inner[0].type == "assignment":
        return inner[0].child_by_field_name("right")
    return inner[0] if following.type == "return_statement" else None


def kept_moment(reader: ModelStatementReader, left: Node, value: Node) -> list[m.Statement] | None:
    """The times of `soon = When(after=a)`: known where it is made, and counted from each send."""
    called, _ = call_parts(value) or ("", [])
    is_kept = reader.expressions.of_run_time(called) == "When" and left.type == "identifier"
    if not is_kept or not _is_bound_once(value, text_of(left), passed=True):
        return None
    times = idioms.times(reader.expressions, value)
    made, kept = _times_kept(reader, text_of(left), times, value)
    reader.expressions.moments[text_of(left)] = kept
    return [*made]


def _times_kept(
    reader: ModelStatementReader, name: str, times: Mapping[str, m.Expression], node: Node
) -> tuple[list[m.Local], dict[str, m.Name]]:
    """Locals that keep the times of sends until these are made, and what they are called."""
    made, kept, own = list[m.Local](), dict[str, m.Name](), reader.expressions
    around = climb(node, lambda above: above.type == "function_definition")
    taken = {*own.types, *(idioms.names_in(around) if around is not None else ())}
    for kind, time in times.items():
        if not is_calm(time) or own.kind(time) != INT:
            raise own.unread(node, "this time is no whole number of the model")
        local = reader.free(f"{name}_{kind}", pattern=f"{name}_{kind}_{{}}", taken=taken)
        made.append(reader.declaration(f"kept as {local}", local, INT, time, node))
        kept[kind] = m.Name(local)
    return made, kept


def _parameters(function: Node) -> tuple[tuple[str, m.Type | None], ...] | None:
    """The parameters with the types that they are said to have; None if some have more to them."""
    listed = function.child_by_field_name("parameters")
    found = []
    for each in named(listed) if listed is not None else ():
        if each.type == "typed_parameter" and named(each)[0].type == "identifier":
            found.append((text_of(named(each)[0]), type_of(field(each, "type"))))
        elif each.type == "identifier":
            found.append((text_of(each), None))
        else:
            return None
    return tuple(found)


def _is_bound_once(node: Node, name: str, passed: bool = False) -> bool:
    """Whether nothing else in the method around gives a name another meaning.

    What has it called, or `passed` on, does not.
    """
    found = 0
    for each in _mentions(node, name):
        above = each.parent
        if above is not None and above.type in (
            "comparison_operator",
            "if_statement",
            "elif_clause",
        ):
            continue  # which ask whether it is there
        called = above is not None and above.type == "call" and field(above, "function") == each
        is_passed = above is not None and above.type in ("argument_list", "keyword_argument")
        found += not (is_passed if passed else called)
    return found == 1


def _mentions(node: Node, name: str) -> list[Node]:
    """Where the method around says a name."""
    around = climb(node, lambda above: above.type == "function_definition")
    every = nodes_in(around) if around is not None else ()
    found = (each for each in every if each.type == "identifier" and text_of(each) == name)
    return [each for each in found if not is_label(each)]


def inline_call(
    reader: ModelStatementReader, node: Node, called: str, arguments: list[Node]
) -> list[m.Statement]:
    """What a function of the body does, where it is called: its parameters are locals."""
    closure, own = reader.inner[called], reader.expressions
    passed = arguments_of(own, node, closure, arguments)
    locals_ = [_local(reader, p, a) for p, a in zip(closure.parameters, passed, strict=True)]
    outer = dict(own.locals)
    for (name, _), local in zip(closure.parameters, locals_, strict=True):
        own.locals[name] = local.declaration.declarators[0].name
    if closure.body.type == "block":
        body = reader.block(named(closure.body), closure.body)
    else:
        body = m.Block((evaluated(own, closure.body),))
    own.locals.clear()
    own.locals.update(outer)
    if not locals_:
        return list(body.statements)
    return [m.Block((*locals_, *body.statements), (), own.py.span(node))]


def _local(
    reader: ModelStatementReader, parameter: tuple[str, m.Type | None], argument: Node
) -> m.Local:
    """The local that a parameter is."""
    name, said = parameter
    own = reader.expressions
    read = own.expression(argument)
    type_ = said if said is not None else own.kind(read)
    if type_ is None or type_.dimensions:
        raise own.unread(argument, f'say the type of "{name}"')
    plain = reader.local(reader.free(name, pattern=f"{name}_{{}}", first=2, taken=own.types))
    return reader.declaration(f"kept as {plain}", plain, type_, read, argument)


def inline_method(
    reader: ModelStatementReader, node: Node, called: str, arguments: list[Node]
) -> list[m.Statement]:
    """What a method does that takes a time of sends: its other parameters are locals."""
    own, name = reader.expressions, called.removeprefix("self.")
    function = own.names.inlined[name]
    body, parameters = field(function.node, "body"), function.parameters[1:]
    is_plain = all(stored.startswith("self.") for stored in idioms.stored_in(body))
    is_known = called.startswith("self.") and own_name(function) == own.own == "self"
    if not is_known or not is_plain or leaves(body) or any(p.star for p in parameters):
        raise own.unread(node, _NOT_INLINED)
    if function.py is not own.py:
        raise own.unread(node, _NOT_INLINED)
    others = {n: f for n, f in own.names.inlined.items() if n != name}  # none calls itself
    fresh = replace(own.inside({}), names=replace(own.names, inlined=others))
    passed: list[Node | None] = [*in_order(own, node, arguments, parameters)]
    passed += [None] * (len(parameters) - len(passed))
    made, bound = list[m.Local](), dict[str, str]()
    for each, said, given in zip(parameters, function.parameter_nodes[1:], passed, strict=True):
        value, asked = (given, own) if given is not None else (each.default, fresh)
        if value is None or (given is None and not takes_time(said)):
            raise own.unread(node, "this has other arguments than those that are asked for")
        if takes_time(said):
            times = idioms.times(asked, value)
            kept, fresh.moments[each.name] = _times_kept(reader, each.name, times, value)
            made += kept
        else:
            type_ = type_of(said.child_by_field_name("type"))
            made.append(_local(reader, (each.name, type_), value))
            bound[each.name] = made[-1].declaration.declarators[0].name
    fresh.locals.update(bound)
    within = replace(reader, expressions=fresh, hoisted={}, cases=[], implied=set(), annotated={})
    within.inner, within.lasting = {}, ""
    done = within.block(body_of(function), body)
    return (
        [m.Block((*made, *done.statements), (), own.py.span(node))] if made else [*done.statements]
    )


def _only_value(body: Node) -> Node | None:
    """What a function gives that does nothing else; None for another function."""
    match [s for s in named(body) if s.type != "comment"]:
        case [only] if only.type == "return_statement":
            values = named(only)
            return values[0] if len(values) == 1 and idioms.is_quiet(values[0]) else None
        case _:
            return None


def leaves(node: Node, in_loop: bool = False) -> bool:
    """Whether something in a block ends it, or the function."""
    for child in named(node):
        if child.type in _LEAVING and not (in_loop and child.type != "return_statement"):
            return True
        if child.type not in SCOPES and leaves(child, in_loop or child.type in _LOOPS):
            return True
    return False
