"""`vibroacoustics orders` of many files: settings, tables and page, refusals."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from scipy.io import wavfile
from support import assert_refused, command_here

import vibroacoustics as va

RATE_HZ = 6400
TIME_S = np.arange(2 * RATE_HZ) / RATE_HZ
SETTINGS = """
[channels]
"channel 1" = { name = "front", unit = "Pa", calibration = 2.0 }
"channel 2" = { name = "tacho", unit = "V", calibration = 10.0 }
[speed]
channel = "tacho"
[analysis]
orders = [1, 2]
maximum_order = 4
[files."{machine}_{run}.wav"]
"""


def write(file: Path, level_db: float, phase_rad: float = 0.0) -> Path:
    """Write a run at 3000 rpm: order 1 of a level, order 2 10 dB below, and a tacho."""
    angle = 2.0 * np.pi * 50.0 * TIME_S
    shifted = angle + phase_rad
    peak = np.sqrt(2.0) * 2e-5 * 10.0 ** (level_db / 20.0)
    sound = peak * (np.cos(shifted) + np.sqrt(0.1) * np.cos(2.0 * shifted)) / 2.0
    tacho = np.where(angle % (2.0 * np.pi) < 0.5, 0.5, 0.0)
    wavfile.write(file, RATE_HZ, np.stack([sound, tacho], axis=1).astype(np.float32))
    return file


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("campaign")
    (folder / "batch.toml").write_text(SETTINGS, encoding="utf-8")
    for machine, levels in (("A", (80.0, 82.0)), ("B", (84.0, 84.0)), ("C", (88.0, 89.0))):
        for number, level_db in enumerate(levels):
            write(folder / f"{machine}_{number}.wav", level_db, 0.1 * number)
    return folder


def _rows(file: Path) -> list[dict[str, str]]:
    with file.open(newline="", encoding="utf-8") as text:
        return list(csv.DictReader(text))


def _files(folder: Path) -> list[Path]:
    return sorted(folder.glob("?_?.wav"))


@pytest.fixture(scope="module")
def out(folder: Path) -> Path:
    out = folder / "out"
    done = command_here("orders", *_files(folder), "--settings", folder / "batch.toml",
                        "--out", out)  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("6 runs of 3 machines at 3000 rpm.\n")
    return out


def test_tables_of_mean_machines_and_runs(out: Path) -> None:
    first = _rows(out / "campaign_orders.csv")[0]
    assert (first["channel"], first["order"], first["runs"], first["machines"]) == (
        "front", "1", "6", "3",
    )  # fmt: skip
    energies = [(10**8 + 10**8.2) / 2, 10**8.4, (10**8.8 + 10**8.9) / 2]
    assert float(first["level_db"]) == pytest.approx(10 * np.log10(sum(energies) / 3), abs=0.01)
    # mean levels 81, 84, 88.5: their mean 84.5, squares 12.25, 0.25, 16 over 2; t = 4.3027
    uncertainty = np.sqrt(28.5 / 2.0 / 3.0)
    assert float(first["mean_interval_db"]) == pytest.approx(4.3027 * uncertainty, abs=0.05)
    machines = _rows(out / "campaign_machine_orders.csv")
    assert [row["runs"] for row in machines if row["order"] == "2"] == ["2", "2", "2"]
    deviations = [float(row["run_deviation_db"]) for row in machines if row["order"] == "2"]
    np.testing.assert_allclose(deviations, [np.sqrt(2.0), 0.0, np.sqrt(0.5)], atol=0.01)
    runs = _rows(out / "campaign_run_orders.csv")
    named = {row["file"]: float(row["level_db"]) for row in runs if row["order"] == "1"}
    expected = {"A_0.wav": 80, "A_1.wav": 82, "B_0.wav": 84, "B_1.wav": 84, "C_0.wav": 88,
                "C_1.wav": 89}  # fmt: skip
    assert named == pytest.approx(expected, abs=0.01)
    levels = _rows(out / "campaign_run_levels.csv")
    total = [row for row in levels if row["band_hz"] == "" and row["weighting"] == "Z"]
    assert float(total[0]["level_db"]) == pytest.approx(80.0 + 10 * np.log10(1.1), abs=0.02)
    assert {row["band_hz"] for row in levels} >= {"50", "100", "1000"}


def test_page_and_results(out: Path) -> None:
    page = (out / "campaign.html").read_text(encoding="utf-8")
    assert "6 runs of 3 machines at 3000 rpm." in page
    assert '<th scope="row" class="words">B: 1</th>' in page
    assert (out / "orders_1_front.svg").is_file()
    assert (out / "bands_1_front.svg").is_file()
    mean = va.open_results(out / "campaign.nc")
    assert mean["run_order_rms"].dims == ("run", "channel", "speed", "order")
    assert mean["machine_order_deviation"].sizes["machine"] == 3


def test_results_are_compared_with_those_of_one_recording(
    folder: Path, out: Path, tmp_path: Path
) -> None:
    words = ["--settings", folder / "batch.toml", "--out", tmp_path]
    done = command_here("orders", folder / "A_0.wav", *words)
    assert done.returncode == 0, done.stderr
    done = command_here("compare", tmp_path / "orders.nc", out / "campaign.nc", "--out", tmp_path)
    assert done.returncode == 0, done.stderr
    rows = _rows(tmp_path / "compared_orders.csv")
    assert {row["channel"] for row in rows} == {"front"}


def test_options_override_the_settings(folder: Path, tmp_path: Path) -> None:
    done = command_here("orders", folder / "A_0.wav", "--settings", folder / "batch.toml",
                        "--orders", "1", "--rpm", "3000", "--calibration", "channel 1=4",
                        "--channels", "channel 1", "--out", tmp_path)  # fmt: skip
    assert done.returncode == 0, done.stderr
    (row,) = _rows(tmp_path / "orders.csv")
    peak = 2.0 * np.sqrt(2.0) * 2e-5 * 10.0**4
    assert float(row["amplitude_peak"]) == pytest.approx(peak, rel=1e-3)


def test_a_run_up_is_averaged_speed_by_speed(tmp_path: Path) -> None:
    """Order 1 of 80 and 86 dB at all speeds; both runs are of one machine."""
    time_s = np.arange(6 * RATE_HZ) / RATE_HZ
    speed_rpm = 1000.0 + 250.0 * time_s
    angle = 2.0 * np.pi * (1000.0 * time_s + 125.0 * time_s**2) / 60.0
    for number, level_db in enumerate((80.0, 86.0)):
        sound = np.sqrt(2.0) * 2e-5 * 10.0 ** (level_db / 20.0) * np.cos(angle)
        recording = va.label_recording([sound, speed_rpm], RATE_HZ, ["front", "n"], ["Pa", "rpm"])
        va.export_recording(recording, tmp_path / f"{number}.nc")
    done = command_here("orders", tmp_path / "0.nc", tmp_path / "1.nc", "--speed-channel", "n",
                        "--orders", "1", "--maximum-order", "4", "--out", tmp_path)  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("2 runs of one machine at 1100 to 2500 rpm.\n")
    rows = _rows(tmp_path / "campaign_orders.csv")
    assert len(rows) == 15
    expected = 10.0 * np.log10((10**8 + 10**8.6) / 2.0)
    for row in rows:
        assert float(row["level_db"]) == pytest.approx(expected, abs=0.05)
        assert float(row["run_deviation_db"]) == pytest.approx(6.0 / np.sqrt(2.0), abs=0.05)
        assert row["machine_deviation_db"] == ""
    # one degree of freedom: t = 12.706; u = 6 dB over root 2, over root 2
    assert float(rows[5]["mean_interval_db"]) == pytest.approx(12.706 * 3.0, rel=0.02)
    assert (tmp_path / "orders_1_front.svg").is_file()


def test_limits_are_those_of_the_mean(folder: Path, tmp_path: Path) -> None:
    limits = tmp_path / "limits.csv"
    limits.write_text("channel,order,limit,unit\nfront,1,0.3,Pa\n", encoding="utf-8")
    done = command_here("orders", *_files(folder), "--settings", folder / "batch.toml",
                        "--limits", limits, "--out", tmp_path)  # fmt: skip
    assert done.returncode == 1, done.stderr
    assert "broken: order 1 of front at 3000 rpm" in done.stdout
    assert (tmp_path / "campaign_limits.csv").is_file()


def test_broken_recordings_are_omitted_and_named(folder: Path, tmp_path: Path, out: Path) -> None:
    (tmp_path / "D_0.wav").write_bytes(b"RIFF")
    broken = [tmp_path / "D_0.wav", tmp_path / "D_1.wav"]
    words = ["--settings", folder / "batch.toml", "--out", tmp_path / "out"]
    done = command_here("orders", *_files(folder), *broken, *words, "--json")
    assert done.returncode == 3, done.stderr
    warned = [line for line in done.stderr.splitlines() if line.startswith("warning: ")]
    assert len(warned) == 2
    assert warned[1] == f"warning: {broken[1]} is omitted: no such file"
    envelope = json.loads(done.stdout)
    assert envelope["warnings"] == [line.removeprefix("warning: ") for line in warned]
    omitted = envelope["tables"]["campaign_omitted"]
    assert omitted["file"] == list(map(str, broken))
    rows = _rows(tmp_path / "out" / "campaign_omitted.csv")
    assert [row["reason"] for row in rows] == omitted["reason"]
    page = (tmp_path / "out" / "campaign.html").read_text(encoding="utf-8")
    assert "2 of 8 recordings are omitted" in page
    assert "D_0.<wbr>wav" in page
    whole, mean = (va.open_results(each / "campaign.nc") for each in (out, tmp_path / "out"))
    assert mean.equals(whole)
    assert json.loads(mean.attrs["omitted"])[str(broken[1])] == "no such file"


def test_too_few_recordings_are_refused_with_all_reasons(folder: Path, tmp_path: Path) -> None:
    missing = [tmp_path / "D_0.wav", tmp_path / "D_1.wav"]
    words = ["--settings", folder / "batch.toml", "--out", tmp_path / "out"]
    done = command_here("orders", _files(folder)[0], *missing, *words)
    assert_refused(done, "1 recordings can be averaged: must be at least 2")
    for file in missing:
        assert_refused(done, f"{file}: no such file")
    assert len(done.stderr.splitlines()) == 3
    assert not (tmp_path / "out").exists()


def test_what_needs_one_recording_is_refused(folder: Path) -> None:
    words = ["--settings", folder / "batch.toml", "--map"]
    assert_refused(command_here("orders", *_files(folder), *words), "--map: need one recording")


def test_speed_that_is_missing_is_asked_for_once(folder: Path) -> None:
    done = command_here("orders", *_files(folder)[:2], "--unit", "*=Pa", "--calibration", "*=1")
    assert_refused(done, "speed: give one of --speed-channel")
    assert len(done.stderr.splitlines()) == 1


def test_sound_power_takes_the_settings(folder: Path, tmp_path: Path) -> None:
    settings = tmp_path / "microphones.toml"
    settings.write_text(
        'channels."channel 1" = { unit = "Pa", calibration = 2.0 }', encoding="utf-8"
    )
    done = command_here("sound-power", *_files(folder)[:4], "--hemisphere", "1",
                        "--settings", settings, "--out", tmp_path)  # fmt: skip
    assert done.returncode == 0, done.stderr
