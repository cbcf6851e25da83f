"""Axis and unit of channels: read or refused."""

import h5py
import numpy as np
import pytest
import scipy.io
import xarray as xr
from nptdms import ChannelObject, TdmsWriter
from offset_channels import dataset_58, sine, uff_ms

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.recordings import open_recording, read_recording
from vibroacoustics.recordings.axes import rounded_rate_hz
from vibroacoustics.recordings.quantities import quantity
from vibroacoustics.recordings.remarks import RecordingWarning
from vibroacoustics.recordings.time_stamps import is_stamp, stamp_ns

RATE_HZ = 2048.0
TIME_S = np.arange(512) / RATE_HZ
SINE = np.sin(2.0 * np.pi * 50.0 * TIME_S)


def tdms(path, **properties):
    about = {"wf_increment": 1.0 / RATE_HZ, "unit_string": "Pa", **properties}
    with TdmsWriter(str(path)) as writer:
        writer.write_segment([ChannelObject("g", "mic", SINE, properties=about)])
    return path


# --- milliseconds are read -----------------------------------------------------------------------


def test_milliseconds_of_a_universal_file(tmp_path):
    read = read_recording(uff_ms(tmp_path, 0.0))
    assert read.attrs["sample_rate_hz"] == pytest.approx(2048.0, rel=1e-5)


@pytest.mark.parametrize(("unit", "factor"), [("ms", 1e3), ("us", 1e6), ("s", 1.0)])
def test_milliseconds_of_tdms(tmp_path, unit, factor):
    path = tdms(tmp_path / "a.tdms", wf_xunit_string=unit, wf_increment=factor / RATE_HZ)
    assert read_recording(path).attrs["sample_rate_hz"] == pytest.approx(RATE_HZ)


@pytest.mark.parametrize(("unit", "factor"), [("ms", 1e3), ("milliseconds", 1e3), ("min", 1 / 60)])
def test_milliseconds_of_hdf5(tmp_path, unit, factor):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["mic"], file["time"] = SINE, factor * TIME_S
        file["mic"].attrs["units"], file["time"].attrs["units"] = "Pa", unit
    read = read_recording(tmp_path / "a.h5")
    assert read.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ)


@pytest.mark.parametrize("factor", [1000.0, None])
def test_milliseconds_of_testlab_need_their_factor(tmp_path, factor):
    """Testlab stores SI units and the factor to the label."""
    axis = {"label": "ms"} if factor is None else {
        "label": "ms", "unit_transformation": {"factor": factor, "offset": 0.0},
    }  # fmt: skip
    struct = {
        "x_values": {"start_value": 0.0, "increment": 1.0 / RATE_HZ, "quantity": axis},
        "y_values": {"values": SINE[:, None], "quantity": {"label": "Pa"}},
        "function_record": {"name": "mic"},
    }
    scipy.io.savemat(tmp_path / "a.mat", {"Signal": struct})
    if factor is None:
        with pytest.raises(ParameterError, match="no function of time, only of 'ms'"):
            read_recording(tmp_path / "a.mat")
    else:
        assert read_recording(tmp_path / "a.mat").attrs["sample_rate_hz"] == RATE_HZ


# --- other axes are refused by their name --------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "unit", "words"),
    [
        (19, "rpm", r"'a': its abscissa is a speed in rpm, unit 'rpm': a recording needs a time"),
        (18, "Hz", "'a': its abscissa is a frequency, unit 'Hz'"),
        (1, "rpm", "'a': its abscissa has the unit 'rpm': a recording needs a time"),
        (1, "Hz", "'a': its abscissa has the unit 'Hz'"),
        (0, "m", "'a': its abscissa has the unit 'm'"),
        (8, "m", "'a': its abscissa is a displacement, unit 'm'"),
    ],
)
def test_other_abscissas_of_a_universal_file(tmp_path, kind, unit, words):
    (tmp_path / "a.uff").write_text(dataset_58("a", SINE, 0.0, unit, kind))
    with pytest.raises(ParameterError, match=words):
        read_recording(tmp_path / "a.uff")


