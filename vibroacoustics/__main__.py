"""`python -m vibroacoustics` is the command line."""

import sys

from .base.errors import PlatformError


def main() -> None:
    """Run the command line until it ends or a signal ends it."""
    try:
        from .base.posix import LEAST_BYTES, check_memory

        check_memory(LEAST_BYTES)
    except PlatformError as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)
    from .commands.signals import ended_by_signals

    with ended_by_signals():
        from .commands.cli import main as command_line

        command_line()


if __name__ == "__main__":
    main()
