"""Statements of Python."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.python import control, functions, loops
from rebsync.reverse.ir.python.context import Lowering, NoLowering
from rebsync.reverse.ir.python.patterns import match
from rebsync.reverse.ir.python.references import name_target, unsupported
from rebsync.reverse.ir.python.results import has_truth
from rebsync.reverse.ir.python.symbols import ScopeKind, imported_name
from rebsync.reverse.ir.python.targets import assign_all, augment, delete
from rebsync.reverse.syntax.py_index import module_of
from rebsync.reverse.syntax.py_tree import field, is_constant_text, named, text_of

_SILENT = frozenset(
    {"pass_statement", "global_statement", "nonlocal_statement", "future_import_statement"}
)
_BLOCKS = frozenset({"block", "elif_clause", "else_clause", "except_clause", "finally_clause"})


def lower_statement(ctx: Lowering, node: Node) -> None:
    """A statement; as a whole `Unsupported` where its own parts have no lowering."""
    if node.type in _SILENT or node.type == "comment":
        return
    mark = len(ctx.out)
    try:
        rule = _RULES.get(node.type)
        if rule is None or _is_broken(node):
            raise NoLowering(f"no meaning is known of a `{node.type}`", node)
        rule(ctx, node)
    except NoLowering as failure:
        del ctx.out[mark:]
        unsupported(ctx, node, failure.reason)
    except RecursionError:
        del ctx.out[mark:]
        ctx.emit(s.Unsupported("this nests too deep", place=ctx.place(node)))


def _is_broken(node: Node) -> bool:
    """Whether what is not within blocks is no Python."""
    if not node.has_error:
        return False
    if node.type == "ERROR" or node.is_missing:
        return True
    return any(c.has_error and c.type not in _BLOCKS for c in node.children) or not any(
        c.has_error for c in node.children
    )


# --- simple statements ---------------------------------------------------------------------------


def _expression_statement(ctx: Lowering, node: Node) -> None:
    inner = named(node)
    if len(inner) > 1 or any(c.type == "," for c in node.children):
        for each in inner:  # a tuple that is not used
            _evaluate(ctx, each)
        return
    match inner[0].type:
        case "assignment":
            _assignment(ctx, inner[0])
        case "augmented_assignment":
            augment(ctx, inner[0])
        case _:
            _evaluate(ctx, inner[0])


def _evaluate(ctx: Lowering, node: Node) -> None:
    if is_constant_text(node) or node.type in ("ellipsis", "integer"):
        return
    value = ctx.value(node)
    last = ctx.out[-1] if ctx.out else None
    if isinstance(last, s.Call | s.Await | s.Yield) and last.target == value:
        ctx.out[-1] = replace(last, target=None)
    elif not isinstance(value, e.Temporary | e.Literal):
        ctx.emit(s.Evaluate(value, ctx.place(node)))


def _assignment(ctx: Lowering, node: Node) -> None:
    targets = [field(node, "left")]
    value = node.child_by_field_name("right")
    if value is None:
        _declare(ctx, node)
        return
    while value is not None and value.type == "assignment":
        targets.append(field(value, "left"))
        value = value.child_by_field_name("right")
    if value is None or value.type == "augmented_assignment":
        raise NoLowering("an assignment of an assignment", node)
    mark = len(ctx.out)
    assign_all(ctx, targets, value, node)
    _store_directly(ctx, mark)
    if node.child_by_field_name("type") is not None:
        _declare(ctx, node)


def _declare(ctx: Lowering, node: Node) -> None:
    """`x: int` says nothing but in a class, where it may be what makes a field of objects."""
    left = field(node, "left")
    if ctx.scope.kind is ScopeKind.CLASS and left.type == "identifier":
        ctx.emit(s.Declare(name_target(ctx, left), place=ctx.place(node)))


def _store_directly(ctx: Lowering, mark: int) -> None:
    """`$1 = call f(); x = $1` is `x = call f()` where that is evaluated in the same order."""
    if len(ctx.out) - mark < 2:
        return
    call, store = ctx.out[-2:]
    if not isinstance(store, s.Assign) or not isinstance(call, s.Call | s.Await | s.Yield):
        return
    is_variable = isinstance(store.target, e.Local | e.Global | e.Captured)
    if is_variable and call.target is not None and call.target == store.value:
        ctx.out[-2:] = [replace(call, target=store.target)]


def _return(ctx: Lowering, node: Node) -> None:
    inner = named(node)
    value = ctx.value(inner[0]) if inner else None
    ctx.emit(s.Return(value, ctx.place(node)))


def _raise(ctx: Lowering, node: Node) -> None:
    cause_node = node.child_by_field_name("cause")
    values = [c for c in named(node) if c != cause_node]
    if not values:
        ctx.emit(s.Raise(place=ctx.place(node)))
        return
    if values[0].type == "expression_list":  # of Python 2
        kind, *rest = named(values[0])
        if len(rest) > 1:
            raise NoLowering("an exception with a traceback", node)
        callee, message = ctx.ordered([lambda: ctx.value(kind), lambda: ctx.value(rest[0])])
        target = ctx.temporary(node)
        ctx.emit(s.Call(target, s.ValueCallee(callee), (s.CallArgument(message),), ctx.place(node)))
        ctx.emit(s.Raise(target, place=ctx.place(node)))
        return
    nodes = values if cause_node is None else [values[0], cause_node]
    lowered = ctx.values(nodes)
    cause = lowered[1] if len(lowered) > 1 else None
    ctx.emit(s.Raise(lowered[0], cause, ctx.place(node)))


def _assert(ctx: Lowering, node: Node) -> None:
    test, *rest = named(node)
    value = ctx.value(test)
    texts: list[e.Expression] = []
    message = ctx.body(lambda: texts.extend(ctx.value(n) for n in rest[:1]))
    text = texts[0] if texts else None
    ctx.emit(s.Assert(value, message, text, has_truth(value), ctx.place(node)))


def _print(ctx: Lowering, node: Node) -> None:
    """`print` of Python 2: a call of the function."""
    nodes = named(node)
    into = [c for c in nodes if c.type == "chevron"]
    shown = [c for c in nodes if c.type != "chevron"]
    parts = [named(into[0])[0], *shown] if into else shown
    values = ctx.values(parts)
    arguments = [s.CallArgument(v) for v in (values[1:] if into else values)]
    arguments += [s.CallArgument(values[0], "file")] * bool(into)
    if node.children[-1].type == ",":
        arguments.append(s.CallArgument(e.Literal(" "), "end"))
    callee = s.LibraryCallee("builtins.print")
    ctx.emit(s.Call(None, callee, tuple(arguments), ctx.place(node)))


def _import(ctx: Lowering, node: Node) -> None:
    place = ctx.place(node)
    for name in node.children_by_field_name("name"):
        wanted = text_of(field(name, "name") if name.type == "aliased_import" else name)
        bound = name.child_by_field_name("alias") or name
        target = name_target(ctx, bound if bound.type == "identifier" else bound.named_children[0])
        if node.type == "import_from_statement":
            ctx.emit(s.Import(target, *_module(ctx, module_of(node), wanted), place))
            continue
        whole, _, is_program = _module(ctx, wanted, None)
        if name.type != "aliased_import" and "." in wanted:
            ctx.emit(s.Import(None, whole, None, is_program, place))
            whole, _, is_program = _module(ctx, imported_name(name), None)
        ctx.emit(s.Import(target, whole, None, is_program, place))
    if any(c.type == "wildcard_import" for c in node.named_children):
        ctx.emit(s.Import(None, *_module(ctx, module_of(node), "*"), place))


def _module(ctx: Lowering, dotted: str, name: str | None) -> tuple[str, str | None, bool]:
    """A module by the name that the form has for it; the name; whether it is of the program."""
    module = ctx.binder.module
    found = ctx.names.module(dotted, module)
    if isinstance(found, e.ModuleReference):
        return found.name, name, True
    if name is not None and name != "*":
        inner = ctx.names.module(dotted + "." * (not dotted.endswith(".")) + name, module)
        if isinstance(inner, e.ModuleReference):
            return inner.name, None, True
    return dotted, name, False


def _break(ctx: Lowering, node: Node) -> None:
    ctx.emit(s.Break(ctx.place(node)))


def _continue(ctx: Lowering, node: Node) -> None:
    ctx.emit(s.Continue(ctx.place(node)))


_RULES: Mapping[str, Callable[[Lowering, Node], None]] = {
    "expression_statement": _expression_statement,
    "return_statement": _return,
    "raise_statement": _raise,
    "assert_statement": _assert,
    "delete_statement": delete,
    "print_statement": _print,
    "import_statement": _import,
    "import_from_statement": _import,
    "break_statement": _break,
    "continue_statement": _continue,
    "while_statement": loops.while_,
    "for_statement": loops.for_,
    "if_statement": control.branch,
    "try_statement": control.try_,
    "with_statement": control.with_,
    "match_statement": match,
    "function_definition": functions.define,
    "class_definition": functions.define,
    "decorated_definition": functions.define,
}
