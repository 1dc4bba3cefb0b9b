"""Random edits of generated packages: what is read with a memory is what is read without one.

python -m tests.roundtrip.incremental [--edits 400] [--seed 1] [EXAMPLE...]
"""

from __future__ import annotations

import argparse
import os
import random
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from rebsync import model as m
from rebsync.reverse.findings import Finding
from rebsync.reverse.generated.cpp_kept import ClassRead
from rebsync.reverse.recovery import Extracted, extract
from rebsync.roundtrip.package.cache.classes import ClassCache
from rebsync.source import NOWHERE, Source, SourceSpan, Span

EXAMPLES = Path(__file__).parent.parent.parent / "examples"
_EDITED = re.compile(r"(?:src/.*_?\.cpp|include/.*\.h|.*\.(?:launch|yaml|msg|txt))\Z")
_NUMBER = re.compile(r"\b\d+\b")
_WORD = re.compile(r"\b[a-z]\w+\b")
_LINES = ("// more", "int extra_ = 1;", "return;", "#define LIMIT 3", "if (true) {}", "/* open")


class Counting(ClassCache):
    """A memory that counts what it did not know."""

    def __init__(self) -> None:
        self.read = 0

    def keep(self, key: str, read: ClassRead, sources: Mapping[str, Source]) -> None:
        """Keeps and counts."""
        self.read += 1
        super().keep(key, read, sources)


def package(example: str) -> dict[str, Source]:
    """The files of an example's package."""
    root = EXAMPLES / example / example
    paths = (p for p in sorted(root.rglob("*")) if p.is_file() and ".rebsync" not in p.parts)
    names = (p.relative_to(root).as_posix() for p in paths)
    return {name: Source(name, (root / name).read_text(encoding="utf-8")) for name in names}


def edited(files: dict[str, Source], chance: random.Random) -> dict[str, Source]:
    """The files with a random edit of a line of one; some make no sense at all."""
    name = chance.choice([name for name in files if _EDITED.search(name)])
    lines = files[name].text.split("\n")
    at = chance.randrange(len(lines))
    match chance.randrange(6):
        case 0:
            lines.insert(at, chance.choice(_LINES))
        case 1:
            del lines[at]
        case 2:
            lines.insert(chance.randrange(len(lines)), lines[at])
        case 3:
            lines[at] = _NUMBER.sub(lambda found: str(int(found[0]) + 1), lines[at])
        case 4 if words := _WORD.findall("\n".join(lines)):
            old, new = chance.choice(words), chance.choice(words)
            lines[at] = lines[at].replace(old, new)
        case _:
            words = _WORD.findall(lines[at])
            other = chance.choice(words) if words else "x"
            lines = [line.replace(other, f"{other}_2") for line in lines]
    return {**files, name: Source(name, "\n".join(lines))}


def told(extracted: Extracted) -> list[object]:
    """All that was read, with the place of each node."""
    nodes = [(type(n).__name__, _place(getattr(n, "span", None))) for n in m.walk(extracted.model)]
    return [extracted.model, nodes, list(map(_found, extracted.findings)), extracted.statements]


def _found(finding: Finding) -> tuple[object, ...]:
    return finding, _place(finding.span), finding.source.text


def _place(span: Span | None) -> tuple[object, ...]:
    source = span.source if isinstance(span, SourceSpan) else None
    text = (source.path, source.text) if source is not None else ()
    return span, span is NOWHERE, *text


def differing(example: str, edits: int, seed: int) -> Iterator[str]:
    """The edits after which both do not say the same; `REBSYNC_CACHE` is where all is kept."""
    chance = random.Random(f"{example} {seed}")
    whole = files = package(example)
    memory = Counting()
    for number in range(edits):
        files = edited(files if chance.random() < 0.7 else whole, chance)
        if told(extract(files, memory=memory)) != told(extract(files)):
            changed = [name for name in files if files[name].text != whole[name].text]
            yield f"{example}, seed {seed}, edit {number}: {', '.join(changed)}"


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--edits", type=int, default=400, metavar="N")
    parser.add_argument("--seed", type=int, default=1, metavar="N")
    parser.add_argument("examples", nargs="*", default=["warehouse", "experiment2", "hello"])
    options = parser.parse_args()
    with TemporaryDirectory() as folder:
        os.environ["REBSYNC_CACHE"] = folder
        found = [d for e in options.examples for d in differing(e, options.edits, options.seed)]
    print(*found, f"{len(found)} of {options.edits * len(options.examples)} differ", sep="\n")
    raise SystemExit(bool(found))


if __name__ == "__main__":
    main()
