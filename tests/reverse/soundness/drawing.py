"""Random bodies of callbacks: a part of C++ that is as wide as it can be without undefined effects.

Integers wrap (`-fwrapv`), divisors are constants other than zero, loops are bounded, indices are
inside of their arrays. What a body may call is drawn before it, so no call ever comes back.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from random import Random

# Names that the code may well use, and a model may not.
LOCALS = ("x", "n", "a", "b", "count", "self", "now", "after", "delay", "sender", "data", "value")
INTEGERS = ("int", "int8_t", "int16_t", "uint8_t")
WIDE = ("unsigned", "int64_t", "uint32_t", "size_t", "long")
LIMIT = 2  # of nested statements


@dataclass(frozen=True)
class Variable:
    """A variable that an expression may name: `type` is that of C++, `length` of an array."""

    name: str
    type: str
    length: int = 0
    constant: bool = False


@dataclass(frozen=True)
class Helper:
    """A function that a body may call; only one without a result has effects.

    C++ leaves open in which order the parts of an expression are computed.
    """

    name: str
    result: str
    parameters: tuple[str, ...]
    member: bool = True


@dataclass(frozen=True)
class Publisher:
    """A publisher with the message's type and its fields by their paths."""

    name: str
    message: str
    fields: tuple[tuple[str, str], ...]


