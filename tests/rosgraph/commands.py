"""Runs `rebsync graph` within the process of the test, which is quick."""

from __future__ import annotations

import pytest

from rebsync.cli.graph import command
from rebsync.diagnostics import RebsyncError
from rebsync.report import report
from tests.cli.run import Outcome


def graph(capfd: pytest.CaptureFixture[str], *arguments: str) -> Outcome:
    """The command in the current directory; an error is what the command line makes of it."""
    capfd.readouterr()
    try:
        status = int(command.main(list(arguments), standalone_mode=False))
        said = ""
    except RebsyncError as error:
        status, said = 2, report(error.findings)
    found = capfd.readouterr()
    return Outcome(status, found.out, found.err + said)
