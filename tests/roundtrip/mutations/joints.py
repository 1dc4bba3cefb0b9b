"""Changes of how nodes are set up and joined: members, topics, handlers, messages."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.roundtrip.mutations.package import (
    Edit,
    Kind,
    Maker,
    Mutant,
    Package,
    Part,
    Texts,
    at_end,
    at_start,
    in_files,
    within,
)
from tests.roundtrip.mutations.surroundings import constants

_STATE = r"// rebsync: statevar (\S+)$"


def _in_header(pattern: str, text: str, *, of_class: bool = False) -> Maker:
    """In the declaration of a state variable, whose path is the last group.

    `of_class`: the model has it in the constructor.
    """

    def make(package: Package) -> Iterator[Edit]:
        for path in package.paths(".h"):
            for found in re.finditer(pattern, package.files[path], re.MULTILINE):
                element = found[found.re.groups]
                element = element.partition(".")[0] if of_class else element
                yield Edit(path, *found.span(), found.expand(text), element)

    return make


def _other_handler(package: Package, part: Part, found: re.Match[str]) -> str | None:
    own = [p.element.partition(".")[2] for p in package.parts if p.kind == "receive"]
    names = [
        p.element.partition(".")[2]
        for p in package.parts
        if p.kind == "receive" and p.owner == part.owner
    ]
    others = [n for n in names if n != found[2]]
    return f"&{found[1]}::{others[0]}" if others and found[2] in own else None


def _other_body(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """Another server of the class that takes as many arguments, in a shim."""
    others = sorted(_bodies(package, part) - {found[1]})
    return f"{{ {others[0]}({found[2]}); }}" if others and not found[2] else None


def _bodies(package: Package, part: Part) -> set[str]:
    every = (p for p in package.parts if p.kind == "msgsrv" and p.owner == part.owner)
    heads = [(p, package.files[p.path][: p.start].rstrip().rpartition("\n")[2]) for p in every]
    return {p.element.partition(".")[2] for p, head in heads if "()" in head}


def _other_of(pattern: str, name: str) -> Texts:
    """Another text of the same file that matches a pattern."""

    def text(package: Package, part: Part, found: re.Match[str]) -> str | None:
        every = re.findall(pattern, package.files[part.path])
        others = [each for each in every if each != found[name]]
        whole, start = found[0], found.start(name) - found.start()
        end = start + len(found[name])
        return whole[:start] + others[0] + whole[end:] if others else None

    return text


def _other_parameter(package: Package) -> Iterator[Mutant]:
    """A parameter of the model that has another value, in place of each that is read."""
    values = {found[2]: found[3] for _, found in constants(package)}
    read = re.compile(r'(?<=global\.param\(")\w+|(?<=declare_parameter<int>\("env\.)\w+')
    for part in (p for p in package.parts if p.kind == "setup"):
        text = package.files[part.path]
        for m in read.finditer(text, part.start, part.end):
            other = next((n for n in values if values[n] != values.get(m[0])), None)
            if other is not None:
                made = package.mutant(Edit(part.path, *m.span(), other))
                yield Mutant(made.files, made.place, (part.owner, m[0], other))


def _swapped_pair(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """The first two of several arguments in the other order."""
    first, second, *rest = re.split(r", *", found[2])
    types = [_field_types(package, name.removeprefix("msg->")) for name in (first, second)]
    if first.startswith("msg->") and types[0] != types[1]:
        return None
    return found[1] + ", ".join([second, first, *rest]) + found[3]


def _field_types(package: Package, name: str) -> set[str]:
    """The types of the fields of messages that have a name."""
    texts = (package.files[path] for path in package.paths(".msg"))
    return {m[1] for text in texts for m in re.finditer(rf"^(\S+) {name}$", text, re.MULTILINE)}


def _servers(pattern: str, text: str) -> Maker:
    def make(package: Package) -> Iterator[Edit]:
        for path in package.paths(".cpp"):
            for found in re.finditer(pattern, package.files[path]):
                owner = package.owners.get(path, "")
                yield Edit(path, *found.span(), found.expand(text), owner)

    return make


def _published(package: Package) -> Iterator[Edit]:
    """A state variable that is set where the state is published."""
    for path in package.paths(".cpp"):
        for found in re.finditer(r"^  msg\.(\w+) = (\w+_);\n", package.files[path], re.MULTILINE):
            text = f"  {found[2]} = {{}};\n"
            yield Edit(path, found.start(), found.start(), text, package.owners.get(path, ""))


def _one_more(step: int) -> Texts:
    return lambda package, part, found: f"{found[1]}{int(found[2]) + step}"


_S = "setup"
_AFTER = r"^(namespace \{\n)(?=\nconstexpr Server)"
_CLASS = (
    r"^(class \w+ (?:: public [\w:]+ )?\{\n)(?= public:\n  \w*[ ]?\w+\(const (?:ros|rclcpp)::Node)"
)
_PAIR = r"((?:\w|->)+, (?:\w|->)+(?:, (?:\w|->)+)*)"

KINDS = (
    Kind("queue one longer", within(r"(mailbox_\((?:node|\*this), )(\d+)", _one_more(1), _S)),
    Kind("queue one shorter", within(r"(mailbox_\((?:node|\*this), )(\d+)", _one_more(-1), _S)),
    Kind("best priority left out", within(r"(mailbox_\((?:node|\*this), \d+), \d+\)", r"\1)", _S)),
    Kind(
        "initial value of a member",
        _in_header(
            rf"int32_t (\w+)\{{\}};( *){_STATE}",
            r"int32_t \1{7};\2// rebsync: statevar \3",
            of_class=True,
        ),
    ),
    Kind(
        "initial truth of a member",
        _in_header(
            rf"bool (\w+)\{{\}};( *){_STATE}",
            r"bool \1{true};\2// rebsync: statevar \3",
            of_class=True,
        ),
    ),
    Kind(
        "member made a byte",
        _in_header(rf"int32_t (\w+)\{{\}};( *){_STATE}", r"int8_t \1{};\2// rebsync: statevar \3"),
    ),
    Kind(
        "array one longer",
        _in_header(
            rf"(array<\w+, )(\d)(> \w+\{{\}};.*){_STATE}", r"\g<1>1\2\3// rebsync: statevar \4"
        ),
    ),
    Kind("later by default", in_files(".h", r"(send\w+\([^;]*)When\(\)\);", r"\1after(1));")),
    Kind("topic of a subscription", within(r'(subscribe\w*\(")', r"\1other/", _S, strings=True)),
    Kind("subscription removed", within(r"^ *\w+_sub_ = [^\n]*\n", "", _S)),
    Kind("subscribed on another side", within(r"subscribeOnBridge\(", "subscribe(", _S)),
    Kind("another handler", within(r"&(\w+)::(receive\w+)", _other_handler, _S)),
    Kind(
        "topic of a publisher",
        within(r'(mailbox_\.advertise<[\w:]+>\(")', r"\1other/", _S, strings=True),
    ),
    Kind("publisher removed", within(r"^ *\w+_pubs?_ = mailbox_[^\n]*\n", "", _S)),
    Kind(
        "publishers of another class",
        within(r'(advertiseAll<[\w:]+>\(")\w+"', r'\1Other"', _S, strings=True),
    ),
    Kind(
        "another known rebec",
        within(
            r'param(?:eter)?<std::string>\("knownrebecs[/.](?P<k>\w+)"',
            _other_of(r'"knownrebecs[/.](\w+)"', "k"),
            _S,
            strings=True,
        ),
    ),
    Kind(
        "another parameter read",
        _other_parameter,
    ),
    Kind(
        "parameter not read",
        within(r"^ *\w+_ = (?:global\.param|node\.param|declare_parameter)[^;]*;\n", "", _S),
    ),
    Kind(
        "arguments of construct swapped", within(rf"(\bconstruct\(){_PAIR}(\))", _swapped_pair, _S)
    ),
    Kind("construct left out", within(r"^ *mailbox_\.construct\([^\n]*\n", "", _S)),
    Kind(
        "send while set up",
        at_end('  mailbox_.post(Server{"x", kNoPriority}, When(), "", [] {});\n', _S),
    ),
    Kind(
        "priority given", _servers(r'(constexpr Server \w+\{"\w+", )kNoPriority', r"\1priority(1)")
    ),
    Kind(
        "priority changed", _servers(r'(constexpr Server \w+\{"\w+", priority\()(\d)', r"\g<1>1\2")
    ),
    Kind(
        "priority taken",
        _servers(r'(constexpr Server \w+\{"\w+", )priority\(\d\)', r"\1kNoPriority"),
    ),
    Kind("field of a send left out", within(r"^ *msg\.\w+ = [^\n]*\n", "", "send")),
    Kind(
        "fields of a send swapped",
        within(r"^( *msg\.\w+ = )(\w+)(;\n *msg\.\w+ = )(\w+);", r"\1\4\3\2;", "send"),
    ),
    Kind("field of a send greater", within(r"^( *msg\.\w+ = )(\w+);", r"\1\2 + 1;", "send")),
    Kind("times left out", within(r"\bwhen\b", "When()", "send")),
    Kind("nothing published", within(r"^ *mailbox_\.(?:publish|post)\([^\n]*\n", "", "send")),
    Kind("published twice", within(r"^( *mailbox_\.(?:publish|post)\([^\n]*\n)", r"\1\1", "send")),
    Kind(
        "published only if",
        within(
            r"^( *)(mailbox_\.(?:publish|post)\([^\n]*\n)", r"\1if (mailbox_.now() > 3) \2", "send"
        ),
    ),
    Kind(
        "another publisher",
        within(
            r"publish\((?P<k>\w+_pub_)", _other_of(r"publish\((\w+_pub_)(?=, msg)", "k"), "send"
        ),
    ),
    Kind(
        "another server posted",
        within(r"post\((?P<k>k\w+)", _other_of(r"post\((k\w+)", "k"), "send"),
    ),
    Kind(
        "another server received",
        within(r"receive\((?P<k>k\w+)", _other_of(r"receive\((k\w+)", "k"), "receive"),
    ),
    Kind("another body posted", within(r"\{ (\w+)\(()\); \}", _other_body, "send")),
    Kind("another body received", within(r"\{ (\w+)\(()\); \}", _other_body, "receive")),
    Kind(
        "fields of a shim swapped",
        within(rf"(\b\w+\(){_PAIR}(\); \}}\);)", _swapped_pair, "receive"),
    ),
    Kind("message thrown away", at_start("  if (msg->timing.arrival > 3) return;\n", "receive")),
    Kind(
        "message received twice",
        within(r"^( *mailbox_\.receive\((?:[^;]*;){1,2}[^;\n]*;?\n)\Z", r"\1\1", "receive"),
    ),
    Kind("sender not told", within(r"(msg->timing, )msg->sender", r'\1""', "receive")),
    Kind("state changed where it is told", _published),
    Kind("macro for a time", in_files(".cpp", _AFTER, r"#define after deadline\n\1")),
    Kind("macro for a truth value", in_files(".cpp", _AFTER, r"#define false true\n\1")),
    Kind("macro in the header", in_files(".h", _CLASS, r"#define true false\n\n\1")),
    Kind("another int32_t", in_files(".cpp", _AFTER, r"\1\nusing int32_t = signed char;\n")),
    Kind(
        "function of the run-time part hidden",
        in_files(".cpp", _AFTER, r"\1\nint32_t divide(int32_t a, int32_t) { return a; }\n"),
    ),
    Kind("class of the run-time part hidden", in_files(".h", _CLASS, r"struct When {};\n\n\1")),
)
