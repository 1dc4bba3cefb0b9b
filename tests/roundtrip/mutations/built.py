"""Changes of what a package is built of: copies that no target compiles, files that are gone."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.roundtrip.mutations.package import Kind, Maker, Mutant, Package, at_start, within

_BEFORE = {True: "        self._mailbox.delay(1)\n", False: "  mailbox_.delay(1);\n"}
# Where people keep what was there before, beside a file or in a folder.
_KEPT = ("{folder}/backup/{name}", "{folder}/a_{name}", "{folder}/{stem}_old{suffix}", "old/{name}")


def _changed(package: Package) -> Iterator[Mutant]:
    yield from Kind("", at_start(_BEFORE[package.is_python], "msgsrv")).mutants(package)


def _copies(path: str) -> Iterator[str]:
    folder, _, name = path.rpartition("/")
    stem, _, suffix = name.rpartition(".")
    for form in _KEPT:
        yield form.format(folder=folder, name=name, stem=stem, suffix=f".{suffix}")


def _original_kept(package: Package) -> Iterator[Mutant]:
    for mutant in _changed(package):
        (path,) = mutant.files
        for copy in _copies(path):
            kept = {**mutant.files, copy: package.files[path]}
            yield Mutant(kept, mutant.place, mutant.elements)


def _changed_copy(package: Package) -> Iterator[Mutant]:
    for mutant in _changed(package):
        (path,) = mutant.files
        for copy in _copies(path):
            yield Mutant({copy: mutant.files[path]}, copy)


def _moved_away(package: Package) -> Iterator[Mutant]:
    """A method that is in a file which no target compiles."""
    for part in package.parts:
        found = re.search(rf"^// rebsync: msgsrv {part.element}\n", package.files[part.path], re.M)
        if part.kind != "msgsrv" or found is None:
            continue
        text = package.files[part.path]
        end = text.index("\n}\n", found.end()) + 3
        include = next(line for line in text.splitlines() if line.startswith("#include"))
        space = next(line for line in text.splitlines() if line.startswith("namespace "))
        moved = f"{include}\n\n{space}\n\n{text[found.start() : end]}\n}}\n"
        files = {part.path: text[: found.start()] + text[end:], "src/more.cpp": moved}
        yield Mutant(files, part.path, (part.element,))


def _header_kept(package: Package) -> Iterator[Mutant]:
    """A header with another value of a variable, and as it was by the same path elsewhere."""
    for path in package.paths(".h"):
        text = package.files[path]
        found = re.search(r"^  int32_t \w+_(?=(?: = \d+|\{\})?;)", text, re.M)
        if found is not None:
            changed = f"{found[0]} = 5;{text[text.index(';', found.end()) + 1 :]}"
            files = {path: text[: found.start()] + changed, f"a/{path}": text}
            yield Mutant(files, path)


def _gone(suffix: str) -> Maker:
    def make(package: Package) -> Iterator[Mutant]:
        for path in package.paths(suffix):
            yield Mutant({path: None}, path)

    return make


def _marker(package: Package) -> Iterator[Mutant]:
    for path in package.files:
        if "/resource/" in f"/{path}":
            yield Mutant({path: None}, path)


def _field_of_state(package: Package) -> Iterator[Mutant]:
    for path in package.paths("State.msg"):
        for found in re.finditer(r"^int32(?:\[\d*\])? (\w+)\n", package.files[path], re.M):
            text = package.files[path][: found.start()] + package.files[path][found.end() :]
            if any(f"msg.{found[1]}" in package.files[p] for p in package.sources):
                yield Mutant({path: text}, path)


def _asked(package: Package) -> Iterator[Mutant]:
    """A manifest or build file that does not ask for what code of it uses."""
    used = "geometry_msgs" if any("drive" in p for p in package.sources) else "diagnostic_msgs"
    for path in (*package.paths("package.xml"), *package.paths("CMakeLists.txt")):
        text = package.files[path]
        entry = rf"\n[^\n]*>{used}<[^\n]*|\nfind_package\({used}\b[^\n]*|\n  {used}(?=\n)"
        new = re.sub(entry, "", text, count=1)
        if new != text:
            yield Mutant({path: new}, path)


_AT = r"^( *)(\w+_\.at\((?!\d+\)).*)$"

ALL = (
    Kind("source kept as it was beside the changed one", _original_kept),
    Kind("interface gone", _gone(".msg")),
    Kind("field of a state gone", _field_of_state),
    Kind("package not asked for", _asked),
)
CPP = (
    Kind("method in a file that is not built", _moved_away),
    Kind("header kept by its path elsewhere", _header_kept),
    Kind(
        "sleep of the standard library for a delay",
        within(
            r"mailbox_\.delay\((.*)\);$",
            r"std::this_thread::sleep_for(std::chrono::seconds(\1));",
        ),
    ),
    Kind("index not tested", within(r"\.at\((cell\d)\)", r"[\1]")),
    Kind(
        "index out of range caught",
        within(_AT, r"\1try {\n\1  \2\n\1} catch (const std::out_of_range&) {\n\1}"),
    ),
)
RCLPY = (Kind("marker of the package gone", _marker),)
NEUTRAL = (Kind("changed copy that is not built", _changed_copy),)
