"""Orders of a few revolutions: one fit of all of them to the whole recording.

Blocks of whole revolutions need several of them, and the anti-aliasing kernel further ones at both
ends. A recording of two to ten revolutions, or half orders in it, is fitted by least squares over
the crank angle instead: x = c_0 + Σ a_k cos(kφ) + b_k sin(kφ), k a multiple of the spacing.
"""

from collections.abc import Sequence
from fractions import Fraction
from math import gcd, lcm
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from ..study.order_analysis import DEFAULT_ORDERS, OrderAnalysis
from .angular_plan import HIGHEST_PASS_BAND_RATIO, known_samples
from .block_orders import OrdersOfBlocks
from .crank_motion import CrankMotion

LEAST_SPACING_LINES: Final = 1.0
"""Least product of spacing and revolutions: orders nearer to each other are not resolved."""
TAPERED_SPACING_LINES: Final = 1.5
"""Product from which on samples have Hann weights, which keep other sound out."""
MOST_FIT_BYTES: Final = 2**30
MOST_DENOMINATOR: Final = 1000
_SLACK: Final = 1e-3


def common_spacing(orders: Sequence[float]) -> float:
    """Largest order of which all given ones are multiples: 0.5 of 0.5, 1 and 1.5.

    Parameters
    ----------
    orders : above 0; fractions with denominators up to 1000
    """
    fractions = [Fraction(order).limit_denominator(MOST_DENOMINATOR) for order in orders]
    numerator = gcd(*(fraction.numerator for fraction in fractions))
    return numerator / lcm(*(fraction.denominator for fraction in fractions))


def fit_orders(signal: Array, angle_rad: Array, orders: Array, is_tapered: bool) -> ComplexArray:
    """Complex peak amplitude of orders, (channel, 1 + order), the constant first.

    Minimises Σ w |x - c_0 - Σ Re(X_k exp(jkφ))|² with w = 1, or the Hann window over the angle
    (weighted linear least squares; Björck 1996, section 4.4).

    Parameters
    ----------
    signal : shape (channel, time), any unit
    angle_rad : crank angle at the samples, shape (time,)
    orders : above 0, shape (order,)
    is_tapered : whether the weights are a Hann window
    """
    turns = angle_rad[:, None] * orders
    basis = np.concatenate([np.ones((angle_rad.size, 1)), np.cos(turns), np.sin(turns)], axis=1)
    share = (angle_rad - angle_rad[0]) / (angle_rad[-1] - angle_rad[0])
    weight = np.sin(np.pi * share) if is_tapered else np.ones_like(share)  # root of the window
    fit = np.linalg.lstsq(basis * weight[:, None], signal.T * weight[:, None], rcond=None)[0].T
    cosines, sines = np.split(fit[:, 1:], 2, axis=1)
    return np.concatenate([fit[:, :1], cosines - 1j * sines], axis=1)


class FittedOrders:
    """One fit of all orders to a recording, which comes in pieces.

    Parameters
    ----------
    rate_hz, samples : sample rate and number of samples of the recording
    channels : number of its channels
    motion : motion of the shaft
    settings : the orders that are wanted; the fit has all multiples of their spacing up to the
        maximum order

    Raises
    ------
    ParameterError
        The recording has too few revolutions for the spacing, too many for a fit, or too low a
        sample rate.
    """

    def __init__(
        self, rate_hz: float, samples: int, channels: int, motion: CrankMotion,
        settings: OrderAnalysis,
    ) -> None:  # fmt: skip
        self._known = known_samples(motion, rate_hz, samples)
        self._settings = settings
        self._blocks: list[Array] = []
        self._orders: Array = np.array(settings.orders or DEFAULT_ORDERS)
        spacing = common_spacing(self._orders.tolist())
        highest = max(settings.maximum_or_default, float(self._orders[-1]))
        count = int(highest / spacing * (1.0 + 1e-9))
        self._lines: Array = spacing * np.arange(1, count + 1, dtype=float)
        used = self._known[1] - self._known[0]
        size = 8 * used * (2 * self._lines.size + 1 + channels)
        if size > MOST_FIT_BYTES:
            raise ParameterError(
                f"fit of {self._lines.size} orders to {used} samples takes {size / 2**30:.3g} GiB, "
                f"at most {MOST_FIT_BYTES / 2**30:g} GiB: analyse without fit, or a part by from_s "
                "and to_s"
            )
        self._time_s = np.arange(*self._known) / rate_hz
        self._angle_rad = motion.angle_rad(self._time_s)
        self._revolutions = float(np.ptp(self._angle_rad[[0, -1]])) / (2.0 * np.pi)
        self._check(spacing, rate_hz, motion)

    @property
    def is_tapered(self) -> bool:
        """Whether the samples have Hann weights."""
        spacing = float(self._lines[0])
        return spacing * self._revolutions >= TAPERED_SPACING_LINES * (1.0 - _SLACK)

    def add(self, block: Array) -> None:
        """Take the next samples, shape (channel, time)."""
        self._blocks.append(block)

    def result(self) -> OrdersOfBlocks:
        """Orders of all that has been added, as one block."""
        first, last = self._known
        signal = np.concatenate(self._blocks, axis=1)[:, first:last]
        fitted = fit_orders(signal, self._angle_rad, self._lines, self.is_tapered)
        spacing = float(self._lines[0])
        positions = np.rint(self._orders / spacing).astype(int)
        phasor = fitted[:, None, positions]
        rms = np.abs(fitted) / np.sqrt(2.0)
        rms[:, 0] = np.abs(fitted[:, 0])
        duration_s = self._time_s[-1] - self._time_s[0]
        return OrdersOfBlocks(
            order=self._orders,
            phasor=phasor,
            rms=np.abs(phasor) / np.sqrt(2.0),
            mean_spectrum=rms,
            map_order=np.concatenate([[0.0], self._lines]),
            amplitude=fitted[:, None] if self._settings.with_map else None,
            time_s=np.array([0.5 * (self._time_s[0] + self._time_s[-1])]),
            shaft_frequency_hz=np.array([self._revolutions / duration_s]),
            revolutions=round(self._revolutions, 3),
            resolution_order=(1.5 if self.is_tapered else 1.0) / self._revolutions,
            band_order=spacing,
        )

    def _check(self, spacing: float, rate_hz: float, motion: CrankMotion) -> None:
        if spacing * self._revolutions < LEAST_SPACING_LINES * (1.0 - _SLACK):
            raise ParameterError(
                f"orders {spacing:g} apart need {LEAST_SPACING_LINES / spacing:.3g} revolutions, "
                f"the signal has {self._revolutions:.3g} with a known angle"
            )
        fastest_hz = float(np.max(motion.frequency_hz(self._time_s)))
        limit = HIGHEST_PASS_BAND_RATIO * rate_hz / (2.0 * fastest_hz)
        if self._lines[-1] > limit:
            raise ParameterError(
                f"maximum_order = {self._lines[-1]:g}: must be above 0 and at most {limit:.4g} at "
                f"the highest speed, {60.0 * fastest_hz:.0f} rpm"
            )
