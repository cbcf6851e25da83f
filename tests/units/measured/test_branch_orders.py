"""Run-up, coast-down, dwell and idle are operating points of their own."""

import numpy as np
import pytest
from support import command_here, tiny_run

import vibroacoustics as va
from vibroacoustics.base.errors import SchemaError
from vibroacoustics.measured.recorded_rows import of_each_speed
from vibroacoustics.orders.recorded import LoadWarning
from vibroacoustics.report import analysis_of_comparison
from vibroacoustics.report.compared.validation import validations_of
from vibroacoustics.report.recordings import analysis_of_orders
from vibroacoustics.report.tables import to_text
from vibroacoustics.results.figure_limits import Compared
from vibroacoustics.results.run_variables import check_known
from vibroacoustics.results.storage import write_results

RATE_HZ = 4096.0


def up_and_down(duration_s=20.0, down=-1.0):
    """900 to 3000 rpm and back: order 2 of 1 Pa up and `down` Pa down, order 1 of 0.3 Pa."""
    time_s = np.arange(int(2.0 * duration_s * RATE_HZ)) / RATE_HZ
    speed_rpm = 3000.0 - 2100.0 * np.abs(time_s - duration_s) / duration_s
    angle = 2.0 * np.pi * np.cumsum(speed_rpm / 60.0) / RATE_HZ
    peak = np.where(time_s < duration_s, 1.0, down)
    sound = peak * np.cos(2.0 * angle) + 0.3 * np.cos(angle)
    return va.label_recording([sound, speed_rpm], RATE_HZ, ["front", "speed"], ["Pa", "rpm"])


@pytest.fixture(scope="module")
def results():
    settings = va.OrderAnalysis(va.SpeedChannel("speed"), (1.0, 2.0), maximum_order=8.0)
    return va.analyse_orders(up_and_down(), settings)


def test_up_and_down_are_two_branches(results):
    assert list(dict.fromkeys(results["branch"].values.tolist())) == ["run-up", "coast-down"]
    second = results["channel_order"].sel(channel="front", order=2.0)
    for branch, peak in (("run-up", 1.0), ("coast-down", -1.0)):
        of_branch = second[results["branch"].values == branch]
        assert of_branch.sizes["speed"] >= 20
        np.testing.assert_allclose(np.abs(of_branch), 1.0, atol=0.01)
        first = results["channel_order"].sel(channel="front", order=1.0)
        relative = of_branch / (first[results["branch"].values == branch] / 0.3) ** 2
        np.testing.assert_allclose(relative.real, peak, atol=0.03)


def test_branches_are_in_table_and_file(results):
    analysis = analysis_of_orders(results)
    table = analysis.tables["orders.csv"]
    assert set(table["branch"]) == {"run-up", "coast-down"}
    text = "\n".join(to_text(block) for block in analysis.shown if block.block == "table")
    assert "coast-down" in text
    assert "branches, never averaged with each other" in " ".join(analysis.shown[0].items)


def test_one_branch_needs_no_column():
    recording = up_and_down().isel(time=slice(0, int(20 * RATE_HZ)))
    results = va.analyse_orders(recording, va.OrderAnalysis(va.SpeedChannel("speed"), (1.0, 2.0)))
    assert set(results["branch"].values) == {"run-up"}
    text = "\n".join(to_text(b) for b in analysis_of_orders(results).shown if b.block == "table")
    assert "run-up" not in text


def test_branches_are_compared_with_their_own_kind(results):
    louder = va.analyse_orders(
        up_and_down(down=-2.0), va.OrderAnalysis(va.SpeedChannel("speed"), (2.0,))
    )
    compared = va.compare(results, louder)
    change_db = compared["order_difference"].sel(channel="front", order=2.0)
    is_down = compared["branch"].values == "coast-down"
    assert 40 < is_down.size <= results.sizes["speed"]
    np.testing.assert_allclose(change_db.values[~is_down], 0.0, atol=0.2)
    np.testing.assert_allclose(change_db.values[is_down], 6.02, atol=0.2)
    one = va.compare(results, louder.isel(speed=louder["branch"].values == "run-up"))
    assert set(one["branch"].values) == {"run-up"}


def test_mean_of_runs_keeps_branches(results):
    mean = va.mean_of_runs([results, results])
    assert mean["branch"].values.tolist() == results["branch"].values.tolist()
    np.testing.assert_allclose(mean["channel_order_rms"], results["channel_order_rms"], rtol=1e-9)
    again = va.compare(results, mean)
    assert again.sizes["speed"] == results.sizes["speed"]


