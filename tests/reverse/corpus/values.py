"""Whether an answer says what a fact says: the rules of README.md, on the JSON of both."""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Iterable
from enum import Enum
from math import isclose
from typing import Any, TypeAlias

Json: TypeAlias = Any


class Verdict(Enum):
    """What an answer is worth; OPEN says that it is unknown though the fact knows it."""

    RIGHT = "right"
    OPEN = "open"
    WRONG = "wrong"


RIGHT, OPEN, WRONG = Verdict.RIGHT, Verdict.OPEN, Verdict.WRONG


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """WRONG before OPEN before RIGHT."""
    seen = set(verdicts)
    return next((v for v in (WRONG, OPEN) if v in seen), RIGHT)


def judge(fact: Json, answer: Json) -> Verdict:
    """An answer against the value of a fact that is not null."""
    if isinstance(fact, dict):
        if "one_of" in fact:
            return _one_of(fact["one_of"], answer)
        if "relative" in fact:
            return _relative(fact, answer)
        return _from_parameter(fact, answer)
    if _is_open(answer):
        return OPEN
    return RIGHT if same(fact, answer) else WRONG


def judge_null(answer: Json, partial: str | None = None) -> Verdict:
    """An answer where the fact says that nobody can know: unknown, with a fitting partial text."""
    if not _is_open(answer):
        return WRONG
    given = _partial(answer)
    fits = partial is None or given is None or _bare(given) == _bare(partial)
    return RIGHT if fits else WRONG


def _is_open(answer: Json) -> bool:
    """Whether an answer leaves something open."""
    match answer:
        case {"one_of": values}:
            return any(_is_open(v) for v in values)
        case {"parameter": name}:
            return _is_open(name) or _is_open(answer.get("default"))
        case dict():
            return "unknown" in answer or "relative" in answer
        case _:
            return False


def _partial(answer: Json) -> str | None:
    match answer:
        case {"relative": str(name)}:
            return f"*/{name}"
        case {"partial": str(text)}:
            return text
        case _:
            return None


def _bare(pattern: str) -> str:
    """A pattern as it matters: `*x` is as good as `*/x` or `*/*/x`."""
    return re.sub(r"(?:/?\*+/?)+", "*", pattern)


# --- plain values -------------------------------------------------------------------------------


def same(fact: Json, answer: Json) -> bool:
    """Whether two plain values are the same: numbers as numbers, names however they are spelt."""
    if isinstance(fact, bool) or isinstance(answer, bool):
        return fact is answer
    if isinstance(fact, int | float) and isinstance(answer, int | float):
        return isclose(fact, answer, rel_tol=1e-6)
    if isinstance(fact, str) and isinstance(answer, str):
        return tidied(fact) == tidied(answer)
    return bool(fact == answer)


def tidied(name: str) -> str:
    """A name without what does not matter: doubled slashes, one at the end, one after `~`."""
    tidy = re.sub("//+", "/", name).replace("~/", "~")
    return tidy.rstrip("/") or tidy


# --- values that depend on something ------------------------------------------------------------


def _alternatives(answer: Json) -> list[Json]:
    """What an answer may be, each by itself."""
    match answer:
        case {"one_of": values}:
            return [a for v in values for a in _alternatives(v)]
        case {"parameter": {"one_of": names}}:
            return [{**answer, "parameter": name} for name in names]
        case _:
            return [answer]


def _one_of(facts: list[Json], answer: Json) -> Verdict:
    given = _alternatives(answer)
    if all(any(judge(f, a) is RIGHT for f in facts) for a in given):
        all_given = all(any(judge(f, a) is RIGHT for a in given) for f in facts)
        return RIGHT if all_given else WRONG
    return OPEN if any(_is_open(a) for a in given) else WRONG


def _relative(fact: Json, answer: Json) -> Verdict:
    """A name under a handle that others choose."""
    name = str(fact["relative"])
    allowed = {_bare(f"*/{name}"), *(_bare(_joined(h, name)) for h in fact["handle"])}
    verdicts = []
    for given in _alternatives(answer):
        if isinstance(given, str):
            verdicts.append(RIGHT if _bare(tidied(given)) in allowed else WRONG)
        elif (partial := _partial(given)) is not None:
            verdicts.append(RIGHT if _bare(partial) in allowed else WRONG)
        else:
            verdicts.append(OPEN if _is_open(given) else WRONG)
    return worst(verdicts)


