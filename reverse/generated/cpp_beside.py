"""What people add to the set-up of a class of generated code that touches nothing of the model.

Statements that log, check or describe parameters; services, further subscriptions and callbacks of
parameters whose functions only look at what the model has.
"""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_hiding import names_given
from rebsync.reverse.bodies.effects.cpp_call_effects import is_calm
from rebsync.reverse.bodies.effects.cpp_effects import Effects
from rebsync.reverse.bodies.effects.touches import Touches
from rebsync.reverse.bodies.scope import Called, Inline, Outside, Scope, Variable, meant_by
from rebsync.reverse.findings import Unread
from rebsync.reverse.generated.cpp_names import declared_type
from rebsync.reverse.generated.cpp_parameters import deciding_parameter, is_own_parameter
from rebsync.reverse.generated.cpp_roles import parameters_of
from rebsync.reverse.generated.cpp_timers import MAKES, has_period, makes
from rebsync.reverse.generated.parameters import READS
from rebsync.reverse.generated.ros2_words import arguments_in
from rebsync.reverse.generated.slicing.publishers import OFFERS, is_free
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, calls_in, string_of
from rebsync.reverse.syntax.cpp_enclosing import locals_referred_to
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, named, part, squeezed, text_of

# What a node is given to call: it tells of itself, and is told what others want to know.
_SERVES = frozenset({"create_service", "advertiseService"})
_HEARS = frozenset({"create_subscription", "subscribe"})
# What calls back to be told how the node does, or what people set.
_CALLING = re.compile(
    r"(?:std::(?:unique|shared)_ptr<)?(?:diagnostic_updater::Updater|dynamic_reconfigure::Server<.*>)>?"
)
_GLOBAL = "global"  # the handle by which generated code reads the constants of the model
_SETS = "add_on_set_parameters_callback"
_REGISTERS = (
    OFFERS
    | MAKES
    | READS
    | {
        *(
            "subscribe",
            "subscribeOnBridge",
            "create_subscription",
            "create_client",
            "serviceClient",
        ),
        *("advertiseAll", "create_callback_group", "getParam", "get_parameter", "has_parameter"),
        *("set_parameter", "set_parameters", "setParam", "declare_parameters", "shared_from_this"),
    }
)
_STATE = "publishState"
_HANDS = ("lambda_expression", "this")
# What only tells where frames are, whatever node makes it.
_FRAMES = re.compile(r"std::make_(?:unique|shared)<tf2_ros::(?:Static)?TransformBroadcaster>")
_HANDLES = frozenset({"", "this", "node", "ros::NodeHandle(node)", "ros::NodeHandle()"})


