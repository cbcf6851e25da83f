"""`vibroacoustics sound-power`: files, calibration and room as the command line gives them."""

import csv
from pathlib import Path

import numpy as np
import pytest
from support import assert_refused, command_here
from synthetic_microphones import BANDS, recording

import vibroacoustics as va
from vibroacoustics.radiation.arrangements import hemisphere_positions

POWER_DB = np.full(len(BANDS), 70.0)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Ten microphones in one file; the same in two, of which the second has half the samples."""
    folder = tmp_path_factory.mktemp("microphones")
    running = recording(hemisphere_positions(1.0), POWER_DB, None, with_source=True)
    va.export_recording(running, folder / "all.wav")
    names = list(running["channel"].values)
    for file, of_file, factor in (("left", names[:5], 1.0), ("right", names[5:], 0.5)):
        chosen = factor * running["signal"].sel(channel=of_file).values
        part = va.label_recording(chosen, 25600.0, of_file, ["Pa"] * 5)
        va.export_recording(part, folder / f"{file}.wav")
    return folder


def _levels(file: Path) -> dict[str, str]:
    with file.open(newline="", encoding="utf-8") as text:
        return {row["band_hz"]: row["sound_power_level_db"] for row in csv.DictReader(text)}


def test_one_file_with_a_unit_for_all_channels(folder: Path, tmp_path: Path) -> None:
    done = command_here(
        "sound-power", folder / "all.wav", "--hemisphere", 1.0, "--unit", "*=Pa", "--out", tmp_path
    )
    assert done.returncode == 0, done.stderr
    levels = _levels(tmp_path / "sound_power.csv")
    assert len(levels) == 22
    assert float(levels["1000"]) == pytest.approx(70.0, abs=0.1)  # the table has two digits
    assert "dB(A) re 1 pW: no grade without background and K2." in done.stdout
    assert "The room was not stated: K2 is 0" in done.stdout
    assert "The background was not recorded" in done.stdout
    page = (tmp_path / "sound_power.html").read_text(encoding="utf-8")
    assert '<th scope="row" class="words">6300</th>' in page


def test_two_files_and_the_calibration_of_one(folder: Path, tmp_path: Path) -> None:
    words = ["--hemisphere", 1.0, "--unit", "*=Pa", "--out", tmp_path, "--absorption-area", 1000]
    files = [folder / "left.wav", folder / "right.wav"]
    done = command_here("sound-power", *files, *words, "--calibration", "right:*=2.0")
    assert done.returncode == 0, done.stderr
    levels = _levels(tmp_path / "sound_power.csv")
    k2 = 10.0 * np.log10(1.0 + 4.0 * 2.0 * np.pi / 1000.0)
    assert float(levels["1000"]) == pytest.approx(70.0 - k2, abs=0.1)
    power = va.open_results(tmp_path / "sound_power.nc")
    assert {str(name).split(":")[0] for name in power["channel"].values} == {"left", "right"}


def test_room_by_reverberation_time_in_a_file(folder: Path, tmp_path: Path) -> None:
    lines = [f"{band.nominal_hz:g},0.8" for band in BANDS]
    (tmp_path / "room.csv").write_text("\n".join(["band_hz,reverberation_time_s", *lines]))
    done = command_here(
        "sound-power", folder / "all.wav", "--hemisphere", 1.0, "--unit", "*=Pa",
        "--reverberation-time", tmp_path / "room.csv", "--volume", 400.0, "--out", tmp_path,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    k2 = 10.0 * np.log10(1.0 + 4.0 * 2.0 * np.pi / (0.16 * 400.0 / 0.8))
    power = va.open_results(tmp_path / "sound_power.nc")
    assert power["environment_correction"].values == pytest.approx(k2)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([], "surface: give one of --hemisphere RADIUS and --box"),
        (["--hemisphere", "1", "--box", "1", "1", "1", "1"], "surface: give one of"),
        (["--hemisphere", "0.1"], "--hemisphere = 0.1 m: must be 0.5 to 16 m"),
        (["--box", "1", "99", "1", "1"], "--box, width = 99 m: must be 0.01 to 20 m"),
        (["--hemisphere", "1", "--volume", "50"], "--reverberation-time and --volume belong"),
        (
            ["--hemisphere", "1", "--volume", "50", "--reverberation-time", "0"],
            "--reverberation-time = 0 s: must be 0.01 to 100 s",
        ),
        (["--hemisphere", "1", "--absorption-area", "large"], "must be a number or a CSV file"),
        (["--hemisphere", "1", "--absorption-area", "-3"], "-3 m² at 100 Hz: must be 0.001 to"),
        (
            ["--hemisphere", "1", "--absorption-area", "9", "--reverberation-time", "1"],
            "one of --absorption-area and --reverberation-time",
        ),
        (["--hemisphere", "1", "--unit", "front=Pa"], "no channel 'front'"),
        (["--hemisphere", "1", "--unit", "*=m/s2"], "no channel is sound pressure"),
    ],
)
def test_bad_words_are_one_line(
    folder: Path, tmp_path: Path, words: list[str], message: str
) -> None:
    unit = [] if "--unit" in words else ["--unit", "*=Pa"]
    done = command_here(
        "sound-power", folder / "left.wav", *unit, *words, "--out", tmp_path / "out"
    )
    assert_refused(done, message)
    assert not (tmp_path / "out").exists()
