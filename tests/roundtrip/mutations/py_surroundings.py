"""Changes of Python packages as wholes: scripts, entry points, what is installed."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.roundtrip.mutations.layout import gone
from tests.roundtrip.mutations.package import (
    BODIES,
    Edit,
    Kind,
    Maker,
    Mutant,
    Package,
    at_start,
    in_files,
)
from tests.roundtrip.mutations.surroundings import run_time


def in_program(pattern: str, text: str) -> Maker:
    """In the programs that run rebecs."""
    compiled = re.compile(pattern, re.MULTILINE)

    def make(package: Package) -> Iterator[Edit]:
        for path in programs(package):
            for found in compiled.finditer(package.code(path)):
                yield Edit(path, *found.span(), found.expand(text))

    return make


def importing(module: str, statement: str) -> Maker:
    """A statement at the start of a body, and the import of the module that it uses."""

    def make(package: Package) -> Iterator[list[Edit]]:
        for made in at_start(f"        {statement}\n", *BODIES)(package):
            assert isinstance(made, Edit)
            head = re.search(r"^from (?!__future__)", package.files[made.path], re.MULTILINE)
            if head is not None:
                line = f"import {module}\n"
                yield [Edit(made.path, head.start(), head.start(), line), made]

    return make


def programs(package: Package) -> list[str]:
    """The programs that run rebecs."""
    return [p for p in sorted(package.files) if re.search(r"_node(?:\.py)?$", p)]


def _other_class(package: Package) -> Iterator[Edit]:
    """A program that imports another class by the name of its own."""
    for path in programs(package):
        text = package.files[path]
        for found in re.finditer(r"^from (\w+)\.(\w+) import ([A-Z]\w*)$", text, re.MULTILINE):
            for other in [c for c in package.classes if c != found[3]][:1]:
                home = next(p for p in package.parts if p.owner == other).path
                module = home.rpartition("/")[2].removesuffix(".py")
                new = f"from {found[1]}.{module} import {other} as {found[3]}"
                yield Edit(path, *found.span(), new)


def _program_gone(package: Package) -> Iterator[Mutant]:
    for path in programs(package):
        yield Mutant({path: None}, path)


def _sensor(pattern: str, text: str) -> Maker:
    compiled = re.compile(pattern, re.MULTILINE)

    def make(package: Package) -> Iterator[Edit]:
        for path in [p for p in sorted(package.files) if re.search(r"_stand_in(?:\.py)?$", p)]:
            for found in compiled.finditer(package.code(path)):
                yield Edit(path, *found.span(), found.expand(text))

    return make


_GIVEN = r'((?:rospy\.get_param\("~|declared\(self, ")\w+)"'
_NUMBER = r"^( +(?:\w+ = )?.*?)(?:rospy\.get_param|declared)\([^()]*\)"

KINDS = (
    Kind("run-time part: negation", run_time(r"\bif not ", "if ")),
    Kind("run-time part: number", run_time(r" = 0$", " = 1")),
    Kind("run-time part: statement removed", run_time(r"^( +)self\.\w+\.\w+\(.*\)\n", r"\1pass\n")),
    Kind("run-time part: file gone", gone("/mailbox.py")),
    Kind("module gone", gone("/values.py")),
    Kind("program reads another parameter", in_program(_GIVEN, r'\1_b"')),
    Kind(
        "program exchanges parameters",
        in_program(_GIVEN + r"(, 0.*?,\s+)" + _GIVEN, r'\3"\2\1"'),
    ),
    Kind("program gives a number", in_program(_NUMBER, r"\g<1>3")),
    Kind("program does not serve", in_program(r"^( *)rebec\.mailbox\.serve\(\)$", r"\1pass")),
    Kind("program of another class", _other_class),
    Kind("program takes part in nothing", in_program(r"^( *)(?:rospy|rclpy)\.init.*$", r"\1pass")),
    Kind("program gone", _program_gone),
    Kind("program leaves at once", in_program(r"^( *)(rebec = )", r"\1raise SystemExit\n\1\2")),
    Kind(
        "program changes a class",
        in_program(r"^( *)(rebec = )(\w+)", r"\1\3.construct = print\n\1\2\3"),
    ),
    Kind("stand-in publishes elsewhere", _sensor(r'"~/?\w+",', '"/other",')),
    Kind(
        "message not generated",
        in_files("CMakeLists.txt", r'^  "?(?:msg/)?(?!\w+State)\w+\.msg"?\n', ""),
    ),
)

ROSPY = (
    Kind("program not installed", in_files("CMakeLists.txt", r"^    scripts/\w+_node\n", "")),
    Kind("no Python package", in_files("CMakeLists.txt", r"^catkin_python_setup\(\)\n", "")),
    Kind(
        "another Python package",
        in_files("setup.py", r'packages=\["(\w+)"\]', r'packages=["\1_b"]'),
    ),
    Kind("another folder of the package", in_files("setup.py", r'"": "src"', '"": "lib"')),
    Kind("setup gone", gone("setup.py")),
    Kind(
        "second publisher",
        in_files(
            ".py",
            r'^( *)self\._\w+_pub = self\._mailbox\.advertise\("(.*)", (\w+)\)\n',
            r'\g<0>\1rospy.Publisher("\2", \3, queue_size=1).publish(\3())\n',
        ),
    ),
    Kind(
        "second subscription",
        in_files(
            ".py",
            r'^( *)self\._\w+_sub = self\._mailbox\.subscribe\("(.*)", (\w+), (.*)\)\n',
            r'\g<0>\1rospy.Subscriber("\2", \3, \4)\n',
        ),
    ),
    Kind(
        "timer in set-up",
        in_files(
            ".py",
            r"^( *)self\._mailbox\.construct.*\n",
            r"\g<0>\1rospy.Timer(rospy.Duration(1), lambda event: self._mailbox.delay(1))\n",
        ),
    ),
    Kind("state not latched", in_files(".py", r"latch=True", "latch=False")),
    Kind("depth of the state", in_files(".py", r"queue_size=QUEUE_SIZE", "queue_size=1")),
    Kind("program of another node", in_program(r'(init_node\("\w+)"', r'\1", anonymous=True')),
)

RCLPY = (
    Kind("program not an entry point", in_files("setup.py", r'^ *"\w+_node = .*\n', "")),
    Kind("another entry point", in_files("setup.py", r'("\w+_node = [\w.]+:)main', r"\1other")),
    Kind("entry point of another module", in_files("setup.py", r'("\w+_node = \w+\.)', r"\1x_")),
    Kind("entry point of another name", in_files("setup.py", r'"(\w+_node) = ', r'"\1_b = ')),
    Kind(
        "modules not installed", in_files("setup.py", r"packages=\[package_name\]", "packages=[]")
    ),
    Kind("launch file not installed", in_files("setup.py", r"^ *\(.*/launch\".*\n", "")),
    Kind("parameters not installed", in_files("setup.py", r"^ *\(.*/config\".*\n", "")),
    Kind("setup gone", gone("setup.py")),
    Kind("scripts elsewhere", in_files("setup.cfg", r"lib/(\w+)$", r"bin/\1")),
    Kind(
        "second publisher",
        in_files(
            ".py",
            r'^( *)self\._\w+_pub = self\._mailbox\.advertise\("(.*)", (\w+)\)\n',
            r'\g<0>\1self.create_publisher(\3, "\2", 1).publish(\3())\n',
        ),
    ),
    Kind(
        "second subscription",
        in_files(
            ".py",
            r'^( *)self\._\w+_sub = self\._mailbox\.subscribe\("(.*)", (\w+), (.*)\)\n',
            r'\g<0>\1self.create_subscription(\3, "\2", \4, 1)\n',
        ),
    ),
    Kind(
        "timer in set-up",
        in_files(
            ".py",
            r"^( *)self\._mailbox\.construct.*\n",
            r"\g<0>\1self.create_timer(1.0, lambda: self._mailbox.delay(1))\n",
        ),
    ),
    Kind("state volatile", in_files(".py", r'"~/state", KEPT\)', '"~/state", 10)')),
    Kind("constant declared with another name", in_files(".py", r'("env\.\w+)"', r'\1_b"')),
    Kind("constant declared beside the others", in_files(".py", r'"env\.(\w+)"', r'"\1"')),
    Kind(
        "known rebec declared with another name",
        in_files(".py", r'(self, "knownrebecs\.\w+)"', r'\1_b"'),
    ),
    Kind(
        "program of another node",
        in_files(".py", r'(\b__init__\((?:self, )?"\w+")', r'\1, namespace="other"'),
    ),
    Kind(
        "program gives parameters",
        in_files(
            ".py",
            r'(\b__init__\((?:self, )?"\w+")',
            r'\1, parameter_overrides=[Parameter("mailbox.time_unit", value=2.0)]',
        ),
    ),
    Kind(
        "program renames topics",
        in_program(r"rclpy\.init\(\)", 'rclpy.init(args=["own", "--ros-args", "-r", "~/a:=b"])'),
    ),
    Kind("program without its arguments", in_program(r"rclpy\.init\(\)", "rclpy.init(args=[])")),
)
