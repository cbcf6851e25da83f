"""Sound files of a run: gain, names, calibration tone, and what is refused."""

import io

import numpy as np
import pytest
from scipy.io import wavfile
from support import assert_refused, command_here

import vibroacoustics as va
from vibroacoustics.sound import files
from vibroacoustics.sound.rendering import rendered


def pascal(path, full_scale):
    rate, samples = wavfile.read(path)
    assert rate == 48000
    assert samples.dtype == np.float32
    return samples.astype(float) * full_scale


def test_files_hold_the_sound_at_one_stated_gain(tmp_path, results):
    paths = va.listen(results, tmp_path, ["none", "lanchester"], duration_s=1.0)
    full_scale = files.full_scale_of(results)
    assert [path.name for path in paths] == [
        f"{option}_front_1m_900rpm_{full_scale:g}Pa.wav" for option in ("none", "lanchester")
    ]
    sound = pascal(paths[1], full_scale)
    parts = va.sound.ingredients(results, "lanchester", "front_1m", 900.0)
    np.testing.assert_allclose(sound, rendered(parts, sound.size), atol=1e-6)
    assert {path.name for path in tmp_path.iterdir()} == {p.name for p in paths}


def test_the_calibration_tone_has_its_level(tmp_path, results):
    (tone, _) = va.listen(results, tmp_path, ["none"], duration_s=1.0, calibration_db=94.0)
    assert tone.name == "calibration_1kHz_94dB_20Pa.wav"
    sound = pascal(tone, 20.0)
    assert 10.0 * np.log10(np.mean(sound**2) / 4e-10) == pytest.approx(94.0, abs=1e-3)
    assert np.argmax(np.abs(np.fft.rfft(sound))) == 1000


def test_no_option_exceeds_full_scale(results):
    full_scale = files.full_scale_of(results)
    for option in results["option"].values:
        for receiver in results["receiver"].values:
            parts = va.sound.ingredients(results, str(option), str(receiver), 1200.0)
            assert np.abs(rendered(parts, 96000)).max() < full_scale
    assert files.full_scale_of(results, 140.0) == 500.0
    silent = results.copy()
    silent["pressure_line"] = 0.0 * silent["pressure_line"]
    for name in ("noise_band_level", "unmodelled_band_level"):
        silent[name] = 0.0 * silent[name] - 300.0
    quiet = silent.drop_vars(["baseline_band_level", "baseline_order_level"])
    assert files.full_scale_of(quiet) == 2e-5


@pytest.mark.parametrize("kind", ["wav", "flac"])
def test_a_file_states_its_full_scale_to_who_reads_it(tmp_path, results, kind):
    if kind == "flac":
        pytest.importorskip("soundfile")
    (path,) = va.listen(results, tmp_path, ["none"], duration_s=1.0, file_format=kind)
    found = va.read_recording(path)["signal"]
    assert found["channel_unit"].values == ["Pa"]
    parts = va.sound.ingredients(results, "none", "front_1m", 900.0)
    expected = rendered(parts, found.sizes["time"])
    full_scale = files.full_scale_of(results)
    np.testing.assert_allclose(found.values[0], expected, atol=2.0**-23 * full_scale)


def test_flac_holds_24_bits():
    soundfile = pytest.importorskip("soundfile")
    sound = 0.5 * np.sin(0.1 * np.arange(4800))
    content = files.flac_bytes(sound, 48000, 20.0)
    again, rate = soundfile.read(io.BytesIO(content))
    assert rate == 48000
    np.testing.assert_allclose(again, sound, atol=2.0**-23)


def test_the_command_writes_and_names_the_files(tmp_path, results_file):
    out = tmp_path / "sound"
    outcome = command_here(
        "listen", results_file, "--option", "none", "--microphone", "side_1m", "--speed", 950,
        "--seconds", 1, "--calibration", 80, "--out", out, "--full-scale", 50,
    )  # fmt: skip
    assert outcome.returncode == 0, outcome.stderr
    names = [line.rpartition("/")[2] for line in outcome.stdout.splitlines()]
    assert names == ["calibration_1kHz_80dB_50Pa.wav", "none_side_1m_950rpm_50Pa.wav"]
    assert all((out / name).is_file() for name in names)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"options": ["pendulum"]}, r"option = pendulum: the results hold no such one"),
        ({"speeds": [1.0]}, r"speed = 1.0 rpm: the results hold no such one"),
        ({"full_scale_pa": 0.1}, r"full scale = 0.1 Pa: the sound reaches"),
        ({"full_scale_pa": -1.0}, r"full scale = -1 Pa: must be above 0, up to 100 kPa"),
        ({"calibration_db": 150.0}, r"calibration = 150 dB: must be 0 to 140 dB"),
        ({"file_format": "mp3"}, r"format = mp3: must be one of wav, flac"),
    ],
)
def test_what_cannot_be_is_refused_and_nothing_is_written(tmp_path, results, asked, said):
    with pytest.raises(va.ParameterError, match=said):
        va.listen(results, tmp_path / "sound", **{"duration_s": 1.0, **asked})
    assert not (tmp_path / "sound").exists()


def test_the_command_refuses_in_one_line(tmp_path, results_file):
    out = tmp_path / "sound"
    outcome = command_here("listen", results_file, "--seconds", 0.5, "--out", out)
    assert_refused(outcome, "results.nc", "--seconds = 0.5 s: must be 1 to 600 s")
    assert not out.exists()


def test_without_soundfile_one_line_says_what_to_install(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "soundfile", None)
    with pytest.raises(va.ParameterError, match=r"pip install 'vibroacoustics\[sound\]'"):
        files.flac_bytes(np.zeros(10), 48000, 1.0)


def test_tones_of_a_sound_file(tmp_path, results):
    (path,) = va.listen(results, tmp_path, ["none"], speeds=[1200.0], duration_s=4.0)
    factor = ("--unit", "channel 1=Pa", "--calibration", "channel 1=20")
    outcome = command_here("tones", path, *factor)
    assert outcome.returncode == 0, outcome.stderr
    assert "channel 1: no tone exceeds the noise of its critical band" in outcome.stdout
    assert_refused(command_here("tones", path, *factor, "--to", 1), "tones need at least 3 s")
    assert_refused(command_here("tones", path, "--unit", "channel 1=V"), "none is in Pa")
