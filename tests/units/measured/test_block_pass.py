"""A recording that is analysed in blocks: the same results as in one piece."""

from functools import partial

import numpy as np
import pytest
import xarray as xr
from scipy.io import wavfile
from support import command_here

from vibroacoustics import (
    analyse_orders,
    export_recording,
    label_recording,
    open_recording,
    open_results,
    track_orders,
)
from vibroacoustics.base import recording_blocks
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders import recorded_speed
from vibroacoustics.orders.rpm_channel import rpm_motion, rpm_motion_of
from vibroacoustics.recordings.recorded import TooLargeError
from vibroacoustics.recordings.remarks import RecordingWarning
from vibroacoustics.study.order_analysis import (
    NominalSpeed,
    OrderAnalysis,
    SpeedChannel,
    TacholessSpeed,
)

RATE_HZ = 4096.0
DURATION_S = 23.0
"""Three transforms of the bands, ten of the meters."""


def turned(time_s):
    """Revolutions from 20 to 45 a second, that swing."""
    return 20.0 * time_s + 0.5 * 25.0 / DURATION_S * time_s**2 + 0.3 * np.sin(1.3 * time_s)


@pytest.fixture(scope="module")
def run_up() -> xr.Dataset:
    """Two microphones, one with an offset, a sensor between them, a tacho and an rpm channel."""
    rng = np.random.default_rng(4)
    time_s = np.arange(int(DURATION_S * RATE_HZ)) / RATE_HZ
    turns = turned(time_s)
    angle = 2.0 * np.pi * turns
    noise = 0.1 * rng.standard_normal((3, time_s.size))
    speed_rpm = 60.0 * np.gradient(turns, 1.0 / RATE_HZ)
    signals = [
        np.cos(angle + 0.3) + 0.2 * time_s / DURATION_S * np.cos(2.5 * angle) + noise[0],
        2.0 * np.cos(2.0 * angle) + noise[1],
        3.0 + 0.5 * np.cos(4.0 * angle) + noise[2],
        np.where(turns % 1.0 < 0.2, 5.0, 0.0),
        speed_rpm,
    ]
    names = ["front", "housing", "rear", "tacho", "speed"]
    units = ["Pa", "m/s²", "Pa", "V", "rpm"]
    return label_recording(signals, RATE_HZ, names, units)


def assert_same(blocks: xr.Dataset, once: xr.Dataset) -> None:
    """To 1e-9 of the largest value of each variable of each channel."""
    assert list(blocks.variables) == list(once.variables)
    for name, variable in once.data_vars.items():
        channels = once["channel"].values if "channel" in variable.dims else [None]
        for channel in channels:
            at = {} if channel is None else {"channel": channel}
            wanted, found = variable.sel(at).values, blocks[name].sel(at).values
            largest = np.nanmax(np.abs(wanted)) if np.isfinite(wanted).any() else 1.0
            np.testing.assert_allclose(
                found, wanted, rtol=0.0, atol=1e-9 * largest, err_msg=f"{name} {channel}"
            )
    np.testing.assert_allclose(blocks["block_speed"], once["block_speed"], rtol=1e-9)
    np.testing.assert_array_equal(blocks["block_count"], once["block_count"])


@pytest.mark.parametrize("method", ["sums", "filters"])
@pytest.mark.parametrize("samples", [997, 20_000])
def test_any_length_of_a_block_gives_the_same_result(run_up, monkeypatch, samples, method):
    """Orders, map, mean spectrum, average over the revolutions, levels and third octaves.

    997 samples are shorter than a block of revolutions and than a transform of the levels.
    """
    recording = run_up.sel(channel=["front", "housing", "rear", "tacho"])
    settings = OrderAnalysis(
        SpeedChannel("tacho"), orders=(1.0, 2.0, 3.5), with_map=True, bands=method
    )
    once = analyse_orders(recording, settings)
    assert once.sizes["block"] > 200
    assert {"order_map", "band_level", "synchronous_average"} <= set(once)
    monkeypatch.setattr(recording_blocks, "BLOCK_BYTES", 8 * 3 * samples)
    assert_same(analyse_orders(recording, settings), once)


@pytest.mark.parametrize("speed", [SpeedChannel("speed"), NominalSpeed(1500.0)])
def test_other_sources_of_speed_go_in_blocks(run_up, monkeypatch, speed):
    once = analyse_orders(run_up, OrderAnalysis(speed))
    monkeypatch.setattr(recording_blocks, "BLOCK_BYTES", 8 * 5000)
    assert_same(analyse_orders(run_up, OrderAnalysis(speed)), once)


