"""Blocked forces of a bench whose source is known, and what validates them."""

import numpy as np
import pytest
import xarray as xr
from in_situ_bench import (
    ABOVE,
    BELOW,
    CORNERS,
    FREQUENCY,
    SPEED_RPM,
    below_the_mounts,
    source,
    write,
)
from support import ROOT, made_up_radiation
from typer.testing import CliRunner

import vibroacoustics as va
from vibroacoustics.commands import cli
from vibroacoustics.measured.blocked_variables import validation_variables
from vibroacoustics.measured.inversion import (
    condition_number,
    left_out_responses,
    rigid_forces,
    rigid_wrench,
)


def error_db(value, truth):
    return np.abs(20.0 * np.log10(np.abs(value) / np.abs(truth)))


def wrench(blocked):
    """Force along z, moments about x and y, shape (frequency, 3)."""
    along, about = blocked["blocked_force_sum"].values, blocked["blocked_moment_sum"].values
    return np.array([along[2], about[0], about[1]]).T


def test_below_the_mounts_they_are_the_forces_on_a_panel_that_does_not_move(tmp_path):
    blocked = va.blocked_forces(write(tmp_path, BELOW))
    force = blocked["blocked_force"].values.T
    assert np.max(np.abs(force - below_the_mounts())) < 1e-8 * np.max(np.abs(force))
    assert np.abs(blocked["validation_difference"]).max() < 1e-8
    assert np.abs(blocked["validation_band_difference"]).max() < 1e-8
    assert blocked["inversion_truncation"] == 0.0
    assert blocked["left_out_error"][0] < 1e-8


@pytest.mark.parametrize("unit", ["m/s", "m"])
def test_mobilities_and_receptances_give_the_same(tmp_path, unit):
    force = va.blocked_forces(write(tmp_path, BELOW, unit=unit))["blocked_force"].values.T
    assert np.max(np.abs(force - below_the_mounts())) < 1e-8 * np.max(np.abs(force))


def test_above_the_mounts_they_are_force_and_moment_of_the_source(tmp_path):
    blocked = va.blocked_forces(write(tmp_path, ABOVE))
    np.testing.assert_allclose(wrench(blocked), source(), rtol=1e-8)
    assert np.abs(blocked["validation_difference"]).max() < 1e-8
    assert blocked["condition_number"].max() < 1e4


def test_four_forces_on_a_rigid_machine_are_one_of_many_with_its_force_and_moment(tmp_path):
    """Without `rigid_source` the fourth direction is nothing but rounding, and is left out."""
    text = ABOVE.replace("rigid_source = true", "")
    blocked = va.blocked_forces(write(tmp_path, text))
    np.testing.assert_allclose(wrench(blocked), source(), rtol=1e-6)
    assert blocked["condition_number"].min() > 1e9


def test_band_of_a_prediction_is_that_of_measurements_drawn_again():
    """Far above noise of constant size |e| it is normal: |p| ± 1.645 |e| / √(2 ln 2)."""
    frequency, size = np.array([100.0, 125.0]), 1e-5
    predicted = np.array([[1e-9 + 2e-9j, 3e-3], [2e-9, 1e-3j]])
    turns = np.exp(2j * np.pi * np.arange(8) / 8.0)[:, None, None]
    coords = {"validation_point": ["a", "b"], "frequency": frequency}
    found = validation_variables(
        predicted, predicted, predicted * (1.0 + size * turns), np.stack([predicted] * 8),
        ["m", "Pa"], coords,
    )  # fmt: skip
    half = 1.645 * size / np.sqrt(2.0 * np.log(2.0))
    level = found["validation_predicted"].values
    for name, sign in (("low", -1.0), ("high", 1.0)):
        off_db = found[f"validation_predicted_{name}"].values - level
        np.testing.assert_allclose(off_db, 20.0 * np.log10(1.0 + sign * half), rtol=1e-3)
        off_db = found[f"validation_band_difference_{name}"].values
        assert np.abs(off_db).max() < 20.0 * np.log10(1.0 + 2.0 * size)


def test_with_three_percent_noise(tmp_path):
    """Above the mounts, where three unknowns are, and below them."""
    above = [va.blocked_forces(write(tmp_path, ABOVE, 0.03, number)) for number in range(3)]
    errors = np.array([error_db(wrench(one), source()) for one in above])
    assert np.median(errors) < 0.4
    assert np.quantile(errors, 0.9) < 2.0
    bands = np.abs(xr.concat([one["validation_band_difference"] for one in above], "run"))
    assert bands.mean() < 0.5
    below = va.blocked_forces(write(tmp_path, BELOW, 0.03))
    assert np.abs(below["validation_band_difference"]).mean() < 1.0


@pytest.mark.long
@pytest.mark.parametrize("share", [0.01, 0.03, 0.1])
def test_bands_hold_the_forces(tmp_path, share):
    held = []
    for number in range(20):
        blocked = va.blocked_forces(write(tmp_path, BELOW, share, number))
        if blocked["inversion_truncation"] == 0.0:  # what is left out is in no band
            truth = np.abs(below_the_mounts().T)
            low, high = blocked["blocked_force_low"], blocked["blocked_force_high"]
            held.append((low <= truth) & (truth <= high))
    assert np.size(held) >= 400
    assert 0.84 < np.mean(held) < 0.94


