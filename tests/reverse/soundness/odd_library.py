"""Macros of people's own, and objects of libraries that are written through: often misread."""

from __future__ import annotations

from tests.reverse.soundness.drawing import Body

# What stands before the code: some only look at what they get, others do more.
MACROS = (
    "#define SHOW(text) if (library::ready()) { library::out() << text; }",
    "#define SHOW_BOTH(a, b) \\",
    "  do { SHOW(a); library::out() << b; } while (0)",
    "#define RAISE(x) ++x",
    "#define STORE(x, y) library::out() << y; x = y",
    "#define LEAVE_IF(x) if ((x) > 3) return",
    "#define GUARDED(x) if (library::ready()) { SHOW(x) } else { RAISE(x); }",
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
        f"library::table()({target}, {other}) = {number};",
        f"{{ Eigen::MatrixXd m_(2, 2); m_(0, {other}) = {target}; {target} = {number}; }}",
        f"{{ Eigen::MatrixXd m_(2, 2); if (m_({other}, 1) > 0.5) {target} = {number}; }}",
    ]
    acting = [
        f"SHOW({target}++);",
        f"SHOW_BOTH({other}, ({target} = {number}));",
        f"RAISE({target});",
        f"{{ STORE({target}, {number}); }}",
        f"GUARDED({target});",
        f"library::table().at({target}++) = {number};",
        f"library::table().row(--{target}).at(2) = {other};",
        f"library::table().at({target} = {number}) += 2;",
        f"library::table()({target}, {other}++) = {number};",
        f"{{ Eigen::MatrixXd m_(2, 2); m_(0, {target}++) = {number}; }}",
    ]
    if body.result == "void":
        acting.append(f"LEAVE_IF({target});")
    return [body.random.choice(calm if body.chance(93) else acting)]
