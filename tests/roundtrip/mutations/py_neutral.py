"""Changes that leave what a system in Python does as it is."""

from __future__ import annotations

import io
import re
import shutil
import subprocess
import sys
import tokenize
from collections.abc import Callable, Iterator
from pathlib import Path

from tests.roundtrip.mutations.layout import swapped_lines
from tests.roundtrip.mutations.package import (
    BODIES,
    Edit,
    Kind,
    Maker,
    Mutant,
    Package,
    at_end,
    at_start,
    in_files,
    within,
)
from tests.roundtrip.mutations.py_surroundings import importing, in_program, programs

_STYLES = {
    "of 60 columns": ("--line-length=60",),
    "of 160 columns": ("--line-length=160",),
    "with single quotes": ("--config", "format.quote-style='single'"),
    "with tabs": ("--config", "format.indent-style='tab'"),
}


def _classes(package: Package) -> list[str]:
    """The sources of classes."""
    return sorted({part.path for part in package.parts})


def _ruff() -> str | None:
    """Where ruff is: beside this Python, or on the path."""
    beside = Path(sys.executable).with_name("ruff")
    return str(beside) if beside.exists() else shutil.which("ruff")


def _formatted(arguments: tuple[str, ...]) -> Maker:
    """A source as ruff (and, but for little, black) lays it out."""

    def make(package: Package) -> Iterator[Mutant]:
        ruff = _ruff()
        for path in _classes(package) if ruff is not None else ():
            done = subprocess.run(
                [str(ruff), "format", "--isolated", *arguments, "--stdin-filename", path, "-"],
                input=package.files[path],
                capture_output=True,
                text=True,
                check=True,
            )
            yield Mutant({path: done.stdout}, path)

    return make


def _rewritten(rewrite: Callable[[str], str]) -> Maker:
    """The sources of classes and the programs written anew, one after the other."""

    def make(package: Package) -> Iterator[Mutant]:
        for path in (*_classes(package), *programs(package)):
            yield Mutant({path: rewrite(package.files[path])}, path)

    return make


def _in_sources(pattern: str, text: str) -> Maker:
    """In the sources of classes, what strings and comments say included."""
    compiled = re.compile(pattern, re.MULTILINE)

    def make(package: Package) -> Iterator[Edit]:
        for path in _classes(package):
            for found in compiled.finditer(package.files[path]):
                yield Edit(path, *found.span(), found.expand(text).replace("NAME", package.name))

    return make


def _indented(text: str) -> str:
    """Twice as deep, but for what is inside of strings and brackets."""
    lines = text.splitlines(keepends=True)
    starts = {
        token.start[0]
        for token in tokenize.generate_tokens(io.StringIO(text).readline)
        if token.type not in (tokenize.NL, tokenize.COMMENT, tokenize.INDENT, tokenize.DEDENT)
    }
    own = re.compile(r"^( *)(?=\S)")
    return "".join(
        own.sub(r"\1\1", line) if number in starts or "#" in line else line
        for number, line in enumerate(lines, 1)
    )


def _renamed_local(package: Package) -> Iterator[list[Edit]]:
    """A local variable with another name."""
    for part in (p for p in package.parts if p.kind in (*BODIES, "send")):
        code = package.code(part.path, strings=False)
        found = re.findall(r"^ +(\w+)(?:: [^=\n]+)? = ", code[part.start : part.end], re.MULTILINE)
        for local in dict.fromkeys(found):
            uses = re.compile(rf"(?<![\w.]){local}\b(?!=)").finditer(code, part.start, part.end)
            yield [Edit(part.path, *use.span(), f"{local}_renamed") for use in uses]


def _renamed_parameter(package: Package) -> Iterator[list[Edit]]:
    """The message that a receiving function takes, with another name."""
    for part in (p for p in package.parts if p.kind == "receive"):
        code = package.code(part.path, strings=False)
        head = code.rindex("def ", 0, part.start)
        uses = re.compile(r"(?<![\w.])msg\b(?=[.:])").finditer(code, head, part.end)
        yield [Edit(part.path, *use.span(), "message") for use in uses]


def _constant(head: str, line: str, use: str) -> Maker:
    """A number in a body that gets a name, in a line after what begins as the head does."""

    def make(package: Package) -> Iterator[list[Edit]]:
        for part in (p for p in package.parts if p.kind in BODIES):
            code = package.code(part.path, strings=False)
            at = re.search(head, code, re.MULTILINE)
            assert at is not None
            for found in re.compile(r"(?<=[=<>+] )\d+\b").finditer(code, part.start, part.end):
                new = Edit(part.path, at.end(), at.end(), line.format(found[0]))
                yield [new, Edit(part.path, *found.span(), use)]

    return make


