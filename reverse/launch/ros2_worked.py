"""What substitutions of ROS 2 work out of known texts: expressions, comparisons, choices."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from rebsync.reverse.launch.arithmetic import evaluate
from rebsync.reverse.unknowns import Open, Text

# Substitutions by the names of their classes, with what they are here; in XML and YAML by words.
CLASSES = {
    "PythonExpression": "eval",
    "EqualsSubstitution": "equals",
    "NotEqualsSubstitution": "not-equals",
    "NotSubstitution": "not",
    "AndSubstitution": "and",
    "OrSubstitution": "or",
    "AllSubstitution": "all",
    "AnySubstitution": "any",
    "IfElseSubstitution": "if",
}
WORDS = frozenset(CLASSES.values())
TRUE, FALSE = ("true", "1"), ("false", "0")
# Python has no such names, though the expression would have a value with them.
_NO_NAMES = re.compile(r"(?<![\w'\"])(?:true|false)(?![\w'\"])")
_COUNTS = {"eval": (1, 1), "equals": (2, 2), "not-equals": (2, 2), "not": (1, 1), "if": (1, 3)}


def worked_out(name: str, texts: Sequence[str]) -> Text:
    """The text that a substitution makes of others; `same` compares them as they are."""
    least, most = _COUNTS.get(name, (1, len(texts)))
    if not least <= len(texts) <= most:
        return Open(f"`{name}` of {len(texts)} texts")
    match name:
        case "eval":
            return _expression(texts[0])
        case "same":
            return _as_text(texts[0] == texts[1])
        case "equals" | "not-equals":
            return _as_text(_equal(*texts) is (name == "equals"))
        case "if":
            return _chosen(*texts)
        case _:
            truths = [_truth(text) for text in texts]
            known = [t for t in truths if t is not None]
            if len(known) < len(truths):
                return Open(f"`{texts[truths.index(None)]}` is neither true nor false")
            if name == "not":
                return _as_text(not known[0])
            return _as_text(all(known) if name in ("and", "all") else any(known))


def _expression(text: str) -> Text:
    if _NO_NAMES.search(text):
        return Open("`true` and `false` are no names in an expression")
    value = evaluate(text, {}, {})
    return value if isinstance(value, Open) else str(value)


def _equal(one: str, other: str) -> bool:
    """Whether two texts are the same, as truths or numbers where both are."""
    truths = _truth(one), _truth(other)
    if None not in truths:
        return truths[0] == truths[1]
    try:
        return math.isclose(float(one), float(other))
    except ValueError:
        return one == other


def _chosen(condition: str, first: str = "", second: str = "") -> Text:
    truth = _truth(condition)
    if truth is None:
        return Open(f"`{condition}` is neither true nor false")
    return first if truth else second


def _truth(text: str) -> bool | None:
    word = text.strip().lower()
    return True if word in TRUE else False if word in FALSE else None


def _as_text(truth: bool) -> str:
    return "true" if truth else "false"
