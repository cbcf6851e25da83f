"""A signal over the angle of a speed profile: its lines, frames, and what is left without it."""

from dataclasses import replace
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import fft
from scipy.interpolate import CubicSpline, PPoly

from ..base.arrays import Array
from .comb_evidence import Lines, are_in_place, clear_lines
from .speed_comb import comb_scores, frame_levels, refine, smooth_curve
from .speed_profiles import MOST_LEVEL, Search, SpeedProfile

_BLOCKS: Final = 4.0
"""Lengths of a block in the recording; fewer average nothing, more resolve less."""
_MOST_REVOLUTIONS: Final = 128
"""Revolutions of a block, midway between the limits."""
_LEAST_REVOLUTIONS: Final = 8
_FLOOR_ORDERS: Final = 4.0
"""Width of the running median under the lines of an order spectrum."""
_SKIRT: Final = 0.006
"""Relative distance up to which a line is taken out with its skirt."""
_SKIRT_LINES: Final = 3.0
_FRAME_REVOLUTIONS: Final = 24
_SPAN: Final = 0.006
"""Relative distance over which a speed profile is refined."""
_TRIALS: Final = 25
_LOW_ORDERS: Final = 3
_BEST_ORDERS: Final = 2
_CLEAR_LEVEL: Final = 1.9
"""Level of a line in a frame, ln of power over floor less its mean in noise: 10 dB over the
floor."""
_STANDS_OUT: Final = 0.5
"""Share of their usual score, in ln of power over floor, that orders have when followed."""


class Unrolled:
    """The signal over the angle of a speed profile, evenly sampled in revolutions.

    Parameters
    ----------
    search : signal and limits of the speed
    profile : speed profile, above zero at all times
    """

    def __init__(self, search: Search, profile: SpeedProfile) -> None:
        self.search, self.profile = search, profile
        rate = search.rate_hz
        first = int(np.ceil(profile.time_s[0] * rate))
        self._at = slice(first, int(profile.time_s[-1] * rate))
        self._time_s = np.arange(self._at.start, self._at.stop) / rate
        turned = profile.curve.antiderivative()(self._time_s)
        self._turned = np.asarray(turned - turned[0])
        self._per_revolution = max(int(self._turned.size / max(self._turned[-1], 1e-9)), 2)

    @property
    def is_rising(self) -> bool:
        """Whether the angle rises everywhere, over some revolutions."""
        enough = self._turned[-1] >= _LEAST_REVOLUTIONS * _BLOCKS / 2.0
        return bool(enough and np.all(np.diff(self._turned) > 0.0))

    @cached_property
    def _signal(self) -> Array:
        grid = np.arange(0.0, self._turned[-1], 1.0 / self._per_revolution)
        return np.asarray(np.interp(grid, self._turned, self.search.samples[self._at]))

    @cached_property
    def lines(self) -> Lines:
        """Clear lines of its spectrum, over the orders of the speed profile."""
        search = self.search
        middle_hz = float(np.sqrt(search.minimum_hz * search.maximum_hz))
        # Equal for all time histories: only then can their lines be compared with each other.
        most = min(self._signal.size / _BLOCKS, _MOST_REVOLUTIONS * search.rate_hz / middle_hz)
        orders = middle_hz * (self._time_s[-1] - self._time_s[0]) / self._turned[-1]
        floor = _FLOOR_ORDERS * orders
        return clear_lines(self._signal, self._per_revolution, int(most), floor)

    @cached_property
    def _frames(self) -> tuple[Array, Array, int]:
        return self._frames_of(_FRAME_REVOLUTIONS)

    def _frames_of(self, wanted: int) -> tuple[Array, Array, int]:
        """Levels of frames, times of their centres, s, and number of bins per order.

        Levels have the shape (frame, bin). Frames have the wanted number of revolutions, at most a
        third of the signal.
        """
        revolutions = max(int(min(wanted, self._turned[-1] / 3.0)), 1)
        length = revolutions * self._per_revolution
        starts = np.arange(0, self._signal.size - length + 1, length / 4)
        centres = np.asarray(0.5 * (length - 1) + starts, dtype=np.float64)
        still = np.zeros(centres.size)
        levels = frame_levels(self._signal, centres, length, still, 12 * revolutions + 1)
        when = np.interp(centres / self._per_revolution, self._turned, self._time_s)
        return levels, when, 2 * revolutions

    def followed(self, scale: float = 1.0) -> float:
        """Share of the frames in which the score of the orders is above half its median.

        Parameters
        ----------
        scale : factor on the speed of the profile
        """
        levels, _, bins = self._frames
        score = comb_scores(
            np.minimum(levels, MOST_LEVEL), self.search.orders, np.array([scale * bins])
        )[:, 0]
        return float(np.mean(score > _STANDS_OUT * np.median(score)))

    def low_lines(self, scale: float = 1.0) -> NDArray[np.bool_]:
        """Whether the lowest orders that have a clear line stand out, shape (order, frame).

        Of the three lowest, the two that stand out in most frames: a weak one may be lost in noise.

        Parameters
        ----------
        scale : factor on the speed of the profile
        """
        levels, _, bins = self._frames
        order = scale * self.search.orders
        bins_of_orders = np.rint(
            bins * order[are_in_place(self.lines, order)][:_LOW_ORDERS]
        ).astype(int)
        bins_of_orders = bins_of_orders[bins_of_orders < levels.shape[1] - 1]
        level = np.maximum.reduce([levels[:, bins_of_orders + step] for step in (-1, 0, 1)])
        stands_out = np.asarray(level.T > _CLEAR_LEVEL)
        return stands_out[np.argsort(-stands_out.mean(axis=1))[:_BEST_ORDERS]]

    def polished(self, revolutions: int = _FRAME_REVOLUTIONS) -> SpeedProfile:
        """The speed profile after refining it in frames.

        Parameters
        ----------
        revolutions : revolutions of a frame
        """
        levels, when, bins = self._frames_of(revolutions)
        trials = bins * np.exp(_SPAN * np.linspace(-1.0, 1.0, _TRIALS))
        middle = np.full(when.size, _TRIALS // 2)
        ratio = refine(levels, self.search.orders, trials, middle) / bins
        knots = self.profile.time_s
        factor = smooth_curve(when, ratio).curve(np.clip(knots, when[0], when[-1]))
        spline = CubicSpline(knots, self.profile.curve(knots) * factor)
        return replace(self.profile, curve=PPoly(spline.c, spline.x))

    def without_orders(self) -> Search:
        """The search in what is left of the signal without the orders of the speed profile."""
        spectrum = fft.rfft(self._signal)
        order = np.arange(spectrum.size) * (self._per_revolution / self._signal.size)
        for number in self.search.orders[self.search.orders < self.lines.highest]:
            reach = _SKIRT * number + _SKIRT_LINES * self.lines.resolution
            spectrum[np.abs(order - number) <= reach] = 0.0
        without_orders = fft.irfft(spectrum, self._signal.size)
        grid = np.arange(without_orders.size) / self._per_revolution
        samples = self.search.samples.copy()
        samples[self._at] = np.interp(self._turned, grid, without_orders)
        return replace(self.search, samples=samples)
