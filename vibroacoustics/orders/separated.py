"""Orders taken out of a signal, changed and put back; the noise between and below them stays.

The Vold-Kalman envelope of an order holds the noise within the bandwidth too. A gain by frequency
of the envelope separates both, as in Wiener's filter, from the noise beside the line.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.fft import dct, idct
from scipy.interpolate import CubicSpline, PPoly
from scipy.ndimage import uniform_filter1d

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from .crank_motion import CrankMotion
from .vold_kalman import vold_kalman
from .vold_kalman_equations import Track

BESIDE_BANDWIDTHS: Final = 3.0
"""Distance of the noise beside an order, in bandwidths: the filter passes 0.2 % there."""
LEAST_DISTANCE: Final = 8.0
"""Distance of neighbouring orders in bandwidths: the noise between two of them fits twice."""
_SMOOTH_BANDWIDTHS: Final = 16.0
"""Duration of the mean squares beside an order, in 1 / bandwidth."""
_ORDER_LINES: Final = 5
"""Lines of an envelope's spectrum whose mean square is compared with the noise."""
_LEAST_OVER_NOISE: Final = 5.0
"""Mean square of these over that of the noise: of noise, five lines exceed it once in 4 million."""
_NOISE_LINES: Final = 0.5
"""Width of the mean square of the noise, in bandwidths."""
_TOGETHER: Final = 4
"""Orders of one shaft that are separated together; others are 8 bandwidths off, -88 dB."""
_BLOCK: Final = 1 << 18


@dataclass(frozen=True)
class SeparatedOrders:
    """Orders of a signal.

    Attributes
    ----------
    tracks : tracks of the orders
    time_s : shape (time,), from the start of the signal
    envelope : complex peaks in the signal's unit, shape (track, time)
    order_square : mean square of each order, unit², shape (track,)
    noise_square : mean square of the noise within the bandwidth, unit², shape (track,)
    bandwidth_hz : full width at -3 dB of what belongs to an order at most
    """

    tracks: tuple[Track, ...]
    time_s: Array
    envelope: ComplexArray
    order_square: Array
    noise_square: Array
    bandwidth_hz: float


def separated_orders(
    signal: Array, sample_rate_hz: float, tracks: Sequence[Track], bandwidth_hz: float
) -> SeparatedOrders:
    """Separate orders from a signal by a Vold-Kalman filter of two poles.

    Orders of several shafts, which may cross, are separated all together.

    The cosine transform of an order's envelope X is a sum of order and noise. Their mean squares
    are P over neighbouring lines and Q beside the order. The gain G = 1 - Q/P, none where P < 5 Q,
    gives the order G X, as Wiener's filter does. Lines a bandwidth off are no order. Taking the
    order out leaves (1 - G)² P of the noise, which is less than Q by G Q. So √G N is taken out with
    it: N is the noise beside the order, which has the mean square Q. The same holds for any ratio
    r: then (r - 1) (G X + √G N) is added, and the sum has the mean square |r|² (P - Q) + Q.

    Parameters
    ----------
    signal : shape (time,)
    sample_rate_hz : sample rate of the signal
    tracks : orders; those that do not cross are at least 8 bandwidths apart
    bandwidth_hz : full width at -3 dB of what belongs to an order at most
    """
    residual, envelopes = signal, []
    for group in _groups(tracks):
        tracked = vold_kalman(residual, sample_rate_hz, group, bandwidth_hz)
        taken = order_sum(group, tracked.time_s, tracked.envelope, signal.size, sample_rate_hz)
        residual = residual - taken
        envelopes.append(tracked.envelope)
    below, above = (
        np.concatenate(
            [
                vold_kalman(
                    residual, sample_rate_hz, _beside(group, distance_hz), bandwidth_hz
                ).envelope
                for group in _groups(tracks)
            ]
        )
        for distance_hz in (-BESIDE_BANDWIDTHS * bandwidth_hz, BESIDE_BANDWIDTHS * bandwidth_hz)
    )
    envelope = np.concatenate(envelopes)
    duration = _SMOOTH_BANDWIDTHS * tracked.sample_rate_hz / bandwidth_hz
    noise = _mean_of_sides(below, above, round(duration))
    lines = 2.0 * bandwidth_hz * tracked.time_s.size / tracked.sample_rate_hz
    order, noise, noise_square = _order_in_noise(envelope, noise, lines)
    return SeparatedOrders(
        tuple(tracks),
        tracked.time_s,
        order + noise,
        0.5 * np.mean(np.abs(order + noise) ** 2, axis=-1),
        noise_square,
        bandwidth_hz,
    )


