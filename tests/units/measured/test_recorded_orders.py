"""A recording from file to orders: against the pipeline that made it, and by every speed source."""

import json

import numpy as np
import pytest
import xarray as xr
from scipy.interpolate import CubicSpline
from support import tiny_run

from vibroacoustics import analyse_orders, label_recording, read_recording
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.orders import OrderResolutionWarning
from vibroacoustics.orders.analysed import channels_without_speed
from vibroacoustics.orders.recorded_speed import (
    PulseWarning,
    UncertainSpeedWarning,
    recorded_speed,
)
from vibroacoustics.recordings import LabelledBlocks, csv_bytes, wav_bytes
from vibroacoustics.report.recordings import levels_data, orders_facts, orders_tables
from vibroacoustics.report.tables import records, to_text
from vibroacoustics.results import storage
from vibroacoustics.study.order_analysis import (
    NominalSpeed,
    OrderAnalysis,
    SpeedChannel,
    TacholessSpeed,
)

RATE_HZ = 25600.0
BY_TACHO = OrderAnalysis(SpeedChannel("tacho"))
REVOLUTION = 2.0 * np.pi
PENDULUM = """
[options.pendulum-side]
kind = "pendulum"
length_mm = { value = 25.0, source = "thesis (7.8), first case" }
horizontal_reach_mm = { value = 15.0, source = "thesis (7.5), first case" }
damping_ratio = { value = 0.02, source = "given" }
"""


def tacho(angle_rad, pulses=1, width=0.1):
    """A pulse of 5 V that rises at every multiple of the pitch, crank angle zero among them."""
    return np.where((pulses * angle_rad) % REVOLUTION < width * REVOLUTION, 5.0, 0.0)


def even_angle(speed_rpm, duration_s, rate_hz=RATE_HZ):
    """Crank angle at even speed; it is 1 rad at the start, where no sample is at an edge."""
    time_s = np.arange(int(duration_s * rate_hz)) / rate_hz
    return 1.0 + REVOLUTION * speed_rpm / 60.0 * time_s


def run_up_angle(first_rpm, last_rpm, duration_s, rate_hz):
    time_s = np.arange(int(duration_s * rate_hz)) / rate_hz
    turned = first_rpm * time_s + (last_rpm - first_rpm) * time_s**2 / (2.0 * duration_s)
    return 1.0 + REVOLUTION * turned / 60.0


def recorded(channels, rate_hz=RATE_HZ):
    """A recording of channels {name: (unit, samples)}."""
    units, samples = zip(*channels.values(), strict=True)
    return label_recording(np.stack(samples), rate_hz, list(channels), units)


# --- the simulated machine, recorded -------------------------------------------------------------


@pytest.fixture(scope="module")
def run() -> xr.Dataset:
    return tiny_run(PENDULUM)


@pytest.fixture(scope="module", params=["none", "pendulum-side"])
def machine(run, request) -> tuple[xr.Dataset, xr.DataArray]:
    """Force and moment of an option over 4 s at 2900 rpm with a tacho, and their orders.

    The force over time comes from the force over the crank angle by a periodic spline, not from
    its orders: at order 2 of 256 samples it errs by (2 · 2π/256)⁴/720 = 1e-8. A revolution is
    529.66 samples long, so that the edges of the tacho meet the samples in 29 places; where it is
    a whole number (3000 rpm), every edge is late by the same part of a sample, ±0.35° of 1x.
    """
    chosen = run.sel(option=request.param, speed=2900.0).sum("source")
    angle = even_angle(2900.0, 4.0)
    crank_angle = np.append(run["crank_angle"].values, REVOLUTION)
    channels, orders = {}, {}
    for name, unit in (("force", "N"), ("moment", "N m")):
        for axis in chosen["axis"].values:
            wave = chosen[name].sel(axis=axis).transpose("crank_angle").values
            lines = chosen[f"{name}_order"].sel(axis=axis, order=[1, 2])
            if np.abs(lines).max() > 1e-9:  # N, N m: an axis that the mechanism does not push
                spline = CubicSpline(crank_angle, np.append(wave, wave[0]), bc_type="periodic")
                channels[f"{name} {axis}"] = (unit, spline(angle % REVOLUTION))
                orders[f"{name} {axis}"] = lines.values
    channels["tacho"] = ("V", tacho(angle))
    simulated = xr.DataArray(
        list(orders.values()), dims=("channel", "order"), coords={"channel": list(orders)}
    )
    return recorded(channels), simulated


