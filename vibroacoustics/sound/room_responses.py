"""Impulse responses from a machine to listeners in a room: waves, direct sound, decaying noise."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from scipy import fft

from ..base.arrays import Array, ComplexArray
from ..base.constants import AIR_IMPEDANCE_PA_S_PER_M, SPEED_OF_SOUND_M_PER_S
from ..levels.bands import HALF_BAND, bands_between
from ..levels.in_room import RoomPaths
from ..levels.sound_power import hemisphere_area_m2
from .least_phase import Numbers, between, least_phase
from .rendering import SAMPLE_RATE_HZ, SEED

FADE: Final = HALF_BAND**2
"""Highest frequency over that of the radiation: a third octave, in which the response fades out."""
FADING_S: Final = 0.05
"""Time after the record: what filters delay is not cut off."""
LOWEST_HZ: Final = (10.0, 20.0)
"""Nothing below the first, all from the second on: what is computed of a room at a few hertz over
the square of the frequency is rounding."""
RISE_S: Final = 1e-3
"""Ahead of the direct sound, within which noise and pulse may begin."""
_DECAY: Final = 3.0 * np.log(10.0)
"""Decay of the pressure within a reverberation time."""
_DECAYS_FROM_HZ: Final = 125.0
_BLOCK: Final = 4096
_ROUNDS: Final = 8
_MOST_GAIN: Final = 2.0
"""Largest gain over that without correlation: bands that need nearly none get next to none."""


@dataclass(frozen=True)
class PathsOfRoom:
    """Paths of a machine's rigid motions to listeners as sound.

    Attributes
    ----------
    pressure : per velocity, of frequencies to the highest one: at the listeners by waves, then at
        the positions on a hemisphere, shape (place, motion, frequency), Pa s/m
    paths : from these to mean squares at the listeners
    direct_per_power : mean square of direct sound per power, of frequencies, (listener, frequency),
        Pa²/W
    distance_m : from the machine, shape (listener,)
    nearest_m : distance of the nearest position on the hemisphere from the machine's wall, or less
    decay_s : reverberation time, of frequencies
    record_s : duration of the waves
    highest_hz : highest frequency of the radiation
    """

    pressure: Callable[[Array], ComplexArray]
    paths: RoomPaths
    direct_per_power: Callable[[Array], Array]
    distance_m: Array
    nearest_m: float
    decay_s: Callable[[Array], Array]
    record_s: float
    highest_hz: float


def room_responses(room: PathsOfRoom, sample_rate_hz: int = SAMPLE_RATE_HZ) -> Array:
    """Pressure at listeners per acceleration, (listener, motion, sample), Pa/(m/s²) or Pa/(rad/s²).

    They are samples, so that the convolution of a sampled acceleration with it is the pressure.
    Below the crossover the waves; in it and above direct sound, a pulse at its time of travel, and
    noise that decays with the reverberation time from then on. The noise is a sum of those of all
    positions on the hemisphere, so that motions together have the power that they have there. Both
    are changed until the response has in each third octave the mean square of both methods. The
    square roots of the methods' shares are filters of least phase, so that nothing sounds before it
    can: they turn the phase of the waves, alike at all listeners and for all motions.

    Parameters
    ----------
    room : paths of the machine's sound
    sample_rate_hz : sample rate of acceleration and pressure
    """
    decaying, fading = (round(time * sample_rate_hz) for time in (room.record_s, FADING_S))
    samples = decaying + fading
    length = fft.next_fast_len(2 * samples, real=True)
    hertz = fft.rfftfreq(length, 1.0 / sample_rate_hz)[1:]
    hertz = hertz[hertz < min(room.highest_hz * FADE, 0.5 * sample_rate_hz)]
    noise = [
        _decaying(room, number, decaying, length, hertz) for number in range(room.distance_m.size)
    ]
    parts = _received(room, hertz, np.array(noise))
    waves, others, square = _weighted(room, parts, hertz, length)
    spectrum = np.zeros((*waves.shape[:-1], length // 2 + 1), dtype=complex)
    in_crossover = waves * least_phase(np.sqrt(1.0 - room.paths.wave_share(hertz)), length)
    gate = _gate(room.distance_m / SPEED_OF_SOUND_M_PER_S, samples, length, sample_rate_hz)
    scaled = _scaled(others, (waves, in_crossover), square, hertz, gate)
    spectrum[..., 1 : hertz.size + 1] = waves + scaled
    responses = np.asarray(fft.irfft(spectrum, length)[..., :samples])
    responses[..., decaying:] *= np.cos(0.5 * np.pi * np.arange(fading) / fading) ** 2
    return responses


def _decaying(
    room: PathsOfRoom, listener: int, samples: int, length: int, hertz: Array
) -> ComplexArray:
    """Spectra of decaying noise of unit power, one a position, shape (position, frequency).

    Each octave decays in its own time; between their middles the noise goes over from one to the
    other along the logarithm of the frequency.
    """
    rate = length * (hertz[1] - hertz[0])
    octaves = np.arange(np.ceil(np.log2(hertz[-1] / _DECAYS_FROM_HZ)) + 1.0)
    middles = _DECAYS_FROM_HZ * 2.0**octaves
    shares = between(np.log2(hertz / _DECAYS_FROM_HZ), octaves, np.eye(octaves.size))
    time = np.arange(samples) / rate
    decays = np.exp(-_DECAY * time / room.decay_s(middles)[:, None])
    decays /= np.sqrt(np.sum(decays**2, axis=1, keepdims=True))
    random = np.random.default_rng([SEED, listener])
    spectra = np.zeros((_positions(room), hertz.size), dtype=complex)
    for position in range(len(spectra)):
        white = random.standard_normal(samples)
        for decay, share in zip(decays, shares, strict=True):
            spectra[position] += share * fft.rfft(white * decay, length)[1 : hertz.size + 1]
    delay_s = room.distance_m[listener] / SPEED_OF_SOUND_M_PER_S
    return np.asarray(spectra * np.exp(-2j * np.pi * hertz * delay_s))


class _Received(NamedTuple):
    """Response to a unit acceleration before the shares of the methods.

    Attributes
    ----------
    waves : at the listeners, shape (listener, motion, frequency)
    positions : sum of the positions with the noise of each, of the same shape
    power : shape (motion, frequency), W
    square : mean squares at the listeners by both methods, shape (listener, motion, frequency), Pa²
    """

    waves: ComplexArray
    positions: ComplexArray
    power: Array
    square: Array


def _received(room: PathsOfRoom, hertz: Array, noise: ComplexArray) -> _Received:
    """Received sound in blocks of frequencies; above the radiation's highest one as at that."""
    parts = []
    for start in range(0, hertz.size, _BLOCK):
        block = slice(start, start + _BLOCK)
        parts.append(_of_block(room, hertz[block], noise[..., block]))
    return _Received(*(np.concatenate(each, axis=-1) for each in zip(*parts, strict=True)))


