"""What a file says of its values counts, and what is wrong with them is told."""

import warnings
from pathlib import Path

import h5py
import netCDF4
import numpy as np
import pytest
import scipy.io
from scipy.io import wavfile

from vibroacoustics.base.errors import ParameterError, StorageError
from vibroacoustics.recordings import read_recording
from vibroacoustics.recordings.overload import overload
from vibroacoustics.recordings.remarks import RecordingWarning

RATE_HZ = 1000.0
TIME_S = np.arange(2000) / RATE_HZ
TONE = np.sin(2.0 * np.pi * 37.3 * TIME_S)
PACKING = {"scale_factor": 1.0 / 20000.0, "add_offset": 0.25}
FILL = -32768
MOTOR = Path(__file__).parents[3] / "data/recordings/electric_motor_vibration.uff"


def stored_tone(gap=None):
    stored = np.round((TONE - PACKING["add_offset"]) / PACKING["scale_factor"]).astype("int16")
    if gap is not None:
        stored[gap] = FILL
    return stored


def write_netcdf(path, kind, stored, **attributes):
    with netCDF4.Dataset(path, "w", format=kind) as file:
        file.createDimension("time", stored.size)
        fill = attributes.pop("_FillValue", None)
        variable = file.createVariable("mic", stored.dtype, ("time",), fill_value=fill)
        variable.set_auto_maskandscale(False)
        variable.setncatts({"units": "Pa", **attributes})
        variable[:] = stored
        file.setncattr("sample_rate_hz", RATE_HZ)
    return path


def write_hdf5(path, stored, **attributes):
    with h5py.File(path, "w") as file:
        file["mic"] = stored
        file["mic"].attrs.update({"units": "Pa", **attributes})
        file.attrs["sample_rate_hz"] = RATE_HZ
    return path


@pytest.mark.parametrize("kind", ["NETCDF3_CLASSIC", "NETCDF3_64BIT", "NETCDF4"])
def test_packed_netcdf(tmp_path, kind):
    path = write_netcdf(tmp_path / "a.nc", kind, stored_tone(), **PACKING, _FillValue=FILL)
    found = read_recording(path)["signal"].values[0]
    np.testing.assert_allclose(found, TONE, atol=0.51 * PACKING["scale_factor"])
    part = read_recording(path, from_s=0.5, to_s=1.0)["signal"].values[0]
    np.testing.assert_array_equal(part, found[500:1000])


@pytest.mark.parametrize(
    "given", [["scale_factor"], ["add_offset"], ["scale_factor", "add_offset"]]
)
def test_packed_hdf5(tmp_path, given):
    attributes = {name: PACKING[name] for name in given}
    stored = stored_tone()
    path = write_hdf5(tmp_path / "a.h5", stored, **attributes)
    expected = stored * attributes.get("scale_factor", 1.0) + attributes.get("add_offset", 0.0)
    np.testing.assert_array_equal(read_recording(path)["signal"].values[0], expected)


@pytest.mark.parametrize("name", ["_FillValue", "missing_value"])
def test_fill_values_are_gaps(tmp_path, name):
    stored = stored_tone(gap=slice(1200, 1205))
    path = write_hdf5(tmp_path / "a.h5", stored, **PACKING, **{name: np.int16(FILL)})
    with pytest.raises(
        ParameterError,
        match=r"channel 'mic': 5 of 2000 samples are missing \(fill value -32768\), the first is "
        r"sample 1201 \(1\.2 s\)",
    ):
        read_recording(path)
    part = read_recording(path, to_s=1.2)["signal"].values[0]
    np.testing.assert_allclose(part, TONE[:1200], atol=0.51 * PACKING["scale_factor"])


@pytest.mark.parametrize("kind", ["NETCDF3_CLASSIC", "NETCDF4"])
def test_values_that_netcdf_never_wrote_are_gaps(tmp_path, kind):
    with netCDF4.Dataset(tmp_path / "a.nc", "w", format=kind) as file:
        file.createDimension("time", 50)
        variable = file.createVariable("mic", "f4", ("time",))
        variable.setncatts({"units": "Pa"})
        variable[:40] = np.arange(40.0)
        file.setncattr("sample_rate_hz", RATE_HZ)
    with pytest.raises(ParameterError, match="10 of 50 samples are missing"):
        read_recording(tmp_path / "a.nc")


def test_unsigned_values_of_classic_netcdf(tmp_path):
    stored = np.array([0, 100, 200, 250, 3], dtype="u1")
    path = write_netcdf(tmp_path / "a.nc", "NETCDF3_CLASSIC", stored.view("i1"), _Unsigned="true")
    assert read_recording(path)["signal"].values[0].tolist() == stored.tolist()