def assert_same_orders(results, simulated):
    """0.01 dB and 0.1° of every order that is there."""
    found = results["channel_order"].isel(speed=0).sel(order=[1, 2]).values
    assert list(results["channel"].values) == list(simulated["channel"].values)
    assert results["speed"].item() == pytest.approx(2900.0, abs=0.01)
    wanted = simulated.values
    there = np.abs(wanted) > 1e-9
    assert there[:, 0].all()
    ratio = found[there] / wanted[there]
    level_db, phase_deg = 20.0 * np.log10(np.abs(ratio)), np.degrees(np.angle(ratio))
    print(f"largest: {np.max(np.abs(level_db)):.2g} dB, {np.max(np.abs(phase_deg)):.2g} deg")
    assert np.max(np.abs(level_db)) <= 0.01
    assert np.max(np.abs(phase_deg)) <= 0.1
    assert np.all(np.abs(found[~there]) < 1e-4 * np.abs(wanted[:, :1]).max())
    assert np.all(results["channel_order_coherence"].sel(order=1) > 0.999)


def test_csv_gives_the_pipelines_orders(machine, tmp_path):
    recording, simulated = machine
    (tmp_path / "machine.csv").write_bytes(csv_bytes(recording))
    assert_same_orders(
        analyse_orders(read_recording(tmp_path / "machine.csv"), BY_TACHO), simulated
    )


def test_wav_gives_the_pipelines_orders(machine, tmp_path):
    recording, simulated = machine
    (tmp_path / "machine.wav").write_bytes(wav_bytes(recording))
    names = [f"channel {number}" for number in range(1, recording.sizes["channel"] + 1)]
    units = dict(zip(names, recording["channel_unit"].values, strict=True))
    read = read_recording(tmp_path / "machine.wav", units=units)
    results = analyse_orders(read, OrderAnalysis(SpeedChannel(names[-1])))
    own = results.assign_coords(channel=recording["channel"].values[:-1])
    assert_same_orders(own, simulated)


# --- levels --------------------------------------------------------------------------------------


def test_levels_of_a_pressure():
    """Tones of whole periods in 3 s, on an offset that is no sound.

    1x at 1000 Hz (60000 rpm), half of it at 2000 Hz, with A(1000) = 0 and A(2000) = +1.2 dB; the
    tables of IEC 61672-1 round to 0.05 dB. Weighting pads with silence: the ends ring for some
    periods out of 3000. LF: the square of a tone of 1 kHz, smoothed with 0.125 s, ripples by
    1/(2 ω τ) = 6e-4, 0.003 dB; of two tones, by twice that with their beat at 1 kHz.
    """
    angle = even_angle(60000.0, 3.0, 51200.0)
    pressure = 2.0 + np.cos(angle) + 0.5 * np.cos(2.0 * angle + 1.0)
    recording = recorded(
        {"microphone": ("Pa", pressure), "shaker": ("N", pressure)}, rate_hz=51200.0
    )
    results = analyse_orders(recording, OrderAnalysis(NominalSpeed(60000.0), maximum_order=4.0))
    first, second = (20.0 * np.log10(peak / np.sqrt(2.0) / 20e-6) for peak in (1.0, 0.5))
    total = 10.0 * np.log10(10 ** (first / 10) + 10 ** (second / 10))
    total_a = 10.0 * np.log10(10 ** (first / 10) + 10 ** ((second + 1.2) / 10))
    own = results.sel(channel="microphone")
    assert own["equivalent_level"].sel(weighting="Z") == pytest.approx(total, abs=1e-6)
    assert own["equivalent_level"].sel(weighting="A") == pytest.approx(total_a, abs=0.02)
    assert own["fast_maximum_level"].sel(weighting="Z") == pytest.approx(total, abs=0.01)
    # Slow reaches 1 - exp(-3 s / 1 s) of the mean square at the end
    slow = total + 10.0 * np.log10(1.0 - np.exp(-3.0))
    assert own["slow_maximum_level"].sel(weighting="Z") == pytest.approx(slow, abs=0.01)
    bands = own["band_level"].sel(weighting="Z")
    assert bands.sel(band=1000.0) == pytest.approx(first, abs=1e-6)
    assert bands.sel(band=2000.0) == pytest.approx(second, abs=1e-6)
    others = bands.drop_sel(band=[1000.0, 2000.0])
    assert np.all(others < first - 200.0)  # whole periods leave rounding alone
    force = results.sel(channel="shaker")
    for name in ("equivalent_level", "fast_maximum_level", "slow_maximum_level", "band_level"):
        assert np.all(np.isnan(force[name])), name


