"""Lists that a CMakeLists.txt sets once and for good, in place of their names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from rebsync.reverse.build.cmake_text import Argument, Command, Quote

_REFERENCE = re.compile(r"\$\{(\w+)\}")
_ELSEWHERE = frozenset({"PARENT_SCOPE", "CACHE"})
_WORKED_OUT = frozenset("$;\\")  # what stands for something else, or splits words


class ConstantLists:
    """The lists of a file, which are known as its commands are gone through in their order.

    One that is set under a condition, or that another command names, may hold anything; so may all
    that were set before a command runs of which `is_known` does not know what it sets.
    """

    def __init__(
        self, commands: Sequence[tuple[Command, str]], is_known: Callable[[str], bool]
    ) -> None:
        self._named = Counter(a.text for command, _ in commands for a in command.arguments)
        self._is_known = is_known
        self._lists: dict[str, tuple[Argument, ...]] = {}

    def passed(self, command: Command, condition: str) -> None:
        """Takes in what a command sets."""
        if not self._is_known(command.name):
            self._lists.clear()
        elif command.name == "set" and command.arguments and not condition:
            name, *words = command.arguments
            if self._named[name.text] == 1 and all(map(_is_plain, words)):
                self._lists[name.text] = (*words,)

    def written_out(self, command: Command) -> Command:
        """The command with the words of these lists in place of their names."""
        return replace(command, arguments=tuple(self._words(command.arguments)))

    def _words(self, arguments: Sequence[Argument]) -> Iterator[Argument]:
        for argument in arguments:
            name = _REFERENCE.fullmatch(argument.text)
            if name is None or argument.quote is not Quote.NONE or name[1] not in self._lists:
                yield argument
            else:
                yield from self._lists[name[1]]


def _is_plain(word: Argument) -> bool:
    """Whether a word stands for itself, in a list of the file."""
    return _ELSEWHERE.isdisjoint({word.text}) and _WORKED_OUT.isdisjoint(word.text)
