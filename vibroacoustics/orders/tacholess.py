"""Crank motion from the signal itself, where no speed was recorded."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import scipy  # loads its subpackages when they are needed
from scipy.interpolate import PPoly

from ..base.allowed import check_range
from ..base.arrays import Array
from ..base.errors import ParameterError
from ..study.order_analysis import DEFAULT_COMB, MAINS_HZ
from .crank_motion import CrankMotion, from_curve
from .mains import without_mains
from .speed_check import SpeedCheck, checked_profile
from .speed_profiles import Search, best_profiles

_OVERSAMPLING: Final = 4
"""Samples per period of the highest order: the frames are straightened by linear interpolation."""

_LEAST_SAMPLES: Final = 96
"""Least number of samples of 24 revolutions."""


@dataclass(frozen=True)
class TacholessResult:
    """Crank motion from a signal, with how sure it is."""

    motion: CrankMotion
    """Its angle is zero at its start, not at a mark on the shaft: phases of orders are relative."""
    time_s: Array
    """Centres of the frames."""
    confidence: Array
    """Confidence of each frame, 0 to 1: likelihood of its speed over the sum of it and that of the
    best speed more than 5 % away. Above 0.5 the speed explains the frame better than every other
    one within the limits; in noise its mean is 0.3 to 0.5."""
    check: SpeedCheck
    """Check of all frames together, in the order spectrum that the speed makes."""


def tacholess_motion(
    signal: Array,
    sample_rate_hz: float,
    minimum_frequency_hz: float,
    maximum_frequency_hz: float,
    orders: Sequence[float] = DEFAULT_COMB,
    maximum_change_per_s: float = 1.0,
    mains_hz: float | None = None,
) -> TacholessResult:
    """Crank motion of a shaft from the orders in a signal, without a tacho.

    Speed profiles that explain short spectra (`best_profiles`), and an even speed, are compared in
    the order spectra that they make: where the clear lines of a long spectrum lie at the teeth of
    the comb, and what else explains them (`checked_profile`). A sum of the levels at the orders in
    short spectra alone (Leclere, Andre and Antoni, Mechanical Systems and Signal Processing 81,
    2016) follows strong lines beside the orders: hum, or a gear mesh. The motion reaches from the
    centre of the first frame to that of the last.

    Parameters
    ----------
    signal : shape (time,), of one channel, any unit
    sample_rate_hz : samples per second
    minimum_frequency_hz, maximum_frequency_hz : lowest and highest frequency of the shaft; frames
        are as long as eight revolutions at the lowest
    orders : rising, of the comb; the better they are those of the machine, the surer is the speed
    maximum_change_per_s : largest relative change of the speed, 1/s
    mains_hz : nominal frequency of the mains, whose multiples are removed; None where there are
        none

    Raises
    ------
    ParameterError
        The signal is empty, not finite, constant or shorter than 24 revolutions at the lowest
        frequency, the frequencies are not 0 < minimum < maximum, the orders do not rise from above
        zero, half the sample rate is below the lowest order, or the mains frequency is out of
        range.
    """
    order = np.asarray(orders, dtype=float)
    _check(signal, sample_rate_hz, minimum_frequency_hz, maximum_frequency_hz, order)
    down = int(sample_rate_hz / (_OVERSAMPLING * order[-1] * maximum_frequency_hz))
    down = max(1, min(down, signal.size // _LEAST_SAMPLES))
    samples, rate = scipy.signal.resample_poly(signal, 1, down), sample_rate_hz / down
    if mains_hz is not None:
        check_range("mains_hz", mains_hz, *MAINS_HZ, "Hz")
        samples = without_mains(samples, rate, mains_hz)
    search = Search(
        samples, rate, order, minimum_frequency_hz, maximum_frequency_hz, maximum_change_per_s
    )
    profile, check = checked_profile(search, best_profiles(search))
    angle = PPoly(2.0 * np.pi * profile.curve.c, profile.curve.x).antiderivative()
    return TacholessResult(from_curve(angle), profile.time_s, profile.confidence, check)


def _check(signal: Array, rate: float, minimum: float, maximum: float, orders: Array) -> None:
    if signal.ndim != 1 or not np.all(np.isfinite(signal)):
        raise ParameterError("signal: needs finite samples of one channel")
    if signal.size == 0 or np.ptp(signal) == 0.0:
        raise ParameterError(f"signal: {signal.size} samples, all the same; no speed is in them")
    if not 0.0 < minimum < maximum:
        raise ParameterError(
            f"minimum_frequency_hz = {minimum:g} Hz, maximum_frequency_hz = {maximum:g} Hz: must "
            "rise from above zero"
        )
    if orders.size == 0 or not np.all(np.diff(orders, prepend=0.0) > 0.0):
        raise ParameterError(f"orders = {orders.tolist()}: must rise from above zero")
    if not orders[0] * maximum < 0.5 * rate:
        raise ParameterError(
            f"maximum_frequency_hz = {maximum:g} Hz: order {orders[0]:g} is not below half the "
            f"sample rate of {rate:g} Hz"
        )
