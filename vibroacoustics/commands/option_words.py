"""Messages of the library in the words of the command line: its options, not Python's arguments."""

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import Any, Final, TypeVar

from ..base.errors import VibroacousticsError

Command = TypeVar("Command", bound=Callable[..., Any])

_ARGUMENTS: Final = {
    "sample_rate_hz": "--sample-rate",
    "from_s": "--from",
    "to_s": "--to",
    "bandwidth_hz": "--bandwidth",
    "resolution_hz": "--resolution",
    "resolution_order": "--resolution",
    "maximum_frequency_hz": "--maximum-frequency",
    "maximum_order": "--maximum-order",
    "speed_step_rpm": "--speed-step",
    "pulses_per_revolution": "--pulses",
    "threshold": "--threshold",
    "minimum_rpm": "--tacholess, lowest",
    "maximum_rpm": "highest",
    "speed_rpm": "--rpm",
    "orders": "--orders",
    "poles": "--poles",
    "absorption_area_m2": "--absorption-area",
    "radius_m": "--hemisphere",
    "length_m": "--box, length",
    "width_m": "--box, width",
    "height_m": "--box, height",
    "distance_m": "--box, distance",
}
"""Arguments, as messages write them with ` =` behind or `give` before, and the options."""
_GIVEN: Final = {"units": "--unit", "calibration": "--calibration"}
_PAIR: Final = re.compile(r"(units|calibration)=\{'([^']*)': '?([^'}]*)'?\}")
_UNKNOWN_CHANNEL: Final = re.compile(r"\b(units|calibration): no channel")
_ARGUMENT: Final = re.compile(
    rf"\b({'|'.join(_ARGUMENTS)}) = |(?<=give )({'|'.join(_ARGUMENTS)})\b"
)


def in_options(message: str) -> str:
    """A message of the library as the command line says it.

    Parameters
    ----------
    message : of an error
    """
    message = _PAIR.sub(_pair, message)
    message = _UNKNOWN_CHANNEL.sub(lambda match: f"{_GIVEN[match[1]]}: no channel", message)
    message = message.replace("from_s and to_s, or channels", "--from and --to, or --channels")
    message = message.replace("by from_s and to_s", "by --from and --to")
    return _ARGUMENT.sub(_argument, message)


def in_own_words(command: Command) -> Command:
    """The command with errors that speak of its options."""

    @wraps(command)
    def spoken(*arguments: Any, **options: Any) -> Any:
        with _spoken():
            return command(*arguments, **options)

    return spoken  # type: ignore[return-value]


@contextmanager
def _spoken() -> Iterator[None]:
    try:
        yield
    except VibroacousticsError as error:
        raise type(error)(*map(in_options, str(error).splitlines())) from error.__cause__


def _pair(match: re.Match[str]) -> str:
    return f'{_GIVEN[match[1]]} "{match[2]}={match[3].removesuffix(".0")}"'


def _argument(match: re.Match[str]) -> str:
    if match[1]:
        return f"{_ARGUMENTS[match[1]]} = "
    return _ARGUMENTS[match[2]]
