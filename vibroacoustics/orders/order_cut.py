"""Orders over a run-up, cut out of an order map."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.decibel import level_of_power
from ..base.errors import ParameterError
from .order_map import OrderMap
from .windows import name_of_window

_LOW_DB = 0.05
"""Half of the last digit of a level: from this loss on a tone is warned of."""
_SAME_LINE = 1e-9
"""Orders this near to a line or a band's edge, relative to the line spacing, lie on it."""


class OrderResolutionWarning(UserWarning):
    """Orders leak into each other or out of their bands at the resolution obtained."""


@dataclass(frozen=True)
class OrderCut:
    """RMS in a band around each of some orders, over the blocks of a run-up."""

    rms: Array
    """Shape (..., block, order), in the signal's unit."""
    order: Array
    """Middle of the bands, shape (order,)."""
    bandwidth_order: Array
    """Really summed over: number of lines over revolutions in a block, shape (order,)."""
    resolution_order: float
    """Noise bandwidth of a line, orders."""
    time_s: Array
    """Middle of the blocks, shape (block,)."""
    shaft_frequency_hz: Array
    """Mean over each block, shape (block,)."""


def order_cut(
    spectra: OrderMap, orders: Sequence[float] | Array, bandwidth_order: float | None = None
) -> OrderCut:
    """RMS of orders over a run-up: √(Σ |X|²/2 / NENBW), summed over the lines of a band.

    Dividing by the window's normalized noise bandwidth (Heinzel, Rüdiger & Schilling 2002,
    equations 21 and 24) makes the sum over any band the mean square of noise in it, and that over a
    main lobe the mean square of a tone: exactly on a line, between two lines to 0.004 dB under a
    Hann window and to 0.0001 dB under a flat top. A rectangular window then loses up to 0.91 dB;
    that is not corrected, as noise in the band has no such loss, but warned of.

    Parameters
    ----------
    spectra : spectra of the run-up
    orders : to cut out
    bandwidth_order : width of each band, orders; at least, and where it is not given, the main
        lobe's width

    Raises
    ------
    ParameterError
        A band is narrower than the main lobe or reaches beyond the orders of the map.

    Warns
    -----
    OrderResolutionWarning
        The main lobe of one of the orders reaches into the band of another, or an order lies
        between two lines and its band reads a tone more than 0.05 dB low.
    """
    bands = order_bands(spectra, orders, bandwidth_order)
    return OrderCut(
        rms=rms_in_bands(spectra, bands),
        order=np.asarray(orders, dtype=float),
        bandwidth_order=np.array([len(band) for band in bands]) / spectra.revolutions,
        resolution_order=spectra.resolution_order,
        time_s=spectra.time_s,
        shaft_frequency_hz=spectra.shaft_frequency_hz,
    )


def order_bands(
    spectra: OrderMap, orders: Sequence[float] | Array, bandwidth_order: float | None = None
) -> list[range]:
    """Lines of the bands around some orders; see `order_cut`."""
    wanted = np.asarray(orders, dtype=float)
    bandwidth = spectra.main_lobe_order if bandwidth_order is None else bandwidth_order
    _check_bands(spectra, wanted, bandwidth)
    # A band reaches half its width to either side, a lobe half its own.
    warn_of_neighbours(
        wanted,
        (bandwidth + spectra.main_lobe_order) / 2.0,
        f"for bands of {bandwidth:.3g} with main lobes of {spectra.main_lobe_order:.3g} "
        f"(resolution obtained {spectra.resolution_order:.3g})",
        stacklevel=4,
    )
    reach = bandwidth / 2.0 + _SAME_LINE / spectra.revolutions
    within = [np.flatnonzero(np.abs(spectra.order - order) <= reach) for order in wanted]
    bands = [range(int(lines[0]), int(lines[-1]) + 1) for lines in within]
    _warn_of_loss(spectra, wanted, bands)
    return bands


