"""Sound in a room from waves at the listeners and the power of a hemisphere."""

import numpy as np
import pytest
import xarray as xr

from vibroacoustics.base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from vibroacoustics.levels import a_weighting
from vibroacoustics.levels.in_room import (
    RoomPaths,
    blended_gains,
    power_of_hemisphere,
    room_sound,
    wave_gains,
)
from vibroacoustics.levels.measured_points import BASELINE_BANDS
from vibroacoustics.levels.room_crossover import shown_bands
from vibroacoustics.levels.room_levels import AirInRoom
from vibroacoustics.mechanics.loads import Lines
from vibroacoustics.mechanics.received_sound import NoisePower, ReceivedSound
from vibroacoustics.uncertainty.sampled_room import sampled_room_level

RADIUS_M = 1.2
RHO_C = AIR_DENSITY_KG_PER_M3 * SPEED_OF_SOUND_M_PER_S
AREA_M2 = 2.0 * np.pi * RADIUS_M**2
PER_POWER = np.array([[100.0], [50.0]])


def paths(share):
    return RoomPaths(2, RADIUS_M, share, lambda hertz: PER_POWER * np.ones(hertz.size))


def step(hertz):
    """Waves below 500 Hz."""
    return (hertz < 500.0).astype(float)


def received(pressure, hertz, noise=()):
    names = tuple(f"order {number}" for number in range(hertz.size))
    return ReceivedSound(Lines(names, hertz, {}), pressure, tuple(noise))


def test_waves_below_and_power_above():
    hertz = np.array([0.0, 100.0, 1000.0])
    pressure = np.zeros((2, 2 + 20, 3), dtype=complex)
    pressure[0, :2] = [[9.0, 0.2, 7.0], [9.0, 0.4, 7.0]]
    pressure[0, 2:] = 0.3
    pressure[1] = -0.5 * pressure[0]
    sound = room_sound(received(pressure, hertz), paths(step))
    weight = 10.0 ** (a_weighting(hertz[1:]) / 10.0)
    power = 0.5 * 0.3**2 * AREA_M2 / RHO_C
    alone = 0.5 * np.array([0.2, 0.4]) ** 2 * weight[0] + power * PER_POWER[:, 0] * weight[1]
    np.testing.assert_allclose(sound.alone[0], alone, rtol=1e-12)
    np.testing.assert_allclose(sound.alone[1], 0.25 * alone, rtol=1e-12)
    np.testing.assert_allclose(sound.total, 0.25 * alone, rtol=1e-12)  # phasors cancel by half
    names = [band.nominal_hz for band in BASELINE_BANDS]
    assert sound.power_band[names.index(1000.0)] == pytest.approx(0.25 * power)
    assert sound.band[1, names.index(100.0)] == pytest.approx(0.25 * 0.5 * 0.4**2)
    assert np.count_nonzero(sound.band[0]) == 2  # nothing at 0 Hz


def test_lines_keep_the_phase_of_the_waves_and_the_energy_of_both():
    """Sources together; without waves the phase is that at the first position."""
    hertz = np.array([0.0, 100.0, 700.0, 1000.0])
    pressure = np.zeros((2, 2 + 20, 4), dtype=complex)
    pressure[:, :2] = [[[9.0, 0.2j, 0.3 + 0.4j, 0.0]], [[9.0, 0.1, 0.0, 0.0]]]
    pressure[0, 2:] = 0.3
    pressure[0, 2] = 0.3j
    sound = room_sound(received(pressure, hertz), paths(step))
    assert sound.line == ("order 0", "order 1", "order 2", "order 3")
    np.testing.assert_allclose(sound.pressure[:, :2], [[0.0, 0.1 + 0.2j]] * 2, atol=1e-15)
    size = 0.3 * np.sqrt(AREA_M2 / RHO_C * PER_POWER[:, 0])
    np.testing.assert_allclose(sound.pressure[:, 2], size * (0.6 + 0.8j), rtol=1e-12)
    np.testing.assert_allclose(sound.pressure[:, 3], size * 1j, rtol=1e-12)
    weight = 10.0 ** (a_weighting(hertz[1:]) / 10.0)
    of_lines = 0.5 * np.abs(sound.pressure[:, 1:]) ** 2 @ weight
    np.testing.assert_allclose(of_lines, sound.total, rtol=1e-12)


def test_noise_adds_as_energy():
    hertz = np.array([100.0, 1000.0])
    pressure = np.zeros((2, 22, 1), dtype=complex)
    power = np.ones((22, 2)) * [[0.1, 0.2]]
    quiet = received(pressure, np.array([50.0]), [NoisePower(1, hertz, power)])
    sound = room_sound(quiet, paths(step))
    weight = 10.0 ** (a_weighting(hertz) / 10.0)
    expected = 0.1 * weight[0] + 0.2 * AREA_M2 / RHO_C * PER_POWER[:, 0] * weight[1]
    np.testing.assert_allclose(sound.total, expected, rtol=1e-12)
    np.testing.assert_allclose(sound.alone, [[0.0, 0.0], expected], rtol=1e-12)
    assert not sound.pressure.any()
    np.testing.assert_allclose(sound.noise_band, sound.band, rtol=1e-12)


