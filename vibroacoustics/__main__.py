"""`python -m vibroacoustics` is the command line."""

from .commands.signals import ended_by_signals


def main() -> None:
    """Run the command line until it ends or a signal ends it."""
    with ended_by_signals():
        from .commands.cli import main as command_line

        command_line()


if __name__ == "__main__":
    main()
