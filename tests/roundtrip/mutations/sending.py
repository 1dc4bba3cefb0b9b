"""Changes of what bodies send: whether, to whom, with what, in which order, and when."""

from __future__ import annotations

import re

from tests.roundtrip.mutations.package import Kind, Package, Part, Texts, within

# A send with its arguments in the third group; the first is the indent.
_SEND = r"^( *)(send\w+)\((.*)\);$"
_TIMED = re.compile(r"(?:^|, )(?:after|deadline)\(.*$")


def _arguments(text: str) -> tuple[list[str], str]:
    """The arguments of a send, and what it says of times."""
    timed = _TIMED.search(text)
    plain = text[: timed.start()] if timed is not None else text
    parts, depth, last = [], 0, 0
    for at, char in enumerate(plain):
        depth += (char in "([{") - (char in ")]}")
        if char == "," and depth == 0:
            parts.append(plain[last:at].strip())
            last = at + 1
    parts += [plain[last:].strip()] if plain.strip() else []
    return parts, text[timed.start() :].lstrip(", ") if timed is not None else ""


def _sent(indent: str, name: str, arguments: list[str], when: str) -> str:
    return f"{indent}{name}({', '.join([*arguments, *([when] if when else [])])});"


def _types(package: Package, part: Part, name: str) -> tuple[str, ...]:
    return package.sends.get((part.owner, name), ())


def _others(package: Package, part: Part, name: str) -> list[str]:
    """What else of the class sends arguments of the same types."""
    own = _types(package, part, name)
    every = [n for (owner, n), types in package.sends.items() if owner == part.owner]
    return [n for n in every if n != name and _types(package, part, n) == own]


def _is_to_self(name: str) -> bool:
    return name.startswith("sendSelf")


def _another(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """To another receiver: one is the sender itself, or both are not."""
    others = _others(package, part, found[2])
    others = [n for n in others if not (_is_to_self(n) and _is_to_self(found[2]))]
    return f"{found[1]}{others[0]}({found[3]});" if others else None


def _another_message(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """Another message to the sender itself."""
    others = [n for n in _others(package, part, found[2]) if _is_to_self(n)]
    return f"{found[1]}{others[0]}({found[3]});" if others and _is_to_self(found[2]) else None


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
    if not types or types[-1] != "int32_t":
        return None
    last = f"({arguments[len(types) - 1]}) + 1"
    return _sent(found[1], found[2], [*arguments[: len(types) - 1], last], when)


def _called_at_once(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """A call in place of a message to oneself."""
    name = found[2].removeprefix("sendSelf")
    own = [p.element.partition(".")[2] for p in package.parts if p.kind == "msgsrv"]
    server = next((n for n in own if n.lower() == name.lower()), None)
    arguments, when = _arguments(found[3])
    if not _is_to_self(found[2]) or server is None or when:
        return None
    return f"{found[1]}{server}({', '.join(arguments)});"


def _at(what: str) -> Texts:
    """A time on sends that have none."""

    def text(package: Package, part: Part, found: re.Match[str]) -> str | None:
        arguments, when = _arguments(found[3])
        return None if when else _sent(found[1], found[2], arguments, what)

    return text


def _also(what: str) -> Texts:
    """A time on sends that have another."""

    def text(package: Package, part: Part, found: re.Match[str]) -> str | None:
        arguments, when = _arguments(found[3])
        if not when or what.partition("(")[0] in when:
            return None
        return _sent(found[1], found[2], arguments, f"{when}.{what}")

    return text


KINDS = (
    Kind("send removed", within(r"^ *send\w+\([^\n]*\n", "")),
    Kind("send twice", within(r"^( *send\w+\([^\n]*\n)", r"\1\1")),
    Kind("sends swapped", within(r"^( *send\w+\([^\n]*\n)(?!\1)( *send\w+\([^\n]*\n)", r"\2\1")),
    Kind("send to another", within(_SEND, _another)),
    Kind("another message to itself", within(_SEND, _another_message)),
    Kind("arguments of a send swapped", within(_SEND, _swapped_arguments)),
    Kind("argument of a send greater", within(_SEND, _greater_argument)),
    Kind("call in place of a send", within(_SEND, _called_at_once)),
    Kind("send only if", within(r"^( *)(send\w+\(.*\);)$", r"\1if (false) {\n\1  \2\n\1}")),
    Kind("after added", within(_SEND, _at("after(1)"))),
    Kind("after removed", within(r"(?:, )?\bafter\([^()]*\)(?=\);)", "")),
    Kind("after one later", within(r"\bafter\(([^()]*)\)", r"after((\1) + 1)")),
    Kind("deadline added", within(_SEND, _at("deadline(1)"))),
    Kind("deadline besides after", within(_SEND, _also("deadline(9)"))),
    Kind("after besides a deadline", within(_SEND, _also("after(1)"))),
    Kind("deadline removed", within(r"(?:, )?\bdeadline\([^()]*\)(?=\);)", "")),
    Kind("deadline one later", within(r"\bdeadline\(([^()]*)\)", r"deadline((\1) + 1)")),
    Kind("deadline made after", within(r"\bdeadline\(([^()]*)\)", r"after(\1)")),
    Kind("after made deadline", within(r"\bafter\(([^()]*)\)", r"deadline(\1)")),
)