@pytest.mark.parametrize(
    ("properties", "words"),
    [
        ({"wf_xunit_string": "Hz"}, r"'mic': axis 'wf_xname' has the unit 'Hz': a recording needs"),
        (
            {"wf_xunit_string": "rpm", "wf_xname": "Speed"},
            "'mic': axis 'Speed' has the unit 'rpm': a recording needs",
        ),
        ({"wf_xname": "Frequency"}, r"'mic': its axis is 'Frequency' \(wf_xname\) without a unit"),
    ],
)
def test_other_axes_of_tdms(tmp_path, properties, words):
    with pytest.raises(ParameterError, match=words):
        read_recording(tdms(tmp_path / "a.tdms", **properties))


@pytest.mark.parametrize(("name", "unit"), [("frequency", "Hz"), ("speed", "rpm"), ("x", "m")])
def test_other_coordinates_of_netcdf(tmp_path, name, unit):
    axis = (name, 10.0 * np.arange(512), {"units": unit})
    data = xr.Dataset({"mic": (name, SINE, {"units": "Pa"})}, coords={name: axis})
    data.attrs["fs"] = RATE_HZ
    data.to_netcdf(tmp_path / "a.nc")
    words = rf"'mic': its axis '{name}' has the unit '{unit}': a recording needs a time"
    with pytest.raises(ParameterError, match=words):
        read_recording(tmp_path / "a.nc")


@pytest.mark.parametrize(("kind", "words"), [(2, "angle"), (3, "distance"), (4, "index")])
def test_other_masters_of_mdf(tmp_path, kind, words):
    from asammdf import MDF, Signal

    with MDF(version="4.10") as file:
        file.append([Signal(SINE, TIME_S, name="mic", unit="Pa")])
        master = file.groups[0].channels[0]
        master.sync_type, master.unit = kind, "deg"
        file.save(tmp_path / "a.mf4")
    with pytest.raises(ParameterError, match=rf"'mic': its axis 'time' is of kind {words}, unit"):
        read_recording(tmp_path / "a.mf4")


@pytest.mark.parametrize(("unit", "rate_hz"), [("kHz", 2000.0), ("Hz", 2.0), ("", 2.0)])
def test_the_unit_of_a_sample_rate(tmp_path, unit, rate_hz):
    data = xr.Dataset({"mic": ("x", SINE, {"units": "Pa"}), "fs": ((), 2.0, {"units": unit})})
    data.to_netcdf(tmp_path / "a.nc")
    assert read_recording(tmp_path / "a.nc").attrs["sample_rate_hz"] == rate_hz
    data["fs"].attrs["units"] = "s"
    data.to_netcdf(tmp_path / "b.nc")
    with pytest.raises(ParameterError, match="'fs' has the unit 's': a sample rate needs Hz"):
        read_recording(tmp_path / "b.nc")


def test_a_channel_whose_name_ends_like_a_time_stays_one(tmp_path):
    """The tangential direction of a foot does not grow."""
    scipy.io.savemat(tmp_path / "a.mat", {"foot": SINE, "foot_t": SINE[::-1], "fs": RATE_HZ})
    read = read_recording(tmp_path / "a.mat", units={"*": "m/s²"})
    assert read["channel"].values.tolist() == ["foot", "foot_t"]


# --- xarray's own times --------------------------------------------------------------------------


@pytest.mark.parametrize("resolution", ["ns", "us", "ms"])
@pytest.mark.parametrize("is_date", [True, False])
@pytest.mark.parametrize("form", ["NETCDF4", "NETCDF3_CLASSIC"])
def test_datetime64_and_timedelta64(tmp_path, resolution, is_date, form):
    """Whole intervals of each resolution: 1000 samples a second."""
    steps = (np.arange(512) * {"ns": 10**6, "us": 1000, "ms": 1}[resolution]).astype(
        f"timedelta64[{resolution}]"
    )
    times = np.datetime64("2026-11-28T10:00:00", resolution) + steps if is_date else steps
    data = xr.Dataset({"mic": ("time", SINE, {"units": "Pa"})}, coords={"time": times})
    data.to_netcdf(tmp_path / "a.nc", format=form)
    read = read_recording(tmp_path / "a.nc")
    assert read.attrs["sample_rate_hz"] == pytest.approx(1000.0, rel=1e-12)
    np.testing.assert_array_equal(read["signal"].values[0], SINE)
    assert read.attrs.get("start_time", "")[:19] == ("2026-11-28T10:00:00" if is_date else "")


