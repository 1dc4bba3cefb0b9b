"""Statements that people write now and then, and that are easily read wrongly."""

from __future__ import annotations

from collections.abc import Callable

from tests.reverse.soundness.drawing import WIDE, Body, Variable


def odd_statement(body: Body) -> list[str]:
    """One of them, if there is what it needs."""
    if body.is_wide and body.chance(70):
        return _wide(body) if body.chance(75) else _unknown(body)
    return body.random.choice(_ALL)(body)


def _name(body: Body, *wishes: str) -> str | None:
    """A name that the body does not have yet."""
    name = next((w for w in wishes if w not in body.used), None)
    if name is not None:
        body.used.add(name)
    return name


def _plain(body: Body, *types: str) -> str | None:
    """A variable that may be written."""
    found = body.of(*types, writable=True)
    return body.random.choice(found).name if found else None


def _effect_inside(body: Body) -> list[str]:
    """An expression with an effect in the middle of another."""
    target, other = _plain(body, "int"), _plain(body, *body.integers)
    if target is None or other is None or target == other:
        return []
    number = body.number()
    return [
        body.one(
            lambda: f"if ({other}++ > {number}) {target} = {number};",
            lambda: f"{target} = {other}-- + {number};",
            lambda: f"if ({body.boolean(2)} && ({target} = {number}) > 2) {other} = 1;",
            lambda: f"if ({body.boolean(2)} || {other}++ > 1) {target} = 1;",
            lambda: f"{target} = {other} = {number};",
            lambda: f"{target} = ({other} += 2) * 2;",
            lambda: f"{target} = {body.boolean(2)} ? {other}++ : {number};",
            lambda: f"{target} = {other}, ++{other};",
        )
    ]


def _mixed(body: Body) -> list[str]:
    """Conversions that C++ makes unasked."""
    flag, whole, real = _plain(body, "bool"), _plain(body, *body.integers), _plain(body, "double")
    lines = []
    if flag is not None:
        lines += [
            f"{flag} = {body.integer(2)};",
            f"{flag} |= {body.boolean(2)};",
            f"{flag} = {flag} + {body.boolean(2)};",
            f"{flag} ^= {body.boolean(2)};",
            f"if ({body.integer(2)}) {flag} = !{flag};",
        ]
    if whole is not None and flag is not None:
        lines += [f"{whole} += {flag};", f"{whole} = {flag} ? {whole} : 'a';"]
    if whole is not None:
        lines += [f"{whole} = {body.real(1)};", f"{whole} += 0.5;", f"{whole} *= 1.5;"]
        lines += [f"{whole} = 0x1F + 010;", f"{whole} = {whole} / 2.0;"]
    if real is not None:
        lines += [f"{real} = {body.integer(2)};", f"{real} = {body.integer(2)} / 2;"]
        lines += [f"{real} = std::floor({real});", f"{real} = 0.1f;", f"{real}++;"]
    return [body.random.choice(lines)] if lines else []


def _unsigned(body: Body) -> list[str]:
    """Types that are wider than those of models, or have no sign."""
    type_ = body.random.choice(("unsigned", "int64_t", "uint16_t", "size_t", "long", "uint32_t"))
    name, target = _name(body, "u", "wide", "big"), _plain(body, "int")
    if name is None or target is None:
        return []
    made = f"{type_} {name} = {body.integer(2)};"
    used = body.one(
        lambda: f"if ({name} > {body.number()}) {target} = 1;",
        lambda: f"{target} = {name} / 2;",
        lambda: f"{target} = {name} - 5 > 0;",
        lambda: f"if ({name} < {target}) {target} = 2;",
        lambda: f"{target} = ({name} * 100000) >> 3;",
    )
    return [made, used]


def _unknown(body: Body) -> list[str]:
    """A member that gets what nobody knows: some are only compared."""
    target, real = _plain(body, "int"), _plain(body, "double")
    if target is None or not body.members or not body.opaque or not target.endswith("_"):
        return []
    lines = [f"{target} = topic_tools::level();", f"if ({target} > 2) {target} = 0;"]
    if real is not None and real.endswith("_"):
        lines += [f"{real} = topic_tools::ratio();"]
    return [body.random.choice(lines)]


