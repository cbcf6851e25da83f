"""Orders of blocks of revolutions, from a signal over the crank angle that comes in pieces."""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from ..study.order_analysis import OrderAnalysis
from .angular import AngularSignal
from .angular_plan import AngularPlan
from .block_maps import OrderMapBlocks
from .block_spectra import block_starts
from .loud_lines import loud_orders
from .order_cut import order_bands, order_lines, rms_in_bands
from .order_map import OrderMap, block_phasors, block_revolutions, rms_of_lines
from .windows import window_by_name

WINDOW: Final = "hann"
OVERLAP_RATIO: Final = 0.5
MOST_MAP_BYTES: Final = 2**30
"""Largest size of an order map that is kept: 16 bytes a line, block and channel."""
MOST_UNASKED_MAP_BYTES: Final = 2**27
"""Largest order map of a run-up that is kept where the settings leave the choice."""
STEADY_RATIO: Final = 0.02
"""A speed that stays within this share of its mean makes one operating point."""


@dataclass(frozen=True)
class OrdersOfBlocks:
    """Orders in the blocks of a recording.

    Attributes
    ----------
    order : orders of the settings, or the loudest, shape (order,)
    phasor : complex peak of these orders, shape (channel, block, order)
    rms : in their bands, shape (channel, block, order)
    mean_spectrum : RMS of each line from the mean power over the blocks, shape (channel, line)
    map_order : order of the lines, shape (line,)
    amplitude : complex peaks, shape (channel, block, line); None where no map is wanted
    time_s : mid-time of the blocks, s, shape (block,)
    shaft_frequency_hz : mean over each block, shape (block,)
    revolutions : revolutions of a block, a whole number; any number for a fit
    resolution_order : noise bandwidth of a line, orders
    band_order : width of the bands, orders
    """

    order: Array
    phasor: ComplexArray
    rms: Array
    mean_spectrum: Array
    map_order: Array
    amplitude: ComplexArray | None
    time_s: Array
    shaft_frequency_hz: Array
    revolutions: float
    resolution_order: float
    band_order: float

    @property
    def duration_s(self) -> Array:
        """Duration of the blocks, shape (block,)."""
        return self.revolutions / self.shaft_frequency_hz


class BlockOrders:
    """Phasors and RMS of orders in every block, and the mean spectrum of all.

    Parameters
    ----------
    plan : plan of the recording
    channels : number of its channels
    settings : the orders that are wanted
    """

    def __init__(self, plan: AngularPlan, channels: int, settings: OrderAnalysis) -> None:
        self._settings = settings
        _, blocks, lines = map_size(plan, settings)
        if settings.with_map:
            _check_map(channels, blocks, lines)
        is_small = 16 * channels * blocks * lines <= MOST_UNASKED_MAP_BYTES
        chooses = not settings.orders  # from the map
        self._keeps_map = chooses or (is_small if settings.with_map is None else settings.with_map)
        self._shows_map = is_small if settings.with_map is None else settings.with_map
        self._mapping = OrderMapBlocks(settings.resolution_or_default, WINDOW, OVERLAP_RATIO)
        self._spectra: list[OrderMap] = []  # without amplitudes where no map is wanted
        self._bands: list[range] = []
        self._phasors: list[ComplexArray] = []
        self._rms: list[Array] = []
        self._squares: list[Array] = []  # of the lines, summed over blocks

    def add(self, signal: AngularSignal) -> None:
        """Take the next samples over the angle.

        Warns
        -----
        OrderResolutionWarning
            Orders that are wanted leak into each other.
        """
        added = self._mapping.add(signal)
        if added is None:
            return
        signal, spectra = added
        if self._settings.orders:
            self._phasors.append(block_phasors(signal, spectra, self._settings.orders))
            self._bands = self._bands or order_bands(spectra, self._settings.orders)
            self._rms.append(rms_in_bands(spectra, self._bands))
        self._squares.append(np.sum(np.abs(spectra.amplitude) ** 2, axis=-2))
        if not self._keeps_map:
            spectra = replace(spectra, amplitude=np.empty(0, dtype=complex))
        self._spectra.append(spectra)

    def result(self, is_sound: Array) -> OrdersOfBlocks:
        """Return the orders of all blocks added; of settings without orders, the loudest.

        Parameters
        ----------
        is_sound : whether a channel is sound pressure, shape (channel,)
        """
        last = self._spectra[-1]
        time_s = np.concatenate([spectra.time_s for spectra in self._spectra])
        shaft_frequency_hz = np.concatenate(
            [spectra.shaft_frequency_hz for spectra in self._spectra]
        )
        amplitude = None
        if self._keeps_map:
            amplitude = np.concatenate([spectra.amplitude for spectra in self._spectra], axis=-2)
        orders = self._settings.orders
        if amplitude is not None and not orders:
            speed_rpm, width = 60.0 * shaft_frequency_hz, last.main_lobe_order
            orders = loud_orders(amplitude, last.order, speed_rpm, width, is_sound)
            spectra = replace(last, amplitude=amplitude)
            self._phasors = [order_lines(spectra, orders)]
            self._rms = [rms_in_bands(spectra, order_bands(spectra, orders))]
        is_shown = self._settings.with_map or not is_steady(shaft_frequency_hz)
        return OrdersOfBlocks(
            order=np.array(orders),
            phasor=np.concatenate(self._phasors, axis=-2),
            rms=np.concatenate(self._rms, axis=-2),
            mean_spectrum=rms_of_lines(np.sum(self._squares, axis=0) / time_s.size),
            map_order=last.order,
            amplitude=amplitude if is_shown and self._shows_map else None,
            time_s=time_s,
            shaft_frequency_hz=shaft_frequency_hz,
            revolutions=last.revolutions,
            resolution_order=last.resolution_order,
            band_order=last.main_lobe_order,
        )


def map_size(plan: AngularPlan, settings: OrderAnalysis) -> tuple[int, int, int]:
    """Revolutions of a block, blocks and lines of the order map of a recording.

    Parameters
    ----------
    plan : plan of the recording
    settings : settings with the resolution

    Raises
    ------
    ParameterError
        The recording has too few revolutions for the resolution.
    """
    samples, per_revolution = plan.grid[1] + 1 - plan.grid[0], plan.samples_per_revolution
    try:
        resolution = settings.resolution_or_default
        revolutions = block_revolutions(
            window_by_name(WINDOW), resolution, samples / per_revolution
        )
    except ParameterError as error:
        raise ParameterError(f"{error}; for a few revolutions give is_fit") from None
    blocks = block_starts(samples, revolutions * per_revolution, OVERLAP_RATIO).size
    return revolutions, blocks, int(plan.maximum_order * revolutions) + 1


def is_steady(speed: Array) -> bool:
    """Whether speeds, in any unit, are one operating point."""
    return bool(np.ptp(speed) <= STEADY_RATIO * np.mean(speed))


def _check_map(channels: int, blocks: int, lines: int) -> None:
    size = 16 * channels * blocks * lines
    if size > MOST_MAP_BYTES:
        raise ParameterError(
            f"order map: {blocks} blocks of {channels} channels take {size / 2**30:.3g} GiB; at "
            f"most {MOST_MAP_BYTES / 2**30:g} GiB: choose channels, or a part by from_s and to_s"
        )
