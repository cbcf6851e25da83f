"""Weights from files of runs: conventions, trial weights, holes, masses, remarks, grade."""

import re
from itertools import product

import numpy as np
import pytest
from balancing_cases import BRUEL_KJAER, DEPENDENT, FEESE
from trial_run_files import Convention, file_text, of_printed, written

import vibroacoustics as va
from vibroacoustics.design.bench.balanced_runs import other_reading
from vibroacoustics.design.bench.grade import grade_mm_per_s, grade_name, grade_of
from vibroacoustics.design.bench.remarks import remarks

SEED = 1935
PER_GRAM = 1e-3 * 0.1
"""Moment of a gram at the radius of the files, kg m."""
EVERY = [
    Convention(*each)
    for each in product(
        ("peak", "peak to peak", "rms"),
        ("lag", "lead"),
        ("with rotation", "against rotation", "clockwise", "counterclockwise"),
        ("clockwise", "counterclockwise"),
    )
]


def linear_runs(rng, weights, scatter=0.0, sensors=3):
    """Runs of a random machine, and its readings and influence without scatter."""
    planes = len(weights[0])
    normal = rng.standard_normal((2, sensors, 1 + planes))
    truth = normal[0] + 1j * normal[1]
    runs = {}
    for number, weight in enumerate(np.array(weights, dtype=complex)):
        noise = scatter * (rng.standard_normal((2, sensors)))
        readings = truth[:, 0] + truth[:, 1:] @ weight + noise[0] + 1j * noise[1]
        runs[f"run_{number}"] = weight, readings
    return runs, truth


@pytest.mark.parametrize("zero_deg", [0.0, 25.0])
@pytest.mark.parametrize("convention", EVERY, ids=" ".join)
def test_every_convention_gives_the_weights(convention, zero_deg, tmp_path):
    """Readings of the file and of the closed form agree to 12 digits."""
    rng = np.random.default_rng(SEED)
    runs, truth = linear_runs(rng, [[0, 0], [2.0, 0], [0, 1.5j]])
    path = written(tmp_path, file_text(runs, convention, zero_deg=zero_deg))
    balanced = va.balance_runs(path)
    expected = np.linalg.lstsq(truth[:, 1:], -truth[:, 0], rcond=None)[0]
    np.testing.assert_allclose(balanced.moment_kg_m / PER_GRAM, expected, rtol=1e-8)
    factor = {"peak": 1.0, "peak to peak": 2.0, "rms": np.sqrt(0.5)}[convention.amplitudes]
    np.testing.assert_allclose(balanced.before, factor * truth[:, 0], rtol=1e-8)
    for weight, moment in zip(balanced.weights, expected, strict=True):
        shown = np.rad2deg(weight.angle_rad) + zero_deg
        assert 1e3 * weight.mass_kg == pytest.approx(abs(moment), rel=1e-8)
        turned = np.exp(1j * convention.sense * np.deg2rad(shown))
        assert turned == pytest.approx(moment / abs(moment), rel=1e-8)


def test_removed_trial_weights(tmp_path):
    balanced = va.balance_runs(
        written(tmp_path, file_text(of_printed(BRUEL_KJAER), Convention(phases="lead",
                angles="with rotation")))
    )  # fmt: skip
    difference = np.abs(balanced.moment_kg_m / PER_GRAM - BRUEL_KJAER.printed)
    assert np.all(difference < 0.04 * np.abs(BRUEL_KJAER.printed))


def test_trial_weights_left_in_and_the_other_reading(tmp_path):
    """The answer is what to add; with what is in it is the printed one."""
    text = file_text(of_printed(FEESE), Convention(), trial_weights="left in")
    balanced = va.balance_runs(written(tmp_path, text))
    total = (balanced.moment_kg_m + balanced.runs.installed) / PER_GRAM
    assert np.all(np.abs(total - FEESE.printed) < 0.04 * np.abs(FEESE.printed))
    np.testing.assert_allclose(balanced.before, FEESE.readings[2])
    other = other_reading(balanced)
    wrong = np.abs(balanced.problem.residual(other - balanced.runs.installed))
    first = np.abs(FEESE.readings[0])
    assert np.linalg.norm(wrong) > 1.1 * np.linalg.norm(first)
    removed = va.balance_runs(written(tmp_path, text.replace('"left in"', '"removed"')))
    np.testing.assert_allclose(other, removed.moment_kg_m, rtol=1e-9)


