"""Whether bags of messages repeat, and what it would save to keep each of them once.

    python bench/bags.py

Local states are kept once (decision 10). Of models whose states cost most, those that occur are
counted, with their bags, and the bytes of these as templates/components.h packs them: in every
local state that has them, and once. A bag of its own would be a number in its local states, and,
beside its content, where it begins and a slot of a table.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable

from running import MODELS
from searching import program_of

from rebsync.checker.exploration import Limits
from rebsync.checker.program import NO_DEADLINE, Cell
from rebsync.checker.search import Interpreted
from rebsync.checker.state import Message

ASKED = (("crowd", "longest", "4"), ("crowd", "longest", "10"), ("ttc", "rounds", "9"))
NUMBER, PLACE = 4, 8 + 11  # bytes at least, with a table that is three quarters full


def packed(value: Cell) -> int:
    """The bytes of a cell: 7 bits in each."""
    whole = struct.unpack("<q", struct.pack("<d", value))[0] if isinstance(value, float) else value
    bits = ((int(whole) << 1) ^ (int(whole) >> 63)) & (1 << 64) - 1
    return max(1, -(-bits.bit_length() // 7))


def _due(deadline: int) -> int:
    """A deadline as a number of which 0 is none."""
    return 0 if deadline == NO_DEADLINE else deadline + (deadline >= 0)


def content(bag: Iterable[Message]) -> int:
    """The bytes of a bag, its length included."""
    fields = (
        (
            m.arrival,
            m.server,
            m.sender,
            _due(m.deadline),
            *m.arguments,
        )
        for m in bag
    )
    return 1 + sum(packed(cell) for cells in fields for cell in cells)


def main() -> None:
    print(
        "model                   states  local states     bags   bytes of bags: now  once (a state)"
    )
    for name, parameter, value in ASKED:
        search = Interpreted(program_of(MODELS / f"{name}.rebeca", {parameter: value}), "ftts")
        states = search.run(Limits()).states
        local, bags, now, once = 0, 0, 0, 0
        for rebec in range(len(search.program.rebecs)):
            own = {state[rebec] for state in search.states}
            different = {each.bag for each in own}
            local, bags = local + len(own), bags + len(different)
            now += sum(content(each.bag) for each in own)
            once += NUMBER * len(own) + sum(PLACE + content(bag) for bag in different)
        print(
            f"{f'{name}, {parameter}={value}':18}{states:12,}{local:14,}{bags:9,}"
            f"{now / states:21.1f}{once / states:6.1f}"
        )


if __name__ == "__main__":
    main()
