"""WAV: PCM and IEEE float. Integers are fractions of full scale; few files state a unit."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from ...base.errors import StorageError
from ...base.registry import register
from ..reader import Reader
from ..recorded import Recorded, Request, Samples, by_channel, check_rate, check_size
from ..riff import FLOAT, PCM, Wave, read_wave, stated_scales
from . import sound_file


def read(request: Request) -> Recorded:
    """Channels `channel 1`, `channel 2` … of a WAV file."""
    with request.path.open("rb") as file:
        wave = read_wave(file)
    if wave.kind not in (PCM, FLOAT):  # packed: A-law, ADPCM, …
        return sound_file.read(request)
    rate_hz = request.sample_rate_hz or wave.sample_rate_hz
    check_rate(rate_hz)
    names = [f"channel {number}" for number in range(1, wave.channels + 1)]
    chosen = request.chosen(names)
    first, last = request.part(wave.frames, rate_hz)
    check_size(len(chosen), last - first)
    stored = by_channel(partial(_frames, request, wave, chosen), first, last, len(chosen))
    is_whole = wave.kind == PCM
    scales = stated_scales(wave.comment, wave.channels)
    pascal = wave.pascal_at_full_scale if is_whole else None
    if pascal is not None:
        scales = [(pascal, "Pa")] * wave.channels
    highest = 1.0 - 2.0 ** (1 - 8 * wave.sample_bytes)
    return Recorded(
        names=[names[column] for column in chosen],
        units=[scales[column][1] if scales else "" for column in chosen],
        samples=[_full_scale_fraction(samples) for samples in stored],
        sample_rate_hz=rate_hz,
        full_scale=is_whole,
        first_sample=first,
        total_samples=wave.frames,
        limits=[(-1.0, highest) if is_whole else None] * len(chosen),
        calibration=[scales[column][0] if scales else None for column in chosen],
    )


def _frames(request: Request, wave: Wave, chosen: Sequence[int], first: int, last: int) -> Samples:
    """Stored samples of some channels, shape (time, channel); 24 bits as the upper ones of 32."""
    width = wave.sample_bytes
    kinds = {1: "u1", 2: "i2", 4: "i4", 8: "i8"} if wave.kind == PCM else {4: "f4", 8: "f8"}
    is_24 = wave.kind == PCM and width == 3
    if width not in kinds and not is_24:
        raise StorageError(f"has samples of {8 * width} bits: known are 8 to 64, floats 32 and 64")
    values = (last - first) * wave.channels
    offset = wave.start + first * wave.channels * width
    if not is_24:
        kind = np.dtype(kinds[width]).newbyteorder(wave.order)
        stored = np.fromfile(request.path, kind, values, offset=offset)
        return stored.reshape(-1, wave.channels)[:, chosen]
    raw = np.fromfile(request.path, "u1", 3 * values, offset=offset).reshape(-1, 3)
    padded = np.zeros((values, 4), dtype="u1")
    padded[:, 1:] = raw if wave.order == "<" else raw[:, ::-1]
    return padded.view("<i4").reshape(-1, wave.channels)[:, chosen]


def _full_scale_fraction(stored: Samples) -> Samples:
    """Integers over half their range, so that full scale is 1; 8 bits are stored from 0 to 255."""
    if stored.dtype.kind == "f":
        return stored
    half_range = 2.0 ** (8 * stored.dtype.itemsize - 1)
    offset = half_range if stored.dtype.kind == "u" else 0.0
    return np.asarray((stored - offset) / half_range)


register(Reader("wav", (".wav", ".rf64", ".bwf"), "WAV", read))
