"""Sound of a machine at listeners in a room: waves at low frequencies, its power above."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.constants import AIR_IMPEDANCE_PA_S_PER_M
from ..mechanics.received_sound import ReceivedSound
from .bands import Band
from .by_source import membership, weighting_power
from .measured_points import BASELINE_BANDS
from .sound_power import hemisphere_area_m2

LINES_OF_BAND: Final = 24
"""Frequencies that stand for a third octave."""
LOWEST_HZ: Final = 1.0
"""Frequency in place of 0 Hz, where nothing is heard."""
ROUNDED: Final = 1.01
"""Factor of the middle of a band that is called by a round number."""


@dataclass(frozen=True)
class RoomPaths:
    """Paths of sound to the listeners, and the machine's power from positions.

    Attributes
    ----------
    listeners : how many; their pressure by waves comes first among what is received, then that of
        the positions on a hemisphere
    radius_m : radius of the hemisphere
    wave_share : function of frequencies, shape (frequency,): 1 where waves count, 0 where the power
        does
    per_power : mean square of pressure per power by direct sound and diffuse field, of
        frequencies, shape (listener, frequency), Pa²/W
    """

    listeners: int
    radius_m: float
    wave_share: Callable[[Array], Array]
    per_power: Callable[[Array], Array]

    def power(self, mean_square: Array) -> Array:
        """W = S/(ρ c) times the mean over the positions, which are the axis before the last, W.

        ISO 3744:2010, with the intensity as p²/(ρ c).
        """
        area = hemisphere_area_m2(self.radius_m)
        mean: Array = mean_square[..., self.listeners :, :].mean(axis=-2)
        return mean * area / AIR_IMPEDANCE_PA_S_PER_M

    def at_listeners(self, mean_square: Array, frequency_hz: Array) -> Array:
        """Mean squares at the listeners, shape (..., listener, frequency), Pa².

        Parameters
        ----------
        mean_square : mean square at the listeners by waves, then at the positions on the
            hemisphere, shape (..., place, frequency), Pa²
        frequency_hz : shape (frequency,)
        """
        share = self.wave_share(frequency_hz)
        waves = mean_square[..., : self.listeners, :]
        diffuse = self.power(mean_square)[..., None, :] * self.per_power(frequency_hz)
        return np.asarray(share * waves + (1.0 - share) * diffuse)


@dataclass(frozen=True)
class RoomSound:
    """Mean squares of all sources of a case at the listeners, and the machine's power.

    Attributes
    ----------
    alone : A-weighted, of each source alone, shape (source, listener), Pa²
    total : A-weighted, of all together, shape (listener,), Pa²
    band : mean square of all sources, unweighted, in `BASELINE_BANDS`, shape (listener, band), Pa²
    power_band : power of all sources, unweighted, shape (band,), W
    pressure : pressure of all sources at the lines, complex peaks, shape (listener, line), Pa
    noise_band : mean square of all noise without lines, unweighted, shape (listener, band), Pa²
    line : names of the lines
    """

    alone: Array
    total: Array
    band: Array
    power_band: Array
    pressure: ComplexArray
    noise_band: Array
    line: tuple[str, ...]


def room_sound(received: ReceivedSound, paths: RoomPaths) -> RoomSound:
    """Sound of a case in a room: lines of all sources as phasors, noise as energy.

    Parameters
    ----------
    received : sound at the listeners by waves, then at the positions on the hemisphere
    paths : paths from the machine to the listeners
    """
    hertz = received.lines.frequency_hz
    audible = hertz > 0.0
    by_source = 0.5 * np.abs(received.pressure) ** 2 * audible
    of_all = received.pressure.sum(axis=0)
    together = 0.5 * np.abs(of_all) ** 2 * audible
    safe = np.maximum(hertz, LOWEST_HZ)
    weight, in_band = weighting_power("A", safe), membership(hertz, BASELINE_BANDS)
    alone = paths.at_listeners(by_source, safe) @ weight
    at_listeners = paths.at_listeners(together, safe)
    total, band = at_listeners @ weight, at_listeners @ in_band
    power_band = paths.power(together) @ in_band
    noise_band = np.zeros_like(band)
    for part in received.noise:
        noise = paths.at_listeners(part.power, np.maximum(part.frequency_hz, LOWEST_HZ))
        loud = noise @ weighting_power("A", part.frequency_hz)
        alone[part.source] += loud
        total = total + loud
        in_band = membership(part.frequency_hz, BASELINE_BANDS)
        noise_band += noise @ in_band
        power_band = power_band + paths.power(part.power) @ in_band
    peaks = np.sqrt(2.0 * at_listeners) * _turn(of_all, paths.listeners)
    return RoomSound(
        alone, total, band + noise_band, power_band, peaks, noise_band, received.lines.names
    )


def _turn(pressure: ComplexArray, listeners: int) -> ComplexArray:
    """exp(jφ) at the listeners, shape (listener, line).

    φ is the phase of the waves; where there are none, that at the first position on the hemisphere
    (assumed: in a room it is random).
    """
    waves = pressure[:listeners]
    phase = np.angle(np.where(waves == 0.0, pressure[listeners], waves))
    return np.asarray(np.exp(1j * phase))


def power_of_hemisphere(mean_square: Array, distance_m: float) -> Array:
    """Power of a source on a hard floor that sends alike everywhere, 2π r² p²/(ρ c), W.

    Parameters
    ----------
    mean_square : mean square of the pressure at the distance, shape (...), Pa²
    distance_m : distance from the point of the floor below the source
    """
    return np.asarray(mean_square * hemisphere_area_m2(distance_m) / AIR_IMPEDANCE_PA_S_PER_M)


def wave_gains(
    pressure_per_velocity: Callable[[Array], ComplexArray], paths: RoomPaths, highest_hz: float
) -> Array:
    """Mean square by waves per power in `BASELINE_BANDS`, shape (listener, band), Pa²/W.

    The machine shakes along x, y and z with the same power each. Gains are zero in bands above
    the waves.

    Parameters
    ----------
    pressure_per_velocity : function that takes frequencies, Hz, and returns the pressure per
        velocity at listeners and positions, shape (place, motion, frequency), Pa s/m
    paths : paths from the machine to the listeners
    highest_hz : highest frequency of the waves
    """
    gains = np.zeros((paths.listeners, len(BASELINE_BANDS)))
    for number, band in enumerate(BASELINE_BANDS):
        hertz = frequencies_of(band)
        hertz = hertz[hertz <= highest_hz]
        if band.middle_hz > highest_hz * ROUNDED:
            break
        square = np.abs(pressure_per_velocity(hertz)[:, :3]) ** 2
        by_motion = np.moveaxis(square, 1, 0)
        power = paths.power(by_motion).mean(axis=-1)
        waves = by_motion[:, : paths.listeners].mean(axis=-1)
        gains[:, number] = (waves / power[:, None]).mean(axis=0)
    return gains


def frequencies_of(band: Band) -> Array:
    """Frequencies spread evenly over a band."""
    middle = (np.arange(LINES_OF_BAND) + 0.5) / LINES_OF_BAND
    return np.asarray(band.lower_hz + middle * (band.upper_hz - band.lower_hz))


def blended_gains(waves: Array, paths: RoomPaths) -> tuple[Array, Array]:
    """Mean square per power in `BASELINE_BANDS`, Pa²/W: both methods blended, and without waves.

    Parameters
    ----------
    waves : gain by waves, see `wave_gains`, shape (listener, band), Pa²/W
    paths : paths from the machine to the listeners

    Returns
    -------
    blend of waves with direct sound and diffuse field, by the wave share, and direct sound and
    diffuse field alone; each of shape (listener, band)
    """
    hertz = np.array([frequencies_of(band) for band in BASELINE_BANDS])
    share = paths.wave_share(hertz.ravel()).reshape(hertz.shape).mean(axis=1)
    diffuse = paths.per_power(hertz.ravel()).reshape(paths.listeners, *hertz.shape).mean(axis=2)
    return share * waves + (1.0 - share) * diffuse, diffuse
