"""Changes of what bodies in Python send: whether, to whom, with what, in which order, and when."""

from __future__ import annotations

from tests.roundtrip.mutations.package import Kind, within
from tests.roundtrip.mutations.parts import split
from tests.roundtrip.mutations.sends import Sends

_SEND = r"^( *)self\.(send_\w+)\((.*)\)$"
_LINE = r"^( *)(self\.send_\w+\([^\n]*\n)"


def _arguments(text: str) -> tuple[list[str], str]:
    """The arguments of a send, and what it says of times."""
    every = split(text)
    if every and every[-1].startswith("When("):
        return every[:-1], every[-1]
    return every, ""


def _also(when: str, what: str) -> str | None:
    return None if what.partition("=")[0] in when else f"{when[:-1]}, {what})"


_OF = Sends(
    send=_SEND,
    statement=_LINE,
    nothing=r"\1pass\n",
    time="{}={}",
    given=r"\b{}=([\w.]+)",
    alone=r"(?:, )?\bWhen\({}=[^()]*\)(?=\)$)",
    later=r"\1 + 1",
    line="{}self.{}({})",
    call="{}self.{}({})",
    to_self="send_self_",
    integer="int",
    greater="int32(({}) + 1)",
    arguments=_arguments,
    timed="When({})".format,
    also=_also,
)

KINDS = (
    *_OF.kinds(),
    Kind("send only if", within(_LINE, r"\1if self._mailbox.now() > 3:\n\1    \2")),
    Kind("send never", within(_LINE, r"\1if False:\n\1    \2")),
    Kind(
        "send in another thread",
        within(_SEND, r"\1threading.Thread(target=lambda: self.\2(\3)).start()"),
    ),
    Kind("send not called", within(r"^( *self\.send_\w+)\(.*\)$", r"\1")),
    Kind("after by position", within(_SEND, _OF.at("1"))),
)
