"""Trees that no text gives, the public answers of an analysis, and its cost."""

from __future__ import annotations

from dataclasses import replace

from rebsync.grammars.parser import parse_model
from rebsync.model import (
    Assign,
    Binary,
    Broken,
    Call,
    Choice,
    Empty,
    Expression,
    ExpressionStatement,
    If,
    IntLiteral,
    MessageServer,
    Model,
    Name,
    ReactiveClass,
    Return,
    Statement,
    Type,
    Unary,
    walk,
)
from rebsync.source import Source
from rebsync.static import analyse
from rebsync.static.symbols import (
    BuiltinFunctionSymbol,
    BuiltinSymbol,
    EnvSymbol,
    KnownRebecSymbol,
    LocalSymbol,
    MethodSymbol,
    ParameterSymbol,
    RebecSymbol,
    ServerSymbol,
    StateSymbol,
)

TEXT = """
env int rate = 2 * 3;
interface Told { msgsrv tell(int a); }
reactiveclass Base(5) {
    knownrebecs { Told first; }
    statevars { int x; }
    Base() { x = 0; }
    int f(int p) { return p + rate; }
    msgsrv go() { x = f(1); self.go() after(rate); }
}
reactiveclass Child extends Base implements Told(5) {
    knownrebecs { Base second; }
    statevars { Base last; }
    Child(int a) { x = a; last = null; self.go(); }
    Child(boolean b) { x = 1; last = self; if (b) self.go(); }
    msgsrv tell(int a) {
        int local = a;
        last = (Base) sender;
        first.tell(local);
        second.go();
        if (last != null) tell(now);
        delay(f(x));
    }
}
main {
    Child a(b, b):(1);
    Child b(a, a):(true);
}
"""


def model_of(text: str) -> Model:
    parsed = parse_model(Source("a.rebeca", text))
    assert parsed.ok, parsed.diagnostics
    return parsed.model


def with_statement(model: Model, statement: Statement) -> Model:
    """The model with one more statement at the end of the last server of its last class."""
    *classes, last = model.classes
    assert isinstance(last, ReactiveClass)
    *members, server = last.members
    assert isinstance(server, MessageServer) and server.body is not None
    body = replace(server.body, statements=(*server.body.statements, statement))
    changed = replace(last, members=(*members, replace(server, body=body)))
    return replace(model, classes=(*classes, changed))


def codes(model: Model) -> list[str]:
    return [d.code for d in analyse(model).diagnostics]


def test_the_model_of_these_tests_is_clean() -> None:
    assert analyse(model_of(TEXT)).diagnostics == ()


def test_a_single_option_is_no_choice() -> None:
    tree = Assign("=", Name("x"), Choice((IntLiteral(1),)))
    assert codes(with_statement(model_of(TEXT), ExpressionStatement(tree))) == ["RS420"]


def test_what_could_not_be_read_is_silent() -> None:
    broken = Broken()
    sum_ = Binary("+", Broken(), Name("x"))
    tree = Assign("=", Name("x"), Call(None, "f", (sum_,), after=None))
    for expression in (broken, tree, Assign("=", Broken(), IntLiteral(1)), Call(Broken(), "m")):
        statement = ExpressionStatement(expression)
        assert codes(with_statement(model_of(TEXT), statement)) == []


def test_incomplete_models_say_nothing_of_what_may_be_lost() -> None:
    text = "reactiveclass A(5) { msgsrv m() { self.qqq(); } msgsrv report() { } }"
    model = parse_model(Source("a.rebeca", text)).model
    assert {d.code for d in analyse(model).diagnostics} == {"RS204", "RS401"}
    assert analyse(model, incomplete=True).diagnostics == ()
    misspelled = parse_model(Source("a.rebeca", text.replace("qqq", "reprot"))).model
    assert [d.code for d in analyse(misspelled, incomplete=True).diagnostics] == ["RS204"]


def test_a_variable_that_a_property_reads_is_used() -> None:
    model = model_of(TEXT.replace("if (last != null) ", ""))
    assert codes(model) == ["RS504"]
    assert analyse(model, observed=frozenset({"last"})).diagnostics == ()


