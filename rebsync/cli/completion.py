"""`rebsync completion`: the script that lets a shell complete commands and options."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class

from rebsync.cli.group import COMPLETING
from rebsync.cli.options import write_output
from rebsync.cli.status import Status


@click.command("completion")
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
@click.pass_context
def command(ctx: click.Context, /, shell: str) -> Status:
    """Print the script that completes `rebsync` in a shell.

    \b
    For bash, once:
    rebsync completion bash > ~/.local/share/bash-completion/completions/rebsync
    """
    kind = get_completion_class(shell)
    assert kind is not None
    write_output("-", kind(ctx.find_root().command, {}, "rebsync", COMPLETING).source())
    return Status.CLEAN
