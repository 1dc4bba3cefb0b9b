"""Verdicts of `rebsync verify` on properties, in the user's cache, for exactly these two texts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rebsync.roundtrip.package.cache.store import key_of, load, save

if TYPE_CHECKING:
    from rebsync.checker.problem import Options, Problem
    from rebsync.checker.result import Result


def save_verdicts(problem: Problem, options: Options, result: Result) -> None:
    """Keeps what was decided as `rebsync verify` decides it when it is not told otherwise.

    Another language, a fairness and compacted hashes change what a verdict means, and the floating
    view where a user asks for it; bounds and reductions only leave properties undetermined.
    """
    is_plain = options.semantics in (None, "tts") and options.fairness == "none"
    decided = {name: verdict for name, verdict in result.properties if verdict != "undetermined"}
    if problem.property_source is None or not is_plain or options.hash_compaction or not decided:
        return
    texts = problem.source.text, problem.property_source.text
    save(key_of("properties", *texts), {**cached_verdicts(*texts), **decided})


def cached_verdicts(model: str, properties: str) -> dict[str, str]:
    """By the names of properties `satisfied` or `violated`, as far as these texts were verified."""
    return load(key_of("properties", model, properties), dict) or {}
