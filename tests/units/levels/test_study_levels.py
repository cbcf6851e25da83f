"""Levels of a study: lines of several cases on one axis, what options leave, the remainder."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from vibroacoustics.base.errors import ParameterError, SolverError
from vibroacoustics.levels.axes import LevelAxes
from vibroacoustics.levels.by_source import SourceSound
from vibroacoustics.levels.insertion_loss import airborne_factor, remaining_share
from vibroacoustics.levels.lines import line_pressure
from vibroacoustics.levels.remainder import remainder, remainder_by_draw
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
    machine=SimpleNamespace(overall_noise=SimpleNamespace(level_dba=94.0, speed_rpm=3000.0)),
    catalogue_receiver="front",
    catalogue_case=(3000.0, "none"),
)


def received(orders, hertz, tone, size):
    names = (*(f"order {order}" for order in range(orders)), f"motor: {tone}")
    frequency = np.array([*(hertz * np.arange(orders)), 100.0])
    pressure = size * np.arange(1.0, orders + 2) * np.array([[[1.0]], [[1.0j]]])
    return ReceivedSound(Lines(names, frequency, {}, {}), pressure, ())


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
    assert remaining_share(HOODED) == pytest.approx([1.0, 0.5 * (0.01 + 1.0)])


def sound(square):
    """The machine at the published speed, with a mean square in Pa²."""
    values = np.full((3, 1, 1), square)
    return {(3000.0, "none"): SourceSound(values[0], values[0], values)}


def test_remainder_fills_up_to_the_published_level():
    published = 4e-10 * 10.0**9.4
    assert remainder(STUDY, AXES, sound(0.25), False) == pytest.approx(published - 0.25)
    assert remainder(STUDY, AXES, sound(2.0), True) == 0.0
    with pytest.raises(ParameterError, match=r"= 94 dB\(A\): the model alone gives 97.0 dB\(A\)"):
        remainder(STUDY, AXES, sound(2.0), False)


def test_three_draws_below_the_published_level_are_needed():
    quiet, loud = [sound(0.25)] * 3, [sound(2.0)]
    assert np.count_nonzero(remainder_by_draw(STUDY, AXES, [*quiet, *loud])) == 3
    with pytest.raises(SolverError, match="only 2 of 3 draws"):
        remainder_by_draw(STUDY, AXES, [*quiet[1:], *loud])
