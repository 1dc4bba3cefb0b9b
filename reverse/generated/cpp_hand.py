"""What people put into classes of generated code that no generator writes.

A body that has such forms in it is read as people's own code is: by what it does.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from dataclasses import replace

from rebsync.reserved import RUNTIME_FUNCTIONS
from rebsync.reverse.bodies.scope import Around, Function, Inline, Member, Outside, Scope
from rebsync.reverse.generated.cpp_free import has_plain_types, is_template, passed_by_reference
from rebsync.reverse.generated.cpp_idle import working
from rebsync.reverse.generated.slicing.publishers import telling_publishers
from rebsync.reverse.syntax.cpp_calls import calls_in
from rebsync.reverse.syntax.cpp_declarations import with_defaults
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, text_of

# Types whose objects do nothing by themselves, and know of no node.
_PASSIVE = re.compile(
    r"(?:mutable\s+)?(?:std::(?:(?:recursive_|timed_|shared_)?mutex|string|vector<.*>|map<.*>"
    r"|set<.*>|deque<.*>|list<.*>|queue<.*>|optional<.*>|unordered_map<.*>|pair<.*>|tuple<.*>"
    r"|o?stringstream|ofstream|mt19937(?:_64)?|default_random_engine|random_device"
    r"|uniform_int_distribution<.*>|chrono::[\w:<>, ]+)"
    r"|(?:std::(?:unique|shared)_ptr<)?tf2_ros::(?:Static)?TransformBroadcaster>?"
    r"|(?:std::(?:unique|shared)_ptr<)?"
    r"(?:diagnostic_updater::Updater|dynamic_reconfigure::Server<.*>)>?"
    r"|rclcpp::node_interfaces::OnSetParametersCallbackHandle::SharedPtr"
    r"|(?:ros|rclcpp)::(?:Wall)?(?:Time|Duration)|rclcpp::Logger|rclcpp::Clock(?:::SharedPtr)?)\Z",
    re.DOTALL,
)
_REFERS = ("pointer_declarator", "reference_declarator")


def as_by_hand(
    code: Code, owner: CppClass, shown: Collection[tuple[str, str]], scope: Scope
) -> Scope:
    """What a body of a class can name, for a reader of what people write.

    `shown` are types of messages with topics that nobody in the code hears.
    """
    members: dict[str, Member] = dict(scope.members)
    for above in code.lineage(owner.name):
        for name in _referring(above):
            members[name] = Outside(reaches=True)
        if scope.form is not None:
            members |= telling_publishers(code, scope.form, above, shown)
    functions: dict[str, Function] = dict(scope.functions)
    free = (f for (of, _), found in code.definitions.items() if not of for f in found)
    own = (f for above in code.lineage(owner.name) for f in code.functions_of(above))
    for function in (*free, *own):
        known = functions.get(function.name, Around())
        if isinstance(known, Around) and stands_in(code, owner, function):
            made = _with_defaults(owner, function)
            functions[function.name] = Inline(made, code.constants_for(function.cpp))
    return replace(scope, members=members, functions=functions, open=True, macros=code.macros)


def stands_in(code: Code, owner: CppClass, function: CppFunction) -> bool:
    """Whether the body of a function can stand where it is called: no method says what it does."""
    of = function.owner
    same = [f for f in code.functions_of(owner) if f.name == function.name] if of else []
    known = function.markers or function.name in RUNTIME_FUNCTIONS or function.name == "main"
    if known or len(same) > 1 or function.body is None or function.pure:
        return False
    if not of and len(code.definitions.get(("", function.name), ())) != 1:
        return False
    refers = function.gives_place or is_template(function)
    refers = refers or any(True for _ in passed_by_reference(function))
    defaults = any(p.default is not None for p in _with_defaults(owner, function).parameters)
    return refers or defaults or not has_plain_types(function)


def only_logs(code: Code, owner: CppClass, function: CppFunction) -> bool:
    """Whether a function does nothing but to log, as all of its name: the model has none of them.

    Where the model has one of them, the compiler chooses among them by what they are given.
    """
    return all(_logs(f) for f in code.functions_of(owner) if f.name == function.name)


def _logs(function: CppFunction) -> bool:
    void = function.result is not None and text_of(function.result) == "void"
    known = function.markers or function.pure or function.body is None
    logs = next(calls_in(function.body), None) is not None
    return void and not known and logs and not working(function.body)


def _with_defaults(owner: CppClass, function: CppFunction) -> CppFunction:
    return with_defaults(function, [f for f in owner.functions if f.name == function.name])


def is_passive(type_: str) -> bool:
    """Whether objects of a type that the model lacks do nothing by themselves.

    What bodies do with them is found there.
    """
    return _PASSIVE.match(" ".join(type_.split())) is not None


def acts(type_: str) -> bool:
    """Whether functions of an object of such a type may act on the node."""
    return type_.startswith(("ros::", "rclcpp::")) and not is_passive(type_)


def _referring(owner: CppClass) -> Iterator[str]:
    """The members that are pointers or references: to what, is not known."""
    for field in inside(owner.node, "field_declaration"):
        for declarator in field.children_by_field_name("declarator"):
            if declarator.type in _REFERS:
                yield text_of(declarator.named_children[-1])