def test_without_sound_pressure_there_are_no_levels():
    results = analyse_orders(shaker(), OrderAnalysis(NominalSpeed(3000.0)))
    assert "equivalent_level" not in results
    assert "weighting" not in results.coords


# --- sources of the speed ------------------------------------------------------------------------


def shaker(speed_rpm=3000.0, duration_s=3.0, rate_hz=6400.0, **others):
    """Force of 2 N at 1x with 0.5 rad and 0.5 N at 2x, and other channels made from the angle."""
    angle = even_angle(speed_rpm, duration_s, rate_hz)
    force = 2.0 * np.cos(angle + 0.5) + 0.5 * np.cos(2.0 * angle)
    channels = {"force": ("N", force)}
    channels |= {name: (unit, make(angle)) for name, (unit, make) in others.items()}
    return recorded(channels, rate_hz)


def amplitudes(results):
    return np.abs(results["channel_order"].sel(channel="force").isel(speed=0)).values


KERNEL = 2e-5
"""Ripple of the gain from time to crank angle, 1e-5, and images of the one order in the other."""


def test_nominal_speed():
    results = analyse_orders(shaker(), OrderAnalysis(NominalSpeed(3000.0)))
    np.testing.assert_allclose(amplitudes(results)[:2], [2.0, 0.5], atol=2.0 * KERNEL)
    assert results["speed"].item() == pytest.approx(3000.0)
    assert results.attrs["speed_source"] == "nominal 3000 rpm"
    assert results.attrs["angle_zero"] == "none"


def test_speed_channel_in_rpm():
    recording = shaker(speed=("rpm", lambda angle: np.full_like(angle, 3000.0)))
    results = analyse_orders(recording, OrderAnalysis(SpeedChannel("speed")))
    np.testing.assert_allclose(amplitudes(results)[:2], [2.0, 0.5], atol=2.0 * KERNEL)
    assert list(results["channel"].values) == ["force"]
    assert results.attrs["angle_zero"] == "none"


def test_encoder_with_index_pulse():
    """60 pulses a revolution; the index pulse tells crank angle zero.

    At 128 samples a revolution the index edge lies half a sample late at most: 1.4°.
    """
    recording = shaker(
        encoder=("V", lambda angle: tacho(angle + 2.0, 60)), index=("V", tacho), rate_hz=25600.0
    )
    results = analyse_orders(recording, OrderAnalysis(SpeedChannel("encoder", 60, "index")))
    assert list(results["channel"].values) == ["force"]
    assert results.attrs["angle_zero"] == "pulse of index"
    np.testing.assert_allclose(amplitudes(results)[:2], [2.0, 0.5], atol=1e-3)
    phase = np.angle(results["channel_order"].sel(channel="force", order=1).item())
    assert phase == pytest.approx(0.5, abs=REVOLUTION * 0.5 / 512)
    alone = analyse_orders(
        recording.sel(channel=["force", "encoder"]), OrderAnalysis(SpeedChannel("encoder", 60))
    )
    assert alone.attrs["angle_zero"] == "none"  # any of the 60 pulses


def test_wrong_number_of_pulses_is_refused():
    recording = shaker(encoder=("V", lambda angle: tacho(angle, 4)), index=("V", tacho))
    with pytest.raises(ParameterError, match=r"recording: pulses_per_revolution = 8: 4\.0 tacho"):
        analyse_orders(recording, OrderAnalysis(SpeedChannel("encoder", 8, "index")))