def test_weights_of_a_run_stay_where_it_says_so(tmp_path):
    """A correction that stays: the next answer is what is missing to the same total."""
    rng = np.random.default_rng(SEED)
    runs, truth = linear_runs(rng, [[0, 0], [2.0, 0], [0, 1.5j], [1.0, -0.5]])
    text = file_text(runs) + "\n[runs.last]\nreadings.1500 = { sensor_1 = \"9@9\" }\n"  # fmt: skip
    text = text.replace("[runs.run_3]", "[runs.run_3]\nweights_stay = true")
    text = text[: text.index("[runs.last]")]
    balanced = va.balance_runs(written(tmp_path, text))
    expected = np.linalg.lstsq(truth[:, 1:], -truth[:, 0], rcond=None)[0]
    total = (balanced.moment_kg_m + balanced.runs.installed) / PER_GRAM
    np.testing.assert_allclose(total, expected, rtol=1e-8)
    np.testing.assert_allclose(balanced.runs.installed / PER_GRAM, [1.0, -0.5], atol=1e-12)


def test_a_check_run_improves_the_answer(tmp_path):
    """Residual of the truth, in the mean of 20 machines."""
    rng = np.random.default_rng(SEED)
    left = []
    for _ in range(20):
        runs, truth = linear_runs(rng, [[0, 0], [2.0, 0], [0, 1.5j]], scatter=0.2)
        first = va.balance_runs(written(tmp_path, file_text(runs)))
        weight = first.moment_kg_m / PER_GRAM
        noise = 0.2 * (rng.standard_normal(3) + 1j * rng.standard_normal(3))
        runs["check"] = weight, truth @ np.append(1.0, weight) + noise
        second = va.balance_runs(written(tmp_path, file_text(runs)))
        best = np.linalg.lstsq(truth[:, 1:], -truth[:, 0], rcond=None)[0]
        floor = np.linalg.norm(truth @ np.append(1.0, best))
        sizes = (
            np.linalg.norm(truth @ np.append(1.0, each.moment_kg_m / PER_GRAM)) - floor
            for each in (first, second)
        )
        left.append(tuple(sizes))
    before, after = np.mean(left, axis=0)
    assert after < 0.8 * before


def test_pieces_in_holes_are_the_moment_and_masses_are_those_available(tmp_path):
    rng = np.random.default_rng(SEED)
    runs, truth = linear_runs(rng, [[0, 0], [2.0, 0], [0, 1.5j]])
    free = va.balance_runs(written(tmp_path, file_text(runs)))
    split = va.balance_runs(written(tmp_path, file_text(runs, plane_lines="holes = 8")))
    np.testing.assert_allclose(split.moment_kg_m, free.moment_kg_m, rtol=1e-9)
    assert {weight.hole for weight in split.weights} <= set(range(1, 9))
    assert len(split.weights) == 4
    for weight in split.weights:
        assert np.rad2deg(weight.angle_rad) == pytest.approx(45.0 * (weight.hole - 1), abs=1e-6)
    lines = "holes = 8\nmasses_g = [0.25, 0.5, 1.0]"
    chosen = va.balance_runs(written(tmp_path, file_text(runs, plane_lines=lines)))
    masses = {round(1e3 * weight.mass_kg, 9) for weight in chosen.weights}
    assert masses <= {0.25, 0.5, 1.0}
    assert np.linalg.norm(chosen.after) > np.linalg.norm(free.after)
    assert np.linalg.norm(chosen.after) < np.linalg.norm(chosen.before)
    limited = file_text(runs, plane_lines=f"maximum_mass_g = {0.5 * np.abs(truth[0, 0]):.9f}")
    balanced = va.balance_runs(written(tmp_path, limited))
    assert max(1e3 * each.mass_kg for each in balanced.weights) <= 0.5 * np.abs(truth[0, 0]) + 1e-6


