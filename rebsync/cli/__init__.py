"""The command line: the roof of the house."""

from __future__ import annotations

import gc
import os
import signal
import sys
import traceback
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import NoReturn, TextIO

import click

from rebsync import __version__
from rebsync.cli.group import LazyGroup
from rebsync.cli.status import Status
from rebsync.diagnostics import RebsyncError
from rebsync.long_numbers import allow_long_numbers
from rebsync.terminal import one_line, say, without_commands

_ending: list[int] = []  # the signals so far that were to end this process
_AGAIN = 2.0  # seconds after which a signal that did not end the process is repeated


@click.command(
    cls=LazyGroup,
    context_settings={"help_option_names": ["-h", "--help"]},
    invoke_without_command=True,
)
@click.version_option(__version__, "-V", "--version", message="%(prog)s %(version)s")
@click.pass_context
def rebsync(ctx: click.Context) -> Status | None:
    """Keeps verified Timed Rebeca models and the ROS code made from them in step.

    \b
    To begin:  rebsync examples . hello
               rebsync verify hello --allow deadlock
    More of a command:  rebsync COMMAND --help
    """
    if ctx.invoked_subcommand is not None:
        return None
    click.echo(ctx.get_help(), err=True)
    return Status.UNUSABLE


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; what it returns is the exit status."""
    _print_whatever_the_encoding()
    allow_long_numbers()
    if arguments is None:
        gc.disable()  # trees have no cycles, and walking them again and again takes a third longer
        _end_in_order()
    try:
        if sys.stdout is None:
            raise RebsyncError.of("standard output", "RS806", "it is closed")
        status = rebsync.main(
            list(arguments) if arguments is not None else None,
            prog_name="rebsync",
            standalone_mode=False,
        )
        sys.stdout.flush()
    except RebsyncError as error:
        status = _report(error)
    except click.Abort:
        status = _say("interrupted", Status.INTERRUPTED)
    except KeyboardInterrupt:
        status = _say("interrupted", Status.INTERRUPTED)
    except click.ClickException as error:
        status = _usage(error)
    except BrokenPipeError:
        status = Status.BROKEN_PIPE
    except OSError as error:
        status = _os_error(error)
    except MemoryError:
        status = _say("there is not enough memory for this", Status.UNUSABLE)
    except RecursionError:
        status = _report(
            RebsyncError.of(".", "RS111", "something here nests deeper than rebsync reads")
        )
    except Exception as error:  # ctypes and `__set_name__` turn what a signal raises into another
        if not _ending and arguments is not None:
            raise
        status = _ended_by(_ending[-1]) if _ending else _unforeseen(error)
    except SystemExit as error:  # click's own answer to a broken pipe
        status = Status.BROKEN_PIPE if error.code == 1 else error.code
    if arguments is None and hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_REAL, 0)  # to be ended while it ends has no handler any more
    _tell_of_cache()
    ended = _closed(int(status or Status.CLEAN))
    try:
        sys.stderr.flush()
    except OSError:
        _drop(sys.stderr)
    return ended


def _tell_of_cache() -> None:
    """Says which folder was to be the cache and was not used."""
    cache = sys.modules.get("rebsync.cache")
    found = cache.refused() if cache is not None else None
    if found is not None:
        _report(RebsyncError([found]))


def _end_in_order() -> None:
    """Signals that end a process become exceptions, so that no half-written file stays."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _interrupt)
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, _exit_by)


def _interrupt(number: int, _: object) -> NoReturn:
    """What Python does at an interrupt, remembered."""
    _ending.append(number)
    raise KeyboardInterrupt


def _ended_by(number: int) -> int:
    if number == signal.SIGINT:
        return _say("interrupted", Status.INTERRUPTED)
    return 128 + number


def _exit_by(number: int, _: object) -> NoReturn:
    """Ends the process; and again if that is lost, as in a finaliser, where Python ignores it."""
    _ending.append(number)
    if hasattr(signal, "setitimer"):
        signal.signal(signal.SIGALRM, lambda *_: _exit_by(number, None))
        signal.setitimer(signal.ITIMER_REAL, _AGAIN)
    raise SystemExit(128 + number)


def _print_whatever_the_encoding() -> None:
    if sys.stderr is None:
        sys.stderr = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        with suppress(AttributeError, ValueError):
            stream.reconfigure(errors="backslashreplace")  # type: ignore[union-attr]


def _report(error: RebsyncError) -> Status:
    from rebsync.report import print_report

    with suppress(OSError):
        if sys.stdout is not None:
            sys.stdout.flush()
    with suppress(OSError):  # standard error may be full, too, or nobody reads it
        print_report(error.findings, sys.stderr)
    return Status.UNUSABLE


def _os_error(error: OSError) -> Status:
    from rebsync.files import os_mistake

    return _report(os_mistake(str(error.filename or "standard output"), error))


def _usage(error: click.ClickException) -> Status:
    shown = click.UsageError(
        without_commands(one_line(error.format_message())), getattr(error, "ctx", None)
    )
    with suppress(OSError):
        shown.show()
    return Status.UNUSABLE


def _unforeseen(error: Exception) -> Status:
    """Nothing is known then, which is another status than that of a drift."""
    with suppress(OSError):
        traceback.print_exception(error)
    hint = "please report it, with the lines above and the file that was read"
    what = f"a mistake of rebsync itself: {type(error).__name__}: {error}"
    return _report(RebsyncError.of(".", "RS817", what, hint=hint))


def _say(message: str, status: Status) -> Status:
    with suppress(OSError):
        say(message, err=True)
    return status


def _drop(stream: TextIO) -> None:
    """What is still to be written goes nowhere, so that the interpreter does not try it again."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _closed(status: int) -> int:
    """Flush what is left; a reader that has gone must not make the interpreter complain."""
    if sys.stdout is None:
        return status
    try:
        sys.stdout.flush()
    except OSError as error:
        _drop(sys.stdout)
        if not isinstance(error, BrokenPipeError) and status in (Status.CLEAN, Status.FINDINGS):
            return _os_error(error)
        return Status.BROKEN_PIPE if isinstance(error, BrokenPipeError) else status
    return status