def test_tacholess():
    """Amplitudes alone: the angle counts from no mark on the shaft.

    The speed is known to 0.5 % (test_orders_tacholess): 2x slips by 0.06 revolutions over a block
    of 6, 0.06 of a line, and stays in its band but for a share of the square of that. Noise puts
    0.01 N² · 33 Hz / 3200 Hz into the band, 2e-4 of 2x.
    """
    angle = even_angle(2930.0, 6.0, 6400.0)
    force = np.sum([2.0 / k * np.cos(k * angle + k) for k in (1, 2, 3, 4, 6, 8)], axis=0)
    force += 0.1 * np.random.default_rng(0).standard_normal(angle.size)
    recording = recorded({"force": ("N", force)}, 6400.0)
    settings = OrderAnalysis(TacholessSpeed(None, 2000.0, 3500.0), orders=(1.0, 2.0))
    results = analyse_orders(recording, settings)
    assert results["speed"].item() == pytest.approx(2930.0, rel=5e-3)
    rms = results["channel_order_rms"].sel(channel="force").isel(speed=0)
    np.testing.assert_allclose(np.sqrt(2.0) * rms, [2.0, 1.0], rtol=5e-3)
    assert results.attrs["angle_zero"] == "none"
    assert 0.9 < results.attrs["confidence"] <= 1.0


def test_speed_found_in_noise_is_warned_of():
    noise = np.random.default_rng(2).standard_normal(6400 * 4)
    recording = recorded({"noise": ("N", noise)}, 6400.0)
    with pytest.warns(UncertainSpeedWarning, match=r"confidence 0\.[0-4]\d of 1"):
        analyse_orders(recording, OrderAnalysis(TacholessSpeed("noise", 1000.0, 4000.0)))


@pytest.mark.long
def test_rival_of_a_speed_is_named():
    """Hum at 50, 100 and 150 Hz beside orders 1 to 3 of 1458 rpm: without its name a rival."""
    time_s = np.arange(int(15.0 * 6400.0)) / 6400.0
    rng = np.random.default_rng(3)
    turn = 2.0 * np.pi * time_s
    force = np.sum([0.3 * np.cos(k * 24.3 * turn + k) for k in (2, 4, 6)], axis=0)
    force += np.sum([np.cos(k * 50.0 * turn + k) for k in (1, 2, 3)], axis=0)
    force += 0.05 * rng.standard_normal(time_s.size)
    recording = recorded({"force": ("N", force)}, 6400.0)
    comb = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    with pytest.warns(UncertainSpeedWarning, match=r"1(458|49\d|50\d) rpm is the next best"):
        analyse_orders(recording, OrderAnalysis(TacholessSpeed(None, 1200.0, 1800.0, comb)))
    named = TacholessSpeed(None, 1200.0, 1800.0, (2.0, 4.0, 6.0), mains_hz=50.0)
    results = analyse_orders(recording, OrderAnalysis(named))
    assert results["speed"].item() == pytest.approx(1458.0, rel=1e-3)
    assert results.attrs["confidence"] > 0.8
    assert "without mains of 50 Hz" in results.attrs["speed_source"]


@pytest.mark.parametrize("wheel", ["10 - 2", "two marks", "aliasing"])
def test_pulses_that_are_not_what_is_stated_are_warned_of(wheel):
    angle = run_up_angle(1000.0, 1500.0, 10.0, 25600.0)
    turns = angle / REVOLUTION
    if wheel == "10 - 2":
        pulses = np.where(turns % 1.0 < 0.8, tacho(angle, 10, 0.5), 0.0)
        stated, words = 10, "on a wheel of 10 - 2 teeth"
    elif wheel == "two marks":
        pulses = np.where((turns % 1.0 < 0.05) | (abs(turns % 1.0 - 0.5) < 0.05), 5.0, 0.0)
        stated, words = 2, "the 2 pulses of a revolution are unequally spaced"
    else:
        pulses, stated, words = tacho(angle, 300, 0.5), 300, "pulses are missed or alias"
    recording = recorded({"force": ("N", np.cos(angle)), "tacho": ("V", pulses)}, 25600.0)
    with pytest.warns(PulseWarning) as caught:
        recorded_speed(LabelledBlocks(recording), SpeedChannel("tacho", stated))
    assert any(words in str(warning.message) for warning in caught)