def changed_signal(
    signal: Array, sample_rate_hz: float, orders: SeparatedOrders, ratio: ComplexArray
) -> Array:
    """Multiply orders of a signal by complex ratios; the residual stays.

    Parameters
    ----------
    signal : shape (time,)
    sample_rate_hz : sample rate of the signal
    orders : orders of the signal
    ratio : new over old complex peak, shape (track, time) of the envelopes

    Raises
    ------
    ParameterError
        The ratio does not have the shape of the envelopes.
    """
    if ratio.shape != orders.envelope.shape:
        raise ParameterError(
            f"ratio: shape {ratio.shape}, must be {orders.envelope.shape}, one for each envelope"
        )
    change = (ratio - 1.0) * orders.envelope
    added = order_sum(orders.tracks, orders.time_s, change, signal.size, sample_rate_hz)
    return np.asarray(signal + added)


def order_sum(
    tracks: Sequence[Track],
    time_s: Array,
    envelope: ComplexArray,
    samples: int,
    sample_rate_hz: float,
) -> Array:
    """Sum of orders, Σ Re{X exp(jΘ)}, zero where the shafts or envelopes are not known.

    Parameters
    ----------
    tracks : orders
    time_s : evenly spaced, shape (time,)
    envelope : complex peaks X, shape (track, time)
    samples, sample_rate_hz : samples and sample rate of the signal

    Returns
    -------
    shape (samples,)
    """
    total = np.zeros(samples)
    end_s = min(track.motion.end_s for track in tracks)
    end_s = min(end_s, 2.0 * time_s[-1] - time_s[-2])  # the last knot is up to a step before
    first = round(float(time_s[0]) * sample_rate_hz)
    last = min(samples, int(np.floor(end_s * sample_rate_hz + 1e-6)) + 1)
    for track, of_track in zip(tracks, envelope, strict=True):
        spline = CubicSpline(time_s, of_track)
        for start in range(first, last, _BLOCK):
            time = np.arange(start, min(start + _BLOCK, last)) / sample_rate_hz
            angle = track.order * track.motion.angle_rad(time)
            total[start : start + time.size] += np.real(spline(time) * np.exp(1j * angle))
    return total


def _groups(tracks: Sequence[Track]) -> list[Sequence[Track]]:
    """Tracks that are separated together: all that may cross; of one shaft, few cost less."""
    if any(track.motion is not tracks[0].motion for track in tracks):
        return [tracks]
    return [tracks[first : first + _TOGETHER] for first in range(0, len(tracks), _TOGETHER)]


def _beside(tracks: Sequence[Track], distance_hz: float) -> list[Track]:
    """Carriers at a constant distance from orders."""
    turn, carriers = 2.0 * np.pi * distance_hz, []
    for track in tracks:
        curve = track.motion.curve
        coefficients = track.order * curve.c
        coefficients[-2] += turn
        coefficients[-1] += turn * curve.x[:-1]
        carriers.append(Track(CrankMotion(PPoly(coefficients, curve.x)), 1.0))
    return carriers


def _mean_of_sides(below: ComplexArray, above: ComplexArray, times: int) -> ComplexArray:
    """Noise of both sides, whose mean square is the harmonic mean of theirs.

    A line that crosses one side so adds 3 dB at most.
    """
    squares = [
        uniform_filter1d(np.abs(side) ** 2, min(times, side.shape[-1]), axis=-1, mode="nearest")
        for side in (below, above)
    ]
    total = squares[0] + squares[1]
    total = np.where(total > 0.0, total, 1.0)
    return np.asarray(np.sqrt(squares[1] / total) * below + np.sqrt(squares[0] / total) * above)


def _order_in_noise(
    envelope: ComplexArray, noise: ComplexArray, lines: float
) -> tuple[ComplexArray, ComplexArray, Array]:
    """Order of an envelope, the noise that belongs to it, and the mean square of all noise.

    Parameters
    ----------
    envelope, noise : shape (track, time)
    lines : number of lines of the spectrum within the bandwidth on either side; those beyond are no
        order
    """
    of_order, of_noise = (dct(each, axis=-1, norm="ortho") for each in (envelope, noise))
    size = envelope.shape[-1]
    of_noise[:, int(np.ceil(lines)) :] = 0.0
    square = _smooth(of_order, min(_ORDER_LINES, size))
    noise_square = _smooth(of_noise, min(max(1, round(_NOISE_LINES * lines)), size))
    present = square > _LEAST_OVER_NOISE * noise_square
    present[:, int(np.ceil(lines)) :] = False
    gain = np.where(present, 1.0 - noise_square / np.where(present, square, 1.0), 0.0)
    order = idct(gain * of_order, axis=-1, norm="ortho")
    copied = idct(np.sqrt(gain) * of_noise, axis=-1, norm="ortho")
    every = 0.5 * np.sum(np.abs(of_noise) ** 2, axis=-1) / size
    return np.asarray(order), np.asarray(copied), np.asarray(every)


def _smooth(spectrum: ComplexArray, lines: int) -> Array:
    """Mean square over neighbouring lines; a spectrum of cosines is even at its ends."""
    return np.asarray(uniform_filter1d(np.abs(spectrum) ** 2, lines, axis=-1, mode="reflect"))
