"""Bad recordings: one clear line each, and never more memory than the stated cap."""

import json
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import h5py
import numpy as np
import pytest
import scipy.io
import soundfile
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st
from nptdms import ChannelObject, TdmsWriter
from support import ROOT
from trade_files import lvm, mf4, simcenter, xlsx

from vibroacoustics.base.errors import ParameterError, StorageError, VibroacousticsError
from vibroacoustics.recordings import label_recording, wav_bytes
from vibroacoustics.recordings import read_recording as read
from vibroacoustics.recordings.child_process import _end_of
from vibroacoustics.recordings.reader import readers_by_suffix
from vibroacoustics.recordings.recorded import (
    MAXIMUM_READING_BYTES,
    MAXIMUM_RECORDING_BYTES,
    Request,
    check_size,
)
from vibroacoustics.results import storage

SAMPLES = np.random.default_rng(5).standard_normal((2, 300))
RECORDING = label_recording(SAMPLES, 1000.0, ["a", "b"], ["Pa", "m/s²"])
MOTOR = ROOT / "data" / "recordings" / "electric_motor_vibration.uff"
TEN_GB = 1_342_177_280
"""Samples of 8 bytes in 10 GB (10 GiB)."""


def refused(path: Path, **options) -> str:
    """The message of the refusal, checked to be one line that names the file."""
    with pytest.raises((ParameterError, StorageError)) as caught:
        read(path, **options)
    message = str(caught.value)
    assert len(message.splitlines()) == 1, message
    assert message.startswith(f"{path}: "), message
    return message


def says(message: str, *words: str) -> None:
    missing = [word for word in words if word not in message]
    assert not missing, f"{missing} not in: {message}"


def write(path: Path, content: bytes | str) -> Path:
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def table(tmp_path: Path, *rows: str) -> Path:
    return write(tmp_path / "a.csv", "\n".join(["time [s],a [Pa]", *rows]) + "\n")


# --- files ---------------------------------------------------------------------------------------


def test_files_that_are_none(tmp_path):
    says(refused(tmp_path / "nowhere.wav"), "no such file")
    (tmp_path / "folder.csv").mkdir()
    says(refused(tmp_path / "folder.csv"), "is not a file")
    says(refused(write(tmp_path / "a.wav", b"")), "is empty")
    says(refused(write(tmp_path / "a.mp3", b"x")), "format '.mp3' is unknown", ".wav", ".tdms")


def test_wrong_content(tmp_path):
    content = b"\x00\xffthis is no recording\n" * 40
    paths = [write(tmp_path / f"a{suffix}", content) for suffix in sorted(readers_by_suffix())]
    for path, header in zip(paths, answers(paths), strict=True):
        assert header["error"] == "StorageError", path
        assert header["message"], path


def test_file_over_the_cap(tmp_path):
    path = tmp_path / "a.csv"
    with path.open("wb") as file:
        file.truncate(5 * 2**30)  # takes no room on the disk
    says(refused(path), "has 5 GiB; at most 4 GiB")


def test_labels():
    def label(signal=((1.0, 2.0),), rate=1.0, names=("a",), units=("Pa",), **options):
        with pytest.raises(ParameterError) as caught:
            label_recording(signal, rate, names, units, **options)
        return str(caught.value)

    says(label(calibration={"a": 0.0}), "calibration factor 0: must not be zero")
    says(label(calibration={"a": np.nan}), "calibration factor nan")
    says(label(((1.0, 2.0), (3.0, 4.0)), names=("a", "a"), units=("Pa", "N")), "unique", "'a'")
    says(label(names=("",)), "not empty")
    says(label(names=("a", "b")), "shape (1, 2) for 2 names and 1 units")
    says(label(((1.0,),)), "1 samples", "at least 2")
    says(label(rate=np.inf), "sample_rate_hz = inf Hz")


# --- content -------------------------------------------------------------------------------------


def test_not_finite(tmp_path):
    message = refused(table(tmp_path, "0,1", "1,nan", "2,3"))
    says(message, "channel 'a'", "1 of 3 samples", "sample 2", "nan")
    with pytest.raises(ParameterError, match=r"sample 2 \(inf\)"):
        label_recording([[1.0, 1e300]], 1.0, ["a"], ["g"], {"a": 1e10})


