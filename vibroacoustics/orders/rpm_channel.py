"""Crank motion from a recorded speed."""

from collections.abc import Callable, Iterator
from typing import Final

import numpy as np

from ..base.arrays import Array, IndexArray
from ..base.errors import ParameterError
from .crank_motion import CrankMotion, from_angle

_POINTS_PER_S: Final = 20
"""Points of a recorded speed: it holds nothing faster than the 10 Hz that drives are controlled
at."""
_LEAST_POINTS: Final = 4
_STANDSTILL: Final = 0.01
"""Share of the highest speed up to which a shaft that starts or stops counts as standing."""

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
    return rpm_motion_of(lambda: iter((speed_rpm,)), speed_rpm.size, sample_rate_hz)


def rpm_motion_of(blocks: Blocks, samples: int, sample_rate_hz: float) -> CrankMotion:
    """Crank motion from a speed channel that comes in blocks; see `rpm_motion`.

    Parameters
    ----------
    blocks : read twice; thrice where the speed falls to zero
    samples : number of samples of all blocks
    sample_rate_hz : samples per second
    """
    if samples < _LEAST_POINTS:
        raise ParameterError(
            f"speed: needs at least {_LEAST_POINTS} finite samples of one channel, got {samples}"
        )
    first, last = _turning_part(blocks, samples)
    points = max(_LEAST_POINTS, int(_POINTS_PER_S * (last - first) / sample_rate_hz))
    probes = np.linspace(first, last - 1, min(points, last - first)).round().astype(int)
    angle_rad = 2.0 * np.pi / 60.0 / sample_rate_hz * _integral(blocks(), probes)
    return from_angle(probes / sample_rate_hz, angle_rad)


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


def _integral(blocks: Iterator[Array], probes: IndexArray) -> Array:
    """Sum of the trapezoids from the first of some rising samples up to each of them."""
    integral = np.zeros(probes.size)
    added, total, before = 0, 0.0, 0.0
    for block in blocks:
        steps = 0.5 * (block + np.concatenate([[before], block[:-1]]))
        steps[: max(min(probes[0] + 1 - added, block.size), 0)] = 0.0  # up to the first
        sums = total + np.cumsum(steps)
        here = (probes >= added) & (probes < added + block.size)
        integral[here] = sums[probes[here] - added]
        added, total, before = added + block.size, float(sums[-1]), float(block[-1])
    return integral
