"""Changes of C++ packages as wholes: what is built, and the run-time part."""

from __future__ import annotations

from tests.roundtrip.mutations.layout import gone, swapped_lines
from tests.roundtrip.mutations.package import Kind, in_files
from tests.roundtrip.mutations.surroundings import run_time

KINDS = (
    Kind("run-time part: negation", run_time(r"if \(!", "if (")),
    Kind("run-time part: number", run_time(r"= 0;", "= 1;")),
    Kind("run-time part: statement removed", run_time(r"^ +\w+\.\w+\([^;\n]*\);\n", "")),
    Kind("run-time part: file gone", gone("/mailbox.h")),
    Kind(
        "stand-in publishes elsewhere",
        in_files("_stand_in.cpp", r'"(?:~/)?\w+", 10', '"/other", 10'),
    ),
    Kind("source not built", in_files("CMakeLists.txt", r"^  src/(?!.*_node).*\.cpp\n", "")),
    Kind("program not built", in_files("CMakeLists.txt", r"^add_executable\([^)]*\)\n", "")),
    Kind(
        "program of another name",
        in_files("CMakeLists.txt", r"OUTPUT_NAME (\w+)", r"OUTPUT_NAME \1_b"),
    ),
    Kind("integers no longer wrap", in_files("CMakeLists.txt", r"(?<=dantic|PUBLIC) -fwrapv", "")),
    Kind(
        "another name for a call",
        in_files("CMakeLists.txt", r"(?<=dantic|PUBLIC) (-fwrapv)", r" \1 -Dafter=deadline"),
    ),
    Kind("source gone", gone("_node.cpp")),
    Kind(
        "message not generated",
        in_files("CMakeLists.txt", r'^  "?(?:msg/)?(?!\w+State)\w+\.msg"?\n', ""),
    ),
)

NEUTRAL = (
    Kind(
        "stand-in plays something else",
        in_files("_stand_in.cpp", r"\{false, true\}|\{0, 1\}", "{}"),
    ),
    Kind(
        "comment in the build", in_files("CMakeLists.txt", r"^(add_executable)", r"# a program\n\1")
    ),
    Kind("sources reordered", swapped_lines(r"  src/\w+\.cpp", "CMakeLists.txt")),
    Kind("messages reordered", swapped_lines(r"  \"?(?:msg/)?\w+\.msg\"?", "CMakeLists.txt")),
    Kind("another warning", in_files("CMakeLists.txt", r"-Wpedantic", "-Wpedantic -Wshadow")),
    Kind(
        "comment in the run-time part",
        in_files("mailbox.h", r"^(class Mailbox)", r"// the queue\n\1"),
    ),
)
