"""The model patrol.rebeca as tables, for the monitor."""

# flake8: noqa: E501, F401
# ruff: noqa: E501, F401
# fmt: off
from __future__ import annotations

from patrol.monitor_machine import Body, Model, Rebec, Server, Variable

MODEL = Model(
    name="patrol.rebeca",
    code=(
        ("KNOWN", 0, 0, ()),
        ("VAR", 0, 0, ()),
        ("CONST", 3, 0, ()),
        ("MOD", 0, 0, ()),
        ("CONST", 0, 0, ()),
        ("CONST", 3, 0, ()),
        ("SENDBY", 0, 1, ()),
        ("SELF", 0, 0, ()),
        ("CONST", 4, 0, ()),
        ("SEND", 1, 0, ()),
        ("RET", 0, 0, ()),
        ("VAR", 0, 0, ()),
        ("CONST", 1, 0, ()),
        ("ADD", 0, 0, ()),
        ("SETVAR", 0, 0, ()),
        ("LOCAL", 0, 0, ()),
        ("CONST", 2, 0, ()),
        ("MOD", 0, 0, ()),
        ("OFFSET", 2, 1, ()),
        ("CHOICE", 5, 0, (1, 0)),
        ("SETVARAT", 1, 0, ()),
        ("RET", 0, 0, ()),
        ("CONST", 2, 0, ()),
        ("DELAY", 0, 0, ()),
        ("LOCAL", 0, 0, ()),
        ("SETVAR", 0, 0, ()),
        ("SENDER", 0, 0, ()),
        ("SETVAR", 1, 0, ()),
        ("KNOWN", 0, 0, ()),
        ("VAR", 0, 0, ()),
        ("CONST", 0, 0, ()),
        ("SEND", 2, 1, ()),
        ("RET", 0, 0, ()),
        ("CONST", 0, 0, ()),
        ("SETVAR", 0, 0, ()),
        ("SELF", 0, 0, ()),
        ("CONST", 0, 0, ()),
        ("SEND", 1, 0, ()),
        ("RET", 0, 0, ()),
        ("CONST", 0, 0, ()),
        ("SETVAR", 0, 0, ()),
        ("RET", 0, 0, ()),
    ),
    texts=(),
    bodies=(
        Body(0, 0, 0),  # Station.call
        Body(11, 1, 1),  # Station.arrived
        Body(22, 1, 1),  # Cart.drive
        Body(33, 0, 0),  # Station.Station
        Body(39, 0, 0),  # Cart.Cart
    ),
    servers=(
        Server(
            "call",
            0,
            2147483647,
            False,
            (),
        ),
        Server(
            "arrived",
            1,
            2147483647,
            False,
            (Variable("place", "int", ()),),
        ),
        Server(
            "drive",
            2,
            2147483647,
            True,
            (Variable("place", "int", ()),),
        ),
    ),
    rebecs=(
        Rebec(
            name="station",
            node="station",
            class_number=0,
            capacity=4,
            priority=2147483647,
            known=(1,),
            state=(
                Variable("seen", "int", ()),
                Variable("flags", "boolean", (2,)),
            ),
            constructor=3,
            arguments=(),
            dispatch=(-1, 0, 1),
        ),
        Rebec(
            name="cart",
            node="cart",
            class_number=1,
            capacity=3,
            priority=2147483647,
            known=(0,),
            state=(
                Variable("at", "int", ()),
                Variable("last", "rebec", ()),
            ),
            constructor=4,
            arguments=(),
            dispatch=(2, -1, -1),
        ),
    ),
    global_ranks=False,
)