# --- pairs of E20.12 -----------------------------------------------------------------------------


@pytest.mark.parametrize("per_line", [1, 2])
def test_pairs_of_wide_columns_in_a_universal_file(tmp_path, per_line):
    records = dataset_58("a", SINE, 0.0).splitlines()[:13]
    records[8] = records[8][:20] + f"{0:10d}" + records[8][30:]
    pairs = [f"{t:20.12e}{x:20.12e}" for t, x in zip(TIME_S, SINE, strict=True)]
    lines = ["".join(pairs[n : n + per_line]) for n in range(0, len(pairs), per_line)]
    (tmp_path / "a.uff").write_text("\n".join([*records, *lines, "    -1"]) + "\n")
    read = read_recording(tmp_path / "a.uff")
    np.testing.assert_allclose(read["signal"].values[0], SINE, atol=1e-12)
    assert read.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ, rel=1e-10)
    blocks = open_recording(tmp_path / "a.uff")
    np.testing.assert_array_equal(blocks.read(["a"], 100, 200), read["signal"].values[:, 100:200])


def test_infinity_as_pyuff_writes_it(tmp_path):
    samples = SINE.copy()
    samples[7] = np.finfo(float).max
    (tmp_path / "a.uff").write_text(dataset_58("a", samples, 0.0))
    with pytest.raises(ParameterError, match=r"1 of 512 samples are not finite, the first is .* 8"):
        read_recording(tmp_path / "a.uff")


# --- uneven times --------------------------------------------------------------------------------


def phone(path, suffix):
    """Times of a telephone: 20 or 21 ms apart, at random; a sine of 5 Hz."""
    time_s = np.cumsum(np.random.default_rng(4).choice([0.020, 0.021], 2000)).round(3)
    wave = np.sin(2.0 * np.pi * 5.0 * time_s)
    path = path / f"phone.{suffix}"
    if suffix == "csv":
        rows = [f"{t:.3f},{x:.9f}" for t, x in zip(time_s, wave, strict=True)]
        path.write_text("\n".join(["time [s],acceleration [m/s²]", *rows]) + "\n")
    elif suffix == "h5":
        with h5py.File(path, "w") as file:
            file["acceleration"], file["time"] = wave, time_s
            file["acceleration"].attrs["units"] = "m/s²"
    else:
        from asammdf import MDF, Signal

        with MDF(version="4.10") as file:
            file.append([Signal(wave, time_s, name="acceleration", unit="m/s²")])
            file.save(path)
    return path


@pytest.mark.parametrize("suffix", ["csv", "h5", "mf4"])
def test_times_of_a_telephone_are_resampled(tmp_path, suffix):
    """Amplitude of the sine over the even grid; by row numbers it would be 0.8."""
    path = phone(tmp_path, suffix)
    with pytest.warns(RecordingWarning, match=r"uneven times of 48.* every second sample"):
        read = read_recording(path)
    signal = read["signal"].values[0]
    time_s = np.arange(signal.size) / read.attrs["sample_rate_hz"]
    window = np.hanning(signal.size)
    line = 2.0 * np.sum(signal * window * np.exp(-2j * np.pi * 5.0 * time_s)) / np.sum(window)
    assert abs(line) == pytest.approx(1.0, abs=0.003)
    with pytest.warns(RecordingWarning, match="uneven times"):
        blocks = open_recording(path)
    np.testing.assert_array_equal(blocks.read(["acceleration"], 300, 400)[0], signal[300:400])


