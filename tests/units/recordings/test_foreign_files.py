"""Files as other programs write them: each open, or is refused with what to do."""

import struct

import h5py
import numpy as np
import pytest
import scipy.io
import soundfile
from nptdms import ChannelObject, GroupObject, RootObject, TdmsWriter
from scipy.io import wavfile

from vibroacoustics.base.errors import ParameterError, StorageError
from vibroacoustics.recordings import open_recording, read_recording
from vibroacoustics.recordings.quantities import quantity
from vibroacoustics.recordings.remarks import RecordingWarning

RATE_HZ = 1024.0
SIGNAL = np.random.default_rng(8).standard_normal(500)
TIME_S = np.arange(500) / RATE_HZ


def samples(recording, channel=0):
    return recording["signal"].values[channel]


def write(path, content):
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


# --- UFF 58 --------------------------------------------------------------------------------------


def dataset_58(values, end="\n", blanks=True, kind=1, ordinate=2, width=13):
    """A dataset 58 as its description says, by hand; `blanks`: lines are filled up to 80."""
    names = ["Bearing 1", "NONE", "2026-11-21T10:00:00", "NONE", "NONE"]
    records = [
        "    -1",
        "    58",
        *names,
        f"{kind:5d}{1:10d}{1:5d}{0:10d} {'NONE':10}{1:10d}{3:4d} {'NONE':10}{0:10d}{0:4d}",
        f"{ordinate:10d}{len(values):10d}{1:10d}{0.0:13.5e}{1.0 / RATE_HZ:13.5e}{0.0:13.5e}",
        f"{17:10d}{0:5d}{0:5d}{0:5d} {'Time':20} {'s':20}",
        f"{12:10d}{0:5d}{0:5d}{0:5d} {'Acceleration':20} {'m/s^2':20}",
        f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':20} {'NONE':20}",
        f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':20} {'NONE':20}",
    ]
    form = {13: "{:13.5e}", 20: "{:20.12e}"}[width]
    per_line = {13: 6, 20: 4}[width]
    texts = [form.format(value) for value in values]
    records += ["".join(texts[n : n + per_line]) for n in range(0, len(texts), per_line)]
    records.append("    -1")
    lines = [record.ljust(80) if blanks else record.rstrip() for record in records]
    return end.join(lines) + end


@pytest.mark.parametrize("blanks", [True, False])
@pytest.mark.parametrize("end", ["\n", pytest.param("\r\n", marks=pytest.mark.long)])
@pytest.mark.parametrize(("ordinate", "width", "digits"), [(2, 13, 5), (4, 20, 12)])
def test_uff_with_and_without_trailing_blanks(tmp_path, blanks, end, ordinate, width, digits):
    content = dataset_58(SIGNAL, end, blanks, ordinate=ordinate, width=width)
    path = write(tmp_path / "a.uff", content + dataset_58(2.0 * SIGNAL, end, blanks))
    expected = np.array([float(f"{value:.{digits}e}") for value in SIGNAL])
    found = read_recording(path)
    assert found["channel"].values.tolist() == ["Bearing 1 1", "Bearing 1 2"]
    assert found["channel_unit"].values.tolist() == ["m/s²", "m/s²"]
    assert found.attrs["start_time"] == "2026-11-21T10:00:00"
    np.testing.assert_array_equal(samples(found), expected)
    part = read_recording(path, from_s=100 / RATE_HZ, to_s=305 / RATE_HZ, channels=["Bearing 1 1"])
    np.testing.assert_array_equal(samples(part), expected[100:305])


def test_uff_without_time_response(tmp_path):
    path = write(tmp_path / "a.uff", dataset_58(SIGNAL, kind=4))
    with pytest.raises(ParameterError, match=r"holds no time response .* only functions of type"):
        read_recording(path)
    path = write(tmp_path / "b.uff", "    -1\n   151\nmodel\n    -1\n")
    with pytest.raises(ParameterError, match=r"holds no time response .* its datasets: 151"):
        read_recording(path)


def test_uff_that_is_truncated(tmp_path):
    content = dataset_58(SIGNAL, "\r\n", blanks=False)
    path = write(tmp_path / "a.uff", content[:-60])
    with pytest.raises(StorageError, match="truncated"):
        read_recording(path)