def test_the_command_reads_a_large_file_in_blocks(run_up, tmp_path, monkeypatch):
    """Two parts are read, each by a process of its own, and worked on in smaller ones."""

    def refuse(*_: object, **__: object) -> None:
        raise TooLargeError("too large")

    path = export_recording(run_up, tmp_path / "run_up.nc")
    once = analyse_orders(run_up, OrderAnalysis(SpeedChannel("tacho"), orders=()))
    monkeypatch.setattr("vibroacoustics.recordings.read_recording", refuse)
    monkeypatch.setattr(recording_blocks, "READ_BYTES", 8 * 4 * 50_000)
    monkeypatch.setattr(recording_blocks, "BLOCK_BYTES", 8 * 4 * 6_000)
    outcome = command_here("orders", path, "--speed-channel", "tacho", "--out", tmp_path / "out")
    assert outcome.returncode == 0, outcome.stderr
    found = open_results(tmp_path / "out" / "orders.nc")
    assert_same(found[list(once.variables)], once)
    assert found.attrs["source_file"] == "run_up.nc"
    refused = command_here("track", path, "--speed-channel", "tacho", "--bandwidth", 2)
    assert refused.returncode == 2
    assert "too large" in refused.stderr


def test_an_overload_is_told_once(tmp_path):
    """In three blocks of which the second and the third hold full scale."""
    signal = 0.5 * np.sin(np.arange(3000) / 7.0)
    stored = np.round(signal * 2.0**15).astype("i2")
    stored[[1500, 1501, 2500]] = 2**15 - 1
    wavfile.write(tmp_path / "a.wav", 1000, stored)
    full_scale = {"channel 1": 2.0}
    blocks = open_recording(tmp_path / "a.wav", units={"channel 1": "Pa"}, calibration=full_scale)
    blocks.read(["channel 1"], 0, 1000)
    line = "channel 'channel 1': 2 samples are at full scale, the first at 1.5 s"
    with pytest.warns(RecordingWarning, match=line):
        blocks.read(["channel 1"], 1000, 2000)
    blocks.read(["channel 1"], 2000, 3000)  # a second warning would be an error
    assert line in blocks.attributes["reading_remarks"]


def test_a_speed_that_needs_the_signal_at_once_is_limited(run_up, monkeypatch):
    monkeypatch.setattr(recorded_speed, "MOST_SPEED_SAMPLES", 50_000)
    speed = TacholessSpeed("housing", 1000.0, 3000.0)
    with pytest.raises(ParameterError, match=r"too many, at most 50000 .* by from_s and to_s"):
        analyse_orders(run_up, OrderAnalysis(speed))
    with pytest.raises(ParameterError, match="by from_s and to_s"):
        track_orders(run_up, speed, [1.0], 2.0)


def test_a_standstill_is_cut_off_in_blocks_too():
    """The shaft stands, turns, hums backwards within a hundredth, and stands again."""
    rng = np.random.default_rng(5)
    speed = np.concatenate([np.zeros(700), np.linspace(100.0, 3000.0, 4000), np.zeros(1300)])
    speed += rng.uniform(-20.0, 20.0, speed.size) * (speed == 0.0)
    once = rpm_motion(speed, 1000.0)
    at_s = np.linspace(once.start_s, once.end_s, 500)
    for size in (1, 699, 1000, 4999):
        blocks = partial(np.split, speed, range(size, speed.size, size))
        motion = rpm_motion_of(lambda blocks=blocks: iter(blocks()), speed.size, 1000.0).motion
        np.testing.assert_array_equal(motion.curve.x, once.curve.x)
        np.testing.assert_allclose(motion.angle_rad(at_s), once.angle_rad(at_s), atol=1e-9)
    assert (once.start_s, once.end_s) == (0.7, 4.699)


def test_a_map_that_is_too_large_is_refused(run_up, monkeypatch):
    from vibroacoustics.orders import block_orders

    monkeypatch.setattr(block_orders, "MOST_MAP_BYTES", 10_000)
    settings = OrderAnalysis(SpeedChannel("tacho"), with_map=True)
    with pytest.raises(ParameterError, match=r"order map: \d+ blocks of 4 channels take .* from_s"):
        analyse_orders(run_up, settings)


def test_a_map_may_take_one_gibibyte():
    """16 B a line, block and channel: 2^26 of them, and not one more."""
    from vibroacoustics.orders.block_orders import _check_map

    _check_map(2, 2**12, 2**13)
    with pytest.raises(ParameterError, match=r"blocks of 1 channels take .* at most 1 GiB"):
        _check_map(1, 1, 2**26 + 1)
