"""The page of the architecture shows what the code makes of its example, stage by stage.

python -m tests.test_architecture    # writes what each stage gives now into the page
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from rebsync import model as m
from rebsync.printing import print_model
from rebsync.reverse.build.field_order import in_order
from rebsync.reverse.files.packages import CODE
from rebsync.reverse.findings import Findings
from rebsync.reverse.generated.cpp_classes import Classes
from rebsync.reverse.generated.messages import own_messages
from rebsync.reverse.ir.python.lowering import python_program
from rebsync.reverse.recovery import extract
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_tree import parse as parse_python
from rebsync.source import Source
from tests.reverse.ir.dump import dump_function

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs/architecture.md"
PACKAGE = ROOT / "examples/experiment2/experiment2"
_READ = (*CODE, ".launch", ".msg", ".txt", ".xml", ".yaml")
_FENCE = re.compile(r"```text\n.*?```\n", re.DOTALL)
_SECTION = "## From a `.cpp` to a `.rebeca`"
_CLASS, _SERVER = "R1", "P1"
_FORM = "## The form"
_NODE = """\
class Robot(Node):
    def on_limit(self, message):
        with self.lock:
            self.limit = message.data // 2
            if 0 < self.limit < self.sensed():
                self.publisher.publish(Int32(data=self.limit))

    def sensed(self):
        self.asked += 1
        return self.distance
"""
_SERVED = "robot.py:Robot.on_limit"


def stages() -> Iterator[str]:
    """What each stage of the way back gives of one message server, as text."""
    paths = [p for p in PACKAGE.rglob("*") if p.suffix in _READ and ".rebsync" not in p.parts]
    files = {p.relative_to(PACKAGE).as_posix(): Source(str(p), p.read_text("utf-8")) for p in paths}
    text = files["src/r1.cpp"].text
    start = text.index(f"// rebsync: msgsrv {_CLASS}.{_SERVER}")
    yield text[start : text.index("\n}\n", start) + 3]
    trees = [parse(source) for name, source in sorted(files.items()) if Path(name).suffix in CODE]
    code = Code.of(trees)
    owner = code.classes[_CLASS]
    functions = {function.name: function for function in code.functions_of(owner)}
    yield _tree(functions[_SERVER])
    yield "".join(f"{f.name}({', '.join(map(str, f.types))})\n" for f in functions.values())
    classes = Classes(code, Findings(), in_order(own_messages(files).fields, ()))
    roles = classes.roles[_CLASS]
    yield f"handlers {roles.handlers}\nshims {sorted(roles.shims)}\nsends {sorted(roles.sends)}\n"
    (read,) = classes.read({_CLASS})
    assert isinstance(read, m.ReactiveClass)
    servers = tuple(s for s in read.members if getattr(s, "name", "") == _SERVER)
    alone = m.ReactiveClass(_CLASS, read.queue_length, servers)
    yield print_model(m.Model((), (alone,), None))
    extracted = extract(files)
    assert extracted.model.main is not None
    rebecs = ", ".join(rebec.name for rebec in extracted.model.main.rebecs)
    told = dict(extracted.statements)[f"{_CLASS}.{_SERVER}"]
    findings = len(extracted.findings)
    yield f"rebecs {rebecs}\nstatements of {_CLASS}.{_SERVER}: {told}\nfindings: {findings}\n"


def form() -> Iterator[str]:
    """A function of Python, and what it is in the intermediate form."""
    yield _NODE
    imports = "from rclpy.node import Node\nfrom std_msgs.msg import Int32\n"
    code = PyCode.of([parse_python(Source("robot.py", imports + _NODE))])
    program = python_program(code)
    yield dump_function(program.function(_SERVED))


def _tree(function: CppFunction) -> str:
    """The first statement in the tree of a body."""
    assert function.body is not None
    condition = function.body.named_children[0]
    then = condition.child_by_field_name("consequence")
    assert then is not None
    return f"{then.named_children[0]}\n"


def page_of(text: str) -> str:
    """The page with what the stages give now."""
    head, section, rest = text.partition(_SECTION)
    before, start, shown_form = head.partition(_FORM)
    return f"{before}{start}{_filled(shown_form, form())}{section}{_filled(rest, stages())}"


def _filled(text: str, given: Iterator[str]) -> str:
    """A part of the page with what is given in its fences."""
    shown = _FENCE.sub(lambda _: f"```text\n{next(given)}```\n", text)
    assert next(given, None) is None, "a fence for each stage"
    return shown


def test_the_page_shows_what_each_stage_gives() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert page_of(text) == text, "run python -m tests.test_architecture"


if __name__ == "__main__":
    PAGE.write_text(page_of(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
