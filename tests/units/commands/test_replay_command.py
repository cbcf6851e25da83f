"""The command `replay`: sounds at one scale, levels, what stays, refusals."""

import csv
import html
import json

import numpy as np
import pytest
from scipy.io import wavfile
from support import assert_refused, command_here, tiny_run, without_warnings

import vibroacoustics as va
from vibroacoustics.results.storage import write_results

RATE_HZ = 8000
OPTION, RESPONSE = "counterweight-half", "front_1m"
ANGLE = 2.0 * np.pi * 2900.0 / 60.0 * np.arange(6 * RATE_HZ) / RATE_HZ


@pytest.fixture(scope="module")
def study():
    return tiny_run()


@pytest.fixture(scope="module")
def folder(study, tmp_path_factory):
    folder = tmp_path_factory.mktemp("replay")
    write_results(study, folder / "results.nc")
    noise = 1e-4 * np.random.default_rng(2).standard_normal(ANGLE.size)
    sound = noise + 0.05 * np.cos(ANGLE) + 0.02 * np.cos(7.5 * ANGLE)
    signals, units = [sound, sound, 0.0 * sound + 2.0], ["Pa", "m/s²", "Pa"]
    recording = va.label_recording(signals, RATE_HZ, ["mic", "foot", "dead"], units)
    va.export_recording(recording, folder / "machine.csv")
    return folder


def words(folder, *further, pair=f"mic={RESPONSE}", option=OPTION, rpm=2900):
    return [
        "replay", folder / "machine.csv", "--results", folder / "results.nc", "--option", option,
        "--pair", pair, "--rpm", rpm, *further,
    ]  # fmt: skip


@pytest.fixture(scope="module")
def done(folder):
    out = folder / "out"
    outcome = command_here(*words(folder, "--out", out, "--json"))
    assert outcome.returncode == 0, outcome.stderr
    return out, json.loads(outcome.stdout)


def test_sounds_have_one_scale_and_the_changed_order(done, study):
    out, _ = done
    files = sorted(path.name for path in out.glob("*.wav"))
    assert files == ["mic_after_0.5Pa.wav", "mic_before_0.5Pa.wav"]
    (_, after), (_, before) = (wavfile.read(out / name) for name in files)
    pressure = study["pressure_line"].sel(receiver=RESPONSE, line="order 1").isel(speed=0)
    peaks = pressure.sum("sound_source")
    ratio = (peaks.sel(option=OPTION) / peaks.sel(option="none")).item()
    wanted = 0.05 * np.real((ratio - 1.0) * np.exp(1j * ANGLE))
    np.testing.assert_allclose(0.5 * (after - before), wanted, atol=2e-3 * abs(wanted).max())
    read = va.read_recording(out / files[0])["signal"]
    assert read["channel_unit"].values == ["Pa"]


def test_envelope_page_and_tables(done):
    out, envelope = done
    lines = envelope["tables"]["replay_lines"]
    changes = dict(zip(lines["line"], lines["change_db"], strict=True))
    rows = list(csv.DictReader((out / "replay_lines.csv").open(encoding="utf-8")))
    assert float(rows[0]["change_db"]) == pytest.approx(changes["order 1"], abs=1e-6)
    change = next(
        each
        for each in envelope["numbers"]
        if each["variable"] == "replayed_line_change" and each["selection"]["line"] == "order 1"
    )
    assert change["unit"] == "dB"
    assert change["value"] == pytest.approx(changes["order 1"], abs=1e-6)
    totals = envelope["tables"]["replay_totals"]
    level = dict(zip(totals["weighting"], totals["before_db"], strict=True))["Z"]
    expected = 10.0 * np.log10((0.05**2 + 0.02**2) / 2.0 / 4e-10)
    assert level == pytest.approx(expected, abs=0.01)
    page = html.unescape((out / "replay.html").read_text(encoding="utf-8"))
    assert page.count("<audio controls") == 2
    assert 'src="mic_before_0.5Pa.wav"' in page
    assert "media-src 'self'" in page
    assert page.count('data-blind="panel"') == 1
    assert envelope["tables"]["replay_unchanged"]["reason"] == []  # orders above 1 are rounding


