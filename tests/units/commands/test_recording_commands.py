"""Commands for recordings: track, map, export."""

import csv

import numpy as np
import pytest
from scipy.io import wavfile
from support import assert_refused, command_here

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError

RATE_HZ = 2048.0
TIME_S = np.arange(int(6.0 * RATE_HZ)) / RATE_HZ
SHAFT_HZ = 20.0 + 4.0 * TIME_S
ANGLE = 2.0 * np.pi * (20.0 * TIME_S + 2.0 * TIME_S**2)
PEAKS = {1.0: 1.0 + 0.2 * TIME_S, 3.0: 0.5 + 0.0 * TIME_S}


@pytest.fixture(scope="module")
def recording():
    signal = sum(peak * np.cos(order * ANGLE + order) for order, peak in PEAKS.items())
    return va.label_recording(
        [signal, 0.02 * signal, 60.0 * SHAFT_HZ], RATE_HZ, ["ring", "front", "speed"],
        ["m/s²", "Pa", "rpm"],
    )  # fmt: skip


@pytest.fixture(scope="module")
def file(recording, tmp_path_factory):
    return va.export_recording(recording, tmp_path_factory.mktemp("recordings") / "run_up.csv")


def test_track_gives_the_envelopes(file, tmp_path):
    outcome = command_here(
        "track", file, "--speed-channel", "speed", "--orders", "1,3", "--bandwidth", 2,
        "--out", tmp_path,
    )  # fmt: skip
    assert outcome.returncode == 0, outcome.stderr
    assert "bandwidth: 2 Hz, 2 poles" in outcome.stdout
    tracked = va.open_results(tmp_path / "tracked_orders.nc")
    found = tracked["tracked_order"].sel(channel="ring")
    for order, peak in PEAKS.items():
        wanted = np.interp(found["track_time"], TIME_S, peak) * np.exp(1j * order)
        np.testing.assert_allclose(found.sel(order=order), wanted, atol=0.01)
    speed = np.interp(tracked["track_time"], TIME_S, 60.0 * SHAFT_HZ)
    np.testing.assert_allclose(tracked["track_speed"], speed, rtol=1e-4)
    rows = list(csv.DictReader((tmp_path / "tracked_orders.csv").open(encoding="utf-8")))
    assert len(rows) == 2 * 2 * tracked.sizes["track_time"]
    assert rows[0]["channel"] == "ring"
    assert (tmp_path / "tracked_1_ring.svg").read_bytes().startswith(b"<svg")


def test_map_shows_orders_and_levels(file, tmp_path):
    outcome = command_here(
        "map", file, "--speed-channel", "speed", "--resolution", 8, "--maximum-frequency", 300,
        "--out", tmp_path,
    )  # fmt: skip
    assert outcome.returncode == 0, outcome.stderr
    mapped = va.open_results(tmp_path / "speed_map.nc")
    assert mapped["map_frequency"].max() <= 300.0
    loudest = abs(mapped["speed_frequency_map"].sel(channel="ring")).idxmax("map_frequency")
    step = float(mapped["map_frequency"][1])
    assert np.all(abs(loudest - mapped["block_speed"] / 60.0) <= step)
    # 0.02 Pa (1 + 0.2 t) and 0.01 Pa, peak: all in the level, lines above 300 Hz too
    power = sum(np.interp(mapped["block_time"], TIME_S, peak) ** 2 for peak in PEAKS.values())
    level = mapped["block_level"].sel(channel="front", weighting="Z")
    np.testing.assert_allclose(level, 10.0 * np.log10(2e-4 * power / (20e-6) ** 2), atol=0.2)
    assert mapped["block_level"].sel(channel="ring").isnull().all()
    pictures = {file.name for file in tmp_path.glob("*.svg")}
    assert pictures == {"speed_map_1_ring.svg", "speed_map_2_front.svg", "levels_2_front.svg"}


