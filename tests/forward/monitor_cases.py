"""A model, edits of the code that is generated from it, and what a monitor has to say of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

OK, ERROR = 0, 2
UNHEARD = "not heard from the beginning"
MODEL = """\
reactiveclass Station(4) {
  knownrebecs { Cart cart; }
  statevars { int seen; boolean[2] flags; }
  Station() { seen = 0; self.call(); }
  msgsrv call() { cart.drive(seen % 3) deadline(3); self.call() after(4); }
  msgsrv arrived(int place) { seen = seen + 1; flags[place % 2] = ?(true, false); }
}
reactiveclass Cart(3) {
  knownrebecs { Station station; }
  statevars { int at; Station last; }
  Cart() { at = 0; }
  msgsrv drive(int place) {
    delay(2);
    at = place;
    last = (Station) sender;
    station.arrived(at);
  }
}
main { Station station(cart):(); Cart cart(station):(); }
"""


@dataclass(frozen=True)
class Case:
    """One edit of the code, in each language, and the first step that it makes another.

    An edit is the class, the text and what is in its place; `step` counts what the rebec served.
    """

    name: str
    python: tuple[str, str, str] | None = None
    cpp: tuple[str, str, str] | None = None
    rebec: str = ""
    step: int = 0
    observed: str = ""
    expected: str = ""

    def edit_python(self, folder: Path) -> None:
        """Makes the edit in the modules of a folder."""
        if self.python is not None:
            _edit(folder / f"{self.python[0]}.py", *self.python[1:])

    def edit_cpp(self, folder: Path) -> None:
        """Makes the edit in the sources of a folder."""
        if self.cpp is not None:
            _edit(folder / f"{self.cpp[0]}.cpp", *self.cpp[1:])

    def check(self, statuses: Sequence[Mapping[str, Any]]) -> None:
        """Whether the statuses of a monitor say so: dicts of level, message and facts."""
        last = statuses[-1]
        if not self.rebec:
            assert last["level"] == OK, last
            assert int(last["facts"]["compared"]) >= 12, last
            assert ERROR not in [s["level"] for s in statuses]
            return
        assert last["level"] == ERROR, last
        facts = last["facts"]
        if self.rebec in facts.get(UNHEARD, "").split(", "):
            # Its first states came before the monitor was connected: its steps are counted from
            # the first that was heard, and what deviates first may be the next of its kind.
            assert (facts["rebec"], int(facts["step"]) <= self.step) == (self.rebec, True), last
            return
        assert (facts["rebec"], int(facts["step"])) == (self.rebec, self.step), last
        assert self.observed in facts["observed"], last
        assert self.expected in facts["expected"], last


def statuses_in(diagnostics: Iterable[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """The statuses of the monitor in what was heard on /diagnostics."""
    return [
        {
            "level": s["level"][0] if isinstance(s["level"], bytes) else s["level"],
            "message": s["message"],
            "facts": {pair["key"]: pair["value"] for pair in s["values"]},
        }
        for each in diagnostics
        for s in each["status"]
        if s["name"].endswith(": run of the model")
    ]


def _edit(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1, (path, old)
    path.write_text(text.replace(old, new), encoding="utf-8")


CASES = (
    Case("as generated"),
    Case(
        "wrong state",
        ("cart", "self._at = place\n", "self._at = place + 1\n"),
        ("cart", "at_ = place;", "at_ = place + 1;"),
        "cart",
        1,
        "at=1, last=station",
        "drive(0) ends at 2 with at=0, last=station",
    ),
    Case(
        "lost send",
        ("cart", "self.send_station_arrived(self._at)", "pass"),
        ("cart", "  sendStationArrived(at_);\n", ""),
        "station",
        2,
        "call(), arrived at 4",
        "arrived(0), arrived at 2, taken at 2",
    ),
    Case(
        "wrong argument",
        ("station", "remainder(self._seen, 3)", "remainder(self._seen, 3) + 1"),
        ("station", "seen_ % 3, deadline", "seen_ % 3 + 1, deadline"),
        "cart",
        1,
        "drive(1), arrived at 0",
        "drive(0), arrived at 0",
    ),
)
