"""Headers that claim more than their file holds, files that are cut, heads with unclear marks."""

import json
import subprocess
import sys
import warnings
from pathlib import Path

import h5py
import numpy as np
import pytest
from kinds_of_files import HALF
from lying_files import HONEST, LIES, RATES, options_of
from support import command_here, without_progress
from trade_files import RATE_HZ, SIGNALS, lvm

from vibroacoustics.base.errors import ParameterError, StorageError
from vibroacoustics.recordings import child, open_recording, read_recording
from vibroacoustics.recordings.readers.hdf5 import _check_bytes
from vibroacoustics.recordings.recorded import Request
from vibroacoustics.recordings.remarks import RecordingWarning

MOST_S, MOST_BYTES = 2.0, 500 * 2**20
COMMANDS = {
    "orders": ["--rpm", "2900", "--maximum-order", "8"],
    "track": ["--rpm", "2900", "--bandwidth", "4"],
    "map": ["--rpm", "2900", "--resolution", "20"],
    "tones": [],
    "export": [],
    "sound-power": ["--hemisphere", "1"],
}

ANSWERS = """
import json, os, resource, sys, time
from pathlib import Path
from vibroacoustics.recordings import child
import h5py, nptdms, openpyxl, scipy.io, soundfile
child._limit(resource.RLIMIT_AS, child.MAXIMUM_READING_BYTES)
for path in sys.argv[1:]:
    for part in ({}, {"samples": [0, 0], "opening": [None, None]}):
        before = time.process_time()
        fields = {"path": path, "channels": None, "sample_rate_hz": None, **part}
        header, _ = child.answer(child._request(fields))
        spent = time.process_time() - before
        print(json.dumps([path, header.get("error"), header.get("message"), spent]), flush=True)
print(1024 * int(open("/proc/self/status").read().split("VmHWM:")[1].split()[0]))
"""


def write_all(folder: Path, writers: dict) -> list[Path]:
    for name, write in writers.items():
        write(folder / name)
    return [folder / name for name in writers]


def without_mdf(writers: dict) -> dict:
    """Without the files whose library takes seconds to import; long tests have them too."""
    return {name: write for name, write in writers.items() if not name.endswith((".mf4", ".mdf"))}


def command_line(name: str, path: Path) -> list[str]:
    """A command on a file, with what the file does not state."""
    given = options_of(path.name)
    words = [name, str(path), *COMMANDS[name]]
    for option, values in (
        ("--unit", given.get("units")),
        ("--calibration", given.get("calibration")),
    ):
        words += [
            word for key, value in (values or {}).items() for word in (option, f"{key}={value}")
        ]
    return [*words, "--out", str(path.with_name("out" + ".csv" * (name == "export")))]


# --- claims --------------------------------------------------------------------------------------


