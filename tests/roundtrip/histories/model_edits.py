"""Edits of a model's text as people make them, those that keep its meaning among them."""

from __future__ import annotations

import re
from collections.abc import Callable
from random import Random
from typing import TypeAlias

from rebsync import model as m
from rebsync.config import Config
from rebsync.diagnostics import Severity
from rebsync.forward.limits import limits
from rebsync.grammars.parser import parse_model
from rebsync.source import Source, Span
from rebsync.static import analyse

Maker: TypeAlias = "Callable[[Random, str, m.Model], str | None]"

_BODIES = (m.Constructor, m.MessageServer, m.Method)
_TRIES = 12
_OTHER = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||"}


def edited_model(rng: Random, text: str, kinds: dict[str, Maker] | None = None) -> tuple[str, str]:
    """The name of an edit, and the text with it: a model of which a package can be made."""
    model = parse_model(Source("drawn.rebeca", text)).model
    makers = list((kinds or KINDS).items())
    for _ in range(_TRIES):
        name, make = rng.choice(makers)
        new = make(rng, text, model)
        if new is not None and new != text and is_fine(new):
            return name, new
    return "nothing", text


def is_fine(text: str) -> bool:
    """Whether a package can be made of a text."""
    parsed = parse_model(Source("drawn.rebeca", text))
    if any(d.severity is Severity.ERROR for d in parsed.diagnostics):
        return False
    analysis = analyse(parsed.model)
    if analysis.errors:
        return False
    found = limits(parsed.model, analysis, Config(), "drawn")
    return not any(d.severity is Severity.ERROR for d in found)


def _put(text: str, span: Span, new: str) -> str:
    return text[: span.start] + new + text[span.end :]


def _new(rng: Random, text: str, stem: str) -> str:
    """A name that the text does not have."""
    while True:
        name = f"{stem}{rng.randrange(10_000)}"
        if name not in text:
            return name


# --- what changes behaviour -----------------------------------------------------------------------


def number(rng: Random, text: str, model: m.Model) -> str | None:
    """Another number."""
    found = [n for n in m.walk(model) if isinstance(n, m.IntLiteral) and n.value > 0]
    if not found:
        return None
    node = rng.choice(found)
    return _put(text, node.span, str(node.value + rng.choice((1, 2, 5))))


def comparison(rng: Random, text: str, model: m.Model) -> str | None:
    """Another operator."""
    found = [n for n in m.walk(model) if isinstance(n, m.Binary) and n.operator in _OTHER]
    if not found:
        return None
    node = rng.choice(found)
    between = Span(node.left.span.end, node.right.span.start)
    old = text[between.start : between.end]
    return _put(text, between, old.replace(node.operator, _OTHER[node.operator], 1))


def removed(rng: Random, text: str, model: m.Model) -> str | None:
    """A statement less."""
    found = [s for b in _blocks(model) for s in b.statements if not isinstance(s, m.Local)]
    if not found:
        return None
    return _without(text, rng.choice(found).span)


def inserted(rng: Random, text: str, model: m.Model) -> str | None:
    """A statement more."""
    owner, body = _body(rng, model)
    if owner is None or body is None:
        return None
    statement = rng.choice(_statements(rng, owner))
    return _at(rng, text, body, f"{statement}")


def wrapped(rng: Random, text: str, model: m.Model) -> str | None:
    """A statement under a condition."""
    found = [
        s for b in _blocks(model) for s in b.statements if isinstance(s, m.ExpressionStatement)
    ]
    if not found:
        return None
    span = rng.choice(found).span
    old = text[span.start : span.end]
    return _put(text, span, f"if ({rng.choice(('true', '1 < 2'))}) {{ {old} }}")


def variable(rng: Random, text: str, model: m.Model) -> str | None:
    """A state variable more, and a statement that sets it."""
    owner = rng.choice([c for c in model.classes if isinstance(c, m.ReactiveClass)])
    name = _new(rng, text, "seen")
    _, body = _body(rng, m.Model((), (owner,), None))
    if body is None or not any(isinstance(x, m.StateVars) for x in owner.members):
        return None
    text = _at(rng, text, body, f"{name} = {rng.randrange(9)};")
    head = re.compile(r"statevars\s*\{").search(text, owner.span.start)
    return None if head is None else f"{text[: head.end()]} int {name};{text[head.end() :]}"


def server(rng: Random, text: str, model: m.Model) -> str | None:
    """A message server more, and one that sends to it."""
    owner = rng.choice([c for c in model.classes if isinstance(c, m.ReactiveClass)])
    name = _new(rng, text, "later")
    bodies = [x for x in owner.members if isinstance(x, m.MessageServer) and x.body is not None]
    if not bodies:
        return None
    chosen = rng.choice(bodies)
    assert chosen.body is not None
    own = f"\n\n  // {name}\n  msgsrv {name}() {{\n    delay({rng.randrange(1, 5)});\n  }}"
    text = text[: chosen.span.end] + own + text[chosen.span.end :]
    return _at(rng, text, chosen.body, f"self.{name}() after({rng.randrange(1, 5)});")


def renamed(rng: Random, text: str, model: m.Model) -> str | None:
    """Something with another name, wherever it is named."""
    names = [
        n.name
        for n in m.walk(model)
        if isinstance(n, m.MessageServer | m.Method | m.Declarator | m.ReactiveClass | m.Rebec)
    ]
    if not names:
        return None
    name = rng.choice(sorted(set(names)))
    code = re.sub(r"//[^\n]*", lambda c: " " * len(c[0]), text)
    new = _new(rng, text, f"{name}_" if rng.random() < 0.5 else name[:1] + "n")
    for found in reversed(list(re.finditer(rf"\b{name}\b", code))):
        text = text[: found.start()] + new + text[found.end() :]
    return text