def _wide(body: Body) -> list[str]:
    """A number that wraps below 0, or above what an int holds."""
    wide, target, real = _plain(body, *WIDE), _plain(body, "int"), _plain(body, "double")
    if wide is None or target is None:
        return []
    number, few = body.random.choice((0, 1, 2, 5, 1000)), body.random.choice((2, 3, 7))
    lines = [
        f"if ({wide} - {few} > {number}) {target} = 1;",
        f"if ({wide} - {few} < {wide}) {target} = 1; else {target} = 2;",
        f"if ({wide} < {target}) {target} = 2;",
        f"if ({target} <= {wide}) {target} = 3;",
        f"if (-{wide} > {number}) {target} = 4;",
        f"if (-{wide} == {target}) {target} = 4;",
        f"if ({wide}) {target} = 5; else {target} = 6;",
        f"{target} = ({wide} - {few}) / {few};",
        f"{target} = ({wide} - {number}) >> 1;",
        f"{target} = {wide} * 100000 * 100000 % 7;",
        f"{target} = {wide} - {number} > {target} ? 1 : 2;",
        f"{wide}--;",
        f"{wide} -= {few};",
        f"if ({wide} > 0) {wide}--;",
        f"if ({wide} > {few}) {wide} -= {few}; else {wide} = {number};",
        f"if ({wide} < 10) ++{wide};",
        f"{wide} = {target};",
        f"{wide} = {target} > 0 ? {target} : 0;",
        f"{wide} = {wide} % {few};",
        f"{wide} <<= 3;",
        f"{wide} = {wide} * 3 + 1;",
        f"{wide} = std::max<int>({target}, 0);",
    ]
    if real is not None:
        lines += [f"{real} = {wide} - {number};", f"{wide} = {real};", f"{real} = {wide} * 0.5;"]
    return [body.random.choice(lines)]


def _narrow(body: Body) -> list[str]:
    """A float, a character or a short whose value does not fit."""
    name, target = _name(body, "f", "c", "h"), _plain(body, "int", "double")
    if name is None or target is None:
        return []
    type_, value = body.random.choice((("float", body.real()), ("char", body.integer(2))))
    return [f"{type_} {name} = {value};", f"{target} = {name} + 1;"]


def _shadow(body: Body) -> list[str]:
    """A local that hides a member."""
    hidden = [v for v in body.of("int") if v.name.endswith("_") and v.name not in body.used]
    if not hidden or not body.members:
        return []
    name = body.random.choice(hidden).name
    lines = [f"int {name} = {body.number()};", f"{name} += {body.integer(2)};"]
    other = _plain(body, "int16_t", "bool")
    return ["{", *lines, f"{other} = {name} > 3;" if other else ";", "}"]


def _alias(body: Body) -> list[str]:
    """A second name for a variable."""
    name, target = _name(body, "r", "same", "alias"), _plain(body, "int")
    if name is None or target is None:
        return []
    kind = body.random.choice(("int& {0} = {1};", "auto& {0} = {1};", "int* {0} = &{1};"))
    pointed = "*" if "*" in kind else ""
    return [
        kind.format(name, target),
        f"{pointed}{name} = {body.integer(1)};",
        f"{target} += 1;",
        f"if ({pointed}{name} > 2) {target} = 0;",
    ]


def _lambda(body: Body) -> list[str]:
    """A function in the middle of a body."""
    name, target = _name(body, "add", "act"), _plain(body, "int")
    if name is None or target is None:
        return []
    by = body.random.choice(("&", "="))
    if by == "=" and not target.endswith("_"):
        by = "&"
    return [
        f"auto {name} = [{by}](int by_) {{ {target} += by_; return {target} > 2; }};",
        f"if ({name}({body.number()})) {name}({body.integer(2)});",
    ]