def test_rounded_times_are_even():
    """Times of 300 samples a second to the millisecond: 3, 3, 4 ms."""
    time_s = np.arange(3000) / 300.0
    assert rounded_rate_hz(time_s.round(3)) == pytest.approx(300.0, rel=1e-6)
    jitter = np.random.default_rng(5).uniform(-0.002, 0.002, 3000)
    assert rounded_rate_hz(np.sort((time_s + jitter).round(3))) is None


# --- channels that nobody asked for --------------------------------------------------------------


@pytest.mark.filterwarnings("ignore:.*is omitted")
def test_channels_of_unknown_units_are_left_out(tmp_path):
    table = ["time [s],mic [Pa],oil [°C],power [kW]"]
    table += [f"{t:.9f},{x:.6f},61.5,7.5" for t, x in zip(TIME_S, SINE, strict=True)]
    path = tmp_path / "a.csv"
    path.write_text("\n".join(table) + "\n")
    with pytest.warns(RecordingWarning, match="'oil' is omitted: its unit '°C' is unknown"):
        assert read_recording(path)["channel"].values.tolist() == ["mic"]
    with pytest.raises(ParameterError, match="'oil': unit '°C' is unknown"):
        read_recording(path, channels=["mic", "oil"])
    with pytest.warns(RecordingWarning, match="'power' is omitted"):
        read = read_recording(path, units={"oil": "1"})
    assert read["channel"].values.tolist() == ["mic", "oil"]
    with pytest.raises(ParameterError, match="unit '°C' is unknown"):
        read_recording(path, channels=["oil"])


@pytest.mark.parametrize("suffix", ["tdms", "mf4", "h5"])
def test_a_slow_temperature_does_not_shorten_the_others(tmp_path, suffix):
    path, slow = tmp_path / f"a.{suffix}", np.full(3, 61.5)
    if suffix == "tdms":
        with TdmsWriter(str(path)) as writer:
            about = {"wf_increment": 1.0 / RATE_HZ, "unit_string": "Pa"}
            other = {"wf_increment": 0.1, "unit_string": "°C"}
            oil = ChannelObject("g", "oil", slow, properties=other)
            writer.write_segment([ChannelObject("g", "mic", SINE, properties=about), oil])
    elif suffix == "mf4":
        from asammdf import MDF, Signal

        with MDF(version="4.10") as file:
            file.append([Signal(SINE, TIME_S, name="mic", unit="Pa")])
            file.append([Signal(slow, 0.1 * np.arange(3), name="oil", unit="°C")])
            file.save(path)
    else:
        with h5py.File(path, "w") as file:
            for name, x, unit, rate_hz in (("mic", SINE, "Pa", RATE_HZ), ("oil", slow, "°C", 10.0)):
                file[name] = x
                file[name].attrs.update({"units": unit, "fs": rate_hz})
    with pytest.warns(RecordingWarning, match="'oil' is omitted"):
        np.testing.assert_array_equal(read_recording(path)["signal"].values[0], SINE)
    with pytest.warns(RecordingWarning, match="'oil' is omitted"):
        assert open_recording(path).samples == SINE.size


@pytest.mark.parametrize(
    ("unit", "si_unit", "factor"),
    [
        ("in/s", "m/s", 0.0254),
        ("mil", "m", 2.54e-5),
        ("lbf", "N", 4.4482216152605),
        ("psi", "Pa", 6894.757293168),
        ("G", "m/s²", 9.80665),
        ("mg", "m/s²", 9.80665e-3),
        ("µm/s", "m/s", 1e-6),
        ("mN", "N", 1e-3),
        ("nm", "m", 1e-9),
        ("µV", "V", 1e-6),
        ("Hz", "rpm", 60.0),
        ("rev/s", "rpm", 60.0),
        ("tr/min", "rpm", 1.0),
    ],
)
def test_units_of_the_trade(unit, si_unit, factor):
    measured = quantity(unit)
    assert (measured.unit, measured.factor) == (si_unit, pytest.approx(factor, rel=1e-12))


