"""Changes that only spell what a class does in another way."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.roundtrip.mutations.package import (
    BODIES,
    Edit,
    Kind,
    Maker,
    Mutant,
    Package,
    Part,
    at_start,
    in_files,
    within,
)

_TYPE = r"(?:int32_t|bool|Rebec<\w+>)"
_DECLARED = rf"^( +{_TYPE} \w+) = ([^;\n{{}}]*);"
_LOCAL = r"^( +)(?:int32_t|bool|Rebec<\w+>) (\w+) = (\w+\()"
_HEAD = r"^(?P<head>(?P<type>[\w:<>, ]+) (?P<owner>\w+)::(?P<name>\w+)\((?P<args>[^;{]*)\)) \{$"


def _is_of_class(path: str, package: Package) -> bool:
    return any(part.path == path for part in package.parts)


def _headers(package: Package) -> list[str]:
    """The headers of classes."""
    return [p for p in package.paths(".h") if "// rebsync: reactiveclass" in package.files[p]]


def _in_headers(pattern: str, text: str) -> Maker:
    """In the headers of classes."""
    compiled = re.compile(pattern, re.MULTILINE)

    def make(package: Package) -> Iterator[Edit]:
        for path in _headers(package):
            for found in compiled.finditer(package.code(path)):
                yield Edit(path, *found.span(), found.expand(text))

    return make


def in_sources(pattern: str, text: str) -> Maker:
    """In the sources of classes; `NAME` is the package."""

    def make(package: Package) -> Iterator[Edit]:
        for made in in_files(".cpp", pattern, text)(package):
            if isinstance(made, Edit) and _is_of_class(made.path, package):
                yield made

    return make


def _both(declared: str, defined: str, *kinds: str) -> Maker:
    """A change of the head of a function where it is declared, and where it is defined.

    In both texts `{type}`, `{name}` and `{args}` are those of the function, `{owner}` its class.
    """

    def make(package: Package) -> Iterator[list[Edit]]:
        for part in (p for p in package.parts if p.kind in kinds):
            found = _head(package, part)
            header = _header(package, part.owner)
            body = package.files[part.path][part.start : part.end]
            if found is None or header is None or ("noexcept" in declared and _throws(body)):
                continue
            names = {k: found[k] for k in ("type", "name", "args", "owner")}
            pattern = rf"^  {re.escape(found['type'])} {found['name']}\(([^;]*)\);$"
            own = re.search(pattern, package.files[header], re.MULTILINE)
            if own is not None:
                text = f"  {declared.format(**{**names, 'args': own[1]})};"
                yield [
                    Edit(part.path, *found.span(), f"{defined.format(**names)} {{"),
                    Edit(header, *own.span(), text),
                ]

    return make


def _throws(body: str) -> bool:
    """Whether an exception may leave a body: an index or a stop during a delay has one."""
    return re.search(r"\.at\(\D|\bdelay\(|\bmove\(", body) is not None


def _head(package: Package, part: Part) -> re.Match[str] | None:
    """The head of a function that is defined in one line."""
    last = package.files[part.path].rfind("\n", 0, part.start - 1)
    return re.compile(_HEAD, re.MULTILINE).match(package.files[part.path], last + 1, part.start)


def _header(package: Package, owner: str) -> str | None:
    of_class = (h for h in _headers(package) if f"class {owner} " in package.files[h])
    return next(of_class, None)


def _parameters(pattern: str, text: str, *kinds: str) -> Maker:
    """The parameters of functions where they are defined, written otherwise."""

    def make(package: Package) -> Iterator[Edit]:
        for part in (p for p in package.parts if p.kind in kinds):
            found = _head(package, part)
            for own in re.finditer(pattern, found["args"]) if found is not None else ():
                start = found.start("args") if found is not None else 0
                yield Edit(part.path, start + own.start(), start + own.end(), own.expand(text))

    return make


def _renamed_parameter(package: Package) -> Iterator[list[Edit]]:
    """A parameter of a function that sends or receives, with another name."""
    for part in (p for p in package.parts if p.kind in ("send", "receive")):
        found = _head(package, part)
        for own in re.finditer(r"(\w+)(?=,|$)", found["args"]) if found is not None else ():
            code = package.code(part.path, strings=False)
            uses = re.compile(rf"(?<![\w.>]){own[1]}\b").finditer(code, part.start, part.end)
            start = found.start("args") if found is not None else 0
            first = Edit(part.path, start + own.start(), start + own.end(), f"own_{own[1]}")
            yield [first, *(Edit(part.path, *use.span(), f"own_{own[1]}") for use in uses)]


def _alias(package: Package) -> Iterator[list[Edit]]:
    """An alias for the type of a state variable."""
    for path in _headers(package):
        text = package.files[path]
        head = re.search(r"^// rebsync: (?:annotation|reactiveclass)", text, re.MULTILINE)
        for found in re.finditer(r"^  (int32_t|bool)(?= \w+_\{\};)", text, re.MULTILINE):
            if head is not None:
                yield [
                    Edit(path, head.start(), head.start(), f"using Own = {found[1]};\n\n"),
                    Edit(path, *found.span(), "  Own"),
                ]


def _no_guard(package: Package) -> Iterator[Mutant]:
    """`#pragma once` in place of the guard of a header."""
    for path in _headers(package):
        text = re.sub(
            r"^#ifndef .*\n#define .*\n", "#pragma once\n", package.files[path], flags=re.M
        )
        yield Mutant({path: re.sub(r"\n#endif.*\n", "", text)}, path)


def _declared_later(package: Package) -> Iterator[Mutant]:
    """The declarations of other classes, each in a namespace of its own."""
    for path in _headers(package):
        text = package.files[path]
        found = re.search(r"^((?:class \w+;\n)+)\n", text, re.MULTILINE)
        if found is not None:
            rest = text[: found.start()] + text[found.end() :]
            new = f"namespace {package.name} {{\n{found[1]}}}\n\nnamespace {package.name} {{\n"
            yield Mutant({path: rest.replace(f"namespace {package.name} {{\n", new, 1)}, path)


def _stored_in_another_order(package: Package, part: Part, found: re.Match[str]) -> str:
    return found[2] + found[1]


_FIELD = r"((?:^ *(?:msg\.\w+ = \w+|flatten\(\w+, msg\.\w+\));\n))"

KINDS = (
    Kind("auto", within(_LOCAL, r"\1auto \2 = \3")),
    Kind("const local", within(r"^( +)(Rebec<\w+> \w+ = )", r"\1const \2")),
    Kind("parentheses in a condition", within(r"\bif \((.*)\) \{$", r"if ((\1)) {")),
    Kind(
        "parentheses in a comparison", within(r"(?<=[( ])(\w+_? (?:==|<|>) \w+)(?=[ )])", r"(\1)")
    ),
    Kind("parentheses in an assignment", within(r" = ([^\n;]+);$", r" = (\1);")),
    Kind("parentheses in a result", within(r"return ([^\n;{}]+);", r"return (\1);")),
    Kind(
        "cast to the same type",
        within(
            r"(int32_t \w+ = |cell_ = |steps_ = |x_ = )([^\n;]+);", r"\1static_cast<int32_t>(\2);"
        ),
    ),
    Kind("this-> written", within(r"(?<![\w.>])(\w+_)(?= = )", r"this->\1")),
    Kind("this-> left out", within(r"this->", "")),
    Kind("this-> before a call", within(r"^( +)(send\w+\()", r"\1this->\2")),
    Kind(
        "class before a member",
        within(r"^( +)(send\w+\()", lambda p, q, m: f"{m[1]}{q.owner}::{m[2]}"),
    ),
    Kind("++ before", within(r"(\w+)\+\+\)", r"++\1)")),
    Kind("alternative tokens", within(r" && ", " and ")),
    Kind("not for !", within(r"(?<=[( ])!(?=[\w(])", "not ")),
    Kind("hexadecimal number", within(r"(?<=[=<>+] )(10|8|15)\b", lambda p, q, m: hex(int(m[1])))),
    Kind(
        "std:: before a type", in_files(".h", r"(?<![\w:])int32_t (\w+_\{\};)", r"std::int32_t \1")
    ),
    Kind("int for int32_t", in_files(".h", r"(?<![\w:])int32_t (\w+_\{\};)", r"int \1")),
    Kind(
        "value instead of {}", in_files(".h", r"(?<![\w:])int32_t (\w+_)\{\};", r"int32_t \1{0};")
    ),
    Kind(
        "attribute of a local",
        within(rf"^( +)({_TYPE} \w+ = )", r"\1[[gnu::unused]] \2"),
    ),
    Kind(
        "attribute of a function", _in_headers(r"^(  )(void \w+\([^)]*\);)$", r"\1[[gnu::hot]] \2")
    ),
    Kind("macro of one's own", in_sources(r"^(namespace \{\n)", r"#define OWN 3\n\1")),
    Kind(
        "unused said of a parameter",
        _parameters(r"int32_t \w+", r"[[gnu::unused]] \g<0>", "msgsrv"),
    ),
    Kind(
        "noexcept",
        _both(
            "{type} {name}({args}) noexcept", "{type} {owner}::{name}({args}) noexcept", "msgsrv"
        ),
    ),
    Kind(
        "const method",
        _both("{type} {name}({args}) const", "{type} {owner}::{name}({args}) const", "method"),
    ),
    Kind(
        "trailing return type",
        _both(
            "auto {name}({args}) -> {type}",
            "auto {owner}::{name}({args}) -> {type}",
            *BODIES,
            "receive",
        ),
    ),
    Kind(
        "const parameter", _parameters(r"(?<!const )(int32_t|bool) (?=\w+)", r"const \1 ", *BODIES)
    ),
    Kind("east const parameter", _parameters(r"const (\w+)& ", r"\1 const& ", "send")),
    Kind("east const message", _parameters(r"const ([\w:]+)& ", r"\1 const& ", "receive")),
    Kind("std:: in a parameter", _parameters(r"(?<![\w:])int32_t ", "std::int32_t ", *BODIES)),
    Kind("std:: in a body", within(r"(?<![\w:])int32_t ", "std::int32_t ")),
    Kind(
        "brackets of a local",
        within(_DECLARED, r"\1{\2};"),
    ),
    Kind(
        "parentheses of a local",
        within(_DECLARED, r"\1(\2);"),
    ),
    Kind(
        "using declaration",
        in_sources(r"^(namespace NAME \{\n)".replace("NAME", r"\w+"), r"\1\nusing std::int32_t;\n"),
    ),
    Kind("using in a body", at_start("  using std::int32_t;\n", *BODIES)),
    Kind("alias in a body", at_start("  using Own = int;\n", *BODIES)),
    Kind("static_assert in a body", at_start('  static_assert(sizeof(int) >= 4, "");\n', *BODIES)),
    Kind("alias of a type", _alias),
    Kind(
        "another include of a source",
        in_sources(r'\A(\s*#include ".*\n)', r"\1\n#include <iostream>\n"),
    ),
    Kind("guard made a pragma", _no_guard),
    Kind("classes declared apart", _declared_later),
    Kind(
        "forward declaration",
        _in_headers(r"^(namespace \w+ \{\n)$", r"\1\nclass Other;\nstruct Another;\n"),
    ),
    Kind(
        "comment before a class",
        _in_headers(r"^(class \w+ (?:final )?(?:: public [\w:]+ )?\{)$", r"\1\n  // What it is.\n"),
    ),
    Kind("final class", _in_headers(r"^(class \w+) (?=(?:: public [\w:]+ )?\{$)", r"\1 final ")),
    Kind("friend", _in_headers(r"^( private:\n)", r"\1  friend class Test;\n")),
    Kind(
        "copies deleted",
        _in_headers(
            r"^( public:\n)(  (?:explicit )?(\w+)\()",
            r"\1  \3(const \3&) = delete;\n\3& operator=(const \3&) = delete;\n\2",
        ),
    ),
    Kind("destructor", _in_headers(r"^( public:\n)(  (\w+)\()", r"\1  ~\3() = default;\n\2")),
    Kind("type in the class", _in_headers(r"^( private:\n)", r"\1  using Own = std::int32_t;\n")),
    Kind(
        "constant in the class",
        _in_headers(r"^( private:\n)", r"\1  static constexpr int kOwn = 3;\n"),
    ),
    Kind("sections of the class", _in_headers(r"^  (Mailbox mailbox_;)$", r" private:\n  \1")),
    Kind("members public", _in_headers(r"^ private:$", " public:")),
    Kind("= 0 for {}", _in_headers(r"(int32_t \w+_)\{\};", r"\1 = 0;")),
    Kind("= false for {}", _in_headers(r"(bool \w+_)\{\};", r"\1 = false;")),
    Kind(
        "this-> before the mailbox",
        within(r"(?<![\w.>])mailbox_\.", "this->mailbox_.", *BODIES, "setup", "receive", "send"),
    ),
    Kind("this-> before a publisher", within(r"publish\((?=\w+_pub_)", "publish(this->", "send")),
    Kind(
        "this-> where set up",
        within(r"^  (?=\w+_ = (?:global|node|mailbox_|declare_|create_))", "  this->", "setup"),
    ),
    Kind("captures by name", within(r"\[this(?:, msg)?\] \{", "[=] {", "receive")),
    Kind("lambda with parameters", within(r"\[this(, msg)?\] \{", r"[this\1]() {", "receive")),
    Kind("message in braces", within(r"^( *[\w:]+ msg);", r"\1{};", "send")),
    Kind("fields in another order", within(_FIELD + _FIELD, _stored_in_another_order, "send")),
    Kind("parameter of plumbing renamed", _renamed_parameter),
    Kind(
        "receiver on more lines",
        within(r"mailbox_\.receive\((\w+), ", r"mailbox_.receive(\n      \1,\n      ", "receive"),
    ),
    Kind("nothing said of the message", at_start("  static_cast<void>(msg);\n", "receive")),
    Kind("std::cerr", at_start('  std::cerr << "here" << 1 << std::endl;\n', *BODIES)),
    Kind("printf", at_start('  printf("here\\n");\n', *BODIES)),
)
