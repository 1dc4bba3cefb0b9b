"""Draws small systems that can be checked: texts of models, well typed, mostly finite.

Variables stay small (`% 3`, bytes that wrap in a few steps), times are constants from 0 to 4, so
that state spaces have tens or hundreds of states. What goes wrong goes wrong now and then.
"""

from __future__ import annotations

from dataclasses import dataclass

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from tests.checker.draw_expressions import Body, arguments, truth, value
from tests.checker.draw_outlines import Callee, Drawer, Features, Outline, outline
from tests.checker.draw_statements import beat, block

TIMED = Features()
WITHOUT_DELAY = Features(delays=False)
UNTIMED = Features(timed=False, delays=False)
CLOCKED = Features(clock=True)
REAL = Features(floats=True)
DRIVEN = Features(drivers=True)
EQUAL = Features(equals=True)
EQUAL_UNTIMED = Features(timed=False, delays=False, equals=True)


@dataclass(frozen=True)
class Drawn:
    """A model and a property file that goes with it."""

    model: str
    properties: str

    def __repr__(self) -> str:
        return f"\n{self.model}\n{self.properties}"


@st.composite
def systems(draw: DrawFn, features: Features = TIMED) -> Drawn:
    """A system with its properties; the static rules accept both."""
    drawer = Drawer(draw, features)
    outline(drawer)
    ranks = _ranks(drawer)
    classes = [_class(drawer, each, ranks) for each in drawer.classes]
    rebecs = _instances(drawer)
    instances = _main(drawer, rebecs, ranks)
    if features.drivers:
        driven = drawer.one([name for each, name in rebecs if each is drawer.classes[0]])
        classes.append(_driver(drawer))
        number = drawer.up_to(len(instances))
        instances[number:number] = [f"Driver d{i}({driven}):();" for i in range(drawer.up_to(2, 1))]
    main = ["main {", *(f"  {line}" for line in instances), "}"]
    lines = [line for each in (*classes, main) for line in each]
    atoms = _atoms_of_equals if features.equals else _atoms_of_all
    return Drawn("\n".join(lines) + "\n", _properties(drawer, atoms(drawer, rebecs)))


def _ranks(drawer: Drawer) -> str:
    """The annotation that orders servers and instances, if any."""
    if not drawer.features.timed or drawer.features.equals:
        return ""
    if drawer.features.drivers:
        return ""
    return drawer.one(["", "", "priority", "priority", "globalPriority"])


def _ranked(drawer: Drawer, ranks: str) -> str:
    return f"@{ranks}({drawer.up_to(2)}) " if ranks and drawer.flag() else ""


def _class(drawer: Drawer, each: Outline, ranks: str) -> list[str]:
    extends = f" extends {each.base.name}" if each.base else ""
    lines = [f"reactiveclass {each.name}{extends}({each.capacity}) {{"]
    for section, declared in (("knownrebecs", each.known), ("statevars", each.state)):
        lines.append(f"  {section} {{")
        lines += [f"    {kind} {name};" for kind, name in declared]
        lines.append("  }")
    lines += _indented(_constructor(drawer, each))
    for server in each.servers:
        lines += _indented(_server(drawer, each, server, ranks))
    for method in each.methods:
        lines += _indented(_method(drawer, each, method))
    return [*lines, "}"]


def _driver(drawer: Drawer) -> list[str]:
    """A class that acts by itself: what it sends arrives later."""
    body = Body(drawer, Outline("Driver", 3), "server", [("int", "n")])
    times = "1", "2", "?(1, 2)", "?(2, 3, 3)"
    server = drawer.one(drawer.servers_of("C0"))
    sent = f"driven.{server.name}({arguments(body, server)}) after({drawer.one(times)});"
    lines = [f"n = (n + {drawer.up_to(2)}) % 2;"]
    lines += [f"if ({truth(body, 1)}) {{", f"  {sent}", "}"] if drawer.flag() else [sent]
    lines.append(f"tick() after({drawer.one(times)});")
    return [
        f"reactiveclass Driver({drawer.up_to(3, least=2)}) {{",
        "  knownrebecs {",
        "    C0 driven;",
        "  }",
        "  statevars {",
        "    int n;",
        "  }",
        "  Driver() {",
        "    self.tick();",
        "  }",
        "  msgsrv tick() {",
        *(f"    {line}" for line in lines),
        "  }",
        "}",
    ]


def _indented(lines: list[str]) -> list[str]:
    return [f"  {line}" for line in lines]


def _body(drawer: Drawer, each: Outline, kind: str, callee: Callee) -> Body:
    variables = [v for c in each.line() for v in c.state]
    # Known rebecs are for servers and methods; a constructor sends only to itself.
    known = [k for c in each.line() for k in c.known]
    body = Body(drawer, each, kind, [*variables, *callee.parameters], known, callee.result)
    if kind == "method":
        body.rank = int(callee.name[1:])
    return body


