"""Force and moment by order at one or many speeds, and at the speeds between."""

import base64
import binascii
import zlib
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...base.errors import ParameterError

COMPONENTS: Final = ("fx", "fy", "fz", "mx", "my", "mz")
"""Force and moment about the centre of mass at rest, along and about the machine's x, y and z."""
SAME_SPEED: Final = 1e-9
"""Speeds that differ by less than this part of them are one."""
SMALLEST_STEPS: Final = 3
"""Least number of crank angles over a revolution: with fewer there is no order one."""


@dataclass(frozen=True)
class Spectra:
    """Orders from zero, complex peaks X of x(θ) = Re Σ X_k exp(jkθ), at constant speed.

    Attributes
    ----------
    speed_rpm : rising, shape (speed,)
    sources : who makes the force
    orders : shape (speed, source, component, order), N and N m
    """

    speed_rpm: tuple[float, ...]
    sources: tuple[str, ...]
    orders: ComplexArray

    def between(self, speed_rpm: float) -> ComplexArray:
        """Return the spectra at a speed in their range, shape (source, component, order).

        Each complex order is linear in the speed squared between two speeds of the table: exact
        there, and everywhere for inertia, which grows as the speed squared, and for a force that
        does not depend on speed.

        Parameters
        ----------
        speed_rpm : in the range of the table

        Raises
        ------
        ParameterError
            It is not.
        """
        tabulated_rpm = np.array(self.speed_rpm)
        same = np.flatnonzero(np.abs(tabulated_rpm - speed_rpm) <= SAME_SPEED * tabulated_rpm)
        if same.size:
            return np.asarray(self.orders[same[0]])
        if not tabulated_rpm[0] < speed_rpm < tabulated_rpm[-1]:
            raise ParameterError(
                f"speed_rpm = {speed_rpm:g} rpm: the table of forces has {tabulated_rpm[0]:g}"
                + (f" to {tabulated_rpm[-1]:g} rpm" if tabulated_rpm.size > 1 else " rpm alone")
            )
        above = int(np.searchsorted(tabulated_rpm, speed_rpm))
        low, high = tabulated_rpm[above - 1] ** 2, tabulated_rpm[above] ** 2
        share = (speed_rpm**2 - low) / (high - low)
        return np.asarray((1.0 - share) * self.orders[above - 1] + share * self.orders[above])


def orders_of(signal: Array) -> ComplexArray:
    """Orders below half the samples of one revolution, shape (..., order).

    Parameters
    ----------
    signal : over uniform crank angles from zero, shape (..., samples)
    """
    samples = signal.shape[-1]
    spectrum = np.fft.rfft(signal)[..., : (samples - 1) // 2 + 1] / samples
    spectrum[..., 1:] *= 2.0
    return np.asarray(spectrum)


def over_revolution(orders: ComplexArray, samples: int) -> Array:
    """The signal at uniform crank angles, shape (..., samples); orders that they cannot hold go.

    Parameters
    ----------
    orders : from zero, complex peaks, shape (..., order)
    samples : over a revolution
    """
    held = orders[..., : (samples - 1) // 2 + 1] * (0.5 * samples)
    held[..., 0] *= 2.0
    return np.asarray(np.fft.irfft(held, n=samples))


def packed(orders: ComplexArray) -> str:
    """Complex orders as text, bit by bit."""
    return base64.b64encode(zlib.compress(orders.astype("<c16").tobytes())).decode()


def unpacked(text: str, speeds: int, sources: int) -> ComplexArray:
    """Complex orders from text, shape (speed, source, component, order).

    Raises
    ------
    ValueError
        It is no such text.
    """
    try:
        content = zlib.decompress(base64.b64decode(text, validate=True))
    except (binascii.Error, zlib.error):
        raise ValueError("packed: is not what was read from a file") from None
    return np.frombuffer(content, dtype="<c16").reshape(speeds, sources, len(COMPONENTS), -1)
