"""Measurement data files that asammdf wrote."""

import numpy as np
import pytest
from trade_files import RATE_HZ, SIGNALS, mf4

from vibroacoustics.base.errors import ParameterError, StorageError
from vibroacoustics.recordings import open_recording, read_recording

pytest.importorskip("asammdf")
FAST = ["microphone", "foot"]


@pytest.mark.parametrize(
    ("name", "version", "compression"),
    [("a.mf4", "4.10", 0), ("b.mf4", "4.11", 2), ("c.mdf", "3.30", 0)],
)
def test_versions_and_compression(tmp_path, name, version, compression):
    file = mf4(tmp_path / name, version, compression)
    read = read_recording(file, channels=FAST)
    assert read["channel_unit"].values.tolist() == ["Pa", "m/s²"]
    assert read.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ, rel=1e-9)
    np.testing.assert_array_equal(read["signal"].values, SIGNALS)
    part = read_recording(file, channels=["foot"], from_s=0.1, to_s=0.2)
    first = round(0.1 * RATE_HZ)
    np.testing.assert_array_equal(part["signal"].values[0], SIGNALS[1, first : first + 103])
    blocks = open_recording(file, channels=FAST)
    np.testing.assert_array_equal(blocks.read(["foot"], 7, 90)[0], SIGNALS[1, 7:90])


@pytest.mark.filterwarnings("ignore:.*different times")
def test_groups_of_other_rates(tmp_path):
    file = mf4(tmp_path / "a.mf4")
    with pytest.warns(UserWarning, match=r"'speed': samples of 102\.4 Hz are interpolated to 1024"):
        assert read_recording(file).attrs["sample_rate_hz"] == pytest.approx(RATE_HZ)
    slow = read_recording(file, channels=["speed"])
    assert slow.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ / 10.0)
    assert slow["channel_unit"].values.tolist() == ["rpm"]


def test_invalid_samples_are_refused(tmp_path):
    from asammdf import MDF, Signal

    invalid = np.zeros(300, dtype=bool)
    invalid[7:9] = True
    times = np.arange(300) / RATE_HZ
    with MDF(version="4.10") as file:
        file.append([Signal(SIGNALS[0], times, name="a", unit="Pa", invalidation_bits=invalid)])
        file.save(tmp_path / "a.mf4")
    with pytest.raises(StorageError, match="2 of 300 samples are missing or marked invalid"):
        read_recording(tmp_path / "a.mf4")


def test_texts_are_not_read_in_silence(tmp_path):
    from asammdf import MDF, Signal

    times = np.arange(300) / RATE_HZ
    with MDF(version="4.10") as file:
        words = Signal(np.array([b"on"] * 300), times, name="state", encoding="utf-8")
        file.append([Signal(SIGNALS[0], times, name="a", unit="Pa"), words])
        file.save(tmp_path / "a.mf4")
    with pytest.warns(UserWarning, match="channel 'state' holds no numbers and is not read"):
        assert read_recording(tmp_path / "a.mf4")["channel"].values.tolist() == ["a"]


def test_a_file_without_numbers_lists_its_channels(tmp_path):
    from asammdf import MDF, Signal

    with MDF() as file:
        file.append(
            [Signal(np.array([b"a", b"b"]), np.array([0.0, 1.0]), name="note", encoding="utf-8")]
        )
        file.save(tmp_path / "a.mf4")
    with pytest.raises(ParameterError, match="no channel of numbers; its channels: 'note'"):
        read_recording(tmp_path / "a.mf4")
