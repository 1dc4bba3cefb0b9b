"""What Python's calls that log are given: a message, and what is put into it.

A logger that takes texts alone refuses numbers, and one that formats raises where the arguments are
not those that the message names.
"""

from __future__ import annotations

from rebsync.reverse.analysis.facts import Facts
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.python.call_binding import REFUSED
from rebsync.reverse.analysis.python.filled_texts import FilledTexts
from rebsync.reverse.analysis.python.format_strings import conversions, numbers_of
from rebsync.reverse.analysis.python.none_values import NoneValues
from rebsync.reverse.analysis.python.operand_kinds import OperandKinds
from rebsync.reverse.analysis.python.value_types import OwnType
from rebsync.reverse.analysis.stores import CallResult, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.calls import Callee
from rebsync.reverse.libraries.python_telling import log_arguments
from rebsync.reverse.libraries.routines import LogCall

_WRONG = "is of another type"
_MESSAGE = frozenset({"msg", "message"})


class LogArguments:
    """The calls that log in one function."""

    def __init__(self, notes: ProblemNotes, kinds: OperandKinds, texts: FilledTexts) -> None:
        self._notes = notes
        self._kinds = kinds
        self._texts = texts
        self._nones = NoneValues(notes)

    def check(self, node: s.Call, facts: Facts) -> None:
        """Notes that a call that logs is given what it does not take."""
        logs = self._logs(node.callee)
        stars = [argument.stars for argument in node.arguments]
        if logs is None or (any(stars) and self._notes.table.trusts_types):
            return
        plain = [e.Spread(a.value) if a.stars else a.value for a in node.arguments if not a.name]
        names = {a.name for a in node.arguments if a.name is not None}
        message = plain[logs.before] if len(plain) > logs.before else None
        rest = plain[logs.before + 1 :]
        is_whole = message is not None or bool(names & _MESSAGE)
        if isinstance(message, e.Spread) or max(stars, default=0) > 1:
            self._notes.fails(node, _WRONG)
        elif not (is_whole and names <= logs.keywords | _MESSAGE and (logs.formats or not rest)):
            self._notes.fails(node, REFUSED)
        elif logs.levels:
            if not self._is_level(message, logs.levels):
                self._notes.fails(node, _WRONG)
        elif message is not None and logs.only_text:
            if self._kinds.asked(message, facts) - {OwnType.TEXT}:
                self._notes.fails(node, _WRONG)
        elif rest and message is not None:
            texts = self._notes.texts_of(message)
            if not texts and not self._notes.table.trusts_types:
                self._notes.fails(node, _WRONG)
            for text in texts:
                self._filled(node, text, rest, facts)

    def _filled(
        self, node: s.Call, text: str, rest: list[e.Expression | e.Spread], facts: Facts
    ) -> None:
        """Notes that a message does not take what is to be put into it, or that this is None."""
        values: e.Expression = e.Build(t.Container(t.ContainerKind.TUPLE), (*rest,))
        if conversions(text) is None and len(rest) == 1 and not isinstance(rest[0], e.Spread):
            values = rest[0]
        if self._texts.refuse(text, values, facts):
            self._notes.fails(node, _WRONG)
        for value in numbers_of(text, [v for v in rest if not isinstance(v, e.Spread)]):
            self._nones.check(value, node, facts)

    @staticmethod
    def _is_level(value: e.Expression | None, levels: frozenset[int | str]) -> bool:
        match value:
            case e.Literal(int(number)):
                return number in levels
            case e.LibraryReference(name):
                return name in levels
            case _:
                return False

    def _logs(self, callee: Callee) -> LogCall | None:
        """What a call that logs takes; None for any other call."""
        table = log_arguments()
        match callee:
            case s.LibraryCallee(name, None):
                return table.get(name)
            case s.MethodCallee(receiver, name) if any(n.endswith(f"().{name}") for n in table):
                makers = self._makers(receiver)
                found = [table.get(f"{made}().{name}") for made in makers]
                return found[0] if found and None not in found else None
            case _:
                return None

    def _makers(self, receiver: e.Expression) -> list[str]:
        """The names of what makes all that a receiver may be; empty where others do as well."""
        key = key_of(receiver, self._notes.function.name)
        stored = self._notes.origins.graph.stores.of(key) if key is not None else ()
        calls = [v.call.callee for _, v in stored if isinstance(v, CallResult)]
        named = [c.name for c in calls if isinstance(c, s.LibraryCallee | s.MethodCallee)]
        return named if len(named) == len(stored) else []
