"""The commands by name; the module of a command is imported when it runs."""

from __future__ import annotations

import os
from importlib import import_module

import click

from rebsync.diagnostics import did_you_mean

GROUPS = {
    "Models": {
        "new": "Begin a model from a list of robots, what they do, and what they sense.",
        "lint": "Report mistakes in models and properties.",
        "fmt": "Bring models into the canonical layout.",
        "verify": "Check everything that can go wrong in a model, and its properties.",
        "simulate": "Make one run of a model, by chance or by hand.",
        "export": "Print a model in the form that another tool accepts.",
    },
    "Models and their ROS packages": {
        "generate": "Write the ROS package of a model.",
        "check": "Tell whether packages and their models are in step.",
        "sync": "Bring packages and their models in step.",
        "diff": "Compare two models, packages of code, or revisions of either.",
        "extract": "Read the code of packages back into models.",
        "accept": "Say of a place that check cannot decide that it is as it is to be.",
    },
    "ROS packages that people wrote": {
        "ask": "Answer a question about what the nodes of a package do.",
        "graph": "Draw the computation graph of packages, and tell what is wrong in it.",
    },
    "Systems that run, or ran": {
        "conform": "Tell whether a recorded run is a run of the model.",
        "monitor": "Write the node that compares a run of a system with its model.",
    },
    "Around your work": {
        "examples": "Write the examples, each with its package, to a directory.",
        "init": "Set a repository up, and tell what it has of models and packages.",
        "watch": "Lint, check and verify what has changed, as files are saved.",
        "lsp": "Serve editors: diagnostics, navigation, renaming, completion.",
        "doctor": "Tell which programs and libraries are found, and what each is for.",
        "completion": "Print the script that completes commands and options in a shell.",
    },
}
COMMANDS = {name: about for group in GROUPS.values() for name, about in group.items()}


COMPLETING = "_REBSYNC_COMPLETE"  # the variable by which a shell asks for what may follow
_PATHS = ("FILE", "DIR", "PATH", "MODEL", "PACKAGE", "RECORDING", "A", "B")


def _complete_paths(command: click.Command) -> None:
    """Lets shells complete paths where a command names one."""
    for param in command.params:
        names = (param.metavar or "").strip("[.]").split("|")
        if param.type is click.STRING and names[0] in _PATHS:
            param.type = click.Path()


class LazyGroup(click.Group):
    """A group that knows its commands without having loaded them."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return sorted(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        command = import_module(f"rebsync.cli.{cmd_name}").command
        assert isinstance(command, click.Command)
        if COMPLETING in os.environ:
            _complete_paths(command)
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        if args[0] not in COMMANDS and not args[0].startswith("-"):
            hint = did_you_mean(args[0], COMMANDS)
            raise click.UsageError(f'no command "{args[0]}"{"; " + hint if hint else ""}', ctx)
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        width = max(map(len, COMMANDS))
        for title, group in GROUPS.items():
            with formatter.section(title):
                formatter.write_dl([(name.ljust(width), about) for name, about in group.items()])
