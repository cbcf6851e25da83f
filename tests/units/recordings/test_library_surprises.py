"""Files that a library reads or writes in a way that nobody guesses."""

import struct

import h5py
import numpy as np
import pytest
import scipy.io
from nptdms import ChannelObject, RootObject, TdmsWriter

from vibroacoustics.base.errors import ParameterError, StorageError
from vibroacoustics.recordings import open_recording, read_recording
from vibroacoustics.recordings.interleaved import interleaved_columns
from vibroacoustics.recordings.remarks import RecordingWarning

RATE_HZ = 2048.0
TIME_S = np.arange(512) / RATE_HZ
PRESSURE_PA = 0.1 * np.sqrt(2.0) * np.sin(2.0 * np.pi * 50.0 * TIME_S)


def rms(recording, channel):
    return float(np.sqrt(np.mean(recording["signal"].sel(channel=channel).values ** 2)))


# --- MF4: arrays and structures ------------------------------------------------------------------


def mf4(path, samples, name="mic"):
    from asammdf import MDF, Signal

    with MDF(version="4.10") as file:
        file.append([Signal(samples, TIME_S, name=name, unit="Pa")])
        file.save(path, overwrite=True)
    return path


def records(*columns, names):
    return np.rec.fromarrays(columns, names=names)


def test_elements_of_an_array_are_channels(tmp_path):
    kind = np.dtype([("array", "(2,)<f8")])
    table = np.rec.fromarrays([np.c_[PRESSURE_PA, 2.0 * PRESSURE_PA]], dtype=kind)
    path = mf4(tmp_path / "a.mf4", table, "array")
    with pytest.warns(RecordingWarning, match="'array' is an array or structure: its elements"):
        read = read_recording(path, units={"*": "Pa"})
    assert read["channel"].values.tolist() == ["array[0]", "array[1]"]
    np.testing.assert_array_equal(read["signal"].values, [PRESSURE_PA, 2.0 * PRESSURE_PA])
    with pytest.raises(ParameterError, match="each sample is a structure of 'array': choose"):
        read_recording(path, channels=["array"])


def test_fields_of_a_structure_are_channels(tmp_path):
    table = records(PRESSURE_PA, 3.0 * PRESSURE_PA, names="left,right")
    with pytest.warns(RecordingWarning, match="'pair' is an array or structure"):
        read = read_recording(mf4(tmp_path / "a.mf4", table, "pair"), units={"*": "Pa"})
    assert rms(read, "right") == pytest.approx(3.0 * rms(read, "left"))


@pytest.mark.parametrize("factor", [2.0, -1.0, 30.0])
def test_columns_that_asammdf_writes_as_one_channel_are_named(tmp_path, factor):
    """The file holds half of the numbers, row after row: nothing in it says so."""
    path = mf4(tmp_path / "a.mf4", np.c_[PRESSURE_PA, factor * PRESSURE_PA])
    with pytest.warns(RecordingWarning, match="'mic': its samples look like 2 columns"):
        read_recording(path)


def test_plain_channels_do_not_look_like_columns():
    noise = np.random.default_rng(3).standard_normal(4096)
    time = np.arange(4096) / 4096.0
    assert interleaved_columns(noise) == interleaved_columns(np.cumsum(noise)) == 1
    for frequency in (5.0, 200.0, 512.0, 1000.0, 1024.0, 1600.0):
        assert interleaved_columns(np.sin(2.0 * np.pi * frequency * time)) == 1
    assert interleaved_columns(np.sign(np.sin(2.0 * np.pi * 30.0 * time))) == 1
    assert interleaved_columns((np.sin(30.0 * time)[:, None] * [1.0, 2.0, 4.0]).ravel()) == 3


# --- TDMS: what changes between segments ---------------------------------------------------------


def tdms(path, *segments, values=None):
    """Write segments of counts of 16 bits, each with its properties."""
    counts = np.rint(PRESSURE_PA / 5e-5).astype("int16") if values is None else values
    with TdmsWriter(str(path)) as writer:
        for part, properties in zip(np.split(counts, len(segments)), segments, strict=True):
            about = {"wf_increment": 1.0 / RATE_HZ, "unit_string": "Pa", **properties}
            writer.write_segment([ChannelObject("g", "mic", part, properties=about)])
    return path


