"""Many recordings as one: mean and scatter against a calculation by hand, all problems at once."""

import math
from pathlib import Path

import numpy as np
import pytest

import vibroacoustics as va
from vibroacoustics.base.fault import LeftOutWarning

RATE_HZ = 3200.0
TIME_S = np.arange(6400) / RATE_HZ
TACHO = np.where((48.0 * TIME_S) % 1.0 < 0.1, 5.0, 0.0)
LEVELS_DB = {"a": (80.0, 82.0, 84.0), "b": (86.0, 86.0), "c": (90.0, 91.0)}
"""Of order 1 of every run."""


def write(
    file: Path,
    level_db: float,
    names: tuple[str, ...] = ("front", "tacho"),
    phase_rad: float = 0.0,
) -> Path:
    """Write a recording at 2880 rpm of a tone at order 1 and a tacho."""
    peak = math.sqrt(2.0) * 2e-5 * 10.0 ** (level_db / 20.0)
    tone = peak * np.cos(2.0 * np.pi * 48.0 * TIME_S + phase_rad)
    recording = va.label_recording([tone, TACHO], RATE_HZ, list(names), ["Pa", "V"])
    return va.export_recording(recording, file)


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("campaign")
    return [
        write(folder / f"{machine}_{number}.csv", level_db, phase_rad=0.1 * number)
        for machine, levels in LEVELS_DB.items()
        for number, level_db in enumerate(levels)
    ]


CAMPAIGN = va.Campaign(
    speed={"channel": "tacho"},
    analysis={"orders": (1.0,), "maximum_order": 4.0},
    files={"{machine}_{run}.csv": {}},
)


def test_mean_and_scatter_by_hand(files: list[Path]) -> None:
    mean = va.analyse_campaign(files, CAMPAIGN.run_of)
    energy = {name: [10.0 ** (level / 10.0) for level in levels]
              for name, levels in LEVELS_DB.items()}  # fmt: skip
    of_machine = {name: sum(values) / len(values) for name, values in energy.items()}
    expected_db = 10.0 * math.log10(sum(of_machine.values()) / 3.0)
    # runs: squares of deviations 4 + 0 + 4, 0, 0.25 + 0.25, over 2 + 1 + 1 degrees of freedom
    run_deviation = math.sqrt(8.5 / 4.0)
    # mean levels 82, 86, 90.5: mean 86.1667, squares 17.3611 + 0.0278 + 18.7778, over 2
    of_means = math.sqrt(36.166667 / 2.0)
    between = math.sqrt(36.166667 / 2.0 - 8.5 / 4.0 * (1 / 3 + 1 / 2 + 1 / 2) / 3.0)
    uncertainty = of_means / math.sqrt(3.0)
    order = mean.sel(channel="front", order=1.0).isel(speed=0)
    level_db = 20.0 * np.log10(order["channel_order_rms"] / 2e-5)
    exact = 1e-3  # of the levels, of the analysis
    assert level_db == pytest.approx(expected_db, abs=exact)
    assert order["order_run_deviation"] == pytest.approx(run_deviation, abs=exact)
    assert order["order_specimen_deviation"] == pytest.approx(between, abs=exact)
    assert order["order_mean_uncertainty"] == pytest.approx(uncertainty, abs=exact)
    # Student's t of two degrees of freedom, 97.5 %: 4.3027 in printed tables
    assert order["order_mean_interval"] == pytest.approx(4.3027 * uncertainty, abs=5 * exact)

    assert mean["machine"].values.tolist() == ["a", "b", "c"]
    assert mean["machine_runs"].values.tolist() == [3, 2, 2]
    machines_db = 20.0 * np.log10(order["machine_order_rms"] / 2e-5)
    by_hand = [10.0 * math.log10(value) for value in of_machine.values()]
    np.testing.assert_allclose(machines_db, by_hand, atol=exact)
    deviations = [2.0, 0.0, math.sqrt(0.5)]
    np.testing.assert_allclose(order["machine_order_deviation"], deviations, atol=exact)

    runs_db = 20.0 * np.log10(order["run_order_rms"] / 2e-5)
    np.testing.assert_allclose(runs_db, [*LEVELS_DB["a"], *LEVELS_DB["b"], *LEVELS_DB["c"]],
                               atol=exact)  # fmt: skip
    assert mean["run"].values.tolist() == ["a: 0", "a: 1", "a: 2", "b: 0", "b: 1", "c: 0", "c: 1"]
    assert mean["run_machine"].values.tolist() == ["a", "a", "a", "b", "b", "c", "c"]
    np.testing.assert_allclose(mean["run_speed"], 2880.0, rtol=1e-4)
    z_weighted = mean.sel(channel="front", weighting="Z")
    assert z_weighted["equivalent_level"] == pytest.approx(expected_db, abs=0.01)
    np.testing.assert_allclose(z_weighted["run_equivalent_level"], runs_db, atol=0.01)
    at_50_hz = z_weighted.sel(band=50.0)
    assert at_50_hz["band_run_deviation"] == pytest.approx(run_deviation, abs=0.01)


