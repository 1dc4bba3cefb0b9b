"""The effects of Python that is the user's own: of sensors' functions and of users' blocks.

What it computes, keeps for itself and asks of hardware is its own; the rebec, its messages and its
time are the model's. Functions of modules that are not of the package get values only, and do what
their tables say.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator, Mapping

from rebsync.records import dataclass
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.effects import of_function
from rebsync.reverse.libraries.routines import Effect, Language

_LOOKS = frozenset({Effect.NONE, Effect.CLOCK, Effect.LOGS, Effect.READS, Effect.RANDOM})
# Modules by which code gets at objects that nobody handed it, or runs beside the node.
_REACHING = frozenset(
    {
        *("gc", "inspect", "ctypes", "importlib", "builtins", "threading", "_thread", "sched"),
        *("multiprocessing", "concurrent", "asyncio", "signal", "atexit", "subprocess", "runpy"),
        "unittest",
    }
)
# Of these modules only what looks.
_LOOKING = {
    "os": {
        *("path", "environ", "getenv", "listdir", "stat", "access", "sep", "getcwd", "scandir"),
        *("open", "read", "close", "pread", "lseek", "uname", "O_RDONLY", "O_RDWR", "O_NONBLOCK"),
    },
    "sys": {"stdout", "stderr", "maxsize", "argv", "platform", "version_info"},
}
_REACHING_NAMES = frozenset(
    {
        *("eval", "exec", "compile", "globals", "locals", "setattr", "delattr", "__import__"),
        *("__builtins__", "exit", "quit", "input", "breakpoint"),
    }
)
_LEAVING = (ast.Raise, ast.Assert, ast.Await, ast.Yield, ast.YieldFrom, ast.AsyncFor, ast.AsyncWith)


@dataclass(frozen=True, slots=True)
class UserEffects:
    """What names of a module stand for: imports by their full names; `modelled` are the model's."""

    aliases: Mapping[str, str]
    modelled: Collection[str]

    @classmethod
    def of(cls, tree: ast.Module, modelled: Collection[str]) -> UserEffects:
        """For the code of a module."""
        aliases = dict[str, str]()
        for node in ast.walk(tree):
            match node:
                case ast.Import(names=names):
                    for a in names:
                        first = a.name.partition(".")[0]
                        aliases[a.asname or first] = a.name if a.asname else first
                case ast.ImportFrom(module=module, names=names):
                    aliases.update({a.asname or a.name: f"{module}.{a.name}" for a in names})
                case _:
                    pass
        return cls(aliases, modelled)

    def acting(self, root: ast.AST) -> Iterator[tuple[ast.expr | ast.stmt, str]]:
        """The places that may do something to what the model has."""
        parts = {id(n.value) for n in ast.walk(root) if isinstance(n, ast.Attribute)}
        for node in ast.walk(root):
            if not isinstance(node, ast.expr | ast.stmt):
                continue
            if (why := self._done(node, id(node) in parts)) is not None:
                yield node, why

    def _done(self, node: ast.expr | ast.stmt, is_part: bool) -> str | None:
        match node:
            case ast.While(test=ast.Constant()) if not _is_left(node):
                return "nothing ends this loop"
            case (
                ast.Attribute(ctx=ast.Store() | ast.Del())
                | ast.Subscript(ctx=ast.Store() | ast.Del())
            ):
                return self._stored(node)
            case ast.Attribute() | ast.Name() if not is_part:
                return self._named(node)
            case _:
                return "this may leave the function" if isinstance(node, _LEAVING) else None

    def _stored(self, node: ast.Attribute | ast.Subscript) -> str | None:
        """A store in what is imported."""
        base: ast.expr = node
        while isinstance(base, ast.Attribute | ast.Subscript):
            base = base.value
        is_others = isinstance(base, ast.Name) and base.id in self.aliases
        return f'"{ast.unparse(node)}" is of another module' if is_others else None

    def _named(self, node: ast.Attribute | ast.Name) -> str | None:
        """What naming something may do, called at once or later."""
        last = node.attr if isinstance(node, ast.Attribute) else ""
        text = ast.unparse(node)
        if last in libraries.acting_methods() or last in libraries.asking_names():
            return f'"{last}" acts on a node'
        first, _, rest = text.partition(".")
        if first in self.modelled:
            return f'"{first}" is the model\'s'
        if not text.replace(".", "").isidentifier():
            return None
        full = ".".join(filter(None, (self.aliases.get(first, first), rest)))
        effect = of_function(Language.PYTHON, full).effect
        is_known = effect is not Effect.UNKNOWN
        if first in self.aliases and (is_known and effect not in _LOOKS):
            return f'"{text}" {effect.value}'
        module, _, within = full.partition(".")
        looking = _LOOKING.get(module)
        is_odd = looking is not None and within.partition(".")[0] not in looking
        is_unknown = libraries.is_of_client(full) and not is_known
        is_reaching = is_odd or module in _REACHING or is_unknown
        if (first in self.aliases and is_reaching) or text in _REACHING_NAMES:
            return f'"{text}" may do anything'
        return None


def _is_left(loop: ast.While) -> bool:
    return any(isinstance(n, ast.Break | ast.Return) for n in ast.walk(loop))


def names_in(root: ast.AST) -> Iterator[str]:
    """All names that stand in a piece of code."""
    for node in ast.walk(root):
        match node:
            case ast.Name(id=name) | ast.Attribute(attr=name):
                yield name
            case _:
                pass
