"""Settings of a campaign: labels from names, settings of a file, what is refused."""

from pathlib import Path

import numpy as np
import pytest

import vibroacoustics as va

TONE = np.sin(2.0 * np.pi * 1000.0 * np.arange(40_000) / 20_000.0)


def load(tmp_path: Path, text: str) -> va.Campaign:
    file = tmp_path / "campaign.toml"
    file.write_text(text, encoding="utf-8")
    return va.load_campaign(file)


def test_everything_that_a_file_may_say(tmp_path: Path) -> None:
    calibrator = va.label_recording([0.02 * TONE], 20_000.0, ["1"], ["V"])
    va.export_recording(calibrator, tmp_path / "calibrator.csv")
    campaign = load(
        tmp_path,
        """
        [channels]
        "1" = { name = "front", calibrator_file = "calibrator.csv" }
        "2" = { name = "shell", unit = "g", calibration = 10 }
        "3" = { name = "tacho", unit = "V" }
        [calibrator]
        level_db = 114
        [recording]
        sample_rate_khz = 51.2
        from_s = 1
        [speed]
        channel = "tacho"
        pulses_per_revolution = 2
        [analysis]
        orders = [0.5, 1]
        resolution_order = 0.125
        [files."{machine}/run_{run}.wav"]
        [files."old_*.wav"]
        machine = "old"
        run = "first"
        channels.2 = { calibration = 20 }
        speed = { nominal_rpm = 2900 }
        recording = { to_s = 5 }
        """,
    )
    run = campaign.run_of(Path("campaign/C 7/run_02.wav"))
    assert (run.machine, run.run, run.label) == ("C 7", "02", "C 7: 02")
    assert run.reading["units"] == {"1": "Pa", "2": "g", "3": "V"}
    assert run.reading["names"] == {"1": "front", "2": "shell", "3": "tacho"}
    assert run.reading["channels"] == ["1", "2", "3"]
    # 114 dB are 10.02 Pa, a peak of 14.17 Pa, which the file holds as 0.02
    factor = np.sqrt(2.0) * 2e-5 * 10.0**5.7 / 0.02
    assert run.reading["calibration"] == {"1": pytest.approx(factor, rel=1e-4), "2": 10.0}
    part = {name: run.reading[name] for name in ("sample_rate_hz", "from_s", "to_s")}
    assert part == {"sample_rate_hz": 51_200.0, "from_s": 1.0, "to_s": None}
    tacho = va.SpeedChannel("tacho", pulses_per_revolution=2)
    assert run.analysis == va.OrderAnalysis(tacho, (0.5, 1.0), resolution_order=0.125)

    old = campaign.run_of(Path("old_a.wav"))
    assert (old.machine, old.run) == ("old", "first")
    assert old.analysis.speed == va.NominalSpeed(2900.0)
    assert old.reading["names"]["2"] == "shell"
    assert old.reading["calibration"]["2"] == 20.0
    assert (old.reading["sample_rate_hz"], old.reading["to_s"]) == (None, 5.0)


def test_without_patterns_all_runs_are_of_one_machine(tmp_path: Path) -> None:
    campaign = load(tmp_path, 'channels."*" = { unit = "Pa" }\nspeed.nominal_rpm = 2900')
    run = campaign.run_of(tmp_path / "a.wav")
    assert (run.machine, run.run, run.label) == ("1", "a", "a")
    assert run.reading["channels"] is None


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("channels.a = { unt = 'Pa' }", "channels.a.unt: unknown key, did you mean unit"),
        ("calibrator.level_db = 20", "calibrator.level_db = 20 dB: out of range; allowed from 60"),
        ("channels.a = { calibration = 1, calibrator_file = 'b' }", "channels.a: give one of"),
        ("channels.a = { unit = 'V', calibrator_file = 'b' }", "unit = V: must be Pa"),
        ("speed = { nominal_rpm = 1, channel = 't' }", "speed: give one of channel, nominal_rpm"),
        ("speed = { minimum_rpm = 1 }", "speed: minimum_rpm and maximum_rpm belong together"),
        ("speed = { minimum_rpm = 2, maximum_rpm = 1 }", "speed: minimum_rpm = 2 rpm: must be bel"),
        ("speed = { nominal_rpm = 1, edge = 'rising' }", "speed: edge: belong to a tacho"),
        ("speed = { channel = 't', mains_hz = 50 }", "speed: comb, mains_hz: belong to"),
        ("analysis.orders = [2, 1]", "analysis: orders = (2.0, 1.0): must be"),
        ("files.'{machine}.wav'.machine = 'a'", "gives the label machine twice"),
        ("files.'a.wav'.speed.nominal_rpm = -1", "nominal_rpm = -1 rpm: out of range"),
    ],
)
def test_what_is_refused_in_a_line(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(va.ParameterError) as refusal:
        load(tmp_path, text)
    assert str(refusal.value).startswith(f"{tmp_path / 'campaign.toml'}: ")
    assert words in str(refusal.value)


def test_all_refusals_come_at_once(tmp_path: Path) -> None:
    with pytest.raises(va.ParameterError) as refusal:
        load(tmp_path, "recording.from_s = -1\nanalysis.maximum_order = 0\nspeed.rpm = 1")
    assert len(str(refusal.value).splitlines()) == 3


@pytest.mark.parametrize(
    ("name", "words"),
    [("b_1.wav", "has none of the patterns"), ("a_1.wav", "has the patterns a_*.wav, ?_1.wav")],
)
def test_a_file_has_one_pattern(tmp_path: Path, name: str, words: str) -> None:
    text = "speed.nominal_rpm = 2900\nfiles.'a_*.wav' = {}\nfiles.'?_1.wav' = {}"
    text = text if name == "a_1.wav" else text.replace("?_1", "c")
    with pytest.raises(va.ParameterError, match=name) as refusal:
        load(tmp_path, text).run_of(Path(name))
    assert words in str(refusal.value)


def test_speed_is_asked_for(tmp_path: Path) -> None:
    with pytest.raises(va.ParameterError, match=r"a.wav: speed is missing .* \[speed\]"):
        load(tmp_path, "").run_of(Path("a.wav"))


def test_speed_without_a_tacho() -> None:
    limits = {"minimum_rpm": 2000.0, "maximum_rpm": 4000.0, "mains_hz": 50.0}
    campaign = va.Campaign(speed={**limits, "channel": "front", "comb": (2.0, 4.0)})
    expected = va.TacholessSpeed("front", 2000.0, 4000.0, (2.0, 4.0), 50.0)
    assert campaign.speed_of(Path("a.wav")) == expected