def test_a_run_is_what_the_analysis_of_its_file_gives(files: list[Path]) -> None:
    mean = va.analyse_campaign(files[:2], CAMPAIGN.run_of)
    alone = va.analyse_orders(va.read_recording(files[1]), CAMPAIGN.run_of(files[1]).analysis)
    for name in ("order_rms", "order"):
        of_run = mean[f"run_{name}"].sel(run="a: 1").values
        np.testing.assert_array_equal(of_run, alone[f"channel_{name}"].values)
    of_run = mean["run_band_level"].sel(run="a: 1").values
    np.testing.assert_array_equal(of_run, alone["band_level"].values)


def test_runs_of_one_machine_have_no_deviation_between_machines(files: list[Path]) -> None:
    mean = va.analyse_campaign(files[:3], CAMPAIGN.run_of)
    assert np.isnan(mean["order_specimen_deviation"]).all()
    # 2 dB over the root of 3, times 4.3027
    assert mean["order_mean_interval"].item() == pytest.approx(4.9683, abs=0.005)


def test_settings_that_do_not_fit_are_refused_before_any_analysis(
    files: list[Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    twice = write(tmp_path / "a_0.csv", 80.0)
    unlabelled = write(tmp_path / "e.csv", 80.0)
    monkeypatch.setattr("vibroacoustics.measured.campaign.recording_blocks", None)
    with pytest.raises(va.ParameterError) as refusal:
        va.analyse_campaign([*files, unlabelled, twice], CAMPAIGN.run_of)
    lines = str(refusal.value).splitlines()
    assert len(lines) == 2, lines
    assert lines[0].startswith(f"{unlabelled}: has none of the patterns")
    assert lines[1].startswith(f"{twice}: has the label 'a: 0'")


def test_recordings_at_other_speeds_are_omitted(files: list[Path]) -> None:
    def run_of(path: Path) -> va.CampaignRun:
        run = CAMPAIGN.run_of(path)
        speed_rpm = 1500.0 if path in files[:2] else 2880.0
        analysis = va.OrderAnalysis(va.NominalSpeed(speed_rpm), (1.0,), maximum_order=4.0)
        return run._replace(analysis=analysis)

    with pytest.warns(LeftOutWarning, match=r"1500 rpm: none is within 2 % of 2880 rpm") as warned:
        mean = va.analyse_campaign(files, run_of)
    named = [str(each.message).partition(" is omitted")[0] for each in warned]
    assert named == list(map(str, files[:2]))
    assert mean.sizes["run"] == 5


def test_warnings_name_the_file(files: list[Path], tmp_path: Path) -> None:
    cut = tmp_path / "a_9.csv"
    cut.write_text(files[0].read_text(encoding="utf-8").rstrip()[:-3], encoding="utf-8")
    with pytest.warns(va.RecordingWarning, match=r"a_9\.csv: .*last row"):
        mean = va.analyse_campaign([files[0], cut], CAMPAIGN.run_of)
    assert "last row" in mean.attrs["runs"]


def low_rate(file: Path, rate_hz: float) -> Path:
    tone = np.cos(2.0 * np.pi * 1000.0 / 60.0 * np.arange(int(20.0 * rate_hz)) / rate_hz)
    noise = 1e-3 * np.random.default_rng(len(file.stem)).standard_normal(tone.size)
    recording = va.label_recording([tone + noise], rate_hz, ["front"], ["m/s²"])
    return va.export_recording(recording, file)


def test_default_orders_are_those_that_the_rate_holds_in_other_processes(tmp_path: Path) -> None:
    """At 100 Hz and 1000 rpm order 2 is the highest; the settings reach each process by a copy."""
    campaign = va.Campaign(speed={"nominal_rpm": 1000.0})
    files = [low_rate(tmp_path / f"{'a' * n}.nc", 100.0) for n in (1, 2)]
    mean = va.analyse_campaign(files, campaign.run_of)
    assert mean["order"].values.tolist() == [1.0, 2.0]


def test_a_recording_of_lower_rate_takes_no_order_from_the_mean(tmp_path: Path) -> None:
    campaign = va.Campaign(speed={"nominal_rpm": 1000.0})
    files = [
        low_rate(tmp_path / f"{'a' * n}.nc", rate) for n, rate in ((1, 400), (2, 400), (3, 100))
    ]
    with pytest.warns(LeftOutWarning, match="sample rate = 100 Hz: lacks the orders from 3, which"):
        mean = va.analyse_campaign(files, campaign.run_of)
    assert mean["order"].values.tolist() == [1.0, 2.0, 3.0, 4.0]
