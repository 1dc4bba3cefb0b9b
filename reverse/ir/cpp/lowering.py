"""C++ files to a program in the intermediate form; bodies are lowered when they are asked for."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp import calls, jumps, lambdas, loops
from rebsync.reverse.ir.cpp.classes import (
    field_type,
    implicit_constructor,
    is_copy,
    members,
    needs_constructor,
)
from rebsync.reverse.ir.cpp.constants import Constants
from rebsync.reverse.ir.cpp.construction import call_library, construct, conversion
from rebsync.reverse.ir.cpp.context import Context, Unlowered, World
from rebsync.reverse.ir.cpp.functions import (
    lambda_names,
    lower_function,
    lower_implicit_constructor,
    names_of_lambdas,
)
from rebsync.reverse.ir.cpp.functions_called import is_virtual, method_key
from rebsync.reverse.ir.cpp.initialisation import initialised, value_initialised
from rebsync.reverse.ir.cpp.names import global_value
from rebsync.reverse.ir.cpp.objects import class_of, default_constructed
from rebsync.reverse.ir.cpp.operator_functions import call_operator
from rebsync.reverse.ir.cpp.symbol_table import SymbolTable
from rebsync.reverse.ir.cpp.symbols import ClassSymbol, FunctionSymbol
from rebsync.reverse.ir.cpp.types import ReferenceKind, TypeReader
from rebsync.reverse.ir.operators import ImplicitCall, Operator
from rebsync.reverse.ir.program import Class, Field, Function, FunctionKind, Program
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, text_of

# Modules that register lowerings of nodes.
REGISTERED = (calls, jumps, lambdas, loops)
DESTRUCTOR = "~"
_CLASSES = ("class_specifier", "struct_specifier")
_OPERATORS: dict[str, Operator | ImplicitCall] = {
    **{f"operator{o.value}": o for o in Operator if not o.value[0].isalpha()},
    **{"operator/": Operator.TRUNCATING_DIVIDE, "operator%": Operator.TRUNCATING_REMAINDER},
    **{"operator()": ImplicitCall.CALL, "operator[]": ImplicitCall.GET_ITEM},
    "operator=": ImplicitCall.COPY,
}


def program_of(code: Code) -> Program:
    """The program of some files: every function that has a body, classes, variables by file."""
    return CppLowering(code).program()


def world_of(code: Code) -> World:
    """What lowerings of the functions of some files share."""
    constants = Constants()
    symbols = SymbolTable(code)
    types = TypeReader(symbols, constants.number)
    world = World(symbols, types, construct, conversion, call_library, call_operator)
    constants.world = world
    return world


class CppLowering:
    """The functions of some files by name, and what lowers each."""

    def __init__(self, code: Code) -> None:
        self.world = world_of(code)
        self._lambdas: dict[str, str] = {}
        self._bodies: dict[str, Function] = {}
        self._implicit: dict[str, ClassSymbol] = {}
        self._modules: dict[str, Cpp] = {cpp.source.path: cpp for cpp in code.files}
        for owner in self.world.symbols.classes.values():
            name = implicit_constructor(owner)
            if _has_implicit(self.world, owner) and name not in self._defined():
                self._implicit[name] = owner

    def file_of(self, name: str) -> Cpp:
        """The file that a function or lambda of the program stands in."""
        around = self._lambdas.get(name, name)
        if around in self._modules:
            return self._modules[around]
        if around in self._implicit:
            return self._implicit[around].cpp
        return self.world.symbols.functions[around].code.cpp

    def program(self) -> Program:
        """The program, of which nothing is lowered yet."""
        for name, function in self._defined().items():
            owner = self.world.symbols.classes.get(function.owner or "")
            self._lambdas |= dict.fromkeys(lambda_names(function, owner).values(), name)
        for name, owner in self._implicit.items():
            values = [f.value for f in owner.fields if not f.is_static]
            self._lambdas |= dict.fromkeys(names_of_lambdas(name, values).values(), name)
        for path, cpp in self._modules.items():
            values = module_values(self.world, cpp)
            self._lambdas |= dict.fromkeys(names_of_lambdas(path, values).values(), path)
        names = [*self._defined(), *self._lambdas, *self._implicit, *self._modules]
        classes = [class_of_program(self.world, c) for c in self.world.symbols.classes.values()]
        modules = [(path, path) for path in self._modules]
        open_ = undefined(self.world.symbols)
        pure = [f.name for f in self.world.symbols.functions.values() if f.code.pure]
        forward = self.world.symbols.forward - self.world.symbols.classes.keys()
        return Program(names, classes, self._lower, modules, self._globals(), open_, pure, forward)

    def _defined(self) -> dict[str, FunctionSymbol]:
        symbols = self.world.symbols.functions
        return {n: f for n, f in symbols.items() if f.code.body is not None}

    def _globals(self) -> Iterator[e.Global]:
        for variables in self.world.symbols.variables.values():
            for variable in variables:
                found = global_value(self.world, variable, e.Global("", "").place).expression
                if isinstance(found, e.Global):
                    yield found

    def _lower(self, name: str) -> Function:
        if name not in self._bodies:
            self._add(name)
        return self._bodies[name]

    def _add(self, name: str) -> None:
        around = self._lambdas.get(name, name)
        if around in self._modules:
            function, closures = lower_module(self.world, self._modules[around])
        elif around in self._implicit:
            function, closures = lower_implicit_constructor(self.world, self._implicit[around])
        else:
            function, closures = lower_function(self.world, self.world.symbols.functions[around])
        self._bodies |= {f.name: f for f in (function, *closures)}
        if name not in self._bodies:  # what is around a lambda has no lowering
            self._bodies[name] = _unsupported(name)


def _unsupported(name: str) -> Function:
    statement = s.Unsupported("a lambda in what has no lowering")
    return Function(name, (), (statement,))


def undefined(symbols: SymbolTable) -> Iterator[str]:
    """The functions that no file defines: more of a name than have a body elsewhere."""
    groups: dict[tuple[str | None, str, int], list[FunctionSymbol]] = {}
    for function in symbols.functions.values():
        key = function.owner or function.scope, function.simple, len(function.code.parameters)
        groups.setdefault(key, []).append(function)
    for group in groups.values():
        open_ = [f for f in group if not (f.code.body or f.is_default or f.is_deleted)]
        alone = [f for f in group if f.code.body and f.declarations == (f.code,) and f.owner]
        apart = [f for f in alone if not climb(f.code.node, lambda n: n.type in _CLASSES)]
        if len(open_) > len(apart):
            yield from (f.name for f in open_)


def _has_implicit(world: World, owner: ClassSymbol) -> bool:
    written = [f for f in owner.constructors if not f.is_default and not f.is_deleted]
    is_defaulted = any(f.is_default and not is_copy(owner, f) for f in owner.constructors)
    nothing_else = not [f for f in written if not is_copy(owner, f)] or is_defaulted
    return nothing_else and needs_constructor(world, owner) and not owner.is_template


def class_of_program(world: World, owner: ClassSymbol) -> Class:
    """The class table's entry for a class."""
    symbols = world.symbols
    bases = symbols.bases(owner)
    own = owner.functions
    methods = tuple((method_key(world, f), f.name) for f in own if not _is_special(owner, f))
    virtual = {method_key(world, f) for f in own if is_virtual(world, f)}
    destructor = owner.destructor
    if any(
        c.destructor is not None and c.destructor.is_virtual for c in symbols.lineage(owner.name)
    ):
        virtual.add(DESTRUCTOR)
    fields = [Field(m.key, m.declared.form) for m in members(world, owner)]
    shared = [f for f in owner.fields if f.is_static]
    fields += [Field(f.name, field_type(world, owner, f).form, True) for f in shared]
    constructors = [f for f in owner.constructors if f.code.body is not None]
    has_body = destructor is not None and destructor.code.body is not None
    operators = [
        (_OPERATORS[f.simple], method_key(world, f)) for f in own if f.simple in _OPERATORS
    ]
    if destructor is not None and has_body:
        methods = (*methods, (DESTRUCTOR, destructor.name))
        operators.append((ImplicitCall.DESTROY, DESTRUCTOR))
    return Class(
        owner.name,
        tuple(b.name if b is not None else world.types.imported(owner.cpp, n) for n, b in bases),
        methods,
        (),
        tuple(fields),
        tuple(operators),
        frozenset(virtual),
        constructors[0].name if len(constructors) == 1 else None,
        destructor.name if destructor is not None and has_body else None,
        None,
        all(b is not None for _, b in bases) and not owner.is_template,
        place=owner.cpp.span(owner.node),
    )