def test_between_the_methods_energies_are_shared():
    half = paths(lambda hertz: 0.25 * np.ones(hertz.size))
    square = np.ones((22, 1))
    expected = 0.25 + 0.75 * AREA_M2 / RHO_C * PER_POWER
    np.testing.assert_allclose(half.at_listeners(square, np.array([500.0])), expected, rtol=1e-12)


def test_gains_are_those_of_translations_with_equal_powers():
    """A motion ten times as strong counts as much; rotations do not count."""

    def pressure(hertz):
        values = np.ones((22, 6, hertz.size), dtype=complex)
        values[:, 0] *= 10.0
        values[0, 1] *= 2.0
        values[:2, 3:] = 99.0
        return values

    gains = wave_gains(pressure, paths(step), 450.0)
    one = RHO_C / AREA_M2
    middle = np.array([band.middle_hz for band in BASELINE_BANDS])
    low = middle < 455.0
    np.testing.assert_allclose(gains[0, low], one * (1.0 + 4.0 + 1.0) / 3.0, rtol=1e-12)
    np.testing.assert_allclose(gains[1, low], one, rtol=1e-12)
    assert not gains[:, ~low].any()
    both, diffuse = blended_gains(gains, paths(step))
    np.testing.assert_allclose(both[1, middle < 400.0], one, rtol=1e-12)
    np.testing.assert_allclose(both[:, middle > 600.0], diffuse[:, middle > 600.0], rtol=1e-12)


def test_power_of_a_hemisphere():
    """1 Pa² at 1 m: W = 2π/(ρ c)."""
    assert power_of_hemisphere(np.array(1.0), 1.0) == pytest.approx(2.0 * np.pi / RHO_C)


def test_samples_change_model_and_rest_as_at_the_microphone():
    """Model 60 dB, rest 50 dB there; in a sample 3 and 6 dB more; in the room 1 and 2 Pa²."""
    coords = {"speed": [2900.0], "option": ["none"], "receiver": ["front"]}
    sampled = {**coords, "sample": [1, 2]}

    def levels(name, values, where, *dims):
        return xr.DataArray(np.reshape(values, [len(where[d]) for d in dims]), where, dims, name)

    def sums(model, rest):
        return 10.0 * np.log10(10.0 ** (np.array(model) / 10.0) + 10.0 ** (np.array(rest) / 10.0))

    cases = ("speed", "option", "receiver")
    results = xr.Dataset(
        {
            "level_modelled": levels("m", 60.0, coords, *cases).expand_dims(weighting=["A"]),
            "level_total": levels("t", sums(60.0, 50.0), coords, *cases),
            "level_modelled_by_sample": levels("d", [60.0, 63.0], sampled, "sample", *cases),
            "level_total_by_sample": levels(
                "e", sums([60, 63], [50, 56]), sampled, "sample", *cases
            ),
            "sample_weight": (("prior", "sample"), [[0.5, 0.5]]),
        },
    )
    none = [np.zeros(0)] * 4
    place = {"speed": [2900.0], "option": ["none"], "listener": ["table"]}
    air = AirInRoom(np.array([[[1.0]]]), np.array([[[2.0]]]), *none, place)
    found = sampled_room_level(air, results, "front")
    ends = 10.0 * np.log10(np.array([3.0, 10.0**0.3 + 2.0 * 10.0**0.6]) / 4e-10)
    assert found["room_level"].item() == pytest.approx(ends.mean(), abs=1e-9)
    low, high = ends[0] + 0.1 * np.diff(ends), ends[0] + 0.9 * np.diff(ends)
    assert found["room_level_10_percent"].item() == pytest.approx(low.item(), abs=1e-9)
    assert found["room_level_90_percent"].item() == pytest.approx(high.item(), abs=1e-9)
    assert found["room_level_nominal"].item() == pytest.approx(ends[0], abs=1e-9)
    assert not sampled_room_level(air, results.drop_vars("sample_weight"), "front").data_vars


def test_the_last_third_of_round_frequencies_has_waves():
    """250 Hz is 251.2 Hz: the half of it below the end of the waves stands for it."""
    gains = wave_gains(lambda hertz: np.ones((22, 6, hertz.size), complex), paths(step), 250.0)
    names = [band.nominal_hz for band in BASELINE_BANDS]
    assert gains[0, names.index(250.0)] > 0.0
    assert gains[0, names.index(315.0)] == 0.0
    assert shown_bands((125.0, 250.0))[-1] == names.index(250.0)