@pytest.mark.parametrize(
    ("speed", "words"),
    [
        (SpeedChannel("tach"), "speed: no channel 'tach'; there are force, tacho"),
        (SpeedChannel("tacho", 1, "zero"), "speed: no channel 'zero'; there are force, tacho"),
        (TacholessSpeed(None, 1e3, 4e3), "speed: name the channel to find it in, one of force, ta"),
    ],
)
def test_speed_that_is_not_there(speed, words):
    recording = shaker(tacho=("V", tacho))
    recording.attrs["source_file"] = "shaker.wav"
    with pytest.raises(ParameterError) as caught:
        analyse_orders(recording, OrderAnalysis(speed))
    assert str(caught.value).startswith("shaker.wav: " + words)


def test_only_the_speed_is_no_recording():
    recording = shaker(tacho=("V", tacho)).sel(channel=["tacho"])
    with pytest.raises(ParameterError, match="no channel besides that of the speed"):
        analyse_orders(recording, BY_TACHO)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: NominalSpeed(0.0), "speed_rpm = 0 rpm"),
        (lambda: NominalSpeed(np.inf), "speed_rpm = inf rpm"),
        (lambda: SpeedChannel("tacho", 0), "pulses_per_revolution = 0: must be 0.001 to 100000"),
        (lambda: SpeedChannel("tacho", 10**400), "pulses_per_revolution = 1000"),
        (lambda: SpeedChannel("tacho", threshold=1e300), "threshold = 1e.300: must be"),
        (lambda: TacholessSpeed(None, 3e3, 1e3), "minimum_rpm = 3000 rpm: must be below"),
        (lambda: TacholessSpeed(None, np.nan, 1e3), "minimum_rpm = nan rpm"),
        (lambda: TacholessSpeed(None, 1e3, 3e3, ()), "comb = .*: must be at least one order"),
        (lambda: TacholessSpeed(None, 1e3, 3e3, (2.0, 1.0)), "comb = .* and rise"),
        (lambda: TacholessSpeed(None, 1e3, 3e3, mains_hz=0.0), "mains_hz = 0 Hz"),
        (lambda: OrderAnalysis(NominalSpeed(1.0), bands="both"), "must be one of sums, filters"),
        (lambda: OrderAnalysis(NominalSpeed(1.0), orders=(), is_fit=True), "must be at least one"),
        (lambda: OrderAnalysis(NominalSpeed(1.0), orders=(2.0, 1.0)), "and rise"),
        (lambda: OrderAnalysis(NominalSpeed(1.0), orders=(1.0, 1.0)), "and rise"),
        (lambda: OrderAnalysis(NominalSpeed(1.0), orders=(np.nan,)), "orders = nan"),
        (lambda: OrderAnalysis(NominalSpeed(1.0), maximum_order=0.0), "maximum_order = 0"),
        (lambda: OrderAnalysis(NominalSpeed(1.0), resolution_order=-1.0), "resolution_order = -1"),
        (lambda: OrderAnalysis(NominalSpeed(1.0), speed_step_rpm=np.inf), "speed_step_rpm = inf"),
    ],
)
def test_settings_that_make_no_sense(make, words):
    with pytest.raises(ParameterError, match=words):
        make()


# --- run-up, faults, what is kept ----------------------------------------------------------------


