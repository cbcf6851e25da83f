"""Starts of processes: the one place. No process looks for modules in the working folder.

Python puts the working folder first on the path of a process that it starts with `-c` or `-m`, as
`multiprocessing` does for its workers and for its resource tracker. Whoever works in a folder of
third parties would run a module that lies there.
"""

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from typing import IO, Any, Final

_SAFE_PATH: Final = "PYTHONSAFEPATH"
"""Variable by which Python omits the working folder, in processes that libraries start, too."""
_STARTING: Final = threading.RLock()


def omit_working_folder() -> None:
    """Let no Python process that is started from now on look for modules in the working folder."""
    os.environ[_SAFE_PATH] = "1"


def start_worker(process: Any, is_copy: bool) -> None:
    """Start a process of `multiprocessing` that never gets SIGINT.

    Parameters
    ----------
    process : process that has not started
    is_copy : whether it is a copy of this process (fork), not started afresh (spawn)
    """
    from multiprocessing import resource_tracker

    with nullcontext() if is_copy else _safe_environment():
        if not is_copy:  # its tracker starts with it otherwise, and unblocks the signal
            resource_tracker.ensure_running()
        blocked = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            process.start()
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, blocked)


def start_module(
    module: str, arguments: Sequence[str], messages: IO[bytes]
) -> subprocess.Popen[bytes]:
    """Start a module of this package; its standard output is a pipe.

    Parameters
    ----------
    module : dotted name
    arguments : arguments of its command line
    messages : file that takes its standard error
    """
    command = [sys.executable, "-P", "-m", module, *arguments]
    return subprocess.Popen(  # noqa: S603 - module of this package
        command,
        env=os.environ | {_SAFE_PATH: "1"},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=messages,
    )


def run_program(
    command: Sequence[str], folder: str | os.PathLike[str], timeout_s: float
) -> subprocess.CompletedProcess[bytes]:
    """Run a program that is no Python of this package, in a folder of its own, until it ends.

    Parameters
    ----------
    command : program and its arguments
    folder : working folder of the program
    timeout_s : time until it is killed, s
    """
    return subprocess.run(  # noqa: S603 - fixed commands
        command,
        cwd=folder,
        env=os.environ | {_SAFE_PATH: "1"},
        capture_output=True,
        stdin=subprocess.DEVNULL,
        timeout=timeout_s,
        check=False,
    )


@contextmanager
def _safe_environment() -> Iterator[None]:
    """Processes of `multiprocessing` that start within it omit the working folder."""
    with _STARTING:
        before = os.environ.get(_SAFE_PATH)
        omit_working_folder()
        try:
            yield
        finally:
            if before is None:
                del os.environ[_SAFE_PATH]
            else:
                os.environ[_SAFE_PATH] = before
