"""`python -m vibroacoustics` is the command line."""

import sys

from .base.errors import PlatformError


def main() -> None:
    """Run the command line until it ends or a signal ends it."""
    try:
        from .base.posix import LEAST_BYTES, check_memory

        check_memory(LEAST_BYTES)
    except PlatformError as error:
        from .commands.outcome import write_errors

        print(f"error: {error}", file=sys.stderr)
        write_errors(sys.argv[1:], error.args)
        sys.exit(2)
    from .base.process_start import omit_working_folder
    from .commands.signals import ended_by_signals

    omit_working_folder()
    with ended_by_signals():
        from .commands.cli import main as command_line

        command_line()


if __name__ == "__main__":
    main()