def linear(slope, offset=0.0):
    return {
        "NI_Scaling_Status": "unscaled", "NI_Number_Of_Scales": 1,
        "NI_Scale[0]_Scale_Type": "Linear", "NI_Scale[0]_Linear_Slope": slope,
        "NI_Scale[0]_Linear_Y_Intercept": offset,
    }  # fmt: skip


def test_each_segment_has_the_scale_that_it_states(tmp_path):
    """The second range is ten times wider: npTDMS scales all by the last."""
    counts = np.rint(PRESSURE_PA / 5e-5)
    counts[256:] /= 10.0
    path = tdms(tmp_path / "a.tdms", linear(5e-5), linear(5e-4), values=counts.astype("int16"))
    read = read_recording(path)
    np.testing.assert_allclose(read["signal"].values[0], PRESSURE_PA, atol=5e-4)
    blocks = open_recording(path)
    np.testing.assert_array_equal(
        blocks.read(["mic"], 200, 300)[0], read["signal"].values[0, 200:300]
    )


def test_a_scale_with_an_offset_in_one_segment(tmp_path):
    read = read_recording(tdms(tmp_path / "a.tdms", linear(5e-5, 1.0), linear(5e-5)))
    np.testing.assert_allclose(read["signal"].values[0, :256], PRESSURE_PA[:256] + 1.0, atol=5e-5)
    np.testing.assert_allclose(read["signal"].values[0, 256:], PRESSURE_PA[256:], atol=5e-5)


def test_a_scale_stated_after_all_samples_is_that_of_all(tmp_path):
    path = tdms(tmp_path / "a.tdms", {})
    with TdmsWriter(str(path), mode="a") as writer:
        empty = ChannelObject("g", "mic", np.empty(0, "int16"), properties=linear(5e-5))
        writer.write_segment([RootObject(), empty])
    read = read_recording(path)
    np.testing.assert_allclose(read["signal"].values[0], PRESSURE_PA, atol=5e-5)


def test_a_unit_that_changes_is_refused_with_its_place(tmp_path):
    scale = linear(5e-5)
    path = tdms(tmp_path / "a.tdms", scale, scale | {"unit_string": "mPa"})
    with pytest.raises(ParameterError, match=r"unit_string changes from Pa to mPa at sample 257 "):
        read_recording(path)
    half = read_recording(path, to_s=0.1)
    np.testing.assert_allclose(half["signal"].values[0], PRESSURE_PA[:205], atol=5e-5)


def test_an_increment_that_changes_is_refused(tmp_path):
    path = tdms(tmp_path / "a.tdms", linear(5e-5), linear(5e-5) | {"wf_increment": 1.0 / 1024.0})
    with pytest.raises(ParameterError, match=r"sample 257 \(0\.125 s\): save the parts"):
        read_recording(path)


def test_a_scale_that_the_library_does_not_know_is_refused(tmp_path):
    scale = linear(5e-5) | {"NI_Scale[0]_Scale_Type": "Reciprocal"}
    with pytest.raises(StorageError, match=r"its scale \(Reciprocal\) from sample 1 on is unknown"):
        read_recording(tdms(tmp_path / "a.tdms", scale))


def test_a_scale_of_the_group_and_of_samples_already_scaled(tmp_path):
    done = linear(7.0) | {"NI_Scaling_Status": "scaled"}
    path = tdms(tmp_path / "a.tdms", done, done, values=PRESSURE_PA)
    np.testing.assert_array_equal(read_recording(path)["signal"].values[0], PRESSURE_PA)


# --- counts with a unit --------------------------------------------------------------------------


def counts_hdf5(path, **attributes):
    with h5py.File(path, "w") as file:
        file["mic"] = np.rint(PRESSURE_PA / 5e-5).astype("int16")
        file["mic"].attrs.update({"units": "Pa", "fs": RATE_HZ, **attributes})
    return path


@pytest.mark.parametrize(
    "name", ["conversion", "calibration_factor", "sensitivity", "Gain", "scale"]
)
def test_the_factor_of_counts_is_named(tmp_path, name):
    path = counts_hdf5(tmp_path / "a.h5", **{name: 5e-5})
    words = rf"'mic': samples are whole numbers of 16 bits with the unit 'Pa'; {name} = 5e-05 may"
    with pytest.raises(ParameterError, match=words):
        read_recording(path)
    read = read_recording(path, calibration={"mic": 5e-5})
    np.testing.assert_allclose(read["signal"].values[0], PRESSURE_PA, atol=5e-5)


