"""Sounds of a recording before and after the replay of an option, at one scale."""

from dataclasses import replace

import numpy as np

from ..base.errors import ParameterError
from ..measured.replay import Replay
from ..report.analysis import Analysis
from ..report.file_names import file_name
from ..report.replay import analysis_of_replay
from ..sound.files import at_gain, wav_bytes
from ..sound.gain import next_full_scale


def analysis_with_sounds(replayed: Replay) -> Analysis:
    """Return the analysis with a WAV file of every channel before and after.

    Parameters
    ----------
    replayed : of `replay`

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
    highest = max(float(np.max(np.abs(each))) for each in (replayed.before, replayed.after))
    scale = next_full_scale(highest)
    sounds, contents = {}, {}
    channels = [str(name) for name in replayed.summary["channel"].values]
    for word, signals in (("before", replayed.before), ("after", replayed.after)):
        for channel, signal in zip(channels, signals, strict=True):
            name = f"{file_name(channel)}_{word}_{scale:g}Pa.wav"
            contents[name] = wav_bytes(at_gain(signal, scale), rate_hz, scale)
            sounds[f"{channel}, {word}"] = name
    if len(contents) < 2 * len(channels):
        raise ParameterError("pair: two channels have the same name of a file; replay one")
    ordered = {f"{channel}, {word}": sounds[f"{channel}, {word}"]
               for channel in channels for word in ("before", "after")}  # fmt: skip
    return replace(analysis_of_replay(replayed.summary, ordered), further=contents)
