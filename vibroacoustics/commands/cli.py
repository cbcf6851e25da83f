"""The command line: every module of commands is imported, and `main` runs one of them.

Heavy imports wait until a command needs them.
"""

import gc
import sys
from typing import Annotated, Final, NoReturn

import typer

from ..base.errors import VibroacousticsError
from ..base.fault import collected
from . import (  # noqa: F401 - each registers its commands
    balancing_commands,
    design_commands,
    installation_commands,
    messages,
    outcome,
    permit_commands,
    prediction_commands,
    recording_commands,
    replay_commands,
    results_commands,
    study_commands,
)
from .command import COMMANDS, HelpedCommand, HelpedGroup

INPUT_ERROR = 2
NOT_COMPLETE = 3
COLLECTIONS: Final = (100_000, 10, 10)
"""Thresholds of the collector of cyclic garbage: imports and figures make next to none of it, and
at the usual 700 it takes a tenth of a run's time."""

app = typer.Typer(
    cls=HelpedGroup,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)
for _name, _command in COMMANDS.items():
    app.command(_name, cls=HelpedCommand)(_command.typed())


def _print_version(requested: bool) -> None:
    if requested:
        from importlib.metadata import version

        typer.echo(f"vibroacoustics {version('vibroacoustics')}")
        raise typer.Exit


@app.callback()
def of_all_commands(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print it.")
    ] = False,
) -> None:
    """Predict forces, feet and sound of a compressor, from mechanism to microphone."""


def main() -> None:
    """Run the command line; input errors are lines on stderr and exit code 2."""
    gc.set_threshold(*COLLECTIONS)
    outcome.begin()
    try:
        with messages.warnings_in_one_line(), collected() as left_out:
            _run(left_out)
    except VibroacousticsError as error:
        _refuse(error)
    except MemoryError as error:
        _refuse(VibroacousticsError(f"not enough memory: {error}"))
    except Exception as error:  # a fault of this package: its traceback follows
        outcome.write_errors(sys.argv[1:], [f"{type(error).__name__}: {error}"], messages.warned())
        raise
    finally:
        gc.freeze()  # the interpreter would search all objects before it ends, for a second


def _refuse(error: VibroacousticsError) -> NoReturn:
    """Print the lines of an error, and its envelope where it is asked for."""
    for line in messages.lines_of(error):
        print(line, file=sys.stderr)
    outcome.write_errors(sys.argv[1:], error.args, messages.warned())
    sys.exit(INPUT_ERROR)


def _run(left_out: list[str]) -> None:
    """Run a command; one that ends well, but without what failed in a plug-in, exits with 3."""
    try:
        app()
    except SystemExit as ended:
        if left_out and not ended.code:
            sys.exit(NOT_COMPLETE)
        raise
