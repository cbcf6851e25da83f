"""Channels that start or are sampled at different times, on one time line."""

import numpy as np
import offset_channels
import pytest
from offset_channels import FREQUENCY_HZ, RATE_HZ, SAMPLES, WRITERS, sine

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.recordings import open_recording, read_recording
from vibroacoustics.recordings.blocks import hold_recording
from vibroacoustics.recordings.resampling import HALF_LENGTH, band_limited, cubic, spline

UNITS = {"testlab": {}, "mat_structs": {"*": "Pa"}, "mat_names": {"*": "Pa"}}
UNITS["mat_tables"] = {"*": "Pa"}
pytestmark = pytest.mark.filterwarnings(
    "ignore::vibroacoustics.recordings.remarks.RecordingWarning"
)


def read(writer, path, offset_s, **options):
    file = WRITERS[writer](path, offset_s)
    return read_recording(file, units=UNITS.get(writer, {}), **options)


def phase_deg(recording):
    """Phase of the second channel to the first, over the whole periods."""
    rate_hz, signal = recording.attrs["sample_rate_hz"], recording["signal"].values
    wave = np.exp(-2j * np.pi * FREQUENCY_HZ * np.arange(signal.shape[1]) / rate_hz)
    window = np.hanning(signal.shape[1])
    lines = signal @ (wave * window)
    return np.degrees(np.angle(lines[1] / lines[0]))


@pytest.mark.parametrize("writer", WRITERS)
@pytest.mark.parametrize("offset_s", [0.005, 0.3 / RATE_HZ])
def test_channels_of_one_sine_are_in_phase(tmp_path, writer, offset_s):
    """The signals are one sine over a common clock; side by side 5 ms would be 90 degrees.

    Stamps to the microsecond leave 0.018 degrees, an increment of six digits less.
    """
    recording = read(writer, tmp_path, offset_s)
    assert abs(phase_deg(recording)) < 0.05
    first = recording["signal"].values[0]
    cut_s = RATE_HZ * offset_s + HALF_LENGTH + 1
    assert SAMPLES - 2 * cut_s <= first.size < SAMPLES


@pytest.mark.parametrize("writer", WRITERS)
def test_equal_samples_that_start_5_ms_apart_are_90_degrees_apart(tmp_path, writer, monkeypatch):
    monkeypatch.setattr(offset_channels, "sine", lambda _, samples=SAMPLES: sine(0.0, samples))
    assert phase_deg(read(writer, tmp_path, 0.005)) == pytest.approx(-90.0, abs=0.05)


@pytest.mark.parametrize("writer", ["uff", "tdms", "mf4", "testlab", "hdf5", "netcdf"])
@pytest.mark.parametrize("offset_s", [0.005, 0.3 / RATE_HZ])
def test_blocks_are_those_of_the_whole(tmp_path, writer, offset_s):
    file = WRITERS[writer](tmp_path, offset_s)
    whole = read_recording(file)
    blocks = open_recording(file)
    assert blocks.samples == whole.sizes["time"]
    signal = whole["signal"].values
    held = hold_recording(file)
    for first, last in ((0, 100), (101, 377), (blocks.samples - 50, blocks.samples)):
        for recording in (blocks, held):
            a, b = recording.channels
            part = recording.read([b, a], first, last)
            np.testing.assert_array_equal(part, signal[::-1, first:last])
            np.testing.assert_array_equal(recording.read([b], first, last), signal[1:, first:last])
    part = read_recording(file, from_s=0.1, to_s=0.2)
    first = round(0.1 * RATE_HZ)
    np.testing.assert_array_equal(part["signal"].values, signal[:, first : first + 205])


def test_what_is_cut_and_shifted_is_said(tmp_path):
    recording = read("tdms", tmp_path, 0.005)
    remarks = recording.attrs["reading_remarks"]
    assert "the part that all have is read, 0.020" in remarks
    assert "'b': starts -0.24 sampling intervals off the others: band-limited" in remarks
    assert recording.attrs["start_time"].startswith("2026-11-28T10:00:00.02")


def test_channels_without_common_time_are_refused(tmp_path):
    with pytest.raises(Exception, match=r"no common time \('a 0 s to 0.499512 s', 'b 7 s"):
        read("mf4", tmp_path, 7.0)