def test_times_that_do_not_grow(tmp_path):
    says(refused(table(tmp_path, "0,1", "1,2", "1,3")), "time does not grow from sample 2 (1 s)")
    says(refused(table(tmp_path, "0,1", "nan,2", "1,3")), "time does not grow")
    rows = [f"{n},{n % 3}" for n in range(40) if n != 17]
    says(refused(table(tmp_path, *rows)), "time has 1 gap, the first of 2 s behind sample 17")


def test_too_short(tmp_path):
    says(refused(table(tmp_path, "0,1")), "1 values; at least 2")
    refused(table(tmp_path))


def test_units(tmp_path):
    path = table(tmp_path, "0,1", "1,2")
    says(refused(path, units={"a": "K"}), "channel 'a'", "unit 'K' is unknown", "Pa, mPa")
    says(refused(path, units={"b": "Pa"}), "units: no channel 'b' among 'a'")
    says(refused(path, calibration={"b": 2.0}), "calibration: no channel 'b'")
    says(refused(path, channels=["x"]), "channel 'x': not in the file, which holds 'a'")
    says(refused(path, channels=[]), "no channel is chosen")
    says(refused(path, sample_rate_hz=0.0), "sample_rate_hz = 0 Hz: must be 0.001 to 1e+09 Hz")
    unnamed = write(tmp_path / "b.csv", "time [s],a\n0,1\n1,2\n")
    says(refused(unnamed), "states no unit for 'a'", "units={'a': 'Pa'}")


TABLES: dict[str, list[str]] = {
    "0,1\n1,2\n": ["its first column counts the rows: give sample_rate_hz"],
    "time [s],a [Pa]\n0,1\n1,2,3\n": ["below its 1 header lines", "row 2"],
    "time [s],a [Pa]\n0,1\n1,x\n": ["'x'", "row 1, column 2"],
    "time [s],a [Pa]\n0,1\n1,\n": ["''", "row 1, column 2"],
    "time [s],a [Pa],b [Pa]\n0,1\n": ["3 columns ('time', 'a', 'b'), the table has 2"],
    "time [weeks],a [Pa]\n0,1\n1,2\n": ["time has the unit 'weeks'"],
    "time [s],t [s],a [Pa]\n0,1,2\n": ["['time', 't'] are all times"],
    "only text\n" * 300: ["no row of numbers in its first 200 lines"],
    "\n\n": ["no row of numbers"],
}


def test_tables(tmp_path):
    paths = [write(tmp_path / f"{n}.csv", content) for n, content in enumerate(TABLES)]
    for words, header in zip(TABLES.values(), answers(paths), strict=True):
        kinds = ("MissingError", "ParameterError", "StorageError", "TooLargeError")
        assert header["error"] in kinds
        says(header["message"], *words)


def test_no_sample_rate(tmp_path):
    scipy.io.savemat(tmp_path / "a.mat", {"a": SAMPLES[0]})
    says(refused(tmp_path / "a.mat"), "states no sample rate", "time_s", "sample_rate_hz")


def test_complex_and_empty_variables(tmp_path):
    scipy.io.savemat(tmp_path / "a.mat", {"a": 1j * SAMPLES[0], "fs": 1.0})
    says(refused(tmp_path / "a.mat"), "channel 'a'", "no real numbers")
    scipy.io.savemat(tmp_path / "a.mat", {"a": [], "fs": 1.0})
    says(refused(tmp_path / "a.mat"), "no vector of numbers", "'a (double)'")


def test_no_other_file_is_read(tmp_path):
    """A dataset in another file, or behind a link to one."""
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["a"] = SAMPLES[0]
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["a"] = h5py.ExternalLink("other.h5", "a")
    says(refused(tmp_path / "a.h5"), "no vector of numbers")
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file.attrs["sample_rate_hz"] = 1.0
        file.create_dataset("a", (300,), "f8", external=[("raw.bin", 0, 2400)])
    says(refused(tmp_path / "a.h5", units={"a": "Pa"}), "stored in another file")


