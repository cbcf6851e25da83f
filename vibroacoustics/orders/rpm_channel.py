"""Crank motion from a recorded speed."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from ..base.arrays import Array, IndexArray
from ..base.errors import ParameterError
from .crank_motion import CrankMotion, from_angle
from .rpm_faults import SpeedFault, listed_faults, repaired, without_strays

_POINTS_PER_S: Final = 20
"""Points of a recorded speed: it holds nothing faster than the 10 Hz that drives are controlled
at."""
_LEAST_POINTS: Final = 4
_STANDSTILL: Final = 0.01
"""Share of the highest speed up to which a shaft that starts or stops counts as standing."""

_WIDE: Final = 0.3
"""Range of the speed within an interval, relative, from which strays are looked for."""
_HELD_SAMPLES: Final = 8
"""Samples with the same value from which a speed counts as held."""

Blocks = Callable[[], Iterator[Array]]
"""Starts over with the channel's blocks, each of shape (time,)."""


def rpm_motion(speed_rpm: Array, sample_rate_hz: float) -> CrankMotion:
    """Crank motion from a recorded speed channel; its angle is zero where it begins.

    The speed is integrated over every sample; the angle is a cubic spline through twenty points a
    second, so that noise of the channel averages out. A standstill before and behind is cut off:
    the motion begins and ends there.

    Parameters
    ----------
    speed_rpm : shape (time,)
    sample_rate_hz : samples per second

    Raises
    ------
    ParameterError
        There are fewer than four samples, one is not finite, or the shaft stops.
    """
    if speed_rpm.ndim != 1 or not np.all(np.isfinite(speed_rpm)):
        raise ParameterError(
            f"speed: needs at least {_LEAST_POINTS} finite samples of one channel, got shape "
            f"{speed_rpm.shape}"
        )
    return rpm_motion_of(lambda: iter((speed_rpm,)), speed_rpm.size, sample_rate_hz).motion


@dataclass(frozen=True)
class RpmMotion:
    """Crank motion from a recorded speed, and what was wrong with it.

    Attributes
    ----------
    motion : crank motion
    faults : spikes, drop-outs and frozen parts, which are interpolated
    held_s : mean time for which a value is held; 0 where the channel has a value for each sample
    """

    motion: CrankMotion
    faults: tuple[SpeedFault, ...] = ()
    held_s: float = 0.0


def rpm_motion_of(
    blocks: Blocks, samples: int, sample_rate_hz: float, factor: float = 1.0
) -> RpmMotion:
    """Crank motion from a speed channel that comes in blocks; see `rpm_motion`.

    Spikes, drop-outs and frozen parts are interpolated.

    Parameters
    ----------
    blocks : read twice; thrice where the speed falls to zero
    samples : number of samples of all blocks
    sample_rate_hz : samples per second
    factor : rpm per unit of the channel
    """
    if samples < _LEAST_POINTS:
        raise ParameterError(
            f"speed: needs at least {_LEAST_POINTS} finite samples of one channel, got {samples}"
        )
    first, last = _turning_part(blocks, samples)
    points = max(_LEAST_POINTS, int(_POINTS_PER_S * (last - first) / sample_rate_hz))
    probes = np.linspace(first, last - 1, min(points, last - first)).round().astype(int)
    means = _interval_means(blocks(), probes)
    mended, is_fault = repaired(means.mean, means.low == means.high)
    time_s = probes / sample_rate_hz
    faults = listed_faults(factor * means.mean, is_fault, factor * mended, time_s)
    faults += [
        SpeedFault("spike" if value > 0.0 else "drop-out", number / sample_rate_hz,
                   number / sample_rate_hz, factor * abs(value))
        for number, value in means.strays
    ]  # fmt: skip
    turned = np.concatenate([[0.0], np.cumsum(mended * np.diff(probes))]) * factor
    motion = from_angle(time_s, 2.0 * np.pi / 60.0 / sample_rate_hz * turned)
    held_s = (last - first) / max(means.changes, 1) / sample_rate_hz
    is_held = means.changes * _HELD_SAMPLES < last - first and means.changes >= _LEAST_POINTS
    return RpmMotion(motion, tuple(sorted(faults, key=_start)), held_s if is_held else 0.0)


