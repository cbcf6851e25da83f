"""The page of all commands, with their arguments and options."""

from typing import Final

import typer

from vibroacoustics.commands import cli

from .tables import code, table

HEAD: Final = """# Command line

`vibroacoustics COMMAND -h` prints the same, with an example. Bad input is one line on the terminal
that names file, field, value, unit and allowed range, with exit code 2 ([errors](errors.md)).
Nothing uses the network.
"""


def page() -> str:
    """Markdown of the page."""
    commands = typer.main.get_command(cli.app).commands
    overview = [(f"[`{name}`](#{name})", one.help) for name, one in commands.items()]
    parts = [HEAD, table(("command", "purpose"), overview)]
    return "\n\n".join([*parts, *(section(name, one) for name, one in commands.items())]) + "\n"


def section(name: str, command) -> str:
    """Usage and parameters of one command."""
    context = command.make_context(name, [], resilient_parsing=True)
    usage = " ".join(command.collect_usage_pieces(context))
    rows = [(code(names), meaning) for _, (names, meaning) in command.records(context)]
    shown = table(("argument or option", "meaning"), rows)
    used = f"    vibroacoustics {name} {usage}\n    {command.example}"
    return "\n\n".join([f"## `{name}`", command.help, used, shown])
