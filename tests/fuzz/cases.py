"""Inputs by number: the files of a folder, and the commands that are run in it."""

from __future__ import annotations

import io
import json
import os
import subprocess
from collections.abc import Callable, Iterator, Sequence
from contextlib import redirect_stderr
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

from tests.fuzz.grammar import derive
from tests.fuzz.mutations import NUMBERS, WORDS, mutate

ROOT = Path(__file__).parent.parent.parent
CORPUS = Path(__file__).parent / "corpus"
_SEEDS = ("tests/**/*", "examples/**/*")
_LARGEST = 8_000  # bytes of a seed: what is small is tried more often
_DIALECTS = ("ros1-cpp", "ros1-py", "ros2-cpp", "ros2-py")
_MODELS = ("examples/hello/hello.rebeca", "examples/experiment1/experiment1.rebeca")
_FORMS = ("text", "json", "sarif", "github")
_MAIN = """reactiveclass A(3) { statevars { int x; } A() { self.m(); } msgsrv m() { x = 1; } }
main { A a():(); }
"""

Files = dict[str, bytes]
Command = tuple[str, ...]


@dataclass(frozen=True)
class Case:
    """What lies in the folder of an input, and what is run there, one command after another."""

    kind: str
    files: Files
    commands: tuple[Command, ...]
    trees: tuple[tuple[bytes, bytes], ...] = ()  # entries of a git tree: names and contents


def case(seed: int, number: int) -> Case:
    """The input of a number: the same for the same seed, on any machine."""
    random = Random(f"{seed}:{number}")
    made = random.choices(tuple(_KINDS), tuple(_KINDS.values()))[0]
    return made(random)


def write(given: Case, folder: Path) -> None:
    """Puts the files of an input into a folder; names that the system refuses are left out."""
    for name, data in given.files.items():
        path = os.path.join(os.fsencode(folder), os.fsencode(name))  # noqa: PTH118
        try:
            os.makedirs(os.path.dirname(path), exist_ok=True)  # noqa: PTH103, PTH120
            with open(path, "wb") as file:  # noqa: PTH123
                file.write(data)
        except (OSError, ValueError):
            continue
    if given.trees:
        _write_tree(given.trees, folder)


# --- seeds --------------------------------------------------------------------------------------


@cache
def _seeds(suffix: str) -> tuple[bytes, ...]:
    """Files of the repository and of the corpus with this end of their names."""
    own = (p for p in CORPUS.rglob(f"*{suffix}"))
    others = (p for pattern in _SEEDS for p in ROOT.glob(pattern) if p.name.endswith(suffix))
    paths = dict.fromkeys(p for p in sorted({*own, *others}) if p.is_file())
    return tuple(p.read_bytes() for p in paths if p.stat().st_size <= _LARGEST)


@cache
def _packages() -> tuple[Files, ...]:
    """Packages: of test cases, and those that rebsync makes of models in each dialect."""
    written = [
        _files_of(p) for p in sorted(ROOT.glob("tests/reverse/*/cases/*/package")) if p.is_dir()
    ]
    return tuple(p for p in written if p and sum(map(len, p.values())) < 40_000)


@cache
def _managed() -> tuple[Files, ...]:
    """Packages with the model that they were made from beside them."""
    from rebsync.cli.generate import package_files
    from rebsync.config import Config
    from rebsync.source import Source

    made = []
    for path in _MODELS:
        for dialect in _DIALECTS:
            text = (ROOT / path).read_text(encoding="utf-8")
            with redirect_stderr(io.StringIO()):
                name, files = package_files(Source("m.rebeca", text), Config(target=dialect))
            below = {f"{name}/{path}": text.encode() for path, text in files.items()}
            made.append({"m.rebeca": text.encode(), **below})
    return tuple(made)


def _files_of(folder: Path) -> Files:
    return {
        f"pkg/{p.relative_to(folder).as_posix()}": p.read_bytes()
        for p in sorted(folder.rglob("*"))
        if p.is_file()
    }


# --- kinds of inputs ----------------------------------------------------------------------------


def _model_text(random: Random) -> bytes:
    seeds = _seeds(".rebeca")
    match random.randrange(6):
        case 0:
            return derive("model", "model", random).encode()
        case 1:
            body = derive("model", random.choice(("statement", "block")), random)
            return _MAIN.replace("x = 1;", body).encode()
        case 2:
            changed = mutate(derive("model", "statement", random).encode(), random)
            return _MAIN.encode().replace(b"x = 1;", changed)
        case _:
            return mutate(random.choice(seeds), random, seeds)