def queue(rng: Random, text: str, model: m.Model) -> str | None:
    """A longer queue."""
    found = list(re.finditer(r"reactiveclass \w+[^({]*\((\d+)\)", text))
    if not found:
        return None
    one = rng.choice(found)
    return _put(text, Span(*one.span(1)), str(int(one[1]) + 1))


def rebec(rng: Random, text: str, model: m.Model) -> str | None:
    """A rebec more, like one that is there."""
    if model.main is None or not model.main.rebecs:
        return None
    node = rng.choice(model.main.rebecs)
    own = text[node.span.start : node.span.end]
    new = re.sub(rf"\b{node.name}\b", _new(rng, text, "twin"), own, count=1)
    return f"{text[: node.span.end]}\n  {new}{text[node.span.end :]}"


def constant(rng: Random, text: str, model: m.Model) -> str | None:
    """An env variable more, that a delay reads."""
    name = _new(rng, text, "pause")
    _, body = _body(rng, model)
    if body is None:
        return None
    text = _at(rng, text, body, f"delay({name});")
    at = model.heads[0].span.start if model.heads else model.classes[0].span.start
    return f"{text[:at]}env int {name} = {rng.randrange(1, 9)};\n{text[at:]}"


# --- what does not --------------------------------------------------------------------------------


def remark(rng: Random, text: str, model: m.Model) -> str | None:
    """A comment on a line of its own, or at the end of one."""
    lines = text.split("\n")
    at = rng.randrange(len(lines) - 1)
    mark = f"// kept {rng.randrange(10**6)}"
    if rng.random() < 0.5 and "//" not in lines[at]:
        lines[at] = f"{lines[at]}  {mark}"
    else:
        lines.insert(at, f"    {mark}")
    return "\n".join(lines)


def layout(rng: Random, text: str, model: m.Model) -> str | None:
    """Blanks where there is one, blank lines, a brace on its own line."""
    old, new = rng.choice(((";\n", ";\n\n"), (" = ", "   =  "), (") {", ")\n  {"), ("  ", "\t")))
    found = [f.start() for f in re.finditer(re.escape(old), text)]
    if not found:
        return None
    at = rng.choice(found)
    return text[:at] + new + text[at + len(old) :]


def parentheses(rng: Random, text: str, model: m.Model) -> str | None:
    """Parentheses that are not needed."""
    found = [n for n in m.walk(model) if isinstance(n, m.Binary)]
    if not found:
        return None
    span = rng.choice(found).span
    return _put(text, span, f"({text[span.start : span.end]})")


# --- places ---------------------------------------------------------------------------------------


def _blocks(model: m.Model) -> list[m.Block]:
    bodies = [n.body for n in m.walk(model) if isinstance(n, _BODIES) and n.body is not None]
    return [n for body in bodies for n in m.walk(body) if isinstance(n, m.Block)]


def _body(rng: Random, model: m.Model) -> tuple[m.ReactiveClass | None, m.Block | None]:
    found = [
        (c, x.body)
        for c in model.classes
        if isinstance(c, m.ReactiveClass)
        for x in c.members
        if isinstance(x, m.MessageServer) and x.body is not None
    ]
    return rng.choice(found) if found else (None, None)


def _statements(rng: Random, owner: m.ReactiveClass) -> list[str]:
    """Statements that the class may have anywhere in its servers."""
    plain = [f"delay({rng.randrange(1, 6)});", 'assertion(1 < 2, "it is");']
    plain += [
        f"self.{x.name}() after({rng.randrange(1, 9)});"
        for x in owner.members
        if isinstance(x, m.MessageServer) and not x.parameters
    ]
    for section in owner.members:
        if isinstance(section, m.StateVars):
            for declaration in section.declarations:
                if declaration.type.name == "int" and not declaration.type.dimensions:
                    plain += [f"{d.name} = {rng.randrange(9)};" for d in declaration.declarators]
    return plain


def _at(rng: Random, text: str, body: m.Block, statement: str) -> str:
    """A statement on a line of its own somewhere in a body."""
    if not body.statements:
        at = body.span.start + 1
        return f"{text[:at]}\n    {statement}{text[at:]}"
    if rng.random() < 0.5:
        at = rng.choice(body.statements).span.start
        return f"{text[:at]}{statement}\n    {text[at:]}"
    at = rng.choice(body.statements).span.end
    return f"{text[:at]}\n    {statement}{text[at:]}"


def _without(text: str, span: Span) -> str:
    """A text without a stretch, nor the line that it had for itself."""
    start = text.rfind("\n", 0, span.start) + 1
    end = text.find("\n", span.end)
    if not text[start : span.start].strip() and not text[span.end : end].strip():
        return text[:start] + text[end + 1 :]
    return text[: span.start] + text[span.end :]


BEHAVIOUR: dict[str, Maker] = {
    "number": number,
    "comparison": comparison,
    "statement removed": removed,
    "statement inserted": inserted,
    "statement under a condition": wrapped,
    "state variable": variable,
    "server": server,
    "rename": renamed,
    "queue": queue,
    "rebec": rebec,
    "constant": constant,
}
NEUTRAL: dict[str, Maker] = {"remark": remark, "layout": layout, "parentheses": parentheses}
KINDS = {**BEHAVIOUR, **NEUTRAL}
