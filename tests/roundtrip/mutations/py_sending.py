"""Changes of what bodies in Python send: whether, to whom, with what, in which order, and when."""

from __future__ import annotations

import re

from tests.roundtrip.mutations.package import Kind, Package, Part, Texts, within
from tests.roundtrip.mutations.parts import split

# A send with its arguments in the third group; the first is the indent.
_SEND = r"^( *)self\.(send_\w+)\((.*)\)$"
_LINE = r"^( *)(self\.send_\w+\([^\n]*\n)"


def _arguments(text: str) -> tuple[list[str], str]:
    """The arguments of a send, and what it says of times."""
    every = split(text)
    if every and every[-1].startswith("When("):
        return every[:-1], every[-1]
    return every, ""


def _sent(indent: str, name: str, arguments: list[str], when: str) -> str:
    return f"{indent}self.{name}({', '.join([*arguments, *([when] if when else [])])})"


def _types(package: Package, part: Part, name: str) -> tuple[str, ...]:
    return package.sends.get((part.owner, name), ())


def _others(package: Package, part: Part, name: str) -> list[str]:
    """What else of the class sends arguments of the same types."""
    own = _types(package, part, name)
    every = [n for (owner, n), types in package.sends.items() if owner == part.owner]
    return [n for n in every if n != name and _types(package, part, n) == own]


def _is_to_self(name: str) -> bool:
    return name.startswith("send_self")


def _another(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """To another receiver: one is the sender itself, or both are not."""
    others = _others(package, part, found[2])
    others = [n for n in others if not (_is_to_self(n) and _is_to_self(found[2]))]
    return f"{found[1]}self.{others[0]}({found[3]})" if others else None


def _another_message(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """Another message to the sender itself."""
    others = [n for n in _others(package, part, found[2]) if _is_to_self(n)]
    return f"{found[1]}self.{others[0]}({found[3]})" if others and _is_to_self(found[2]) else None


def _swapped_arguments(package: Package, part: Part, found: re.Match[str]) -> str | None:
    arguments, when = _arguments(found[3])
    types = _types(package, part, found[2])
    for at in range(len(types) - 1):
        if types[at] == types[at + 1] and arguments[at] != arguments[at + 1]:
            arguments[at], arguments[at + 1] = arguments[at + 1], arguments[at]
            return _sent(found[1], found[2], arguments, when)
    return None


def _greater_argument(package: Package, part: Part, found: re.Match[str]) -> str | None:
    arguments, when = _arguments(found[3])
    types = _types(package, part, found[2])
    if not types or types[-1] != "int":
        return None
    return _sent(found[1], found[2], [*arguments[:-1], f"int32(({arguments[-1]}) + 1)"], when)


def _called_at_once(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """A call in place of a message to oneself."""
    name = found[2].removeprefix("send_self_")
    own = [p.element.partition(".")[2] for p in package.parts if p.kind == "msgsrv"]
    arguments, when = _arguments(found[3])
    if not _is_to_self(found[2]) or name not in own or when:
        return None
    return f"{found[1]}self.{name}({', '.join(arguments)})"


def _at(what: str) -> Texts:
    """A time on sends that have none."""

    def text(package: Package, part: Part, found: re.Match[str]) -> str | None:
        arguments, when = _arguments(found[3])
        return None if when else _sent(found[1], found[2], arguments, f"When({what})")

    return text


def _also(what: str) -> Texts:
    """A time on sends that have another."""

    def text(package: Package, part: Part, found: re.Match[str]) -> str | None:
        arguments, when = _arguments(found[3])
        if not when or what.partition("=")[0] in when:
            return None
        return _sent(found[1], found[2], arguments, f"{when[:-1]}, {what})")

    return text


KINDS = (
    Kind("send removed", within(_LINE, r"\1pass\n")),
    Kind("send twice", within(_LINE, r"\g<0>\g<0>")),
    Kind("sends swapped", within(rf"({_LINE})(?!\1)(^ *self\.send_\w+\([^\n]*\n)", r"\4\1")),
    Kind("send to another", within(_SEND, _another)),
    Kind("another message to itself", within(_SEND, _another_message)),
    Kind("arguments of a send swapped", within(_SEND, _swapped_arguments)),
    Kind("argument of a send greater", within(_SEND, _greater_argument)),
    Kind("call in place of a send", within(_SEND, _called_at_once)),
    Kind("send only if", within(_LINE, r"\1if self._mailbox.now() > 3:\n\1    \2")),
    Kind("send never", within(_LINE, r"\1if False:\n\1    \2")),
    Kind(
        "send in another thread",
        within(_SEND, r"\1threading.Thread(target=lambda: self.\2(\3)).start()"),
    ),
    Kind("send not called", within(r"^( *self\.send_\w+)\(.*\)$", r"\1")),
    Kind("after added", within(_SEND, _at("after=1"))),
    Kind("after by position", within(_SEND, _at("1"))),
    Kind("after removed", within(r"(?:, )?\bWhen\(after=[^()]*\)(?=\)$)", "")),
    Kind("after one later", within(r"\bafter=([\w.]+)", r"after=\1 + 1")),
    Kind("deadline added", within(_SEND, _at("deadline=1"))),
    Kind("deadline besides after", within(_SEND, _also("deadline=9"))),
    Kind("after besides a deadline", within(_SEND, _also("after=1"))),
    Kind("deadline removed", within(r"(?:, )?\bWhen\(deadline=[^()]*\)(?=\)$)", "")),
    Kind("deadline one later", within(r"\bdeadline=([\w.]+)", r"deadline=\1 + 1")),
    Kind("deadline made after", within(r"\bdeadline=", "after=")),
    Kind("after made deadline", within(r"\bafter=", "deadline=")),
)