def _methods(text: str) -> list[tuple[int, int]]:
    """The extents of methods, with the comments before and the empty line after them."""
    pattern = (
        r"^(?:    [#@][^\n]*\n)*    def [^\n]*(?:\n {5,}[^\n]*|\n    \)[^\n]*|\n(?=\n* {5}))*\n\n?"
    )
    return [m.span() for m in re.finditer(pattern, text, re.MULTILINE)]


def _reordered_methods(package: Package) -> Iterator[Mutant]:
    """The methods of a class in the opposite order, what sets it up still first."""
    for path in _classes(package):
        text = package.files[path]
        spans = _methods(text)[1:]
        parts = [text[start:end].rstrip("\n") for start, end in reversed(spans)]
        new = text[: spans[0][0]] + "\n\n".join(parts) + "\n" + text[spans[-1][1] :]
        yield Mutant({path: new}, path)


def _in_base_class(package: Package) -> Iterator[Mutant]:
    """A method in a class of its own, in another module, that the reactive class extends."""
    for part in [p for p in package.parts if p.kind == "method"]:
        text = package.files[part.path]
        span = next((s for s in _methods(text) if s[0] <= part.start <= s[1]), None)
        if span is None:
            continue
        head = text[: text.index("\n_")]
        module = part.path.rpartition("/")[2].removesuffix(".py")
        other = part.path.replace(".py", "_more.py")
        rest = text[: span[0]] + text[span[1] :]
        rest = rest.replace(f"class {part.owner}:", f"class {part.owner}({part.owner}More):")
        line = f"from {package.name}.{module}_more import {part.owner}More\n"
        at = rest.index(f"from {package.name}.values")
        files: dict[str, str | None] = {
            part.path: rest[:at] + line + rest[at:],
            other: f"{head}\n\nclass {part.owner}More:\n{text[span[0] : span[1]]}".rstrip() + "\n",
        }
        yield Mutant(files, package.place(part.path, part.start))


def _helper(package: Package) -> Iterator[list[Edit]]:
    """A send in a method of its own."""
    send = re.compile(r"^( +)(self\.send_self_\w+\(\))$", re.MULTILINE)
    for part in (p for p in package.parts if p.kind in ("constructor", "msgsrv")):
        code = package.code(part.path)
        at = re.search(r"^    def _receive", code, re.MULTILINE)
        for found in send.finditer(code, part.start, part.end):
            if at is not None:
                text = f"    def _own(self) -> None:\n        {found[2]}\n\n"
                yield [
                    Edit(part.path, *found.span(), f"{found[1]}self._own()"),
                    Edit(part.path, at.start(), at.start(), text),
                ]


def _other_quotes(text: str) -> str:
    return re.sub(r'(?<!["\'])"([^"\'\n]*)"(?!")', r"'\1'", text)


def _no_hints(text: str) -> str:
    """Without what heads of methods and declarations say of types."""
    text = re.sub(r"^(    def .*?) -> [^\n]*?:$", r"\1:", text, flags=re.MULTILINE)
    text = re.sub(r"^( {8,}(?:self\.)?\w+): [^=\n(]+ = ", r"\1 = ", text, flags=re.MULTILINE)
    return re.sub(
        r"^(    def \w+\()(self, .*)(\):)$",
        lambda m: m[1] + re.sub(r": (?:[\w.]+(?:\[[^\]]*\])?)", "", m[2]) + m[3],
        text,
        flags=re.MULTILINE,
    )


def _some_hints(text: str) -> str:
    """The heads of methods without what they give."""
    return re.sub(r"^(    def .*?) -> None:$", r"\1:", text, flags=re.MULTILINE)


def _logged(package: Package) -> Iterator[Edit]:
    """What a body does, told with the state."""
    for part in (p for p in package.parts if p.kind in BODIES):
        for member in package.members_of(part.owner)[:1]:
            text = f'        print(f"now {{{member.name}}} of {{1}}")\n'
            yield Edit(part.path, part.start, part.start, text)


_STATEMENT = r"^( +)(self\.[^\n]*[)\w])$"