def _is_special(owner: ClassSymbol, function: FunctionSymbol) -> bool:
    return function.simple == owner.simple or function.simple.startswith("~")


# --- modules --------------------------------------------------------------------------------------


def module_values(world: World, cpp: Cpp) -> list[Node | None]:
    """The initialisers of the variables and static members of a file."""
    symbols = world.symbols
    fields = [f for c in symbols.classes.values() for f in c.fields if f.is_static]
    variables = [v for found in symbols.variables.values() for v in found]
    values = [f.value for f in fields if f.cpp is cpp]
    return [*values, *(v.value for v in variables if v.cpp is cpp)]


def lower_module(world: World, cpp: Cpp) -> tuple[Function, list[Function]]:
    """What a file does before the program starts: its variables and static members begin."""
    path = cpp.source.path
    context = Context(world, cpp, path, "")
    context.lambdas = names_of_lambdas(path, module_values(world, cpp))
    place = context.place(cpp.root)
    for owner in world.symbols.classes.values():
        if owner.cpp is cpp:
            _static_members(context, owner)
    for variables in world.symbols.variables.values():
        for variable in variables:
            if variable.cpp is cpp:
                target = global_value(world, variable, context.place(variable.declarator))
                context.scope = variable.scope
                if isinstance(target.expression, e.Lvalue):
                    _begins(context, target.expression, target.type, variable.value)
    for function in world.symbols.functions.values():
        if function.code.cpp is cpp and function.code.body is not None:
            _flags(context, function)
    body, captured = tuple(context.out), frozenset(context.shared)
    kind = FunctionKind.MODULE
    found = Function(path, (), body, t.NOTHING, kind, captured=captured, place=place)
    return found, context.closures