# --- time columns of loggers ---------------------------------------------------------------------

FORMS = {
    "28.11.2026 10:00:{s:06.3f}": "2026-11-28T10:00:00.000",
    "11/28/2026 10:00:{s:06.3f}": "2026-11-28T10:00:00.000",
    "28/11/2026 10:00:{s:06.3f}": "2026-11-28T10:00:00.000",
    "28-Nov-2026 10:00:{s:06.3f}": "2026-11-28T10:00:00.000",
    "2026/11/28 10:00:{s:06.3f}": "2026-11-28T10:00:00.000",
    "2026-11-28 10:00:{s:06.3f}": "2026-11-28T10:00:00.000",
    "2026-11-28T10:00:{s:06.3f}Z": "2026-11-28T10:00:00.000Z",
    "10:00:{s:06.3f}": "",
    "11/28/2026 10:00:{s:06.3f} PM": "2026-11-28T22:00:00.000",
    "5/6/2026 10:00:{s:06.3f}": "",  # May or June
}


@pytest.mark.parametrize(("form", "start"), FORMS.items())
def test_time_stamps_of_loggers(tmp_path, form, start):
    time_s = 0.005 * np.arange(200)
    rows = [f"{form.format(s=t)},{x:.6f}" for t, x in zip(time_s, SINE, strict=False)]
    (tmp_path / "a.csv").write_text("\n".join(["Time,mic [Pa]", *rows]) + "\n")
    read = read_recording(tmp_path / "a.csv")
    assert read.attrs["sample_rate_hz"] == pytest.approx(200.0, rel=1e-9)
    assert read.attrs.get("start_time", "") == start
    np.testing.assert_allclose(read["signal"].values[0], SINE[:200], atol=1e-6)


@pytest.mark.parametrize(
    ("head", "factor"),
    [
        ("Time (sec)", 1.0), ("time [ns]", 1e9), ("time [min]", 1.0 / 60.0), ("t (msec)", 1e3),
        ("duration [min]", 1.0 / 60.0), ("Elapsed Time (seconds)", 1.0), ("Timestamp [us]", 1e6),
        ("time (h)", 1.0 / 3600.0),
    ],
)  # fmt: skip
def test_units_of_time_columns(tmp_path, head, factor):
    rows = [f"{factor * t:.12g},{x:.6f}" for t, x in zip(TIME_S, SINE, strict=True)]
    (tmp_path / "a.csv").write_text("\n".join([f"{head},mic [Pa]", *rows]) + "\n")
    read = read_recording(tmp_path / "a.csv")
    assert read.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ, rel=1e-6)


def test_a_column_named_time_comes_before_one_with_its_unit(tmp_path):
    rows = [f"{t:.12g},{x:.6f},{0.2 + t / 3600.0:.9g}" for t, x in zip(TIME_S, SINE, strict=True)]
    (tmp_path / "a.csv").write_text("\n".join(["time [s],mic [Pa],run time [h]", *rows]) + "\n")
    with pytest.warns(RecordingWarning, match="channel 'run time' is omitted: its unit 'h'"):
        read = read_recording(tmp_path / "a.csv")
    assert read.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ, rel=1e-6)
    assert read["channel"].values.tolist() == ["mic"]


def test_clocks_of_time_stamps():
    clocks = ["9:59:59.5", "10:00:00", "10:00:00.25", "11:00:30"]
    seconds = [1e-9 * (stamp_ns(clock) - stamp_ns("9:00:00")) for clock in clocks]
    np.testing.assert_allclose(seconds, [3599.5, 3600.0, 3600.25, 7230.0])
    assert stamp_ns("12:00:00 AM") == 0
    assert stamp_ns("12:00:00 PM") == stamp_ns("12:00:00") == stamp_ns("14:00:00+02:00")
    assert not is_stamp("25:00:00")
    assert not is_stamp("31.02.2026 10:00:00")


def test_sine_of_the_helper_is_the_same():
    np.testing.assert_allclose(sine(0.0, 512), SINE, atol=1e-12)
