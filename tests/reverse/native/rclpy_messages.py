"""Messages and services of ROS 2 for the stand-in of rclpy, as modules."""

from __future__ import annotations

import copy
from types import ModuleType


def _message(named: str, constants: dict[str, object] | None = None, /, **fields: object) -> type:
    """A class of messages: only its fields may be given and set, as keywords."""

    def start(self: object, **given: object) -> None:
        for field, default in fields.items():
            setattr(self, field, given.pop(field, copy.copy(default)))
        assert not given, given

    return type(named, (), {**(constants or {}), "__slots__": tuple(fields), "__init__": start})


def message_modules() -> dict[str, ModuleType]:
    whole = ("Int8", "Int16", "Int32", "Int64", "UInt8", "UInt16", "UInt32")
    plain = [_message(name, data=0) for name in whole]
    plain += [_message("Bool", data=False), _message("Float64", data=0.0)]
    plain += [_message("String", data=""), _message("Empty")]
    levels = {"OK": b"\x00", "WARN": b"\x01", "ERROR": b"\x02", "STALE": b"\x03"}
    status = _message("DiagnosticStatus", dict(levels), level=b"\x00", name="", message="")
    result = _message("SetParametersResult", successful=False, reason="")
    ranged = _message("IntegerRange", from_value=0, to_value=0, step=0)
    descriptor = _message("ParameterDescriptor", description="", read_only=False, integer_range=[])
    answer = _message("Response", success=False, message="")
    services = [
        _empty("SetBool", Request=_message("Request", data=False), Response=answer),
        _empty("Trigger", Request=_message("Request"), Response=answer),
    ]
    return dict(
        [
            module("std_msgs.msg", **{t.__name__: t for t in plain}),
            module("diagnostic_msgs.msg", DiagnosticStatus=status),
            module("std_srvs.srv", **{t.__name__: t for t in services}),
            module(
                "rcl_interfaces.msg",
                SetParametersResult=result,
                ParameterDescriptor=descriptor,
                IntegerRange=ranged,
            ),
            *(module(n) for n in ("std_msgs", "diagnostic_msgs", "std_srvs", "rcl_interfaces")),
        ]
    )


def _empty(name: str, /, **members: object) -> type:
    return type(name, (), members)


def module(name: str, /, **content: object) -> tuple[str, ModuleType]:
    module = ModuleType(name)
    module.__dict__.update(content)
    module.__path__ = []
    return name, module
