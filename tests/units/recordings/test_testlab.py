"""Signals of Simcenter Testlab in MAT files that SciPy and h5py wrote."""

import numpy as np
import pytest
import scipy.io
from trade_files import RATE_HZ, SIGNALS, simcenter, simcenter_hdf5, simcenter_structs

from vibroacoustics.base.errors import StorageError
from vibroacoustics.recordings import open_recording, read_recording
from vibroacoustics.recordings.remarks import RecordingWarning


@pytest.mark.parametrize("write", [simcenter, simcenter_hdf5])
def test_rate_units_and_names(tmp_path, write):
    """Stored samples are in SI units, whatever unit the label names."""
    file = write(tmp_path / "a.mat")
    read = read_recording(file)
    assert read["channel"].values.tolist() == ["Mic:1:S", "Foot:+Z"]
    assert read["channel_unit"].values.tolist() == ["Pa", "m/s²"]
    assert read.attrs["sample_rate_hz"] == RATE_HZ
    np.testing.assert_allclose(read["signal"].values, SIGNALS, rtol=1e-12)
    blocks = open_recording(file)
    np.testing.assert_allclose(blocks.read(["Foot:+Z"], 7, 9)[0], SIGNALS[1, 7:9], rtol=1e-12)


def changed(tmp_path, **fields):
    structs = simcenter_structs()
    for path, value in fields.items():
        target = structs["Signal_1"]
        *groups, leaf = path.split("__")
        for group in groups:
            target = target[group]
        target[leaf] = value
    scipy.io.savemat(tmp_path / "a.mat", structs)
    return tmp_path / "a.mat"


def test_channels_in_one_table(tmp_path):
    structs = {"Signal": simcenter_structs()["Signal_0"]}
    structs["Signal"]["y_values"]["values"] = SIGNALS.T
    structs["Signal"]["function_record"]["name"] = np.array(["left", "right"], dtype=object)
    scipy.io.savemat(tmp_path / "a.mat", structs)
    read = read_recording(tmp_path / "a.mat")
    assert read["channel"].values.tolist() == ["left", "right"]
    np.testing.assert_array_equal(read["signal"].values, SIGNALS)


def test_functions_of_frequency_are_no_channels(tmp_path):
    read = read_recording(changed(tmp_path, x_values__quantity__label="Hz"))
    assert read["channel"].values.tolist() == ["Mic:1:S"]


def test_what_does_not_fit(tmp_path):
    with pytest.raises(StorageError, match="claims 301 samples and holds 300"):
        read_recording(changed(tmp_path, x_values__number_of_values=301.0))
    with pytest.raises(StorageError, match="increment = 0 s: must be above zero"):
        read_recording(changed(tmp_path, x_values__increment=0.0))
    with pytest.warns(RecordingWarning, match="factor 1 does not take SI units to 'g'"):
        read_recording(changed(tmp_path, y_values__quantity__unit_transformation__factor=1.0))
