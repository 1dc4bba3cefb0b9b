"""What statements of a module may do besides to bind names, by its syntax tree."""

from __future__ import annotations

import ast
from collections.abc import Callable, Collection, Iterable, Iterator
from typing import TypeAlias, TypeGuard

from rebsync.reverse.libraries.effects import of_function
from rebsync.reverse.libraries.routines import Effect, Language
from rebsync.reverse.python.generated.slicing.log_words import CALLING, COMPUTING

# What binds names, makes plain values, or only reads; further functions are in the tables.
PLAIN = frozenset(
    {"int", "float", "str", "bool", "range", "dict", "list", "tuple", "set", "frozenset", "print"}
    | {"property", "staticmethod", "classmethod", "object", "bytes"}
    | {"logging.getLogger", "re.compile", "os.path.join", "os.getenv"}
    | {"os.path.dirname", "os.path.abspath", "os.path.expanduser", "os.environ.get"}
    | {"pathlib.Path", "collections.namedtuple", "collections.defaultdict", "collections.deque"}
    | {"typing.TypeVar", "typing.NewType", "typing.cast", "typing.overload", "typing.final"}
    | {"functools.lru_cache", "functools.cache", "functools.partial", "functools.wraps"}
    | {"functools.total_ordering", "functools.cached_property", "contextlib.contextmanager"}
    | {
        "dataclasses.dataclass",
        "dataclasses.field",
        "enum.auto",
        "enum.unique",
        "abc.abstractmethod",
    }
    | {
        "threading.Lock",
        "threading.RLock",
        "threading.Event",
        "collections.OrderedDict",
        "collections.Counter",
    }
)
PLAIN |= COMPUTING
IN_SETUP = PLAIN | {
    *("setuptools.setup", "distutils.core.setup", "setuptools.find_packages", "glob.glob"),
    *("catkin_pkg.python_setup.generate_distutils_setup", "os.listdir", "os.walk"),
    *("setuptools.find_namespace_packages", "setup", "find_packages", "os.path.splitext"),
    *("open", "readme.read", "f.read", "file.read"),
}
# What launch files are made of: they describe what is started, and run before it.
_LAUNCH = ("launch.", "launch_ros.", "ament_index_python.", "nav2_common.launch.", "xacro.")
_DESCRIBES = frozenset(
    {"add_action", "add_entity", "append", "extend", "get", "items", "keys", "perform", "values"}
)
_Function: TypeAlias = "ast.FunctionDef | ast.AsyncFunctionDef"
_CLASS_HOOKS = frozenset({"__init_subclass__", "__set_name__"})
_MAKING = frozenset({"__init__", "__new__", "__post_init__", "__call__"})
# What all modules of a process share, and may be changed under another name.
_SHARED = frozenset(
    {"os.environ", "os.environb"}
    | {f"sys.{name}" for name in ("path", "argv", "modules", "meta_path", "path_hooks")}
)
_COPYING = frozenset({"dict", "list", "tuple", "set", "len", "sorted"})
_READING = frozenset({"r", "rb", "rt"})
# Of a text or container that is written there, methods change nothing that others have.
_DISPLAYS = (ast.Constant, ast.Dict, ast.List, ast.Set, ast.Tuple)
_BINDS = (ast.Import, ast.ImportFrom, ast.Pass, ast.Global, ast.Nonlocal)


