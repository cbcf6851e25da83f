"""Tests of frequency responses against physics: causality, passivity, reciprocity, mass line."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from ..base.arrays import Array, ComplexArray

LONGEST_DELAY_S: Final = 0.05
"""Longest lag that is searched for; assumed."""
LONGEST_DRIVING_DELAY_S: Final = 0.01
"""Longest delay of all forces that is searched for; assumed."""
PHASE_MARGIN: Final = np.radians(20.0)
"""Angle beyond 90° that noise turns no line by: five deviations of 10 % noise; assumed."""
LEAST_GIVING: Final = 0.1
"""Least share of lines that give power in a delayed driving point; assumed."""
MOST_LEFT: Final = 0.1
"""Largest part of them that may be left with the delay corrected; assumed."""
OVERSAMPLING: Final = 32
"""Tried lags per period of the highest frequency; assumed."""


class Lag(NamedTuple):
    """Lag between two functions: its time, s, the factor there, and the residual share of power."""

    delay_s: float
    factor: float
    residual_ratio: float


def causality(values: ComplexArray) -> float:
    """Balance of an impulse response between the first and the second half of its period, -1 to 1.

    -Im Σ H(k+1) H*(k) / Σ |H|², the mean of sin(2πt/T) weighted by the energy of the impulse
    response at t: positive where it begins at zero time and decays, as every causal, damped system
    must (Oppenheim and Schafer, Discrete-Time Signal Processing, chapter 12), and negative where
    the function is conjugated. Factors, signs and powers of jω do not change its sign.

    Parameters
    ----------
    values : H at even frequencies, shape (frequency,)
    """
    power = float(np.sum(np.abs(values) ** 2))
    return float(-np.sum(values[1:] * values[:-1].conj()).imag / max(power, 1e-300))


def passivity(mobility: ComplexArray) -> float:
    """Share of a driving point's mobility that takes up power, -1 to 1.

    Σ |Y| Re Y / Σ |Y|². The real part of a driving-point mobility is not negative, as a structure
    without sources takes up power (Cremer, Heckl and Petersson, Structure-Borne Sound, 2005,
    chapter 5). A negative share has the wrong sign or is no driving point.

    Parameters
    ----------
    mobility : Y, m/(N s), shape (frequency,)
    """
    size = np.abs(mobility)
    return float(np.sum(size * mobility.real) / max(float(np.sum(size**2)), 1e-300))


def share_giving_power(mobility: ComplexArray) -> float:
    """Share of the lines of a driving point that give power by more than noise turns them, 0 to 1.

    The phase of a driving-point mobility is -90° to 90°; lines beyond by `PHASE_MARGIN` count.

    Parameters
    ----------
    mobility : Y, m/(N s), shape (frequency,)
    """
    cosine = mobility.real / np.abs(mobility).clip(min=1e-300)
    return float(np.mean(cosine < -np.sin(PHASE_MARGIN)))


def driving_delay_s(frequency_hz: Array, mobilities: Sequence[ComplexArray]) -> float:
    """Delay τ of the force that makes driving points Y exp(jωτ) passive again, s; 0 without.

    Of all τ that leave the fewest lines giving power it is the one at which the points take up the
    most, as resonances do at the phase zero. There is none where the points are passive as they
    are, or where no τ makes them so.

    Parameters
    ----------
    frequency_hz : shape (frequency,)
    mobilities : Y of driving points, each of shape (frequency,)
    """
    phase = np.angle(np.concatenate(list(mobilities)))
    hz = np.tile(frequency_hz, len(mobilities))
    tried_s = _tried_lags(frequency_hz)
    tried_s = tried_s[np.abs(tried_s) <= LONGEST_DRIVING_DELAY_S]
    limit = -np.sin(PHASE_MARGIN)
    parts = np.array_split(tried_s, 1 + tried_s.size * hz.size // 1_000_000)
    turned = [np.cos(phase - 2.0 * np.pi * np.outer(part, hz)) < limit for part in parts]
    shares = np.concatenate([np.mean(each, axis=1) for each in turned])
    present, least = share_giving_power(np.exp(1j * phase)), float(shares.min())
    if present < LEAST_GIVING or least > MOST_LEFT * present:
        return 0.0
    best = tried_s[shares <= least + 0.5 / hz.size]
    powers = [each * np.abs(each) / np.sum(np.abs(each) ** 2) for each in mobilities]
    taken_up = np.exp(-2j * np.pi * np.outer(best, frequency_hz)) @ np.sum(powers, axis=0)
    return float(best[np.argmax(taken_up.real)])


def reciprocity_residual(
    values: ComplexArray, reciprocal: ComplexArray, factor: complex | ComplexArray = 1.0
) -> float:
    """Share of power by which functions differ from a factor times their reciprocal ones, 0 to 2.

    Σ |H - g H'|² / Σ (|H|² + |g H'|²), as passive structures are reciprocal, H = H'
    (Ewins, Modal Testing, 2000, section 3.11).

    Parameters
    ----------
    values, reciprocal : H and H', shape (..., frequency)
    factor : g, one number or shape (frequency,)
    """
    scaled = factor * reciprocal
    power = np.sum(np.abs(values) ** 2 + np.abs(scaled) ** 2)
    return float(np.sum(np.abs(values - scaled) ** 2) / max(float(power), 1e-300))


def real_factor(values: ComplexArray, reciprocal: ComplexArray) -> float:
    """Real factor g of H = g H' with errors of both in the same ratio; shapes (..., frequency)."""
    product = float(np.sum(values * reciprocal.conj()).real)
    size = np.sqrt(
        np.sum(np.abs(values) ** 2) / max(float(np.sum(np.abs(reciprocal) ** 2)), 1e-300)
    )
    return float(np.copysign(size, product))


