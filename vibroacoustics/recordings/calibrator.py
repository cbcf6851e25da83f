"""Calibration factor of a microphone from the recording of a sound calibrator (IEC 60942)."""

from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from ..base.allowed import check_range
from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import amplitude_of_level, level_of_amplitude, level_of_power, power_of_level
from ..base.errors import ParameterError
from .asked import naming_file
from .reading import read_recording
from .recorded import check_rate, listed

BLOCK_S: Final = 0.25
"""Length of the blocks whose levels are compared."""
STEADY_DB: Final = 0.1
"""Largest deviation of a block's level from the median of those that are used."""
LEAST_STEADY_S: Final = 1.0
LEAST_RATIO_DB: Final = 20.0
"""Least level of the tone above all else within an octave around it."""
FREQUENCY_RATIO: Final = 0.05
"""Largest deviation of the tone from the nominal frequency."""
LEVELS_DB: Final = (60.0, 140.0)
LOWEST_HZ: Final = 20.0
"""Lowest frequency of a calibrator: an octave around it has four lines in a single block."""


@dataclass(frozen=True)
class CalibratorReading:
    """Reading of the recording of a calibrator.

    Attributes
    ----------
    channel : channel of the file
    pascal_per_unit : calibration factor, Pa per unit stored in the file
    frequency_hz : frequency of the tone
    steady_s : length of the part that was used

    Examples
    --------
    >>> va.CalibratorReading("front", pascal_per_unit=28.35, frequency_hz=1000.0, steady_s=9.5)
    CalibratorReading(channel='front', pascal_per_unit=28.35, frequency_hz=1000.0, steady_s=9.5)
    """

    channel: str
    pascal_per_unit: float
    frequency_hz: float
    steady_s: float


def read_calibrator(
    path: str | Path,
    *,
    channel: str | None = None,
    level_db: float = 94.0,
    frequency_hz: float = 1000.0,
    sample_rate_hz: float | None = None,
) -> CalibratorReading:
    """Read the recording of a sound calibrator on a microphone: the factor from its samples to Pa.

    The factor is for `calibration` of `read_recording` with the unit Pa, for files that the same
    recorder wrote with the same gain.

    Parameters
    ----------
    path : file of any format that `read_recording` reads
    channel : channel of the file; a file with one channel needs none
    level_db : level of the calibrator, dB re 20 µPa
    frequency_hz : frequency of the calibrator
    sample_rate_hz : actual sample rate, where the file states none

    Raises
    ------
    ParameterError
        The channel is not clear, or there is no steady tone at the frequency; see
        `tone_amplitude`.
    StorageError
        The file cannot be read.

    Examples
    --------
    >>> time_s = np.arange(20000) / 10000.0
    >>> tone = 0.05 * np.sin(2.0 * np.pi * 1000.0 * time_s)
    >>> recording = va.label_recording([tone], 10000.0, ["front"], ["V"])
    >>> file = va.export_recording(recording, "calibrator.csv")
    >>> round(va.read_calibrator(file).pascal_per_unit, 2)
    28.35
    """
    path = Path(path)
    stored = read_recording(
        path,
        units={"*": "1"},  # as the file holds them, whatever unit that is
        calibration={"*": 1.0},
        sample_rate_hz=sample_rate_hz,
    )
    names = [str(name) for name in stored["channel"].values]
    with naming_file(path):
        check_range("level_db", level_db, *LEVELS_DB, "dB")
        name = names[0] if len(names) == 1 else channel
        if name not in names:
            raise ParameterError(f"holds the channels {listed(names)}: say which, CHANNEL=FILE")
        signal = stored["signal"].values[names.index(name)]
        rate_hz = float(stored.attrs["sample_rate_hz"])
        amplitude, tone_hz, steady_s = tone_amplitude(signal, rate_hz, frequency_hz)
    pressure_pa = REFERENCE_PRESSURE_PA * amplitude_of_level(level_db)
    factor = float(pressure_pa * np.sqrt(2.0) / amplitude)
    return CalibratorReading(name, factor, tone_hz, steady_s)


