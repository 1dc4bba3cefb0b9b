"""Changes of how nodes in Python are set up and joined: members, topics, handlers, messages."""

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
    anywhere,
    at_end,
    at_start,
    within,
)
from tests.roundtrip.mutations.surroundings import constants

_S = "setup"
_MARK = r"( *# rebsync: statevar (\S+))$"


def _in_setup(pattern: str, text: Texts) -> Maker:
    return within(pattern, text, _S, strings=True)


def _state(pattern: str, text: str, *, of_class: bool = False) -> Maker:
    """In the declaration of a state variable, whose path is the last group.

    `of_class`: the model has it in the constructor.
    """
    compiled = re.compile(pattern + _MARK, re.MULTILINE)

    def make(package: Package) -> Iterator[Edit]:
        for path in package.sources:
            for found in compiled.finditer(package.files[path]):
                element = found[found.re.groups]
                element = element.partition(".")[0] if of_class else element
                mark = found[found.re.groups - 1]
                yield Edit(path, *found.span(), f"{found.expand(text)}{mark}", element)

    return make


def _in_sources(pattern: str, text: str) -> Maker:
    """In the sources of classes, what strings and comments say included."""
    compiled = re.compile(pattern, re.MULTILINE)

    def make(package: Package) -> Iterator[Edit]:
        for path in package.sources:
            if path in package.owners:
                for found in compiled.finditer(package.files[path]):
                    yield Edit(path, *found.span(), found.expand(text), package.owners[path])

    return make


def _other_handler(package: Package, part: Part, found: re.Match[str]) -> str | None:
    own = [p for p in package.parts if p.kind == "receive" and p.owner == part.owner]
    others = [n for n in (p.element.partition(".")[2] for p in own) if n != found[1]]
    return f"self.{others[0]}" if others else None