@pytest.mark.parametrize(
    ("channel", "label", "reference"),
    [("front", "dB re 20 µPa", np.sqrt(2.0) * 20e-6), ("ring", "dB re 1 m/s² peak", 1.0)],
)
def test_maps_say_their_reference(recording, channel, label, reference):
    """A level of sound pressure is of the effective value."""
    speed = va.SpeedChannel("speed")
    mapped = va.speed_frequency_map(recording, speed, resolution_hz=8.0)
    settings = va.OrderAnalysis(speed, (1.0,), maximum_order=4.0, with_map=True)
    orders = va.analyse_orders(recording, settings)
    for figure, values in (
        (va.plot.speed_frequency_map(mapped, channel), mapped["speed_frequency_map"]),
        (va.plot.order_map(orders, channel), orders["order_map"]),
    ):
        panel, bar = figure.axes
        assert bar.get_ylabel() == label
        shown = panel.collections[0].get_array()
        top = abs(values.sel(channel=channel)).max().item()
        assert shown.max() == pytest.approx(20.0 * np.log10(top / reference), abs=1e-9)


@pytest.mark.parametrize("name", ["out.csv", "out.nc", "out.wav"])
def test_export_is_read_back(file, recording, tmp_path, name):
    outcome = command_here("export", file, "--out", tmp_path / name)
    assert outcome.returncode == 0, outcome.stderr
    names = {f"channel {number}" for number in (1, 2, 3)}
    told = name.endswith(".wav") and {
        "units": dict(zip(sorted(names), ["m/s²", "Pa", "rpm"], strict=True)),
        "calibration": dict.fromkeys(names, 1.0),
    }
    again = va.read_recording(tmp_path / name, **(told or {}))
    np.testing.assert_array_equal(again["signal"].values, recording["signal"].values)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("track", "--bandwidth", 2), "speed: give one of"),
        (
            ("track", "--bandwidth", 0, "--speed-channel", "speed"),
            "--bandwidth = 0 Hz: must be above 0",
        ),
        (("track", "--bandwidth", 2, "--rpm", 1200, "--orders", "1,x"), "'x' is no number"),
        (
            ("track", "--bandwidth", 2, "--rpm", 1200, "--orders", "0"),
            "--orders = 0: must be 0.001 to 10000",
        ),
        (
            ("track", "--bandwidth", 2, "--rpm", 1200, "--poles", 4),
            "--poles = 4: must be 1, 2 or 3",
        ),
        (
            ("map", "--speed-channel", "speed", "--resolution", 0),
            "--resolution = 0 Hz: must be ",
        ),
        (
            ("map", "--speed-channel", "speed", "--maximum-frequency", 0),
            "--maximum-frequency = 0 Hz",
        ),
        (("export", "--out", "x.mp3"), "x.mp3: ending '.mp3': must be .csv, .nc or .wav"),
    ],
)
def test_bad_words_are_one_line(file, words, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert_refused(command_here(words[0], file, *words[1:]), message)
    assert not list(tmp_path.rglob("*.nc"))


def test_a_part_is_exported(file, recording, tmp_path):
    outcome = command_here(
        "export", file, "--from", 1.0, "--to", 2.5, "--channels", "front", "--out",
        tmp_path / "part.nc",
    )  # fmt: skip
    assert outcome.returncode == 0, outcome.stderr
    part = va.read_recording(tmp_path / "part.nc")
    wanted = recording["signal"].sel(channel=["front"]).values[:, 2048:5120]
    np.testing.assert_array_equal(part["signal"].values, wanted)


def test_messages_name_the_options(tmp_path):
    """The same from Python speaks of Python's arguments."""
    wav = tmp_path / "a.wav"
    wavfile.write(wav, 2048, np.zeros(99, dtype="float32"))
    assert_refused(
        command_here("export", wav, "--out", tmp_path / "b.csv"), '--unit "channel 1=Pa"'
    )
    with pytest.raises(ParameterError, match=r"units=\{'channel 1': 'Pa'\}"):
        va.read_recording(wav)
    wavfile.write(wav, 2048, np.arange(99, dtype="int16"))
    words = ("export", wav, "--unit", "channel 1=Pa", "--out", tmp_path / "b.csv")
    assert_refused(command_here(*words), '--calibration "channel 1=20"')
    assert_refused(
        command_here(*words, "--calibration", "front=2"), "--calibration: no channel 'front'"
    )
    table = tmp_path / "a.csv"
    table.write_text("a [Pa]\n1\n2\n")
    refusal = command_here("export", table, "--out", tmp_path / "b.csv")
    assert_refused(refusal, "or give --sample-rate")


def test_a_wav_file_needs_whole_hertz(tmp_path):
    recording = va.label_recording([[0.0, 1.0]], 0.5, ["a"], ["V"])
    with pytest.raises(ParameterError, match=r"x\.wav: sample_rate_hz"):
        va.export_recording(recording, tmp_path / "x.wav")
