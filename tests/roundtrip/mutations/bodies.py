"""Changes of what the bodies of servers, methods and constructors do."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.roundtrip.mutations.choices import edits, other_member, other_rebec, stepped, swapped
from tests.roundtrip.mutations.package import Edit, Kind, Package, Part, at_start, within

_BLOCK = r"((?:\1  [^\n]*\n)+)"
_PLAIN = r"[^\n{};]+(?:\{[^{}\n]*\}[^\n{};]*)?;\n"


def _flipped(package: Package, part: Part, found: re.Match[str]) -> str:
    return "false" if found[0] == "true" else "true"


def _other_result(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """What a method gives, made another value of its type."""
    head = package.files[part.path][: part.start].rstrip().rpartition("\n")[2]
    if head.startswith("bool "):
        return f"return !({found[1]});"
    return f"return ({found[1]}) + 1;" if head.startswith("int32_t ") else None


def _depend(first: str, second: str) -> bool:
    """Whether the order matters: of sends, of what takes time, of a variable that both use."""
    if first == second or "drive_.move" in first + second:
        return False
    told = [bool(re.match(r"send|mailbox_\.delay|\w+\(", s)) for s in (first, second)]
    sets = [re.match(r"(?:this->)?([\w.\[\]()]+) = ", s) for s in (first, second)]
    sent = [s.startswith("send") for s in (first, second)]
    delayed = any("delay" in s for s in (first, second))
    if all(sent) or (delayed and any(told)):
        return all(told) or delayed
    names = [m[1].split("[")[0].split(".")[0] if m else None for m in sets]
    return (names[0] is not None and names[0] in second) or (
        names[1] is not None and names[1] in first
    )


def _dropped_branch(package: Package) -> Iterator[Edit]:
    """The last `else` of a chain of conditions."""
    yield from edits(package, rf"^( *)\}} else \{{\n{_BLOCK}\1\}}\n", r"\1}\n")


def _swapped_branches(package: Package) -> Iterator[Edit]:
    pattern = rf"^( *)(if \([^\n]*\) \{{\n){_BLOCK.replace('(', '(?P<then>', 1)}\1\}} else \{{\n"
    pattern += r"(?P<other>(?:\1  [^\n]*\n)+)\1\}\n"
    yield from edits(package, pattern, r"\1\2\g<other>\1} else {\n\g<then>\1}\n")


def _narrowed(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """A number that is cut to a byte before it is kept."""
    own = [m for m in package.members_of(part.owner) if m.name == found["name"]]
    if not own or own[0].type != "int32_t" or found[3].isdigit():
        return None
    return f"{found[1]} = static_cast<int8_t>({found[3]});"


KINDS = (
    Kind("< made <=", within(r" < ", " <= ")),
    Kind("> made >=", within(r" > ", " >= ")),
    Kind("== made !=", within(r" == ", " != ")),
    Kind("!= made ==", within(r" != ", " == ")),
    Kind("< made >", within(r" < ", " > ")),
    Kind("&& made ||", within(r" && ", " || ")),
    Kind("|| made &&", within(r" \|\| ", " && ")),
    Kind("! removed", within(r"(?<=[( ])!(?=[\w(])", "")),
    Kind("condition negated", within(r"\bif \((.*)\) \{$", r"if (!(\1)) {")),
    Kind("condition made true", within(r"\bif \((.*)\) \{$", r"if (true) {")),
    Kind("conjunct removed", within(r"if \(([^\n()]*?) && [^\n()]*?\) \{$", r"if (\1) {")),
    Kind("constant one greater", within(r"(?<!case )(?<![\w.\[])\d+\b(?!_)", stepped(1))),
    Kind("index one greater", within(r"(?<=\[)\d+(?=\])", stepped(1))),
    Kind("truth value flipped", within(r"\b(?:true|false)\b", _flipped)),
    Kind("+ made -", within(r" \+ ", " - ")),
    Kind("- made +", within(r" - ", " + ")),
    Kind("% made /", within(r" % ", " / ")),
    Kind("label of a case", within(r"\bcase (\d+):", stepped(50, shown="case {}:"))),
    Kind("break removed", within(r"^ *break;\n", "")),
    Kind("default removed", within(rf"^( *)default: \{{\n{_BLOCK}\1\}}\n", "")),
    Kind("assignment removed", within(r"^ *(?:this->)?\w+_[\w.\[\]()]* = [^\n]*;\n", "")),
    Kind("assignment to another", within(r"(?:this->)?\b(?P<name>\w+_)(?= = )", other_member)),
    Kind("read of another", within(r"(?<= )(?P<name>\w+_)\b(?! =)(?![\w.(])", other_member)),
    Kind("= made +=", within(r"(?<=_ )= (?!true|false|!|mailbox|\w+_;$)(?=[^\n]*;$)", "+= ")),
    Kind("narrowed", within(r"((?:this->)?(?P<name>\w+_)) = ([^\n;]*);", _narrowed)),
    Kind("else dropped", _dropped_branch),
    Kind("else if made if", within(r"\} else if \(", "} if (")),
    Kind("branches swapped", _swapped_branches),
    Kind(
        "statements swapped",
        within(
            rf"^(?P<indent> *)(?P<first>{_PLAIN})(?P=indent)(?P<second>{_PLAIN})", swapped(_depend)
        ),
    ),
    Kind("return at the start", at_start("  return;\n", "constructor", "msgsrv")),
    Kind("return in a branch", within(r"(if \(.*\) \{\n)( *)", r"\1\2return;\n\2", "msgsrv")),
    Kind("break in a loop", within(r"(for \(.*\) \{\n)( *)", r"\1\2break;\n\2")),
    Kind("continue in a loop", within(r"(for \(.*\) \{\n)( *)", r"\1\2continue;\n\2")),
    Kind("loop starts later", within(r"(for \(\w+ \w+ = )0;", r"\g<1>1;")),
    Kind("loop in greater steps", within(r"(for \(.*; )(\w+)\+\+\)", r"\1\2 += 2)")),
    Kind("body of a loop once", within(r"for \((.*?;) (.*?); .*\) \{$", r"\1 if (\2) {")),
    Kind("another result", within(r"return ([^\n;]+);", _other_result, "method")),
    Kind(
        "another rebec as result",
        within(r"return (\w+_);", other_rebec(r"return (\w+_);"), "method"),
    ),
    Kind("assertion removed", within(r"^ *mailbox_\.assertion\([^\n]*\n", "")),
    Kind("delay one longer", within(r"mailbox_\.delay\((.*)\);", r"mailbox_.delay((\1) + 1);")),
    Kind("delay removed", within(r"^ *mailbox_\.delay\([^\n]*\n", "")),
    Kind("delay twice", within(r"^( *mailbox_\.delay\([^\n]*\n)", r"\1\1")),
    Kind("delay added", at_start("  mailbox_.delay(1);\n", "constructor", "msgsrv", "method")),
    Kind("move removed", within(r"^ *drive_\.move\([^\n]*\n", "")),
    Kind("move turned", within(r"drive_\.move\(([^,]*), ([^)]*)\)", r"drive_.move(\2, \1)")),
    Kind("choices fewer", within(r"choose\(\{(\w+), \w+\}", r"choose({\1}")),
    Kind("choice made for good", within(r"mailbox_\.choose\(\{(\w+),[^\n]*;", r"\1;")),
)
