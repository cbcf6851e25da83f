"""Spreadsheets that openpyxl wrote."""

import numpy as np
import openpyxl
import pytest
from trade_files import RATE_HZ, SIGNALS, xlsx

from vibroacoustics.base.errors import ParameterError, StorageError
from vibroacoustics.recordings import read_recording
from vibroacoustics.recordings.remarks import RecordingWarning


def test_a_table_with_times(tmp_path):
    read = read_recording(xlsx(tmp_path / "a.xlsx", above=(("Machine", "ZP41"), ())))
    assert read["channel"].values.tolist() == ["microphone", "foot"]
    assert read["channel_unit"].values.tolist() == ["Pa", "m/s²"]
    assert read.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ, rel=1e-12)
    np.testing.assert_allclose(read["signal"].values, SIGNALS, rtol=2e-15)


def test_time_stamps(tmp_path):
    read = read_recording(xlsx(tmp_path / "a.xlsx", "stamp"), channels=["foot"])
    assert read.attrs["sample_rate_hz"] == pytest.approx(100.0, rel=1e-6)
    assert read.attrs["start_time"].startswith("2026-02-19T10:00:00")
    np.testing.assert_allclose(read["signal"].values[0], SIGNALS[1], rtol=2e-15)


def test_a_sample_rate_above_the_table(tmp_path):
    stated = (("Sample rate [Hz]", 51200),)
    assert read_recording(xlsx(tmp_path / "a.xlsx", "", stated)).attrs["sample_rate_hz"] == 51200.0
    file = xlsx(tmp_path / "b.xlsx", "")
    with pytest.raises(ParameterError, match="no column 'time"):
        read_recording(file)
    assert read_recording(file, sample_rate_hz=100.0).attrs["sample_rate_hz"] == 100.0


def changed(path, row, column, value):
    book = openpyxl.load_workbook(path)
    book["run"].cell(row, column).value = value
    book.save(path)
    return path


def test_cells_that_are_no_numbers(tmp_path):
    file = changed(xlsx(tmp_path / "a.xlsx"), 100, 3, "lost")
    with pytest.raises(StorageError, match="sheet 'run', row 100, column 'foot': 'lost' is no num"):
        read_recording(file)
    read_recording(file, channels=["microphone"])
    with pytest.raises(StorageError, match="None is no number"):
        read_recording(changed(file, 100, 3, None))
    for column in (1, 2, 3):
        changed(file, 100, column, None)
    with pytest.raises(StorageError, match="row 100 is empty and row 101 is not"):
        read_recording(file)


def test_a_second_table_is_not_read_in_silence(tmp_path):
    file = xlsx(tmp_path / "a.xlsx")
    book = openpyxl.load_workbook(file)
    book.copy_worksheet(book["run"]).title = "run 2"
    book.save(file)
    with pytest.warns(RecordingWarning, match="sheet 'run' is read, not 'run 2'"):
        read_recording(file)


def test_no_table(tmp_path):
    book = openpyxl.Workbook()
    book.active.append(["only", "text"])
    book.save(tmp_path / "a.xlsx")
    with pytest.raises(StorageError, match="sheet 'Sheet' has no row of numbers"):
        read_recording(tmp_path / "a.xlsx")