def _library(body: Body) -> list[str]:
    """A function of a library that changes what it is given, or not."""
    target, other = _plain(body, "int"), _plain(body, "int")
    arrays = [v.name for v in body.variables if v.length and not v.constant]
    if target is None or other is None:
        return []
    lines = [f"std::swap({target}, {other});", f"{target} = std::max({target}, {other});"]
    lines += [f"{target} = std::min({{1, 2, {other}}});", f"{target} = std::exchange({other}, 3);"]
    lines += [f"{target} = std::pow({other}, 2);", f"{target} = {other} == 3 ? INT32_MAX : 0;"]
    lines += [f"std::fill(std::begin({a}), std::end({a}), 2);" for a in arrays]
    lines += [f"std::sort(std::begin({a}), std::end({a}));" for a in arrays]
    return [body.random.choice(lines)]


def _endless(body: Body) -> list[str]:
    """A loop that only leaves in its middle."""
    name, target = _name(body, "rounds", "turns"), _plain(body, "int")
    if name is None or target is None:
        return []
    head = body.random.choice(("while (true)", "for (;;)", "while (ros::ok())"))
    leave = f"if (++{name} > {body.random.randrange(3)}) break;"
    return [f"int {name} = 0;", f"{head} {{", f"  {leave}", f"  {target} += {name};", "}"]


def _local_array(body: Body) -> list[str]:
    name, target = _name(body, "t", "list"), _plain(body, "int")
    if name is None or target is None:
        return []
    made = body.random.choice(
        (
            f"int {name}[4] = {{1, {body.number()}}};",
            f"std::array<int, 4> {name} = {{{{1, 2, {body.number()}}}}};",
            f"std::vector<int> {name} = {{1, 2, 3, {body.number()}}};",
        )
    )
    body.variables.append(Variable(name, "int", length=4))
    return [made, f"{target} = {name}[{body.random.randrange(4)}];"]


def _remembered(body: Body) -> list[str]:
    """A local that outlives the body."""
    name, target = _name(body, "times", "before"), _plain(body, "int")
    if name is None or target is None or not body.members:
        return []
    return [f"static int {name} = 2;", f"{target} = {name}++;"]


def _jump(body: Body) -> list[str]:
    target = _plain(body, "int")
    if target is None or body.result != "void":
        return []
    return [
        body.one(
            lambda: (
                f"try {{ {target} = std::stoi(label_); }} catch (...) {{ {target} = 1; }}"
                if body.members
                else ";"
            ),
            lambda: f"try {{ {target} = 1; }} catch (const std::exception& e) {{ }}",
            lambda: f"switch ({target}) {{ default: {target} = 1; case 2: {target} += 2; }}",
            lambda: f"if (int q_ = {body.integer(2)}) {target} = q_; else {target} = 9;",
            lambda: f"if (const bool q_ = {body.boolean(2)}; q_) {target} = 7;",
        )
    ]


def _whole(body: Body) -> list[str]:
    """Messages that are passed on as they are."""
    given = "msg" if body.by_value else "*msg"
    keeps = any(v.name == "last_.data" for v in body.variables) and body.members
    writable = keeps and any(v.name == "last_.data" and not v.constant for v in body.variables)
    lines = [f"{p.name}.publish({given});" for p in body.publishers if p.message == body.message]
    lines += [f"{p.name}.publish(msg);" for p in body.publishers if p.message == body.message]
    if body.message == "std_msgs::Int32" and writable:
        field = "msg.data" if body.by_value else "(*msg).data"
        lines += [f"last_ = {given};", f"if ({field} > last_.data) last_ = {given};"]
    numbers = [p.name for p in body.publishers if p.message == "std_msgs::Int32"]
    if keeps:
        lines += [f"{p}.publish(last_);" for p in numbers]
    if writable:
        lines += ["last_ = std_msgs::Int32();"]
    lines += [f"{name}(ros::TimerEvent());" for name in body.callable]
    if numbers and (name := _name(body, "copy", "next")) and keeps:
        lines += [f"auto {name} = last_; {name}.data += 1; {numbers[0]}.publish({name});"]
    return [body.random.choice(lines)] if lines else []


_ALL: tuple[Callable[[Body], list[str]], ...] = (
    _effect_inside,
    _effect_inside,
    _whole,
    _whole,
    _mixed,
    _mixed,
    _unsigned,
    _narrow,
    _shadow,
    _alias,
    _lambda,
    _library,
    _endless,
    _local_array,
    _remembered,
    _jump,
)