def _of_block(room: PathsOfRoom, hertz: Array, noise: ComplexArray) -> _Received:
    paths, bounded_hz = room.paths, np.minimum(hertz, room.highest_hz)
    per_acceleration = room.pressure(bounded_hz) / (2j * np.pi * bounded_hz)
    waves, positions = np.split(per_acceleration, [paths.listeners])
    by_motion = np.moveaxis(np.abs(per_acceleration) ** 2, 1, 0)
    square = np.moveaxis(paths.at_listeners(by_motion, bounded_hz), 1, 0)
    turned = positions * np.exp(2j * np.pi * bounded_hz * room.nearest_m / SPEED_OF_SOUND_M_PER_S)
    return _Received(
        waves, np.einsum("pmf,lpf->lmf", turned, noise), paths.power(by_motion), square
    )


def _weighted(
    room: PathsOfRoom, parts: _Received, hertz: Array, length: int
) -> tuple[ComplexArray, ComplexArray, Array]:
    """Waves, direct sound with noise, mean squares of all, each (listener, motion, frequency).

    They fade out below 20 Hz and above the highest frequency of the radiation.
    """
    paths, bounded_hz = room.paths, np.minimum(hertz, room.highest_hz)
    fade = _faded(hertz, room.highest_hz)
    share, direct = paths.wave_share(bounded_hz), room.direct_per_power(bounded_hz)
    reflected = np.maximum(paths.per_power(bounded_hz) - direct, 0.0)
    per_position = hemisphere_area_m2(paths.radius_m) / AIR_IMPEDANCE_PA_S_PER_M / _positions(room)
    travel_s = room.distance_m[:, None, None] / SPEED_OF_SOUND_M_PER_S
    above = (1.0 - share) * fade**2
    pulse = least_phase(np.sqrt(above * direct[:, None] * parts.power), length)
    waves = least_phase(np.sqrt(share) * fade, length) * parts.waves
    size = least_phase(np.sqrt(above * reflected * per_position), length)
    others = size[:, None] * parts.positions + pulse * np.exp(-2j * np.pi * hertz * travel_s)
    return waves, others, parts.square * fade**2


