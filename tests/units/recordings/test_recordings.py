"""Recordings in: every format gives back, bit by bit, what was written, with unit and rate."""

import hashlib
import io
import os
import struct
import sys
import wave
from pathlib import Path

import h5py
import numpy as np
import pytest
import scipy.io
import xarray as xr
from documents import MOSQITO
from evidence import claim
from nptdms import ChannelObject, TdmsWriter
from scipy.io import wavfile
from support import ROOT

from vibroacoustics.base import vocabulary
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.recordings import (
    csv_bytes,
    label_recording,
    read_recording,
    wav_bytes,
)
from vibroacoustics.recordings.quantities import QUANTITIES, find_quantity, quantity
from vibroacoustics.recordings.readers import csv_table
from vibroacoustics.recordings.recorded import Request
from vibroacoustics.recordings.remarks import RecordingWarning
from vibroacoustics.recordings.riff import scale_comment, stated_scales, with_comment
from vibroacoustics.recordings.time_axis import even_part
from vibroacoustics.results import storage

MOTOR = ROOT / "data" / "recordings" / "electric_motor_vibration.uff"
RATE_HZ = 51200.0 / 3.0
EPS = np.finfo(float).eps
SIGNAL = np.random.default_rng(4).standard_normal((3, 400))
NAMES = ["microphone, front", "housing x", "tacho"]
UNITS = ["Pa", "m/s²", "V"]
TIME_S = np.arange(400) / RATE_HZ


@pytest.fixture(scope="module")
def recording() -> xr.Dataset:
    return label_recording(SIGNAL, RATE_HZ, NAMES, UNITS)


def write(path: Path, content: bytes) -> Path:
    path.write_bytes(content)
    return path


def units_of(found: xr.Dataset) -> list[str]:
    return found["channel_unit"].values.tolist()


def check_same(found: xr.Dataset, names=NAMES, units=UNITS, signal=SIGNAL) -> None:
    """Samples bit by bit, names and units."""
    assert found["signal"].dtype == np.float64
    assert found["signal"].values.tobytes() == np.ascontiguousarray(signal, dtype=float).tobytes()
    assert found["channel"].values.tolist() == list(names)
    assert units_of(found) == list(units)
    vocabulary.check(found, ["signal"])


# --- the labelled form ---------------------------------------------------------------------------


def test_labelled_form(recording):
    check_same(recording)
    assert recording.attrs == {"sample_rate_hz": RATE_HZ}
    assert recording["time"].values.tobytes() == TIME_S.tobytes()
    assert recording["calibration_factor"].values.tolist() == [1.0, 1.0, 1.0]
    assert recording["time"].attrs["units"] == "s"


def test_units_and_calibration_are_applied():
    found = label_recording(
        [[1.0, -2.0], [3.0, 4.0], [10.0, 20.0]],
        1000.0,
        ["a", "b", "c"],
        ["g", "mm/s", "rpm"],
        {"a": 0.5, "c": 100.0},
    )
    factors = [0.5 * 9.80665, 1e-3, 100.0]
    assert found["calibration_factor"].values.tolist() == factors
    assert units_of(found) == ["m/s²", "m/s", "rpm"]
    expected = np.array([[1.0, -2.0], [3.0, 4.0], [10.0, 20.0]]) * np.array(factors)[:, None]
    assert found["signal"].values.tolist() == expected.tolist()


def test_labelling_leaves_the_callers_samples_alone():
    samples = np.array([[1.0, 2.0]])
    label_recording(samples, 10.0, ["a"], ["g"])
    assert samples.tolist() == [[1.0, 2.0]]


@pytest.mark.parametrize(
    ("spelling", "unit"),
    [
        ("m/s2", "m/s²"),
        ("m/s^2", "m/s²"),
        ("m/s**2", "m/s²"),
        ("m s-2", "m/s²"),
        ("m s^-2", "m/s²"),
        ("m·s⁻²", "m/s²"),
        (" g ", "g"),
        ("Nm", "N m"),
        ("N*m", "N m"),
        ("N·m", "N m"),
        ("μPa", "µPa"),
        ("uPa", "µPa"),
        ("1/min", "rpm"),
        ("deg", "°"),
        ("-", "1"),
    ],
)
def test_spellings_of_units(spelling, unit):
    assert quantity(spelling) == QUANTITIES[unit]