@pytest.fixture(scope="module")
def run_up() -> xr.Dataset:
    """1000 to 3000 rpm in 20 s; 1x grows with the speed, 2x is as large everywhere.

    One pulse of the tacho is missing and one comes twice.
    """
    angle = run_up_angle(1000.0, 3000.0, 20.0, 6400.0)
    speed_rpm = 1000.0 + 100.0 * np.arange(angle.size) / 6400.0
    force = 1e-3 * speed_rpm * np.cos(angle + 0.5) + 0.3 * np.cos(2.0 * angle)
    pulses = tacho(angle)
    revolution = angle / REVOLUTION
    pulses[(revolution >= 100.0) & (revolution < 100.2)] = 0.0
    pulses[(revolution >= 200.5) & (revolution < 200.55)] = 5.0
    recording = recorded({"force": ("N", force), "tacho": ("V", pulses)}, 6400.0)
    recording.attrs |= {"source_file": "run_up.csv", "source_sha256": "0" * 64}
    settings = OrderAnalysis(SpeedChannel("tacho"), orders=(1.0, 2.0), with_map=True)
    return analyse_orders(recording, settings)


def test_run_up_has_an_operating_point_every_100_rpm(run_up):
    """Blocks of 6 revolutions span 0.36 to 0.12 s, 36 to 12 rpm; the window's ends add little.

    The blocks at a point lie within ±50 rpm of it, evenly but at both ends of the run-up: the
    mean of 1x is that at the mean speed, known to a block's share.
    """
    np.testing.assert_array_equal(run_up["speed"], np.arange(1000.0, 3001.0, 100.0))
    np.testing.assert_allclose(run_up["block_count"].sum(), run_up.sizes["block"])
    inner = run_up.sel(channel="force", speed=slice(1100.0, 2900.0))
    first = np.abs(inner["channel_order"].sel(order=1))
    speed = inner["speed"].values
    np.testing.assert_allclose(first, 1e-3 * speed, atol=1e-3 * 18.0)  # half a block's rpm
    np.testing.assert_allclose(np.abs(inner["channel_order"].sel(order=2)), 0.3, rtol=5e-3)
    phase = np.angle(inner["channel_order"].sel(order=1))
    np.testing.assert_allclose(phase, 0.5, atol=np.radians(1.0))
    rms = run_up["block_order_rms"].sel(channel="force", order=1)
    np.testing.assert_allclose(rms, 1e-3 * run_up["block_speed"] / np.sqrt(2.0), rtol=5e-3)


def test_faults_of_the_tacho_are_listed(run_up):
    kinds = [str(name).split()[1] for name in run_up["fault"].values]
    assert kinds == ["missing", "double"]
    # 1000 t + 50 t² = 60 n gives the times of revolutions 100 and 200.5, less the first 1 rad
    turned = 60.0 * (np.array([100.0, 200.5]) - 1.0 / REVOLUTION)
    expected = -10.0 + np.sqrt(100.0 + turned / 50.0)
    np.testing.assert_allclose(run_up["fault_time"], expected, atol=1e-3)
    assert run_up.attrs["tacho_faults"] == 2


def test_map_is_kept_where_it_is_wanted(run_up):
    assert run_up["order_map"].dims == ("channel", "block", "map_order")
    lines = run_up["order_map"].sel(map_order=[1.0, 2.0]).values
    # The same sum in another order: rounding of 1e3 terms.
    np.testing.assert_allclose(lines, run_up["block_order"].values, rtol=0.0, atol=1e-11)
    assert "order_map" not in analyse_orders(shaker(), OrderAnalysis(NominalSpeed(3000.0)))


def test_attributes_say_how_it_was_made(run_up):
    attrs = run_up.attrs
    assert attrs["source_file"] == "run_up.csv"
    assert attrs["source_sha256"] == "0" * 64
    assert attrs["sample_rate_hz"] == 6400.0
    assert attrs["angle_zero"] == "pulse of tacho"
    assert attrs["revolutions_per_block"] == 6
    assert attrs["resolution_order"] == 0.25
    assert attrs["band_order"] == pytest.approx(4.0 / 6.0)
    assert attrs["schema_version"] == "1"
    settings = json.loads(attrs["analysis"])
    assert settings["speed"]["channel"] == "tacho"
    assert settings["orders"] == [1.0, 2.0]


def test_calibration_stays_with_the_channel():
    angle = even_angle(3000.0, 3.0, 6400.0)
    recording = label_recording([np.cos(angle)], 6400.0, ["force"], ["kN"], {"force": 2.0})
    results = analyse_orders(recording, OrderAnalysis(NominalSpeed(3000.0)))
    assert results["calibration_factor"].item() == 2000.0
    np.testing.assert_allclose(amplitudes(results)[0], 2000.0, rtol=KERNEL)


