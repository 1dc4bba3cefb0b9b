"""Draws networks whose rebecs act in the same moments and mostly do not meet: much to leave out.

A message at once goes only to rebecs of later classes, so that every moment ends, now and then
with an exception. Assertions and narrow bags make what goes wrong depend on the order of steps.
"""

from __future__ import annotations

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from tests.checker.draw_outlines import Drawer, Features
from tests.checker.draw_systems import Drawn


@st.composite
def networks(draw: DrawFn, delays: bool = True) -> Drawn:
    """A model with assertions; two to four classes, three to six rebecs."""
    drawer = Drawer(draw, Features(delays=delays))
    count = drawer.up_to(4, least=2)
    known = [[drawer.up_to(count - 1) for _ in range(drawer.up_to(2))] for _ in range(count)]
    classes = [_class(drawer, number, known) for number in range(count)]
    kinds = [*range(count), *(drawer.up_to(count - 1) for _ in range(drawer.up_to(2, least=1)))]
    main = [_rebec(drawer, number, kinds, known) for number in range(len(kinds))]
    model = "\n".join([*classes, "main {", *main, "}", ""])
    return Drawn(model, _properties(drawer, len(kinds)))


def _class(drawer: Drawer, number: int, known: list[list[int]]) -> str:
    bound = " ".join(f"K{kind} k{place};" for place, kind in enumerate(known[number]))
    ranks = ["@priority(1) ", ""] if drawer.flag(5) else ["", ""]
    depth = "@KeepLast(1) " if drawer.flag(8) else ""
    return f"""reactiveclass K{number}({drawer.up_to(6, least=2)}) {{
  knownrebecs {{ {bound} }}
  statevars {{ byte v; }}
  K{number}(int first) {{ v = 0; self.tick() after(first); }}
  {ranks[0]}msgsrv tick() {{ {_body(drawer, number, known)} {_again(drawer)} }}
  {depth}{ranks[1]}msgsrv put(byte x) {{ {_body(drawer, number, known)} }}
}}"""


def _again(drawer: Drawer) -> str:
    return f"self.tick() after({drawer.one(['1', '2', '?(1, 2)'])});" if drawer.up_to(3) else ""


def _body(drawer: Drawer, number: int, known: list[list[int]]) -> str:
    lines = []
    for _ in range(drawer.up_to(2)):
        match drawer.up_to(7):
            case 0:
                lines.append(f'assertion(v < {drawer.up_to(3, least=1)}, "low");')
            case 1 if drawer.features.delays:
                lines.append(f"delay({drawer.up_to(2)});")
            case 2 | 3 | 4:
                lines.append(f"v = (byte) ((v + {drawer.up_to(2)}) % 3);")
            case _:
                lines += _send(drawer, number, known[number])
    return " ".join(lines)


def _send(drawer: Drawer, number: int, known: list[int]) -> list[str]:
    options = [f"k{place}" for place in range(len(known))]
    if not options and not drawer.flag(4):
        return []
    place = drawer.up_to(len(options))
    at_once = (place < len(known) and known[place] > number) or drawer.flag(10)
    after = drawer.one(["", " after(1)", " after(v)"] if at_once else [" after(1)", " after(2)"])
    if place == len(options):
        return [f"if (sender instanceof K0) {{ ((K0) sender).tick(){after}; }}"]
    return [f"{options[place]}.put({drawer.one(['v', '1', '?(0, 1)'])}){after};"]


def _rebec(drawer: Drawer, number: int, kinds: list[int], known: list[list[int]]) -> str:
    fitting = ([n for n, k in enumerate(kinds) if k == wanted] for wanted in known[kinds[number]])
    bound = ", ".join(f"r{drawer.one(options)}" for options in fitting)
    return f"  K{kinds[number]} r{number}({bound}):({drawer.up_to(2)});"


def _properties(drawer: Drawer, rebecs: int) -> str:
    entries = []
    for number in range(drawer.up_to(3, least=1)):
        read = [drawer.up_to(rebecs - 1) for _ in range(drawer.one([1, 1, 2]))]
        parts = " || ".join(f"r{r}.v {drawer.one(['!=', '<'])} {drawer.up_to(2)}" for r in read)
        entries.append(f"p{number}: {parts};")
    return "property { Assertion { " + " ".join(entries) + " } }\n"
