"""Changes of what the bodies of servers, methods and constructors in Python do."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.roundtrip.mutations.choices import edits, other_member, other_rebec, stepped, swapped
from tests.roundtrip.mutations.package import Edit, Kind, Package, Part, at_start, within

_BLOCK = r"((?:\1    [^\n]*\n)+)"
_IF = r"\b((?:el)?if) (.*):$"
_SIMPLE = r"(?:self\.|int32)[^\n]*\n"


def _flipped(package: Package, part: Part, found: re.Match[str]) -> str:
    return "False" if found[0] == "True" else "True"


def _type_of(package: Package, part: Part) -> str:
    """What a function gives, as its head says."""
    head = package.files[part.path][: part.start].rstrip().rpartition("\n")[2]
    return head.rpartition("-> ")[2].rstrip(":")


def _other_result(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """What a method gives, made another value of its type."""
    type_ = _type_of(package, part)
    if type_ == "bool":
        return f"return not ({found[1]})"
    return f"return int32(({found[1]}) + 1)" if type_ == "int" else None


def _depend(first: str, second: str) -> bool:
    """Whether the order matters: of sends, of what takes time, of a variable that both use."""
    if first == second or "_drive.move" in first + second:
        return False
    told = [bool(re.match(r"self\.(?:\w+\(|_mailbox\.delay)", s)) for s in (first, second)]
    sets = [re.match(r"(self\._\w+)[\w.\[\]()]* = ", s) for s in (first, second)]
    delayed = any("delay" in s for s in (first, second))
    if all(s.startswith("self.send") for s in (first, second)) or (delayed and any(told)):
        return all(told) or delayed
    names = [m[1] if m else None for m in sets]
    return (names[0] is not None and f"{names[0]} " in f"{second} ".replace("\n", " ")) or (
        names[1] is not None and f"{names[1]} " in f"{first} ".replace("\n", " ")
    )


def _swapped_branches(package: Package) -> Iterator[Edit]:
    pattern = rf"^( *)(if [^\n]*:\n){_BLOCK.replace('(', '(?P<then>', 1)}\1else:\n"
    pattern += r"(?P<other>(?:\1    [^\n]*\n)+)"
    yield from edits(package, pattern, r"\1\2\g<other>\1else:\n\g<then>")


def _narrowed(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """A number that is cut to a byte before it is kept."""
    own = [m for m in package.members_of(part.owner) if m.name == found["name"]]
    if not own or own[0].type != "int" or found["value"].isdigit():
        return None
    return f"{found['name']} = ({found['value']}) & 127"


_CHOOSE = r"self\._mailbox\.choose\(\[([^,\]]*), [^\]]*\](?:, self\._\w+\.seen\(\w+\))?\)"

KINDS = (
    Kind("< made <=", within(r" < ", " <= ")),
    Kind("> made >=", within(r" > ", " >= ")),
    Kind("== made !=", within(r" == ", " != ")),
    Kind("!= made ==", within(r" != ", " == ")),
    Kind("< made >", within(r" < ", " > ")),
    Kind("and made or", within(r" and ", " or ")),
    Kind("or made and", within(r" or ", " and ")),
    Kind("not removed", within(r"\bnot (?=[\w(])", "")),
    Kind("condition negated", within(_IF, r"\1 not (\2):")),
    Kind("condition made true", within(_IF, r"\1 True:")),
    Kind("conjunct removed", within(r"if ([^\n()]*?) and [^\n()]*?:$", r"if \1:")),
    Kind("constant one greater", within(r"(?<![\w.\[])\d+\b", stepped(1))),
    Kind("index one greater", within(r"(?<=\[)\d+(?=\])", stepped(1))),
    Kind("truth value flipped", within(r"\b(?:True|False)\b", _flipped)),
    Kind("+ made -", within(r" \+ ", " - ")),
    Kind("- made +", within(r" - ", " + ")),
    Kind("remainder made quotient", within(r"\bremainder\(", "divide(")),
    Kind("int32 left out", within(r"\bint32(?=\()", "")),
    Kind("// for divide", within(r"\bremainder\((int32\([^()]*\)), (\d+)\)", r"(\1 // \2)")),
    Kind("label of a case", within(r"(?<= in \()\d+(?=, )", stepped(50))),
    Kind("case removed", within(rf"^( *)elif [^\n]* == \d+:\n{_BLOCK}", "")),
    Kind("assignment removed", within(r"^( *)self\._[\w.\[\]()]* = [^\n]*\n", r"\1pass\n")),
    Kind("assignment to another", within(r"(?P<name>\bself\._\w+)(?= = )", other_member)),
    Kind(
        "read of another",
        within(r"(?<=[ (])(?P<name>self\._\w+)\b(?! =)(?![\w.(\[])", other_member),
    ),
    Kind("= made +=", within(r"(?<= )(self\._\w+) = (?=[^\n]*int32|\d)", r"\1 += ")),
    Kind("narrowed", within(r"(?P<name>self\._\w+) = (?P<value>[^\n]*)$", _narrowed)),
    Kind("else dropped", lambda p: edits(p, rf"^( *)else:\n{_BLOCK}", "")),
    Kind("elif made if", within(r"\belif ", "if ")),
    Kind("branches swapped", _swapped_branches),
    Kind(
        "statements swapped",
        within(
            rf"^(?P<indent> *)(?P<first>{_SIMPLE})(?P=indent)(?P<second>{_SIMPLE})",
            swapped(_depend),
        ),
    ),
    Kind(
        "statement taken into a branch",
        within(r"^( +)(    \S[^\n]*\n)\1(self\.[^\n]*\n)", r"\1\2\1    \3"),
    ),
    Kind("return at the start", at_start("        return\n", "constructor", "msgsrv")),
    Kind(
        "return in a branch",
        within(r"(\bif .*:\n)( *)(?=\S)", r"\1\2return\n\2", "msgsrv"),
    ),
    Kind("raise in a branch", within(r"(\bif .*:\n)( *)(?=\S)", r"\1\2raise ValueError\n\2")),
    Kind("break in a loop", within(r"^( *)(for \w+ in .*:\n)", r"\1\2\1    break\n")),
    Kind("loop starts later", within(r"\brange\((\d+)\)", r"range(1, \1)")),
    Kind("loop in greater steps", within(r"\brange\((\d+)\)", r"range(0, \1, 2)")),
    Kind("loop ends earlier", within(r"\brange\(\d+\)", "range(1)")),
    Kind("another result", within(r"return ([^\n]+[^\n(])$", _other_result, "method")),
    Kind(
        "another rebec as result",
        within(r"return (self\._\w+)$", other_rebec(r"return (self\._\w+)$"), "method"),
    ),
    Kind(
        "assertion removed",
        within(
            r"^( *)self\._mailbox\.assertion\((?:\n(?:\1 +[^\n]*\n)*\1\)|[^\n]+)\n", r"\1pass\n"
        ),
    ),
    Kind(
        "assertion of Python",
        within(r"^( *)self\._mailbox\.assertion\(\s*(.*),\s*[^,\n]*,?\s*\)$", r"\1assert \2"),
    ),
    Kind("delay one longer", within(r"_mailbox\.delay\((.*)\)$", r"_mailbox.delay((\1) + 1)")),
    Kind("delay removed", within(r"^( *)self\._mailbox\.delay\([^\n]*\n", r"\1pass\n")),
    Kind("delay twice", within(r"^( *self\._mailbox\.delay\([^\n]*\n)", r"\1\1")),
    Kind("time.sleep for a delay", within(r"self\._mailbox\.delay\((.*)\)$", r"time.sleep(\1)")),
    Kind(
        "delay added",
        at_start("        self._mailbox.delay(1)\n", "constructor", "msgsrv", "method"),
    ),
    Kind("move removed", within(r"^( *)self\._drive\.move\([^\n]*\n", r"\1pass\n")),
    Kind("move turned", within(r"_drive\.move\(([^,]*), ([^)]*)\)", r"_drive.move(\2, \1)")),
    Kind("choices fewer", within(r"choose\(\[(\w+), \w+\]", r"choose([\1]")),
    Kind("choice made for good", within(_CHOOSE, r"\1")),
    Kind("random choice", within(r" < (\d+)", r" < random.randrange(\1)")),
)
