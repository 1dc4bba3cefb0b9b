"""What extraction tells of sums in edited Python that do not wrap as the model's do."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping

from rebsync.reverse.findings import Finding, Grade
from rebsync.roundtrip.python_trees import span_of, tree_of
from rebsync.roundtrip.wiring_facts import Fact
from rebsync.roundtrip.wiring_python import facts_in_python, has_nodes
from rebsync.roundtrip.wiring_ranges import RANGE, range_hint
from rebsync.source import Source

_OWN = re.compile(r"self\._\w+\b(?!\()")  # what has no type in its file is known to check alone
_UNREAD = ("a number with a point", "never below zero")  # which reading tells already


def unwrapped(files: Mapping[str, Source]) -> tuple[Finding, ...]:
    """The places in generated classes whose numbers go on where those of the model wrap.

    The model lacks what the code does then, so that they are unreadable.
    """
    return tuple(
        found
        for path, source in files.items()
        if path.endswith(".py") and "_mailbox" in source.text
        for found in _in_file(path, source)
    )


def _in_file(path: str, source: Source) -> Iterator[Finding]:
    tree = tree_of(source)
    if tree is None or not has_nodes(tree):
        return
    for fact in facts_in_python(path, source, ""):
        is_told = fact.kind == RANGE and not fact.value.endswith(_UNREAD)
        if is_told and all(f"{name}:" in source.text for name in _OWN.findall(fact.name)):
            what = fact.value.rpartition("again ")[2]
            within = f"{fact.owner}.{_within(source, tree, fact)}"
            hint = range_hint(fact.name, what)
            why = f"the model's numbers wrap, this is {what}"
            yield Finding(Grade.UNREADABLE, source, fact.span, why, hint, within)


def _within(source: Source, tree: ast.Module, fact: Fact) -> str:
    """The function that a place is in."""
    functions = (n for n in ast.walk(tree) if isinstance(n, ast.FunctionDef))
    spans = ((f, span_of(source, f)) for f in functions)
    around = [f for f, s in spans if s.start <= fact.span.start < s.end]
    return around[0].name if around else ""
