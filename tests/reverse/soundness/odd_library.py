"""Macros of people's own, and objects of libraries that are written through: often misread."""

from __future__ import annotations

from tests.reverse.soundness.drawing import Body

# What stands before the code: some only look at what they get, others do more.
MACROS = (
    "#define SHOW(text) if (topic_tools::ready()) { topic_tools::out() << text; }",
    "#define SHOW_BOTH(a, b) \\",
    "  do { SHOW(a); topic_tools::out() << b; } while (0)",
    "#define RAISE(x) ++x",
    "#define STORE(x, y) topic_tools::out() << y; x = y",
    "#define LEAVE_IF(x) if ((x) > 3) return",
    "#define GUARDED(x) if (topic_tools::ready()) { SHOW(x) } else { RAISE(x); }",
    "void spread(int& to, int by) { to = by; }",
    "void spread(int& to) { to = to % 50 + 1; }",
    "bool looked(int of) { return of > 1; }",
    "bool looked(int of, int* found) {",
    "  *found = of;",
    "  return of > 2;",
    "}",
    "void noted(const int& of, double& seen) { seen = of; }",
    "",
)


def library_statement(body: Body) -> list[str]:
    """One of them, if there is what it needs."""
    found = [v.name for v in body.of("int", writable=True) if v.name.isidentifier()]
    if not found:
        return []
    target, other = body.random.choice(found), body.random.choice(found)
    number = body.number()
    calm = [
        f'SHOW("it is " << {target} << " of " << {other});',
        f"SHOW({target});",
        f"SHOW_BOTH({target} + 1, {other});",
        f"topic_tools::table()({target}, {other}) = {number};",
        f"{{ Eigen::Matrix3d m_(2, 2); m_(0, {other}) = {target}; {target} = {number}; }}",
        f"{{ Eigen::Matrix3d m_(2, 2); if (m_({other}, 1) > 0.5) {target} = {number}; }}",
    ]
    calm += [
        f"{{ double seen_; noted({target}, seen_); if (seen_ > 2.0) {target} = {number}; }}",
        f"{{ int got_; if (looked({other}, &got_)) {target} = {number}; }}",
        f"{{ int got_; looked({other} * 2, &got_); {target} = got_; }}",
        f"{{ double seen_ = 0; noted(topic_tools::level(), seen_); {target} = {number}; }}",
        f"spread(topic_tools::table().cell, {target});",
        f"spread({target});",
        f"if (looked({other})) {target} = {number};",
    ]
    acting = [
        f"spread({target}, {other});",
        f"looked({other}++, &{target});",
        f"if (looked({number}, &{target})) {other} = 1;",
        f"looked({target}, &topic_tools::table().row({target}++).cell);",
        f"SHOW({target}++);",
        f"SHOW_BOTH({other}, ({target} = {number}));",
        f"RAISE({target});",
        f"{{ STORE({target}, {number}); }}",
        f"GUARDED({target});",
        f"topic_tools::table().at({target}++) = {number};",
        f"topic_tools::table().row(--{target}).at(2) = {other};",
        f"topic_tools::table().at({target} = {number}) += 2;",
        f"topic_tools::table()({target}, {other}++) = {number};",
        f"{{ Eigen::Matrix3d m_(2, 2); m_(0, {target}++) = {number}; }}",
    ]
    if body.result == "void":
        acting.append(f"LEAVE_IF({target});")
    return [body.random.choice(calm if body.chance(93) else acting)]