def test_remarks_of_good_runs_are_none(tmp_path):
    rng = np.random.default_rng(SEED)
    runs, _ = linear_runs(rng, [[0, 0], [0, 0], [2.0, 0], [0, 1.5j]], scatter=0.01)
    assert remarks(va.balance_runs(written(tmp_path, file_text(runs)))) == []


def _changed(change):
    rng = np.random.default_rng(SEED)
    runs, truth = linear_runs(rng, [[0, 0], [0, 0], [2.0, 0], [0, 1.5j]], scatter=0.01)
    return file_text(change(runs, truth))


def _weak(runs, truth):
    weight = np.array([0.02, 0.0])
    return runs | {"run_2": (weight, truth @ np.append(1.0, weight))}


def _wrapped(runs, truth):
    return runs | {"run_1": (runs["run_1"][0], -runs["run_1"][1])}


def _nonlinear(runs, truth):
    weight = np.array([4.0, 0.0])
    return runs | {"larger": (weight, truth[:, 0] + 1.5 * truth[:, 1:] @ weight)}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (_weak, "run run_2: the trial weight in plane plane_1 is weak"),
        (_wrapped, "have the same weights and phases 17"),
        (_nonlinear, "plane plane_1: the weights of runs"),
    ],
)
def test_each_doubt_is_named(change, words, tmp_path):
    doubts = remarks(va.balance_runs(written(tmp_path, _changed(change))))
    assert [line for line in doubts if words in line], doubts


def test_speeds_that_differ_are_named_and_corrected(tmp_path):
    rng = np.random.default_rng(SEED)
    runs, _ = linear_runs(rng, [[0, 0], [0, 0], [2.0, 0], [0, 1.5j]])
    text = file_text(runs)
    start = text.index("[runs.run_2]")
    text = text[:start] + text[start:].replace("readings.1500", "readings.1530", 1)
    balanced = va.balance_runs(written(tmp_path, text))
    (line,) = [line for line in remarks(balanced) if "rpm" in line]
    assert line.startswith("run run_2: 1530 rpm, the first run 1500 rpm")
    assert len(balanced.runs.sensors) == 3
    expected = runs["run_2"][1] * (1500.0 / 1530.0) ** 2  # a velocity
    np.testing.assert_allclose(balanced.runs.readings[2], expected, rtol=1e-9)


def test_two_speeds_and_a_resonance_between_them(tmp_path):
    rng = np.random.default_rng(SEED)
    runs, truth = linear_runs(rng, [[0, 0], [2.0, 0], [0, 1.5j]])
    second = {name: (weight, -1.1 * readings) for name, (weight, readings) in runs.items()}
    text, other = file_text(runs), file_text(second, speed=3000)
    for name in runs:
        line = next(
            each
            for each in other[other.index(f"[runs.{name}]") :].splitlines()
            if each.startswith("readings")
        )
        text = text.replace(f"[runs.{name}]", f"[runs.{name}]\n{line}")
    text += "[rotor]\nmass_kg = 10.0\nservice_speed_rpm = 3600\n"
    balanced = va.balance_runs(written(tmp_path, text))
    assert balanced.runs.speeds_rpm.tolist() == 3 * [1500.0] + 3 * [3000.0]
    lines = remarks(balanced)
    assert sum("its phase turns by 180° from 1500 to 3000 rpm" in line for line in lines) == 3
    assert sum("no reading at the service speed, 3600 rpm" in line for line in lines) == 1
    grade = grade_of(balanced)
    expected = np.linalg.lstsq(truth[:, 1:], -truth[:, 0], rcond=None)[0]
    moment = PER_GRAM * np.abs(expected).sum()
    assert grade.before == pytest.approx(1e3 * moment / 10.0 * 2.0 * np.pi * 60.0, rel=1e-6)
    assert grade.after < 1e-6 * grade.before


