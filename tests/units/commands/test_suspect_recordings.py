"""Dead channels, impossible values and repeated files are named by every command that reads."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from support import assert_refused, command_here, tiny_run

import vibroacoustics as va
from vibroacoustics.base.arrays import Array
from vibroacoustics.results.storage import write_results

RATE_HZ = 4000
TIME_S = np.arange(4 * RATE_HZ) / RATE_HZ
RPM = 2900.0
FAULTS: dict[str, tuple[Callable[[Array], Array], str]] = {
    "dead": (lambda tone: 0.0 * tone, "channel 'rear': is dead: all 16000 samples are 0 Pa"),
    "beyond": (
        lambda tone: 1e30 * tone / np.max(np.abs(tone)),
        "channel 'rear': reaches 1e+30 Pa: a sensor of sound pressure gives at most 2e+05 Pa: "
        "check unit and calibration",
    ),
}
"""Change of the second channel, and words of the warning."""
SPEED = ("--rpm", RPM)
COMMANDS: dict[str, tuple[tuple[object, ...], str]] = {
    "orders": ((*SPEED, "--orders", "1"), "orders"),
    "track": ((*SPEED, "--orders", "1", "--bandwidth", 3), "tracked_orders"),
    "map": (SPEED, "speed_map"),
    "tones": ((), "tones"),
    "sound-power": (("--hemisphere", 1.0), "sound_power"),
    "replay": ((*SPEED, "--option", "counterweight-half", "--pair", "front=front_1m"), "replay"),
}
"""Options, and name of the results."""


def sound(number: int) -> Array:
    """Order 1 in noise, Pa."""
    noise = np.random.default_rng(number).standard_normal(TIME_S.size)
    return np.asarray(0.1 * np.cos(2.0 * np.pi * RPM / 60.0 * TIME_S) + 0.01 * noise)


def write(file: Path, rear: Array) -> Path:
    channels = [sound(1), rear]
    return va.export_recording(
        va.label_recording(channels, RATE_HZ, ["front", "rear"], ["Pa", "Pa"]), file
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("suspects")
    write_results(tiny_run(), folder / "results.nc")
    for fault, (changed, _) in FAULTS.items():
        write(folder / f"{fault}.nc", changed(sound(2)))
    write(folder / "good.nc", sound(3))
    write(folder / "other.nc", sound(4))
    return folder


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("command", COMMANDS)
def test_each_command_names_the_channel(
    folder: Path, tmp_path: Path, command: str, fault: str
) -> None:
    options, name = COMMANDS[command]
    further = ("--results", folder / "results.nc") if command == "replay" else ()
    file = folder / f"{fault}.nc"
    done = command_here(command, file, *options, *further, "--out", tmp_path, "--json")
    assert done.returncode == 0, done.stderr
    words = FAULTS[fault][1]
    (line,) = [each for each in json.loads(done.stdout)["warnings"] if words in each]
    assert line.startswith(f"{file}: ")
    assert f"warning: {line}" in done.stderr
    assert words in va.open_results(tmp_path / f"{name}.nc").attrs["reading_remarks"]
    page = (tmp_path / f"{name}.html").read_text(encoding="utf-8")
    assert words.partition(": ")[2][:12] in page


@pytest.mark.parametrize("fault", FAULTS)
def test_export_names_the_channel(folder: Path, tmp_path: Path, fault: str) -> None:
    done = command_here("export", folder / f"{fault}.nc", "--out", tmp_path / "a.nc")
    assert done.returncode == 0, done.stderr
    assert FAULTS[fault][1] in done.stderr
    assert FAULTS[fault][1] in va.open_results(tmp_path / "a.nc").attrs["reading_remarks"]


@pytest.mark.parametrize("fault", FAULTS)
def test_a_campaign_omits_the_recording(folder: Path, tmp_path: Path, fault: str) -> None:
    files = [folder / "good.nc", folder / f"{fault}.nc", folder / "other.nc"]
    done = command_here("orders", *files, *SPEED, "--orders", "1", "--out", tmp_path, "--json")
    assert done.returncode == 3, done.stderr
    (line,) = json.loads(done.stdout)["warnings"]
    assert line.startswith(f"{files[1]} is omitted: {FAULTS[fault][1]}")


def test_a_file_again_is_named(folder: Path, tmp_path: Path) -> None:
    copy = tmp_path / "copy.nc"
    shutil.copy(folder / "good.nc", copy)
    files = [folder / "good.nc", folder / "other.nc", copy]
    done = command_here("orders", *files, *SPEED, "--orders", "1", "--out", tmp_path)
    assert done.returncode == 3, done.stderr
    assert f"{copy} is omitted: has the bytes of {files[0]}" in done.stderr
    for words in ([files[0], copy], [files[0], files[1], "--background", copy]):
        done = command_here("sound-power", *words, "--hemisphere", 1.0, "--out", tmp_path)
        assert done.returncode == 0, done.stderr
        line = "copy.nc: has the bytes of good.nc: record each position"
        assert f"warning: {line}" in done.stderr
        assert line in va.open_results(tmp_path / "sound_power.nc").attrs["reading_remarks"]


def test_all_broken_microphones_are_refused_together(folder: Path, tmp_path: Path) -> None:
    broken = [tmp_path / "a.nc", tmp_path / "b.nc", tmp_path / "c.nc"]
    broken[0].write_bytes(b"")
    words = [broken[0], folder / "good.nc", broken[1], "--background", broken[2]]
    done = command_here("sound-power", *words, "--hemisphere", 1.0, "--out", tmp_path / "out")
    for file in broken:
        assert_refused(done, f"{file}: ")
    assert len(done.stderr.splitlines()) == 3
    assert not (tmp_path / "out").exists()
