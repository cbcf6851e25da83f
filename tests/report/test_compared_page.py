"""The page of a comparison: options side by side, recordings beside a study, limits."""

import re

import numpy as np
import pytest
from scipy.stats import norm
from sources_study import sources_run
from support import assert_refused, command_here, tiny_run

from vibroacoustics import (
    OrderAnalysis,
    SpeedChannel,
    analyse_orders,
    compare,
    label_recording,
    mean_of_runs,
)
from vibroacoustics.report import analysis_of_comparison
from vibroacoustics.report.compared.studies import inputs_table, key_figures
from vibroacoustics.report.compared.validation import levels_tables, validations_of
from vibroacoustics.results.figure_limits import Compared
from vibroacoustics.results.mean_of_runs import with_scatter
from vibroacoustics.results.storage import write_results

MICROPHONE = "pressure front_1m"
TWICE_DB = 20.0 * np.log10(2.0)


@pytest.fixture(scope="module")
def study():
    return tiny_run()


def recording(study, gain):
    """Orders of the study's sound at the microphone times a gain, 4 s with a tacho."""
    angle = 2.0 * np.pi * 2900.0 / 60.0 * np.arange(16384) / 4096.0
    peaks = (
        study["pressure_line"]
        .sel(option="none", receiver="front_1m")
        .isel(speed=0, line=slice(1, 5))
    )
    peaks = gain * peaks.sum("sound_source").values
    sound = sum(np.real(p * np.exp(1j * k * angle)) for k, p in enumerate(peaks, 1))
    tacho = np.clip(0.5 + ((angle + np.pi) % (2.0 * np.pi) - np.pi) / 0.1, 0.0, 1.0)
    made = label_recording([sound, tacho], 4096.0, ["front", "tacho"], ["Pa", "V"])
    orders = tuple(float(order) for order in range(1, 5))
    return analyse_orders(made, OrderAnalysis(SpeedChannel("tacho"), orders, maximum_order=6.0))


def validated(study, runs, specimens):
    mean = mean_of_runs(runs, specimens)
    orders = with_scatter(compare(study, mean, {MICROPHONE: "front"}), mean)
    return Compared(orders, study, mean)


def page_of(compared, figures=()):
    return analysis_of_comparison(compared, figures).html().decode()


def test_options_side_by_side(study):
    pairs = {name: name for name in (MICROPHONE, "force x")}
    orders = compare(study, study, pairs, other_option="counterweight-half")
    compared = Compared(orders, study, study)
    force = {row[0]: row for row in key_figures(compared).rows}["Force, 1×, 2900 rpm"]
    values = study["force_amplitude"].sel(order=1).squeeze("speed")
    expected = float(values.sel(option="counterweight-half") / values.sel(option="none"))
    assert float(force[5]) == pytest.approx(expected, abs=5e-4)
    inputs = {row[0]: row[1:] for row in inputs_table(compared).rows}
    assert inputs["option.name"] == ("none", "counterweight-half")
    assert inputs["option.share_ratio"] == ("–", "0.5")
    assert set(inputs) == {"option.name", "option.kind", "option.share_ratio"}
    page = page_of(compared)
    assert re.findall(r'<section id="(.*?)">', page) == [
        "verdict", "figures", "rating", "orders", "levels", "inputs", "results",
    ]  # fmt: skip
    assert "default-src &#39;none&#39;; img-src data:" in page
    assert "<script" not in page


def test_recordings_beside_a_study(study):
    """Two specimens, 6 dB apart, twice each: E and u_D are known."""
    runs = [recording(study, gain) for gain in (1.0, 1.0, 2.0, 2.0)]
    compared = validated(study, runs, ["a", "a", "b", "b"])
    order = next(one for one in validations_of(compared) if one.quantity.startswith("Order 1 of"))
    mean_db = 10.0 * np.log10(2.5)
    assert order.error == pytest.approx(-mean_db, abs=0.02)
    assert order.published == pytest.approx(TWICE_DB / 2.0, abs=0.01)
    assert order.numerical == pytest.approx(20.0 * np.log10(1.01), abs=0.01)
    scatter = compared.orders.sel(order=1).squeeze(["channel", "speed"])
    assert scatter["order_run_deviation"].item() == pytest.approx(0.0, abs=1e-6)
    assert scatter["order_specimen_deviation"].item() == pytest.approx(4.257, abs=0.01)
    page = page_of(compared)
    assert "mean of 4 recordings of 2 machines" in page
    assert '<section id="validation">' in page