@dataclass
class Body:
    """Draws the statements of one body.

    `opaque` ones have values that no reader can know; `members` says that it is one's function.
    `message` is the type of what the callback takes, `callable` are other callbacks.
    """

    random: Random
    variables: list[Variable]
    helpers: list[Helper]
    publishers: list[Publisher]
    timers: list[str] = field(default_factory=list)
    handle: str = "nh_"
    result: str = "void"
    opaque: bool = True
    members: bool = True
    used: set[str] = field(default_factory=set)
    looping: int = 0
    odd: Callable[[Body], list[str]] | None = None
    message: str = ""
    by_value: bool = False
    callable: list[str] = field(default_factory=list)
    integers: tuple[str, ...] = INTEGERS

    @property
    def is_wide(self) -> bool:
        """Whether there are numbers wider than those of models."""
        return self.integers != INTEGERS

    @property
    def taken(self) -> tuple[str, ...]:
        """The types of other numbers that messages have."""
        return ("uint64_t",) if self.is_wide else ()

    # --- expressions ----------------------------------------------------------------------------

    def one(self, *options: Callable[[], str]) -> str:
        return self.random.choice(options)()

    def chance(self, percent: int) -> bool:
        return self.random.randrange(100) < percent

    def of(self, *types: str, writable: bool = False) -> list[Variable]:
        """The plain variables of these types."""
        return [
            v
            for v in self.variables
            if v.type in types and not v.length and not (writable and v.constant)
        ]

    def number(self) -> str:
        return str(self.random.choice((0, 1, 1, 2, 3, 4, 5, 7, 10, 100, 200, 300, 40000)))

    def integer(self, depth: int = 0) -> str:
        """An expression of an integer type."""
        known = self.of(*self.integers, "uint16_t", *self.taken)
        if depth > 2 or self.chance(30):
            return self.random.choice(known).name if known and self.chance(70) else self.number()
        left, right = self.integer(depth + 1), self.integer(depth + 1)
        return self.one(
            lambda: f"{left} {self.random.choice('+-*')} {right}",
            lambda: f"({left} {self.random.choice('+-&|^')} {right})",
            lambda: f"({left}) {self.random.choice('/%')} {self.random.choice((2, 3, 7, -3))}",
            lambda: f"({left}) {self.random.choice(('<<', '>>'))} {self.random.randrange(6)}",
            lambda: f"-({left})",
            lambda: f"~{self.number()}",
            lambda: f"({self.boolean(depth + 1)} ? {left} : {right})",
            lambda: f"static_cast<{self.random.choice(self.integers)}>({left})",
            lambda: f"({self.random.choice(self.integers)})({left})",
            lambda: f"int({left})",
            lambda: f"std::{self.random.choice(('min', 'max'))}<int>({left}, {right})",
            lambda: self._magnitude(left),
            lambda: self._element(depth) or left,
            lambda: self._called("int", depth) or right,
            lambda: f"static_cast<int>({self.real(depth + 1)})",
            lambda: f"({self.boolean(depth + 1)})",
        )

    def _magnitude(self, inner: str) -> str:
        if self.is_wide:
            return f"std::abs(static_cast<int>({inner}))"
        return f"std::abs({inner})" if inner.isidentifier() else f"abs(({inner}) % 1000)"

    def _element(self, depth: int, writable: bool = False) -> str:
        arrays = [v for v in self.variables if v.length and not (writable and v.constant)]
        if not arrays:
            return ""
        array = self.random.choice(arrays)
        index = self.integer(depth + 1)
        inside = f"({index}) & {array.length - 1}"
        index = self.random.choice((inside, str(self.random.randrange(array.length))))
        return f"{array.name}[{index}]"

    def _called(self, result: str, depth: int) -> str:
        """A call in an expression, which has effects where the function has."""
        fitting = [h for h in self.helpers if h.result == result]
        if not fitting or depth > 1:
            return ""
        return self.call(self.random.choice(fitting), depth)

    def call(self, helper: Helper, depth: int = 0) -> str:
        arguments = []
        for type_ in helper.parameters:
            targets = self.of("int", writable=True)
            if type_ == "int&" and not targets:
                return ""
            by_reference = type_ == "int&"
            arguments.append(
                self.random.choice(targets).name if by_reference else self.integer(depth + 1)
            )
        return f"{helper.name}({', '.join(arguments)})"

    def boolean(self, depth: int = 0) -> str:
        """A condition."""
        known = self.of("bool")
        if depth > 2:
            return self.random.choice(known).name if known else "true"
        compared = self.random.choice(("<", ">", "<=", ">=", "==", "!="))
        return self.one(
            lambda: f"{self.integer(depth + 1)} {compared} {self.integer(depth + 1)}",
            lambda: f"{self.integer(depth + 1)} {compared} {self.number()}",
            lambda: f"{self.real(depth + 1)} {compared} {self.real(depth + 1)}",
            lambda: self.random.choice(known).name if known else "false",
            lambda: f"!({self.boolean(depth + 1)})",
            lambda: f"({self.boolean(depth + 1)} && {self.boolean(depth + 1)})",
            lambda: f"({self.boolean(depth + 1)} || {self.boolean(depth + 1)})",
            lambda: self._unknown() if self.opaque else "true",
            lambda: self._called("bool", depth) or "false",
            lambda: self._mode(compared) or "true",
        )

    def _mode(self, compared: str) -> str:
        modes = self.of("Mode")
        return f"{self.random.choice(modes).name} {compared} RUN" if modes else ""

    def _unknown(self) -> str:
        """A condition that no reader can know."""
        return self.one(
            lambda: "topic_tools::ready()",
            lambda: f"topic_tools::level() > {self.random.randrange(4)}",
            lambda: "topic_tools::ratio() < 0.5",
            lambda: "table_.empty()",
            lambda: f"table_.count({self.integer(2)}) > 0",
            lambda: 'label_ == "go"',
        )

    def real(self, depth: int = 0) -> str:
        """An expression of floating type."""
        known = self.of("double", "float")
        constant = self.random.choice(("0.5", "1.0", "2.5", "-0.25"))
        if not known or depth > 1:
            return self.random.choice(known).name if known else constant
        name = self.random.choice(known).name
        return self.one(
            lambda: name,
            lambda: constant,
            lambda: f"({name} + {constant})",
            lambda: f"{name} * {constant}",
            lambda: f"static_cast<double>({self.integer(depth + 1)})",
            lambda: f"-{name}",
        )

    def expression(self, type_: str) -> str:
        match type_:
            case "bool":
                return self.boolean()
            case "double" | "float":
                return self.real()
            case "Mode":
                return self.random.choice(("IDLE", "Mode::RUN", "STOP"))
            case _:
                return self.integer()

    # --- statements -----------------------------------------------------------------------------

    def block(self, depth: int, most: int = 4) -> list[str]:
        """Statements in braces: their locals end with them."""
        outside = list(self.variables)
        lines: list[str] = []
        for _ in range(self.random.randint(1, max(1, most - depth))):
            lines += self.statement(depth)
        self.variables = outside
        return ["{", *(f"  {line}" for line in lines), "}"]

    def statement(self, depth: int) -> list[str]:
        flat = (self._assign, self._assign, self._declare, self._publish, self._call, self._outside)
        nested = (self._if, self._if, self._for, self._while, self._switch, self._early)
        if self.odd is not None and self.chance(60 if self.is_wide else 25):
            return self.odd(self)
        if depth < LIMIT and self.chance(45):
            return self.random.choice(nested)(depth)
        return self.random.choice(flat)()

    def _assign(self) -> list[str]:
        targets = self.of(*self.integers, "bool", "double", "Mode", writable=True)
        if self.chance(20) and (element := self._element(1, writable=True)):
            return [f"{element} {self.random.choice(('=', '+='))} {self.integer()};"]
        if not targets:
            return []
        target = self.random.choice(targets)
        if target.type in self.integers and self.chance(30):
            return [self.random.choice((f"{target.name}++;", f"--{target.name};"))]
        if target.type in self.integers and self.chance(40):
            operator = self.random.choice(("+=", "-=", "*=", "|=", "&=", "^="))
            return [f"{target.name} {operator} {self.integer()};"]
        return [f"{target.name} = {self.expression(target.type)};"]

    def _declare(self) -> list[str]:
        free = [n for n in LOCALS if n not in self.used]
        if not free:
            return []
        name = self.random.choice(free)
        self.used.add(name)
        if self.opaque and self.chance(15):
            self.variables.append(Variable(name, "int"))
            return [f"int {name} = topic_tools::level();  // rebsync: domain 0..5"]
        types: tuple[str, ...] = ("int", "int", "bool", "double", "int8_t", "int16_t")
        type_ = self.random.choice((*types, *WIDE) if self.is_wide else types)
        shown = self.random.choice((type_, f"const {type_}"))
        value = self.expression(type_)
        if type_ in ("int", "bool", "double", *WIDE) and self.chance(30):
            shown, value = "auto", f"static_cast<{type_}>({value})"
        self.variables.append(Variable(name, type_, constant=shown.startswith("const")))
        return [f"{shown} {name} = {value};"]

    def _publish(self) -> list[str]:
        if self.timers and self.chance(8):
            seconds, timer = self.random.randint(1, 4), self.random.choice(self.timers)
            made = f"{self.handle}.createTimer(ros::Duration({seconds}), {timer}, true)"
            return [f"once_ = {made};"]
        if not self.publishers:
            return []
        publisher = self.random.choice(self.publishers)
        free = [n for n in ("out", "msg_out", "reply", "m") if n not in self.used]
        if not free:
            return []
        name = free[0]
        self.used.add(name)
        filled = [
            f"{path} = {self.expression(t)};" for path, t in publisher.fields if self.chance(85)
        ]
        if self.chance(20):
            made = f"auto {name} = boost::make_shared<{publisher.message}>();"
            return [made, *(f"{name}->{f}" for f in filled), f"{publisher.name}.publish({name});"]
        made = f"{publisher.message} {name};"
        return [made, *(f"{name}.{f}" for f in filled), f"{publisher.name}.publish({name});"]

    def _call(self) -> list[str]:
        effective = [h for h in self.helpers if h.result == "void"]
        if not effective:
            return []
        call = self.call(self.random.choice(effective))
        return [f"{call};"] if call else []

    def _outside(self) -> list[str]:
        return [
            self.one(
                lambda: 'ROS_INFO("x %d", 1);',
                lambda: f"topic_tools::record({self.integer(2)});",
                *(self._stored if self.members else lambda: "std::cout << 1;" for _ in range(3)),
                lambda: "ros::Duration(1.0).sleep();" if self.result == "void" else "assert(true);",
            )
        ]

    def _stored(self) -> str:
        return self.one(
            lambda: f"table_[{self.integer(2)}] = {self.integer(2)};",
            lambda: 'label_ = "go";',
            lambda: "table_.clear();",
        )

    def _if(self, depth: int) -> list[str]:
        lines = [f"if ({self.boolean()}) " + "{", *self.block(depth + 1)[1:]]
        if self.chance(30):
            lines[-1] = f"}} else if ({self.boolean()}) {{"
            lines += self.block(depth + 1)[1:]
        if self.chance(40):
            lines[-1] = "} else {"
            lines += self.block(depth + 1)[1:]
        return lines

    def _early(self, depth: int) -> list[str]:
        leave = "return;" if self.result == "void" else f"return {self.expression(self.result)};"
        if self.looping and self.chance(70):
            leave = self.random.choice(("break;", "continue;"))
        return [f"if ({self.boolean(1)}) {leave}"]

    def _loop(self, depth: int) -> list[str]:
        self.looping += 1
        body = self.block(depth + 1, 3)
        self.looping -= 1
        return body

    def _for(self, depth: int) -> list[str]:
        arrays = [v for v in self.variables if v.length]
        index = next((n for n in ("i", "j", "k") if n not in self.used), None)
        if index is None:
            return []
        self.used.add(index)
        outside = list(self.variables)
        if arrays and self.chance(40):
            array = self.random.choice(arrays)
            by = self.random.choice(("int", "auto", "const auto&", "auto&"))
            by = "int" if array.constant and by == "auto&" else by
            self.variables.append(Variable(index, "int", constant="const" in by))
            head = f"for ({by} {index} : {array.name}) "
        else:
            self.variables.append(Variable(index, "int", constant=True))
            step = self.random.choice((f"{index}++", f"++{index}", f"{index} += 2"))
            by = self.random.choice(("int", *WIDE)) if self.is_wide else "int"
            head = f"for ({by} {index} = 0; {index} < {self.random.randint(1, 4)}; {step}) "
        body = self._loop(depth)
        self.variables = outside
        return [head + "{", *body[1:]]

    def _while(self, depth: int) -> list[str]:
        counter = next((n for n in ("left", "tries", "more") if n not in self.used), None)
        if counter is None:
            return []
        self.used.add(counter)
        outside = list(self.variables)
        self.variables.append(Variable(counter, "int", constant=True))
        by = self.random.choice(("int", *WIDE)) if self.is_wide else "int"
        made = f"{by} {counter} = {self.random.randint(1, 3)};"
        body = self._loop(depth)
        self.variables = outside
        if self.chance(50):
            return [made, f"while ({counter}-- > 0) {{", *body[1:]]
        return [made, "do {", *body[1:-1], f"}} while (--{counter} > 0);"]

    def _switch(self, depth: int) -> list[str]:
        modes = self.of("Mode")
        named = bool(modes) and self.chance(60)
        subject = self.random.choice(modes).name if named else self.integer(1)
        labels = ["Mode::IDLE", "RUN", "STOP"] if named else ["0", "1", "2", "3"]
        lines = [f"switch ({subject}) {{"]
        looping, self.looping = self.looping, 0
        for label in self.random.sample(labels, self.random.randint(1, len(labels))):
            ends = self.chance(70)
            lines += [f"  case {label}: {{", *(f"    {x}" for x in self.block(depth + 1, 2)[1:-1])]
            lines += ["    break;"] if ends else []
            lines += ["  }"]
        if self.chance(50):
            lines += ["  default:", *(f"    {x}" for x in self._assign())]
            lines += ["    break;"]
        self.looping = looping
        return [*lines, "}"]

    def lines(self) -> Iterator[str]:
        """The lines of the whole body, with what it returns at its end."""
        yield from self.block(0, 5)[1:-1]
        if self.result != "void":
            yield f"  return {replace(self).expression(self.result)};"
