"""Changes by options: forces in dB, the total, and a line that counts only where it is heard."""

import numpy as np
import pytest

from vibroacoustics.base.rounding import FORCE_FLOOR
from vibroacoustics.base.vocabulary import WEIGHTINGS, stamp
from vibroacoustics.base.weighting import a_weighting
from vibroacoustics.levels.changes import JUDGED, MASKED_DB, change_db, change_variables, changes_of
from vibroacoustics.levels.hearing import hearing_threshold_db
from vibroacoustics.study.scoring import Measurable

HERTZ = 50.0
THRESHOLD_DB = hearing_threshold_db(HERTZ)
LINE = JUDGED.index("level_1x")
TOTAL = JUDGED.index("level_total")


def judged(line_db, total_db=(0.0, 0.0), forces=(1.0, 1.0), hertz=HERTZ, least=None):
    """Increase and decrease of every quantity by the second of two options, one sample."""
    changes = changes_of(
        np.broadcast_to(np.reshape(forces, (1, 1, 1, 2)), (3, 1, 1, 2)),
        np.reshape(total_db, (1, 1, 2, 1)),
        np.reshape(line_db, (1, 1, 2, 1)),
        np.array([hertz]),
        0,
        least or Measurable(),
    )
    assert not changes.increased[:, :, :, 0].any()
    assert not changes.decreased[:, :, :, 0].any()
    return changes.increased[0, :, 0, 1, 0], changes.decreased[0, :, 0, 1, 0]


def of_line(line_db, total_db=(0.0, 0.0), **more):
    increased, decreased = judged(line_db, total_db, **more)
    return increased[LINE] - decreased[LINE]


def test_change_of_a_force_is_in_db_against_the_reference():
    force = np.array([[2.0, 4.0, 1.0], [10.0, 10.0, 5.0]])
    expected = 20.0 * np.log10([[1.0, 2.0, 0.5], [1.0, 1.0, 0.5]])
    np.testing.assert_allclose(change_db(force, 0), expected, atol=1e-12)
    np.testing.assert_allclose(change_db(force, 1), expected - expected[:, [1]], atol=1e-12)


def test_forces_below_the_floor_count_as_the_floor():
    """Rounding noise neither appears nor vanishes."""
    noise = np.array([1e-20, 0.3 * FORCE_FLOOR, 0.0])
    np.testing.assert_array_equal(change_db(noise, 0), 0.0)
    vanished = change_db(np.array([1.0, 0.0]), 0)
    np.testing.assert_allclose(vanished, [0.0, 20.0 * np.log10(FORCE_FLOOR)])


@pytest.mark.parametrize(
    ("ratio", "expected"), [(1.051, 1.0), (1.049, 0.0), (0.951, 0.0), (0.949, -1.0)]
)
def test_forces_count_from_five_per_cent_on(ratio, expected):
    increased, decreased = judged((0.0, 0.0), forces=(10.0, 10.0 * ratio))
    np.testing.assert_array_equal((increased - decreased)[:3], expected)


@pytest.mark.parametrize(
    ("change", "expected"), [(0.51, 1.0), (0.49, 0.0), (-0.49, 0.0), (-0.51, -1.0)]
)
def test_the_total_counts_from_half_a_decibel_on(change, expected):
    increased, decreased = judged((0.0, 0.0), (50.0, 50.0 + change))
    assert increased[TOTAL] - decreased[TOTAL] == expected
    increased, decreased = judged((0.0, 0.0), (50.0, 50.0 + change), least=Measurable(level_db=1.0))
    assert increased[TOTAL] == decreased[TOTAL] == 0.0


def test_an_inaudible_line_never_counts():
    below = THRESHOLD_DB - 0.1
    assert of_line((below - 30.0, below)) == 0.0
    assert of_line((below, below - 30.0)) == 0.0


def test_a_line_rises_where_it_is_heard_afterwards_and_falls_where_it_was_before():
    low, high = THRESHOLD_DB - 5.0, THRESHOLD_DB + 5.0
    assert of_line((low, high)) == 1.0
    assert of_line((high, low)) == -1.0
    assert of_line((high, high + 0.4)) == 0.0
    assert of_line((high + 0.6, high)) == -1.0


@pytest.mark.parametrize(("side_db", "counts"), [(-0.1, True), (0.1, False)])
def test_a_line_15_db_below_the_total_is_masked(side_db, counts):
    line_db = 70.0
    total_dba = line_db + float(a_weighting(np.array(HERTZ))) + MASKED_DB + side_db
    assert MASKED_DB == 15.0
    assert of_line((line_db - 6.0, line_db), (total_dba, total_dba)) == (1.0 if counts else 0.0)
    assert of_line((line_db, line_db - 6.0), (total_dba, total_dba)) == (-1.0 if counts else 0.0)