def test_grade_of_the_standard():
    """ISO 21940-11, annex A: 40 kg, 3000 rpm, G 6.3 permits 802 g mm."""
    permitted = 6.3e-3 / (np.pi * 100.0) * 40.0
    assert permitted == pytest.approx(802e-6, rel=1e-3)
    assert grade_mm_per_s(np.array(permitted), 40.0, 3000.0) == pytest.approx(6.3)
    assert [grade_name(each) for each in (0.4, 6.2, 6.4, 5000.0)] == [
        "G 0.4", "G 6.3", "G 16", "no grade",
    ]  # fmt: skip


def test_dependent_planes_have_a_sound_answer_and_a_remark(tmp_path):
    influence, response = DEPENDENT.influence, DEPENDENT.response
    weights = np.vstack([np.zeros(3), np.eye(3)]).astype(complex)
    runs = {
        f"run_{number}": (weight, response + influence @ weight)
        for number, weight in enumerate(weights)
    }
    text = file_text(runs, Convention(phases="lead", angles="with rotation"))
    balanced = va.balance_runs(written(tmp_path, text))
    assert balanced.chosen == "independent planes"
    assert np.abs(balanced.moment_kg_m).max() < 0.3 * np.abs(
        balanced.answers["least squares"]
    ).max()  # fmt: skip
    assert "planes plane_2 and plane_3 act alike" in remarks(balanced)[0]
    assert "condition number 25.7" in remarks(balanced)[0]


def test_microphone_and_vibration_side_by_side(tmp_path):
    rng = np.random.default_rng(SEED)
    runs, truth = linear_runs(rng, [[0, 0], [2.0, 0], [0, 1.5j]], sensors=4)
    sensors = ("end", "side", "front", "back")
    text = file_text(runs, sensors=sensors)
    for name in ("front", "back"):
        text = text.replace(f'[sensors.{name}]\nunit = "mm/s"', f'[sensors.{name}]\nunit = "Pa"')
    balanced = va.balance_runs(written(tmp_path, text))
    for answer, rows in (("for vibration", slice(0, 2)), ("for microphones", slice(2, 4))):
        moment = balanced.answers[answer] / PER_GRAM
        left = truth[rows] @ np.append(1.0, moment)
        assert np.abs(left).max() < 1e-8


