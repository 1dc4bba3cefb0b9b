"""A named constant of C++ is what its type makes of its value."""

from __future__ import annotations

import pytest

from rebsync.config import Config
from rebsync.printing import print_model
from tests.forward.compiling import generated
from tests.reverse.laws import extracted

MODEL = """\
reactiveclass G(5) {
  statevars { double wide; float real; int whole; boolean on; }
  G() { wide = 11.0d; real = 11.0; whole = 77; on = false; }
  msgsrv go() { self.go() after(1); }
}
main { G g():(); }
"""
LISTED = ""
CONSTANTS = [  # the declaration, what gets it, and what the model says
    ("constexpr int kStart = 4.5f;", "wide_ = 11.0", LISTED),
    ("constexpr int kStart = 4;", "whole_ = 77", "whole = 4;"),
    ("constexpr double kStart = 4;", "wide_ = 11.0", "wide = 4.0d;"),
    ("constexpr double kStart = 4;", "whole_ = 77", "whole = 4.0d;"),
    ("constexpr double kStart = 0.5;", "wide_ = 11.0", "wide = 0.5d;"),
    ("constexpr double kStart = 0.1f;", "wide_ = 11.0", LISTED),
    ("constexpr float kStart = 0.1f;", "real_ = 11.0f", "real = 0.1;"),
    ("constexpr float kStart = 0.1;", "real_ = 11.0f", "real = 0.1;"),
    ("constexpr float kStart = -3;", "real_ = 11.0f", "real = -3.0;"),
    ("constexpr uint8_t kStart = 300;", "whole_ = 77", LISTED),
    ("constexpr uint8_t kStart = 200;", "whole_ = 77", "whole = 200;"),
    ("constexpr int8_t kStart = 200;", "whole_ = 77", LISTED),
    ("constexpr bool kStart = 2;", "on_ = false", "on = true;"),
    ("constexpr bool kStart = true;", "on_ = false", "on = true;"),
    ("const auto kStart = 5;", "whole_ = 77", "whole = 5;"),
    ("#define kStart 6", "whole_ = 77", "whole = 6;"),
]


@pytest.mark.parametrize("target", ["ros1-cpp", "ros2-cpp"])
def test_a_constant_is_what_its_type_makes_of_it(target: str) -> None:
    files = generated(MODEL, "g", Config(target=target))
    for declared, store, wanted in CONSTANTS:
        place = store.partition("=")[0] + "= kStart"
        source = files["src/g.cpp"]
        assert source.count(store) == 1, (store, source)
        edited = source.replace(store, place).replace(
            "namespace {\n", f"namespace {{\n\n{declared}\n"
        )
        found = extracted(files | {"src/g.cpp": edited})
        assert bool(found.findings) == (wanted == LISTED), (declared, store, found.findings)
        assert wanted in print_model(found.model), (declared, print_model(found.model))
