"""What the topics between rebecs say of a deviation: was the message sent, by whom, how often?"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rebsync.conform.conformance import Deviation
from rebsync.conform.recording import Event, Sent

_FEW = 4  # messages that are told of
_Key = tuple[str, str, int]


def explanation(deviation: Deviation, rebec: int, events: Iterable[Event]) -> tuple[str, ...]:
    """Sentences about the message that was served, and those that the model allows.

    `rebec` is the number of the one that deviates; `events` are all of the recording.
    """
    wanted: dict[_Key, list[Sent]] = {}
    if deviation.served is not None:
        served = deviation.served
        wanted[served.server, served.arguments, served.arrival] = []
    for allowed in deviation.allowed[:_FEW]:
        wanted[allowed.server, allowed.arguments, allowed.arrival] = []
    has_any = False
    for event in events:
        if isinstance(event, Sent):
            has_any = True
            if event.receiver == rebec and event.arrival is not None:
                found = wanted.get((event.server, event.arguments, event.arrival))
                if found is not None and len(found) < _FEW:
                    found.append(event)
    if not has_any:
        return ()
    return tuple(_sentences(wanted))


def _sentences(wanted: dict[_Key, list[Sent]]) -> Iterator[str]:
    for (server, arguments, arrival), found in wanted.items():
        if server == "constructor":
            continue
        message = f"{server}({arguments}) that arrives at {arrival}"
        if not found:
            yield f"{message} is on no topic; what a rebec sends itself is on none"
            continue
        times = [f"{len(found)} times"] if len(found) > 1 else []
        by = [f"by {found[0].publisher}"] if found[0].publisher else []
        said = [message, "was published", *times, *by, f"(message {found[0].place.number})"]
        yield " ".join(said)