def tone_loss_db(spectra: OrderMap, order: float, band: range) -> float:
    """Level of a tone minus its level in a band, dB, at least 0.

    The band holds Σ |W(d)|² / NENBW of its mean square, with d the distance of the lines from the
    tone and W the window's transform.

    Parameters
    ----------
    spectra : map, for its window and its lines
    order : tone
    band : numbers of the lines
    """
    response = spectra.window.response(np.array(band) - order * spectra.revolutions)
    power = np.sum(response**2) / spectra.window.noise_bandwidth_lines
    return max(0.0, -float(level_of_power(power)))


def _warn_of_loss(spectra: OrderMap, orders: Array, bands: Sequence[range]) -> None:
    losses = [tone_loss_db(spectra, order, band) for order, band in zip(orders, bands, strict=True)]
    low = [f"{order:g}" for order, loss in zip(orders, losses, strict=True) if loss > _LOW_DB]
    if low:
        warnings.warn(
            f"window {name_of_window(spectra.window)}: a tone of order {', '.join(low)} lies "
            f"between lines {1.0 / spectra.revolutions:.3g} apart and reads up to "
            f"{max(losses):.2f} dB low; take hann or flat_top, a wider bandwidth_order, or blocks "
            f"in which it has a line",
            OrderResolutionWarning,
            stacklevel=4,
        )


def rms_in_bands(spectra: OrderMap, bands: Sequence[range]) -> Array:
    """RMS in bands of lines, shape (..., block, band), in the signal's unit."""
    power = [_band_power(spectra.amplitude[..., band.start : band.stop]) for band in bands]
    return np.asarray(np.sqrt(np.stack(power, axis=-1) / spectra.window.noise_bandwidth_lines))


def order_lines(spectra: OrderMap, orders: Sequence[float] | Array) -> ComplexArray:
    """Complex peak amplitude of orders that lie on a line of the map, shape (..., block, order).

    Raises
    ------
    ParameterError
        An order lies between two lines or beyond the map.
    """
    line = np.asarray(orders, dtype=float) * spectra.revolutions
    nearest = np.rint(line).astype(int)
    for order, distance, number in zip(orders, np.abs(line - nearest), nearest, strict=True):
        if distance > _SAME_LINE or not 0 <= number < spectra.order.size:
            raise ParameterError(
                f"order {order:g}: has no line; those of the map are 0 to {spectra.order[-1]:g} "
                f"in steps of 1/{spectra.revolutions}"
            )
    return spectra.amplitude[..., nearest]


def _band_power(amplitude: ComplexArray) -> Array:
    return np.asarray(np.sum(np.abs(amplitude) ** 2, axis=-1) / 2.0)


def _check_bands(spectra: OrderMap, orders: Array, bandwidth: float) -> None:
    slack = _SAME_LINE / spectra.revolutions
    if bandwidth < spectra.main_lobe_order - slack:
        raise ParameterError(
            f"bandwidth_order = {bandwidth:g}: narrower than the main lobe, "
            f"{spectra.main_lobe_order:.4g}; a finer resolution_order of the map narrows it"
        )
    highest = float(spectra.order[-1])
    for order in orders:
        if not bandwidth / 2.0 - slack < order <= highest - bandwidth / 2.0 + slack:
            raise ParameterError(
                f"order {order:g}: its band of {bandwidth:.4g} must lie between order 0 and "
                f"{highest:g}, the highest of the map"
            )


def warn_of_neighbours(orders: Array, needed: float, why: str, stacklevel: int = 3) -> None:
    """Warn of orders that are nearer to each other than the resolution."""
    for lower, upper in pairwise(np.unique(orders)):
        if upper - lower < needed * (1.0 - _SAME_LINE):
            warnings.warn(
                f"orders {lower:g} and {upper:g} leak into each other: they are "
                f"{upper - lower:.3g} apart and need {needed:.3g} {why}",
                OrderResolutionWarning,
                stacklevel=stacklevel,
            )
