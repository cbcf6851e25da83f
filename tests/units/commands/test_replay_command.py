"""The command `replay`: sounds at one scale, levels, what stays, refusals."""

import csv
import html
import json

import numpy as np
import pytest
from scipy.io import wavfile
from support import assert_refused, command_here, tiny_run

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
    recording = va.label_recording([sound, sound], RATE_HZ, ["mic", "foot"], ["Pa", "m/s²"])
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
    unchanged = envelope["tables"]["replay_unchanged"]
    assert "below the recording's noise" in unchanged["reason"]


REFUSED = {
    "unit": ({"pair": f"foot={RESPONSE}"}, "channel foot is in m/s², the response in Pa"),
    "response": ({"pair": "mic=rear"}, "response = rear: must be one of front_1m"),
    "pair": ({"pair": "mic"}, "--pair 'mic': must be NAME=VALUE"),
    "option": ({"option": "x"}, "option = x: must be one of counterweight-half"),
    "speed": ({"rpm": 3300}, "add to its speed_rpm: 3300"),
}


@pytest.mark.parametrize(("changed", "message"), REFUSED.values(), ids=REFUSED)
def test_refused_in_one_line_without_files(folder, tmp_path, changed, message):
    outcome = command_here(*words(folder, "--out", tmp_path / "out", **changed))
    assert_refused(outcome, message)
    assert not (tmp_path / "out").exists()