def test_bands_hold_the_readings_that_remain(tmp_path):
    """100 machines: 80 % bands hold 75 to 85 %; 600 readings have a standard error of 2 %."""
    rng = np.random.default_rng(SEED)
    weights = [[0, 0], [0, 0], [0, 0], [2.0, 0], [2.0, 0], [0, 1.5j], [0, 1.5j]]
    held = []
    for _ in range(100):
        runs, truth = linear_runs(rng, weights, scatter=0.05, sensors=6)
        balanced = va.balance_runs(written(tmp_path, file_text(runs)))
        left = np.abs(truth @ np.append(1.0, balanced.moment_kg_m / PER_GRAM))
        low, _, high = balanced.after_band
        held.append((low <= left) & (left <= high))
    assert 0.75 <= np.mean(held) <= 0.85, np.mean(held)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"9.1@', '"9,1@', "must be an amplitude from 0 to 1e12 at an angle in degrees"),
        ('"9.1@', '"9.1', "must be an amplitude from 0 to 1e12 at an angle in degrees"),
        ('sensor_1 = "', 'sensor_1 = "-', "must be an amplitude from 0"),
        ('sensor_1 = "', 'sensor_9 = "', "no such sensor; known are sensor_1"),
        ("@0", " µm@0", "is in µm, the sensor in mm/s: must be in mm/s"),
        ("@0", " mm/s rms@0", "is rms, the amplitudes of the file are peak: must be peak"),
        ('phases = "lead"', 'phases = "behind"', "phases = 'behind': must be 'lag' or 'lead'"),
        ("radius_mm = 100.0", "radius_mm = -1", "planes.plane_1.radius_mm = -1 mm: out of range"),
        ("weights.plane_1", "weights.plane_7", "no plane plane_7; known are plane_1, plane_2"),
        ("angle_deg = 0", "angle_deg = 0, hole = 1", "give one of angle_deg and hole"),
        ("angle_deg = 0", "hole = 3", "hole = 3: must be 1 to 0"),
        ('unit = "mm/s"', 'unit = "furlong"', "unit = furlong: must be one of Pa"),
        ("readings.1500", "readings.fast", "readings.fast: must be a speed of 1 to 1000000 rpm"),
        ("[runs.run_2]", "[runs.run_2.x]", "runs.run_2"),
        ("sensor_1", "sensor_mm", "sensors.sensor_mm: ends in the unit mm: choose another name"),
    ],
)
def test_bad_files_are_refused_in_one_line(old, new, words, tmp_path):
    runs = {
        f"run_{number}": (np.array(weight, dtype=complex), np.array([9.1 + 0j, 2.0 + number]))
        for number, weight in enumerate([[0, 0], [2.0, 0], [0, 1.5]])
    }
    text = file_text(runs, Convention(phases="lead", angles="with rotation"))
    assert old in text
    changed = text.replace(old, new) if old == "sensor_1" else text.replace(old, new, 1)
    path = written(tmp_path, changed)
    with pytest.raises(va.ParameterError) as caught:
        va.balance_runs(path)
    first = str(caught.value.args[0])
    assert first.startswith(f"{path}: ")
    assert any(words in str(line) for line in caught.value.args), caught.value.args


@pytest.mark.parametrize(
    "readings",
    [
        ([0, 0], [0, 0], [0, 0]), ([0, 0], [1, 2], [2, 1]), ([0, 1], [1, 2j], [2, 1]),
        ([1, 2], [1, 2], [1, 3]), ([1, 2], [2, 3], [2, 3]), ([1, 2], [1, 2], [1, 2]),
    ],
)  # fmt: skip
def test_readings_of_zero_and_weights_without_effect_give_no_large_masses(readings, tmp_path):
    runs = {
        f"run_{number}": (np.array(weight, dtype=complex), np.array(values, dtype=complex))
        for number, (weight, values) in enumerate(
            zip([[0, 0], [1, 0], [0, 1]], readings, strict=True)
        )
    }
    runs["again"] = runs["run_0"]
    balanced = va.balance_runs(written(tmp_path, file_text(runs)))
    assert np.all(np.abs(balanced.moment_kg_m) < 5.0 * PER_GRAM)
    idle = ~np.abs(balanced.problem.influence).any(axis=0)
    words = [f"plane plane_{number}: its weights change no reading" for number in (1, 2)]
    said = " ".join(remarks(balanced))
    assert [each in said for each in words] == idle.tolist()
    assert "act alike" not in said or not idle.any()


def test_runs_that_do_not_determine_the_planes_are_refused(tmp_path):
    runs = {
        "first": (np.zeros(2, dtype=complex), np.array([1.0 + 0j, 2.0])),
        "second": (np.array([1.0 + 0j, 1.0]), np.array([1.5 + 0j, 2.0])),
    }
    with pytest.raises(va.ParameterError, match="runs: do not determine 2 planes: add a run"):
        va.balance_runs(written(tmp_path, file_text(runs)))


def test_a_limit_does_not_improve_the_grade(tmp_path):
    """One plane whose weight may be 1 g of 4: the grade counts what cannot be placed."""
    rng = np.random.default_rng(SEED)
    runs, _ = linear_runs(rng, [[0], [2.0]], sensors=2)
    runs["run_0"] = runs["run_0"][0], 4.0 * runs["run_0"][1]
    rotor = "\n[rotor]\nmass_kg = 20\nservice_speed_rpm = 1500\n"
    grades, wanted = [], None
    for lines in ("", "maximum_mass_g = 1"):
        balanced = va.balance_runs(written(tmp_path, file_text(runs, plane_lines=lines) + rotor))
        grades.append(grade_of(balanced))
        wanted = balanced if wanted is None else wanted
    free, limited = grades
    assert limited.before == pytest.approx(free.before, rel=1e-9)
    unplaced = np.abs(wanted.moment_kg_m[0]) - PER_GRAM
    expected = grade_mm_per_s(np.array(unplaced), 20.0, 1500.0)
    assert limited.after == pytest.approx(float(expected), rel=1e-6)


