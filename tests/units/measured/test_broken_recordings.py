"""Campaigns with broken recordings: the others are averaged, every broken one is named."""

import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import vibroacoustics as va
from vibroacoustics.base.arrays import Array
from vibroacoustics.base.fault import LeftOutWarning

RATE_HZ = 3200.0
SAMPLES = 3200
CAMPAIGN = va.Campaign(
    speed={"nominal_rpm": 3000.0}, analysis={"orders": (1.0,), "maximum_order": 4.0}
)


def sound(number: int, samples: int = SAMPLES) -> Array:
    """Two microphones: order 1 at 3000 rpm in noise, shape (channel, time)."""
    noise = np.random.default_rng(number).standard_normal((2, samples))
    tone = np.cos(2.0 * np.pi * 50.0 * np.arange(samples) / RATE_HZ)
    return np.asarray((1.0 + 0.01 * number) * tone + 0.1 * noise)


def write(file: Path, signal: Array, rate_hz: float = RATE_HZ, unit: str = "Pa") -> Path:
    """Write a WAV file that states its unit."""
    names = [f"channel {number}" for number in range(len(signal))]
    labelled = va.label_recording(signal, rate_hz, names, [unit] * len(signal))
    return va.export_recording(labelled, file)


def changed(channel: int, value: float | Array) -> Array:
    signal = sound(77)
    signal[channel] = value
    return signal