@pytest.mark.filterwarnings("ignore:.*usual is")
def test_the_machine_by_table_runs_with_them(tmp_path):
    outcome = CliRunner().invoke(
        cli.app, ["blocked-forces", str(write(tmp_path, ABOVE)), "--out", str(tmp_path)]
    )
    assert outcome.exit_code == 0, outcome.output
    assert "n13" in outcome.output
    from vibroacoustics.mechanisms.tabulated.csv_layout import read_csv

    spectra = read_csv(tmp_path / "orders.csv")
    assert spectra.speed_rpm == (SPEED_RPM,)
    orders = spectra.orders[0, 0, :, 1:]
    np.testing.assert_allclose(orders[[2, 3, 4]].T, source(), rtol=1e-8)
    study = va.load_study(ROOT / "pipelines" / "reciprocating_table.toml").replace(
        {
            "machine.override.forces.file": {
                "value": str(tmp_path / "orders.csv"),
                "source": "bench",
            },
            "machine.override.overall_noise.speed_rpm": {"value": SPEED_RPM, "source": "bench"},
            "operation": {"speed_rpm": [SPEED_RPM], "maximum_order": 4},
        }
    )
    results = va.run(study, radiation=made_up_radiation)
    force = results["force_order"].sel(option="none", speed=SPEED_RPM, axis="z").sum("source")
    np.testing.assert_allclose(force.sel(order=[1, 2, 3, 4]), source()[:4, 0], rtol=1e-8)
    assert np.isfinite(results["level_total"]).all()
    names = {path.name for path in tmp_path.iterdir()}
    assert {"blocked_forces.nc", "blocked_forces.csv", "validation.csv", "blocked_forces.md",
            "blocked_forces.svg", "validation.svg"} <= names  # fmt: skip
    rows = (tmp_path / "validation.csv").read_text().splitlines()
    assert len(rows) == 1 + 3 * FREQUENCY.size


def test_a_truncation_that_is_asked_for_is_taken(tmp_path):
    file = write(tmp_path, BELOW)
    text = file.read_text().replace("draws = 50", "draws = 50\ntruncation_percent = 2.0")
    file.write_text(text)
    assert va.blocked_forces(file)["inversion_truncation"] == 0.02


def test_left_out_responses_are_those_of_the_forces_from_the_others():
    rng = np.random.default_rng(5)
    y = rng.normal(size=(3, 5, 2)) + 1j * rng.normal(size=(3, 5, 2))
    u = rng.normal(size=(3, 5)) + 0j
    made = left_out_responses(u, y, [0.0])[0]
    for line in range(3):
        for left in range(5):
            rest = np.delete(np.arange(5), left)
            force = np.linalg.lstsq(y[line, rest], u[line, rest], rcond=None)[0]
            np.testing.assert_allclose(made[line, left], y[line, left] @ force, rtol=1e-10)


def test_forces_that_move_a_rigid_body():
    corners = np.column_stack([CORNERS, np.full(4, -0.1)])
    w = rigid_wrench(corners, np.tile([0.0, 0.0, 1.0], (4, 1)))
    np.testing.assert_allclose(w[3], CORNERS[:, 1])  # about x: y F
    np.testing.assert_allclose(w[4], -CORNERS[:, 0])
    sets = rigid_forces(w)
    assert sets.shape == (4, 3)
    twisting = np.array([1.0, -1.0, 1.0, -1.0])  # neither force nor moment
    np.testing.assert_allclose(twisting @ sets, 0.0, atol=1e-12)
    np.testing.assert_allclose(condition_number(np.diag([4.0, 2.0])[None] + 0j), [2.0])


WRONG = [
    ('validation = ["n25"', 'validation = ["n24"', "n24: is among the responses"),
    ('validation = ["n25"', 'validation = ["n99"', "blocked_forces.validation = n99: no such"),
    ('points = ["n11"', 'points = ["n12"', "blocked_forces.points: names a point twice"),
    ('"n14", "n21", "n22", "n23", "n24"]', "]", "responses: 3 for 4 forces: must be at least"),
    ('points = ["n11"', 'points = ["n21"', "frequency response 21+z/21+z is in none"),
    ('[blocked_forces]', "[blocked_forces]\nspeed_rpm = 1500.0", "positions.n11: must be one of"),
    ('[blocked_forces]', "[blocked_forces]\nspeed_rpm = 6.0", "speed_rpm = 6.0 rpm: out of range"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "words"), WRONG)
def test_what_is_wrong_is_one_line_and_exit_code_2(tmp_path, old, new, words, monkeypatch, capsys):
    file = write(tmp_path, BELOW)
    file.write_text(file.read_text().replace(old, new))
    monkeypatch.setattr("sys.argv", ["vibroacoustics", "blocked-forces", str(file)])
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        cli.main()
    assert ended.value.code == 2
    (line, *_) = capsys.readouterr().err.splitlines()
    assert words in line
    assert str(tmp_path) in line
    assert not (tmp_path / "reports").exists()


def test_lines_that_are_no_orders_are_refused(tmp_path):
    file = write(tmp_path, ABOVE.replace("speed_rpm = 1500.0", "speed_rpm = 1733.0"))
    outcome = CliRunner().invoke(
        cli.app, ["blocked-forces", str(file), "--out", str(tmp_path / "out")]
    )
    assert isinstance(outcome.exception, va.ParameterError)
    assert "no line is within 0.01 of an order" in str(outcome.exception)
    assert not (tmp_path / "out").exists()


def test_shapes_that_do_not_fit_are_refused():
    with pytest.raises(va.ParameterError, match=r"compliance: shape \(3, 2, 1\)"):
        va.inverted_forces(np.ones((3, 4), complex), np.ones((3, 2, 1), complex))
