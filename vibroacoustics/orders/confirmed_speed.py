"""A speed beside the sound: a lag is corrected, a speed that the lines contradict is named."""

import warnings
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np
import scipy  # loads its subpackages when they are needed

from ..base.arrays import Array
from ..base.recording_blocks import RecordingBlocks, block_by_block
from .comb_evidence import best_speeds, clear_lines, evidence, lines_in_place
from .crank_motion import CrankMotion
from .lag_evidence import (
    LEAST_LINES,
    OFF_ORDER,
    departures,
    in_place,
    is_supported,
    line_error,
    moves_off,
    off_orders,
    scale_lag,
)
from .mains import mains_of
from .shaft_speed import RecordedSpeed, UncertainSpeedWarning
from .speed_lag import HIGHEST_ORDER, LEAST_LAG_S, SpeedLag, late, speed_lag

MOST_CHANNELS: Final = 3
"""Channels that are looked at, the first ones."""
_MOST_SAMPLES: Final = 2**25
"""Samples of the channels of a longer recording that are looked at, from its start."""
_VARIES: Final = 0.05
"""Range of a speed, relative, from which a lag changes anything."""
_ERRORS: Final = 5.0
"""Standard errors of a lag that is one."""
_OVERSAMPLING: Final = 2.5
_MOST_LAG_S: Final = 0.9
"""Largest lag that is corrected: trials end at 1 s."""
_BENDS: Final = 2.0
"""Change of the orders that a lag explains, over the scatter of the lines."""
_NEAR: Final = 0.1
"""Distance of a nominal speed from the actual one, relative."""
_APART: Final = 0.004
_HALF_ORDERS: Final[Array] = np.arange(1, 21) / 2.0
_COMB: Final[Array] = np.arange(1, 11, dtype=float)
_UNITS: Final = {
    "rad/s": 30.0 / np.pi, "Hz": 60.0, "rpm instead of rad/s": np.pi / 30.0,
    "rpm instead of Hz": 1.0 / 60.0,
}  # fmt: skip
"""Factors between units of a speed that may be confused."""
_LEAST_HZ: Final = 2.0
_LEAST_EVIDENCE: Final = 8.0
_LEAST_TURNS: Final = 4.0
"""Revolutions below which no line can be compared."""


def confirmed(
    recording: RecordingBlocks, shaft: RecordedSpeed, names: Sequence[str]
) -> RecordedSpeed:
    """Compare a speed with the lines in the sound; correct its lag.

    Parameters
    ----------
    recording : recording of the speed
    shaft : speed of the shaft
    names : channels with its sound or vibration

    Warns
    -----
    UncertainSpeedWarning
        The speed is late, or the lines of the sound contradict it.
    """
    motion, notes = shaft.motion, []
    speeds_hz = _speeds_hz(motion)
    highest_hz = float(speeds_hz.max())
    if recording.samples / recording.sample_rate_hz * highest_hz < _LEAST_TURNS:
        return shaft
    if np.ptp(speeds_hz) < _VARIES * highest_hz:
        if shaft.kind == "nominal":
            signals = _signals(recording, names, highest_hz)
            checked = [_scale_notes(*each, motion) for each in signals]
            is_confirmed = any(each is None for each in checked)
            notes = [] if is_confirmed else [note for each in checked for note in each or ()][:1]
    else:
        lags = list(_lags(_signals(recording, names, highest_hz), motion))
        if lags:
            lag = max(lags, key=lambda pair: pair[0])[1]
            motion, notes = _corrected(shaft, lag)
            notes += departures(lag)
        if shaft.kind == "recorded" and not any(in_place(each.lines).any() for _, each in lags):
            notes = _unit_notes(recording, names, motion, LEAST_LINES if lags else 1) or notes
        if shaft.kind == "recorded" and not notes:
            notes = [note for _, lag in lags for note in _ratio_notes(lag.unmoved_lines)][:1]
    for note in notes:
        warnings.warn(f"speed: {note}", UncertainSpeedWarning, stacklevel=3)
    return replace(shaft, motion=motion, source="; ".join([shaft.source, *notes]))


def _lags(
    signals: Iterable[tuple[Array, float]], motion: CrankMotion
) -> Iterator[tuple[float, SpeedLag]]:
    """Sharpness of the lines and lag of a motion by channel, up to one in which it is sure."""
    highest_hz = float(_speeds_hz(motion).max())
    for signal, rate_hz in signals:
        lag, sharpness = speed_lag(*_decimated(signal, rate_hz, highest_hz), motion)
        if lag is not None:
            yield sharpness, lag
            if lag.is_sure:
                return


