"""Speed without a tacho from the motor of a machine file."""

import numpy as np
import pytest
from support import ROOT, assert_refused, command_here

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.measured.machine_speed import (
    slip_limits_rpm,
    speed_of_machine,
    supplies_within_slip,
)

MACHINES = ROOT / "data" / "machines"
SCROLL = MACHINES / "copeland_zp41k3e.toml"
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
    with pytest.raises(ParameterError, match=r"has no motor .* gives a speed: give --tacholess"):
        speed_of_machine(va.load_machine(MACHINES / "reciprocating_table.toml"))


@pytest.mark.parametrize(
    ("speed_rpm", "supply"),
    [(2950.0, (50.0, 1)), (3500.0, (60.0, 1)), (1440.0, (50.0, 2)), (1750.0, (60.0, 2)),
     (3000.0, (50.0, 1)), (960.0, (50.0, 3)), (1150.0, (60.0, 3))],
)  # fmt: skip
def test_supplies_of_rated_speeds(speed_rpm, supply):
    """Speeds of rating plates of induction motors."""
    assert next(supplies_within_slip(speed_rpm)) == supply


def test_no_supply_of_the_mains():
    assert not list(supplies_within_slip(4500.0))


@pytest.mark.parametrize("machine", ["estupinan_hermetic", "dagilis_slider_link"])
def test_induction_motors_without_a_circuit(machine):
    """Two poles at 50 Hz, by the synchronous speed and by the published speed."""
    speed = speed_of_machine(va.load_machine(MACHINES / f"{machine}.toml"))
    assert (speed.minimum_rpm, speed.maximum_rpm) == pytest.approx((2673.0, 3030.0), rel=1e-6)
    assert (speed.comb, speed.mains_hz) == (tuple(map(float, range(1, 11))), 50.0)


def test_a_synchronous_motor_needs_limits():
    """Six poles in nine slots: ripple at 6 × 3, cogging at the least common multiple, both 18."""
    machine = va.load_machine(SCROLL)
    speed = speed_of_machine(machine, limits_rpm=(1500.0, 6000.0))
    assert (speed.minimum_rpm, speed.maximum_rpm, speed.mains_hz) == (1500.0, 6000.0, None)
    assert speed.comb == (*map(float, range(1, 11)), 18.0)
    motor = machine.synchronous_motor.model_copy(update={"slots": 12, "pole_pairs": 4})
    other = machine.model_copy(update={"motor": None, "synchronous_motor": motor})
    assert speed_of_machine(other, limits_rpm=(900.0, 5400.0)).comb[-2:] == (10.0, 24.0)
    with pytest.raises(ParameterError, match="on an inverter, of any speed: give --tacholess"):
        speed_of_machine(other)


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


def test_the_speed_of_an_inverter(tmp_path):
    """Ripple at order 18 stands out, shaft orders are weak: 3780 rpm, not a multiple of it."""
    time_s, rng = np.arange(int(8.0 * RATE_HZ)) / RATE_HZ, np.random.default_rng(5)
    peaks = {**{float(order): 0.006 for order in range(1, 9)}, 18.0: 0.2}
    sound = 0.02 * rng.standard_normal(time_s.size) + sum(
        peak * np.cos(2.0 * np.pi * order * 63.0 * time_s + order) for order, peak in peaks.items()
    )
    recording = va.label_recording([sound], RATE_HZ, ["mic"], ["Pa"])
    file = va.export_recording(recording, tmp_path / "run.csv")
    done = command_here(
        "orders", file, "--tacholess-machine", SCROLL, "--tacholess", 1500, 6000,
        "--orders", "1,18", "--out", tmp_path,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    found = va.open_results(tmp_path / "orders.nc")
    assert found["speed"].values == pytest.approx([3780.0], abs=0.5)
    assert found.attrs["confidence"] > 0.8


def test_words(tmp_path):
    file = va.export_recording(
        va.label_recording([run_of(2900.0)], RATE_HZ, ["mic"], ["Pa"]), tmp_path / "run.csv"
    )
    done = command_here("orders", file, "--tacholess-machine", SCROLL, "--rpm", 2900)
    assert_refused(done, "give one of --speed-channel")
    assert_refused(command_here("orders", file, "--tacholess-machine", "no.toml"), "no such file")
    table = MACHINES / "reciprocating_table.toml"
    assert_refused(command_here("orders", file, "--tacholess-machine", table), "has no motor")