def lag(frequency_hz: Array, values: ComplexArray, reciprocal: ComplexArray) -> Lag:
    """Delay τ of H = ±g H' exp(-jωτ) with the least residual.

    Parameters
    ----------
    frequency_hz : shape (frequency,)
    values, reciprocal : H and H', shape (..., frequency)
    """
    tried_s = _tried_lags(frequency_hz)
    product = np.sum(values * reciprocal.conj(), axis=tuple(range(values.ndim - 1)))
    delay_s = float(tried_s[np.argmax(np.abs(_turned_back(frequency_hz, product, tried_s)))])
    shift = np.exp(-2j * np.pi * frequency_hz * delay_s)
    factor = real_factor(values, reciprocal * shift)
    return Lag(delay_s, factor, reciprocity_residual(values, reciprocal, factor * shift))


def second_hit(frequency_hz: Array, values: ComplexArray, reciprocal: ComplexArray) -> Lag:
    """Second hit that is in H alone, H = H' (1 + a exp(-jωτ)): its lag τ and its size a.

    A window that cuts the second hit off the force, but not its response, makes such functions.

    Parameters
    ----------
    frequency_hz : shape (frequency,)
    values, reciprocal : H and H', shape (..., frequency)
    """
    tried_s = _tried_lags(frequency_hz)
    tried_s = tried_s[tried_s > 2.0 / np.ptp(frequency_hz)]
    axes = tuple(range(values.ndim - 1))
    further = np.sum((values - reciprocal) * reciprocal.conj(), axis=axes)
    power = float(np.sum(np.abs(reciprocal) ** 2))
    size = _turned_back(frequency_hz, further, tried_s) / max(power, 1e-300)
    best = int(np.argmax(size))
    delay_s, factor = float(tried_s[best]), float(size[best])
    comb = 1.0 + factor * np.exp(-2j * np.pi * frequency_hz * delay_s)
    return Lag(delay_s, factor, reciprocity_residual(values, reciprocal, comb))


def parallel_mass_kg(accelerance: ComplexArray) -> float:
    """Mass that points feel in parallel motion, kg: the median of 1ᵀ A⁺ 1.

    On the mass line of a rigid, freely hung body A = [1 x y] M⁻¹ [1 x y]ᵀ has three singular
    values. The forces of unit acceleration of all points then sum to the mass, wherever the centre
    of mass is, for three or more points in one direction that are not in line. (Ewins, Modal
    Testing, 2000, section 4.5 uses this line for calibration.)

    Parameters
    ----------
    accelerance : A, 1/kg, shape (frequency, point, point)
    """
    mean = accelerance.real.mean(axis=0)
    values, vectors = np.linalg.eigh((mean + mean.T) / 2.0)
    kept = np.argsort(np.abs(values))[-3:]
    sums = vectors[:, kept].sum(axis=0)
    return float(np.sum(sums**2 / values[kept]))


def unexplained(compliance: ComplexArray, response: ComplexArray) -> float:
    """Share of the power of operating responses that no forces at the interface explain, 0 to 1.

    Each line counts alike. Where forces at the interface drive all responses, as blocked forces do
    (ISO 20270), more responses than forces leave nothing but noise.

    Parameters
    ----------
    compliance : Y, shape (frequency, response, force)
    response : u, shape (frequency, response)
    """
    size = np.linalg.norm(compliance, axis=2, keepdims=True).clip(min=1e-300)
    scaled = response / size[..., 0]
    left_vectors = np.linalg.svd(compliance / size, full_matrices=False)[0]
    along = np.einsum("frn,fr->fn", left_vectors.conj(), scaled)
    power = np.sum(np.abs(scaled) ** 2, axis=1).clip(min=1e-300)
    return float(np.mean(1.0 - np.sum(np.abs(along) ** 2, axis=1) / power))


def _tried_lags(frequency_hz: Array) -> Array:
    step_s = 1.0 / (OVERSAMPLING * float(frequency_hz[-1]))
    longest_s = min(LONGEST_DELAY_S, 0.5 / float(np.median(np.diff(frequency_hz))))
    count = int(longest_s / step_s)
    return np.asarray(step_s * np.arange(-count, count + 1, dtype=np.float64))


def _turned_back(frequency_hz: Array, product: ComplexArray, tried_s: Array) -> Array:
    """Real part of the sum of a cross spectrum with each lag turned back, shape (lag,)."""
    parts = np.array_split(tried_s, 1 + tried_s.size * frequency_hz.size // 1_000_000)
    sums = [(np.exp(2j * np.pi * np.outer(part, frequency_hz)) @ product).real for part in parts]
    return np.asarray(np.concatenate(sums))
