"""What is done to the files of a package without changing what they say."""

from __future__ import annotations

import io
import re
import subprocess
import sys
import tokenize
from collections.abc import Callable, Iterable
from importlib.util import find_spec
from pathlib import Path
from shutil import which

STYLES = ("Google", "LLVM", "Mozilla", "WebKit", "Chromium", "GNU", "Microsoft")
WIDTHS = (60, 79, 120)
TOUCHED, SPREAD = "touched", "spread"
_BREAKABLE = re.compile(r'//[^\n]*|^ *#[^\n]*|"(?:\\.|[^"\\])*"|::', re.MULTILINE)


def forms() -> dict[str, Callable[[Path], None]]:
    """The forms by name, without those whose formatter is not installed."""
    found: dict[str, Callable[[Path], None]] = {
        TOUCHED: touched,
        "quotes": with_other_quotes,
        "crlf": with_crlf,
        SPREAD: spread,
    }
    if which("clang-format") is not None:
        for style in STYLES:
            found[style] = _of_cpp(style)
    for formatter in ("ruff", "black"):
        if find_spec(formatter) is not None:
            for width in WIDTHS:
                found[f"{formatter} {width}"] = _of_python(formatter, width)
    return found


def touched(root: Path) -> None:
    """A remark at the top and at the end of every file of code, and of launch files."""
    for path in cpp_of(root):
        _rewrite(path, lambda text: f"// A remark.\n{text}// Another.\n")
    for path in python_of(root):
        _rewrite(path, _remarked)
    for path in files_of(root):
        if path.suffix in (".msg", ".srv", ".yaml", ".cmake") or path.name == "CMakeLists.txt":
            _rewrite(path, lambda text: f"# A remark.\n{text}# Another.\n")
        elif path.suffix in (".launch", ".xml"):
            _rewrite(path, lambda text: f"{text}<!-- A remark. -->\n")


def _remarked(text: str) -> str:
    """Python with remarks; the line that says what runs a script stays the first."""
    first, rest = text.split("\n", 1) if text.startswith("#!") else ("", text)
    return f"{first}\n# A remark.\n{rest}# Another.\n".lstrip("\n")


def with_other_quotes(root: Path) -> None:
    """Strings of Python in the other quotes."""
    for path in python_of(root):
        _rewrite(path, other_quotes)


def with_crlf(root: Path) -> None:
    """The ends of lines of another system, and a blank line at the end."""
    for path in (*cpp_of(root), *python_of(root)):
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n") + b"\r\n")


def spread(root: Path) -> None:
    """Names and literals of C++ broken wherever a formatter with very short lines may do so."""
    for path in cpp_of(root):
        _rewrite(path, lambda text: _BREAKABLE.sub(lambda found: _broken(found[0]), text))


def _broken(text: str) -> str:
    if text == "::":
        return " ::\n    "
    if text.startswith('"') and len(text) > 3 and "\\" not in text:
        return f'{text[:2]}"\n    "{text[2:]}'
    return text


def other_quotes(text: str) -> str:
    """A text of Python whose strings have the other quotes, where these are in none of them."""
    lines = text.splitlines(keepends=True)
    for token in [*tokenize.generate_tokens(io.StringIO(text).readline)][::-1]:
        plain = token.string[1:-1]
        is_plain = token.string.startswith('"') and not set(plain) & set("'\"\\")
        if token.type == tokenize.STRING and is_plain:
            line, (row, start), (_, end) = lines[token.start[0] - 1], token.start, token.end
            lines[row - 1] = f"{line[:start]}'{plain}'{line[end:]}"
    return "".join(lines)


def _of_cpp(style: str) -> Callable[[Path], None]:
    command = ("clang-format", f"--style={style}", "-i")
    return lambda root: _run(command, cpp_of(root))


def _of_python(formatter: str, width: int) -> Callable[[Path], None]:
    length = f"--line-length={width}"
    options = ("format", "--quiet", "--isolated") if formatter == "ruff" else ("--quiet",)
    command = (sys.executable, "-m", formatter, *options, length)
    return lambda root: _run(command, python_of(root))


def _run(command: tuple[str, ...], paths: Iterable[Path]) -> None:
    names = [str(path) for path in paths]
    if names:
        subprocess.run((*command, *names), check=True)


def _rewrite(path: Path, change: Callable[[str], str]) -> None:
    path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")


def files_of(root: Path) -> list[Path]:
    """The files of the packages in a folder, without what is recorded of them."""
    packages = [p.parent for p in sorted(root.rglob("package.xml")) if ".rebsync" not in p.parts]
    found = (path for package in packages for path in sorted(package.rglob("*")))
    return [path for path in found if path.is_file() and ".rebsync" not in path.parts]


def cpp_of(root: Path) -> list[Path]:
    """The files of C++."""
    return [path for path in files_of(root) if path.suffix in (".h", ".hpp", ".cpp")]


def python_of(root: Path) -> list[Path]:
    """The files of Python, scripts without a suffix among them."""
    return [p for p in files_of(root) if p.suffix == ".py" or p.parent.name == "scripts"]
