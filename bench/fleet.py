"""A model of a control and any number of robots, each of a class of its own."""

from __future__ import annotations

_CONTROL = """\
env int pace = 2;

reactiveclass Control(40) {{
  knownrebecs {{
{known}
  }}
  statevars {{
    int turn;
    int done;
  }}
  Control() {{
    turn = 0;
    done = 0;
    self.next();
  }}
  msgsrv next() {{
    turn = (turn + 1) % {count};
{goes}
    self.next() after(pace);
  }}
  msgsrv arrived(int id, int at) {{
    done = (done + id * at) % 97;
  }}
}}
"""
_ROBOT = """
@Robot
reactiveclass Robot{i}(6) {{
  knownrebecs {{
    Control control;
  }}
  statevars {{
    int position;
    int goal;
    boolean moving;
    int[4] seen;
    int steps;
  }}
  Robot{i}(int start) {{
    position = start;
    goal = start;
    moving = false;
    for (int k = 0; k < 4; k++) {{
      seen[k] = 0;
    }}
    steps = 0;
  }}
  msgsrv go(int to, int how) {{
    goal = to;
    if (!moving) {{
      moving = true;
      steps = 0;
      self.step(how) after(pace);
    }} else if (goal < position && how > {i}) {{
      goal = position;
    }}
  }}
  msgsrv step(int how) {{
    steps = steps + 1;
    int distance = goal - position;
    if (distance > 0) {{
      position = position + 1;
    }} else if (distance < 0) {{
      position = position - 1;
    }}
    seen[steps % 4] = position;
    if (distance == 0 || steps > {i} + 5) {{
      moving = false;
      control.arrived(how, total(position));
    }} else {{
      self.step(how) after(pace) deadline(40);
    }}
  }}
  msgsrv stop() {{
    moving = false;
    goal = position;
    self.pause(3);
  }}
  msgsrv pause(int times) {{
    if (times > 0) {{
      delay(1);
      self.pause(times - 1);
    }}
  }}
  int total(int at) {{
    int sum = at;
    for (int k = 0; k < 4; k++) {{
      sum = sum + seen[k] * {i};
    }}
    return sum;
  }}
}}
"""


def fleet(count: int) -> str:
    """The text of the model."""
    numbers = range(1, count + 1)
    known = "\n".join(f"    Robot{i} robot{i};" for i in numbers)
    goes = "\n".join(f"    if (turn == {i - 1}) {{ robot{i}.go(turn, {i}); }}" for i in numbers)
    control = _CONTROL.format(known=known, goes=goes, count=count)
    bound = ", ".join(f"robot{i}" for i in numbers)
    rebecs = "".join(f"  Robot{i} robot{i}(control):({i});\n" for i in numbers)
    main = f"\nmain {{\n  Control control({bound}):();\n{rebecs}}}\n"
    return control + "".join(_ROBOT.format(i=i) for i in numbers) + main
