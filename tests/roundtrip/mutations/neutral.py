"""Changes that leave what a system does as it is."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator

from tests.roundtrip.mutations.layout import SOURCES, rewritten, swapped_lines
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

_STYLES = {
    "LLVM": "{BasedOnStyle: LLVM, ColumnLimit: 60}",
    "GNU": "{BasedOnStyle: GNU, PointerAlignment: Right}",
    "Mozilla": "{BasedOnStyle: Mozilla, ColumnLimit: 40}",
    "Google": "{BasedOnStyle: Google, IndentWidth: 4, ColumnLimit: 120}",
    "WebKit": "{BasedOnStyle: WebKit, BreakBeforeBraces: Allman}",
}


def _classes(package: Package) -> list[str]:
    """The sources of classes."""
    return sorted({part.path for part in package.parts})


def _formatted(style: str) -> Maker:
    """A file as clang-format lays it out."""

    def make(package: Package) -> Iterator[Mutant]:
        if shutil.which("clang-format") is None:
            return
        for path, text in sorted(package.files.items()):
            if path.endswith((".h", ".hpp", ".cpp")):
                done = subprocess.run(
                    ["clang-format", f"--style={style}", f"--assume-filename={path}"],
                    input=text,
                    capture_output=True,
                    text=True,
                    check=True,
                )
                yield Mutant({path: done.stdout}, path)

    return make


def _renamed_local(package: Package) -> Iterator[list[Edit]]:
    """A local variable with another name."""
    for part in package.parts:
        if part.kind not in BODIES:
            continue
        code = package.code(part.path, strings=False)
        for local in re.findall(r"^ +[\w:<>]+ (\w+) = ", code[part.start : part.end], re.MULTILINE):
            if local.endswith("_"):
                continue
            uses = re.compile(rf"(?<![\w.>]){local}\b").finditer(code, part.start, part.end)
            yield [Edit(part.path, *use.span(), f"{local}_renamed") for use in uses]


def _constant(package: Package) -> Iterator[list[Edit]]:
    """A number in a body that becomes a named constant."""
    for part in package.parts:
        if part.kind not in BODIES:
            continue
        code = package.code(part.path, strings=False)
        head = re.search(r"^constexpr Server", code, re.MULTILINE)
        for found in re.compile(r"(?<=[=<>+] )\d+\b").finditer(code, part.start, part.end):
            if head is not None:
                text = f"constexpr int32_t kOwn = {found[0]};\n"
                yield [
                    Edit(part.path, head.start(), head.start(), text),
                    Edit(part.path, *found.span(), "kOwn"),
                ]


def _functions(text: str) -> list[tuple[int, int]]:
    """The extents of functions with the comments before them, in a source of a class."""
    pattern = r"^(?://[^\n]*\n)*[A-Za-z][^\n;]*\w::\w+\([^;{]*?\{\n(?:[^}\n][^\n]*\n|\n)*\}\n"
    return [m.span() for m in re.finditer(pattern, text, re.MULTILINE)]


def _reordered_functions(package: Package) -> Iterator[Mutant]:
    """The functions of a source in the opposite order, the constructor still first."""
    for path in _classes(package):
        text = package.files[path]
        spans = _functions(text)[1:]
        if len(spans) > 1:
            parts = [text[start:end] for start, end in reversed(spans)]
            new = text[: spans[0][0]] + "\n".join(parts) + text[spans[-1][1] :]
            yield Mutant({path: new}, path)


def _split_file(package: Package) -> Iterator[Mutant]:
    """The last functions of a source that are the model's in a source of their own."""
    for part in [p for p in package.parts if p.kind in ("msgsrv", "method")]:
        text = package.files[part.path]
        span = next((s for s in _functions(text) if s[0] <= part.start <= s[1]), None)
        if span is None:
            continue
        include = text[: text.index("\n") + 1]
        other = part.path.replace(".cpp", "_more.cpp")
        body = text[span[0] : span[1]]
        cmake = package.files["CMakeLists.txt"].replace(
            f"  {part.path}\n", f"  {part.path}\n  {other}\n"
        )
        files: dict[str, str | None] = {
            part.path: text[: span[0]] + text[span[1] :],
            other: f"{include}\nnamespace {package.name} {{\n\n{body}\n}}\n",
            "CMakeLists.txt": cmake,
        }
        yield Mutant(files, package.place(part.path, part.start))


def _moved_file(package: Package) -> Iterator[Mutant]:
    """A source in another folder."""
    for path in _classes(package):
        other = path.replace("src/", "src/nodes/")
        cmake = package.files["CMakeLists.txt"].replace(f"  {path}\n", f"  {other}\n")
        yield Mutant({path: None, other: package.files[path], "CMakeLists.txt": cmake}, path)


