"""The page of all commands, with their arguments and options."""

from typing import Final

import typer

from vibroacoustics.commands import cli

from .tables import code, table

HEAD: Final = """# Command line

`vibroacoustics COMMAND --help` prints the same. Bad input is one line on the terminal that names
file, field, value, unit and allowed range, with exit code 2 ([errors](errors.md)). Nothing uses the
network.
"""


def page() -> str:
    """Markdown of the page."""
    commands = typer.main.get_command(cli.app).commands
    overview = [(f"[`{name}`](#{name})", one.help) for name, one in commands.items()]
    parts = [HEAD, table(("command", "does"), overview)]
    return "\n\n".join([*parts, *(section(name, one) for name, one in commands.items())]) + "\n"


def section(name: str, command) -> str:
    """Usage and parameters of one command."""
    context = command.make_context(name, [], resilient_parsing=True)
    usage = " ".join(command.collect_usage_pieces(context))
    records = [one.get_help_record(context) for one in command.params if one.name != "help"]
    rows = [(code(names), meaning) for names, meaning in filter(None, records)]
    shown = table(("argument or option", "meaning"), rows) if rows else ""
    return "\n\n".join([f"## `{name}`", command.help, f"    vibroacoustics {name} {usage}", shown])