def _faded(hertz: Array, highest_hz: float) -> Array:
    """Fade from 0 to 1 over the lowest octave, to 0 again above the highest frequency."""
    rise = np.log(hertz / LOWEST_HZ[0]) / np.log(LOWEST_HZ[1] / LOWEST_HZ[0])
    fall = np.log(hertz / highest_hz) / np.log(FADE)
    return np.asarray(
        np.sin(0.5 * np.pi * np.clip(rise, 0.0, 1.0))
        * np.cos(0.5 * np.pi * np.clip(fall, 0.0, 1.0))
    )


def _positions(room: PathsOfRoom) -> int:
    """Number of positions on the hemisphere."""
    return len(room.pressure(np.array([room.highest_hz]))) - room.paths.listeners


def _scaled(
    others: ComplexArray,
    crossover: tuple[ComplexArray, ComplexArray],
    square: Array,
    hertz: Array,
    gate: Array,
) -> ComplexArray:
    """Direct sound and noise with the gain that gives, with the waves, the mean squares of both.

    In each third octave what they have in common with the waves is taken out of them, as waves in
    the crossover alone, by the waves' share of the energy: of a band that the waves hardly reach it
    would be a large factor for its neighbours. In a third octave |w + g n|² = s has then the gain
    g = (√(c² + |n|² (s - |w|²)) - c)/|n|² with c = Re{w* n}, sums over the band. Both go over
    smoothly between the middles of the bands. They have no phase and spread in time by the inverse
    of a band's width: what comes before the direct sound is cut off in each round, until there is
    next to nothing.

    Parameters
    ----------
    others : direct sound and noise, shape (listener, motion, frequency)
    crossover : waves, and those at the crossover, of the same shape
    square : mean squares of all, of the same shape, Pa²
    hertz : shape (frequency,)
    gate : share of each sample that is kept, shape (listener, 1, time)
    """
    waves, in_crossover = crossover
    bands = bands_between(3, hertz[0], hertz[-1])
    edges = np.searchsorted(hertz, [band.lower_hz for band in bands])
    starts, kept = np.unique(edges[edges < hertz.size], return_index=True)
    middles = np.log([bands[number].middle_hz for number in kept])

    def summed(values: Numbers) -> Numbers:
        total: Numbers = np.add.reduceat(values, starts, axis=-1)
        return total

    def ratio(part: Numbers, total: Numbers) -> Numbers:
        of_bands: Numbers = part / np.where(total == 0.0, 1.0, total)
        return between(np.log(hertz), middles, of_bands)

    of_waves = summed(np.abs(waves) ** 2)
    wanted = np.maximum(summed(square) - of_waves, 0.0)
    shared = summed(waves.conj() * in_crossover) * (
        1.0 + wanted / np.where(of_waves == 0.0, 1.0, of_waves)
    )
    for _ in range(_ROUNDS):
        others = others - ratio(summed(waves.conj() * others), shared) * in_crossover
        common, energy = summed((waves.conj() * others).real), summed(np.abs(others) ** 2)
        uncorrelated = np.sqrt(energy * wanted)
        root = np.sqrt(common**2 + uncorrelated**2) - common
        gain = ratio(np.minimum(root, _MOST_GAIN * uncorrelated), energy)
        others = _cut(others * gain, gate)
    return others


def _gate(arrival_s: Array, samples: int, length: int, sample_rate_hz: int) -> Array:
    """Weights that end what comes before the direct sound, shape (listener, 1, time).

    They rise within the millisecond before it. The last samples of the transform are those before
    its first one.

    Parameters
    ----------
    arrival_s : arrival time of the direct sound, shape (listener,)
    samples : number of samples of a response
    length : length of the transform
    sample_rate_hz : sample rate of the samples
    """
    number = np.arange(length)
    time_s = np.where(number < (length + samples) // 2, number, number - length) / sample_rate_hz
    ahead = np.clip((arrival_s[:, None, None] - time_s) / RISE_S, 0.0, 1.0)
    return np.asarray(np.cos(0.5 * np.pi * ahead) ** 2)


def _cut(spectra: ComplexArray, gate: Array) -> ComplexArray:
    """Spectra of what a gate keeps of their samples, shape (..., frequency)."""
    length, lines = gate.shape[-1], spectra.shape[-1]
    spectrum = np.zeros((*spectra.shape[:-1], length // 2 + 1), dtype=complex)
    spectrum[..., 1 : lines + 1] = spectra
    return np.asarray(fft.rfft(gate * fft.irfft(spectrum, length))[..., 1 : lines + 1])