def _model(random: Random) -> Case:
    form = random.choice(_FORMS)
    bounds = ("--max-states", "200", "--max-time", "2")
    commands: list[Command] = [
        ("lint", "m.rebeca", "--format", form),
        ("fmt", "--diff", "m.rebeca"),
        ("export", "--for", "rmc", "m.rebeca"),
        ("verify", "m.rebeca", *bounds, "--engine", "interpreted", *_run_form(random)),
        ("simulate", "m.rebeca", "--seed", "1", "--steps", "20", *_run_form(random)),
        ("verify", "m.rebeca", *bounds, "--states", random.choice(("s.dot", "s.json", "s.svg"))),
        ("generate", "m.rebeca", "--target", random.choice(_DIALECTS)),
        ("check", "m", "--format", form),
        ("diff", "m.rebeca", "m"),
        ("extract", "m"),
        ("fmt", "m.rebeca"),
        ("lint", "--fix", "m.rebeca"),
    ]
    return Case("model", {"m.rebeca": _model_text(random)}, _some(commands, random, 4))


def _run_form(random: Random) -> Command:
    return ("--format", random.choice(("text", "text", "json", "svg", "html")))


def _some(commands: Sequence[Command], random: Random, most: int) -> tuple[Command, ...]:
    """A few commands in their order."""
    picked = sorted(random.sample(range(len(commands)), min(most, len(commands))))
    return tuple(commands[i] for i in picked)


def _property(random: Random) -> Case:
    seeds = _seeds(".property")
    model = (ROOT / random.choice(_MODELS)).read_bytes()
    if random.random() < 0.4:
        text = derive("property", "properties", random).encode()
    else:
        text = mutate(random.choice(seeds), random, seeds)
    commands = (
        ("lint", "m.property", "--format", random.choice(_FORMS)),
        ("verify", "m.rebeca", "--max-states", "200", "--max-time", "2", *_run_form(random)),
    )
    return Case("property", {"m.rebeca": model, "m.property": text}, commands)


def _toml(random: Random) -> Case:
    """Settings beside a model, and conceptual models."""
    seeds = _seeds(".toml")
    text = mutate(random.choice(seeds), random, seeds)
    model = (ROOT / _MODELS[0]).read_bytes()
    commands: list[Command] = [
        ("new", "rebsync.toml"),
        ("generate", "m.rebeca", "--target", random.choice(_DIALECTS)),
        ("check",),
        ("extract", "."),
    ]
    return Case("toml", {"m.rebeca": model, "rebsync.toml": text}, tuple(commands))


def _changed(files: Files, random: Random, below: Callable[[str], bool]) -> Files:
    """A package in which one file or two are changed, gone, or have other names."""
    files = dict(files)
    for _ in range(random.choice((1, 1, 1, 2))):
        names = sorted(name for name in files if below(name))
        if not names:
            break
        name = random.choice(names)
        match random.randrange(12):
            case 0:
                del files[name]
            case 1:
                word = random.choice(WORDS).replace(b"\0", b"0").replace(b"/", b"_")
                stem, dot, suffix = name.rpartition(".")
                files[stem + os.fsdecode(word) + dot + suffix] = files.pop(name)
            case _:
                files[name] = mutate(files[name], random, _alike(name))
    return files


@cache
def _alike(name: str) -> tuple[bytes, ...]:
    suffix = Path(name).suffix
    return _seeds(suffix)[:200] if suffix else ()


def _code(random: Random) -> Case:
    """A package that was written by hand."""
    files = _changed(random.choice(_packages()), random, lambda _: True)
    commands: list[Command] = [
        ("extract", "pkg"),
        ("extract", "pkg", "--format", "json"),
        ("extract", "pkg", "--report", random.choice(("text", "json"))),
        ("diff", "pkg", "pkg", "--format", random.choice((*_FORMS, "html"))),
    ]
    return Case("code", files, _some(commands, random, 2))


def _check_commands(random: Random) -> tuple[Command, ...]:
    form = random.choice((*_FORMS, "junit"))
    commands: list[Command] = [
        ("check", "--format", form),
        ("check", "--verify", "--max-states", "200", "--max-time", "2", "--format", form),
        ("diff", "m.rebeca", "m", "--format", random.choice((*_FORMS, "html"))),
        ("diff", "m.rebeca", "m", "--behaviour", "--max-states", "50"),
        ("sync", "--dry-run"),
        ("sync", "--conflict", random.choice(("markers", "ours", "theirs"))),
        ("check",),
        ("generate", "m.rebeca", "--diff"),
        ("generate", "m.rebeca", *random.choice(((), ("--force",)))),
    ]
    return _some(commands, random, 3)