class ImportedCode:
    """One module: its statements, what its imports call things, and the classes that it defines."""

    def __init__(self, tree: ast.Module, plain: frozenset[str] = PLAIN) -> None:
        self.tree = tree
        self._plain = plain
        self._aliases: dict[str, str] = {}
        self._functions = {n.name: n for n in tree.body if isinstance(n, ast.FunctionDef)}
        self._asked = set[str]()
        own = (n.targets for n in tree.body if isinstance(n, ast.Assign) and _is_made(n.value))
        self._containers = {t.id for targets in own for t in targets if isinstance(t, ast.Name)}
        self._classes = {n.name: n for n in ast.walk(tree) if isinstance(n, ast.ClassDef)}
        for node in ast.walk(tree):
            if isinstance(node, ast.Import):
                for alias in node.names:
                    if alias.asname is not None:
                        self._aliases[alias.asname] = alias.name
            elif isinstance(node, ast.ImportFrom):
                names = ((a.asname or a.name, f"{node.module}.{a.name}") for a in node.names)
                self._aliases.update(names)

    def acting(self) -> Iterator[ast.stmt]:
        """The statements that may do more than to bind names."""
        return self._acting(self.tree.body)

    def _acting(self, body: Iterable[ast.stmt]) -> Iterator[ast.stmt]:
        for node in body:
            match node:
                case ast.If(test=test, orelse=others) if self._never_here(test):
                    yield from self._acting(others)
                case ast.If(test=test, body=inner, orelse=others):
                    yield from () if self._is_plain(test) else (node,)
                    yield from self._acting((*inner, *others))
                case ast.Try(body=inner, handlers=handlers, orelse=others, finalbody=last):
                    caught = (s for handler in handlers for s in handler.body)
                    yield from self._acting((*inner, *caught, *others, *last))
                case ast.For(target=target, iter=all_, body=inner, orelse=others):
                    yield from () if _is_name(target) and self._is_plain(all_) else (node,)
                    yield from self._acting((*inner, *others))
                case ast.With(items=items, body=inner):
                    yield from () if all(self._is_plain(i.context_expr) for i in items) else (node,)
                    yield from self._acting(inner)
                case ast.ClassDef(body=inner):
                    if not self._is_plain_class(node):
                        yield node
                    yield from self._acting(inner)
                case _ if not self._only_binds(node):
                    yield node
                case _:
                    pass

    def acting_in(self, function: ast.FunctionDef) -> Iterator[ast.stmt]:
        """The statements of a function that may do more than to give a value."""
        for node in self._acting(function.body):
            match node:
                case ast.Return(value=value) if value is None or self._is_plain(value):
                    pass
                case ast.AugAssign(target=ast.Name(), value=value) if self._is_plain(value):
                    pass
                case _:
                    yield node

    def defining(self, own: Collection[str]) -> Iterator[ast.stmt]:
        """The definitions at the top that may do more than to bind their names."""
        for node in self.tree.body:
            match node:
                case ast.ClassDef(name=name, body=body) if name in own:
                    yield from (n for n in body if _is_function(n) and not self._is_plain_head(n))
                    yield from self._acting(n for n in body if isinstance(n, ast.ClassDef))
                case ast.ClassDef():
                    yield from self._acting([node])
                case _ if _is_function(node) and not self._is_plain_head(node):
                    yield node
                case _:
                    pass

    def _is_plain_head(self, node: _Function) -> bool:
        """Whether to define a function evaluates nothing that may act but for its decorators."""
        args = node.args
        parts = [*args.defaults, *args.kw_defaults]
        if not self._defers:
            every = (*args.posonlyargs, *args.args, *args.kwonlyargs, args.vararg, args.kwarg)
            parts += [node.returns, *(a.annotation for a in every if a is not None)]
        return all(self._is_plain(part) for part in parts if part is not None)

    @property
    def _defers(self) -> bool:
        """Whether annotations are not evaluated."""
        return self._aliases.get("annotations") == "__future__.annotations"

    @staticmethod
    def _never_here(test: ast.expr) -> bool:
        text = ast.unparse(test)
        return text in ("TYPE_CHECKING", "typing.TYPE_CHECKING", "__name__ == '__main__'")

    def _only_binds(self, node: ast.stmt) -> bool:
        match node:
            case _ if _is_function(node):
                decorated = all(map(self._is_plain_decorator, node.decorator_list))
                return decorated and self._is_plain_head(node)
            case ast.Assign(targets=targets, value=value):
                return all(map(self._is_own, targets)) and self._is_plain(value)
            case ast.AnnAssign(target=target, annotation=type_, value=value):
                evaluated = [*([] if self._defers else [type_]), *([value] if value else [])]
                return _is_name(target) and all(map(self._is_plain, evaluated))
            case ast.Expr(value=value):
                return self._is_plain(value)
            case _:
                return isinstance(node, _BINDS)

    def _is_own(self, target: ast.expr) -> bool:
        """Whether a place is a name of the module, or in a container that it made."""
        match target:
            case ast.Subscript(value=ast.Name(id=name), slice=index):
                return name in self._containers and self._is_plain(index)
            case _:
                return _is_name(target)

    def _is_plain_function(self, name: str) -> bool:
        """Whether a function of the module does nothing but to give a value."""
        function = self._functions.get(name)
        if function is None or name in self._asked:
            return False
        self._asked.add(name)
        plain = all(self._only_gives(s) for s in function.body)
        self._asked.discard(name)
        return plain and not function.decorator_list

    def _only_gives(self, node: ast.stmt) -> bool:
        match node:
            case ast.Return(value=value):
                return value is None or self._is_plain(value)
            case ast.If(test=test, body=inner, orelse=others):
                return self._is_plain(test) and all(map(self._only_gives, (*inner, *others)))
            case ast.Assign(targets=targets, value=value):
                return all(map(_is_name, targets)) and self._is_plain(value)
            case _:
                return self._only_binds(node) and not isinstance(node, ast.Global | ast.Nonlocal)

    def _is_plain_class(self, node: ast.ClassDef) -> bool:
        """Whether to define a class runs nothing besides its body."""
        bases = (*node.bases, *(k.value for k in node.keywords if k.arg == "metaclass"))
        above = (self._classes.get(ast.unparse(base)) for base in node.bases)
        hooks = (n.name for c in above if c is not None for n in c.body if _is_function(n))
        is_plain = all(map(self._is_plain, bases)) and all(
            k.arg != "metaclass" or self._name_of(k.value) in ("abc.ABCMeta", "enum.EnumMeta")
            for k in node.keywords
        )
        is_enumeration = any(self._name_of(base).startswith("enum.") for base in node.bases)
        own = {n.name for n in node.body if _is_function(n)} if is_enumeration else set[str]()
        is_plain = is_plain and own.isdisjoint(_MAKING | {"_generate_next_value_"})
        decorated = all(map(self._is_plain_decorator, node.decorator_list))
        return is_plain and decorated and _CLASS_HOOKS.isdisjoint(hooks)

    def is_library_decorator(self, node: ast.expr) -> bool:
        """Whether it is one that only wraps, perhaps made with constants."""
        given = (
            [*node.args, *(k.value for k in node.keywords)] if isinstance(node, ast.Call) else ()
        )
        name = self._name_of(node.func if isinstance(node, ast.Call) else node)
        is_own = name in self._functions or name in self._classes
        return name in PLAIN and not is_own and all(isinstance(g, ast.Constant) for g in given)

    def _is_plain_decorator(self, node: ast.expr) -> bool:
        if isinstance(node, ast.Call):
            return self._is_plain(node)
        name = self._name_of(node)
        is_property = name.rpartition(".")[2] in ("setter", "getter", "deleter")
        return name in self._plain or is_property or self._is_plain_function(name)

    def _is_plain(self, node: ast.expr) -> bool:
        """Whether to evaluate an expression calls nothing that is not known to be harmless."""
        match node:
            case ast.Lambda(args=args):
                return all(map(self._is_plain, args.defaults))
            case ast.Name() | ast.Attribute() if self._is_shared(node):
                return False
            case ast.Call(func=function, keywords=keywords):
                is_changed = any(k.arg == "cmdclass" for k in keywords)
                if is_changed or not self._is_plain_call(function):
                    return False
                if not (self._only_reads(node) and self._hands_over_plainly(node)):
                    return False
            case ast.Await() | ast.Yield() | ast.YieldFrom():
                return False
            case _:
                pass
        looked_at = [part for part in self._looked_at(node) if self._is_shared(part)]
        inner = (part for child in ast.iter_child_nodes(node) for part in _parts(child))
        return all(self._is_plain(part) for part in inner if part not in looked_at)

    def _is_shared(self, node: ast.expr) -> bool:
        return self._name_of(node) in _SHARED

    def _looked_at(self, node: ast.expr) -> list[ast.expr]:
        """The parts of an expression of which it asks elements, or makes a copy."""
        match node:
            case ast.Subscript(value=of) | ast.Attribute(value=of):
                return [of]
            case ast.Compare(comparators=others):
                return others
            case ast.Call(func=function, args=args) if self._name_of(function) in _COPYING:
                return args
            case ast.Dict(keys, values):
                return [v for k, v in zip(keys, values, strict=True) if k is None]
            case _:
                return []

    def _only_reads(self, call: ast.Call) -> bool:
        """Whether a call opens no file to write into it."""
        if self._name_of(call.func) not in ("open", "io.open", "codecs.open"):
            return True
        modes = [*call.args[1:2], *(k.value for k in call.keywords if k.arg in (None, "mode"))]
        return all(isinstance(m, ast.Constant) and m.value in _READING for m in modes)

    def _hands_over_plainly(self, call: ast.Call) -> bool:
        """Whether the functions that a call is given, and calls, do nothing but to give a value."""
        handed = [k.value for k in call.keywords if k.arg == "key"]
        handed += call.args[:1] if self._name_of(call.func) in CALLING else []
        return all(map(self._is_called_plainly, handed))

    def _is_called_plainly(self, function: ast.expr) -> bool:
        match function:
            case ast.Lambda(body=body):
                return self._is_plain(body)
            case ast.Call(func=maker):
                return self._name_of(maker) in ("operator.itemgetter", "operator.attrgetter")
            case ast.Attribute(value=ast.Name("str")) | ast.Constant():
                return True
            case _:
                return self._is_plain_call(function)

    def _is_plain_call(self, function: ast.expr) -> bool:
        name = self._name_of(function)
        made = self._classes.get(name)
        if made is not None:
            return self._is_made_plainly(made)
        if name in self._plain or self._is_plain_function(name):
            return True
        if isinstance(function, ast.Attribute) and isinstance(function.value, _DISPLAYS):
            return True
        return any(
            of_function(Language.PYTHON, full).effect in (Effect.NONE, Effect.READS)
            for full in (name, f"builtins.{name}")
        )

    def _is_made_plainly(self, made: ast.ClassDef) -> bool:
        """Whether to make an object of a class only gives it plain members."""
        functions = [n for n in made.body if _is_function(n)]
        making = [n for n in functions if n.name in _MAKING]
        if not _CLASS_HOOKS.isdisjoint(f.name for f in functions):
            return False
        if not making:
            return True
        is_plain = not made.bases and all(
            f.name != "__setattr__" and "setter" not in map(_last_name, f.decorator_list)
            for f in functions
        )
        return is_plain and all(
            f.name == "__init__" and f.args.args and all(map(self._only_fills(f), f.body))
            for f in making
        )

    def _only_fills(self, function: _Function) -> Callable[[ast.stmt], bool]:
        """Whether a statement of a constructor only puts a plain value into a member."""
        own = function.args.args[0].arg

        def only_fills(node: ast.stmt) -> bool:
            match node:
                case ast.Assign([ast.Attribute(ast.Name(name))], value) if name == own:
                    return self._is_plain(value)
                case ast.AnnAssign(ast.Attribute(ast.Name(name)), _, value) if name == own:
                    return value is None or self._is_plain(value)
                case _:
                    return self._only_gives(node)

        return only_fills

    def _name_of(self, node: ast.expr) -> str:
        """The full name of what is called, by the imports."""
        first, _, rest = ast.unparse(node).partition(".")
        whole = self._aliases.get(first, first)
        return f"{whole}.{rest}" if rest else whole


class LaunchCode(ImportedCode):
    """A launch file, whose functions run when it is started."""

    def _is_plain_call(self, function: ast.expr) -> bool:
        name = self._name_of(function)
        of, _, method = name.rpartition(".")
        if name.startswith(_LAUNCH) or (method in _DESCRIBES and of not in _SHARED):
            return True
        return super()._is_plain_call(function)


def _parts(node: ast.AST) -> list[ast.expr]:
    """The expressions that a child of an expression is, or holds."""
    match node:
        case ast.keyword(value=value):
            return [value]
        case ast.comprehension(iter=of, ifs=tests):
            return [of, *tests]
        case ast.expr():
            return [node]
        case _:
            return []


def _is_name(target: ast.expr) -> bool:
    if isinstance(target, ast.Tuple):
        return all(map(_is_name, target.elts))
    return isinstance(target, ast.Name)


def _last_name(node: ast.expr) -> str:
    return node.attr if isinstance(node, ast.Attribute) else ""


def _is_made(value: ast.expr) -> bool:
    return isinstance(value, ast.Dict | ast.List | ast.Set)


def _is_function(node: ast.stmt) -> TypeGuard[_Function]:
    return isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