def _signals(
    recording: RecordingBlocks, names: Sequence[str], highest_hz: float
) -> Iterator[tuple[Array, float]]:
    """The first channels at rates, Hz, that hold the orders of a speed; each is read once."""
    down = int(recording.sample_rate_hz / (_OVERSAMPLING * HIGHEST_ORDER * highest_hz))
    coarse = max(down // 8, 1)  # a mean is enough of a filter far below its first zero
    for name in names[:MOST_CHANNELS]:
        kept: Array = np.empty(0)
        parts, added = [], 0
        for (block,) in block_by_block(recording, [name]):
            joined = np.concatenate([kept, block])
            complete = joined.size // coarse * coarse
            parts.append(joined[:complete].reshape(-1, coarse).mean(axis=1))
            kept, added = joined[complete:], added + block.size
            if added > _MOST_SAMPLES:
                break
        means = np.concatenate(parts)
        rate_hz = recording.sample_rate_hz / coarse
        yield _decimated(means - means.mean(), rate_hz, highest_hz)


def _decimated(signal: Array, rate_hz: float, highest_hz: float) -> tuple[Array, float]:
    """A signal, shape (time,), at the lowest rate that holds the orders, and that rate, Hz."""
    down = max(int(rate_hz / (_OVERSAMPLING * HIGHEST_ORDER * highest_hz)), 1)
    return scipy.signal.resample_poly(signal, 1, down), rate_hz / down


def _corrected(shaft: RecordedSpeed, lag: SpeedLag) -> tuple[CrankMotion, list[str]]:
    """Motion without its lag, and a sentence on it; the motion as it is without a clear lag."""
    is_lag = abs(lag.lag_s) > max(LEAST_LAG_S, _ERRORS * lag.error_s)
    motion, held_s = shaft.motion, shaft.held_s
    lag_s = scale_lag(lag) if shaft.kind == "recorded" else 0.0
    if is_lag and lag.bend > _BENDS and not moves_off(lag) and is_supported(lag):
        lag_s = lag.lag_s
    shifted = late(motion, lag_s)
    if abs(lag_s) < LEAST_LAG_S or shifted is None:
        return motion, []
    orders = ", ".join(f"{order:.4g}" for order in np.sort(lag.unmoved_lines))
    word = "late" if lag_s > 0.0 else "early"
    note = f"{abs(lag_s):.3g} s {word} beside lines of the sound (near orders {orders})"
    if held_s > LEAST_LAG_S:
        note += f", its values are held for {held_s:.3g} s"
    if abs(lag_s) > _MOST_LAG_S:
        return motion, [f"{note}, beyond what lines fix surely: not corrected, orders read too low"]
    if lag.lines.size == 1 and lag_s != lag.lag_s:
        return motion, [f"{note}, if that is a whole order: not corrected, orders read too low"]
    return shifted, [f"{note}: corrected"]


def _unit_notes(
    recording: RecordingBlocks, names: Sequence[str], motion: CrankMotion, least_lines: int
) -> list[str]:
    """Name the unit in which a recorded speed has lines at its orders, and else none."""
    most_hz = recording.sample_rate_hz / (2.0 * LEAST_LINES)
    highest_hz = float(_speeds_hz(motion).max())
    factors = {
        unit: each for unit, each in _UNITS.items() if _LEAST_HZ < each * highest_hz < most_hz
    }
    if not factors:
        return []
    signals = list(_signals(recording, names, max(factors.values()) * highest_hz))
    for unit, factor in factors.items():
        for _, lag in _lags(signals, motion.geared(factor)):
            are_orders = off_orders(lag.lines) < np.minimum(line_error(lag.lines), OFF_ORDER)
            if lag.lines.size >= least_lines and are_orders.all():
                lines = ", ".join(f"{order:.4g}" for order in np.sort(lag.lines))
                return [
                    f"no line of the sound is an order of it; as a speed in {unit} it has lines at "
                    f"orders {lines}: orders are wrong; state its unit"
                ]
    return []


def _ratio_notes(lines: Array) -> list[str]:
    """Name the speed whose orders all lines are, where none is an order of the recorded one.

    The orders have no common divisor: multiples of one line would fit many speeds.
    """
    error = line_error(lines)
    if lines.size < LEAST_LINES or np.any(off_orders(lines) < error):
        return []
    for order in range(max(round(lines[0]) - 1, 1), round(lines[0]) + 2):
        ratio = lines[0] / order
        nearest = np.rint(lines / ratio)
        ratio = float(np.sum(lines * nearest) / max(np.sum(nearest**2), 1.0))
        is_sure = np.all(np.abs(lines - ratio * nearest) < error) and nearest.min() > 0.0
        if is_sure and np.gcd.reduce(nearest.astype(int)) == 1 and abs(ratio - 1.0) < _NEAR:
            return [
                f"no line of the sound is an order of it, all {lines.size} are of {ratio:.4g} "
                "times the speed: orders read too low; check its factor, or find it in the signal"
            ]
    return []


def _speeds_hz(motion: CrankMotion) -> Array:
    """Speeds of a motion at times evenly apart, shape (1000,)."""
    times = np.linspace(motion.start_s, motion.end_s, 1000, dtype=float)
    return motion.frequency_hz(np.asarray(times))


def _scale_notes(signal: Array, rate_hz: float, motion: CrankMotion) -> list[str] | None:
    """Name the speed that the lines fit; None where a nominal one explains some of them."""
    first = int(np.ceil(motion.start_s * rate_hz))
    samples = signal[first : int(motion.end_s * rate_hz) + 1]
    hertz = float(motion.frequency_hz(np.array([motion.start_s]))[0])
    per_revolution = rate_hz / hertz
    length = int(min(samples.size / 3.0, 200.0 * per_revolution))
    if length < 24.0 * per_revolution:
        return []
    lines = clear_lines(samples, per_revolution, length, 4.0)
    explained = lines_in_place(lines, _HALF_ORDERS)[0]
    scales, worths = best_speeds(lines, _COMB, 1.0 - _NEAR, 1.0 + _NEAR, _APART)
    if explained:
        return None
    if scales.size == 0 or mains_of(np.array([scales[0] * hertz])) is not None:
        return []
    explained = lines_in_place(lines, scales[0] * _COMB)[0]
    gain = worths[0] - evidence(lines, _COMB, np.ones(1))[0]
    if explained < LEAST_LINES or gain < _LEAST_EVIDENCE or abs(scales[0] - 1.0) < _APART:
        return []
    rpm = 60.0 * hertz
    return [
        f"no line of the sound is an order of {rpm:.4g} rpm, {explained} are of "
        f"{scales[0] * rpm:.4g} rpm: orders read too low; give that speed, or find it in the signal"
    ]