def test_files_with_branches_are_compared_in_rows_of_their_own(results, tmp_path):
    file = write_results(results, tmp_path / "orders.nc")
    mean = write_results(va.mean_of_runs([results, results]), tmp_path / "campaign.nc")
    for other in (file, mean):
        outcome = command_here("compare", file, other, "--out", tmp_path / "compared")
        assert outcome.returncode == 0, outcome.stderr
        head, _, *rows = outcome.stdout[outcome.stdout.index("Channel") :].splitlines()
        assert "branch" in head
        assert {"run-up", "coast-down"} <= {word for row in rows for word in row.split()}


def test_a_study_is_beside_every_branch(results):
    study = tiny_run()  # at 2900 rpm
    compared = va.compare(study, results, {"pressure front_1m": "front"})
    beside = Compared(compared, study, results)
    quantities = [row.quantity for row in validations_of(beside)]
    points = [word.partition(", ")[2] for word in quantities if word.startswith("Order 1 ")]
    assert points == ["2900 rpm, run-up", "2900 rpm, coast-down"]
    assert "2900, coast-down" in analysis_of_comparison(beside, ()).html().decode()


def test_a_speed_twice_in_a_branch_is_refused(results):
    twice = results.isel(speed=[0, *range(results.sizes["speed"])])
    with pytest.raises(SchemaError, match="coordinate speed holds a label twice"):
        check_known(twice)
    assert check_known(results).sizes == results.sizes


def test_limits_hold_in_every_branch(results):
    checked = va.check_limits(results, [va.Limit("front", 2.0, 0.5, "Pa")])
    assert not checked["within_limit"].sel(order=2.0).any()


def test_a_baseline_has_each_speed_once(results):
    single = of_each_speed(results)
    assert single["speed"].values.tolist() == sorted(set(results["speed"].values.tolist()))


def test_a_machine_that_stops_is_running_and_idle():
    """20 s at 3000 rpm of which it runs from 5 to 14 s: 1 Pa peak, not its mean over the time."""
    time_s = np.arange(int(20.0 * RATE_HZ)) / RATE_HZ
    is_on = (time_s > 5.0) & (time_s < 14.0)
    noise = 0.01 * np.random.default_rng(0).standard_normal(time_s.size)
    sound = is_on * np.cos(2.0 * np.pi * 50.0 * time_s) + noise
    recording = va.label_recording([sound], RATE_HZ, ["front"], ["Pa"])
    results = va.analyse_orders(recording, va.OrderAnalysis(va.NominalSpeed(3000.0), (1.0, 2.0)))
    assert results["branch"].values.tolist() == ["idle 1", "dwell", "idle 2"]
    peak = np.abs(results["channel_order"].sel(channel="front", order=1.0).values)
    np.testing.assert_allclose(peak[1], 1.0, rtol=0.01)
    assert np.all(peak[[0, 2]] < 0.01)
    facts = " ".join(analysis_of_orders(results).shown[0].items)
    assert "idle: the orders are 10 dB or more below" in facts


def test_a_start_and_a_stop_are_in_no_mean():
    """3000 rpm from 6 to 14 s, with a start of 2 s and a stop of 3 s, at one nominal speed."""
    time_s = np.arange(int(20.0 * RATE_HZ)) / RATE_HZ
    hertz = np.interp(time_s, [0, 4, 6, 14, 17, 20], [0, 0, 50, 50, 0, 0])
    angle = 2.0 * np.pi * np.cumsum(hertz) / RATE_HZ
    sound = np.where(hertz > 0.0, np.cos(angle), 0.0)
    sound += 0.01 * np.random.default_rng(0).standard_normal(time_s.size)
    recording = va.label_recording([sound], RATE_HZ, ["front"], ["Pa"])
    results = va.analyse_orders(recording, va.OrderAnalysis(va.NominalSpeed(3000.0), (1.0, 2.0)))
    assert results["branch"].values.tolist() == ["idle 1", "dwell", "idle 2"]
    peak = np.abs(results["channel_order"].sel(channel="front", order=1.0).values)
    np.testing.assert_allclose(peak[1], 1.0, atol=0.02)


def test_two_loads_at_one_speed_are_named():
    time_s = np.arange(int(20.0 * RATE_HZ)) / RATE_HZ
    sound = np.where(time_s < 10.0, 1.0, 0.5) * np.cos(8.0 * 2.0 * np.pi * 40.0 * time_s)
    sound += 0.01 * np.random.default_rng(0).standard_normal(time_s.size)
    recording = va.label_recording([sound], RATE_HZ, ["front"], ["Pa"])
    with pytest.warns(LoadWarning, match=r"dwell: the orders stay at two levels, 6\.\d* dB apart"):
        va.analyse_orders(recording, va.OrderAnalysis(va.NominalSpeed(2400.0), (8.0,)))