# --- headers that claim too much -----------------------------------------------------------------


def patched(content: bytes, old: bytes, new: bytes) -> bytes:
    assert content.count(old) == 1
    return content.replace(old, new)


def wave(channels: int, claimed: int) -> bytes:
    head = b"RIFF" + (2**32 - 1).to_bytes(4, "little") + b"WAVEfmt \x10\0\0\0\x03\0"
    head += channels.to_bytes(2, "little") + (1000).to_bytes(4, "little")
    head += (8 * channels * 1000).to_bytes(4, "little")
    head += (8 * channels % 65536).to_bytes(2, "little") + b"\x40\0data"
    return head + claimed.to_bytes(4, "little") + bytes(800)


def long_form_wave() -> bytes:
    content = wave(1, 2**32 - 1).replace(b"RIFF", b"RF64")
    sizes = b"ds64\x1c\0\0\0" + b"".join(n.to_bytes(8, "little") for n in (1, 8 * TEN_GB, TEN_GB))
    return content[:12] + sizes + bytes(4) + content[12:]


def mat_claiming(path: Path) -> None:
    scipy.io.savemat(path, {"a": SAMPLES[:1], "fs": 1000.0})
    sides = np.array([1, 300], "<i4").tobytes()
    write(path, patched(path.read_bytes(), sides, np.array([1, TEN_GB], "<i4").tobytes()))


def hdf5_claiming(path: Path, shape: tuple[int, ...], **options) -> None:
    with h5py.File(path, "w") as file:
        file.attrs["sample_rate_hz"] = 1000.0
        file.create_dataset("a", shape, "f8", **options)
        file["a"].attrs["units"] = "Pa"


def tdms(path: Path) -> None:
    known = {"wf_increment": 1e-3, "unit_string": "Pa"}
    with TdmsWriter(str(path)) as writer:
        writer.write_segment(
            [ChannelObject("g", n, x, known) for n, x in zip("ab", SAMPLES, strict=True)]
        )


def tdms_claiming(path: Path) -> None:
    tdms(path)
    count = (300).to_bytes(8, "little")
    write(path, path.read_bytes().replace(count, TEN_GB.to_bytes(8, "little")))


def classic_netcdf(path: Path) -> None:
    dataset = xr.Dataset({"a": ("time", SAMPLES[0], {"units": "Pa"})}, attrs={"fs": 1000.0})
    dataset.to_netcdf(path, format="NETCDF3_64BIT", engine="netcdf4")


def classic_claiming(path: Path) -> None:
    classic_netcdf(path)
    head, tail = path.read_bytes().split((300).to_bytes(4, "big"), 1)
    write(path, head + TEN_GB.to_bytes(4, "big") + tail)


def uff_claiming(path: Path) -> None:
    write(path, patched(MOTOR.read_bytes(), b"    181504", b"%10d" % TEN_GB))


CLAIMS = {
    "a data chunk of 4 GB.wav": lambda path: write(path, wave(1, 2**32 - 1)),
    "65535 channels.wav": lambda path: write(path, wave(65535, 800)),
    "10 GB in the long form.wav": lambda path: write(path, long_form_wave()),
    "10 GB.mat": mat_claiming,
    "10 GB.uff": uff_claiming,
    "10 GB.tdms": tdms_claiming,
    "10 GB, classic.nc": classic_claiming,
    "10 GB, in chunks.h5": lambda path: hdf5_claiming(path, (TEN_GB,), chunks=(1024,)),
    "10 GB, in one piece.h5": lambda path: hdf5_claiming(path, (TEN_GB,)),
    "1 GB, none stored.h5": lambda path: hdf5_claiming(path, (2**27,), chunks=(2**20,)),
    "too wide.h5": lambda path: hdf5_claiming(path, (2**30, 2**30), chunks=(1024, 1024)),
    "10 GB.lvm": lambda path: write(
        path, lvm(path).read_text().replace("Samples\t300\t300", f"Samples\t{TEN_GB}\t{TEN_GB}")
    ),
    "a line of 64 MB.csv": lambda path: write(path, b"1" * 2**26),
    "a line of 64 MB below.csv": lambda path: write(
        path, b"time [s],a [Pa]\n" + b"0,1\n" * 300 + b"1," * 2**25
    ),
}

