"""Sounds of a recording before and after the replay of an option, at one scale a unit."""

from dataclasses import replace
from typing import Final

import numpy as np

from ..base.errors import ParameterError
from ..measured.replay import Replay
from ..report.analysis import Analysis
from ..report.file_names import file_name
from ..report.replay import analysis_of_replay
from ..sound.files import at_gain, next_full_scale, wav_bytes

_IN_NAMES: Final = {"Pa": "Pa", "m/s²": "m_s2", "m/s": "m_s", "N": "N"}
"""Units in names of files."""


def analysis_with_sounds(replayed: Replay) -> Analysis:
    """Return the analysis with a WAV file of every channel before and after.

    Parameters
    ----------
    replayed : result of `replay`

    Raises
    ------
    ParameterError
        The sample rate is not a whole number, or two channels have one name of a file.
    """
    rate_hz = round(replayed.sample_rate_hz)
    if abs(rate_hz - replayed.sample_rate_hz) > 1e-6:
        raise ParameterError(
            f"sample rate = {replayed.sample_rate_hz:g} Hz: must be a whole number for WAV files; "
            "give --sample-rate"
        )
    units = replayed.summary["channel_unit"].values.astype(str)
    scales = {
        unit: next_full_scale(max(float(np.max(np.abs(each[units == unit])))
                                  for each in (replayed.before, replayed.after)))
        for unit in dict.fromkeys(units)
    }  # fmt: skip
    sounds: dict[str, dict[str, str]] = {}
    contents = {}
    channels = [str(name) for name in replayed.summary["channel"].values]
    for channel, unit, *signals in zip(
        channels, units, replayed.before, replayed.after, strict=True
    ):
        scale, sounds[channel] = scales[unit], {}
        for word, signal in zip(("before", "after"), signals, strict=True):
            name = f"{file_name(channel)}_{word}_{scale:g}{_IN_NAMES[unit]}.wav"
            contents[name] = wav_bytes(at_gain(signal, scale), rate_hz, scale, unit)
            sounds[channel][word] = name
    if len(contents) < 2 * len(channels):
        raise ParameterError("pair: two channels have the same name of a file; replay one")
    return replace(analysis_of_replay(replayed.summary, sounds), further=contents)