def _constructor(drawer: Drawer, each: Outline) -> list[str]:
    body = _body(drawer, each, "constructor", Callee("", (("int", "start"),)))
    lines = block(body, 1, most=2)
    if drawer.up_to(4) or each is drawer.classes[0]:
        lines += beat(body)
    return [f"{each.name}(int start) {{", *_indented(lines), "}"]


def _server(drawer: Drawer, each: Outline, server: Callee, ranks: str) -> list[str]:
    body = _body(drawer, each, "server", server)
    lines = block(body, 2, most=3, least=1)
    if drawer.up_to(5):
        lines += beat(body)
    head = f"{_ranked(drawer, ranks)}msgsrv {server.name}({_declared(server)}) {{"
    return [head, *_indented(lines), "}"]


def _method(drawer: Drawer, each: Outline, method: Callee) -> list[str]:
    body = _body(drawer, each, "method", method)
    lines = block(body, 1, most=3)
    if method.result != "void":
        lines.append(f"return {value(body, method.result)};")
    return [f"{method.result} {method.name}({_declared(method)}) {{", *_indented(lines), "}"]


def _declared(callee: Callee) -> str:
    return ", ".join(f"{kind} {name}" for kind, name in callee.parameters)


# --- main ----------------------------------------------------------------------------------------


def _instances(drawer: Drawer) -> list[tuple[Outline, str]]:
    chosen = [*drawer.classes, *(c for c in drawer.classes if drawer.flag(3))]
    if drawer.features.equals:
        chosen = drawer.classes[:1] * drawer.up_to(3, least=2) + drawer.classes[1:]
    if len(chosen) == 1:
        chosen *= 2
    return [(each, f"r{number}") for number, each in enumerate(chosen)]


def _main(drawer: Drawer, rebecs: list[tuple[Outline, str]], ranks: str) -> list[str]:
    return [_rebec(drawer, each, name, rebecs, ranks) for each, name in rebecs]


def _rebec(
    drawer: Drawer, each: Outline, name: str, rebecs: list[tuple[Outline, str]], ranks: str
) -> str:
    bindings = []
    for kind, _ in (k for c in each.line() for k in c.known):
        fitting = [n for c, n in rebecs if any(a.name == kind for a in c.line())]
        others = [n for n in fitting if n != name] or fitting
        if drawer.features.equals:  # the next in a ring, or one that is none of the equals
            others = [n for n in fitting if n > name][:1] or fitting[:1]
            others = fitting[-1:] if drawer.flag(8) else others
        bindings.append(drawer.one(others))
    rank = _ranked(drawer, ranks if ranks == "priority" else "")
    return f"{rank}{each.name} {name}({', '.join(bindings)}):({drawer.up_to(3)});"


# --- properties ----------------------------------------------------------------------------------


def _atoms_of_all(drawer: Drawer, rebecs: list[tuple[Outline, str]]) -> list[str]:
    return [atom for each, name in rebecs for atom in _atoms(drawer, each, name)]


def _atoms_of_equals(drawer: Drawer, rebecs: list[tuple[Outline, str]]) -> list[str]:
    """What is said of all rebecs of the first class, or of some of them; now and then of one."""
    equals = [name for each, name in rebecs if each is drawer.classes[0]]
    if drawer.flag(5):
        return _atoms_of_all(drawer, rebecs)
    return [
        "(" + drawer.one([" && ", " || "]).join(atom.replace("r0.", f"{n}.") for n in equals) + ")"
        for atom in _atoms(drawer, *rebecs[0])
    ]


def _properties(drawer: Drawer, atoms: list[str]) -> str:
    if not atoms:
        return ""
    entries = []
    for number in range(drawer.up_to(2, least=1)):
        joined = drawer.one([" && ", " || ", " -> "])
        parts = [drawer.one(atoms) for _ in range(drawer.up_to(2, least=1))]
        entries.append(f"    p{number}: {joined.join(parts)};")
    defined = drawer.one(atoms)
    return "\n".join(
        (
            "property {",
            f"  define {{ d: d = {defined}; }}".replace("d: d", "d"),
            "  Assertion {",
            *entries,
            "    q: !d || d;" if drawer.flag() else "    q: d;",
            "  }",
            "}",
            "",
        )
    )


def _atoms(drawer: Drawer, each: Outline, name: str) -> list[str]:
    atoms = []
    for kind, variable in (v for c in each.line() for v in c.state):
        read = f"{name}.{variable}"
        match kind:
            case "boolean":
                atoms.append(read)
            case "int" | "byte" | "float" | "double":
                compared = drawer.one(["==", "!=", "<", ">="])
                atoms.append(f"{read} {compared} {drawer.up_to(2)}")
            case "int[2]":
                atoms.append(f"{read}[{drawer.up_to(1)}] >= 0")
            case "byte[2][2]":
                atoms.append(f"{read}[1][{drawer.up_to(1)}] != 1")
            case _:
                atoms.append(f"{read} != null")
    return atoms