def test_claims_are_refused_in_little_time_and_memory(tmp_path):
    """At once and as the header of blocks: nothing is planned by the claim.

    The libraries of these formats take 150 MB; the limit of a command is that of two processes.
    """
    paths = write_all(tmp_path, without_mdf(LIES))
    done = subprocess.run(
        [sys.executable, "-c", ANSWERS, *map(str, paths)],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    *lines, peak = done.stdout.splitlines()
    assert len(lines) == 2 * len(paths) >= 80
    for path, error, message, spent in map(json.loads, lines):
        assert error in ("StorageError", "TooLargeError", "ParameterError"), path
        assert len(message.splitlines()) == 1
        assert "at most 2 GiB are read at once" not in message, path
        assert spent < MOST_S, path
    assert int(peak) < MOST_BYTES / 2


WORDS = {
    "68 billion.flac": "claims 68719476735 samples, its 1736 bytes can hold 9480730 at most",
    "data of 10 GB.w64": "chunk 'data' claims 10737418240 bytes, 2424 follow",
    "a billion.mat": "claims 1073741824 values in variable 'microphone', its 5120 bytes can hold",
    "10 billion in chunks.h5": "dataset 'a' is incomplete: 0 of 10485760 chunks stored",
    "a billion, classic.nc": "claims more values than its 5072 bytes can hold: ",
    "a billion.uff": "points in dataset 'microphone', its 13996 bytes can hold 6998 at most",
    "10 billion.tdms": "claims 10737418240 samples of /'run'/'microphone' and holds 300",
    "10 billion.mf4": "claims 10737418240 samples of channel 'microphone', its 8",
    "200 thousand rows.xlsx": "part 'xl/worksheets/sheet2.xml' claims 12046201 bytes in ",
    "far row.xlsx": "claims more than the 1048576 rows that a sheet can hold",
    "10 billion.lvm": "claims 10737418240 samples, its 6457 bytes can hold 3228 at most",
    "99999999 channels.lvm": "claims 99999999 channels and names 3",
}


@pytest.mark.parametrize("name", WORDS)
def test_a_command_says_what_is_claimed_and_what_the_file_can_hold(tmp_path, name):
    if name.endswith(".mf4"):
        pytest.importorskip("asammdf")
    (path,) = write_all(tmp_path, {name: LIES[name]})
    outcome = command_here(*command_line("orders", path))
    assert outcome.returncode == 2
    (line,) = outcome.stderr.splitlines()
    assert line.startswith(f"error: {path}: ")
    assert WORDS[name] in line
    assert [each.name for each in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize(("filters", "ratio"), [({}, 1), ({"compression": "gzip"}, 1032)])
def test_chunks_hold_no_more_than_their_filters_can_pack(tmp_path, filters, ratio):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        dataset = file.create_dataset("a", data=HALF[0], chunks=(64,), shuffle=True, **filters)
        file.flush()
        most = (tmp_path / "a.h5").stat().st_size * ratio // dataset.dtype.itemsize
        _check_bytes("values", dataset, most)
        with pytest.raises(StorageError, match=f"claims {most + 1} values, its .* hold {most} at"):
            _check_bytes("values", dataset, most + 1)


def test_the_last_sample_of_a_claim_is_read_before_blocks_are_planned(tmp_path):
    """A claim that compression allows: 20 thousand samples of 300 in a FLAC file."""
    (path,) = write_all(tmp_path, {"20 thousand.flac": LIES["20 thousand.flac"]})
    with pytest.raises(StorageError, match="claims 20000 samples, of which 19999 to 20000 cannot"):
        open_recording(path, **options_of(path.name))


def test_a_part_that_is_stored_is_read_and_one_that_is_not_is_refused(tmp_path):
    path = tmp_path / "a.h5"
    with h5py.File(path, "w") as file:
        file.attrs["sample_rate_hz"] = RATE_HZ
        stored = file.create_dataset("a", (2**30,), "f4", chunks=(1024,))
        stored.attrs["units"] = "Pa"
        stored[: 8 * 1024] = 1.0
    assert open_recording(path, to_s=8.0).read(["a"], 8000, 8192).tolist() == [[1.0] * 192]
    for part in ({}, {"to_s": 9.0}, {"from_s": 4.0}):
        with pytest.raises(StorageError, match=r"is incomplete: \d+ of "):
            open_recording(path, **part)


@pytest.mark.parametrize("command", COMMANDS)
def test_rates_that_no_recorder_has(tmp_path, command):
    """A rate that nothing can be computed from is one line; no memory is planned by it."""
    paths = write_all(tmp_path, RATES)
    with warnings.catch_warnings(action="ignore"):
        for path in paths:
            outcome = command_here(*command_line(command, path))
            assert outcome.returncode in (0, 2), (path.name, outcome.stderr)


@pytest.mark.long
@pytest.mark.parametrize("command", COMMANDS)
def test_lies_in_processes_of_their_own(tmp_path, command):
    """Processor time of all processes, with the start of the program; memory of two of them.

    An honest file takes longer: it is analysed. The limit is that of the machine at rest; where it
    is not, as long as a command on no file at all, and a second.
    """
    pytest.importorskip("asammdf")
    idle_s, *_ = measured(command_line(command, tmp_path / "none.wav"))
    for path in write_all(tmp_path, LIES):
        spent_s, peak, code, said = measured(command_line(command, path))
        print(f"{command:12s} {path.name:34s} {spent_s:5.2f} s {peak / 2**20:4.0f} MB {said}")
        assert code == 2, (path.name, said)
        (line,) = said.splitlines()
        assert line.startswith(f"error: {path}: ")
        is_slow = path.suffix in (".mf4", ".mdf")  # the import of asammdf
        assert spent_s < max(MOST_S, 4.0 * idle_s) + 5.0 * idle_s * is_slow
        assert 2 * peak < MOST_BYTES


LAUNCH = """
import resource, subprocess, sys
done = subprocess.run([sys.executable, "-m", "vibroacoustics", *sys.argv[1:]],
    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(used.ru_utime + used.ru_stime, used.ru_maxrss * 1024, done.returncode)
print(done.stderr, file=sys.stderr, end="")
"""
"""A small process: the peak of a process begins with that of the process that starts it."""


def measured(words: list[str]) -> tuple[float, int, int, str]:
    """Processor time and the largest process of a command, its exit code and errors."""
    done = subprocess.run(
        [sys.executable, "-c", LAUNCH, *words], capture_output=True, text=True, check=True
    )
    spent_s, peak, code = done.stdout.split()
    return float(spent_s), int(peak), int(code), without_progress(done.stderr)


# --- cuts ----------------------------------------------------------------------------------------

CUTS = """
import hashlib, json, logging, sys, warnings
from pathlib import Path
from vibroacoustics.recordings import child
warnings.simplefilter("ignore")
logging.disable()
for path in map(Path, sys.stdin.read().splitlines()):
    header, channels = child.answer(child.Request(path), hashed=False)
    header["channels"] = hashlib.sha256(b"".join(x.tobytes() for x in channels)).hexdigest()
    print(json.dumps(header), flush=True)
"""


def places(content: bytes, number: int) -> list[int]:
    """Places of cuts over the whole file; not behind a line of a table, which shows no cut."""
    cuts = sorted({*np.linspace(1, len(content) - 1, number).astype(int).tolist()})
    is_text = not content.count(b"\0")
    return [cut - (is_text and content[cut - 1 : cut] == b"\n" and cut > 1) for cut in cuts]


def answers_of(paths: list[Path]) -> list[dict]:
    """Answers of processes that read; where one crashes, another goes on behind that file."""
    found: list[dict] = []
    while len(found) < len(paths):
        done = subprocess.run(
            [sys.executable, "-c", CUTS], input="\n".join(map(str, paths[len(found) :])),
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        found += map(json.loads, done.stdout.splitlines())
        if done.returncode:
            assert done.returncode < 0, done.stderr
            found.append({"error": "crash", "message": str(done.returncode)})
    return found


@pytest.mark.parametrize("number", [6, pytest.param(50, marks=pytest.mark.long)])
def test_no_cut_is_silent(tmp_path, number):
    """Refused, read with a remark that the end is missing, or nothing that counts was cut off."""
    if number > 6:
        pytest.importorskip("asammdf")
    wholes = write_all(tmp_path, HONEST if number > 6 else without_mdf(HONEST))
    assert len(wholes) >= (22 if number > 6 else 19)
    cut_files = []
    for whole in wholes:
        content = whole.read_bytes()
        for cut in places(content, number):
            cut_files.append(tmp_path / f"{cut:06d} {whole.name}")
            cut_files[-1].write_bytes(content[:cut])
    first = dict(zip((whole.name for whole in wholes), answers_of(wholes), strict=True))
    silent = []
    for path, answer in zip(cut_files, answers_of(cut_files), strict=True):
        whole = first[path.name.partition(" ")[2]]
        is_told = "error" in answer or any("cut short" in line for line in answer["remarks"])
        if not is_told and answer != whole:
            silent.append(path.name)
    assert not silent


# --- marks ---------------------------------------------------------------------------------------


def comma(content: str) -> str:
    return content.replace("\t", ",").replace("Separator,Tab", "Separator,Comma")


def both_commas(content: str) -> str:
    return comma(content).replace("Decimal_Separator,.", "Decimal_Separator,,")


def with_rows(content: str, old: str, new: str) -> str:
    """Another sign in the rows alone."""
    head, mark, rows = content.partition("X_Value")
    return head + mark + rows.replace(old, new)


LVM_MARKS = {
    "both commas": both_commas,
    "both commas, fractions": lambda text: with_rows(both_commas(text), ".", ","),
    "a comma unstated": lambda text: with_rows(
        comma(text).replace("Decimal_Separator,.\n", ""), ".", ","
    ),
    "a comma in rows alone": lambda text: with_rows(comma(text), ".", ","),
    "commas stated as tabs": lambda text: text.replace("\t", ","),
    "tabs stated as commas": lambda text: text.replace("Separator\tTab", "Separator\tComma"),
    "points stated as commas": lambda text: text.replace("Separator\t.", "Separator\t,"),
    "commas stated as points": lambda text: with_rows(text, ".", ","),
    "a comma in the last row": lambda text: text[:-20] + text[-20:].replace(".", ","),
    "thousands": lambda text: with_rows(text, "\t0.", "\t1,000."),
}


@pytest.mark.parametrize("name", LVM_MARKS)
def test_lvm_heads_that_contradict_their_rows(tmp_path, name):
    path = lvm(tmp_path / "a.lvm")
    path.write_text(LVM_MARKS[name](path.read_text()))
    with pytest.raises(StorageError):
        read_recording(path)


def test_lvm_of_commas_and_points(tmp_path):
    path = lvm(tmp_path / "a.lvm")
    path.write_text(comma(path.read_text()))
    np.testing.assert_array_equal(read_recording(path)["signal"].values, SIGNALS.round(6))


ROWS = [(0.0, 1234.5, 0.25), (0.001, 1235.5, 0.5), (0.002, 2234.25, 0.75)]
ABOVE = {
    "": (None, None), "sep=;\n": (";", None), "sep=,\n": (",", None),
    "Decimal separator;,\n": (None, ","), "Decimal separator,.\n": (None, "."),
    "# decimal sign: point\n": (None, "."), "Decimal symbol: comma\n": (None, ","),
}  # fmt: skip
"""Separator and decimal sign that a line states."""


def written(separator: str, decimal: str, thousands: str, head: str, quote: str) -> str:
    def cell(value: float) -> str:
        signs = {",": thousands, ".": decimal}
        return quote + "".join(signs.get(each, each) for each in f"{value:,.3f}") + quote

    lines = [head.join(["time [s]", "mic [Pa]", "foot [Pa]"])]
    return "\n".join([*lines, *(separator.join(map(cell, row)) for row in ROWS)]) + "\n"


@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("separator", [",", ";", "\t", "|"])
def test_csv_marks_are_read_right_or_refused(tmp_path, separator, decimal):
    """Every separator, thousands, head and line above; what contradicts it is refused."""
    path = tmp_path / "a.csv"
    for thousands in {"", ",", ".", " ", "'"} - {decimal}:
        for head in (separator, ",", ";"):
            for quote in ("", '"'):
                for above, (stated, sign) in ABOVE.items():
                    content = above + written(separator, decimal, thousands, head, quote)
                    path.write_text(content)
                    header, rows = child.answer(Request(path), hashed=False)
                    if "error" not in header:
                        np.testing.assert_array_equal(list(rows), np.array(ROWS).T[1:], content)
                        assert stated in (None, separator)
                        assert sign in (None, decimal)
    path.write_text(written(separator, decimal, "", separator, '"'))
    assert "error" not in child.answer(Request(path), hashed=False)[0]


@pytest.mark.parametrize(
    ("end", "kept"),
    [("0.2,0.2512", 3), ("0.2,0.25", 2), ("0.2,0", 2), ("0.2", 2), ("0.2,1.2e-4", 2)],
)
def test_last_row_without_an_end(tmp_path, end, kept):
    """Whole where it has the digits of all others, else omitted with a remark."""
    path = tmp_path / "a.csv"
    path.write_text(f"time [s],mic [Pa]\n0.0,0.1234\n0.1,0.5678\n{end}")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        read = read_recording(path)
    assert read.sizes["time"] == kept
    assert [each.category for each in caught] == [RecordingWarning] * (kept < 3)


def test_whole_numbers_without_an_end_are_not_trusted(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("time [s],speed [rpm]\n0.0,1021\n0.1,1022\n0.2,1023\n0.3,10")
    with pytest.warns(RecordingWarning, match="its last row .* has no end and may be cut short"):
        assert read_recording(path)["signal"].values[0].tolist() == [1021.0, 1022.0, 1023.0]


def test_signs_that_a_line_states_against_the_numbers(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("Decimal separator;,\ntime [s];a [Pa]\n0.0;0.5\n0.1;0.7\n")
    with pytest.raises(ParameterError, match=r"states ',' as the decimal sign above numbers such"):
        read_recording(path)
    path.write_text("sep=;\ntime [s],a [Pa]\n0,5\n1,7\n")
    with pytest.raises(StorageError, match="no row of numbers of cells between ';', as it states"):
        read_recording(path)