def test_the_total_of_each_option_masks_its_own_line():
    """A line that only a louder machine hides falls; one that a quieter machine uncovers rises."""
    line_db = 70.0
    hidden = line_db + float(a_weighting(np.array(HERTZ))) + MASKED_DB + 1.0
    assert of_line((line_db - 6.0, line_db), (hidden, 0.0)) == 1.0
    assert of_line((line_db - 6.0, line_db), (0.0, hidden)) == 0.0
    assert of_line((line_db, line_db - 6.0), (0.0, hidden)) == -1.0
    assert of_line((line_db, line_db - 6.0), (hidden, 0.0)) == 0.0


def test_the_quietest_line_and_lines_below_20_hz_have_a_limit():
    assert hearing_threshold_db(1000.0) < 0.0
    quiet = Measurable(quietest_line_db=5.0)
    assert of_line((-6.0, 5.4), (-20.0, -20.0), hertz=1000.0, least=quiet) == 0.0
    assert of_line((-6.0, 5.6), (-20.0, -20.0), hertz=1000.0, least=quiet) == 1.0
    lowest = hearing_threshold_db(20.0)
    assert of_line((0.0, lowest + 1.0), (-60.0, -60.0), hertz=10.0) == 1.0
    assert of_line((0.0, lowest - 1.0), (-60.0, -60.0), hertz=10.0) == 0.0


def test_each_speed_option_and_receiver_is_judged_by_itself():
    rng = np.random.default_rng(1)
    shape = (4, 2, 3, 2)
    forces = rng.uniform(0.9, 1.1, (3, *shape[:3]))
    total, line = rng.normal(50.0, 1.0, shape), rng.normal(60.0, 20.0, shape)
    hertz = np.array([40.0, 120.0])
    changes = changes_of(forces, total, line, hertz, 1, Measurable())
    for n in np.ndindex(shape):
        sample, speed, option, receiver = n
        base = (sample, speed, 1, receiver)
        at = float(a_weighting(hertz[speed]))

        def audible(place, at=at, speed=speed):
            return line[place] >= hearing_threshold_db(hertz[speed]) and (
                line[place] + at >= total[place] - 15.0
            )

        ratio = forces[:, sample, speed, option] / forces[:, sample, speed, 1]
        of_total, of_line = total[n] - total[base], max(line[n], 0.0) - max(line[base], 0.0)
        up = [*(ratio > 1.05), of_total > 0.5, of_line > 0.5 and audible(n)]
        down = [*(ratio < 0.95), of_total < -0.5, of_line < -0.5 and audible(base)]
        assert changes.increased[sample, :, speed, option, receiver].tolist() == up
        assert changes.decreased[sample, :, speed, option, receiver].tolist() == down


def test_nominal_changes_are_labelled():
    place = {"speed": [3000.0], "option": ["louder", "none"], "receiver": ["front"]}
    orders = {"order": [0, 1]}
    order_level = np.zeros((1, 2, 1, 2, 3))
    order_level[0, :, 0, 1, WEIGHTINGS.index("Z")] = [80.0, 70.0]
    levels = stamp("level_total", [[[53.0], [50.0]]], place).to_dataset()
    levels["order_level"] = stamp(
        "order_level", order_level, {**place, **orders, "weighting": list(WEIGHTINGS)}
    )
    at = {"speed": place["speed"], "option": place["option"], **orders}
    forces = levels.assign_coords(order_frequency=(("speed", "order"), [[0.0, 50.0]]))
    for name, factor in (("force_amplitude", 2.0), ("moment_amplitude", 1.0),
                         ("largest_foot_force", 0.5)):  # fmt: skip
        forces[name] = stamp(name, [[[0.0, factor * 3.0], [0.0, 3.0]]], at)
    found = change_variables(Measurable(), levels, forces)
    assert found["force_change_1x"].sel(option="louder").item() == pytest.approx(6.0206, abs=1e-4)
    assert found["foot_force_change_1x"].sel(option="louder").item() == pytest.approx(
        -6.0206, abs=1e-4
    )
    assert not found["moment_change_1x"].values.any()
    up, down = (
        found[f"{name}_probability"].sel(option="louder").squeeze()
        for name in ("increase", "decrease")
    )
    assert up["judged_quantity"].values.tolist() == list(JUDGED)
    assert up.values.tolist() == [1.0, 0.0, 0.0, 1.0, 1.0]
    assert down.values.tolist() == [0.0, 0.0, 1.0, 0.0, 0.0]
