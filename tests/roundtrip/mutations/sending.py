"""Changes of what bodies send: whether, to whom, with what, in which order, and when."""

from __future__ import annotations

import re

from tests.roundtrip.mutations.package import Kind, within
from tests.roundtrip.mutations.parts import split
from tests.roundtrip.mutations.sends import Sends

# A send with its arguments in the third group; the first is the indent.
_SEND = r"^( *)(send\w+)\((.*)\);$"
_TIMED = re.compile(r"(?:^|, )(?:after|deadline)\(.*$")


def _arguments(text: str) -> tuple[list[str], str]:
    """The arguments of a send, and what it says of times."""
    timed = _TIMED.search(text)
    if timed is None:
        return split(text), ""
    return split(text[: timed.start()]), text[timed.start() :].lstrip(", ")


def _also(when: str, what: str) -> str | None:
    return None if what.partition("(")[0] in when else f"{when}.{what}"


_OF = Sends(
    line="{}{}({});",
    call="{}{}({});",
    to_self="sendSelf",
    integer="int32_t",
    greater="({}) + 1",
    arguments=_arguments,
    timed=str,
    also=_also,
)

KINDS = (
    Kind("send removed", within(r"^ *send\w+\([^\n]*\n", "")),
    Kind("send twice", within(r"^( *send\w+\([^\n]*\n)", r"\1\1")),
    Kind("sends swapped", within(r"^( *send\w+\([^\n]*\n)(?!\1)( *send\w+\([^\n]*\n)", r"\2\1")),
    Kind("send to another", within(_SEND, _OF.another)),
    Kind("another message to itself", within(_SEND, _OF.another_message)),
    Kind("arguments of a send swapped", within(_SEND, _OF.swapped)),
    Kind("argument of a send greater", within(_SEND, _OF.greater_last)),
    Kind("call in place of a send", within(_SEND, _OF.called_at_once)),
    Kind("send only if", within(r"^( *)(send\w+\(.*\);)$", r"\1if (false) {\n\1  \2\n\1}")),
    Kind("after added", within(_SEND, _OF.at("after(1)"))),
    Kind("after removed", within(r"(?:, )?\bafter\([^()]*\)(?=\);)", "")),
    Kind("after one later", within(r"\bafter\(([^()]*)\)", r"after((\1) + 1)")),
    Kind("deadline added", within(_SEND, _OF.at("deadline(1)"))),
    Kind("deadline besides after", within(_SEND, _OF.besides("deadline(9)"))),
    Kind("after besides a deadline", within(_SEND, _OF.besides("after(1)"))),
    Kind("deadline removed", within(r"(?:, )?\bdeadline\([^()]*\)(?=\);)", "")),
    Kind("deadline one later", within(r"\bdeadline\(([^()]*)\)", r"deadline((\1) + 1)")),
    Kind("deadline made after", within(r"\bdeadline\(([^()]*)\)", r"after(\1)")),
    Kind("after made deadline", within(r"\bafter\(([^()]*)\)", r"deadline(\1)")),
)