def _other_body(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """Another server of the class that takes no arguments either, in a shim."""
    every = [p for p in package.parts if p.kind == "msgsrv" and p.owner == part.owner]
    heads = [(p, package.files[p.path][: p.start].rstrip().rpartition("\n")[2]) for p in every]
    names = sorted(p.element.partition(".")[2] for p, head in heads if "(self)" in head)
    others = [name for name in names if name != found[1]]
    return f"self.{others[0]})" if found[1] in names and others else None


def _other_of(pattern: str, name: str) -> Texts:
    """Another text of the same file that matches a pattern."""

    def text(package: Package, part: Part, found: re.Match[str]) -> str | None:
        every = re.findall(pattern, package.files[part.path])
        others = [each for each in every if each != found[name]]
        whole, start = found[0], found.start(name) - found.start()
        return whole[:start] + others[0] + whole[start + len(found[name]) :] if others else None

    return text


def _other_parameter(package: Package) -> Iterator[Mutant]:
    """A parameter of the model that has another value, in place of each that is read."""
    values = {found[2]: found[3] for _, found in constants(package)}
    read = re.compile(r'(?<=get_param\(")\w+|(?<=declared\(self, "env\.)\w+')
    for part in (p for p in package.parts if p.kind == _S):
        text = package.files[part.path]
        for m in read.finditer(text, part.start, part.end):
            other = next((n for n in values if values[n] != values.get(m[0])), None)
            if other is not None and m[0] in values:
                made = package.mutant(Edit(part.path, *m.span(), other))
                yield Mutant(made.files, made.place, (part.owner, m[0], other))


def _one_more(step: int) -> Texts:
    return lambda package, part, found: f"{found[1]}{int(found[2]) + step}"


_MAILBOX = r"(= Mailbox\((?:self, )?)(\d+)"
_CALL = r"[^\n(]*\((?:[^()]|\([^()]*\))*\)\n"
_PUBLISH = r"^( *)(self\._mailbox\.(?:publish|post)\([^\n]*\n)"
_FIELD = r"^( *msg\.(?!sender)\w+ = )(\w+)$"
_CONSTANT = r"^( *self\._\w+: int = )(?:rospy\.get_param|declared)\([^\n]*?\)(  #)"

KINDS = (
    Kind("queue one longer", within(_MAILBOX, _one_more(1), _S)),
    Kind("queue one shorter", within(_MAILBOX, _one_more(-1), _S)),
    Kind("best priority left out", within(_MAILBOX + r", \d+\)", r"\1\2)", _S)),
    Kind("initial value of a member", _state(r"(: int = )0\b", r"\g<1>7", of_class=True)),
    Kind("initial truth of a member", _state(r"(: bool = )False\b", r"\1True", of_class=True)),
    Kind("array one longer", _state(r"(= array\(\w+, )(\d+)\)", r"\g<1>1\2)")),
    Kind("later by default", _in_sources(r"(def send_.*)= AT_ONCE", r"\1= When(after=1)")),
    Kind("deadline by default", _in_sources(r"(def send_.*)= AT_ONCE", r"\1= When(0, 3)")),
    Kind("topic of a subscription", _in_setup(r'(subscribe\w*\("(?:~/?)?)', r"\1other/")),
    Kind("subscription removed", _in_setup(rf"^ *self\._\w+_sub = {_CALL}", "")),
    Kind("subscribed on another side", _in_setup(r"subscribe_on_bridge\(", "subscribe(")),
    Kind("another handler", _in_setup(r"self\.(_receive_\w+)", _other_handler)),
    Kind("topic of a publisher", _in_setup(r'(_mailbox\.advertise\("~/?)', r"\1other/")),
    Kind("publisher removed", _in_setup(rf"^ *self\._\w+_pubs? = self\._mailbox{_CALL}", "")),
    Kind("publishers of another class", _in_setup(r'(advertise_all\("\w+)"', r'\1Other"')),
    Kind(
        "another known rebec",
        _in_setup(
            r'\(.*"~?knownrebecs[/.](?P<k>\w+)"', _other_of(r'"~?knownrebecs[/.](\w+)"', "k")
        ),
    ),
    Kind("another parameter read", _other_parameter),
    Kind("parameter not read", _in_sources(_CONSTANT, r"\g<1>3\2")),
    Kind("parameter by another key", _in_setup(r'(: int = .*"(?:env\.)?\w+)"', r'\1_b"')),
    Kind(
        "arguments of construct swapped",
        within(r"(\bconstruct\()(\w+), (\w+)", r"\1\3, \2", _S),
    ),
    Kind(
        "construct left out",
        within(r"^( *)self\._mailbox\.construct\((?:\n(?:\1 +[^\n]*\n)*\1\)|[^\n]+)\n", "", _S),
    ),
    Kind(
        "construct called at once",
        within(r"self\._mailbox\.construct\(\s*lambda: (.*\))\s*\)$", r"\1", _S),
    ),
    Kind(
        "send while set up",
        at_end('        self._mailbox.post(Server("x"), When(), "", lambda: None)\n', _S),
    ),
    Kind("priority given", _in_sources(r'^(_\w+ = Server\("\w+")\)', r"\1, priority(1))")),
    Kind("priority changed", _in_sources(r"^(_\w+ = Server\(.*priority\()(\d)", r"\g<1>1\2")),
    Kind("priority taken", _in_sources(r"^(_\w+ = Server\(.*), \w*priority\(\d+\)\)", r"\1)")),
    Kind("server of another name", _in_sources(r'^(_\w+ = Server\("\w+)"', r'\1_b"')),
    Kind("field of a send left out", within(r"^ *msg\.\w+ = [^\n]*\n", "", "send")),
    Kind(
        "fields of a send swapped",
        within(r"^( *msg\.\w+ = )(\w+)(\n *msg\.\w+ = )(\w+)$", r"\1\4\3\2", "send"),
    ),
    Kind("field of a send greater", within(_FIELD, r"\1\2 + 1", "send")),
    Kind("times left out", within(r"\bwhen\b", "AT_ONCE", "send")),
    Kind("nothing published", within(_PUBLISH, r"\1pass\n", "send")),
    Kind("published twice", within(_PUBLISH, r"\g<0>\g<0>", "send")),
    Kind(
        "published only if",
        within(_PUBLISH, r"\1if self._mailbox.now() > 3:\n\1    \2", "send"),
    ),
    Kind(
        "another publisher",
        within(
            r"publish\(self\.(?P<k>\w+_pub)",
            _other_of(r"publish\(self\.(\w+_pub)(?=, msg)", "k"),
            "send",
        ),
    ),
    Kind(
        "another server posted",
        within(r"post\((?P<k>_[A-Z]\w+)", _other_of(r"post\((_[A-Z]\w+)", "k"), "send"),
    ),
    Kind(
        "another server received",
        within(r"receive\((?P<k>_[A-Z]\w+)", _other_of(r"receive\((_[A-Z]\w+)", "k"), "receive"),
    ),
    Kind("another body posted", within(r"self\.(\w+)\)$", _other_body, "send")),
    Kind("another body received", within(r"self\.(\w+)\)$", _other_body, "receive")),
    Kind(
        "fields of a shim swapped",
        within(r"(lambda: self\.\w+\()(msg\.\w+), (msg\.\w+)", r"\1\3, \2", "receive"),
    ),
    Kind(
        "message thrown away",
        at_start("        if msg.timing.arrival > 3:\n            return\n", "receive"),
    ),
    Kind(
        "message received twice",
        within(r"(?s)^( *self\._mailbox\.receive\(.*)\Z", r"\1\1", "receive"),
    ),
    Kind("sender not told", within(r"(msg\.timing, )msg\.sender", r'\1""', "receive")),
    Kind(
        "state changed where it is told",
        _in_sources(r"^(        )msg\.\w+ = (self\._\w+)\n(?=.*\n)", r"\g<0>\1\2 = 0\n"),
    ),
    Kind("another int32", _in_sources(r"^(_\w+ = Server)", r"int32 = int\n\1")),
    Kind("another int", _in_sources(r"^(class \w+(?:\(\w+\))?:\n)", r"int = float\n\n\n\1")),
    Kind(
        "function of the run-time part hidden",
        _in_sources(
            r"(?s)(\bint32\b.*?\n_\w+ = Server[^\n]*\n)\n\n",
            r"\1\n\ndef int32(value: int) -> int:\n    return value\n\n\n",
        ),
    ),
    Kind(
        "class of the run-time part hidden",
        anywhere(_in_sources(r"^(class \w+(?:\(\w+\))?:\n)", r"class When:\n    pass\n\n\n\1")),
    ),
    Kind("imported from elsewhere", _in_sources(r"^from \w+\.values import", "from own import")),
    Kind(
        "imported by another name", _in_sources(r"^(from \w+\.values import .*)\bAT_ONCE, ", r"\1")
    ),
    Kind("method decorated", _in_sources(r"^(    # rebsync: msgsrv .*\n)", r"\1    @own\n")),
    Kind("another mailbox", _in_sources(r"return self\._mailbox$", "return Mailbox(3)")),
    Kind(
        "method replaced afterwards",
        _in_sources(r"\Z", "\n\nMailbox.post = None\n"),
    ),
)
