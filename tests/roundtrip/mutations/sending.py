"""Changes of what bodies send: whether, to whom, with what, in which order, and when."""

from __future__ import annotations

import re

from tests.roundtrip.mutations.package import Kind, within
from tests.roundtrip.mutations.parts import split
from tests.roundtrip.mutations.sends import Sends

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
    send=_SEND,
    statement=r"^( *)(send\w+\([^\n]*\n)",
    nothing="",
    time="{}({})",
    given=r"\b{}\(([^()]*)\)",
    alone=r"(?:, )?\b{}\([^()]*\)(?=\);)",
    later=r"(\1) + 1",
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
    *_OF.kinds(),
    Kind("send only if", within(_SEND, r"\1if (false) {\n\1  \2(\3);\n\1}")),
)
