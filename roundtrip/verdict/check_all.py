"""The verdicts on many packages: what must be read for them is read on all processors."""

from __future__ import annotations

import gc
import os
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import TypeAlias, cast

from rebsync.diagnostics import Findings, RebsyncError
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import ACCEPTED
from rebsync.roundtrip.verdict.check import begin, finish_proved
from rebsync.roundtrip.verdict.result import CheckResult, StartedCheck

# Findings say why it cannot be told how a package stands.
Result: TypeAlias = "CheckResult | tuple[Findings, ...]"


def check_all(packages: Iterable[ManagedPackage], depth: str) -> Iterator[Result]:
    """How each package stands, in their order."""
    begun = [_tried(package.root, partial(begin, package, depth)) for package in packages]
    pending = [b for b in begun if isinstance(b, StartedCheck)]
    finished = _in_processes(pending, depth) if _is_much(pending) else _in_turn(pending, depth)
    for each in begun:
        yield _as_accepted(next(finished) if isinstance(each, StartedCheck) else each)


def _as_accepted(result: Result) -> Result:
    """The same with what the user has accepted, where anything is."""
    if not isinstance(result, CheckResult) or result.drift is None:
        return result
    root = result.package.root
    if not os.path.lexists(f"{root}/{ACCEPTED}"):
        return result
    from rebsync.roundtrip.verdict.acceptance import with_accepted

    return cast("Result", _tried(root, lambda: with_accepted(result)))


def _tried(root: str, task: Callable[[], CheckResult | StartedCheck]) -> Result | StartedCheck:
    try:
        return task()
    except RebsyncError as error:
        return error.findings
    except RecursionError:
        return _too_deep(root)


def _too_deep(root: str) -> tuple[Findings, ...]:
    why = "something in it nests deeper than rebsync reads"
    return RebsyncError.of(root, "RS111", why).findings


def _finished(begun: StartedCheck, depth: str) -> Result:
    return cast("Result", _tried(begun.package.root, lambda: finish_proved(begun, depth)))


def _in_turn(pending: list[StartedCheck], depth: str) -> Iterator[Result]:
    yield from (_finished(begun, depth) for begun in pending)


# --- processes ----------------------------------------------------------------------------------


def _is_much(pending: list[StartedCheck]) -> bool:
    """Whether more processes are worth while; what they need is loaded for that only."""
    if len(pending) < 3:
        return False
    from rebsync.reverse.files.parallel import ENOUGH, processors

    return sum(b.state.listing.size for b in pending) >= ENOUGH and processors() > 1


def _in_processes(pending: list[StartedCheck], depth: str) -> Iterator[Result]:
    from rebsync.reverse.files.parallel import in_processes
    from rebsync.roundtrip.package.cache.serialisation import deserialised

    first, *others = pending
    yield _finished(first, depth)  # what it loads, copies of this process have then
    for text in in_processes(iter(others), partial(_sent, depth), lambda b: b.package.root):
        yield cast("Result", deserialised(text))


def _sent(depth: str, begun: StartedCheck) -> str:
    """The result in the form in which values keep what they are."""
    from rebsync.roundtrip.package.cache.serialisation import serialised

    try:
        return serialised(_finished(begun, depth))
    finally:
        gc.collect()  # commands run without it, but this one may take long
