"""Calibration factors from recordings of a calibrator, as the command line gives them."""

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from ..base.errors import ParameterError, gathered
from ..recordings.quantities import find_quantity

if TYPE_CHECKING:
    from ..recordings import CalibratorReading

UNIT = "Pa"


def with_calibrators(
    texts: Sequence[str],
    level_db: float,
    frequency_hz: float,
    units: Mapping[str, str],
    calibration: Mapping[str, float],
) -> tuple[dict[str, str], dict[str, float]]:
    """Units and factors by channel, with those of the calibrator's recordings.

    Parameters
    ----------
    texts : `CHANNEL=FILE`, or `FILE` for the channel of the same name as that of the file
    level_db, frequency_hz : level and frequency of the calibrator, dB re 20 µPa and Hz
    units, calibration : that are given otherwise

    Raises
    ------
    ParameterError
        A channel is calibrated twice, or its unit is not that of a sound pressure in Pa; or the
        recording is not that of a calibrator.
    """
    from ..recordings import read_calibrator

    def channel_and_reading(text: str) -> "tuple[str, CalibratorReading]":
        channel, _, file = ("", "", text) if os.path.exists(text) else text.rpartition("=")
        return channel, read_calibrator(
            file, channel=channel or None, level_db=level_db, frequency_hz=frequency_hz
        )

    factors: dict[str, float] = {}
    readings = gathered(channel_and_reading, texts)
    for text, (channel, measured_tone) in zip(texts, readings, strict=True):
        name = channel or measured_tone.channel
        if name in factors or name in calibration:
            raise ParameterError(f"--calibrator {text!r}: channel {name!r} is calibrated twice")
        unit = units.get(name, UNIT)
        measured = find_quantity(unit)
        if measured is None or (measured.unit, measured.factor) != (UNIT, 1.0):
            raise ParameterError(
                f"--calibrator {text!r}: channel {name!r} has the unit {unit!r}, must be {UNIT}"
            )
        factors[name] = measured_tone.pascal_per_unit
    return {**units, **dict.fromkeys(factors, UNIT)}, {**calibration, **factors}
