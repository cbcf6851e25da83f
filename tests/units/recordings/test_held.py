"""A recording that is held as its file stores it gives the values of the one read at once."""

import h5py
import numpy as np
import pytest

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.recording_blocks import BLOCK_BYTES, block_by_block
from vibroacoustics.recordings import read_recording
from vibroacoustics.recordings.blocks import hold_recording, samples_digest

RATE_HZ = 8000.0
FACTORS = {"front": 0.7, "rear": 3.0}


def written(folder, kind, signal):
    path = folder / "recording.h5"
    with h5py.File(path, "w") as stored:
        stored.attrs["sample_rate_hz"] = RATE_HZ
        for name, samples in zip(("front", "rear"), signal, strict=True):
            stored.create_dataset(name, data=samples.astype(kind)).attrs["units"] = "g"
    return path


@pytest.mark.parametrize(("kind", "held"), [("f4", 4), ("i2", 2), ("i4", 4), ("f8", 8), (">f4", 8)])
def test_held_samples_are_those_read_at_once(tmp_path, kind, held):
    signal = 1000.0 * np.random.default_rng(1).standard_normal((2, 5000))
    path = written(tmp_path, kind, signal)
    given = {"calibration": FACTORS, "from_s": 0.1, "names": {"rear": "back"}}
    at_once, blocks = read_recording(path, **given), hold_recording(path, **given)
    assert blocks.stored.itemsize == held
    assert blocks.channels == ("front", "back")
    wanted = at_once["signal"].values
    np.testing.assert_array_equal(blocks.read(["front", "back"], 0, blocks.samples), wanted)
    np.testing.assert_array_equal(blocks.read(["back"], 70, 90)[0], wanted[1, 70:90])
    joined = np.concatenate(list(block_by_block(blocks, ["back", "front"])), axis=1)
    np.testing.assert_array_equal(joined, wanted[::-1])
    assert blocks.attributes == at_once.attrs
    assert blocks.read_bytes == BLOCK_BYTES


def test_the_hash_is_that_of_float64():
    stored = np.arange(6, dtype="i2").reshape(2, 3)
    assert samples_digest(stored) == samples_digest(stored.astype(float))


@pytest.mark.parametrize(("sample", "factor"), [(np.nan, 1.0), (np.inf, 1.0)])
def test_samples_that_are_not_finite_are_refused_alike(tmp_path, sample, factor):
    signal = np.ones((2, 100))
    signal[1, 40] = sample
    path = written(tmp_path, "f4", signal)
    messages = []
    for read in (read_recording, hold_recording):
        with pytest.raises(ParameterError, match="the first is sample 41") as error:
            read(path, calibration={"rear": factor})
        messages.append(str(error.value))
    assert messages[0] == messages[1]