def _sync(random: Random) -> Case:
    """A package of rebsync's in which the code was changed, or the model, or both."""
    files = _changed(random.choice(_managed()), random, lambda name: ".rebsync/" not in name)
    return Case("sync", files, _check_commands(random))


def _record(random: Random) -> Case:
    """A package whose `.rebsync/` was changed."""
    files = dict(random.choice(_managed()))
    manifest = next(name for name in files if name.endswith("/manifest.json"))
    if random.random() < 0.5:
        files[manifest] = _changed_json(files[manifest], random)
    else:
        files = _changed(files, random, lambda name: ".rebsync/" in name)
    return Case("record", files, _check_commands(random))


def _changed_json(data: bytes, random: Random) -> bytes:
    """A JSON text in which values were put in the place of others of another kind."""
    value = json.loads(data)
    for _ in range(random.choice((1, 1, 2, 3))):
        holder, key = random.choice(list(_holders(value)))
        holder[key] = random.choice(_STRANGE)
    text = json.dumps(value)
    number = random.choice((*NUMBERS, b"[" * 100_000))
    return text.replace('"NUMBER"', number.decode("latin-1")).encode()


_STRANGE: tuple[object, ...] = (
    *(None, True, 0, -1, 1.5, 2**70, "", "x", "NUMBER", [], {}, [[]], {"": None}, ["x"], [0]),
    *("../../x", "/etc/passwd", "\x1b[2J", "a\nb", "\ud800", "m.rebeca", "m", "\0", "a/b.py"),
)


def _holders(value: object) -> Iterator[tuple[Any, Any]]:
    items: list[tuple[Any, Any]] = []
    if isinstance(value, dict):
        items = list(value.items())
    elif isinstance(value, list):
        items = list(enumerate(value))
    for key, below in items:
        yield value, key
        yield from _holders(below)


def _replay(random: Random) -> Case:
    """A recorded run that was changed."""
    model = (ROOT / _MODELS[0]).read_bytes()
    run = random.choice(_seeds("run.json"))
    changed = _changed_json(run, random) if random.random() < 0.6 else mutate(run, random)
    commands = (("verify", "m.rebeca", "--replay", "run.json", *_run_form(random)),)
    return Case("replay", {"m.rebeca": model, "run.json": changed}, commands)


def _git(random: Random) -> Case:
    """Revisions whose trees no `git add` would make."""
    name = os.fsencode(random.choice(("m.rebeca", "pkg/src/a.cpp", "package.xml")))
    odd = (
        b"..",
        b".git",
        b"/x",
        b"a/b",
        b".",
        b"\x1b[2J",
        b"\xff",
        b"a\nb",
        b"-x",
        b"a" * 300,
    )
    names = (random.choice(odd), mutate(name, random).replace(b"\0", b""), b"m.rebeca", b"x.py")
    contents = (_model_text(random), *(random.choice(_seeds(s)) for s in (".py", ".cpp", ".xml")))
    picked = tuple((n, random.choice(contents)) for n in names if random.random() < 0.7)
    commands = (
        ("diff", "hostile:", "m.rebeca"),
        ("diff", "m.rebeca", random.choice(("hostile:m.rebeca", "hostile:x", "hostile:../x"))),
    )
    return Case("git", {"m.rebeca": _MAIN.encode()}, commands, picked or ((b"..", b"x"),))


def _write_tree(entries: Sequence[tuple[bytes, bytes]], folder: Path) -> None:
    def git(*arguments: str, data: bytes = b"") -> bytes:
        done = subprocess.run(
            ("git", "-c", "user.name=f", "-c", "user.email=f@example.org", *arguments),
            cwd=folder,
            input=data,
            capture_output=True,
            check=False,
        )
        return done.stdout.strip()

    git("init", "-q")
    body = b""
    for name, content in entries:
        blob = git("hash-object", "-w", "--stdin", data=content)
        body += b"100644 " + name + b"\0" + bytes.fromhex(blob.decode())
    tree = git("hash-object", "-w", "-t", "tree", "--literally", "--stdin", data=body)
    commit = git("commit-tree", tree.decode(), "-m", "x")
    git("update-ref", "refs/heads/hostile", commit.decode())


_KINDS: dict[Callable[[Random], Case], float] = {
    _model: 6,
    _property: 2,
    _toml: 2,
    _code: 5,
    _sync: 3,
    _record: 3,
    _replay: 1,
    _git: 0.3,
}