# --- overload ------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["int16", "int32", "uint8"])
def test_full_scale_of_whole_numbers(tmp_path, kind):
    limits = np.iinfo(kind)
    middle, half = (limits.max + limits.min + 1) / 2, (limits.max - limits.min + 1) / 2
    stored = np.clip(np.round(middle + 1.1 * half * TONE), limits.min, limits.max).astype(kind)
    wavfile.write(tmp_path / "a.wav", 1000, stored)
    at = np.flatnonzero((stored == limits.min) | (stored == limits.max))
    told = {"units": {"channel 1": "Pa"}, "calibration": {"channel 1": 2.0}}
    line = (
        f"channel 'channel 1': {at.size} samples are at full scale, the first at {at[0] / 1000} s"
    )
    with pytest.warns(RecordingWarning, match=line):
        read_recording(tmp_path / "a.wav", **told)
    behind = int(at[at > 500][0])
    with pytest.warns(RecordingWarning, match=f"the first at {behind / 1000} s"):
        read_recording(tmp_path / "a.wav", from_s=0.5, to_s=1.0, **told)


def test_clipped_floats(tmp_path):
    clipped = np.clip(TONE, -2.0, 0.9)
    scipy.io.savemat(tmp_path / "a.mat", {"mic": clipped, "rpm": clipped, "fs": RATE_HZ})
    at = np.flatnonzero(clipped == 0.9)
    with pytest.warns(
        RecordingWarning, match=rf"'mic': {at.size} samples .* {at[0] / 1000} s"
    ) as all_:
        read_recording(tmp_path / "a.mat", units={"mic": "Pa", "rpm": "rpm"})
    assert len(all_) == 1  # a speed may stay


RANDOM = np.random.default_rng(3).standard_normal(20000)
SAMPLE = np.arange(51200)
PHASES = np.random.default_rng(5).uniform(0.0, 2.0 * np.pi, 12)
OVER_DB = [0.5, 1.0, 3.0, 4.0, 6.0, 12.0, 20.0, 40.0]


def at_full_scale(signal):
    return signal / np.max(np.abs(signal))


def orders(cycles_a_sample):
    lines = (
        np.sin(2.0 * np.pi * order * cycles_a_sample * SAMPLE + phase) / order
        for order, phase in enumerate(PHASES, 1)
    )
    return at_full_scale(sum(lines))


def low_noise(share_of_rate):
    spectrum = np.fft.rfft(np.random.default_rng(6).standard_normal(SAMPLE.size))
    spectrum[int(share_of_rate * SAMPLE.size) :] = 0.0
    return at_full_scale(np.fft.irfft(spectrum))


LOUD = {
    "a tone": np.sin(2.0 * np.pi * 997.3 / 51200.0 * SAMPLE + 0.3),
    "a tone of whole samples a period": np.sin(2.0 * np.pi * SAMPLE / 48.0),
    "a tone of whole samples a period between them": np.sin(2.0 * np.pi * (SAMPLE + 0.5) / 32.0),
    "orders": orders(48.3 / 51200.0),
    "orders of whole samples a revolution": orders(1.0 / 1024.0),
    "noise": low_noise(0.04),
}


@pytest.mark.parametrize("over_db", OVER_DB)
@pytest.mark.parametrize("signal", LOUD.values(), ids=LOUD)
def test_every_overload_is_found(signal, over_db):
    loud = 10.0 ** (over_db / 20.0) * signal
    clipped = np.clip(loud, -1.0, 1.0)
    at = np.flatnonzero(np.abs(loud) >= 1.0)
    for stored in (clipped, (20.0 * clipped).astype("f4"), 1e-3 * np.round(30000.0 * clipped)):
        found = overload(stored)
        assert found is not None
        full = np.flatnonzero(np.abs(stored) == np.max(np.abs(stored)))
        assert (found.samples, found.first) == (full.size, full[0])
        assert set(at) <= set(full)


