"""Names of hand-written code as names of the model."""

from __future__ import annotations

import re
from collections.abc import Collection

from rebsync.names import camel_case, unique
from rebsync.records import dataclass

_WORDS = frozenset(
    """abstract after assertion boolean break byte case continue currentMessageArrival
    currentMessageDeadline currentMessageWaitingTime deadline default delay double else env extends
    false featurevar float for goto if implements import instanceof int interface knownrebecs main
    msgsrv new now null package pow private protected public reactiveclass record return self
    sender short sqrt statevars super switch true void while""".split()  # noqa: SIM905
)
_NO_LETTER = re.compile(r"\W")


def model_word(text: str) -> str:
    """The text as a name that the language takes: `~cmd/vel` is `cmd_vel`."""
    plain = _NO_LETTER.sub("_", text).lstrip("_") or "value"
    if plain[0].isdigit():
        plain = f"n_{plain}"
    return f"{plain}_" if plain in _WORDS else plain


def class_word(text: str) -> str:
    """The name of a class after a program or node: `vel_mux` is `VelMux`."""
    return model_word(camel_case(model_word(text)))


@dataclass(slots=True)
class Names:
    """Hands out names of one class, each once."""

    used: set[str]

    @staticmethod
    def beside(others: Collection[str]) -> Names:
        """Names that are none of these."""
        return Names(set(others))

    def give(self, *wishes: str) -> str:
        """The first of the names that is free, or the first with a number behind it."""
        words = [model_word(wish) for wish in wishes]
        free = next((word for word in words if word not in self.used), words[0])
        return unique(free, self.used)