@dataclass(slots=True)
class Beside:
    """Looks through the statements of a constructor, or of another function, one after the other.

    `scope` is what people's bodies can name; what the function is given belongs to the model.
    """

    code: Code
    function: CppFunction
    scope: Scope
    effects: Effects

    @classmethod
    def of(cls, code: Code, function: CppFunction, scope: Scope) -> Beside:
        """For a function, from its first statement on."""
        given = {p.name: declared_type(code, p.type) for p in function.parameters}
        known: dict[str, Variable | Outside] = {
            name: Variable(name, type_) if type_ is not None else Outside(reaches=True)
            for name, type_ in (*given.items(), *((n, None) for n, _ in arguments_in(function)))
        }
        for name, _ in arguments_in(function):
            known[name] = Variable(name, None)
        inside_ = scope.with_locals(known)
        return cls(code, function, inside_, Effects(function.cpp, inside_))

    def takes(self, statement: Node) -> bool:
        """Whether a statement touches nothing of the model, now or later, and does not throw."""
        if self._raises(statement):
            return False
        return self._calls_back(statement) or self._touches_nothing(statement)

    def is_outside(self, statement: Node) -> bool:
        """Whether a statement after each body touches nothing of the model, nor throws."""
        return not self._raises(statement) and self._touches_nothing(statement)

    def _raises(self, statement: Node) -> bool:
        form = self.scope.form
        return form is not None and form.raises(self.function.cpp, statement) is not None

    def _touches_nothing(self, statement: Node) -> bool:
        frames = [n for c in calls_in(statement) if _tells_frames(c) for n in c.arguments]
        made = {n.id for a in frames for n in inside(a, *_HANDS)}
        handed = [n for n in inside(statement, *_HANDS) if n.id not in made]
        if any(map(_hands_on, handed)):
            return False
        if any(self._registers(c) for c in calls_in(statement)):
            return False
        if any(name in self.scope.members or name == _GLOBAL for name in _declared(statement)):
            return False  # what follows means the local by it
        before = set(self.effects.inner)
        try:
            for each in self._decided(statement):
                self.effects.check(each)
        except Unread:
            self.effects.inner = before
            return False
        return True

    def _decided(self, statement: Node) -> list[Node]:
        """The branches of an `if` that asks for a parameter of people; else the statement."""
        if deciding_parameter(self.code, self.function, statement) is None:
            return [statement]
        ways = [part(statement, "consequence"), statement.child_by_field_name("alternative")]
        return [way for way in ways if way is not None]

    def _registers(self, call: CppCall) -> bool:
        """Whether a call makes something of ROS, or gets what the model's parameters say."""
        if call.name not in READS:
            return call.name.rpartition("::")[2] in _REGISTERS
        keys = [n for cpp in self.code.files for n in inside(cpp.root, "string_literal")]
        key = [squeezed(n) for n in call.arguments[:1]]
        is_once = [[squeezed(n)] for n in keys].count(key) == 1
        return not (is_once and is_own_parameter(call.node))

    def _calls_back(self, statement: Node) -> bool:
        """Whether it offers a service, or has set parameters looked at, and keeps what it gets."""
        inner = named(statement)[0] if statement.type == "expression_statement" else None
        if inner is not None and inner.type == "assignment_expression":
            kept = self.scope.members.get(text_of(part(inner, "left")).removeprefix("this->"))
            inner = part(inner, "right") if isinstance(kept, Outside) else None
        call = call_of(inner) if inner is not None else None
        if call is None:
            return False
        on = squeezed(call.target) if call.target is not None else ""
        if _CALLING.fullmatch(self._type_of(on)):
            return self._is_told(call)
        if on not in _HANDLES:
            return False
        first, *others = call.arguments or (call.node,)
        if makes(call):
            return self.is_idle_timer(call)
        if call.name in _SERVES:
            return string_of(first) is not None and bool(others) and self._is_calm(others)
        if call.name in _HEARS:
            is_plain = len(others) > 1 and not inside(others[0], "lambda_expression")
            return is_plain and is_free(self.code, first) and self._is_calm(others[1:])
        is_set = call.name == _SETS and bool(call.arguments)
        return is_set and self._is_calm(call.arguments) and self._agrees(call)

    def _type_of(self, member: str) -> str:
        """The type of a member, without its layout."""
        owner = self.code.classes.get(self.function.owner)
        fields = owner.fields if owner is not None else ()
        name = member.removeprefix("this->")
        return next((squeezed(f.type) for f in fields if f.name == name), "")

    def _is_told(self, call: CppCall) -> bool:
        """Whether an object that tells people, or is told by them, calls what touches nothing."""
        match call.name, call.arguments:
            case (("setHardwareID" | "setHardwareIDf" | "setPeriod"), arguments):
                return not any(inside(a, *_HANDS, "assignment_expression") for a in arguments)
            case "setCallback", arguments if arguments:
                return self._is_calm(arguments)
            case "add", [_, *callback] if callback:
                return self._is_calm(callback[::-1])
            case _:
                return False

    def is_idle_timer(self, call: CppCall) -> bool:
        """Whether what a timer calls touches nothing of the model."""
        arguments = list(call.arguments)
        if call.name.startswith("rclcpp::"):
            arguments = arguments[2:]
        if len(arguments) < 2 or inside(arguments[0], "lambda_expression", "assignment_expression"):
            return False
        owner = self.code.classes.get(self.function.owner)
        is_seldom = owner is not None and has_period(self.code, owner, self.function.cpp, call)
        return is_seldom and self._is_calm(arguments[1:])

    def _is_calm(self, callback: list[Node] | tuple[Node, ...]) -> bool:
        """Whether what is called back touches nothing of the model: a lambda, or a method."""
        first, *others = callback
        if first.type == "lambda_expression":
            return not others and self._looks(first)
        if (bound := call_of(first)) is not None and bound.name in ("std::bind", "boost::bind"):
            first, *others = bound.arguments or (first,)
            others = [a for a in others if not text_of(a).startswith(("std::placeholders", "_"))]
        if not text_of(first).startswith("&") or [a.type for a in others] != ["this"]:
            return False
        name = text_of(first).rpartition("::")[2]
        own = self.scope.functions.get(name)
        meant = meant_by(own, name, -1) if isinstance(own, Called | Inline) else ()
        found = meant or self.code.definitions.get((self.function.owner, name), ())
        return len(found) == 1 and is_calm(Effects(self.function.cpp, self.scope), found[0])

    def observes(self, call: CppCall) -> bool:
        """Whether a lambda has the state published, and else does what touches nothing."""
        lambda_ = call.arguments[-1] if call.arguments else call.node
        if lambda_.type != "lambda_expression":
            return False
        statements = named(part(lambda_, "body"))
        told = [s for s in statements if _publishes(s)]
        return len(told) == 1 and self._looks(lambda_, [s for s in statements if s not in told])

    def _looks(self, lambda_: Node, only: list[Node] | None = None) -> bool:
        captured = inside(lambda_, "lambda_capture_specifier")
        if captured and squeezed(captured[0]) not in ("[]", "[this]", "[=]", "[&]"):
            return False
        if locals_referred_to(lambda_, self.function):
            return False
        checked = [part(lambda_, "body")] if only is None else only
        inner = {p.name for p in parameters_of(lambda_)}
        effects = Effects(self.function.cpp, self.scope, returning=only is None, inner=inner)
        try:
            for each in checked:
                effects.check(each)
        except (Touches, RecursionError):
            return False
        return _STATE not in effects.inner and not any(map(self._raises, checked))

    def _agrees(self, call: CppCall) -> bool:
        """Whether each way through a callback says that it takes what is set."""
        bodies = [call.arguments[0]]
        for function in self.code.definitions.get((self.function.owner, _method(call)), ()):
            bodies = [function.node]
        stores = [n for b in bodies for n in inside(b, "assignment_expression")]
        said = [n for n in stores if text_of(part(n, "left")).endswith(".successful")]
        is_first = len({text_of(part(n, "left")) for n in said}) == 1
        return (
            is_first
            and all(text_of(part(n, "right")) == "true" for n in said)
            and all(
                n.parent is not None
                and n.parent.parent is not None
                and n.parent.parent.parent is not None
                and n.parent.parent.parent.type in ("lambda_expression", "function_definition")
                for n in said[:1]
            )
        )


