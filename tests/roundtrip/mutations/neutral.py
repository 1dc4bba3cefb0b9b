"""Changes that leave what a system does as it is."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable, Iterator

from tests.roundtrip.mutations.package import (
    BODIES,
    Edit,
    Kind,
    Maker,
    Mutant,
    Package,
    Part,
    at_end,
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

_MARKER = re.compile(r"[ \t]*(?://|#|<!--)\s*rebsync: (?!annotation|env|user|end)[^\n]*")


def _classes(package: Package) -> list[str]:
    """The sources of classes."""
    return sorted({part.path for part in package.parts})


def _rewritten(suffixes: tuple[str, ...], rewrite: Callable[[str], str]) -> Maker:
    """Whole files written anew, one after the other."""

    def make(package: Package) -> Iterator[Mutant]:
        for path, text in sorted(package.files.items()):
            if path.endswith(suffixes):
                yield Mutant({path: rewrite(text)}, path)

    return make


def _formatted(style: str) -> Maker:
    """A file as clang-format lays it out."""

    def make(package: Package) -> Iterator[Mutant]:
        if shutil.which("clang-format") is None:
            return
        for path, text in sorted(package.files.items()):
            if path.endswith((".h", ".cpp")):
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
            h for h in package.paths(".h") if f"class {part.owner} {{" in package.files[h]
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


def _swapped_lines(pattern: str, suffix: str) -> Maker:
    """Two lines that match, one after the other, in the other order."""
    lines = re.compile(rf"^({pattern}\n)({pattern}\n)", re.MULTILINE)

    def make(package: Package) -> Iterator[Edit]:
        for path in package.paths(suffix):
            for found in lines.finditer(package.files[path]):
                yield Edit(path, *found.span(), found[2] + found[1])

    return make


def _without_braces(package: Package, part: Part, found: re.Match[str]) -> str | None:
    return f"{found[1]}{found[2]}\n{found[3]}"


def _markers(package: Package) -> Iterator[Mutant]:
    """No marker at all, all over the package."""
    files: dict[str, str | None] = {
        path: _MARKER.sub("", text)
        for path, text in package.files.items()
        if path.endswith((".h", ".cpp", ".launch"))
    }
    yield Mutant(files, "everywhere")


def _one_marker(package: Package) -> Iterator[Edit]:
    for path in (*package.paths(".cpp"), *package.paths(".h")):
        for found in _MARKER.finditer(package.files[path]):
            yield Edit(path, *found.span(), "")


def _all_files(rewrite: Callable[[str], str]) -> Maker:
    """All texts of the package written anew at once."""

    def make(package: Package) -> Iterator[Mutant]:
        yield Mutant({path: rewrite(text) for path, text in package.files.items()}, "everywhere")

    return make


_SOURCES = (".h", ".cpp")
_STATEMENT = r"^( +)((?:this->)?\w[^\n{}]*;)$"

KINDS = (
    *(Kind(f"clang-format {name}", _formatted(style)) for name, style in _STYLES.items()),
    Kind("comment on a line", within(_STATEMENT, r"\1// So it is.\n\1\2")),
    Kind("comment after a statement", within(_STATEMENT, r"\1\2  // so it is; x = 1;")),
    Kind("comment in a statement", within(r" = (?=[^\n]*;$)", " = /* x = 2; */ ")),
    Kind(
        "comment that mentions markers", within(_STATEMENT, r"\1// see rebsync in the docs\n\1\2")
    ),
    Kind("blank lines", _rewritten(_SOURCES, lambda t: re.sub(r";\n", ";\n\n", t))),
    Kind(
        "tabs",
        _rewritten(
            _SOURCES, lambda t: re.sub(r"^ +", lambda m: "\t" * len(m[0]), t, flags=re.MULTILINE)
        ),
    ),
    Kind(
        "spaces at ends of lines",
        _rewritten(
            (".cpp", ".h", ".launch", ".yaml", ".txt", ".msg"), lambda t: t.replace("\n", "  \n")
        ),
    ),
    Kind("CRLF", _all_files(lambda t: t.replace("\n", "\r\n"))),
    Kind(
        "CRLF in one file",
        _rewritten(
            (".cpp", ".h", ".launch", ".yaml", ".txt", ".msg"), lambda t: t.replace("\n", "\r\n")
        ),
    ),
    Kind("byte order mark", _rewritten(_SOURCES, lambda t: f"\ufeff{t}")),
    Kind(
        "no newline at the end",
        _rewritten((".cpp", ".h", ".launch", ".yaml", ".txt", ".msg"), lambda t: t.rstrip("\n")),
    ),
    Kind("local renamed", _renamed_local),
    Kind("constant extracted", _constant),
    Kind("includes reordered", _swapped_lines(r"#include [<\"][^\n]*", ".h")),
    Kind("another include", in_files(".cpp", r"\A(#include .*\n)", r"\1#include <vector>\n")),
    Kind("pragma once", _rewritten((".h",), lambda t: f"#pragma once\n{t}")),
    Kind("functions reordered", _reordered_functions),
    Kind(
        "members reordered",
        _swapped_lines(r"  [\w:<>, ]+ \w+\{\};[ ]*// rebsync: statevar [^\n]*", ".h"),
    ),
    Kind("declarations reordered", _swapped_lines(r"  (?:void|bool|int32_t) \w+\([^\n]*\);", ".h")),
    Kind("subscriptions reordered", _swapped_lines(r"  \w+_sub_ = [^\n]*;", ".cpp")),
    Kind(
        "parameters read in another order", _swapped_lines(r"  \w+_ = global\.param[^\n]*;", ".cpp")
    ),
    Kind("ROS_INFO", at_start('  ROS_INFO("here: %d", 1);\n', *BODIES)),
    Kind("ROS_DEBUG_STREAM", at_start('  ROS_DEBUG_STREAM("at " << 1);\n', *BODIES)),
    Kind(
        "ROS_WARN in the end", at_end('  ROS_WARN_THROTTLE(1.0, "end");\n', "constructor", "msgsrv")
    ),
    Kind("std::cout", at_start('  std::cout << "here" << std::endl;\n', *BODIES)),
    Kind("logged where received", at_start('  ROS_INFO("received");\n', "receive")),
    Kind("logged where sent", at_start('  ROS_INFO("sent");\n', "send")),
    Kind("logged in set-up", at_end('  ROS_INFO("ready");\n', "setup")),
    Kind(
        "logged in the program",
        in_files("_node.cpp", r"^(  ros::AsyncSpinner)", r'  ROS_INFO("up");\n\1'),
    ),
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
        in_files(".cpp", r"^(// rebsync: msgsrv )", r"}\n\nnamespace NAME {\n\n\1"),
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
    Kind("markers removed", _markers),
    Kind("one marker removed", _one_marker),
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
        ),
    ),
    Kind(
        "user's block added",
        at_start(
            "  // rebsync: user Own\n  std::vector<int> seen;\n  // rebsync: end\n",
            "msgsrv",
        ),
    ),
    Kind(
        "comment in the launch file", in_files(".launch", r"^(  <node )", r"  <!-- a node -->\n\1")
    ),
    Kind(
        "attributes reordered",
        in_files(".launch", r'(<node) (name="\w+") (pkg="\w+")', r"\1 \3 \2"),
    ),
    Kind("log instead of the screen", in_files(".launch", r'output="screen"', 'output="log"')),
    Kind("single quotes", _rewritten((".launch",), lambda t: t.replace('"', "'"))),
    Kind("remaps reordered", _swapped_lines(r"    <remap [^\n]*", ".launch")),
    Kind("arguments reordered", _swapped_lines(r"    <param [^\n]*", ".launch")),
    Kind(
        "argument by an arg",
        in_files(
            ".launch",
            r'(<launch>\n)((?:.*\n)*?.*value=")(\d+)" type="int"',
            r'\1  <arg name="own" default="\3"/>\n\2$(arg own)" type="int"',
        ),
    ),
    Kind("comment in the parameters", in_files("params.yaml", r"^(\w+: \d+)$", r"\1  # so it is")),
    Kind("parameters reordered", _swapped_lines(r"\w+: \d+", "params.yaml")),
    Kind("slack", in_files("params.yaml", r"^(  slack: ).*$", r"\g<1>0.9")),
    Kind("seed", in_files("params.yaml", r"^(  seed: ).*$", r"\g<1>7")),
    Kind(
        "comment in the build", in_files("CMakeLists.txt", r"^(add_executable)", r"# a program\n\1")
    ),
    Kind("sources reordered", _swapped_lines(r"  src/\w+\.cpp", "CMakeLists.txt")),
    Kind("messages reordered", _swapped_lines(r"  \w+\.msg", "CMakeLists.txt")),
    Kind("another warning", in_files("CMakeLists.txt", r"-Wpedantic", "-Wpedantic -Wshadow")),
    Kind("comment in a message", in_files(".msg", r"\A", "# what is told\n")),
    Kind(
        "version of the package",
        in_files("package.xml", r"<version>.*</version>", "<version>9.9.9</version>"),
    ),
    Kind("README", in_files("README.md", r"\A", "Mine.\n")),
    Kind(
        "comment in the run-time part",
        in_files("mailbox.h", r"^(class Mailbox)", r"// the queue\n\1"),
    ),
    Kind(
        "new file",
        lambda package: iter([Mutant({"scripts/plot.py": "print(1)\n"}, "scripts/plot.py")]),
    ),
)
