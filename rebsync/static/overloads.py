"""Which of several declarations of one name a call or an instance means."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, TypeVar

from rebsync.model import Expression, Type
from rebsync.source import Span
from rebsync.static.facts import Facts
from rebsync.static.symbols import Classes
from rebsync.static.types import converts

Arguments = Sequence[Type | None]


class Takes(Protocol):
    """A declaration that takes arguments of the types of its signature."""

    @property
    def signature(self) -> tuple[Type | None, ...]: ...


T = TypeVar("T", bound=Takes)


def select(
    candidates: Sequence[T],
    arguments: Arguments,
    written: Sequence[Expression],
    name: str,
    span: Span,
    facts: Facts,
) -> T | None:
    """The declaration that takes the arguments; reports when there is none, or no single one."""
    of_length = [c for c in candidates if len(c.signature) == len(arguments)]
    if any(a is None for a in arguments) and of_length:
        return of_length[0] if len(of_length) == 1 else None
    fitting = [c for c in of_length if _takes(c.signature, arguments, facts.classes)]
    exact = [c for c in fitting if list(c.signature) == list(arguments)]
    if len(fitting) == 1 or exact:
        return (exact or fitting)[0]
    if any(None in c.signature for c in fitting):
        return None
    if fitting:
        message = f'"{name}{_listed(arguments)}" fits {len(fitting)} declarations'
        hint = f"cast an argument so that one fits: {_signatures(name, fitting)}"
        facts.error("RS311", span, message, hint)
    elif len(candidates) == 1:
        _explain(candidates[0].signature, arguments, written, name, span, facts)
    else:
        message = f'no "{name}" takes {_listed(arguments)}'
        facts.error("RS310", span, message, f"there is {_signatures(name, candidates)}")
    return None


def _takes(signature: Arguments, arguments: Arguments, classes: Classes) -> bool:
    pairs = zip(signature, arguments, strict=True)
    return all(p is None or a is None or converts(a, p, classes) for p, a in pairs)


def _explain(
    signature: Arguments,
    arguments: Arguments,
    written: Sequence[Expression],
    name: str,
    span: Span,
    facts: Facts,
) -> None:
    """Says what is wrong with a call for which there is only one declaration."""
    if len(signature) != len(arguments):
        count = {0: "no arguments", 1: "1 argument"}.get(len(signature))
        count = count or f"{len(signature)} arguments"
        message = f'"{name}" takes {count}, not {len(arguments)}'
        facts.error("RS310", span, message, f"it is declared as {name}{_listed(signature)}")
        return
    for i, (wanted, given) in enumerate(zip(signature, arguments, strict=True)):
        if wanted is not None and given is not None and not converts(given, wanted, facts.classes):
            message = f'argument {i + 1} of "{name}" must be of type "{wanted}", not "{given}"'
            facts.error("RS310", written[i].span, message)


def _listed(types: Arguments) -> str:
    return f"({', '.join('?' if t is None else str(t) for t in types)})"


def _signatures(name: str, candidates: Sequence[Takes]) -> str:
    return ", ".join(name + _listed(c.signature) for c in candidates)