KINDS = (
    *(Kind(f"ruff format {name}", _formatted(style)) for name, style in _STYLES.items()),
    Kind("comment on a line", within(_STATEMENT, r"\1# So it is.\n\1\2", *BODIES)),
    Kind("comment after a statement", within(_STATEMENT, r"\1\2  # so it is; x = 1", *BODIES)),
    Kind("comment that mentions markers", within(_STATEMENT, r"\1# see rebsync in the docs\n\1\2")),
    Kind("comment not indented", within(_STATEMENT, r"# so it is\n\1\2")),
    Kind(
        "docstring of a class",
        _in_sources(r"^(class \w+(?:\(\w+\))?:\n)", r'\1    """What it is."""\n\n'),
    ),
    Kind("docstring of a method", at_start('        """What it does."""\n', *BODIES)),
    Kind("blank lines", within(_STATEMENT, r"\n\1\2\n", *BODIES)),
    Kind("indented deeper", _rewritten(_indented)),
    Kind("byte order mark", _rewritten(lambda t: t if t.startswith("#!") else f"\ufeff{t}")),
    Kind(
        "coding line",
        _rewritten(lambda t: t if t.startswith("#!") else f"# -*- coding: utf-8 -*-\n{t}"),
    ),
    Kind("single quotes", _rewritten(_other_quotes)),
    Kind("statement in parentheses", within(r" = ([^\n]+)$", r" = (\1)", *BODIES)),
    Kind("condition in parentheses", within(r"\b((?:el)?if) (.*):$", r"\1 (\2):")),
    Kind("result in parentheses", within(r"return ([^\n]+[^\n(])$", r"return (\1)")),
    Kind("comparison in parentheses", within(r"(?<=if )(\S+ (?:==|<|>) \S+)(?=:$)", r"(\1)")),
    Kind("continued line", within(r" = (?=[^\n]+$)", " = \\\\\n            ", *BODIES)),
    Kind("semicolon", within(r"^( *)(self\.[^\n]*[)\w])$(?!\n\1[ )])", r"\1\2;")),
    Kind(
        "two statements on a line",
        within(r"^( *)(self\._[^\n]*)\n\1(self\.send_\w+\(.*\))$", r"\1\2; \3"),
    ),
    Kind(
        "branch on one line",
        within(r"^( *if .*:)\n +(self\.[^\n]*)\n(?! {9,})", r"\1 \2\n"),
    ),
    Kind("pass", at_start("        pass\n", *BODIES)),
    Kind("pass in the end", at_end("        pass\n", "constructor", "msgsrv")),
    Kind("...", at_start("        ...\n", *BODIES)),
    Kind("hexadecimal number", within(r"(?<=[=<>+] )(10|8|15)\b", lambda p, q, m: hex(int(m[1])))),
    Kind(
        "elif taken apart",
        within(
            r"^( *)elif (.*:)\n((?:\1    [^\n]*\n)+)(?!\1(?:el|    ))",
            lambda p, q, m: (
                f"{m[1]}else:\n{m[1]}    if {m[2]}\n" + re.sub(r"(?m)^", "    ", m[3]).rstrip(" ")
            ),
        ),
    ),
    Kind("local renamed", _renamed_local),
    Kind("parameter of plumbing renamed", _renamed_parameter),
    Kind("constant extracted", _constant(r"^(?=_\w+ = Server)", "_OWN = {}\n", "_OWN")),
    Kind(
        "constant of the class",
        _constant(r"^class \w+(?:\(\w+\))?:\n", "    _OWN = {}\n\n", "self._OWN"),
    ),
    Kind("types of results left out", _rewritten(_some_hints)),
    Kind("no future import", _in_sources(r"^from __future__ import annotations\n\n", "")),
    Kind(
        "imports reordered", swapped_lines(r"from \w+\.(?!msg|values \()\w+ import [^(\n]*", ".py")
    ),
    Kind("another import", _in_sources(r"^(from typing .*\n)", r"import math\n\1")),
    Kind("import of a name twice", _in_sources(r"^(from typing .*\n)", r"\1\1")),
    Kind("__all__", _in_sources(r"^(_\w+ = Server.*\n)(?=\n)", r'\1\n__all__ = ["own"]\n')),
    Kind("methods reordered", _reordered_methods),
    Kind(
        "members reordered",
        swapped_lines(r"        self\.\w+: [^\n]* # rebsync: statevar [^\n]*", ".py"),
    ),
    Kind("subscriptions reordered", swapped_lines(r"        self\._\w+_sub = [^\n]*", ".py")),
    Kind(
        "publishers reordered",
        swapped_lines(r"        self\._\w+_pub = self\._mailbox[^\n]*", ".py"),
    ),
    Kind(
        "parameters read in another order",
        swapped_lines(r"        self\._\w+: int = [^\n]* # rebsync: env [^\n]*", ".py"),
    ),
    Kind("servers reordered", swapped_lines(r"_\w+ = Server\([^\n]*", ".py")),
    Kind(
        "fields in another order",
        within(r"^( *msg\.\w+ = \w+\n)( *msg\.\w+ = \w+\n)", r"\2\1", "send"),
    ),
    Kind("print", at_start('        print("here")\n', *BODIES)),
    Kind("print of a state variable", _logged),
    Kind("logging", importing("logging", 'logging.getLogger(__name__).info("at %d", 1)')),
    Kind("logged where received", at_start('        print("received", msg)\n', "receive")),
    Kind("logged where sent", at_start('        print("sent")\n', "send")),
    Kind("logged in set-up", at_end('        print("ready")\n', "setup")),
    Kind(
        "logged where the state is told",
        _in_sources(r"^( +)(self\._state_pub\.pub)", r'\1print("told")\n\1\2'),
    ),
    Kind(
        "unused helper",
        _in_sources(
            r"^((?:# rebsync: annotation.*\n)*# rebsync: reactiveclass)",
            r"def unused_helper(x: int) -> int:\n    return x + 1\n\n\n\1",
        ),
    ),
    Kind(
        "unused method",
        _in_sources(
            r"^(    def _publish_state)",
            r"    def unused_method(self) -> int:\n        return 1\n\n\1",
        ),
    ),
    Kind("unused constant", _in_sources(r"^(_\w+ = Server.*\n)(?=\n)", r"\1_UNUSED = 3\n")),
    Kind("object as base", _in_sources(r"^(class \w+)(:\n)", r"\1(object)\2")),
    Kind("object as another base", _in_sources(r"^(class \w+\(\w+)(\):\n)", r"\1, object\2")),
    Kind(
        "__repr__",
        _in_sources(
            r"^(    def _publish_state)",
            r'    def __repr__(self) -> str:\n        return "own"\n\n\1',
        ),
    ),
    Kind(
        "lambda for a method", within(r"(?<=, )(self\.\w+)\)$", r"lambda: \1())", "receive", "send")
    ),
    Kind(
        "user's own block",
        in_files(
            "_sensors.py", r"^(# rebsync: user .*\n)", r"\1# mine\nOWN = 2\n\n\n", comments=True
        ),
    ),
    Kind("arguments by name", within(r"\bWhen\(after=", "When(deadline=None, after=")),
    Kind("comment at the end", _rewritten(lambda t: t + "\n# end\n")),
    Kind("logged in the program", in_program(r"^( *)(rebec = )", r'\1print("up")\n\1\2')),
    Kind("comment in the set-up", in_files("setup.py", r"^(setup\()", r"# mine\n\1")),
    Kind(
        "comment in the run-time part",
        in_files("/mailbox.py", r"^(class Mailbox)", r"# the queue\n\1"),
    ),
)

