"""How the time to parse and to type-check grows with the size of a model.

    python bench/parse.py [LINES ...]

Makes a model of so many lines for each size (default 100 to 100,000), and prints seconds and
microseconds a line; the last column is that figure over the one of the smallest size above 1,000
lines, which is 1 where time grows linearly.
"""

from __future__ import annotations

import gc
import sys
from itertools import count
from time import perf_counter

from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse

SIZES = (100, 300, 1_300, 3_000, 10_000, 30_000, 100_000)
ENOUGH = 1_000

CLASS = """\
@Robot
reactiveclass Robot{n}(4) {{
  knownrebecs {{
    Robot{n} other;
  }}

  statevars {{
    int id;
    boolean stopped;
    int[2] pos;
  }}

  Robot{n}(int robot_id, int x) {{
    id = robot_id;
    stopped = false;
    pos[0] = x + 3 * (x - 1);
    self.go();
  }}

  // Goes on until it is told to stop.
  msgsrv go() {{
    int step = {n};
    if (pos[0] < 10 && stopped == false) {{
      for (int i = 0; i < 3; i++) {{
        pos[1] += step * i;
      }}
      @Move(X + 1, Y);
      delay(e);
      other.stop(pos[0] == step) after(2) deadline(5);
    }} else {{
      stopped = ?(true, false);
    }}
    self.go() after(e + 1);
  }}

  msgsrv stop(boolean now_) {{
    stopped = now_;
  }}
}}

"""


def model_of(lines: int) -> str:
    """A model that is free of mistakes and about so many lines long."""
    per_class = CLASS.count("\n") + 1
    classes = max(1, (lines - 3) // per_class)
    parts = ["env int e = 2;\n"]
    parts += [CLASS.format(n=n) for n in range(classes)]
    rebecs = [f"  Robot{n} robot{n}(robot{n}):({n}, 2);\n" for n in range(classes)]
    return "".join([*parts, "main {\n", *rebecs, "}\n"])


def measure(text: str) -> tuple[float, float]:
    """Seconds to parse and to analyse, the best of up to three runs."""
    best = (float("inf"), float("inf"))
    for run in count():
        gc.collect()
        start = perf_counter()
        parsed = parse_model(Source("bench.rebeca", text))
        middle = perf_counter()
        analysis = analyse(parsed.model)
        end = perf_counter()
        assert parsed.ok and not analysis.errors
        best = min(best, (middle - start, end - middle), key=sum)
        if run == 2 or end - start > 5:
            return best
    raise AssertionError


def main() -> None:
    sizes = [int(a) for a in sys.argv[1:]] or list(SIZES)
    gc.disable()  # as the command line does
    measure(model_of(100))
    unit = None
    print("   lines    parse s    types s    us/line    ratio")
    for size in sizes:
        text = model_of(size)
        lines = text.count("\n")
        parse, types = measure(text)
        per_line = (parse + types) / lines * 1e6
        if unit is None and lines >= ENOUGH:
            unit = per_line
        ratio = f"{per_line / unit:8.2f}" if unit else "       -"
        print(f"{lines:8}{parse:11.3f}{types:11.3f}{per_line:11.1f} {ratio}")


if __name__ == "__main__":
    main()
