"""C made into libraries by the system's compiler, and kept in the user's cache by content."""

from __future__ import annotations

import ctypes
import hashlib
import os
import shlex
import shutil
import signal
import time
from collections.abc import Callable
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from rebsync.cache import Cache, open_cache, read_ours
from rebsync.checker.exploration import Unavailable
from rebsync.records import dataclass

if TYPE_CHECKING:
    from subprocess import Popen

_TEMPLATES = Path(__file__).parent / "templates"
_FLAGS = ("-std=gnu11", "-fPIC", "-shared", "-pthread", "-ffp-contract=off", "-w")
_KEPT = 100  # libraries in the cache
_PATIENCE = 120  # seconds that one compilation may take
_GLANCE = 0.1  # seconds between two looks whether it is still wanted


@dataclass(frozen=True, slots=True)
class Unit:
    """One library: its name, how its text is made and from what, and how to optimise.

    Equal `parts` make an equal library, so that the text is needed only to compile.
    """

    name: str
    text: Callable[[], str]
    parts: tuple[str, ...]
    level: str


def header(name: str) -> str:
    """The text of a C file that belongs to rebsync."""
    return (_TEMPLATES / name).read_text(encoding="utf-8")


def always() -> bool:
    """What is begun is always wanted."""
    return True


def libraries(
    units: tuple[Unit, ...], compiled: bool = True, wanted: Callable[[], bool] = always
) -> tuple[ctypes.CDLL, ...]:
    """The units as loaded libraries; what the cache does not have is compiled, side by side.

    Raises Unavailable when there is no compiler, or it fails, or what it makes cannot be loaded;
    unless it may be `compiled`, when the cache lacks one of them; and when they are not `wanted`
    any more while the compiler runs.
    """
    compiler = _compiler()
    keys = [_key(unit, compiler) for unit in units]
    cache = open_cache("libraries")
    loaded = [_kept(cache, key) for key in keys]
    missing = [i for i, library in enumerate(loaded) if library is None]
    if missing and not compiled:
        raise Unavailable("the model has not been compiled before")
    if missing:
        import tempfile

        try:
            with tempfile.TemporaryDirectory(prefix="rebsync-") as scratch:
                made = _compile([units[i] for i in missing], compiler, Path(scratch), wanted)
                for i, path in zip(missing, made, strict=True):
                    loaded[i] = _made(cache, keys[i], path)
        except OSError as error:
            raise Unavailable(f"the model cannot be compiled: {error.strerror}") from None
    return tuple(library for library in loaded if library is not None)


def _compiler() -> tuple[str, ...]:
    """The command of the C compiler: `$CC`, else the first that is found."""
    chosen = os.environ.get("CC", "")
    try:
        command = shlex.split(chosen)
    except ValueError:
        raise Unavailable(f"CC is no command: {chosen}") from None
    for name, *arguments in [command] if command else [["cc"], ["gcc"], ["clang"]]:
        if path := shutil.which(name):
            return (path, *arguments)
    raise Unavailable(f"the C compiler {command[0]} is not there" if command else "no C compiler")


def _key(unit: Unit, compiler: tuple[str, ...]) -> str:
    """What the library depends on, as one name."""
    with suppress(OSError):
        found = Path(compiler[0]).resolve().stat()
        compiler = (*compiler, str(found.st_size), str(found.st_mtime_ns))
    parts = (unit.name, *unit.parts, unit.level, *_FLAGS, *compiler)
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:32]


# --- the cache: names that say what a library is made from, and the seal of its content ----------


def _kept(cache: Cache | None, key: str) -> ctypes.CDLL | None:
    """The library of a key; None unless it is under this user's seal, and loads."""
    if cache is None:
        return None
    for path in cache.folder.glob(f"{key}-*.so"):
        content = read_ours(path)
        with suppress(OSError, Unavailable):
            if content is not None and path.name == _name(cache, key, content):
                os.utime(path)
                return _load(path)
        with suppress(OSError):
            path.unlink()
    return None


def _name(cache: Cache, key: str, content: bytes) -> str:
    return f"{key}-{cache.seal(key, content)}.so"


def _keep(cache: Cache | None, key: str, made: Path) -> Path | None:
    """Puts a library into the cache; None when that cannot be done."""
    if cache is None:
        return None
    content = made.read_bytes()
    try:
        path = cache.put(_name(cache, key, content), content, mode=0o700)
    except OSError:
        return None
    cache.tidy(_KEPT)
    return path


def _made(cache: Cache | None, key: str, made: Path) -> ctypes.CDLL:
    """What was compiled, from the cache if it can be kept and run there."""
    kept = _keep(cache, key, made)
    if kept is not None:
        with suppress(Unavailable):
            return _load(kept)
    return _load(made)


def _load(path: Path) -> ctypes.CDLL:
    try:
        return ctypes.CDLL(str(path))
    except OSError as error:
        raise Unavailable(f"the compiled model cannot be loaded: {error}") from None


# --- compiling -----------------------------------------------------------------------------------


def _compile(
    units: list[Unit], compiler: tuple[str, ...], scratch: Path, wanted: Callable[[], bool]
) -> list[Path]:
    for source in _TEMPLATES.glob("*.[ch]"):
        shutil.copyfile(source, scratch / source.name)
    with ExitStack() as ending:
        running = []
        for unit in units:
            process = _started(unit, compiler, scratch)
            running.append(ending.enter_context(process))
            ending.callback(_end, process)
        for process in running:
            _finish(process, compiler[0], wanted)
    made = [scratch / f"{unit.name}.so" for unit in units]
    if not all(path.is_file() for path in made):
        raise Unavailable(f"the C compiler {compiler[0]} has made nothing")
    return made


def _finish(process: Popen[str], compiler: str, wanted: Callable[[], bool]) -> None:
    said = _said(process, compiler, wanted)
    if process.returncode:
        first = next((line for line in said.splitlines() if line.strip()), "it says nothing")
        raise Unavailable(f"the C compiler {compiler} fails: {first}")


def _said(process: Popen[str], compiler: str, wanted: Callable[[], bool]) -> str:
    from subprocess import TimeoutExpired

    end = time.monotonic() + _PATIENCE
    while True:
        try:
            return process.communicate(timeout=_GLANCE)[0]
        except TimeoutExpired:
            if not wanted():
                raise Unavailable("the compiled model is not wanted any more") from None
            if time.monotonic() >= end:
                raise Unavailable(f"the C compiler {compiler} takes too long") from None


def _end(process: Popen[str]) -> None:
    """Ends a compiler that still runs, with the parts that it has started itself."""
    if process.stdout is None or process.stdout.closed:
        return
    if hasattr(os, "killpg"):
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()


def _started(unit: Unit, compiler: tuple[str, ...], scratch: Path) -> Popen[str]:
    from subprocess import DEVNULL, PIPE, STDOUT, Popen

    source = scratch / f"{unit.name}.c"
    source.write_text(unit.text(), encoding="utf-8")
    library = f"{unit.name}.so"
    command = (*compiler, unit.level, *_FLAGS, source.name, "-o", library, "-lm")
    try:
        return Popen(
            command,
            cwd=scratch,
            stdin=DEVNULL,
            stdout=PIPE,
            stderr=STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        )
    except OSError as error:
        raise Unavailable(f"the C compiler {compiler[0]} does not start: {error}") from None