def _static_members(context: Context, owner: ClassSymbol) -> None:
    for symbol in owner.fields:
        declared = field_type(context.world, owner, symbol)
        is_value = declared.reference is ReferenceKind.NONE
        is_made = symbol.value is not None or class_of(context, declared.type) is not None
        if symbol.is_static and is_made and is_value:
            class_ = e.ClassReference(owner.name)
            target = e.Attribute(class_, symbol.name, declared.type, False)
            context.scope = owner.name
            _begins(context, target, declared.type, symbol.value)


def _begins(context: Context, target: e.Lvalue, type_: t.Type, value: Node | None) -> None:
    """One variable gets its first value; without an initialiser zeros ([basic.start.static])."""
    mark = len(context.out)
    try:
        with context.full_expression():
            if value is not None:
                initialised(context, target, type_, value)
            else:
                _zero(context, target, type_)
    except Unlowered as error:
        del context.out[mark:]
        context.emit(s.Unsupported(str(error), (), (), target, target.place))


def _zero(context: Context, target: e.Lvalue, type_: t.Type) -> None:
    if isinstance(type_, t.Unknown):
        raise Unlowered("a variable of a type that is not known")
    if isinstance(type_, t.Record | t.RosMessage):
        default_constructed(context, target, type_, target.place)
    else:
        value_initialised(context, target, type_, target.place)


def _flags(context: Context, function: FunctionSymbol) -> None:
    """Static locals of a function are not initialised when the program starts."""
    if b"static" not in context.cpp.words or function.code.body is None:
        return
    counts = dict[str, int]()
    for node in inside(function.code.body, "declaration"):
        if any(text_of(c) == "static" for c in node.children):
            for declarator in node.children_by_field_name("declarator"):
                inner = declarator.child_by_field_name("declarator") or declarator
                name = text_of(inner)
                counts[name] = counts.get(name, 0) + 1
                own = name if counts[name] == 1 else f"{name}~{counts[name]}"
                ready = e.Global(function.name, f"{own} is initialised", t.TRUTH)
                context.emit(s.Assign(ready, e.Literal(False, t.TRUTH)))