def tone_amplitude(
    signal: Array, sample_rate_hz: float, frequency_hz: float
) -> tuple[float, float, float]:
    """Peak amplitude of a steady tone, its frequency, Hz, and the length of its steady part, s.

    The frequency is the maximum of the Hann spectrum near the nominal one, interpolated by a
    parabola through the logarithms of three lines. In blocks of 0.25 s, sine and cosine of it and
    a constant are fitted by least squares; of the longest run of blocks that are within 0.1 dB of
    their median the root mean square amplitude counts. So the handling before and behind is left
    out.

    Parameters
    ----------
    signal : shape (time,), any unit
    sample_rate_hz : sample rate of the signal
    frequency_hz : nominal frequency

    Raises
    ------
    ParameterError
        The frequency is below 20 Hz or above 0.45 of the sample rate; no tone is within 5 % of it,
        or it is less than 20 dB above all else within its octave, or steady for less than a second.
    """
    check_rate(sample_rate_hz)
    check_range("frequency_hz", frequency_hz, LOWEST_HZ, 0.45 * sample_rate_hz, "Hz")
    length = int(np.ceil(BLOCK_S * sample_rate_hz))
    blocks = signal[: signal.size // length * length].reshape(-1, length)
    if len(blocks) * BLOCK_S < LEAST_STEADY_S:
        raise ParameterError(f"lasts {signal.size / sample_rate_hz:.3g} s; at least 1 s is needed")
    strongest = blocks[_longest_steady(np.std(blocks, axis=1))]
    tone_hz = _tone_hz(strongest.ravel(), sample_rate_hz, frequency_hz)
    amplitude = np.abs(_fitted(blocks, sample_rate_hz, tone_hz))
    steady = _longest_steady(amplitude)
    steady_s = (steady.stop - steady.start) * length / sample_rate_hz
    if steady_s < LEAST_STEADY_S:
        raise ParameterError(
            f"has no steady tone at {frequency_hz:g} Hz: its level stays within {STEADY_DB:g} dB "
            f"for {steady_s:.3g} s; at least 1 s is needed"
        )
    used = blocks[steady].ravel()
    tone_hz = _tone_hz(used, sample_rate_hz, frequency_hz)
    amplitude = np.abs(_fitted(blocks[steady], sample_rate_hz, tone_hz))
    return float(np.sqrt(np.mean(amplitude**2))), tone_hz, steady_s


def _longest_steady(amplitude: Array) -> slice:
    """Longest run of blocks within 0.1 dB of the median of the louder half."""
    loud = amplitude[amplitude >= np.median(amplitude)]
    median = max(float(np.median(loud)), np.finfo(float).tiny)
    ratio = np.asarray(amplitude / median)
    is_steady = np.abs(level_of_amplitude(ratio)) <= STEADY_DB
    edges = np.flatnonzero(np.diff(np.concatenate([[0], is_steady.astype(int), [0]])))
    starts, ends = edges[::2], edges[1::2]
    if not starts.size:
        return slice(0, 0)
    longest = int(np.argmax(ends - starts))
    return slice(int(starts[longest]), int(ends[longest]))


def _tone_hz(signal: Array, sample_rate_hz: float, frequency_hz: float) -> float:
    """Frequency of the tone near the nominal one, which must be above all else in its octave."""
    if not signal.size:
        raise ParameterError(f"has no steady tone at {frequency_hz:g} Hz")
    window = np.hanning(signal.size)
    power = np.abs(np.fft.rfft((signal - signal.mean()) * window)) ** 2
    line_hz = sample_rate_hz / signal.size
    low, high = (round(frequency_hz * ratio / line_hz) for ratio in (0.7071, 1.4142))
    octave = slice(max(low, 4), min(high, power.size - 1))
    peak = octave.start + int(np.argmax(power[octave]))
    tone = float(np.sum(power[max(peak - 4, 0) : peak + 5]))
    noise = float(np.sum(power[octave])) - tone
    is_near = abs(peak * line_hz / frequency_hz - 1.0) <= FREQUENCY_RATIO
    if not is_near or not tone > noise * power_of_level(LEAST_RATIO_DB):
        ratio_db = level_of_power(tone / max(noise, np.finfo(float).tiny))
        raise ParameterError(
            f"has no clear tone at {frequency_hz:g} Hz: the strongest within an octave is "
            f"{peak * line_hz:.6g} Hz, {ratio_db:.1f} dB above all else; at least "
            f"{LEAST_RATIO_DB:g} dB are needed"
        )
    before, at_peak, behind = np.log(power[peak - 1 : peak + 2] + 1e-300)
    curvature = before - 2.0 * at_peak + behind
    shift = 0.5 * (before - behind) / curvature if curvature else 0.0
    return float((peak + shift) * line_hz)


def _fitted(blocks: Array, sample_rate_hz: float, frequency_hz: float) -> ComplexArray:
    """Complex peak amplitude of a tone in each block, (block,), by least squares."""
    angle = 2.0 * np.pi * frequency_hz * np.arange(blocks.shape[1]) / sample_rate_hz
    basis = np.stack([np.cos(angle), np.sin(angle), np.ones_like(angle)], axis=1)
    fit = np.linalg.lstsq(basis, blocks.T, rcond=None)[0]
    return np.asarray(fit[0] - 1j * fit[1])
