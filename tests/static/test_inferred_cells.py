"""Which variables give the cell of a robot: what bodies must do for it, and what spoils it."""

from __future__ import annotations

import pytest

from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse
from rebsync.static.inferred_cells import cell_of

# State variables, statements of the body of a server, the variables for X and Y.
CASES = {
    "by one": ("int a;", "@Move(X + 1, Y); a = a + 1;", ("a", None)),
    "the other way round": ("int a;", "@Move(X + 1, Y); a = 1 + a;", ("a", None)),
    "increment": ("int a;", "@Move(X + 1, Y); a++;", ("a", None)),
    "compound": ("int a;", "@Move(X - 2, Y); a -= 2;", ("a", None)),
    "of self": ("int a;", "@Move(X + (1), Y); self.a = (self.a + 1);", ("a", None)),
    "by a variable": ("int a; int n;", "@Move(X + n, Y); a += n;", ("a", None)),
    "elements": ("int[2] p;", "@Move(X + 1, Y); p[0] += 1;", ("p[0]", "p[1]")),
    "the second": ("int[2] p;", "@Move(X, Y + 1); p[1] += 1;", ("p[0]", "p[1]")),
    "by letter": ("int posX; int posY;", "@Move(X, Y + 1); posY++;", ("posX", "posY")),
    "small letter": ("int x1; int y1;", "@Move(X + 1, Y); x1++;", ("x1", "y1")),
    "no neighbour": ("int x; int id;", "@Move(X + 1, Y); x++;", ("x", None)),
    "both": ("int a; int b;", "@Move(X + 1, Y - 1); a++; b--;", ("a", "b")),
    "there and back": (
        "int a; int fuel;",
        "if (a > 1) { @Move(X + 1, Y); a++; fuel--; } else { @Move(X - 1, Y); a--; fuel--; }",
        ("a", None),
    ),
    "of several the named one": ("int n; int x;", "@Move(X + 1, Y); n++; x++;", ("x", None)),
    "of several none": ("int n; int m;", "@Move(X + 1, Y); n++; m++;", (None, None)),
    "another amount": ("int a;", "@Move(X + 2, Y); a++;", (None, None)),
    "stored": ("int a;", "@Move(X + 1, Y); a = 5;", (None, None)),
    "stored as well": ("int a;", "@Move(X + 1, Y); a++; if (a > 5) a = 0;", (None, None)),
    "not a number": ("boolean a;", "@Move(X + 1, Y); a = true;", (None, None)),
    "no moves": ("int x; int y;", "x++;", (None, None)),
    "an axis that moves otherwise": (
        "int x; int y;", "@Move(X + 1, Y + 1); x++; y += 2;", ("x", None),
    ),
    "diagonally": ("int x; int y;", "@Move(X + 1, Y + 1); x++; y++;", ("x", "y")),
    "diagonally without names": ("int a;", "@Move(X + 1, Y + 1); a++;", (None, None)),
}  # fmt: skip


def variables(state: str, body: str, more: str = "") -> tuple[str | None, str | None]:
    text = f"""
    @Robot reactiveclass R(2) {{
      statevars {{ {state} }}
      R() {{ self.go(); }}
      msgsrv go() {{ {body} delay(1); }}
      {more}
    }}
    main {{ R r():(); }}
    """
    analysis = analyse(parse_model(Source("model.rebeca", text)).model)
    assert not analysis.errors, analysis.errors
    return cell_of(analysis.classes["R"]).texts


@pytest.mark.parametrize("name", CASES)
def test_variables_follow_moves(name: str) -> None:
    state, body, expected = CASES[name]
    assert variables(state, body) == expected


def test_all_bodies_count() -> None:
    move = "@Move(X + 1, Y); a++;"
    assert variables("int a;", move, "msgsrv reset() { a = 0; }") == (None, None)
    assert variables("int a;", move, "msgsrv back() { @Move(X - 1, Y); }") == (None, None)
    assert variables("int a;", move, "void back() { @Move(X - 1, Y); a--; }") == ("a", None)
