"""Messages of the library in the words of the command line: its options, not Python's arguments."""

import re
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from typing import Final

from ..base.errors import VibroacousticsError

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
    "points": "--tacholess-line",
    "comb": "--comb",
    "mains_hz": "--mains",
    "level_db": "--calibrator-level",
    "frequency_hz": "--calibrator-frequency",
    "shaft_ratio": "--shaft-ratio",
    "bandwidth": "--bandwidth",
    "duration": "--seconds",
    "full scale": "--full-scale",
    "calibration": "--calibration",
    "batch_deviation_db": "--batch",
    "orders": "--orders",
    "listen": "--listen",
    "poles": "--poles",
    "is_fit": "--fit",
    "absorption_area_m2": "--absorption-area",
    "radius_m": "--hemisphere",
    "length_m": "--box, length",
    "width_m": "--box, width",
    "height_m": "--box, height",
    "distance_m": "--box, distance",
}
"""Arguments, as messages write them with ` =` behind or `give` before, and the options."""
_PARTS: Final = {"highest": "tacholess"}
_GIVEN: Final = {"units": "--unit", "calibration": "--calibration", "names": "--name"}
_PAIR: Final = re.compile(r"(units|calibration)=\{'([^']*)': '?([^'}]*)'?\}")
_UNKNOWN_CHANNEL: Final = re.compile(r"\b(units|calibration|names): no channel")
_ARGUMENT: Final = re.compile(
    rf"\b({'|'.join(_ARGUMENTS)}) = |(?<=give )({'|'.join(_ARGUMENTS)})\b"
)


def in_options(message: str, options: Collection[str]) -> str:
    """Return a message of the library as the command line says it."""

    def argument(match: re.Match[str]) -> str:
        option = _ARGUMENTS[match[1] or match[2]]
        name = option.removeprefix("--").partition(",")[0].replace("-", "_")
        if not {name, f"{name}_s", _PARTS.get(name, "")} & set(options):
            return match[0]
        return f"{option} = " if match[1] else option

    if "unit" in options:
        message = _PAIR.sub(_pair, message)
        message = _UNKNOWN_CHANNEL.sub(lambda match: f"{_GIVEN[match[1]]}: no channel", message)
        message = message.replace("from_s and to_s, or channels", "--from and --to, or --channels")
        message = message.replace("by from_s and to_s", "by --from and --to")
    return _ARGUMENT.sub(argument, message)


@contextmanager
def spoken(options: Collection[str]) -> Iterator[None]:
    """Let errors speak of a command's options."""
    try:
        yield
    except VibroacousticsError as error:
        lines = str(error).splitlines()
        changed = [in_options(line, options) for line in lines]
        if changed == lines:
            raise
        raise type(error)(*changed) from error.__cause__


def _pair(match: re.Match[str]) -> str:
    return f'{_GIVEN[match[1]]} "{match[2]}={match[3].removesuffix(".0")}"'
