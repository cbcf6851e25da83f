"""What tests of processes have done in workers; imports little, for every worker imports it."""

import os
import signal
import time
from pathlib import Path
from typing import NoReturn


def square(number: int) -> int:
    return number * number


def process_of(_: object) -> int:
    return os.getpid()


def pause(seconds: float) -> float:
    time.sleep(seconds)
    return seconds


def end_once(folder: Path, ends: int, number: int) -> int:
    """Kill this process at every third number, as often as is wanted; markers in a folder count."""
    marker = folder / str(number)
    deaths = len(marker.read_text()) if marker.exists() else 0
    if number % 3 == 0 and deaths < ends:
        marker.write_text("x" * (deaths + 1))
        os.kill(os.getpid(), signal.SIGKILL)
    return number * number


class TwoPartError(Exception):
    """Cannot be unpickled: it takes two arguments and passes one on."""

    def __init__(self, first: str, second: str) -> None:
        super().__init__(first + second)


def fail(number: int) -> int:
    if number == 3:
        raise ValueError("three is wrong")
    return number


def fail_oddly(_: int) -> NoReturn:
    raise TwoPartError("odd", "ly")


def unsendable(_: int) -> object:
    return lambda: None


def leave(*_: object) -> NoReturn:
    """Stand in for a worker that cannot begin."""
    os._exit(7)
