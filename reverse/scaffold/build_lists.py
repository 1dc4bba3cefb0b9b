"""Lists that a CMakeLists.txt sets once and for good, in place of their names; loops over them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from rebsync.reverse.build.cmake_text import Argument, Command, CommandBlock, Item, Quote

_REFERENCE = re.compile(r"\$\{(\w+)\}")
_ELSEWHERE = frozenset({"PARENT_SCOPE", "CACHE"})
_WORKED_OUT = frozenset("$;\\")  # what stands for something else, or splits words
_LEAVING = frozenset({"break", "continue", "return"})


class ConstantLists:
    """The lists of a file, which are known as its commands are gone through in their order.

    One that is set under a condition, or that another command names, may hold anything; so may all
    that were set before a command runs of which `is_known` does not know what it sets.
    """

    def __init__(
        self, commands: Sequence[tuple[Command, str]], is_known: Callable[[str], bool]
    ) -> None:
        self._named = Counter(a.text for command, _ in commands for a in _named_in(command))
        self._loops = Counter(
            c.arguments[0].text for c, _ in commands if c.name == "foreach" and c.arguments
        )
        self._may_name = any(map(_sets_what_is_worked_out, (c for c, _ in commands)))
        self._is_known = is_known
        self._lists: dict[str, tuple[Argument, ...]] = {}

    def passed(self, command: Command, condition: str) -> None:
        """Takes in what a command sets."""
        if not self._is_known(command.name) or self._may_name:
            self._lists.clear()
        elif command.name == "set" and command.arguments and not condition:
            name, *words = command.arguments
            if self._named[name.text] == 1 and all(map(_is_plain, words)):
                self._lists[name.text] = (*words,)

    def written_out(self, command: Command) -> Command:
        """The command with the words of these lists in place of their names."""
        return replace(command, arguments=tuple(self._words(command.arguments)))

    def rounds(self, loop: CommandBlock) -> list[tuple[Item, ...]] | None:
        """The commands of each round of a `foreach` over words that are known.

        None where the commands of a round may set its variable, or leave the loop.
        """
        if loop.head.name != "foreach":
            return None
        words = self.written_out(loop.head).arguments
        match [word.text for word in words]:
            case [_, "IN", "LISTS", name] if name in self._lists:
                words = (words[0], *self._lists[name])
            case [_, "IN", "ITEMS", *_]:
                words = (words[0], *words[3:])
            case [_, "IN" | "RANGE", *_]:
                return None
            case _:
                pass
        inside = list(_all_commands(loop.body))
        is_left = any(c.name in _LEAVING or not self._is_known(c.name) for c in inside)
        if not words or not all(map(_is_plain, words)) or is_left or self._may_name:
            return None
        name = words[0].text
        is_used_again = any(c.name == "foreach" and c.arguments[:1] == words[:1] for c in inside)
        if self._named[name] != self._loops[name] or is_used_again:
            return None
        return [tuple(_in_round(item, name, word.text) for item in loop.body) for word in words[1:]]

    def _words(self, arguments: Sequence[Argument]) -> Iterator[Argument]:
        for argument in arguments:
            name = _REFERENCE.fullmatch(argument.text)
            if name is None or argument.quote is not Quote.NONE or name[1] not in self._lists:
                yield argument
            else:
                yield from self._lists[name[1]]


def _sets_what_is_worked_out(command: Command) -> bool:
    """Whether the name of the variable that is set is itself made of others."""
    return command.name in ("set", "unset") and any("$" in a.text for a in command.arguments[:1])


def _named_in(command: Command) -> Sequence[Argument]:
    """The words by which a command may set a variable; a loop only reads its lists."""
    is_over_lists = [a.text for a in command.arguments[1:3]] == ["IN", "LISTS"]
    return command.arguments[: 1 if command.name == "foreach" and is_over_lists else None]


def _all_commands(items: Sequence[Item]) -> Iterator[Command]:
    for item in items:
        match item:
            case CommandBlock(head, body, others):
                yield head
                yield from _all_commands(body)
                for branch, other in others:
                    yield branch
                    yield from _all_commands(other)
            case Command():
                yield item


def _in_round(item: Item, name: str, word: str) -> Item:
    """What a command of a loop is in the round in which its variable is `word`."""

    def of(command: Command) -> Command:
        return replace(command, arguments=tuple(map(argument, command.arguments)))

    def argument(written: Argument) -> Argument:
        if written.quote is Quote.BRACKET:
            return written
        return replace(written, text=re.sub(rf"(?<!\\)\$\{{{name}\}}", word, written.text))

    match item:
        case CommandBlock(head, body, others):
            return CommandBlock(
                of(head),
                tuple(_in_round(inner, name, word) for inner in body),
                tuple((of(b), tuple(_in_round(i, name, word) for i in o)) for b, o in others),
            )
        case Command():
            return of(item)


def _is_plain(word: Argument) -> bool:
    """Whether a word stands for itself, in a list of the file."""
    return _ELSEWHERE.isdisjoint({word.text}) and _WORKED_OUT.isdisjoint(word.text)
