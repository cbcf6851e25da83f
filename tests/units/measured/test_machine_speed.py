"""Speed without a tacho from the motor of a machine file."""

import numpy as np
import pytest
from support import ROOT, assert_refused, command_here

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.measured.machine_speed import slip_limits_rpm, speed_of_machine

SCROLL = ROOT / "data" / "machines" / "copeland_zp41k3e.toml"
RATE_HZ = 8192.0


def test_limits():
    """Two poles at 50 Hz: 3000 rpm; four at 60 Hz: 1800 rpm; 10 % of slip, 1 % of the mains."""
    assert slip_limits_rpm(50.0, 1) == pytest.approx((2673.0, 3030.0))
    assert slip_limits_rpm(60.0, 2) == pytest.approx((1603.8, 1818.0))


def test_source_of_a_machine():
    speed = speed_of_machine(va.load_machine(SCROLL), "front")
    assert (speed.channel, speed.mains_hz) == ("front", 50.0)
    assert (speed.minimum_rpm, speed.maximum_rpm) == pytest.approx((2673.0, 3030.0))
    assert speed.comb == (*map(float, range(1, 11)), 30.0)
    assert speed_of_machine(va.load_machine(SCROLL), mains_hz=60.0).maximum_rpm == 3636.0
    with pytest.raises(ParameterError, match="has no induction motor"):
        speed_of_machine(va.load_machine(ROOT / "data" / "machines" / "reciprocating_table.toml"))


def run_of(rpm):
    """Four orders of the shaft, the rotor's slots and hum at twice the mains, stronger than all."""
    time_s = np.arange(int(8.0 * RATE_HZ)) / RATE_HZ
    rng = np.random.default_rng(4)
    peaks = {1.0: 0.05, 2.0: 0.02, 3.0: 0.02, 4.0: 0.01, 30.0: 0.05}
    sound = sum(
        peak * np.cos(2.0 * np.pi * order * rpm / 60.0 * time_s + order)
        for order, peak in peaks.items()
    )
    hum = 0.3 * np.cos(2.0 * np.pi * 100.0 * time_s)
    return sound + hum + 0.02 * rng.standard_normal(time_s.size)


@pytest.mark.parametrize("rpm", [2894.0, 2960.0])
def test_the_speed_under_hum(tmp_path, rpm):
    recording = va.label_recording([run_of(rpm)], RATE_HZ, ["mic"], ["Pa"])
    file = va.export_recording(recording, tmp_path / "run.csv")
    done = command_here(
        "orders", file, "--tacholess-machine", SCROLL, "--orders", "1,2", "--out", tmp_path
    )
    assert done.returncode == 0, done.stderr
    found = va.open_results(tmp_path / "orders.nc")
    assert found["speed"].values == pytest.approx([rpm], abs=0.5)
    rms = found["channel_order_rms"].sel(channel="mic", order=1.0).values
    assert rms == pytest.approx([0.05 / np.sqrt(2.0)], rel=0.05)


def test_words(tmp_path):
    file = va.export_recording(
        va.label_recording([run_of(2900.0)], RATE_HZ, ["mic"], ["Pa"]), tmp_path / "run.csv"
    )
    done = command_here("orders", file, "--tacholess-machine", SCROLL, "--rpm", 2900)
    assert_refused(done, "give one of --speed-channel")
    assert_refused(command_here("orders", file, "--tacholess-machine", "no.toml"), "no such file")
