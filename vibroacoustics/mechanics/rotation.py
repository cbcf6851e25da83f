"""Rotation of a shaft over one revolution, at a constant or a varying speed."""

from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array
from ..base.units import shaft_frequency_hz


@dataclass(frozen=True)
class Rotation:
    """Periodic rotation of a shaft over uniform crank angles of one revolution.

    Attributes
    ----------
    speed_rad_per_s : shape (samples,)
    acceleration_rad_per_s2 : shape (samples,)

    Examples
    --------
    >>> angle = va.constant_rotation(3000.0, 64).crank_angle
    >>> speed = 314.0 + 5.0 * np.cos(angle)  # rad/s over crank angle
    >>> rotation = va.Rotation(speed, -5.0 * np.sin(angle) * speed)  # dω/dt = ω dω/dθ
    >>> round(rotation.fluctuation_ratio, 3)
    0.032
    """

    speed_rad_per_s: Array
    acceleration_rad_per_s2: Array

    @property
    def crank_angle(self) -> Array:
        """Shape (samples,), rad."""
        return uniform_crank_angle(self.speed_rad_per_s.size)

    @property
    def fluctuation_ratio(self) -> float:
        """(largest - smallest speed)/mean speed over time."""
        return float(np.ptp(self.speed_rad_per_s) * np.mean(1.0 / self.speed_rad_per_s))

    @property
    def duration_s(self) -> float:
        """Time of one revolution."""
        return float(2.0 * np.pi * np.mean(1.0 / self.speed_rad_per_s))

    @property
    def time_s(self) -> Array:
        """Time at each crank angle from crank angle zero, shape (samples,)."""
        return crank_time_s(self.speed_rad_per_s)


def uniform_crank_angle(samples: int) -> Array:
    """Crank angles of one revolution from zero, shape (samples,), rad."""
    return 2.0 * np.pi * np.arange(samples) / samples


def constant_rotation(speed_rpm: float, samples: int) -> Rotation:
    """Rotation at a constant speed.

    Parameters
    ----------
    speed_rpm : above zero
    samples : uniform crank angles over a revolution

    Examples
    --------
    >>> rotation = va.constant_rotation(3000.0, 4)
    >>> rotation.speed_rad_per_s.round(2).tolist()
    [314.16, 314.16, 314.16, 314.16]
    """
    speed = 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
    return Rotation(np.full(samples, speed), np.zeros(samples))


def crank_time_s(speed_rad_per_s: Array) -> Array:
    """Time at uniform crank angles of one revolution from zero, shape (samples,).

    The integral of 1/speed over crank angle, by its Fourier series.

    Parameters
    ----------
    speed_rad_per_s : shape (samples,)
    """
    slowness = 1.0 / speed_rad_per_s
    mean = slowness.mean()
    spectrum = np.fft.rfft(slowness - mean)
    orders = np.arange(1, spectrum.size)
    spectrum[1:] /= 1j * orders
    if slowness.size % 2 == 0:
        spectrum[-1] = 0.0  # the highest order has no integral on these samples
    wave = np.fft.irfft(spectrum, n=slowness.size)
    return np.asarray(mean * uniform_crank_angle(slowness.size) + wave - wave[0])
