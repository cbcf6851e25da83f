"""Channels that no working sensor can have recorded: dead ones, and values beyond its limits."""

import tomllib
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Any, Final, Literal, NamedTuple

from ..base.decibel import amplitude_of_level, level_of_amplitude
from ..base.unit_spelling import plain_unit
from .extent import Extent
from .quantities import quantity
from .remarks import MAY_BE_PULSES, MAY_STAY

FAR_BELOW_DB: Final = 90.0
"""A living channel is less than this below the quietest of the others of its unit. Assumed, 80 to
110 dB: a microphone in a quiet room is 70 dB below one at a loud machine, the noise of an open
input of 24 bits 90 dB and more below a signal."""
_LAST_BITS: Final = 2.5
"""Steps within which noise of the last bit stays, one either side."""
_PULSES: Final = 1.5
"""Steps of two values side by side, which are a tacho."""
_LEAST_SAMPLES: Final = 10
"""Equal samples that say something: fewer may be a pause."""
_ADVICE: Final = "check sensor, cable and range of the recorder"


class Suspect(NamedTuple):
    """Channel that no working sensor can have recorded.

    Attributes
    ----------
    channel : name of the channel in the file
    kind : dead, or values beyond any sensor
    words : description with advice
    """

    channel: str
    kind: Literal["dead", "beyond"]
    words: str

    @property
    def line(self) -> str:
        """Remark on the channel."""
        return f"channel {self.channel!r}: {self.words}"


class _Channel(NamedTuple):
    """Channel with its extent in SI."""

    name: str
    stated_unit: str
    extent: Extent
    factor: float

    @property
    def unit(self) -> str:
        return quantity(self.stated_unit).unit

    @property
    def deviation(self) -> float:
        return abs(self.factor) * self.extent.deviation


def header_extents(header: Mapping[str, Any]) -> list[Extent]:
    """Extents in the header that the reading process gives."""
    return [Extent(**each) for each in header["extents"]]


def suspect_channels(
    names: Sequence[str], units: Sequence[str], factors: Sequence[float], extents: Sequence[Extent]
) -> list[Suspect]:
    """Channels that are dead, or beyond the limits of sensors (sensor_limits.toml).

    Dead is a channel of equal samples, of noise of the last bit, or 90 dB below every other of its
    unit. Speeds, angles and numbers may be constant.

    Parameters
    ----------
    names : names of the channels
    units : units that file or user state
    factors : SI unit per unit of the file, calibration included
    extents : extents in the unit of the file
    """
    channels = list(map(_Channel, names, units, extents, factors))
    by_name = {channel.name: _beyond(channel) for channel in channels}
    possible = [channel for channel in channels if by_name[channel.name] is None]
    dead = {channel.name: _dead(channel) for channel in possible}
    living = [channel for channel in possible if dead[channel.name] is None]
    for channel in living:
        others = [other for other in living if other is not channel and other.unit == channel.unit]
        dead[channel.name] = _far_below(channel, [other.deviation for other in others])
    by_name |= dead
    return [suspect for channel in channels if (suspect := by_name[channel.name]) is not None]


def _beyond(channel: _Channel) -> Suspect | None:
    limit = sensor_limits().get(plain_unit(channel.stated_unit))
    extent = channel.extent
    largest = abs(channel.factor) * max(abs(extent.lowest), abs(extent.highest))
    if limit is None or not largest > limit["highest"]:
        return None
    advice = "; ".join(["check unit and calibration", *filter(None, [limit.get("advice")])])
    words = (
        f"reaches {largest:.3g} {channel.unit}: a sensor of {limit['quantity']} gives at most "
        f"{limit['highest']:.3g} {channel.unit}: {advice}"
    )
    return Suspect(channel.name, "beyond", words)


def _dead(channel: _Channel) -> Suspect | None:
    extent, unit = channel.extent, channel.unit
    if unit in MAY_STAY or extent.samples < _LEAST_SAMPLES:
        return None
    spread = extent.highest - extent.lowest
    if spread == 0.0:
        value = channel.factor * extent.lowest + 0.0  # no minus zero
        return _suspected(channel, f"all {extent.samples} samples are {value:.6g} {unit}")
    least = _PULSES if unit == MAY_BE_PULSES else 0.0
    if least * extent.step < spread < _LAST_BITS * extent.step:
        return _suspected(
            channel, f"varies by {abs(channel.factor) * spread:.3g} {unit}, the last bit, alone"
        )
    return None


def _far_below(channel: _Channel, others: Sequence[float]) -> Suspect | None:
    """Channel whose deviation is far below those of the others of its unit."""
    if not others or channel.unit in (*MAY_STAY, MAY_BE_PULSES):
        return None
    return quiet(channel.name, channel.deviation, min(others), FAR_BELOW_DB, "every other channel")


def quiet(
    name: str, deviation: float, reference: float, most_db: float, what: str
) -> Suspect | None:
    """Channel that is dead by comparison; None where it is not.

    Parameters
    ----------
    name : name of the channel
    deviation, reference : standard deviation of the channel and what it is compared with, one unit
    most_db : largest level difference of a living channel
    what : reference in words
    """
    if not 0.0 < deviation * amplitude_of_level(most_db) < reference:
        return None
    below_db = level_of_amplitude(reference / deviation)
    return Suspect(name, "dead", f"is dead: {below_db:.0f} dB below {what} of its unit: {_ADVICE}")


def _suspected(channel: _Channel, words: str) -> Suspect:
    return Suspect(channel.name, "dead", f"is dead: {words}: {_ADVICE}")


@cache
def sensor_limits() -> dict[str, dict[str, Any]]:
    """Rows of sensor_limits.toml by the plain spelling of each unit."""
    text = files(__package__).joinpath("sensor_limits.toml").read_text(encoding="utf-8")
    rows: list[dict[str, Any]] = tomllib.loads(text)["limit"]
    return {plain_unit(unit): row for row in rows for unit in row["units"]}