PEAK = """
def peak():  # ru_maxrss would hold that of the process that started this one
    status = open("/proc/self/status").read()
    return 1024 * int(status.split("VmHWM:")[1].split()[0])
"""

READ_ALL = f"""
import json, resource, sys
{PEAK}
from vibroacoustics.recordings import read_recording
for path in sys.argv[1:]:
    try:
        read_recording(path, units={{"a": "Pa"}} if path.endswith(".mat") else None)
        print("read")
    except Exception as error:
        print(json.dumps([type(error).__name__, str(error)]))
print(peak())
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024)
"""


def run(code: str, *arguments: str) -> subprocess.CompletedProcess:
    command = [sys.executable, "-c", code, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.slow
def test_claims_are_refused_before_anything_is_allocated(tmp_path):
    """The files hold at most 64 MB; the interpreter with its libraries takes about 150 MB, and a
    line of the file is held up to three times. Any claim allocated would show: 1 GB or more.
    """
    paths = [tmp_path / name for name in CLAIMS]
    for path in paths:
        CLAIMS[path.name](path)
    *lines, own, reading = run(READ_ALL, *map(str, paths)).stdout.splitlines()
    assert len(lines) == len(paths)
    for path, line in zip(paths, lines, strict=True):
        assert line != "read", path.name
        kind, message = json.loads(line)
        assert kind in ("ParameterError", "StorageError", "TooLargeError"), message
        assert len(message.splitlines()) == 1
        assert message.startswith(f"{path}: ")
    assert int(own) < 400 * 2**20
    assert int(reading) < 400 * 2**20


def test_size_cap():
    check_size(1, MAXIMUM_RECORDING_BYTES // 16)
    with pytest.raises(StorageError, match="at most 2 GiB are read at once: give from_s"):
        check_size(1, MAXIMUM_RECORDING_BYTES // 16 + 1)


MEMORY_OF_A_RECORDING = f"""
import resource, sys
from vibroacoustics.recordings import read_recording
{PEAK}
read_recording(sys.argv[1], units={{"channel 1": "Pa", "channel 2": "Pa"}})
before = peak()
read_recording(sys.argv[2], units={{"channel 1": "Pa"}})
print(peak() - before, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024)
"""


@pytest.mark.long
def test_memory_of_a_recording_stays_within_the_cap(tmp_path):
    """The cap allows twice the recording, samples and time axis, in either process."""
    samples = 4_000_000
    small = write(tmp_path / "small.wav", wav_bytes(RECORDING))
    one = label_recording(np.ones((1, samples)), 1000.0, ["a"], ["Pa"])
    large = write(tmp_path / "large.wav", wav_bytes(one))
    done = run(MEMORY_OF_A_RECORDING, str(small), str(large))
    grown, reading = map(int, done.stdout.split())
    cap = MAXIMUM_READING_BYTES / MAXIMUM_RECORDING_BYTES * 16 * samples
    assert grown <= cap + 8 * 2**20  # what the allocator keeps besides
    assert reading <= cap + 200 * 2**20  # with the interpreter and its libraries


# --- the reading process -------------------------------------------------------------------------

AS_CHILD = """
import sys, numpy
from vibroacoustics.recordings import child
from vibroacoustics.recordings.reader import Reader
def read(request): {body}
child.readers_by_suffix = lambda: {{".wav": Reader("wav", (".wav",), "WAV", read)}}
child.MAXIMUM_CPU_S = 1
sys.argv[1] = '{{"path": "a.wav", "channels": null, "sample_rate_hz": null}}'
child.main()
"""


def test_the_operating_system_limits_its_memory():
    done = run(AS_CHILD.format(body=f"numpy.ones({MAXIMUM_READING_BYTES})"), "")
    assert json.loads(done.stdout) == {
        "error": "StorageError",
        "message": "needs more than the 4 GiB of memory that reading may take: choose fewer "
        "channels or a shorter part",
        "type": "<f8",
    }


def test_the_operating_system_limits_its_time():
    done = run(AS_CHILD.format(body="\n    while True: pass"), "")
    says(_end_of(done.returncode, b""), "was not read after 600 s")


def test_a_crash_of_a_parser_is_told():
    done = run(AS_CHILD.format(body="import os; os.kill(os.getpid(), 11)"), "")
    says(_end_of(done.returncode, b""), "crashed (SIGSEGV)", "damaged")
    says(_end_of(1, b"Traceback\nImportError: no numpy"), "failed: ImportError: no numpy")


# --- damaged files -------------------------------------------------------------------------------


def mat(path: Path, **options) -> None:
    scipy.io.savemat(path, {"a": SAMPLES[0], "fs": 1000.0}, **options)


GOOD = {
    "a.wav": lambda path: write(path, wav_bytes(RECORDING)),
    "a.flac": lambda path: soundfile.write(path, 0.1 * SAMPLES.T, 1000),
    "plain.mat": mat,
    "packed.mat": lambda path: mat(path, do_compression=True),
    "a.h5": lambda path: hdf5_claiming(path, (300,), data=SAMPLES[0], chunks=(64,)),
    "own.nc": lambda path: storage.write_results(RECORDING, path),
    "classic.nc": classic_netcdf,
    "a.tdms": tdms,
    "a.lvm": lvm,
    "with times.lvm": lambda path: lvm(path, ",", "One"),
    "a.xlsx": xlsx,
    "testlab.mat": simcenter,
    "a.mf4": lambda path: mf4(path, is_slow=False),
    "packed.mf4": lambda path: mf4(path, compression=2, is_slow=False),
    "a.uff": lambda path: write(
        path, patched(b"\n".join(_motor_lines(50)), b"    181504", b"       300")
    ),
}


def _motor_lines(rows: int) -> list[bytes]:
    lines = MOTOR.read_bytes().split(b"\n")
    return [*lines[: 13 + rows], b"    -1".ljust(80), b""]


ANSWER_ALL = """
import hashlib, json, resource, sys, warnings
from pathlib import Path
from vibroacoustics.recordings import child
child._limit(resource.RLIMIT_AS, child.MAXIMUM_READING_BYTES)
warnings.simplefilter("ignore")
for path in sys.argv[1:]:
    header, channels = child.answer(child.Request(Path(path)))
    header["channels"] = hashlib.sha256(b"".join(x.tobytes() for x in channels)).hexdigest()
    print(json.dumps(header), flush=True)
# ru_maxrss would hold that of the process that started this one
print(1024 * int(open("/proc/self/status").read().split("VmHWM:")[1].split()[0]))
"""


def answers(paths: list[Path]) -> list[dict]:
    """What the reading process answers to each file; where it crashes, it goes on behind that."""
    found: list[dict] = []
    while len(found) < len(paths):
        done = run(ANSWER_ALL, *map(str, paths[len(found) :]))
        lines = done.stdout.splitlines()
        if done.returncode == 0:
            assert int(lines.pop()) < 600 * 2**20
            found += map(json.loads, lines)
        else:
            found += [*map(json.loads, lines), {"error": "crash", "message": str(done.returncode)}]
            assert done.returncode < 0, done.stderr
    return found


@pytest.mark.parametrize("name", GOOD)
def test_truncated_and_damaged(tmp_path, name):
    """A truncated file is refused or read whole; one with some bytes changed is refused or read."""
    if name.endswith(".mf4"):
        pytest.importorskip("asammdf")
    good = tmp_path / name
    GOOD[name](good)
    content = good.read_bytes()
    random = np.random.default_rng(6)
    end = len(content.rstrip()) if name.endswith("uff") else len(content)
    cuts = {1, 8, 100, end // 4, end // 2, end - 1, *random.integers(1, end, 20).tolist()}
    paths = [good]
    paths += [write(tmp_path / f"cut {c}{good.suffix}", content[:c]) for c in sorted(cuts)]
    for number in range(60):
        damaged = bytearray(content)
        within = min(len(content), 600 if number % 2 else len(content))  # the header, or anywhere
        for place in random.integers(0, within, 1 + number % 4):
            damaged[place] = random.integers(0, 256)
        paths.append(write(tmp_path / f"changed {number}{good.suffix}", bytes(damaged)))
    first, *others = answers(paths)
    assert first.get("samples") == 300
    for path, header in zip(paths[1:], others, strict=True):
        if path.name.startswith("cut") and "error" not in header:  # padding or comment is cut off
            at_end = ["sha256", *(["units", "calibration"] if path.suffix == ".wav" else [])]
            assert without(header, at_end) == without(first, at_end)
        if "error" in header:
            assert header["error"] in (
                "StorageError", "TooLargeError", "ParameterError", "MissingError", "crash"
            )  # fmt: skip
            assert header["message"]


def without(header: dict[str, object], names: list[str]) -> dict[str, object]:
    """Without what hangs on the end of a file: its hash and, of samples, their comment."""
    return {name: value for name, value in header.items() if name not in names}


def answered(path: Path) -> None:
    """Our own parsers in this process: an error of ours, or channels of one length."""
    with suppress(VibroacousticsError):
        found = readers_by_suffix()[path.suffix].read(Request(path))
        assert len({len(samples) for samples in found.samples}) == 1


TEXTS = st.text(alphabet='0123456789.,;\t\n\r-+e" []()sPagtimeµ²nx', max_size=200)


@settings(max_examples=300, deadline=None)
@given(text=TEXTS, is_below=st.booleans())
def test_any_text_as_table(tmp_path_factory, text, is_below):
    head = "time [s],a [Pa]\n0,1\n" if is_below else ""
    path = tmp_path_factory.getbasetemp() / "any.csv"
    answered(write(path, head + text))


LVM_LINES = st.lists(
    st.sampled_from([
        "Channels\t2", "Channels\t-1", "Samples\t3\t3", "Samples\t99999999999\t99999999999",
        "Delta_X\t0.001\t0.001", "Delta_X\t0\t0", "Delta_X\tnan", "Delta_X\t1e-999\t1e999",
        "X0\t1,5\t", "X0\tx", "Date\t2026/02/31\t", "Time\t25:99", "Separator\tComma",
        "Decimal_Separator\t,", "X_Columns\tMulti", "X_Columns\tNo", "***End_of_Header***",
        "X_Value\ta\tb\tComment", "\t1\t2", "0.001\t1.0\t2.0", "", "\t", "X_Dimension\tTime",
    ]) | st.text(alphabet="0123456789.,;\t-+eEX_ab*", max_size=30),
    max_size=24,
)  # fmt: skip


@settings(max_examples=400, deadline=None)
@given(rows=LVM_LINES, is_whole=st.booleans())
def test_any_lines_as_labview_file(tmp_path_factory, rows, is_whole):
    head = "LabVIEW Measurement\t\n" + "Separator\tTab\n***End_of_Header***\n" * is_whole
    segment = "Channels\t2\nSamples\t2\t2\nDelta_X\t0.1\t0.1\n" * is_whole
    path = tmp_path_factory.getbasetemp() / "any.lvm"
    answered(write(path, head + segment + "\n".join(rows)))


CHUNKS = st.tuples(
    st.sampled_from([b"fmt ", b"data", b"LIST", b"ds64", b"fact"]),
    st.integers(0, 2**32 - 1) | st.integers(0, 64),
    st.binary(max_size=64),
)


@settings(max_examples=300, deadline=None)
@given(kind=st.sampled_from([b"RIFF", b"RIFX", b"RF64"]), chunks=st.lists(CHUNKS, max_size=5))
def test_any_chunks_as_wave(tmp_path_factory, kind, chunks):
    """The walk through the chunks never fails in another way, whatever they claim."""
    from vibroacoustics.recordings.riff import read_wave

    body = b"".join(name + size.to_bytes(4, "little") + rest for name, size, rest in chunks)
    path = write(tmp_path_factory.getbasetemp() / "any.wav", kind + b"\0\0\0\0WAVE" + body)
    with path.open("rb") as file, suppress(StorageError):
        read_wave(file)