# --- WAV and FLAC --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("suffix", "subtype"),
    [("flac", "PCM_16"), ("flac", "PCM_24"), ("w64", "PCM_16"), ("wav", "ALAW")],
)
def test_flac_and_others_by_libsndfile(tmp_path, suffix, subtype):
    both = 0.1 * np.stack([SIGNAL, -SIGNAL], axis=1)
    soundfile.write(tmp_path / f"a.{suffix}", both, 1024, subtype=subtype)
    names = {"channel 1": "Pa", "channel 2": "V"}
    full_scale = {"channel 1": 20.0, "channel 2": 10.0}
    found = read_recording(tmp_path / f"a.{suffix}", units=names, calibration=full_scale)
    error = {"PCM_16": 2.0**-15, "PCM_24": 2.0**-23, "ALAW": 0.02}[subtype]
    np.testing.assert_allclose(samples(found), 2.0 * SIGNAL, atol=20.0 * error)
    part = read_recording(
        tmp_path / f"a.{suffix}", units={"channel 2": "V"}, calibration={"channel 2": 10.0},
        channels=["channel 2"], from_s=100 / 1024, to_s=200 / 1024,
    )  # fmt: skip
    np.testing.assert_array_equal(samples(part), samples(found, 1)[100:200])


def test_calibration_that_the_recorder_wrote(tmp_path):
    """Comment of Ocean Sonics: 3 V peak at full scale, -170 dB re 1 V/µPa: 948.7 Pa."""
    path = tmp_path / "a.wav"
    wavfile.write(path, 1024, np.arange(-300, 300, dtype="int16"))
    text = b"3.000000 V pk, -170.0 dBV re 1uPa, 32768 = Max Count"
    text += bytes(len(text) % 2)
    listed = b"INFOICMT" + struct.pack("<I", len(text)) + text
    path.write_bytes(path.read_bytes() + b"LIST" + struct.pack("<I", len(listed)) + listed)
    found = read_recording(path)
    pascal = 3.0 * 10.0 ** (170.0 / 20.0) * 1e-6
    assert found["channel_unit"].values.tolist() == ["Pa"]
    np.testing.assert_allclose(found["calibration_factor"], pascal)
    np.testing.assert_allclose(samples(found), np.arange(-300, 300) / 32768.0 * pascal)
    given = read_recording(path, calibration={"channel 1": 2.0})
    np.testing.assert_allclose(given["calibration_factor"], 2.0)
    with pytest.raises(ParameterError, match="give the calibration"):
        read_recording(path, units={"channel 1": "V"})


@pytest.mark.parametrize(
    "kind",
    [
        "int16",
        "float32",
        *(pytest.param(one, marks=pytest.mark.long) for one in ("int32", "uint8")),
    ],
)
def test_part_of_a_wav_file(tmp_path, kind):
    stored = np.arange(200).reshape(100, 2).astype(kind)
    wavfile.write(tmp_path / "a.wav", 100, stored)
    told = {"units": {"channel 2": "Pa"}, "calibration": {"channel 2": 1.0}}
    part = read_recording(tmp_path / "a.wav", channels=["channel 2"], from_s=0.2, to_s=0.7, **told)
    full = read_recording(tmp_path / "a.wav", channels=["channel 2"], **told)
    assert part.sizes["time"] == 50
    np.testing.assert_array_equal(samples(part), samples(full)[20:70])
    blocks = open_recording(tmp_path / "a.wav", channels=["channel 2"], **told)
    np.testing.assert_array_equal(blocks.read(["channel 2"], 20, 70), part["signal"].values)


# --- MAT -----------------------------------------------------------------------------------------


def test_mat_structs(tmp_path):
    runs = {"run": {"mic": SIGNAL, "more": {"acc": 2.0 * SIGNAL}, "Fs": RATE_HZ, "note": "x"}}
    scipy.io.savemat(tmp_path / "a.mat", runs)
    found = read_recording(tmp_path / "a.mat", units={"run.mic": "Pa", "run.more.acc": "m/s2"})
    assert found.attrs["sample_rate_hz"] == RATE_HZ
    np.testing.assert_array_equal(samples(found), SIGNAL)
    np.testing.assert_array_equal(samples(found, 1), 2.0 * SIGNAL)


def test_mat_structs_with_a_time_each(tmp_path):
    runs = {"a": {"y": SIGNAL, "time": TIME_S}, "b": {"y": SIGNAL[:9], "time": 2.0 * TIME_S[:9]}}
    scipy.io.savemat(tmp_path / "a.mat", runs)
    with pytest.raises(ParameterError, match=r"no common time \('a\.y 0 s to 0\.487"):
        read_recording(tmp_path / "a.mat")
    found = read_recording(tmp_path / "a.mat", channels=["b.y"], units={"b.y": "V"})
    assert found.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ / 2.0, rel=1e-12)


def test_mat_7_3_structs(tmp_path):
    with h5py.File(tmp_path / "a.mat", "w", userblock_size=512) as file:
        for name, values in {"run/mic": SIGNAL[None], "run/fs": [[RATE_HZ]]}.items():
            file[name] = np.asarray(values)
            file[name].attrs["MATLAB_class"] = np.bytes_("double")
    with (tmp_path / "a.mat").open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")
    found = read_recording(tmp_path / "a.mat", units={"run.mic": "Pa"})
    np.testing.assert_array_equal(samples(found), SIGNAL)