@pytest.mark.parametrize("unit", ["", "pa", "MPa", "Gs", "dB", "m/s³", "PSI", "n", "K"])
def test_units_that_are_not_in_the_list_are_not_guessed(unit):
    assert find_quantity(unit) is None
    with pytest.raises(ParameterError, match="unknown; known are Pa,"):
        quantity(unit)


def test_the_si_unit_of_each_unit_is_in_the_list_with_factor_one():
    for unit, found in QUANTITIES.items():
        assert quantity(unit) == found
        assert quantity(found.unit) == (found.kind, found.unit, 1.0)


# --- time axes -----------------------------------------------------------------------------------


def even_rate_hz(time_s, request):
    return even_part(lambda first, last: time_s[first:last], len(time_s), request)[2]


def test_rate_is_that_of_the_end_points_and_not_rounded():
    rate = even_rate_hz(12.5 + TIME_S, Request(Path("x")))
    # t carries rounding of 2⁻⁵³ · 12.5 s at both ends of 399 / RATE_HZ = 23.4 ms
    assert abs(rate / RATE_HZ - 1.0) <= 2.0 * 12.5 * EPS / TIME_S[-1]


def test_rounded_times_within_the_tolerance():
    times = np.round(np.arange(5000) / 51200.0, 6)  # off by 0.5 µs, 0.026 intervals, at most
    rate = even_rate_hz(times, Request(Path("x")))
    assert rate == pytest.approx(51200.0, rel=1e-6 / times[-1], abs=0.0)


def test_uneven_times():
    times = np.arange(100) * 1e-3
    times[50] += 6e-5
    with pytest.raises(ParameterError, match=r"sample 51 lies 0\.06 .* give sample_rate_hz"):
        even_rate_hz(times, Request(Path("x")))
    assert even_rate_hz(times, Request(Path("x"), None, 1000.0)) == 1000.0


def test_a_part_begins_and_ends_at_the_nearest_samples():
    """Samples 0.1 s apart over 10 s: a time belongs to the one up to 0.05 s away."""
    times = 12.5 + 0.1 * np.arange(101)

    def part(from_s, to_s):
        request = Request(Path("x"), from_s=from_s, to_s=to_s)
        return even_part(lambda first, last: times[first:last], times.size, request)[:2]

    assert part(2.04, 4.06) == (20, 41)
    assert part(1.96, 3.94) == (20, 39)


def test_gaps_all_over_are_uneven_times():
    """One step of five is double: no part is without a gap, so none is advised."""
    times = 1e-3 * np.cumsum([0, *([1, 1, 1, 1, 2] * 20)])
    with pytest.raises(ParameterError, match="time is not even"):
        even_rate_hz(times, Request(Path("x")))
    times = 1e-3 * np.cumsum([0, *([1, 1, 1, 1, 2] + [1] * 95)])
    with pytest.raises(ParameterError, match=r"time has 1 gap, the first of 0\.002 s behind"):
        even_rate_hz(times, Request(Path("x")))


# --- WAV -----------------------------------------------------------------------------------------


def test_wav_round_trip_in_floats(recording, tmp_path):
    whole = recording.assign_attrs(sample_rate_hz=51200.0)
    path = write(tmp_path / "a.wav", wav_bytes(whole))
    names = ["channel 1", "channel 2", "channel 3"]
    found = read_recording(path)  # the file's comment holds the units
    check_same(found, names)
    assert found.attrs["sample_rate_hz"] == 51200.0
    assert found.attrs["source_file"] == "a.wav"
    assert found.attrs["source_sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.mark.parametrize(
    ("comment", "scales"),
    [
        (scale_comment([(0.5, "Pa"), (1e-6, "m/s²")]), [(0.5, "Pa"), (1e-6, "m/s²")]),
        (scale_comment([(0.5, "Pa")]), []),  # of one channel, the file has two
        ("vibroacoustics: 0.5 Pa, -1.0 V at full scale", []),
        ("vibroacoustics: 0.5 Pa, e V at full scale", []),
        ("vibroacoustics: 0.5 Pa, V at full scale", []),
        ("0.5 Pa, 1.0 V at full scale", []),
    ],
)
def test_comments_of_another_form_state_nothing(comment, scales):
    assert stated_scales(comment, 2) == scales