def _in_header(package: Package) -> Iterator[Mutant]:
    """A method that is defined where it is declared."""
    for part in [p for p in package.parts if p.kind == "method"]:
        text = package.files[part.path]
        span = next((s for s in _functions(text) if s[0] <= part.start <= s[1]), None)
        header = next(
            h
            for h in package.paths(".h")
            if re.search(rf"class {part.owner} (?:: public [\w:]+ )?\{{", package.files[h])
        )
        head = text[: part.start].rstrip().rpartition("\n")[2].replace(f"{part.owner}::", "")
        declared = f"  {head.rstrip(' {')};\n"
        if span is None or declared not in package.files[header]:
            continue
        body = f"  // rebsync: method {part.element}\n  {head}\n{text[part.start : part.end]}  }}\n"
        files: dict[str, str | None] = {
            part.path: text[: span[0]] + text[span[1] :],
            header: package.files[header].replace(declared, body),
        }
        yield Mutant(files, package.place(part.path, part.start))


def _without_braces(package: Package, part: Part, found: re.Match[str]) -> str | None:
    return f"{found[1]}{found[2]}\n{found[3]}"


_STATEMENT = r"^( +)((?:this->)?\w[^\n{}]*;)$"

KINDS = (
    *(Kind(f"clang-format {name}", _formatted(style)) for name, style in _STYLES.items()),
    Kind("comment on a line", within(_STATEMENT, r"\1// So it is.\n\1\2")),
    Kind("comment after a statement", within(_STATEMENT, r"\1\2  // so it is; x = 1;")),
    Kind("comment in a statement", within(r" = (?=[^\n]*;$)", " = /* x = 2; */ ")),
    Kind(
        "comment that mentions markers", within(_STATEMENT, r"\1// see rebsync in the docs\n\1\2")
    ),
    Kind("blank lines", rewritten(SOURCES, lambda t: re.sub(r";\n", ";\n\n", t))),
    Kind(
        "tabs",
        rewritten(
            SOURCES, lambda t: re.sub(r"^ +", lambda m: "\t" * len(m[0]), t, flags=re.MULTILINE)
        ),
    ),
    Kind("byte order mark", rewritten(SOURCES, lambda t: f"\ufeff{t}")),
    Kind("local renamed", _renamed_local),
    Kind("constant extracted", _constant),
    Kind("includes reordered", swapped_lines(r"#include [<\"][^\n]*", ".h")),
    Kind("another include", in_files(".cpp", r"\A(\s*#include .*\n)", r"\1#include <vector>\n")),
    Kind("pragma once", rewritten((".h",), lambda t: f"#pragma once\n{t}")),
    Kind("functions reordered", _reordered_functions),
    Kind(
        "members reordered",
        swapped_lines(r"  [\w:<>, ]+ \w+\{\};[ ]*// rebsync: statevar [^\n]*", ".h"),
    ),
    Kind("declarations reordered", swapped_lines(r"  (?:void|bool|int32_t) \w+\([^\n]*\);", ".h")),
    Kind("subscriptions reordered", swapped_lines(r"  \w+_sub_ = [^\n]*;", ".cpp")),
    Kind("std::cout", at_start('  std::cout << "here" << std::endl;\n', *BODIES)),
    Kind(
        "without braces",
        within(
            r"^( *(?:if|for) \([^\n]*\)) \{(\n[^\n{}]*;)\n *\}\n( *)(?!else|\})", _without_braces
        ),
    ),
    Kind("brace on its own line", within(r"^( *)(if \(.*\)) \{$", r"\1\2\n\1{")),
    Kind("else on its own line", within(r"^( *)\} else", r"\1}\n\1else")),
    Kind(
        "else if in braces",
        within(r"^( *)\} else (if \(.*\) \{\n(?:\1  .*\n)+\1\})(?! else)", r"\1} else {\n\1\2 }"),
    ),
    Kind(
        "namespace reopened",
        in_files(".cpp", r"^(// rebsync: msgsrv )", r"}\n\nnamespace NAME {\n\n\1", comments=True),
    ),
    Kind(
        "unused helper",
        in_files(
            ".cpp",
            r"^(constexpr Server \w+\{.*\n)\n",
            r"\1\nint unusedHelper(int x) { return x + 1; }\n\n",
        ),
    ),
    Kind(
        "unused constant",
        in_files(".cpp", r"^(constexpr Server \w+\{.*\n)\n", r"\1constexpr int kUnused = 3;\n\n"),
    ),
    Kind(
        "unused member function",
        in_files(".h", r"^(  void publishState)", r"  int unusedMethod() const { return 1; }\n\1"),
    ),
    Kind(
        "static_assert",
        in_files(
            ".cpp",
            r"^(namespace \w+ \{\n\n)(?!\})",
            r'\1static_assert(sizeof(int) >= 4, "");\n\n',
        ),
    ),
    Kind("split file", _split_file),
    Kind("file in another folder", _moved_file),
    Kind("method in the header", _in_header),
    Kind("empty statement", at_start("  ;\n", "constructor", "msgsrv")),
    Kind("block", within(r"^( +)(send\w+\(.*\);)$", r"\1{\n\1  \2\n\1}")),
    Kind(
        "user's own block",
        in_files(
            "_sensors.h",
            r"^(// rebsync: user .*\n)",
            r"\1// mine\ninline int helper() { return 2; }\n",
            comments=True,
        ),
    ),
    Kind(
        "user's block added",
        at_start(
            "  // rebsync: user Own\n  std::vector<int> seen;\n  // rebsync: end\n",
            "msgsrv",
        ),
    ),
)