def test_channels_of_lvm_have_their_own_interval(tmp_path):
    """Every second sample of the second channel, which has half as many."""
    path = WRITERS["lvm"](tmp_path, 0.0)
    head, _, table = path.read_text().rpartition("Comment\n")
    head = head.replace(f"Samples\t{SAMPLES}\t{SAMPLES}", f"Samples\t{SAMPLES}\t{SAMPLES // 2}")
    step = f"{1.0 / RATE_HZ:.12f}"
    head = head.replace(f"{step}\t{step}", f"{step}\t{2.0 / RATE_HZ:.12f}")
    rows = [row.split("\t") for row in table.splitlines()]
    halved = [row[2] for row in rows[::2]] + [""] * (SAMPLES // 2)
    lines = [f"\t{row[1]}\t{value}\n" for row, value in zip(rows, halved, strict=True)]
    path.write_text(f"{head}Comment\n{''.join(lines)}")
    recording = read_recording(path)
    first, second = recording["signal"].values
    assert recording.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ, rel=1e-6)
    np.testing.assert_allclose(second, first, atol=2e-5)


# --- slow channels -------------------------------------------------------------------------------


def run_up(path, suffix, fault=0.0):
    """A microphone at 51.2 kHz and a speed at 100 Hz: 8 times the shaft, amplitude 1."""
    time, slow = np.arange(4 * 51200) / 51200.0, np.arange(400) / 100.0
    speed_rpm = 900.0 + 525.0 * slow
    speed_rpm[30] += fault
    angle = 2.0 * np.pi * (15.0 * time + 0.5 * 8.75 * time**2)
    sound = np.cos(8.0 * angle)
    if suffix == "mf4":
        from asammdf import MDF, Signal

        with MDF(version="4.10") as file:
            file.append([Signal(sound, time, name="mic", unit="Pa")])
            file.append([Signal(speed_rpm, slow, name="speed", unit="rpm")])
            file.save(path / "run.mf4")
        return path / "run.mf4"
    from nptdms import ChannelObject, TdmsWriter

    with TdmsWriter(str(path / "run.tdms")) as writer:
        about = {"unit_string": "Pa", "wf_increment": 1.0 / 51200.0}
        slowly = {"unit_string": "rpm", "wf_increment": 0.01}
        mic = ChannelObject("g", "mic", sound, properties=about)
        writer.write_segment([mic, ChannelObject("g", "speed", speed_rpm, properties=slowly)])
    return path / "run.tdms"


@pytest.mark.parametrize("suffix", ["mf4", "tdms"])
def test_the_order_of_a_run_up_with_a_slow_speed(tmp_path, suffix):
    import vibroacoustics as va

    recording = read_recording(run_up(tmp_path, suffix))
    assert "'speed': samples of 100 Hz are interp" in recording.attrs["reading_remarks"]
    blocks = open_recording(tmp_path / f"run.{suffix}")
    for names in (["speed"], ["mic", "speed"]):
        part = recording["signal"].sel(channel=names).values[:, 70_000:70_100]
        np.testing.assert_array_equal(blocks.read(names, 70_000, 70_100), part)
    settings = va.OrderAnalysis(va.SpeedChannel("speed"), orders=(8.0,))
    orders = va.analyse_orders(recording, settings)
    peak = np.abs(orders["block_order"].sel(channel="mic", order=8.0).values)
    np.testing.assert_allclose(peak, 1.0, atol=0.01)


@pytest.mark.parametrize("suffix", ["mf4", "tdms"])
def test_what_is_no_number_in_a_slow_channel_is_named(tmp_path, suffix):
    file = run_up(tmp_path, suffix, np.nan)
    with pytest.raises(
        ParameterError, match=r"'speed': 1 of .* not finite, the first is sample 31"
    ):
        read_recording(file)


def test_a_cubic_is_exact_for_cubics():
    time = np.arange(12.0)
    position = np.linspace(0.0, 11.0, 97)
    polynomial = np.polynomial.Polynomial([1.0, -2.0, 0.3, 0.05])
    np.testing.assert_allclose(cubic(polynomial(time), position), polynomial(position), rtol=1e-12)
    few = cubic(np.array([1.0, 3.0, 2.0]), np.array([0.5, 1.5]))
    np.testing.assert_allclose(few, [2.0, 2.5])


@pytest.mark.parametrize("frequency", [0.01, 0.1, 0.25, 0.4])
def test_a_band_limited_value_is_that_of_the_sine(frequency):
    """The window passes up to 0.44 of the sample rate within 1e-5."""
    samples = np.cos(2.0 * np.pi * frequency * np.arange(200))
    position = np.random.default_rng(1).uniform(HALF_LENGTH, 199 - HALF_LENGTH, 500)
    expected = np.cos(2.0 * np.pi * frequency * position)
    np.testing.assert_allclose(band_limited(samples, position), expected, atol=2e-5)


def test_a_spline_is_exact_for_a_cubic_at_uneven_times():
    time = np.cumsum(np.random.default_rng(2).uniform(0.5, 1.5, 40))
    wanted = np.linspace(time[0], time[-1], 77)
    polynomial = np.polynomial.Polynomial([0.1, 2.0, -0.2, 0.01])
    np.testing.assert_allclose(spline(time, polynomial(time), wanted), polynomial(wanted))