@pytest.mark.parametrize("kind", ["float32", "int16"])
def test_a_wav_states_its_scale_unless_another_is_given(tmp_path, kind):
    samples = np.array([0.25, -0.5, 0.75, 0.0])
    stored = samples.astype(kind) if kind == "float32" else (samples * 2**15).astype(kind)
    content = io.BytesIO()
    wavfile.write(content, 48000, stored)
    stating = with_comment(content.getvalue(), scale_comment([(20.0, "Pa")]))
    path = write(tmp_path / "a.wav", stating)
    found = read_recording(path)["signal"]
    np.testing.assert_allclose(found.values[0], 20.0 * samples)
    assert found["channel_unit"].values == ["Pa"]
    louder = read_recording(path, calibration={"*": 40.0})["signal"]
    np.testing.assert_allclose(louder.values[0], 40.0 * samples)
    volt = read_recording(path, units={"*": "V"}, calibration={"*": 1.0})["signal"]
    np.testing.assert_allclose(volt.values[0], samples)
    assert volt["channel_unit"].values == ["V"]
    (_, again) = wavfile.read(path)
    np.testing.assert_array_equal(again, stored)


def test_wav_states_whole_rates_only(recording):
    with pytest.raises(ParameterError, match=r"17066\.66.*whole Hz only"):
        wav_bytes(recording)


