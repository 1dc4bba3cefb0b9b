"""Trees of the model, of classes and of declarations."""

from __future__ import annotations

from lark import Token

from rebsync import model as m
from rebsync.grammars.tree_parts import (
    Children,
    Names,
    Parameters,
    body_of,
    first_of,
    integer,
    listed,
    nodes_of,
    place_of,
    span_of,
    tokens_of,
)
from rebsync.source import Span


class Structure:
    """Rules of the model, of classes and of declarations."""

    def model(self, items: Children) -> m.Model:
        return m.Model(
            nodes_of(items, m.Env, m.Refused),
            nodes_of(items, m.ReactiveClass, m.Interface),
            first_of(items, m.Main),
            span_of(items) if items else Span(0, 0),
        )

    def env(self, items: Children) -> m.Env:
        return m.Env(items[1], span_of(items))

    def refused(self, items: Children) -> m.Refused:
        text = "".join(str(t) for t in items[1:] if isinstance(t, Token)).rstrip(";")
        return m.Refused(str(items[0]), text.partition("{")[0], span_of(items))

    def reactive_class(self, items: Children) -> m.ReactiveClass:
        name, queue = tokens_of(items, "ID")[0], tokens_of(items, "INT")[0]
        lists = {n.keyword: n for n in nodes_of(items, Names)}
        extends, implements = lists.get("extends"), lists.get("implements")
        kinds = (m.KnownRebecs, m.StateVars, m.Constructor, m.MessageServer, m.Method)
        return m.ReactiveClass(
            str(name),
            integer(queue),
            nodes_of(items, *kinds),
            abstract=bool(tokens_of(items, "ABSTRACT")),
            extends=str(extends.names[0]) if extends else None,
            implements=tuple(map(str, implements.names)) if implements else (),
            annotations=items[0],
            span=span_of(items),
            name_span=place_of(name),
            extends_span=place_of(extends.names[0]) if extends else Span(0, 0),
            implements_spans=tuple(map(place_of, implements.names)) if implements else (),
            queue_span=place_of(queue),
        )

    def names(self, items: Children) -> Names:
        return Names(str(items[0]), tuple(tokens_of(items, "ID")), span_of(items))

    extends_class = implements = extends_interfaces = names

    def interface(self, items: Children) -> m.Interface:
        name = tokens_of(items, "ID")[0]
        extends = first_of(items, Names)
        return m.Interface(
            str(name),
            nodes_of(items, m.MessageServer),
            tuple(map(str, extends.names)) if extends else (),
            items[0],
            span_of(items),
            place_of(name),
            tuple(map(place_of, extends.names)) if extends else (),
        )

    def known_rebecs(self, items: Children) -> m.KnownRebecs:
        return m.KnownRebecs(nodes_of(items, m.Declaration), span_of(items))

    def state_vars(self, items: Children) -> m.StateVars:
        return m.StateVars(nodes_of(items, m.Declaration), span_of(items))

    def constructor(self, items: Children) -> m.Constructor:
        annotations, name, parameters, body = items
        return m.Constructor(
            str(name), parameters.items, body_of(body), annotations, span_of(items), place_of(name)
        )

    def message_server(self, items: Children) -> m.MessageServer:
        name = tokens_of(items, "ID")[0]
        return m.MessageServer(
            str(name),
            items[-2].items,
            body_of(items[-1]),
            bool(tokens_of(items, "ABSTRACT")),
            items[0],
            span_of(items),
            place_of(name),
        )

    interface_server = message_server

    def method(self, items: Children) -> m.Method:
        *_, type_, name, parameters, body = items
        return m.Method(
            type_,
            str(name),
            parameters.items,
            body_of(body),
            bool(tokens_of(items, "ABSTRACT")),
            items[0],
            span_of(items),
            place_of(name),
        )

    def parameters(self, items: Children) -> Parameters:
        return Parameters(nodes_of(items, m.Parameter), span_of(items))

    def parameter(self, items: Children) -> m.Parameter:
        return m.Parameter(items[0], str(items[1]), span_of(items), place_of(items[1]))

    def declaration(self, items: Children) -> m.Declaration:
        return m.Declaration(items[1], nodes_of(items, m.Declarator), items[0], span_of(items))

    def plain_declaration(self, items: Children) -> m.Declaration:
        return m.Declaration(items[0], nodes_of(items, m.Declarator), (), span_of(items))

    def declarator(self, items: Children) -> m.Declarator:
        initial = items[2] if len(items) > 1 else None
        return m.Declarator(str(items[0]), initial, span_of(items), place_of(items[0]))

    def array_initializer(self, items: Children) -> m.ArrayInitializer:
        values = tuple(i for i in items if not isinstance(i, Token))
        return m.ArrayInitializer(values, span_of(items))

    def type(self, items: Children) -> m.Type:
        return m.Type(str(items[0]), tuple(map(integer, tokens_of(items, "INT"))), span_of(items))

    def annotations(self, items: Children) -> tuple[m.Annotation, ...]:
        return tuple(items)

    def annotation(self, items: Children) -> m.Annotation:
        arguments = listed(items[3]) if len(items) > 3 else ()
        return m.Annotation(str(items[1]), arguments if len(items) > 2 else None, span_of(items))

    def main(self, items: Children) -> m.Main:
        return m.Main(nodes_of(items, m.Rebec), span_of(items))

    def rebec(self, items: Children) -> m.Rebec:
        annotations, type_, name = items[:3]
        colon = next(i for i, t in enumerate(items) if isinstance(t, Token) and t.type == "COLON")
        bindings, arguments = items[4 : colon - 1], items[colon + 2 : -2]
        return m.Rebec(
            type_,
            str(name),
            listed(bindings[0]) if bindings else (),
            listed(arguments[0]) if arguments else (),
            annotations,
            span_of(items),
            place_of(name),
        )
