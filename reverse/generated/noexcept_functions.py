"""Functions of C++ out of which an exception ends the program ([except.spec]).

In generated code an exception that leaves a body ends the body: the mailbox reports it and serves
the next message, and so does the model with an index that is out of range or a time that is
negative. Where a function around it is `noexcept` the node ends instead; so it does when it is told
to stop during a delay, which an exception ends. So such a function has only what throws nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rebsync.reverse.bodies.effects.cpp_form import CppForm
from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.generated.cpp_meanings import is_runtime_header
from rebsync.reverse.syntax.cpp_index import Code

_WHY = "an exception that leaves this ends the node; in the model it ends the body only"
_MAY_SAY = re.compile(r"\bnoexcept\b|\bthrow\s*\(\s*\)")
_DELAY, _POST = "::Mailbox::delay", "::Mailbox::post"


def ending_the_node(code: Code, form: CppForm) -> Iterator[Finding]:
    """The places in functions and lambdas that are `noexcept` that may throw."""
    for cpp in code.files:
        if not is_runtime_header(cpp.source.path) and _MAY_SAY.search(cpp.source.text):
            for span, within in form.terminating(cpp, _DELAY, _POST):
                yield Finding(Grade.UNREADABLE, cpp.source, span, _WHY, "", within)