def test_study_may_be_the_second(study):
    run = recording(study, 2.0)
    orders = compare(run, study, {"front": MICROPHONE})
    validations = validations_of(Compared(orders, run, study))
    first = next(one for one in validations if one.quantity.startswith("Order 1 of"))
    assert first.error == pytest.approx(-TWICE_DB, abs=0.02)


def test_levels_of_both(study):
    compared = validated(study, [recording(study, 1.0)], ["a"])
    (table,) = levels_tables(compared)
    band = {row[0]: row for row in table.rows}["50 Hz"]
    assert band[1] == band[2]
    assert len(table.head) == 4  # one run tells no uncertainty


@pytest.mark.long
def test_command_with_runs_options_and_limits(study, tmp_path):
    """All kinds of limits from one file; exit code 1 and a line for what is broken, else 0."""
    result = write_results(study, tmp_path / "results.nc")
    files = []
    for number, gain in enumerate((1.0, 1.1)):
        files.append(write_results(recording(study, gain), tmp_path / f"{number}.nc"))
    limits, out = tmp_path / "limits.csv", tmp_path / "out"
    to = ("compare", result, *files, "--pair", f"{MICROPHONE}=front", "--out", out)
    header = "channel,order,band_hz,criterion,limit,unit,side\n"
    limits.write_text(header + "front,1,,,120,dB,\nfront,,50,,120,dB,\nfront,,,,120,dB(A),\n")
    good = command_here(*to, "--limits", limits)
    assert (good.returncode, good.stderr) == (0, ""), good.stderr
    assert "broken" not in good.stdout
    limits.write_text(header + ",,,foot_force_1x_n,1e-6,N,\nfront,1,,,120,dB,\n")
    bad = command_here(*to, "--specimens", "a,b", "--limits", limits)
    assert (bad.returncode, bad.stderr) == (1, ""), bad.stderr
    (line,) = [line for line in bad.stdout.splitlines() if line.startswith("broken: ")]
    assert line.startswith("broken: criterion foot_force_1x_n in A: ")
    assert line.endswith(f"({limits}: line 2)")
    page = (out / "compared.html").read_text()
    assert "1 limit is broken." in page
    assert (out / "compared_figures_limits.csv").is_file()
    assert_refused(command_here(*to, "--specimens", "a"), "specimens: 1 for 2 runs")
    assert_refused(command_here("compare", *files, result), "only recordings are averaged")
    assert_refused(command_here(*to, "--other-option", "hood"), "'hood': mean of 2 recordings")
    assert_refused(command_here("compare", result, result, "--other-option", "hood"), "is none of")


def test_recordings_of_own_samples_agree_in_four_of_five():
    """Levels of a hundred samples by their weights: the 80 % interval; 10 dB off differs."""
    sampled = sources_run()
    at = {"speed": 2900.0, "option": "none", "receiver": "front_1m"}
    rows = sampled["level_total_by_sample"].sel(at).values
    weight = sampled["sample_weight"].values[0]
    picked = np.random.default_rng(3).choice(rows.size, 100, p=weight / weight.sum())
    orders = recording(sampled, 1.0)
    level = orders["equivalent_level"].sel(channel="front", weighting="A").item()

    def verdict(level_dba):
        shifted = orders.assign(equivalent_level=orders["equivalent_level"] + level_dba - level)
        compared = compare(sampled, shifted, {MICROPHONE: "front"})
        total, *_ = validations_of(Compared(compared, sampled, shifted))
        assert total.data == pytest.approx(level_dba)
        assert total.inputs > 0.0
        return total.verdict

    verdicts = [verdict(float(rows[row])) for row in picked]
    assert 76 <= verdicts.count("agrees") <= 84
    assert verdict(float(sampled["level_total"].sel(at)) + 10.0) == "differs"


def test_orders_have_the_spread_of_the_samples():
    sampled = sources_run()
    run = recording(sampled, 2.0)
    orders = compare(sampled, run, {MICROPHONE: "front"})
    rows = validations_of(Compared(orders, sampled, run))
    order = next(row for row in rows if row.quantity.startswith("Order 1 of"))
    at = {"speed": 2900.0, "option": "none", "receiver": "front_1m", "order": 1, "weighting": "Z"}
    high, value = (sampled[f"order_level{end}"].sel(at).item() for end in ("_90_percent", ""))
    assert order.inputs == pytest.approx((high - value) / norm.ppf(0.9), rel=1e-9)