def _joined(namespace: str, name: str) -> str:
    """A name within a namespace as the code gives it: `~` and `x` are `~x`."""
    if not namespace or name.startswith(("/", "~")):
        return name
    return tidied(f"{namespace}/{name}")


def _from_parameter(fact: Json, answer: Json) -> Verdict:
    if not isinstance(answer, dict) or "parameter" not in answer:
        return OPEN if _is_open(answer) else WRONG
    within = _listed(answer.get("in", ""))
    differs = bool(fact.get("search")) != bool(answer.get("search")) or not _same_use(
        fact.get("expression"), answer.get("expression")
    )
    return worst(
        [
            judge(fact["parameter"], answer["parameter"]),
            _default(fact, answer, within),
            _within(_listed(fact.get("in", "")), within),
            WRONG if differs else RIGHT,
        ]
    )


def _within(facts: list[str], given: list[str]) -> Verdict:
    """The namespaces of the handles; `*` is an unknown one."""
    if set(facts) == set(given):
        return RIGHT
    return OPEN if any("*" in namespace for namespace in given) else WRONG


def _listed(value: Json) -> list[str]:
    return list(value) if isinstance(value, list) else [value]


def _default(fact: Json, answer: Json, within: list[str]) -> Verdict:
    """What stands in for the parameter: as it is, as resolved or as used."""
    wanted, given = fact.get("default"), answer.get("default")
    if wanted is None:  # a variable that holds nothing yet is none either
        return RIGHT if given in (None, "", 0) else OPEN if _is_open(given) else WRONG
    if given is None:
        return WRONG
    forms = [given]
    if isinstance(given, str):
        forms += [_joined(namespace, given) for namespace in within]
    if answer.get("expression") and isinstance(given, int | float | str):
        forms.append(evaluated(answer["expression"], given))
    verdicts = [judge(wanted, form) for form in forms]
    return RIGHT if RIGHT in verdicts else verdicts[0]


def _same_use(fact: str | None, answer: str | None) -> bool:
    """Whether two expressions make the same of any value."""
    first, second = fact or "value", answer or "value"
    if first == second:
        return True
    for samples in ((3.0, 7.5, 40.0), ("one", "two")):
        results = [(evaluated(first, s), evaluated(second, s)) for s in samples]
        if all(a is not None and b is not None and same(a, b) for a, b in results):
            return True
    return False


_OPERATORS: dict[type[ast.AST], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}


def spelt(expression: str) -> str:
    """An expression in one spelling: `1.f/value` and `1/value` as `1.0 / value`."""
    try:
        plain = ast.unparse(ast.parse(_SUFFIX.sub(r"\1", expression), mode="eval"))
    except SyntaxError:
        return expression
    return re.sub(r"(?<![\w.])(\d+) / ", r"\1.0 / ", plain)


_SUFFIX = re.compile(r"(\b\d+\.?\d*)[fFlLuU]+\b")


def evaluated(expression: str, value: float | str) -> float | str | None:
    """What an expression over `value` makes of it; None where it has none."""

    def of(node: ast.AST) -> Any:  # noqa: ANN401
        match node:
            case ast.Expression(body):
                return of(body)
            case ast.Constant(constant):
                return constant
            case ast.Name("value"):
                return value
            case ast.UnaryOp(ast.USub(), operand):
                return -of(operand)
            case ast.BinOp(left, op, right) if type(op) in _OPERATORS:
                return _OPERATORS[type(op)](of(left), of(right))
        raise ValueError(ast.dump(node))

    try:
        plain = _SUFFIX.sub(r"\1", expression)
        found = of(ast.parse(plain, mode="eval"))
    except (SyntaxError, TypeError, ValueError, ZeroDivisionError):
        return None
    return found if isinstance(found, int | float | str) else None
