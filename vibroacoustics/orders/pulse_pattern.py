"""Pattern of tacho pulses: missing teeth, unequal pitches, too few samples."""

from typing import Final

import numpy as np

from ..base.arrays import Array
from .pulse_faults import NumberedPulses

LEAST_SAMPLES: Final = 4.0
"""Samples between two pulses below which edges are missed: from half the sample rate on pulses
alias."""
_QUICKEST: Final = 0.01
"""Share of the pulses that come so close, as where an aliasing encoder's speed seems to turn."""
_UNEQUAL: Final = 0.02
"""Share of a pitch, from which marks are unequally spaced; speed varies less from tooth to
tooth."""
_CLEAR: Final = 5.0
"""Standard errors by which the pitches of a revolution differ."""
_REPEATED: Final = 0.8
"""Share of the revolutions, and of the gaps, that show a pattern."""
_LEAST_REVOLUTIONS: Final = 5
_MARKS: Final = (2, 3, 4, 5, 6)
"""Marks a revolution that are looked for where one is stated."""


def pulse_notes(pulses: NumberedPulses, pulses_per_revolution: int) -> tuple[tuple[str, ...], bool]:
    """Sentences on the wheel that the pulses come from, and whether its gaps are teeth left out.

    Parameters
    ----------
    pulses : numbered
    pulses_per_revolution : number of pulses that was stated
    """
    gap = _gap_note(pulses, pulses_per_revolution)
    if gap is not None:
        return (gap[0],), gap[1]
    stated = pulses_per_revolution
    for marks in (stated,) if stated > 1 else _MARKS:
        spread = _unequal_pitch(pulses, marks)
        if spread is None:
            continue
        if stated == 1:
            return (
                f"intervals repeat every {marks} pulses and differ by {100.0 * spread:.0f} %: "
                f"{marks} unequal marks a revolution? 1 pulse a revolution is stated",
            ), False
        return (
            f"the {marks} pulses of a revolution are unequally spaced, by {100.0 * spread:.0f} % "
            "of a pitch, or the speed swings as much within each revolution: taken for the latter",
        ), False
    return (), False


def sampling_note(pulse_times_s: Array, sample_rate_hz: float) -> str | None:
    """A sentence where pulses come too quickly for the sample rate.

    Parameters
    ----------
    pulse_times_s : rising, shape (pulse,)
    sample_rate_hz : sample rate of the channel
    """
    if pulse_times_s.size < 2:
        return None
    samples = float(np.quantile(np.diff(pulse_times_s), _QUICKEST) * sample_rate_hz)
    if samples >= LEAST_SAMPLES:
        return None
    return (
        f"pulses come every {samples:.1f} samples, {LEAST_SAMPLES:g} are needed: pulses are missed "
        "or alias, and the speed may be wrong; sample faster, or take fewer pulses a revolution"
    )


def _gap_note(pulses: NumberedPulses, stated: int) -> tuple[str, bool] | None:
    """Teeth that are missing in every revolution; whether the stated number counts them."""
    steps = np.diff(pulses.number)
    gaps = np.flatnonzero(steps > 1)
    if gaps.size < _LEAST_REVOLUTIONS:
        return None
    apart = np.diff(pulses.number[gaps])
    teeth, absent = int(np.median(apart)), int(np.median(steps[gaps])) - 1
    regular = np.mean((apart == teeth) & (steps[gaps[1:]] == absent + 1))
    if regular < _REPEATED or teeth < 3:
        return None
    wheel = f"{absent} of {teeth} pulses are missing regularly, as on a wheel of {teeth} - {absent}"
    if teeth == stated:
        return f"{wheel} teeth: the gaps are counted", True
    return f"{wheel} teeth; {stated} pulses a revolution are stated: give {teeth}", False


def _unequal_pitch(pulses: NumberedPulses, marks: int) -> float | None:
    """Largest difference among the pitches of a revolution, of their mean; None where not clear."""
    period = np.log(np.diff(pulses.time_s) / np.diff(pulses.number))
    if period.size < _LEAST_REVOLUTIONS * marks:
        return None
    window = marks + 1 - marks % 2
    weight = np.full(window, 1.0 / marks)
    if marks % 2 == 0:
        weight[[0, -1]] /= 2.0
    half = window // 2
    deviation = period[half:-half] - np.convolve(period, weight, mode="valid")
    position = pulses.number[half : half + deviation.size] % marks
    count = np.bincount(position, minlength=marks)
    if count.min() < _LEAST_REVOLUTIONS - 2:
        return None
    mean = np.bincount(position, deviation, minlength=marks) / count
    noise = float(np.std(deviation - mean[position]))
    spread = float(np.ptp(mean))
    is_clear = spread > max(_UNEQUAL, _CLEAR * noise / np.sqrt(count.min()))
    return spread if is_clear and noise < spread else None