RATIOS = [(p, q) for q in range(2, 13) for p in range(1, q // 2 + 1) if np.gcd(p, q) == 1]
SHIFTS = [0.0, 0.25, 0.3]
RATIONAL = {
    f"a tone of {p}/{q} of the rate, {shift}": np.sin(2.0 * np.pi * (p * SAMPLE / q + shift))
    for p, q in RATIOS
    for shift in (*SHIFTS, 1.0 / (4.0 * q))
    if np.ptp(np.sin(2.0 * np.pi * (p * np.arange(q) / q + shift))) > 1e-9
}
SLOW = 2.0 * np.pi * 1.7 * TIME_S
PULSE = np.hanning(40)
CLEAN = RATIONAL | {
    "a tone": TONE,
    "a tone of whole samples a period": np.sin(2.0 * np.pi * np.arange(2000) / 40.0),
    "a tone near an eighth of the rate": np.sin(2.0 * np.pi * (1.0 / 8.0 + 1e-9) * SAMPLE),
    "a tone in coarse steps": np.round(TONE * 20.0),
    "a slow tone in coarse steps": np.round(np.sin(SLOW) * 50.0),
    "a slow tone in three steps": np.round(np.sin(SLOW) * 1.4),
    "a flat peak in coarse steps": np.round((np.sin(SLOW) + np.sin(3.0 * SLOW) / 9.0) * 50.0),
    "a slow tone of three digits": np.array([float(f"{value:.3g}") for value in np.sin(SLOW)]),
    "orders": orders(48.3 / 51200.0),
    "orders of whole samples a revolution": orders(1.0 / 1024.0),
    "noise": RANDOM,
    "noise in coarse steps": np.round(RANDOM * 3.0),
    "an idle channel": np.where(RANDOM > 1.0, 0.1, 0.2),
    "an idle channel in three steps": np.round(RANDOM * 0.4),
    "blows of a hammer": np.convolve(SAMPLE % 9999 == 5000, PULSE, "same") - 0.003,
    "silence before": np.concatenate([np.zeros(500), TONE**2]),
    "one value and a glitch": np.where(SAMPLE == 7, 3.5, 3.0),
    "a constant": np.full(100, 3.0),
}


def test_clean_signals_are_many():
    assert len(CLEAN) >= 60


@pytest.mark.parametrize("signal", CLEAN.values(), ids=CLEAN)
def test_what_is_no_overload(signal):
    assert overload(signal) is None


@pytest.mark.parametrize("share", [0.999, 0.95, 0.5])
def test_clipped_noise_is_an_overload(share):
    smooth = np.convolve(RANDOM, np.ones(8) / 8.0, "same")  # a recorder's filter
    level = np.quantile(np.abs(smooth), share)
    found = overload(np.clip(smooth, -level, level))
    assert found is not None
    assert found.samples == np.count_nonzero(np.abs(smooth) >= level)


def test_a_signal_clipped_on_one_side():
    found = overload(np.clip(TONE, -2.0, 0.9))
    assert found is not None
    assert found.samples == np.count_nonzero(TONE >= 0.9)


@pytest.mark.parametrize(
    ("unit", "reported"),
    [("Pa", True), ("m/s²", True), ("m/s", True), ("N", True)]
    + [(unit, False) for unit in ("V", "1", "rpm", "°")],
)
def test_pulses_are_told_from_overloads_by_unit(tmp_path, unit, reported):
    square = np.clip(100.0 * TONE, -1.0, 1.0)
    scipy.io.savemat(tmp_path / "a.mat", {"one": square, "fs": RATE_HZ})
    with warnings.catch_warnings(record=True) as all_:
        warnings.simplefilter("always")
        read_recording(tmp_path / "a.mat", units={"one": unit})
    assert [warning.category for warning in all_] == [RecordingWarning] * reported


def test_a_clipped_voltage_is_reported(tmp_path):
    scipy.io.savemat(tmp_path / "a.mat", {"one": np.clip(TONE, -0.9, 0.9), "fs": RATE_HZ})
    with pytest.warns(RecordingWarning, match="full scale"):
        read_recording(tmp_path / "a.mat", units={"one": "V"})


def test_a_real_recording_is_not_overloaded():
    read_recording(MOTOR)  # a warning would be an error


# --- gaps in the time ----------------------------------------------------------------------------


@pytest.mark.parametrize("given", [{}, {"sample_rate_hz": RATE_HZ}])
def test_a_gap_in_the_times(tmp_path, given):
    times = TIME_S + np.where(np.arange(2000) >= 700, 0.5, 0.0)
    scipy.io.savemat(tmp_path / "a.mat", {"mic": TONE, "t": times})
    with pytest.raises(
        ParameterError,
        match=r"1 gap, the first of 0\.501 s behind sample 700 \(0\.699 s\).*to_s = 0\.699",
    ):
        read_recording(tmp_path / "a.mat", units={"mic": "Pa"}, **given)
    before = read_recording(tmp_path / "a.mat", units={"mic": "Pa"}, to_s=0.7, **given)
    behind = read_recording(tmp_path / "a.mat", units={"mic": "Pa"}, from_s=1.2, **given)
    np.testing.assert_array_equal(before["signal"].values[0], TONE[:700])
    np.testing.assert_array_equal(behind["signal"].values[0], TONE[700:])


@pytest.mark.parametrize(("place", "value", "words"), [(12, 2, "must be 4"), (14, 32, "must be 8")])
def test_a_wav_whose_block_contradicts_its_channels_is_refused(tmp_path, place, value, words):
    """Bytes of a sample, or bits, beside two channels of 16 bits in 4 bytes."""
    wavfile.write(tmp_path / "a.wav", 1000, np.zeros((100, 2), "int16"))
    content = bytearray((tmp_path / "a.wav").read_bytes())
    content[content.index(b"fmt ") + 8 + place] = value
    (tmp_path / "a.wav").write_bytes(content)
    with pytest.raises(StorageError, match=words):
        read_recording(tmp_path / "a.wav", units={"*": "Pa"}, calibration={"*": 1.0})
