"""Vold-Kalman tracking: envelopes of several orders at once, of several shafts if need be.

Second generation (Vold, Mains and Blough 1997, SAE 972007; first: Vold and Leuridan 1993, SAE
931288), all orders coupled. The signal obeys the data equation

    y(t) = Re Σ X_k(t) exp(jΘ_k(t)) + η(t),    Θ_k = order × crank angle,

at every sample, and each complex envelope the structural equation ∇^p X_k = ε_k. Least squares of
η and r ε give the envelopes. The weight r grows with (sample rate / bandwidth)^p: at the rate of
a recording the equations are singular in double precision. So the envelopes, which are slow, are
decimated, never the signal: they are cubic B-splines on few knots, with the differences taken of
the coefficients (P-splines: Eilers and Marx 1996, Statistical Science 11). No filter comes first,
and an envelope that is a polynomial of a degree below p is found exactly, at the ends too.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.linalg import LinAlgError, cho_solve_banded, cholesky_banded

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError, SolverError
from .vold_kalman_equations import (
    SUPPORT,
    Track,
    add_data_equations,
    data_pieces,
    structural_equations,
    weight_squared,
)

__all__ = ["Track", "TrackedOrders", "vold_kalman"]


KNOTS_PER_BANDWIDTH: Final = 8
"""Knots per second over the bandwidth. The splines pass on less than (1/16)^4, -96 dB, of what
would alias into the band; the filter itself is no better there with two poles (-88 dB)."""
LEAST_SAMPLES_PER_KNOT: Final = 4
LARGEST_NOISE_GAIN: Final = 100.0
"""Noise within the bandwidth 40 dB below the orders would come out as large as they are."""
_PROP: Final = 1e-8
"""Threshold of an eigenvalue that is 1 for an order on its own: above rounding, below what is
accepted."""


@dataclass(frozen=True)
class TrackedOrders:
    """Envelopes of tracked orders.

    Attributes
    ----------
    time_s : shape (time,), from the start of the recording
    envelope : shape (..., track, time), complex peak in the signal's unit; the phase is the one
        against the crank angle of the track's shaft
    sample_rate_hz : sample rate of the envelopes
    noise_gain : largest factor by which noise within the bandwidth grows because orders are too
        close to be separated; about 1 or 2 where they are apart
    """

    time_s: Array
    envelope: ComplexArray
    sample_rate_hz: float
    noise_gain: float


def vold_kalman(
    signal: Array,
    sample_rate_hz: float,
    tracks: Sequence[Track],
    bandwidth_hz: float,
    poles: int = 2,
) -> TrackedOrders:
    """Track orders in a signal, all of them together.

    Orders that cross are separated if they stay within the bandwidth of each other for a short
    time only: at a crossing with s Hz/s, a bandwidth up to √s. Orders that stay side by side need
    a bandwidth below their distance.

    Parameters
    ----------
    signal : shape (..., time); sample k at time k / sample_rate_hz, as the motions count it
    sample_rate_hz : sample rate of the signal
    tracks : orders that are tracked; the result spans the time that all motions cover
    bandwidth_hz : full width at -3 dB of what passes around each order
    poles : 1, 2 or 3; each steepens the filter by 40 dB a decade

    Raises
    ------
    ParameterError
        A sample is not finite, or the bandwidth does not fit the recording or an order.
    SolverError
        Two orders are too close for too long.
    """
    _check(signal, sample_rate_hz, tracks, bandwidth_hz, poles)
    first, count = _common_span(tracks, sample_rate_hz, signal.shape[-1], bandwidth_hz)
    step = int(sample_rate_hz / (KNOTS_PER_BANDWIDTH * bandwidth_hz))
    rate = sample_rate_hz / step
    time = (first + np.arange(0, count, step)) / sample_rate_hz
    _check_frequencies(tracks, time, sample_rate_hz, bandwidth_hz)

    unknowns = 2 * len(tracks)
    channels = signal[..., first : first + count].reshape(-1, count)
    # The splines themselves pass sinc^4 of the frequency, squared in the normal equations.
    weight = weight_squared(bandwidth_hz, rate, poles) * float(
        np.sinc(0.5 * bandwidth_hz / rate) ** 8
    )
    band = structural_equations(time.size + SUPPORT - 1, unknowns, weight, poles)
    right = np.zeros((band.shape[1], channels.shape[0]))
    for start, design, samples in data_pieces(channels, tracks, first, sample_rate_hz, step):
        add_data_equations(band, right, start, unknowns, design, samples, 2.0 / step)

    factor, noise_gain = _factorise(band, tracks, time, bandwidth_hz)
    solution = cho_solve_banded((factor, True), right).reshape(-1, unknowns, channels.shape[0])
    knots = (solution[:-3] + 4.0 * solution[1:-2] + solution[2:-1]) / 6.0
    envelope = np.moveaxis(knots[:, 0::2] + 1j * knots[:, 1::2], (0, 1, 2), (2, 1, 0))
    shape = (*signal.shape[:-1], len(tracks), time.size)
    return TrackedOrders(time, envelope.reshape(shape), rate, noise_gain)


def _factorise(
    band: Array, tracks: Sequence[Track], time: Array, bandwidth_hz: float
) -> tuple[Array, float]:
    """Cholesky factor and the noise gain, 1/√ of the smallest eigenvalue."""
    try:
        factor = cholesky_banded(band, lower=True)
    except LinAlgError:  # singular to rounding: held up to find which orders are to blame
        band[0] += _PROP
        factor = cholesky_banded(band, lower=True)
    vector = np.random.default_rng(0).standard_normal(band.shape[1])
    for _ in range(20):  # power iteration; the gain to some percent is enough
        vector = cho_solve_banded((factor, True), vector / np.linalg.norm(vector))
    gain = float(np.sqrt(np.linalg.norm(vector)))
    if not gain < LARGEST_NOISE_GAIN:
        share = np.sum(vector.reshape(-1, len(tracks), 2) ** 2, axis=-1)
        raise _too_close(tracks, time, bandwidth_hz, share)
    return factor, gain


def _too_close(
    tracks: Sequence[Track], time: Array, bandwidth_hz: float, share: Array
) -> SolverError:
    """Name the orders, and the time, of which the equations know least: (spline, track) shares."""
    when = time[np.clip(np.argmax(np.sum(share, axis=1)) - 1, 0, time.size - 1)]
    numbers = np.sort(np.argsort(np.sum(share, axis=0))[-2:])
    names = [
        f"track {number} (order {tracks[number].order:g}, "
        f"{tracks[number].order * tracks[number].motion.frequency_hz(when):.6g} Hz)"
        for number in numbers
    ]
    return SolverError(
        f"{' and '.join(names)} around {when:.3g} s: too close for too long to be separated with "
        f"a bandwidth of {bandwidth_hz:g} Hz"
    )


def _check(
    signal: Array, sample_rate_hz: float, tracks: Sequence[Track], bandwidth_hz: float, poles: int
) -> None:
    """Refuse what no recording has."""
    if poles not in (1, 2, 3):
        raise ParameterError(f"poles = {poles}: must be 1, 2 or 3")
    if not tracks:
        raise ParameterError("tracks: none given, needs at least one")
    highest = sample_rate_hz / (KNOTS_PER_BANDWIDTH * LEAST_SAMPLES_PER_KNOT)
    if not 0.0 < bandwidth_hz <= highest:
        raise ParameterError(
            f"bandwidth_hz = {bandwidth_hz:g} Hz: must be above 0 and up to {highest:g} Hz, 1/"
            f"{KNOTS_PER_BANDWIDTH * LEAST_SAMPLES_PER_KNOT} of the sample rate"
        )
    broken = np.flatnonzero(~np.all(np.isfinite(signal), axis=tuple(range(signal.ndim - 1))))
    if broken.size:
        raise ParameterError(f"signal: sample {broken[0]} is not a finite number")


def _common_span(
    tracks: Sequence[Track], sample_rate_hz: float, samples: int, bandwidth_hz: float
) -> tuple[int, int]:
    """First sample and number of samples at which all motions are known."""
    start = max(track.motion.start_s for track in tracks) * sample_rate_hz
    end = min(track.motion.end_s for track in tracks) * sample_rate_hz
    # A motion's end is a time of its own; an ulp must not drop a sample.
    first = max(0, int(np.ceil(start - 1e-6)))
    count = max(0, min(samples, int(np.floor(end + 1e-6)) + 1) - first)
    duration = count / sample_rate_hz
    if duration * bandwidth_hz < 1.0:
        raise ParameterError(
            f"bandwidth_hz = {bandwidth_hz:g} Hz: needs {1.0 / bandwidth_hz:.3g} s of signal over "
            f"which all shafts are known, there are {duration:.3g} s"
        )
    return first, count


def _check_frequencies(
    tracks: Sequence[Track], time: Array, sample_rate_hz: float, bandwidth_hz: float
) -> None:
    """Every order stays a bandwidth away from 0 Hz and from half the sample rate."""
    highest = 0.5 * sample_rate_hz - bandwidth_hz
    for number, track in enumerate(tracks):
        frequency = track.order * track.motion.frequency_hz(time)
        low, high = float(np.min(frequency)), float(np.max(frequency))
        if low < bandwidth_hz or high > highest:
            raise ParameterError(
                f"track {number} (order {track.order:g}): runs from {low:.4g} to {high:.4g} Hz, "
                f"must stay within {bandwidth_hz:g} (the bandwidth) and {highest:g} Hz"
            )