def test_results_survive_the_disk(run_up, tmp_path):
    again = storage.open_results(storage.write_results(run_up, tmp_path / "orders.nc"))
    xr.testing.assert_identical(run_up, again[list(run_up.data_vars)])


def test_synchronous_average_is_the_wave_over_a_revolution():
    recording = shaker(tacho=("V", tacho), rate_hz=25600.0, speed_rpm=2900.0)
    results = analyse_orders(recording, BY_TACHO).sel(channel="force")
    angle = results["average_angle"].values
    wave = 2.0 * np.cos(angle + 0.5) + 0.5 * np.cos(2.0 * angle)
    # 0.1° of 2 N
    np.testing.assert_allclose(results["synchronous_average"], wave, atol=2.0 * np.radians(0.1))


def test_orders_too_close_for_the_resolution_are_warned_of():
    settings = OrderAnalysis(NominalSpeed(3000.0), orders=(1.0, 1.5), resolution_order=0.25)
    with pytest.warns(OrderResolutionWarning, match=r"orders 1 and 1\.5 leak into each other"):
        analyse_orders(shaker(), settings)


def test_resolution_that_the_recording_does_not_allow():
    settings = OrderAnalysis(NominalSpeed(3000.0), resolution_order=0.001)
    with pytest.raises(ParameterError, match=r"^recording: resolution_order = 0\.001: needs block"):
        analyse_orders(shaker(), settings)


# --- what is left out ----------------------------------------------------------------------------


def test_synchronous_average_that_lacks_revolutions_is_left_out():
    """One and a half revolutions: blocks of one are enough for the orders."""
    recording = shaker(speed_rpm=3000.0, duration_s=0.062, rate_hz=25600.0)
    settings = OrderAnalysis(
        NominalSpeed(3000.0), orders=(2.0,), maximum_order=8.0, resolution_order=1.5
    )
    results = analyse_orders(recording, settings)
    assert "synchronous_average" not in results
    assert results.attrs["left_out"].startswith("synchronous average: revolutions = 1: the signal")
    assert "left out: synchronous average: revolutions = 1" in orders_facts(results)[-1]


def test_levels_say_what_they_leave_out_and_how_bands_come_about():
    angle = even_angle(3000.0, 3.0, 6400.0)
    recording = recorded({"microphone": ("Pa", np.cos(angle))}, 6400.0)
    sums, filters = (
        analyse_orders(recording, OrderAnalysis(NominalSpeed(3000.0), bands=method))
        for method in ("sums", "filters")
    )
    assert sums.attrs["levels_left_out_s"] == pytest.approx(0.1)
    assert "A and C omit the first and last 0.1 s" in to_text(orders_tables(sums)[1])
    assert "third octaves in levels.csv by band sums" in to_text(orders_tables(sums)[1])
    assert "third octaves in levels.csv by IEC 61260-1 filters" in to_text(
        orders_tables(filters)[1]
    )
    weightings = {row["weighting"]: row for row in records(levels_data(filters))}
    assert weightings["A"]["left_out_s"] == 0.1
    assert weightings["Z"]["left_out_s"] == 0.0
    assert weightings["Z"]["bands"] == "filters"
    skirt = filters["band_level"] - sums["band_level"]
    assert skirt.sel(channel="microphone", weighting="Z", band=40.0) > 15.0


def test_channels_beside_each_other_are_not_copied():
    recording = shaker(tacho=("V", tacho), other=("N", np.cos))
    signal = recording["signal"]
    first = channels_without_speed(signal.isel(channel=[1, 0, 2]), SpeedChannel("tacho"))
    assert list(first["channel"].values) == ["force", "other"]
    last = signal.sel(channel=["force", "other", "tacho"])
    assert np.shares_memory(channels_without_speed(last, SpeedChannel("tacho")).values, last.values)
    between = channels_without_speed(signal, SpeedChannel("tacho"))
    assert list(between["channel"].values) == ["force", "other"]
