"""Order map of a recording in blocks: neither it nor its signal over the angle is kept."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from .angular import AngularSignal, joined
from .angular_plan import AngularPlan
from .angular_stream import angular_parts
from .block_spectra import block_hop, block_starts
from .crank_motion import CrankMotion
from .order_map import OrderMap, block_revolutions, order_map
from .windows import window_by_name


class OrderMapBlocks:
    """Takes a signal over the crank angle part by part and gives the blocks of its order map.

    Parameters
    ----------
    resolution_order, window, overlap_ratio : see `order_map`
    """

    def __init__(self, resolution_order: float, window: str, overlap_ratio: float) -> None:
        self._settings = resolution_order, window, overlap_ratio
        self._length = block_revolutions(window_by_name(window), resolution_order, np.inf)
        self._pending: AngularSignal | None = None

    def add(self, part: AngularSignal) -> tuple[AngularSignal, OrderMap] | None:
        """Take the next samples; return the blocks that they end, with their samples, or None."""
        signal = joined(self._pending, part)
        self._pending = signal
        if signal.time_s.size < self._length * signal.samples_per_revolution:
            return None
        spectra = order_map(signal, *self._settings)
        hop = block_hop(spectra.revolutions * signal.samples_per_revolution, self._settings[2])
        self._pending = signal.behind(int(spectra.starts[-1]) + hop)
        return signal, spectra


def order_map_of_blocks(
    blocks: Iterable[Array],
    samples: int,
    sample_rate_hz: float,
    motion: CrankMotion,
    maximum_order: float,
    resolution_order: float,
    window: str = "hann",
    overlap_ratio: float = 0.5,
) -> OrderMap:
    """Order map of a recording that comes in blocks: as `order_map` of `angular_resample`.

    Parameters
    ----------
    blocks : the recording, one block after the other, shape (channel, time) each
    samples : number of samples of a channel in all blocks together
    sample_rate_hz : sample rate of the recording
    motion : crank angle over (a part of) its time
    maximum_order : highest order to keep
    resolution_order, window, overlap_ratio : see `order_map`

    Raises
    ------
    ParameterError
        See `angular_resample` and `order_map`.

    Examples
    --------
    >>> motion = va.orders.constant_speed(50.0, 0.0, 4.0)  # Hz, from and to in s
    >>> tone = np.cos(motion.angle_rad(np.arange(4096) / 1024.0))
    >>> blocks = (tone[None, first : first + 512] for first in range(0, 4096, 512))
    >>> spectra = va.orders.order_map_of_blocks(blocks, 4096, 1024.0, motion, 4.0, 0.25)
    >>> va.orders.order_cut(spectra, [1.0]).rms[0, 0].round(3)
    array([0.707])
    """
    plan = AngularPlan(sample_rate_hz, samples, motion, maximum_order)
    spanned, per_revolution = plan.grid[1] + 1 - plan.grid[0], plan.samples_per_revolution
    shape = window_by_name(window)
    revolutions = block_revolutions(shape, resolution_order, spanned / per_revolution)
    starts = block_starts(spanned, revolutions * per_revolution, overlap_ratio)
    mapping = OrderMapBlocks(resolution_order, window, overlap_ratio)
    time_s, shaft_frequency_hz = np.empty(starts.size), np.empty(starts.size)
    amplitude: ComplexArray = np.empty(0, dtype=complex)
    spectra, done = None, 0
    for part in angular_parts(plan, blocks):
        added = mapping.add(part)
        if added is None:
            continue
        spectra = added[1]
        if not done:  # now the numbers of channels and lines are known
            channels, _, lines = spectra.amplitude.shape
            amplitude = np.empty((channels, starts.size, lines), dtype=complex)
        some = slice(done, done + spectra.time_s.size)
        amplitude[:, some], time_s[some] = spectra.amplitude, spectra.time_s
        shaft_frequency_hz[some] = spectra.shaft_frequency_hz
        done = some.stop
    if spectra is None or done < starts.size:
        raise ParameterError(f"signal: its blocks hold fewer than the {samples} samples stated")
    return replace(
        spectra,
        amplitude=amplitude,
        starts=starts,
        time_s=time_s,
        shaft_frequency_hz=shaft_frequency_hz,
    )
