"""Kinds of files of docs/recordings.md, each written by another library, read back alike."""

import numpy as np
import pytest
from kinds_of_files import HALF, KINDS, NAMES, RESCALED, UNITS
from support import ROOT
from trade_files import RATE_HZ, SIGNALS, mf4

from vibroacoustics.recordings import read_recording


@pytest.mark.parametrize("name", KINDS)
def test_what_other_libraries_write(tmp_path, name):
    write, options, tolerance = KINDS[name]
    write(tmp_path / name)
    read = read_recording(tmp_path / name, **options)
    samples = read["signal"].values
    if not name.endswith((".wav", ".flac", ".w64")):
        read = read.sel(channel=list(NAMES))
        samples = read["signal"].values
    assert read.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ, rel=2e-6)
    assert set(read["channel_unit"].values) <= set(UNITS)
    np.testing.assert_allclose(samples, HALF, rtol=0.0, atol=tolerance)


@pytest.mark.parametrize("name", RESCALED)
def test_without_any_option(tmp_path, name):
    read = read_recording(RESCALED[name](tmp_path / name))
    assert tuple(read["channel_unit"].values) == UNITS
    assert read.attrs["sample_rate_hz"] == pytest.approx(RATE_HZ, rel=1e-9)
    np.testing.assert_allclose(read["signal"].values, SIGNALS, rtol=1e-12)


@pytest.mark.parametrize("version", ["4.10", "3.30"])
def test_measurement_data_files(tmp_path, version):
    pytest.importorskip("asammdf")
    file = mf4(tmp_path / ("a.mf4" if version >= "4" else "a.mdf"), version, is_slow=False)
    read = read_recording(file)
    assert tuple(read["channel_unit"].values) == UNITS
    np.testing.assert_array_equal(read["signal"].values, SIGNALS)


def test_files_of_measuring_systems():
    for name in ("electric_motor_vibration.uff", "labview_force.lvm", "labview_acceleration.lvm"):
        assert read_recording(ROOT / "data" / "recordings" / name)["signal"].size >= 12