def test_counts_without_any_factor_are_refused(tmp_path):
    with pytest.raises(ParameterError, match="and without a factor: give it, as in calibration"):
        read_recording(counts_hdf5(tmp_path / "a.h5"))
    with pytest.raises(ParameterError, match="'mic': samples are whole numbers of 16 bits"):
        read_recording(tdms(tmp_path / "a.tdms", {}))
    packed = read_recording(counts_hdf5(tmp_path / "b.h5", scale_factor=5e-5))
    np.testing.assert_allclose(packed["signal"].values[0], PRESSURE_PA, atol=5e-5)


def test_whole_numbers_of_a_speed_are_values(tmp_path):
    path = tmp_path / "a.h5"
    with h5py.File(path, "w") as file:
        file["speed"] = np.arange(600, 700, dtype="int16")
        file["speed"].attrs.update({"units": "rpm", "fs": 100.0})
    assert read_recording(path)["signal"].values[0, 5] == 605.0


# --- netCDF: the valid range ---------------------------------------------------------------------


@pytest.mark.parametrize(
    "attributes",
    [
        {"valid_range": np.array([-100, 100], dtype="int16")},
        {"valid_max": np.int16(100)},
        {"valid_min": np.int16(-100)},
        {"valid_min": np.int16(-100), "valid_max": np.int16(100)},
    ],
)
@pytest.mark.parametrize("form", ["NETCDF4", "NETCDF3_CLASSIC"])
def test_samples_outside_the_valid_range_are_missing(tmp_path, attributes, form):
    """The range is that of the packed numbers (CF-1.11, 2.5.1)."""
    import netCDF4

    stored = np.arange(-50, 50).astype("int16")
    stored[17] = -101 if "valid_max" not in attributes else 101
    with netCDF4.Dataset(tmp_path / "a.nc", "w", format=form) as file:
        file.createDimension("time", stored.size)
        file.fs = RATE_HZ
        mic = file.createVariable("mic", "i2", ("time",))
        mic.set_auto_maskandscale(False)
        mic.units = "Pa"
        mic.scale_factor = 0.01
        for name, value in attributes.items():
            mic.setncattr(name, value)
        mic[:] = stored
    with pytest.raises(ParameterError, match=r"1 of 100 .*outside the valid range .*sample 18 "):
        read_recording(tmp_path / "a.nc")
    part = read_recording(tmp_path / "a.nc", from_s=20 / RATE_HZ)
    np.testing.assert_allclose(part["signal"].values[0], 0.01 * stored[20:])


# --- arrays of other shapes ----------------------------------------------------------------------


def test_hdf5_records_are_read_by_field(tmp_path):
    table = np.empty(512, dtype=[("t", "f8"), ("mic", "f4"), ("name", "S3"), ("pair", "f8", (2,))])
    table["t"], table["mic"] = TIME_S, PRESSURE_PA
    table["pair"] = np.c_[PRESSURE_PA, 2.0 * PRESSURE_PA]
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["table"] = table
    read = read_recording(tmp_path / "a.h5", units={"*": "Pa"})
    assert read["channel"].values.tolist() == ["table.mic", "table.pair 1", "table.pair 2"]
    assert read.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ)
    np.testing.assert_array_equal(read["signal"].values[2], 2.0 * PRESSURE_PA)


@pytest.mark.parametrize("suffix", ["h5", "mat"])
def test_an_array_of_three_dimensions_is_named(tmp_path, suffix):
    path, cube = tmp_path / f"a.{suffix}", np.ones((512, 3, 2))
    if suffix == "mat":
        scipy.io.savemat(path, {"mic": PRESSURE_PA, "cube": cube, "fs": RATE_HZ})
    else:
        with h5py.File(path, "w") as file:
            file["mic"], file["cube"], file["fs"] = PRESSURE_PA, cube, RATE_HZ
    with pytest.warns(RecordingWarning, match=r"'cube' of shape \(512, 3, 2\) is not read"):
        assert read_recording(path, units={"*": "Pa"})["channel"].values.tolist() == ["mic"]
    with pytest.raises(ParameterError, match="'cube': not in the file, which holds 'mic'"):
        read_recording(path, channels=["cube"])


def test_big_endian_and_single_precision_of_hdf5(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["mic"] = PRESSURE_PA.astype(">f4")
        file["fs"] = struct.unpack(">d", struct.pack(">d", RATE_HZ))[0]
    read = read_recording(tmp_path / "a.h5", units={"*": "Pa"})
    np.testing.assert_array_equal(read["signal"].values[0], PRESSURE_PA.astype("f4"))
