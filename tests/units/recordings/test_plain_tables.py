"""Tables of numbers as programs write them: without names, with blanks, date beside the clock."""

from datetime import datetime, timedelta

import numpy as np
import pytest

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.recordings import read_recording

RATE_HZ = 2048.0
TIME_S = np.arange(1024) / RATE_HZ
SINE = np.sin(2.0 * np.pi * 50.0 * TIME_S)
TABLE = np.column_stack([TIME_S, SINE])
PASCAL = {"*": "Pa"}
pytestmark = pytest.mark.filterwarnings(
    "ignore::vibroacoustics.recordings.remarks.RecordingWarning"
)


def check(path, channel, **options):
    recording = read_recording(path, **options)
    assert recording.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ, rel=1e-6)
    assert recording["channel"].values.tolist() == [channel]
    np.testing.assert_allclose(recording["signal"].values[0], SINE, atol=1e-6)
    return recording


@pytest.mark.parametrize(
    ("options", "channel"),
    [
        ({}, "column 2"),
        ({"header": "time mic"}, "mic"),
        ({"header": "made on a bench", "comments": "% "}, "column 2"),
        ({"delimiter": "\t"}, "column 2"),
        ({"delimiter": ",", "header": "time,mic"}, "mic"),
        ({"fmt": "   %.9e"}, "column 2"),
    ],
)
def test_what_numpy_and_matlab_write(tmp_path, options, channel):
    np.savetxt(tmp_path / "a.txt", TABLE, **options)
    recording = check(tmp_path / "a.txt", channel, units=PASCAL)
    assert "states no unit and is taken as the time in s" in recording.attrs["reading_remarks"]
    part = read_recording(tmp_path / "a.txt", units=PASCAL, from_s=0.25)
    np.testing.assert_allclose(part["signal"].values[0], SINE[512:], atol=1e-6)


@pytest.mark.parametrize("head", ["time [s]  mic [Pa]", "time  mic\n(s)   (Pa)"])
def test_heads_between_blanks(tmp_path, head):
    rows = [f"{time:.9f}   {value:.9f}" for time, value in TABLE]
    (tmp_path / "a.txt").write_text("\n".join([head, *rows]) + "\n")
    check(tmp_path / "a.txt", "mic")


def test_one_column_needs_its_rate(tmp_path):
    np.savetxt(tmp_path / "a.txt", SINE)
    check(tmp_path / "a.txt", "column 1", units=PASCAL, sample_rate_hz=RATE_HZ)
    with pytest.raises(ParameterError, match="give sample_rate_hz"):
        read_recording(tmp_path / "a.txt", units=PASCAL)


def test_a_column_that_counts_rows_is_no_time(tmp_path):
    np.savetxt(tmp_path / "a.txt", np.column_stack([np.arange(1024), SINE]), fmt=["%d", "%.9f"])
    with pytest.raises(ParameterError, match=r"its first column counts the rows: give sample_rate"):
        read_recording(tmp_path / "a.txt", units=PASCAL)
    check(tmp_path / "a.txt", "column 2", units=PASCAL, sample_rate_hz=RATE_HZ)


@pytest.mark.parametrize("start", ["2026-11-28T10:00:00", "2026-11-28T23:59:59.8"])
@pytest.mark.parametrize(
    ("form", "separator", "head"),
    [
        ("%Y-%m-%d,%H:%M:%S.%f", ",", "date,time,mic [Pa]"),
        ("%d.%m.%Y;%H:%M:%S.%f", ";", "Datum;Uhrzeit;mic [Pa]"),
        ("%H:%M:%S.%f\t%m/%d/%Y", "\t", "Time\tDate\tmic [Pa]"),
        ("%Y-%m-%d  %H:%M:%S.%f", "  ", "Date  Time  mic [Pa]"),
        ("%H:%M:%S.%f", ",", "time,mic [Pa]"),
    ],
)
def test_date_and_clock_in_two_columns(tmp_path, form, separator, head, start):
    """Microseconds are off the grid by 0.001 intervals at most; midnight is no gap."""
    begin = datetime.fromisoformat(start)
    rows = [
        f"{(begin + timedelta(seconds=time)).strftime(form)}{separator}{value:.9f}"
        for time, value in TABLE.tolist()
    ]
    (tmp_path / "a.txt").write_text("\n".join([head, *rows]) + "\n")
    recording = check(tmp_path / "a.txt", "mic")
    stated = "" if "%d" not in form else begin.isoformat(timespec="microseconds")
    assert recording.attrs.get("start_time", "") == stated


@pytest.mark.parametrize("head", ["frequency [Hz]", "Freq [kHz]", "Frequenz [Hz]"])
@pytest.mark.parametrize("rate_hz", [None, 1000.0])
def test_a_spectrum_is_refused_with_and_without_a_sample_rate(tmp_path, head, rate_hz):
    path = tmp_path / "spectrum.csv"
    path.write_text(f"{head},mic [Pa]\n" + "".join(f"{10 * n},0.{n}\n" for n in range(9)))
    with pytest.raises(ParameterError, match="a spectrum is no recording"):
        read_recording(path, sample_rate_hz=rate_hz)
