"""Impulse responses of a room that is made up: energies, first arrival, decay, a tone."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import fftconvolve

from vibroacoustics.base.constants import AIR_IMPEDANCE_PA_S_PER_M as IMPEDANCE
from vibroacoustics.base.constants import SPEED_OF_SOUND_M_PER_S
from vibroacoustics.levels.bands import bands_between
from vibroacoustics.levels.in_room import RoomPaths
from vibroacoustics.radiation.rooms.of_study import wave_share
from vibroacoustics.sound.room_responses import PathsOfRoom, room_responses

RATE = 48000
HIGHEST_HZ, RECORD_S, DECAY_S, RADIUS_M = 3000.0, 0.6, 0.5, 1.2
DISTANCE_M = np.array([2.0, 3.0])
REFLECTIONS = 200
LENGTH = 2**17


def pressure(hertz):
    """Echoes at two listeners, and a pulse at 20 positions, per velocity; of yaw nothing."""
    random = np.random.default_rng(7)
    omega = 2.0 * np.pi * hertz
    values = np.zeros((22, 6, hertz.size), dtype=complex)
    for listener, away in enumerate(DISTANCE_M / SPEED_OF_SOUND_M_PER_S):
        later_s = away + random.uniform(0.0, 0.9 * RECORD_S, REFLECTIONS)
        later_s[0] = away
        size = random.standard_normal((6, REFLECTIONS)) * 10.0 ** (-3.0 * later_s / DECAY_S)
        values[listener] = size @ np.exp(-1j * np.outer(later_s, omega))
    turned = np.exp(-1j * omega * RADIUS_M / SPEED_OF_SOUND_M_PER_S)
    values[2:] = random.standard_normal((20, 6, 1)) * turned
    values[:, 1], values[:, 5] = values[:, 0], 0.0  # sway as surge
    return 0.01j * omega * values


@pytest.fixture(scope="module")
def room():
    return room_to(1000.0)


def room_to(highest_hz):
    """The room with waves to a frequency."""
    direct = IMPEDANCE / (2.0 * np.pi * DISTANCE_M[:, None] ** 2) * [[1.0], [0.0]]  # one in sight
    per_power = lambda hertz: (direct + IMPEDANCE * 0.3) * np.ones(hertz.size)  # noqa: E731
    return PathsOfRoom(
        pressure=pressure,
        paths=RoomPaths(2, RADIUS_M, wave_share(highest_hz), per_power),
        direct_per_power=lambda hertz: direct * np.ones(hertz.size),
        distance_m=DISTANCE_M,
        nearest_m=RADIUS_M,
        decay_s=lambda hertz: np.full(hertz.size, DECAY_S),
        record_s=RECORD_S,
        highest_hz=HIGHEST_HZ,
    )


@pytest.fixture(scope="module")
def responses(room):
    return room_responses(room)


def test_third_octaves_have_the_mean_squares_of_the_levels(room, responses):
    """Below the seam the end is cut off a filter that rings for 0.1 s, above it a fit has a rest.

    Of waves 72 dB down at the end of the record 2.5e-4 of the pressure is left, 0.005 dB; of what
    the filter from 10 to 20 Hz turns it is more. What ends before the direct sound spreads over all
    frequencies, 60 dB below: 20 lg(1 + 1e-3) = 0.009 dB beside it.
    """
    hertz = np.fft.rfftfreq(LENGTH, 1.0 / RATE)
    written = np.abs(np.fft.rfft(responses, LENGTH)) ** 2
    for band in bands_between(3, 25.0, 2500.0):
        within = (hertz >= band.lower_hz) & (hertz < band.upper_hz)
        at = hertz[within]
        square = np.moveaxis(np.abs(pressure(at) / (2.0 * np.pi * at)) ** 2, 1, 0)
        wanted = room.paths.at_listeners(square, at).mean(axis=-1)[:5].T
        off_db = 10.0 * np.log10(written[:, :5, within].mean(axis=-1) / wanted)
        bound_db = 0.014 if 90.0 < band.upper_hz < 400.0 else 0.1
        assert np.abs(off_db).max() < bound_db, band.nominal_hz


@pytest.mark.parametrize("highest_hz", [250.0, 355.0, 500.0, 1000.0])
def test_nothing_comes_before_the_direct_sound(highest_hz):
    """1 ms before it, wherever waves go over into noise: 60 dB down, where 37 are stated."""
    responses = room_responses(room_to(highest_hz))
    for listener, away in enumerate(DISTANCE_M):
        first = int((away / SPEED_OF_SOUND_M_PER_S - 1e-3) * RATE)
        energy = np.cumsum(responses[listener, :5] ** 2, axis=-1)
        before_db = 10.0 * np.log10(energy[:, first] / energy[:, -1])
        assert before_db.max() < -50.0
    pulse = responses[0, 0, int(2.0 / SPEED_OF_SOUND_M_PER_S * RATE) :]
    assert np.sum(pulse[: RATE // 1000] ** 2) > 1e-3 * np.sum(pulse**2)


def test_the_noise_decays_in_the_reverberation_time(responses):
    """About 1.8 kHz: of 100 ms that fall by 12 dB some 100 values are independent, 0.6 dB.

    The five responses are parts of two noises: 0.4 dB at most for each of both ends.
    """
    spectrum = np.fft.rfft(responses, LENGTH)
    hertz = np.fft.rfftfreq(LENGTH, 1.0 / RATE)
    octave = np.fft.irfft(spectrum * np.exp(-0.5 * ((hertz - 1800.0) / 300.0) ** 2))
    early, late = (
        np.sum(octave[:, :5, int(start * RATE) :][..., : RATE // 10] ** 2) for start in (0.05, 0.35)
    )
    assert 10.0 * np.log10(early / late) == pytest.approx(60.0 * 0.3 / DECAY_S, abs=1.2)


def test_the_decay_goes_over_between_octaves_up_to_the_highest_frequency(room):
    """0.15 s to the octave of 2 kHz, 0.5 s in that of 4 kHz; about 2.9 kHz the noise is of both.

    Each part has unit power in all, the shares are linear along the logarithm of the frequency. Of
    100 ms some 70 values are independent, 0.7 dB at each end.
    """
    mixed = replace(room, decay_s=lambda hertz: np.where(hertz < 3000.0, 0.15, 0.5))
    spectrum = np.fft.rfft(room_responses(mixed), LENGTH)
    hertz = np.fft.rfftfreq(LENGTH, 1.0 / RATE)
    band = np.fft.irfft(spectrum * np.exp(-0.5 * ((hertz - 2900.0) / 200.0) ** 2))
    time_s = np.arange(RECORD_S * RATE) / RATE
    share = np.log2(2900.0 / 2000.0)
    quick, slow = (10.0 ** (-3.0 * time_s / decay_s) for decay_s in (0.15, 0.5))
    law = (1.0 - share) * quick / np.linalg.norm(quick) + share * slow / np.linalg.norm(slow)
    early, late = (
        slice(int(start * RATE), int(start * RATE) + RATE // 10) for start in (0.05, 0.35)
    )
    made_db = 10.0 * np.log10(np.sum(band[:, :5, early] ** 2) / np.sum(band[:, :5, late] ** 2))
    law_db = 10.0 * np.log10(np.sum(law[early] ** 2) / np.sum(law[late] ** 2))
    assert made_db == pytest.approx(law_db, abs=1.5)


@pytest.mark.parametrize("hertz", [97.0, 200.0])
def test_a_tone_comes_at_its_level(responses, hertz):
    """Convolved with an acceleration, after the record: as the vectors have it."""
    time = np.arange(int(1.5 * RATE)) / RATE
    made = fftconvolve(0.5 * np.sin(2.0 * np.pi * hertz * time), responses[1, 2])
    steady = made[int(0.7 * RATE) : int(1.5 * RATE)]
    whole = int(int(0.8 * hertz) / hertz * RATE)
    wanted = 0.5 * np.abs(pressure(np.array([hertz]))[1, 2, 0]) / (2.0 * np.pi * hertz)
    assert np.sqrt(2.0 * np.mean(steady[:whole] ** 2)) == pytest.approx(wanted, rel=3e-3)


def test_motions_that_cancel_are_silent_together(room, responses):
    assert not responses[:, 5].any()
    np.testing.assert_allclose(responses[:, 1], responses[:, 0], atol=1e-12)
    np.testing.assert_array_equal(room_responses(room), responses)
    assert responses.shape == (2, 6, round((RECORD_S + 0.05) * RATE))