def test_mat_with_a_variable_twice(tmp_path):
    """As `save -append` of some programs leaves it; a header of 128 bytes stands before."""
    scipy.io.savemat(tmp_path / "a.mat", {"mic": SIGNAL[:7], "fs": RATE_HZ})
    scipy.io.savemat(tmp_path / "b.mat", {"mic": SIGNAL})
    path = write(
        tmp_path / "c.mat",
        (tmp_path / "a.mat").read_bytes() + (tmp_path / "b.mat").read_bytes()[128:],
    )
    with pytest.warns(RecordingWarning, match="'mic' 2 times: the last counts"):
        found = read_recording(path, units={"mic": "Pa"})
    np.testing.assert_array_equal(samples(found), SIGNAL)


def test_time_in_the_first_column(tmp_path):
    table = np.stack([3.0 + TIME_S, SIGNAL, -SIGNAL], axis=1)
    scipy.io.savemat(tmp_path / "a.mat", {"data": table})
    units = {"data 2": "Pa", "data 3": "V"}
    with pytest.warns(RecordingWarning, match="column 1 of data .* taken as the time in s"):
        found = read_recording(tmp_path / "a.mat", units=units)
    assert found["channel"].values.tolist() == ["data 2", "data 3"]
    assert found.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ, rel=1e-12)
    np.testing.assert_array_equal(samples(found, 1), -SIGNAL)


def test_a_counter_in_the_first_column_is_no_time(tmp_path):
    scipy.io.savemat(tmp_path / "a.mat", {"data": np.stack([np.arange(500.0), SIGNAL], axis=1)})
    with pytest.raises(ParameterError, match="states no sample rate"):
        read_recording(tmp_path / "a.mat")


# --- HDF5, TDMS and units ------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["SampleFrequency", "Sampling Rate", "sample_freq_hz", "FS"])
def test_names_of_the_sample_rate(tmp_path, name):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["run/mic"] = SIGNAL
        file["run"].attrs[name] = RATE_HZ
        file["run/mic"].attrs["units"] = "Volts"
    found = read_recording(tmp_path / "a.h5")
    assert found.attrs["sample_rate_hz"] == RATE_HZ
    assert found["channel_unit"].values.tolist() == ["V"]


def test_tdms_without_a_waveform(tmp_path):
    channel = ChannelObject("run", "mic", SIGNAL, properties={"unit_string": "Volts"})
    group = GroupObject("run", properties={"SampleFrequency": RATE_HZ})
    with TdmsWriter(str(tmp_path / "a.tdms")) as writer:
        writer.write_segment([RootObject(), group, channel])
    found = read_recording(tmp_path / "a.tdms")
    assert found.attrs["sample_rate_hz"] == RATE_HZ
    np.testing.assert_array_equal(samples(found), SIGNAL)
    part = read_recording(tmp_path / "a.tdms", from_s=100 / RATE_HZ, to_s=200 / RATE_HZ)
    np.testing.assert_array_equal(samples(part), SIGNAL[100:200])


def segments_with_pauses(path, pauses_s, stated=(True, True, True)):
    """Three segments of 1000 samples of two channels, each after a pause; start times."""
    begin, start_s = np.datetime64("2026-03-01T10:00:00.000000"), 0.0
    with TdmsWriter(str(path)) as writer:
        for pause_s, says in zip(pauses_s, stated, strict=True):
            start_s += pause_s
            properties = {"wf_increment": 1.0 / RATE_HZ, "unit_string": "Pa"}
            if says:
                microseconds = np.timedelta64(round(1e6 * start_s), "us")
                properties["wf_start_time"] = begin + microseconds
            writer.write_segment(
                [
                    ChannelObject("run", name, np.arange(1000.0), properties=properties)
                    for name in ("a", "b")
                ]
            )
            start_s += 1000.0 / RATE_HZ
    return path


def test_gap_between_segments_of_tdms_is_reported(tmp_path):
    path = segments_with_pauses(tmp_path / "a.tdms", [0.0, 0.25, 0.0])
    line = rf"1 gap in the time .* of 0\.25 s at {1000.0 / RATE_HZ:.9g} s: the samples on both"
    with pytest.warns(RecordingWarning, match=line) as told:
        found = read_recording(path)
    assert len(told) == 1
    assert "1 gap in the time" in found.attrs["reading_remarks"]
    assert found.sizes["time"] == 3000
    with pytest.warns(RecordingWarning, match=line):
        open_recording(path)
    read_recording(path, from_s=1001.0 / RATE_HZ)  # warns of nothing