@pytest.mark.parametrize("width", [1, 2, 3, 4])
def test_wav_integers_are_fractions_of_full_scale(tmp_path, width):
    """Written by Python's own `wave`, which knows nothing of SciPy's reader."""
    half_range = 2 ** (8 * width - 1)
    stored = [-half_range, -half_range // 2, 0, half_range // 2, half_range - 1]
    offset = 128 if width == 1 else 0  # 8 bits are unsigned
    with wave.open(str(tmp_path / "a.wav"), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(width)
        file.setframerate(48000)
        file.writeframes(
            b"".join((v + offset).to_bytes(width, "little", signed=width > 1) for v in stored)
        )
    with pytest.warns(RecordingWarning, match="2 samples are at full scale, the first at 0 s"):
        found = read_recording(
            tmp_path / "a.wav", units={"channel 1": "Pa"}, calibration={"channel 1": 20.0}
        )
    expected = [v / half_range * 20.0 for v in stored]
    assert found["signal"].values[0].tolist() == expected


def test_wav_integers_need_a_calibration(tmp_path):
    wavfile.write(tmp_path / "a.wav", 48000, np.arange(9, dtype="int16"))
    with pytest.raises(ParameterError, match="fractions of full scale: give the calibration"):
        read_recording(tmp_path / "a.wav", units={"channel 1": "Pa"})


def test_wav_needs_a_unit(tmp_path):
    wavfile.write(tmp_path / "a.wav", 48000, SIGNAL[0])
    with pytest.raises(ParameterError, match=r"states no unit for 'channel 1'.*units=\{"):
        read_recording(tmp_path / "a.wav")


# --- CSV -----------------------------------------------------------------------------------------


def test_csv_round_trip(recording, tmp_path):
    found = read_recording(write(tmp_path / "a.csv", csv_bytes(recording)))
    check_same(found)
    # (N-1) / fl((N-1)/rate): two roundings
    assert abs(found.attrs["sample_rate_hz"] / RATE_HZ - 1.0) <= 2.0 * EPS


@pytest.mark.parametrize("name", ["=1+1", "+a", "-a", "@a", "'=a", "'a"])
def test_a_channel_that_would_be_a_formula_is_defused_and_read_back(tmp_path, name):
    made = label_recording([SIGNAL[0]], RATE_HZ, [name], ["Pa"])
    content = csv_bytes(made)
    assert content.startswith(b"time [s],'")
    assert list(read_recording(write(tmp_path / "a.csv", content))["channel"].values) == [name]


CSV_TABLES = {
    "comma": "time [s],a [Pa],b [g]\n0,1,2\n0.5,3,4\n",
    "semicolon and decimal comma": "time [s];a [Pa];b [g]\n0,0;1;2\n0,5;3,0;4,0\n",
    "tab, round brackets": "t (s)\ta (Pa)\tb (g)\n0\t1\t2\n0.5\t3\t4\n",
    "tab and decimal comma": "t (s)\ta (Pa)\tb (g)\n0,0\t1\t2\n0,5\t3\t4\n",
    "row of units": "Time,a,b\ns,Pa,g\n0,1,2\n0.5,3,4\n",
    "row of units in brackets": "Time;a;b\r\n[s];[Pa];[g]\r\n0;1;2\r\n0,5;3;4\r\n",
    "lines above": 'recorder "X"\nserial 7; 8\n\ntime [s],a [Pa],b [g]\n0,1,2\n0.5,3,4\n',
    "milliseconds, quoted names": '"time [ms]","a [Pa]","b [g]"\n0,1,2\n500,3,4\n',
    "time in the middle, byte-order mark": "\ufeffa [Pa],time [s],b [g]\n1,0,2\n3,.5,4\n",
}


@pytest.mark.parametrize("table", CSV_TABLES.values(), ids=CSV_TABLES)
def test_csv_forms(tmp_path, table):
    found = csv_table.read(Request(write(tmp_path / "a.csv", table.encode())))
    assert (found.names, found.units, found.sample_rate_hz) == (["a", "b"], ["Pa", "g"], 2.0)
    assert np.array(found.samples).tolist() == [[1.0, 3.0], [2.0, 4.0]]


def test_csv_in_latin_1_and_without_time(tmp_path):
    path = write(tmp_path / "a.txt", "housing x [m/s²]\n1\n-2\n".encode("latin-1"))
    found = read_recording(path, sample_rate_hz=1000.5)
    check_same(found, ["housing x"], ["m/s²"], [[1.0, -2.0]])
    assert found.attrs["sample_rate_hz"] == 1000.5
    with pytest.raises(ParameterError, match=r"no column 'time \[s\]'"):
        read_recording(path)


def test_channels_in_the_order_asked_for(recording, tmp_path):
    path = write(tmp_path / "a.csv", csv_bytes(recording))
    found = read_recording(path, channels=["tacho", "housing x"], units={"tacho": "1"})
    check_same(found, ["tacho", "housing x"], ["1", "m/s²"], SIGNAL[[2, 1]])


# --- MAT -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("compressed", [False, True])
def test_mat_round_trip(tmp_path, compressed):
    content = {"mic": SIGNAL[0], "acc": SIGNAL[1:2].T, "t": TIME_S, "note": "a text"}
    scipy.io.savemat(tmp_path / "a.mat", content, do_compression=compressed)
    found = read_recording(tmp_path / "a.mat", units={"mic": "Pa", "acc": "m/s^2"})
    check_same(found, ["mic", "acc"], ["Pa", "m/s²"], SIGNAL[:2])
    assert abs(found.attrs["sample_rate_hz"] / RATE_HZ - 1.0) <= 2.0 * EPS


def test_mat_table_and_stated_rate(tmp_path):
    scipy.io.savemat(tmp_path / "a.mat", {"data": SIGNAL.T, "fs": RATE_HZ})
    names = ["data 1", "data 2", "data 3"]
    found = read_recording(tmp_path / "a.mat", units=dict(zip(names, UNITS, strict=True)))
    check_same(found, names)
    assert found.attrs["sample_rate_hz"] == RATE_HZ


def test_mat_4(tmp_path):
    scipy.io.savemat(tmp_path / "a.mat", {"mic": SIGNAL[0], "fs": 1000.0}, format="4")
    found = read_recording(tmp_path / "a.mat", units={"mic": "Pa"})
    check_same(found, ["mic"], ["Pa"], SIGNAL[:1])


def test_mat_7_3(tmp_path):
    """As MATLAB writes it: HDF5 after a header of 512 bytes, arrays transposed."""
    path = tmp_path / "a.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, values in {"mic": SIGNAL[:1], "fs": [[RATE_HZ]]}.items():
            file[name] = np.asarray(values)
            file[name].attrs["MATLAB_class"] = np.bytes_("double")
        file["text"] = np.array([[104], [105]], dtype="uint16")
        file["text"].attrs["MATLAB_class"] = np.bytes_("char")
    with path.open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")
    found = read_recording(path, units={"mic": "Pa"})
    check_same(found, ["mic"], ["Pa"], SIGNAL[:1])
    assert found.attrs["sample_rate_hz"] == RATE_HZ


def test_mat_lists_what_it_holds(tmp_path):
    scipy.io.savemat(tmp_path / "a.mat", {"run": {"mic": "x"}, "label": "x"})
    with pytest.raises(ParameterError, match=r"'run \(struct\)', 'label \(char\)'"):
        read_recording(tmp_path / "a.mat")


def test_variables_of_several_lengths(tmp_path):
    scipy.io.savemat(tmp_path / "a.mat", {"a": np.arange(5.0), "b": np.arange(9.0), "fs": 10.0})
    with pytest.raises(ParameterError, match=r"'a 5', 'b 9'.*choose channels"):
        read_recording(tmp_path / "a.mat")
    found = read_recording(tmp_path / "a.mat", channels=["b"], units={"b": "N"})
    assert found["signal"].shape == (1, 9)


# --- HDF5 and netCDF -----------------------------------------------------------------------------


def test_own_form_as_netcdf(recording, tmp_path):
    found = read_recording(storage.write_results(recording, tmp_path / "a.nc"))
    check_same(found)
    assert found.attrs["sample_rate_hz"] == RATE_HZ


def test_own_form_with_more_channels_than_samples(tmp_path):
    wide = label_recording(SIGNAL[:, :2], RATE_HZ, NAMES, UNITS)
    check_same(read_recording(storage.write_results(wide, tmp_path / "a.nc")), signal=SIGNAL[:, :2])


def test_hdf5_datasets_with_attributes(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        for name, unit, samples in zip(["p", "run/x", "run/n"], UNITS, SIGNAL, strict=True):
            file.create_dataset(name, data=samples, chunks=(64,), compression="gzip")
            file[name].attrs.update({"units": unit, "sample_rate_hz": RATE_HZ})
        file["run"].attrs["comment"] = "nothing"
    found = read_recording(tmp_path / "a.h5", channels=["p", "run/x", "run/n"])
    check_same(found, ["p", "run/x", "run/n"])
    assert found.attrs["sample_rate_hz"] == RATE_HZ


@pytest.mark.parametrize("kind", ["NETCDF3_CLASSIC", "NETCDF3_64BIT", "NETCDF4"])
def test_netcdf_of_others(tmp_path, kind):
    dataset = xr.Dataset(
        {"p": ("time", SIGNAL[0], {"units": "Pa"})},
        coords={"time": ("time", TIME_S * 1e3, {"units": "ms"})},
        attrs={"start_time": "2026-11-21T10:00:00"},
    )
    dataset.to_netcdf(tmp_path / "a.nc", format=kind, engine="netcdf4")
    found = read_recording(tmp_path / "a.nc")
    check_same(found, ["p"], ["Pa"], SIGNAL[:1])
    # t · 1e3 · 1e-3 and the quotient: four roundings
    assert abs(found.attrs["sample_rate_hz"] / RATE_HZ - 1.0) <= 4.0 * EPS
    assert found.attrs["start_time"] == "2026-11-21T10:00:00"


def test_rate_and_time_axis_that_disagree(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["p"] = np.arange(1000.0)
        file["time"] = np.arange(1000) / 51200.0
        file.attrs["sample_rate_hz"] = 48000.0
    with pytest.raises(ParameterError, match="rate of 48000 Hz, but its time axis has 51200 Hz"):
        read_recording(tmp_path / "a.h5", units={"p": "Pa"})
    found = read_recording(tmp_path / "a.h5", units={"p": "Pa"}, sample_rate_hz=51200.0)
    assert found.attrs["sample_rate_hz"] == 51200.0


# --- UFF -----------------------------------------------------------------------------------------


def _motor_by_hand() -> tuple[float, np.ndarray]:
    """Sampling interval and samples of the motor's file, read by the columns of the format."""
    lines = MOTOR.read_text(encoding="latin-1").splitlines()
    interval = float(lines[8][43:56])
    values = [
        float(line[start : start + 13])
        for line in lines[13:-1]
        for start in range(0, len(line.rstrip()), 13)
    ]
    return interval, np.array(values)


def test_motor_recording():
    interval, samples = _motor_by_hand()
    found = read_recording(MOTOR)
    check_same(found, ["Acceleration"], ["m/s²"], samples[None])
    assert samples.size == 181504
    assert interval == 1.95312e-05
    assert found.attrs["sample_rate_hz"] == 1.0 / 1.95312e-05
    assert found.attrs["start_time"] == "28/jul/2021 10:28:51"
    # The first six values as printed in the file.
    printed = [-612.284, -736.045, -783.707, -843.571, -765.933, -483.865]
    assert found["signal"].values[0, :6].tolist() == printed
    claim(
        "Root mean square of a motor's recorded acceleration", kind="recording", unit="m/s²",
        source=MOSQITO("column of numbers by awk"), reference=MOTOR_RMS, tolerance=1e-6 * MOTOR_RMS,
        computed=np.sqrt(np.mean(found["signal"].values ** 2)), topics=("measured",),
    )  # fmt: skip


MOTOR_RMS = 512.392331
"""rms of the file's column of numbers by awk, m/s²."""


def test_the_users_rate_overrides_the_rounded_one():
    assert read_recording(MOTOR, sample_rate_hz=51200.0).attrs["sample_rate_hz"] == 51200.0


@pytest.mark.parametrize("binary", [0, 1])
def test_uff_round_trip(tmp_path, binary):
    import pyuff

    file = pyuff.UFF(str(tmp_path / "a.uff"))
    rounded = SIGNAL.astype(np.float32).astype(float) if binary else np.round(SIGNAL, 6)
    for name, unit, samples in zip(NAMES, ["Pa", "g", "NONE"], rounded, strict=True):
        file.write_sets(
            pyuff.prepare_58(
                binary=binary,
                func_type=1,
                rsp_node=1,
                rsp_dir=1,
                ref_node=1,
                ref_dir=1,
                data=samples,
                x=TIME_S,
                id1=name,
                abscissa_spacing=1,
                ordinate_spec_data_type=0,
                orddenom_spec_data_type=0,
                z_axis_spec_data_type=0,
                abscissa_inc=1.0 / RATE_HZ,
                abscissa_min=0.0,
                ordinate_axis_units_lab=unit,
            ),
            "add",
        )
    found = read_recording(
        tmp_path / "a.uff", units={"tacho": "V"}, calibration={"housing x": 1 / 9.80665}
    )
    factors = found["calibration_factor"].values[:, None]
    check_same(found, NAMES, UNITS, rounded * factors)
    # E13.5: six digits
    assert found.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ, rel=5e-6, abs=0.0)


# --- TDMS ----------------------------------------------------------------------------------------


def tdms_channel(name, samples, group="run", **properties) -> ChannelObject:
    known = {"wf_increment": 1.0 / RATE_HZ, "unit_string": "Pa"}
    return ChannelObject(group, name, samples, properties=known | properties)


def write_tdms(path: Path, *channels: ChannelObject) -> Path:
    with TdmsWriter(str(path)) as writer:
        writer.write_segment(list(channels))
    return path


def test_tdms_round_trip(tmp_path):
    rows = [
        tdms_channel(name, samples, unit_string=unit)
        for name, samples, unit in zip(NAMES, SIGNAL, UNITS, strict=True)
    ]
    found = read_recording(write_tdms(tmp_path / "a.tdms", *rows))
    check_same(found)
    assert found.attrs["sample_rate_hz"] == 1.0 / (1.0 / RATE_HZ)


@pytest.mark.filterwarnings("ignore:.*different times")
def test_tdms_channels_that_differ(tmp_path):
    path = write_tdms(
        tmp_path / "a.tdms",
        tdms_channel("fast", SIGNAL[0], group="A"),
        tdms_channel("slow", SIGNAL[1, :40], group="B", wf_increment=1e-3),
    )
    with pytest.warns(RecordingWarning, match=r"'B/slow': samples of 1000 Hz .* to 17066\.7 Hz"):
        assert read_recording(path).attrs["sample_rate_hz"] == pytest.approx(17066.67, rel=1e-6)
    assert read_recording(path, channels=["B/slow"]).attrs["sample_rate_hz"] == 1000.0


@pytest.mark.parametrize(("package", "suffix"), [("soundfile", "flac"), ("nptdms", "tdms")])
@pytest.mark.usefixtures("own_process")
def test_missing_extra_is_named(tmp_path, monkeypatch, package, suffix):
    """The reading process finds a package that cannot be imported first."""
    (tmp_path / f"{package}.py").write_text(f"raise ModuleNotFoundError(name={package!r})")
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")
    path = write(tmp_path / f"a.{suffix}", MOTOR.read_bytes())
    with pytest.raises(Exception, match=rf"needs {package}: pip install vibroacoustics\[io\]"):
        read_recording(path)


def test_no_module_beside_a_recording_is_run(tmp_path, monkeypatch):
    (tmp_path / "numpy.py").write_text("raise SystemExit('run')")
    monkeypatch.chdir(tmp_path)
    wavfile.write("a.wav", 48000, SIGNAL[0])
    assert read_recording("a.wav", units={"channel 1": "Pa"})["signal"].shape == (1, 400)


# --- simulated against measured ------------------------------------------------------------------


def test_simulated_force_with_tacho_as_csv(thesis_study, tmp_path):
    """The Copeland's force over 20 revolutions at 3000 rpm and a pulse a revolution, and back."""
    from support import wrench_orders

    force, _ = wrench_orders(thesis_study, "none", 3000.0)
    angle = 2.0 * np.pi * 50.0 * np.arange(20 * 512) / 25600.0
    order = np.arange(force.shape[-1])[:, None]
    wave_n = np.real(force[0][:, None] * np.exp(1j * order * angle)).sum(axis=0)
    tacho = (np.mod(angle, 2.0 * np.pi) < 0.1).astype(float)
    made = label_recording([wave_n, tacho], 25600.0, ["force x", "tacho"], ["N", "1"])
    found = read_recording(write(tmp_path / "force.csv", csv_bytes(made)))
    xr.testing.assert_identical(found["signal"], made["signal"])
    assert np.count_nonzero(np.diff(found["signal"].values[1]) > 0.5) == 19  # begins with a pulse


def test_the_reading_process_needs_no_labelled_arrays():
    """It starts for each file, so it must not load what it does not need."""
    import subprocess

    code = "import sys, vibroacoustics.recordings.child; print('xarray' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_rf64(tmp_path):
    """A WAV file with 64-bit sizes, put together by hand."""
    samples = SIGNAL[0].astype("<f8").tobytes()
    body = b"WAVEds64" + struct.pack("<IQQQI", 28, 80 + len(samples), len(samples), 400, 0)
    body += b"fmt " + struct.pack("<IHHIIHH", 16, 3, 1, 48000, 48000 * 8, 8, 64)
    body += b"data" + struct.pack("<I", 2**32 - 1) + samples
    path = write(tmp_path / "a.wav", b"RF64" + struct.pack("<I", 2**32 - 1) + body)
    found = read_recording(path, units={"channel 1": "Pa"})
    check_same(found, ["channel 1"], ["Pa"], SIGNAL[:1])