def _publishes(statement: Node) -> bool:
    """Whether a statement is a call of the function that publishes the state."""
    inner = named(statement)[:1] if statement.type == "expression_statement" else []
    call = call_of(inner[0]) if inner else None
    return call is not None and text_of(part(call.node, "function")) in (_STATE, f"this->{_STATE}")


def _declared(statement: Node) -> set[str]:
    """The names that a statement declares for those that follow it."""
    if statement.type != "declaration":
        return set(names_given(statement))
    found = statement.children_by_field_name("declarator")
    names = (d.child_by_field_name("declarator") or d for d in found)
    variables = {text_of(n) for d in names for n in inside(d, "identifier")}
    return variables | {*names_given(statement)}


def _tells_frames(call: CppCall) -> bool:
    """Whether a call makes an object that tells where frames are, and is given the node for it."""
    return _FRAMES.fullmatch("".join(call.name.split())) is not None


def _method(call: CppCall) -> str:
    bound = call_of(call.arguments[0])
    first = bound.arguments[0] if bound is not None and bound.arguments else call.arguments[0]
    return text_of(first).rpartition("::")[2]


def _hands_on(node: Node) -> bool:
    """Whether a lambda, or the object itself, is handed to somebody."""
    above = node.parent
    return node.type == "lambda_expression" or above is None or above.type != "field_expression"