@pytest.mark.parametrize("pauses_s", [[0.0, 0.1, 3.0], [0.0, -0.05, -0.05]])
def test_every_gap_of_tdms_counts(tmp_path, pauses_s):
    path = segments_with_pauses(tmp_path / "a.tdms", pauses_s)
    with pytest.warns(RecordingWarning, match=f"2 gaps in the time .* of {pauses_s[1]:g} s"):
        read_recording(path)


@pytest.mark.parametrize(
    ("pauses_s", "stated"),
    [
        ([0.0, 0.0, 0.0], (True, True, True)),
        ([0.0, 0.0, 0.0], (True, False, True)),
        ([0.0, 0.5, 0.5], (True, False, False)),
        ([0.0, 0.0, 1.2 / 2000.0], (True, True, True)),
    ],
)
def test_tdms_without_a_stated_gap_warns_of_nothing(tmp_path, pauses_s, stated):
    """Segments one after the other, without a start of their own, or off by a sample."""
    read_recording(segments_with_pauses(tmp_path / "a.tdms", pauses_s, stated))


def test_start_that_every_segment_repeats_is_no_gap(tmp_path):
    start = np.datetime64("2026-03-01T10:00:00")
    properties = {"wf_increment": 1e-3, "unit_string": "Pa", "wf_start_time": start}
    with TdmsWriter(str(tmp_path / "a.tdms")) as writer:
        for _ in range(3):
            writer.write_segment(
                [ChannelObject("run", "a", np.arange(100.0), properties=properties)]
            )
    assert read_recording(tmp_path / "a.tdms").sizes["time"] == 300


@pytest.mark.parametrize(
    ("word", "unit"), [("Volts", "V"), ("Pascal", "Pa"), ("newtons", "N"), ("Amps", "A")]
)
def test_units_in_words(word, unit):
    assert quantity(word) == quantity(unit)


# --- CSV -----------------------------------------------------------------------------------------


def table(rows=500, separator=",", stamp=None):
    lines = [separator.join(["time [s]", "mic [Pa]", "acc [m/s²]"])]
    for number in range(rows):
        time = repr(float(TIME_S[number])) if stamp is None else stamp(number)
        lines.append(separator.join([time, repr(float(SIGNAL[number])), repr(float(number))]))
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be", "utf-8-sig"])
def test_csv_in_unicode(tmp_path, encoding):
    path = write(tmp_path / "a.csv", table().encode(encoding))
    found = read_recording(path)
    assert found["channel_unit"].values.tolist() == ["Pa", "m/s²"]
    np.testing.assert_array_equal(samples(found), SIGNAL)


@pytest.mark.parametrize("form", ["{}T{}", "{} {}", "{}T{}Z", "{}T{}+01:00"])
def test_csv_with_time_stamps(tmp_path, form):
    def stamp(number):
        seconds, rest = divmod(number * 1000, 100_000)
        return form.format("2026-11-21", f"23:59:{58 + seconds:02d}.{10 * rest:06d}")

    rows = 150
    lines = table(rows, ";", stamp).replace("time [s]", "Timestamp")
    found = read_recording(write(tmp_path / "a.csv", lines))
    assert found.attrs["sample_rate_hz"] == pytest.approx(100.0, rel=1e-12)
    assert found.attrs["start_time"].startswith("2026-11-21T23:59:58.000000")
    np.testing.assert_array_equal(samples(found), SIGNAL[:rows])
    part = read_recording(tmp_path / "a.csv", from_s=0.5, to_s=1.2, channels=["mic"])
    np.testing.assert_array_equal(samples(part), SIGNAL[50:120])


def test_csv_parts_are_found_without_reading_all(tmp_path):
    path = write(tmp_path / "a.csv", table())
    for begin, end in ((0, 2), (0, 500), (123, 400), (498, 500)):
        part = read_recording(path, from_s=begin / RATE_HZ, to_s=end / RATE_HZ)
        np.testing.assert_array_equal(samples(part), SIGNAL[begin:end])
        assert part.attrs["part_start_s"] == pytest.approx(begin / RATE_HZ, abs=1e-9)
    with pytest.raises(ParameterError, match=r"from_s = 9 s: holds no samples"):
        read_recording(path, from_s=9.0)


def test_csv_that_is_truncated(tmp_path):
    """Within a row, or within its last number, which would be 0.25 of 0.2512."""
    rows = "time [s],mic [Pa]\n0.0,0.1234\n0.1,0.5678\n0.2,0.25"
    for cut in (rows, rows[:-5], rows[:-2]):
        with pytest.warns(RecordingWarning, match="cut short: the file is truncated; that row is"):
            found = read_recording(write(tmp_path / "a.csv", cut))
        assert samples(found).tolist() == [0.1234, 0.5678]
    found = read_recording(write(tmp_path / "a.csv", rows + "12"))
    assert samples(found).tolist() == [0.1234, 0.5678, 0.2512]