def test_the_other_reading_is_corrected_for_the_speed_once(tmp_path):
    rng = np.random.default_rng(SEED)
    runs, _ = linear_runs(rng, [[0, 0], [2.0, 0], [0, 1.5j]])
    text = file_text(runs).replace("readings.1500", "readings.1530", 2)
    text = text.replace("readings.1530", "readings.1500", 1)
    balanced = va.balance_runs(written(tmp_path, text))
    left_in = text.replace('trial_weights = "removed"', 'trial_weights = "left in"')
    assert left_in != text
    expected = va.balance_runs(written(tmp_path, left_in)).answers["least squares"]
    np.testing.assert_allclose(other_reading(balanced), expected, rtol=1e-9)


def test_a_run_without_a_reading_widens_no_band(tmp_path):
    """The scatter that is stated is that of every reading that is there."""
    rng = np.random.default_rng(SEED)
    runs, _ = linear_runs(rng, [[0, 0], [2.0, 0], [0, 1.5j], [1.0, 1.0]])
    text = file_text(runs).replace('unit = "mm/s"', 'unit = "mm/s"\nscatter = 0.05')
    head, mark, last = text.partition("[runs.run_3]")
    fewer = re.sub(r'sensor_1 = "[^"]*", ', "", last)
    assert fewer != last
    high = [
        va.balance_runs(written(tmp_path, head + mark + part)).expected_band[2, 0]
        for part in (last, fewer)
    ]
    assert high[1] < 1.3 * high[0]


def test_no_piece_is_above_the_largest_mass(tmp_path):
    """Two of three holes make a moment between them by a mass 15 % above its own at most."""
    rng = np.random.default_rng(SEED)
    most, masses, words = 0.25, [], ""
    lines = f"holes = 3\nmaximum_mass_g = {most}"
    for _ in range(6):
        runs, _ = linear_runs(rng, [[0, 0], [2.0, 0], [0, 1.5j]])
        balanced = va.balance_runs(written(tmp_path, file_text(runs, plane_lines=lines)))
        masses += [1e3 * weight.mass_kg for weight in balanced.weights]
        words += " ".join(remarks(balanced))
    assert max(masses) == pytest.approx(most, rel=1e-9)
    assert "its holes and masses make 0.2" in words


def test_masses_above_the_largest_are_refused(tmp_path):
    rng = np.random.default_rng(SEED)
    runs, _ = linear_runs(rng, [[0, 0], [2.0, 0], [0, 1.5j]])
    lines = "holes = 3\nmasses_g = [50]\nmaximum_mass_g = 20"
    with pytest.raises(va.ParameterError, match="masses_g: one must be at most maximum_mass_g"):
        va.balance_runs(written(tmp_path, file_text(runs, plane_lines=lines)))


def test_a_limit_between_median_and_end_of_the_band_is_named(tmp_path):
    rng = np.random.default_rng(SEED)
    weights = [[0, 0], [0, 0], [2.0, 0], [0, 1.5j]]
    runs, _ = linear_runs(rng, weights, scatter=0.05)
    balanced = va.balance_runs(written(tmp_path, file_text(runs)))
    limit = 0.5 * (balanced.after_band[1, 0] + balanced.after_band[2, 0])
    text = file_text(runs).replace('unit = "mm/s"', f'unit = "mm/s"\nlimit = {limit}', 1)
    words = remarks(va.balance_runs(written(tmp_path, text)))
    assert any("may remain, above its limit" in each for each in words), words