def _start(fault: SpeedFault) -> float:
    return fault.start_s


def _turning_part(blocks: Blocks, samples: int) -> tuple[int, int]:
    """First sample of the shaft's longest run, and the one behind its last.

    All of a channel that never falls to zero; else what lies above a hundredth of the highest
    speed. A second run or one backwards, of more than a hundredth of the first, is left in: it
    is no standstill before or behind, and the motion refuses it.
    """
    lowest, highest = np.inf, -np.inf
    for block in blocks():
        lowest, highest = min(lowest, float(block.min())), max(highest, float(block.max()))
    if lowest > 0.0 or not highest > 0.0:
        return 0, samples
    begins, ends, moving = _runs(blocks(), samples, _STANDSTILL * highest)
    longest = int(np.argmax(ends - begins))
    first, last = int(begins[longest]), int(ends[longest])
    if moving - (last - first) > _STANDSTILL * (last - first) or last - first < _LEAST_POINTS:
        return 0, samples
    return first, last


def _runs(
    blocks: Iterator[Array], samples: int, standing_rpm: float
) -> tuple[IndexArray, IndexArray, int]:
    """First samples of the runs forwards, those behind the last; samples of runs either way."""
    edges, moving, added, turned = [], 0, 0, False
    for block in blocks:
        turns = np.concatenate([[turned], block > standing_rpm])
        edges.append(added + np.flatnonzero(turns[1:] != turns[:-1]))
        moving += int(np.count_nonzero(np.abs(block) > standing_rpm))
        added, turned = added + block.size, bool(turns[-1])
    edges.append(np.array([samples] if turned else [], dtype=np.intp))
    borders = np.concatenate(edges)
    return borders[::2], borders[1::2], moving


class _Means(NamedTuple):
    """Mean, lowest and highest of intervals; strays with their sign; changes of the value."""

    mean: Array
    low: Array
    high: Array
    strays: list[tuple[int, float]]
    changes: int


def _interval_means(blocks: Iterator[Array], probes: IndexArray) -> _Means:
    """Means of the intervals between some rising samples, by the trapezoidal rule."""
    count = probes.size - 1
    mean, low, high = np.empty(count), np.empty(count), np.empty(count)
    strays: list[tuple[int, float]] = []
    kept: Array = np.empty(0)
    added, done, changes = 0, 0, 0
    for block in blocks:
        # From the first sample of the next interval on.
        data, begin = np.concatenate([kept, block]), added - kept.size
        added += block.size
        last = int(np.searchsorted(probes, added)) - 1  # intervals that are complete
        if last > done:
            part = data[probes[done] - begin : probes[last] - begin + 1].copy()
            starts = probes[done:last] - probes[done]
            low[done:last], high[done:last] = (
                extreme.reduceat(part[:-1], starts) for extreme in (np.minimum, np.maximum)
            )
            changes += int(np.count_nonzero(part[1:] != part[:-1]))
            wide = high[done:last] - low[done:last] > _WIDE * np.abs(high[done:last])
            for number in np.flatnonzero(wide).tolist():
                of_interval = slice(starts[number], probes[done + number + 1] - probes[done])
                mended, is_stray = without_strays(part[of_interval])
                if 0 < np.count_nonzero(is_stray) < 0.5 * is_stray.size:
                    worst = int(np.argmax(np.abs(part[of_interval] - mended)))
                    sign = 1.0 if part[of_interval][worst] > mended[worst] else -1.0
                    strays.append(
                        (int(probes[done + number]) + worst, sign * abs(part[of_interval][worst]))
                    )
                    part[of_interval] = mended
            sums = np.add.reduceat(0.5 * (part[1:] + part[:-1]), starts)
            mean[done:last] = sums / np.diff(probes[done : last + 1])
            done = last
        kept = data[max(int(probes[done]) - begin, 0) :] if done < count else np.empty(0)
    return _Means(mean, low, high, strays, changes)