def test_symbols_and_types() -> None:
    model = model_of(TEXT)
    analysis = analyse(model)
    found = {
        (type(n).__name__, n.name, type(s).__name__, str(analysis.types.get(id(n), "")))
        for n in walk(model)
        if isinstance(n, Name | Call) and (s := analysis.symbol_of(n)) is not None
    }
    assert found == {
        ("Name", "rate", EnvSymbol.__name__, "int"),
        ("Name", "x", StateSymbol.__name__, "int"),
        ("Name", "last", StateSymbol.__name__, "Base"),
        ("Name", "first", KnownRebecSymbol.__name__, "Told"),
        ("Name", "second", KnownRebecSymbol.__name__, "Base"),
        ("Name", "p", ParameterSymbol.__name__, "int"),
        ("Name", "a", ParameterSymbol.__name__, "int"),
        ("Name", "b", ParameterSymbol.__name__, "boolean"),
        ("Name", "local", LocalSymbol.__name__, "int"),
        ("Name", "now", BuiltinSymbol.__name__, "int"),
        ("Name", "sender", BuiltinSymbol.__name__, "ReactiveClass"),
        ("Name", "a", RebecSymbol.__name__, "Child"),
        ("Name", "b", RebecSymbol.__name__, "Child"),
        ("Call", "f", MethodSymbol.__name__, "int"),
        ("Call", "go", ServerSymbol.__name__, "void"),
        ("Call", "tell", ServerSymbol.__name__, "void"),
        ("Call", "delay", BuiltinFunctionSymbol.__name__, "void"),
    }


def test_every_expression_of_a_clean_model_has_a_type() -> None:
    model = model_of(TEXT)
    analysis = analyse(model)
    nodes = [n for n in walk(model) if isinstance(n, Name | Call | Binary | Assign | IntLiteral)]
    assert len(nodes) > 30
    assert all(analysis.type_of(n) is not None for n in nodes)


def test_classes_with_what_they_inherit() -> None:
    child = analyse(model_of(TEXT)).classes["Child"]
    assert child.ancestors == ("Base", "Told")
    assert [(s.name, s.owner) for s in child.state] == [("x", "Base"), ("last", "Child")]
    assert [k.name for k in child.known] == ["first", "second"]
    assert {(s.name, s.owner) for s in child.servers} == {("go", "Base"), ("tell", "Child")}
    assert [(m.name, m.owner, m.type) for m in child.methods] == [("f", "Base", Type("int"))]
    assert len(child.constructors) == 2


def test_constructors_servers_and_values() -> None:
    model = model_of(TEXT)
    analysis = analyse(model)
    assert model.main is not None
    first, second = (analysis.constructor_of(r) for r in model.main.rebecs)
    assert first is not None and first.parameters[0].name == "a"
    assert second is not None and second.parameters[0].name == "b"
    sends = [n for n in walk(model) if isinstance(n, Call) and n.name == "tell"]
    owners = [s.owner for n in sends if (s := analysis.server_of(n)) is not None]
    assert owners == ["Told", "Child"]
    assert analysis.env["rate"].value == 6
    returned = next(n for n in walk(model) if isinstance(n, Return))
    assert isinstance(returned.value, Binary)
    assert analysis.value_of(returned.value.right) == 6
    assert analysis.value_of(returned.value) is None


def test_related_places_and_corrections() -> None:
    text = (
        "reactiveclass R_1(5) { } reactiveclass S(5) { } reactiveclass S(5) { } main { R1 a():(); }"
    )
    source = Source("a.rebeca", text)
    twice, unknown = (d for d in analyse(model_of(text)).diagnostics if d.code != "RS517")
    assert [source.slice(s) for s, _ in twice.related] == ["S"]
    assert unknown.hint == 'did you mean "R_1"?'
    assert [(source.slice(e.span), e.text) for e in unknown.edits] == [("R1", "R_1")]


def test_two_near_names_are_no_certain_correction() -> None:
    text = "reactiveclass Robot1(5) { } reactiveclass Robot2(5) { } main { Robot3 a():(); }"
    unknown = next(d for d in analyse(model_of(text)).diagnostics if d.code == "RS201")
    assert unknown.hint == 'did you mean "Robot2"?'
    assert unknown.edits == ()


def test_long_chains_do_not_nest() -> None:
    terms: Expression = Name("x")
    for _ in range(5_000):
        terms = Binary("+", terms, Name("x"))
    model = with_statement(model_of(TEXT), ExpressionStatement(Assign("=", Name("x"), terms)))
    chain: Statement = Empty()
    for n in range(2_000):
        chain = If(Binary("==", Name("x"), IntLiteral(n)), Empty(), chain)
    assert codes(with_statement(model, chain)) == []


def test_deep_nesting_is_a_diagnostic() -> None:
    deep: Expression = Name("x")
    for _ in range(5_000):
        deep = Unary("-", deep)
    model = with_statement(model_of(TEXT), ExpressionStatement(Assign("=", Name("x"), deep)))
    assert codes(model) == ["RS111"]
