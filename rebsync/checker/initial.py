"""The message `initial` of core Rebeca up to 2.0: each rebec has it in its queue at the start."""

from __future__ import annotations

from dataclasses import replace

from rebsync.model import (
    Block,
    Call,
    ClassMember,
    Constructor,
    ExpressionStatement,
    MessageServer,
    Model,
    Name,
    ReactiveClass,
    Self,
)


def with_initial(model: Model) -> Model:
    """The model with a constructor that sends `initial`, in classes that have only that server."""
    classes = tuple(_begun(c) if isinstance(c, ReactiveClass) else c for c in model.classes)
    return replace(model, classes=classes)


def _begun(declared: ReactiveClass) -> ReactiveClass:
    constructors = [m for m in declared.members if isinstance(m, Constructor)]
    servers = [m for m in declared.members if isinstance(m, MessageServer)]
    initial = next((s for s in servers if s.name == "initial"), None)
    if constructors or initial is None or initial.body is None or declared.extends:
        return declared
    arguments = tuple(Name(p.name, span=p.span) for p in initial.parameters)
    call = Call(Self(span=initial.name_span), "initial", arguments, span=initial.name_span)
    statement = ExpressionStatement(call, span=initial.name_span)
    body = Block((statement,), span=initial.span)
    constructor: ClassMember = Constructor(
        declared.name,
        initial.parameters,
        body,
        span=initial.span,
        name_span=initial.name_span,
    )
    return replace(declared, members=(*declared.members, constructor))