ROSPY = (
    Kind("rospy.loginfo", at_start('        rospy.loginfo("here: %d", 1)\n', *BODIES)),
    Kind(
        "rospy.logwarn_throttle",
        at_start('        rospy.logwarn_throttle(1.0, f"at {1}")\n', *BODIES),
    ),
    Kind(
        "rospy imported otherwise", _in_sources(r"^import rospy\n", "import math\n\nimport rospy\n")
    ),
    Kind("rospy.logdebug in set-up", at_end('        rospy.logdebug("ready")\n', "setup")),
    Kind(
        "another shebang",
        lambda p: (
            Mutant({path: p.files[path].replace("env python3", "env python3.10", 1)}, path)
            for path in programs(p)
        ),
    ),
    Kind("comment in the build", in_files("CMakeLists.txt", r"^(catkin_python)", r"# so\n\1")),
    Kind("messages reordered", swapped_lines(r"  \w+\.msg", "CMakeLists.txt")),
    Kind("programs reordered", swapped_lines(r"    scripts/\w+", "CMakeLists.txt")),
)

RCLPY = (
    Kind(
        "logger of rclpy",
        importing("rclpy.logging", 'rclpy.logging.get_logger("own").info(f"at {1}")'),
    ),
    Kind("logger of the node", at_end('        self.get_logger().info("ready")\n', "setup")),
    Kind(
        "logger of the node kept",
        within(
            r"^( *)(?=self\._mailbox\.construct\()", r"\1self._log = self.get_logger()\n\1", "setup"
        ),
    ),
    Kind("entry points reordered", swapped_lines(r'            "\w+ = [^\n]*', "setup.py")),
    Kind("version in the set-up", in_files("setup.py", r'version=".*"', 'version="9.9.9"')),
    Kind("more in the set-up", in_files("setup.py", r"^( +)(zip_safe)", r'\1license="MIT",\n\1\2')),
    Kind(
        "main called", in_files("_node.py", r"\Z", '\n\nif __name__ == "__main__":\n    main()\n')
    ),
    Kind("messages reordered", swapped_lines(r"  \"msg/\w+\.msg\"", "CMakeLists.txt")),
    Kind("comment in the build", in_files("CMakeLists.txt", r"^(rosidl_gen)", r"# so\n\1")),
    Kind("another description", _in_sources(r'"constant of the model"', '"own"')),
)
