"""Levels of a study: lines of several cases on one axis, what options leave, the remainder."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.levels.axes import LevelAxes
from vibroacoustics.levels.by_source import SourceSound, gain_band_number
from vibroacoustics.levels.lines import line_pressure
from vibroacoustics.levels.remainder import (
    airborne_factor,
    in_spectrum,
    over_published,
    remaining,
    remaining_factor,
    unmodelled_bands,
    unmodelled_square,
)
from vibroacoustics.machine.remainder import OverallNoise, UnmodelledNoise
from vibroacoustics.mechanics.added import InsertionLoss
from vibroacoustics.mechanics.loads import Lines
from vibroacoustics.mechanics.received_sound import ReceivedSound

AXES = LevelAxes([3000.0, 1500.0], ["none"], ["moving_parts", "motor"], ["front"], [])
HOODED = {
    "none": SimpleNamespace(insertion_loss=lambda: None),
    "hood": SimpleNamespace(
        insertion_loss=lambda: InsertionLoss(np.array([50.0, 63.0]), np.array([20.0, 0.0]))
    ),
}
STUDY = SimpleNamespace(
    machine=SimpleNamespace(
        overall_noise=OverallNoise(
            level_dba=94.0, speed_rpm=3000.0, distance_m=1.0, deviation_db=2.0
        ),
        remainder=UnmodelledNoise(),
    ),
    measured=None,
    baseline=None,
    evidence=SimpleNamespace(spectrum=None),
    catalogue_receiver="front",
    catalogue_speed_rpm=3000.0,
    catalogue_case=(3000.0, "none"),
)


def received(orders, hertz, tone, size):
    names = (*(f"order {order}" for order in range(orders)), f"motor: {tone}")
    frequency = np.array([*(hertz * np.arange(orders)), 100.0])
    pressure = size * np.arange(1.0, orders + 2) * np.array([[[1.0]], [[1.0j]]])
    return ReceivedSound(Lines(names, frequency, {}), pressure, ())


def test_tones_of_one_name_are_one_line_after_all_orders():
    fast, slow = received(2, 50.0, "hum", 1.0), received(4, 25.0, "whine", 10.0)
    lines = line_pressure(AXES, {(3000.0, "none"): fast, (1500.0, "none"): slow})
    orders = [f"order {number}" for number in range(4)]
    assert lines["line"].values.tolist() == [*orders, "motor: hum", "motor: whine"]
    assert lines["line_order"].values[:4].tolist() == [0.0, 1.0, 2.0, 3.0]
    assert np.all(np.isnan(lines["line_order"].values[4:]))
    pressure = lines["pressure_line"].sel(option="none", receiver="front")
    of_motor = pressure.sel(sound_source="motor")
    assert of_motor.values[0].tolist() == [1.0j, 2.0j, 0.0, 0.0, 3.0j, 0.0]
    assert of_motor.values[1].tolist() == [10.0j, 20.0j, 30.0j, 40.0j, 0.0, 50.0j]
    frequency = lines["tone_frequency"].values
    np.testing.assert_array_equal(frequency[0], [0.0, 50.0, np.nan, np.nan, 100.0, np.nan])


def test_option_takes_its_loss_off_lines_and_its_mean_off_the_rest():
    frequency = xr.DataArray([[0.0, 50.0, 100.0]], {"speed": [3000.0], "order": [0, 1, 2]})
    factor = airborne_factor(HOODED, frequency)
    assert factor.dims == ("option", "speed", "order")
    assert factor.sel(option="none").values.tolist() == [[1.0, 1.0, 1.0]]
    assert factor.sel(option="hood").values[0] == pytest.approx([1.0, 0.1, 1.0])
    share = remaining_factor(HOODED, np.array([50.0, 63.0, 80.0])) @ np.array([0.6, 0.3, 0.1])
    assert share == pytest.approx([1.0, 0.6 * 0.01 + 0.3 + 0.1])


def sound(square):
    """The machine at the published speed, with a mean square in Pa²."""
    values = np.full((3, 1, 1), square)
    return {(3000.0, "none"): SourceSound(values[0], values[0], values)}


def test_remainder_fills_up_to_the_published_level():
    published = 4e-10 * 10.0**9.4
    assert unmodelled_square(STUDY, AXES, sound(0.25), False) == pytest.approx(published - 0.25)
    assert unmodelled_square(STUDY, AXES, sound(2.0), True) == 0.0
    with pytest.raises(ParameterError, match=r"= 94 dB\(A\): the model alone gives 97.0 dB\(A\)"):
        unmodelled_square(STUDY, AXES, sound(2.0), False)


def test_unmodelled_noise_grows_with_speed_and_passes_a_hood_band_by_band():
    """30 dB for ten times the speed; an even spectrum."""
    machine = SimpleNamespace(remainder=UnmodelledNoise(speed_growth_db=30.0, slope_db=0.0))
    axes = LevelAxes([3000.0, 1500.0], ["none", "hood"], ["keys"], ["front"], ())
    study = SimpleNamespace(**{**vars(STUDY), "options": HOODED})
    left = remaining(study, axes, machine, in_spectrum(machine, 0.81)).sum(axis=3)[:, :, 0]
    bands_of_remainder = 27  # 25 Hz to 10 kHz, of which the hood takes 20 dB off that at 50 Hz
    assert left[0] == pytest.approx([0.81, 0.81 * (1.0 - 0.99 / bands_of_remainder)])
    assert left[1] == pytest.approx(left[0] / 8.0)


def test_unmodelled_noise_has_the_shape_and_level_that_its_machine_gives():
    peak_hz, slope_db = 2000.0, 5.0
    given = UnmodelledNoise(peak_frequency_hz=peak_hz, slope_db=slope_db)
    bands = unmodelled_bands(STUDY, SimpleNamespace(remainder=given))
    assert bands.sum() == pytest.approx(4e-10 * 10.0**9.4)
    columns = [gain_band_number(np.array(hertz)) for hertz in (500.0, 1000.0, 8000.0)]
    fall = 10.0 * np.log10(bands[columns] / bands.max())
    assert fall == pytest.approx([-10.0, -5.0, -10.0], abs=0.1)  # 10^0.3, not 2


def test_a_sample_is_told_over_the_published_level():
    unsolved = {(3000.0, "none"): sound(1.0)[3000.0, "none"].unknown}
    over = over_published(STUDY, AXES, [sound(4e-10 * 10.0**9.1), unsolved])
    assert over[0] == pytest.approx(-3.0)
    assert np.isnan(over[1])
