"""Changes of what bodies in Python send: whether, to whom, with what, in which order, and when."""

from __future__ import annotations

from tests.roundtrip.mutations.package import Kind, within
from tests.roundtrip.mutations.parts import split
from tests.roundtrip.mutations.sends import Sends

# A send with its arguments in the third group; the first is the indent.
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
    Kind("send removed", within(_LINE, r"\1pass\n")),
    Kind("send twice", within(_LINE, r"\g<0>\g<0>")),
    Kind("sends swapped", within(rf"({_LINE})(?!\1)(^ *self\.send_\w+\([^\n]*\n)", r"\4\1")),
    Kind("send to another", within(_SEND, _OF.another)),
    Kind("another message to itself", within(_SEND, _OF.another_message)),
    Kind("arguments of a send swapped", within(_SEND, _OF.swapped)),
    Kind("argument of a send greater", within(_SEND, _OF.greater_last)),
    Kind("call in place of a send", within(_SEND, _OF.called_at_once)),
    Kind("send only if", within(_LINE, r"\1if self._mailbox.now() > 3:\n\1    \2")),
    Kind("send never", within(_LINE, r"\1if False:\n\1    \2")),
    Kind(
        "send in another thread",
        within(_SEND, r"\1threading.Thread(target=lambda: self.\2(\3)).start()"),
    ),
    Kind("send not called", within(r"^( *self\.send_\w+)\(.*\)$", r"\1")),
    Kind("after added", within(_SEND, _OF.at("after=1"))),
    Kind("after by position", within(_SEND, _OF.at("1"))),
    Kind("after removed", within(r"(?:, )?\bWhen\(after=[^()]*\)(?=\)$)", "")),
    Kind("after one later", within(r"\bafter=([\w.]+)", r"after=\1 + 1")),
    Kind("deadline added", within(_SEND, _OF.at("deadline=1"))),
    Kind("deadline besides after", within(_SEND, _OF.besides("deadline=9"))),
    Kind("after besides a deadline", within(_SEND, _OF.besides("after=1"))),
    Kind("deadline removed", within(r"(?:, )?\bWhen\(deadline=[^()]*\)(?=\)$)", "")),
    Kind("deadline one later", within(r"\bdeadline=([\w.]+)", r"deadline=\1 + 1")),
    Kind("deadline made after", within(r"\bdeadline=", "after=")),
    Kind("after made deadline", within(r"\bafter=", "deadline=")),
)
