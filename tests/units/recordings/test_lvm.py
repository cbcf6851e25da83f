"""LabVIEW measurement files: two of LabVIEW itself, and what their layout allows."""

import numpy as np
import pytest
from support import ROOT
from trade_files import RATE_HZ, SIGNALS, lvm

from vibroacoustics.base.errors import ParameterError, StorageError
from vibroacoustics.recordings import read_recording
from vibroacoustics.recordings.remarks import RecordingWarning

FOLDER = ROOT / "data" / "recordings"


def test_files_of_labview():
    """A decimal comma without times; a point that its header does not state, with times."""
    force = read_recording(FOLDER / "labview_force.lvm")
    assert force["channel_unit"].values.tolist() == ["N", "m/s²"]
    assert force["signal"].values[:, 0].tolist() == [0.914018, 1.204792]
    assert force["signal"].values[:, -1].tolist() == [0.680572, 1.212775]
    assert force.attrs["sample_rate_hz"] == pytest.approx(25600.0, rel=1e-9)
    assert force.attrs["start_time"] == "2013-02-19T09:51:40.727189"
    assert force["channel"].values.tolist() == ["Excitation (Trigger)", "Response (Trigger)"]
    shaken = read_recording(FOLDER / "labview_acceleration.lvm", units={"*": "m/s²"})
    assert shaken.attrs["sample_rate_hz"] == 4000.0
    np.testing.assert_array_equal(
        shaken["signal"].sel(channel="ay"), [-0.028189, -0.031060, -0.013517, -0.021172]
    )


@pytest.mark.parametrize("columns", ["No", "One"])
@pytest.mark.parametrize("decimal", [".", ","])
def test_decimals_and_times(tmp_path, columns, decimal):
    read = read_recording(lvm(tmp_path / "a.lvm", decimal, columns))
    assert read["channel"].values.tolist() == ["microphone", "foot"]
    assert read["channel_unit"].values.tolist() == ["Pa", "m/s²"]
    assert read.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ, rel=1e-9)
    np.testing.assert_array_equal(read["signal"].values, SIGNALS.round(6))


def test_a_part_of_one_channel(tmp_path):
    file = lvm(tmp_path / "a.lvm")
    read = read_recording(file, channels=["foot"], from_s=0.1, to_s=0.2)
    first = round(0.1 * RATE_HZ)
    np.testing.assert_array_equal(
        read["signal"].values[0], SIGNALS[1, first : round(0.2 * RATE_HZ)].round(6)
    )


def test_segments_are_joined_without_a_gap_alone(tmp_path):
    read = read_recording(lvm(tmp_path / "a.lvm", segments=3))
    np.testing.assert_array_equal(read["signal"].values, SIGNALS.round(6))
    with pytest.raises(ParameterError, match=r"2 segments are not one after the other.*0\.5 s"):
        read_recording(lvm(tmp_path / "b.lvm", segments=2, gap_s=0.5))


def test_what_is_no_recording(tmp_path):
    with pytest.raises(ParameterError, match=r"abscissa is .*frequency"):
        read_recording(lvm(tmp_path / "a.lvm", axis="Frequency"))
    lines = lvm(tmp_path / "b.lvm").read_text().splitlines(keepends=True)
    for cut in ("".join(lines[:-1]), "".join(lines)[:-3]):
        (tmp_path / "b.lvm").write_text(cut)
        with pytest.raises(StorageError, match="is truncated"):
            read_recording(tmp_path / "b.lvm")


def test_a_rounded_interval_is_a_warning(tmp_path):
    file = lvm(tmp_path / "a.lvm")
    file.write_text(file.read_text().replace("0.0009765625", "0.000977"))
    with pytest.warns(RecordingWarning, match=r"uncertain by 0\.051 %; give sample_rate_hz"):
        read_recording(file)
    assert read_recording(file, sample_rate_hz=1024.0).attrs["sample_rate_hz"] == 1024.0