def truncated(file: Path) -> None:
    content = write(file, sound(77)).read_bytes()
    file.write_bytes(content[: len(content) // 2])


def with_nan(file: Path) -> None:
    content = bytearray(write(file, sound(77)).read_bytes())
    start = content.index(b"data") + 8 + 1600
    content[start : start + 8] = np.array([np.nan]).tobytes()
    file.write_bytes(bytes(content))


def last_bit(file: Path) -> None:
    """Both channels in 16 bits, of which the second has noise of the last bit alone."""
    from scipy.io import wavfile

    from vibroacoustics.recordings.riff import scale_comment, with_comment

    noise = np.random.default_rng(3).integers(-1, 2, SAMPLES)
    stored = np.stack([16384 * sound(77)[0] / 1.5, noise]).astype(np.int16)
    wavfile.write(file, int(RATE_HZ), stored.T)
    file.write_bytes(with_comment(file.read_bytes(), scale_comment([(3.0, "Pa")] * 2)))


BROKEN: dict[str, tuple[Callable[[Path], object], str]] = {
    "truncated": (truncated, "truncated"),
    "empty": (lambda file: file.write_bytes(b""), "is empty"),
    "wrong_format": (lambda file: file.write_text("no recording\n" * 40), "RIFF"),
    "missing_channel": (
        lambda file: write(file, sound(77)[:1]),
        "has the channels channel 1 [Pa]; most recordings have channel 1 [Pa], channel 2 [Pa]",
    ),
    "other_unit": (lambda file: write(file, sound(77), unit="m/s²"), "channel 1 [m/s²]"),
    "not_finite": (with_nan, "samples are not finite"),
    "dead": (
        lambda file: write(file, changed(1, 0.01)),
        "channel 'channel 2': is dead: all 3200 samples are 0.01 Pa",
    ),
    "last_bit": (last_bit, "channel 'channel 2': is dead: varies by 0.000183 Pa, the last bit"),
    "far_below": (
        lambda file: write(file, changed(1, 1e-6 * sound(5)[0])),
        "channel 'channel 2': is dead: 125 dB below every other channel of its unit",
    ),
    "beyond": (
        lambda file: write(file, changed(0, 1e30)),
        "channel 'channel 1': reaches 1e+30 Pa: a sensor of sound pressure gives at most 2e+05 Pa",
    ),
    "copied": (lambda file: shutil.copy(file.with_name("good_0.wav"), file), "has the bytes of"),
    "saved_again": (
        lambda file: va.export_recording(va.read_recording(file.with_name("good_1.wav")), file),
        "has the",
    ),
    "slower": (
        lambda file: write(file, sound(77)[:, ::2], RATE_HZ / 2.0),
        "sample rate = 1600 Hz: lacks the third octaves from 800 Hz",
    ),
    "too_short": (lambda file: write(file, sound(77, 20)), "orders need at least 1: record longer"),
    "absent": (lambda _: None, "no such file"),
}
"""How a recording is broken, and words of the reason."""


def _files(folder: Path, count: int) -> tuple[list[Path], list[Path]]:
    """Good recordings, and one for every way to be broken."""
    good = [write(folder / f"good_{number}.wav", sound(number)) for number in range(count)]
    broken = [folder / f"{name}.wav" for name in BROKEN]
    for file in broken:
        BROKEN[file.stem][0](file)
    return good, broken


def test_the_others_are_averaged_and_each_is_named(tmp_path: Path) -> None:
    good, broken = _files(tmp_path, 8)
    mixed = [file for pair in zip(good, broken, strict=False) for file in pair] + broken[8:]
    assert sorted(mixed) == sorted([*good, *broken])
    with pytest.warns(LeftOutWarning) as warned:
        mean = va.analyse_campaign(mixed, CAMPAIGN.run_of)
    assert mean.equals(va.analyse_campaign(good, CAMPAIGN.run_of))
    lines = [str(each.message) for each in warned]
    assert len(lines) == len(broken)
    for file, line in zip(broken, lines, strict=True):
        assert line.startswith(f"{file} is omitted: "), line
        assert BROKEN[file.stem][1] in line, line


def test_a_fault_that_all_recordings_share_is_a_warning(tmp_path: Path) -> None:
    """Such as a transducer of static pressure in Pa: the campaign is no less a mean."""
    files = []
    for number in range(3):
        signal = sound(number)
        signal[1] *= 1e6
        files.append(write(tmp_path / f"{number}.wav", signal))
    with pytest.warns(va.RecordingWarning, match="sensor of sound pressure") as warned:
        mean = va.analyse_campaign(files, CAMPAIGN.run_of)
    assert mean.sizes["run"] == len(warned) == 3


def test_a_channel_far_below_itself_in_other_recordings(tmp_path: Path) -> None:
    """A microphone alone: no other channel says that its cable is loose."""
    files = [write(tmp_path / f"{number}.wav", sound(number)[:1]) for number in range(3)]
    loose = write(tmp_path / "loose.wav", 3e-4 * sound(9)[:1])
    quiet = write(tmp_path / "quiet.wav", 3e-3 * sound(8)[:1])
    with pytest.warns(LeftOutWarning, match="70 dB below its median") as warned:
        mean = va.analyse_campaign([*files, loose, quiet], CAMPAIGN.run_of)
    assert [str(each.message).partition(" is")[0] for each in warned] == [str(loose)]
    assert mean.sizes["run"] == 4


def test_no_recording_of_a_half_is_omitted(tmp_path: Path) -> None:
    """Neither half lacks what most have: the mean has what all have, as ever."""
    slow = [
        write(tmp_path / f"slow_{n}.wav", sound(n)[:, ::2], RATE_HZ / 2.0, "Pa") for n in (0, 1)
    ]
    quick = [write(tmp_path / f"quick_{n}.wav", sound(n)) for n in (2, 3)]
    mean = va.analyse_campaign([*slow, *quick], CAMPAIGN.run_of)
    assert mean.sizes["run"] == 4
    assert mean["band"].max() == 630.0


def test_a_process_that_ends_at_a_recording_costs_that_recording(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from vibroacoustics.measured import campaign

    files = [write(tmp_path / f"{number}.wav", sound(number)) for number in range(3)]

    def lost(function, items, on_loss):
        return (on_loss(run, "SIGKILL") if run.file == files[1] else function(run) for run in items)

    monkeypatch.setattr(campaign, "side_by_side", lost)
    with pytest.warns(LeftOutWarning, match=r"1\.wav is omitted: two processes .* \(SIGKILL\)"):
        mean = va.analyse_campaign(files, CAMPAIGN.run_of)
    assert mean.sizes["run"] == 2


@pytest.mark.long
def test_fifteen_of_a_hundred_are_omitted(tmp_path: Path) -> None:
    good, broken = _files(tmp_path, 100 - len(BROKEN))
    command = [sys.executable, "-m", "vibroacoustics", "orders", *good, *broken, "--rpm", "3000",
               "--orders", "1", "--maximum-order", "4", "--out", tmp_path / "out"]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 3, done.stderr
    for file in broken:
        assert f"warning: {file} is omitted: " in done.stderr
    alone = va.analyse_campaign(good, CAMPAIGN.run_of)
    assert va.open_results(tmp_path / "out" / "campaign.nc").equals(alone)
