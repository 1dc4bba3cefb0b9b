"""Edits of a package's files: mutations, remarks, and what another model would have made."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import islice
from random import Random

from rebsync.config import Config
from rebsync.forward.generate import generate
from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.merge.text import merged_text
from rebsync.roundtrip.package.markers import user_blocks, with_user_blocks
from rebsync.source import Source
from rebsync.static import analyse
from tests.roundtrip.histories.laws import parts_of
from tests.roundtrip.histories.model_edits import BEHAVIOUR as MODEL_KINDS
from tests.roundtrip.histories.model_edits import edited_model
from tests.roundtrip.mutations.kinds import BEHAVIOUR, NEUTRAL
from tests.roundtrip.mutations.package import Kind, Package

Files = dict[str, str]
_LABELS = ("a", "b")
_SLOW = ("clang-format", "ruff format")
_MOST = 40  # places of a kind that are drawn from
_QUIET = {d: [k for k in kinds if not k.name.startswith(_SLOW)] for d, kinds in NEUTRAL.items()}


def edited_code(
    rng: Random, name: str, files: Files, text: str, dialect: str = "ros1-cpp"
) -> tuple[str, Files]:
    """The name of an edit, and the files with it; `text` is the model that they say."""
    match rng.choices(("model", "remark", "user", "neutral", "behaviour"), (50, 20, 5, 15, 10))[0]:
        case "model":
            kind, new = edited_model(rng, text, MODEL_KINDS)
            return f"code: {kind}", as_generated(name, files, text, new, dialect) or files
        case "remark":
            return "code: remark", _remark(rng, files)
        case "user":
            return "code: user's block", _user_block(rng, files)
        case "neutral":
            return _mutated(rng, name, files, _QUIET[dialect], dialect)
        case _:
            return _mutated(rng, name, files, BEHAVIOUR[dialect], dialect)


def as_generated(
    name: str, files: Files, old: str, new: str, dialect: str = "ros1-cpp"
) -> Files | None:
    """The files with what is generated otherwise for another model; None where that touches."""
    before, after = _generated(name, old, dialect), _generated(name, new, dialect)
    result = dict(files)
    for path in sorted({*before, *after}):
        if before.get(path) == after.get(path):
            continue
        theirs = after.get(path)
        if theirs is None:
            result.pop(path, None)
            continue
        ours = files.get(path, "")
        blocks = user_blocks(ours)
        base = with_user_blocks(before.get(path, ""), blocks)
        merged = merged_text(ours, base, with_user_blocks(theirs, blocks), _LABELS)
        if merged.conflicts:
            return None
        result[path] = merged.text
    return result


def _generated(name: str, text: str, dialect: str) -> Mapping[str, str]:
    parsed, config = parse_model(Source(f"{name}.rebeca", text)), Config(target=dialect)
    return generate(parsed.model, parsed.comments, analyse(parsed.model), config, name)


def _remark(rng: Random, files: Files) -> Files:
    """A comment after a statement, or on a line before one."""
    path = rng.choice([p for p in sorted(files) if p.endswith((".cpp", ".h", ".hpp", ".py"))])
    lines = files[path].split("\n")
    is_python = path.endswith(".py")
    end, sign = (")", "#") if is_python else (";", "//")
    fine = [i for i, line in enumerate(lines) if line.endswith(end) and line.startswith("  ")]
    if not fine:
        return files
    at = rng.choice(fine)
    mark = f"{sign} kept {rng.randrange(10**6)}"
    if rng.random() < 0.5:
        lines[at] = f"{lines[at]}  {mark}"
    else:
        lines.insert(at, f"  {mark}")
    return {**files, path: "\n".join(lines)}


def _user_block(rng: Random, files: Files) -> Files:
    """A line more in a block of the user's, odd as it may be."""
    found = [
        (path, match.end())
        for path, text in sorted(files.items())
        for match in re.finditer(r"^[^\n]*rebsync: user [^\n]*\n", text, re.MULTILINE)
    ]
    if not found:
        return files
    path, at = rng.choice(found)
    number = rng.randrange(10**6)
    own = f"// mine {number}   \n\tinline int own{number}() {{return 1;}}\n"
    if path.endswith(".py"):
        own = f"# mine {number}   \nOWN{number} = 1\n"
    return {**files, path: files[path][:at] + own + files[path][at:]}


def _mutated(
    rng: Random, name: str, files: Files, kinds: Sequence[Kind], dialect: str
) -> tuple[str, Files]:
    package = Package(name, dialect)
    package.files = dict(files)
    if not parts_of(package):
        return "code: nothing", files
    for kind in rng.sample(list(kinds), 8):
        mutants = list(islice(kind.mutants(package), _MOST))
        if mutants:
            mutant = rng.choice(mutants)
            new = {**files, **mutant.files}
            return f"code: {kind.name}", {p: t for p, t in new.items() if t is not None}
    return "code: nothing", files