def test_an_accelerometer_on_a_foot(folder, study, tmp_path):
    """Beside a microphone: its own scale, unit, reference and ratio, that of the rigid body."""
    response = "foot acceleration rear_left z"
    outcome = command_here(
        *words(folder, "--pair", f"foot={response}", "--out", tmp_path / "out", "--json")
    )
    assert outcome.returncode == 0, outcome.stderr
    file = "foot_after_0.1m_s2.wav"
    names = sorted(path.name for path in (tmp_path / "out").glob("foot*.wav"))
    assert names == [file, "foot_before_0.1m_s2.wav"]
    read = va.read_recording(tmp_path / "out" / file)["signal"]
    assert read["channel_unit"].values == ["m/s²"]
    velocity = study["velocity_order"].sum("source").isel(speed=0).sel(order=1)
    motion = velocity.transpose("option", "dof").values
    offset = study["foot_position"].sel(foot="rear_left").values
    vertical = motion[:, 2] + motion[:, 3] * offset[1] - motion[:, 4] * offset[0]  # v + w × r
    peaks = dict(zip(study["option"].values.tolist(), vertical, strict=True))
    change = 20.0 * np.log10(abs(peaks[OPTION] / peaks["none"]))
    envelope = json.loads(outcome.stdout)
    lines = envelope["tables"]["replay_lines"]
    rows = dict(zip(zip(lines["channel"], lines["line"], strict=True), lines["change_db"],
                    strict=True))  # fmt: skip
    assert rows["foot", "order 1"] == pytest.approx(change, abs=0.01)
    before = dict(zip(lines["channel"], lines["before_db"], strict=True))
    levels = {"mic": 2e-5, "foot": 1e-6}
    for channel, reference in levels.items():
        expected = 20.0 * np.log10(0.05 / np.sqrt(2.0) / reference)
        assert before[channel] == pytest.approx(expected, abs=0.01)
    totals = envelope["tables"]["replay_totals"]
    held = dict(zip(zip(totals["channel"], totals["weighting"], strict=True), totals["before_db"],
                    strict=True))  # fmt: skip
    assert held["foot", "A"] is None
    assert held["foot", "Z"] - held["mic", "Z"] == pytest.approx(20.0 * np.log10(20.0), abs=1e-6)
    page = (tmp_path / "out" / "replay.html").read_text(encoding="utf-8")
    assert "dB re 20 µPa (mic), 1 µm/s² (foot)" in page


REFUSED = {
    "unit": ({"pair": f"foot={RESPONSE}"}, "channel foot is in m/s², the response in Pa"),
    "moment": ({"pair": "foot=moment x"}, "the response in N m: the units must agree"),
    "ratio": ({"further": ("--shaft-ratio", "0")}, "--shaft-ratio = 0: must be 0.01 to 100"),
    "response": ({"pair": "mic=rear"}, "response = rear: must be one of front_1m"),
    "silent": ({"pair": f"dead={RESPONSE}"}, "channel dead: is silent: all samples are 2 Pa"),
    "pair": ({"pair": "mic"}, "--pair 'mic': must be NAME=VALUE"),
    "option": ({"option": "x"}, "option = x: must be one of counterweight-half"),
    "speed": ({"rpm": 3300}, "the recording has 3300 rpm, the study 2900: they must overlap"),
}


@pytest.mark.parametrize(("changed", "message"), REFUSED.values(), ids=REFUSED)
def test_refused_in_one_line_without_files(folder, tmp_path, changed, message):
    further = changed.get("further", ())
    changed = {name: value for name, value in changed.items() if name != "further"}
    outcome = command_here(*words(folder, "--out", tmp_path / "out", *further, **changed))
    assert_refused(without_warnings(outcome), message)  # a channel is dead
    assert not (tmp_path / "out").exists()
