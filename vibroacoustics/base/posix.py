"""Functions of Linux and macOS that Windows lacks: locks, limits, a signal by time.

Modules import `fcntl`, `resource` and ENDING from here.
"""

import signal
from typing import Final

from .errors import PlatformError

try:
    import fcntl
    import resource
except ImportError:
    raise PlatformError(
        "vibroacoustics runs on Linux and macOS; on Windows, run it in the Windows Subsystem for "
        "Linux (WSL)"
    ) from None

__all__ = ["ENDING", "check_memory", "fcntl", "resource"]
ENDING: Final = (signal.SIGINT, signal.SIGTERM, signal.SIGALRM)
"""Signals that end a command; the last one repeats the others."""
LEAST_BYTES: Final = 700_000_000
"""Address space of a command that only reads and prints, with its libraries."""
LEAST_TO_COMPUTE_BYTES: Final = 1_200_000_000
"""Address space of a command that computes: with less, threads of libraries cannot start, and the
command waits for them without end."""


def check_memory(least_bytes: int) -> None:
    """Refuse to begin where the memory of the process is limited to less.

    Parameters
    ----------
    least_bytes : needed

    Raises
    ------
    PlatformError
        Names limit and need.
    """
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit != resource.RLIM_INFINITY and limit < least_bytes:
        raise PlatformError(
            f"memory of a process is limited to {limit / 1e9:.2g} GB (ulimit -v); this command "
            f"needs {least_bytes / 1e9:.2g} GB at least"
        )
