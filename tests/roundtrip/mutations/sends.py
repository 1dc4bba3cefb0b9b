"""What can be changed about a send, in whatever language it is written."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from tests.roundtrip.mutations.package import Kind, Package, Part, Texts, within


@dataclass(frozen=True)
class Sends:
    """How a language writes sends, of which a match has the indent, the name and the arguments.

    `line` has places for these three; `to_self` begins the names of what a rebec sends to itself.
    `integer` is the type of numbers, `greater` one that is one more than another. `arguments` tells
    the arguments from what is said of times, which `timed` writes, and `also` beside another time.

    `send` finds a send, `statement` its whole line with the indent apart, and `nothing` stands for
    one that is not there. `time` has places for a kind of time and its amount, which `given` finds;
    `alone` finds a time with no other beside it, and `later` is the amount found and one more.
    """

    send: str
    statement: str
    nothing: str
    time: str
    given: str
    alone: str
    later: str
    line: str
    call: str
    to_self: str
    integer: str
    greater: str
    arguments: Callable[[str], tuple[list[str], str]]
    timed: Callable[[str], str]
    also: Callable[[str, str], str | None]

    def kinds(self) -> Iterator[Kind]:
        """What is changed alike in every language."""
        line = self.statement
        yield Kind("send removed", within(line, self.nothing))
        yield Kind("send twice", within(line, r"\g<0>\g<0>"))
        yield Kind("sends swapped", within(rf"({line})(?!\1)({line})", r"\4\1"))
        yield Kind("send to another", within(self.send, self.another))
        yield Kind("another message to itself", within(self.send, self.another_message))
        yield Kind("arguments of a send swapped", within(self.send, self.swapped))
        yield Kind("argument of a send greater", within(self.send, self.greater_last))
        yield Kind("call in place of a send", within(self.send, self.called_at_once))
        for time, other, amount in (("after", "deadline", "9"), ("deadline", "after", "1")):
            added, beside = self.time.format(time, 1), self.time.format(other, amount)
            found, article = self.given.format(time), "" if time == "after" else "a "
            later, made = self.time.format(time, self.later), self.time.format(other, r"\1")
            yield Kind(f"{time} added", within(self.send, self.at(added)))
            yield Kind(f"{time} removed", within(self.alone.format(time), ""))
            yield Kind(f"{time} one later", within(found, later))
            yield Kind(f"{time} made {other}", within(found, made))
            yield Kind(f"{other} besides {article}{time}", within(self.send, self.besides(beside)))

    def another(self, package: Package, part: Part, found: re.Match[str]) -> str | None:
        """To another receiver: one is the sender itself, or both are not."""
        others = self._others(package, part, found[2])
        others = [n for n in others if not (self._is_to_self(n) and self._is_to_self(found[2]))]
        return self._line(found[1], others[0], found[3]) if others else None

    def another_message(self, package: Package, part: Part, found: re.Match[str]) -> str | None:
        """Another message to the sender itself."""
        others = [n for n in self._others(package, part, found[2]) if self._is_to_self(n)]
        is_own = bool(others) and self._is_to_self(found[2])
        return self._line(found[1], others[0], found[3]) if is_own else None

    def swapped(self, package: Package, part: Part, found: re.Match[str]) -> str | None:
        """Two arguments of one type in the other order."""
        arguments, when = self.arguments(found[3])
        types = _types(package, part, found[2])
        for at in range(len(types) - 1):
            if types[at] == types[at + 1] and arguments[at] != arguments[at + 1]:
                arguments[at], arguments[at + 1] = arguments[at + 1], arguments[at]
                return self._sent(found[1], found[2], arguments, when)
        return None

    def greater_last(self, package: Package, part: Part, found: re.Match[str]) -> str | None:
        """The last argument one greater, if it is a number."""
        arguments, when = self.arguments(found[3])
        types = _types(package, part, found[2])
        if not types or types[-1] != self.integer:
            return None
        last = self.greater.format(arguments[len(types) - 1])
        return self._sent(found[1], found[2], [*arguments[: len(types) - 1], last], when)

    def called_at_once(self, package: Package, part: Part, found: re.Match[str]) -> str | None:
        """A call in place of a message to oneself."""
        name = found[2].removeprefix(self.to_self)
        own = [p.element.partition(".")[2] for p in package.parts if p.kind == "msgsrv"]
        server = next((n for n in own if n.lower() == name.lower()), None)
        arguments, when = self.arguments(found[3])
        if not self._is_to_self(found[2]) or server is None or when:
            return None
        return self.call.format(found[1], server, ", ".join(arguments))

    def at(self, what: str) -> Texts:
        """A time on sends that have none."""

        def text(package: Package, part: Part, found: re.Match[str]) -> str | None:
            arguments, when = self.arguments(found[3])
            return None if when else self._sent(found[1], found[2], arguments, self.timed(what))

        return text

    def besides(self, what: str) -> Texts:
        """A time on sends that have another."""

        def text(package: Package, part: Part, found: re.Match[str]) -> str | None:
            arguments, when = self.arguments(found[3])
            both = self.also(when, what) if when else None
            return self._sent(found[1], found[2], arguments, both) if both else None

        return text

    def _line(self, indent: str, name: str, arguments: str) -> str:
        return self.line.format(indent, name, arguments)

    def _sent(self, indent: str, name: str, arguments: list[str], when: str) -> str:
        return self._line(indent, name, ", ".join([*arguments, *([when] if when else [])]))

    def _is_to_self(self, name: str) -> bool:
        return name.startswith(self.to_self)

    def _others(self, package: Package, part: Part, name: str) -> list[str]:
        """What else of the class sends arguments of the same types."""
        own = _types(package, part, name)
        every = [n for (owner, n), types in package.sends.items() if owner == part.owner]
        return [n for n in every if n != name and _types(package, part, n) == own]


def _types(package: Package, part: Part, name: str) -> tuple[str, ...]:
    return package.sends.get((part.owner, name), ())
