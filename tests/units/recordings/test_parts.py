"""Parts of recordings: only what is asked for is read."""

import hashlib
import resource
import struct
import subprocess
import sys

import h5py
import numpy as np
import pytest

from vibroacoustics.base.errors import ParameterError, StorageError
from vibroacoustics.recordings import (
    LabelledBlocks,
    label_recording,
    open_recording,
    read_recording,
)

RATE_HZ = 51200.0
GIB = 2**30


def processor_s():
    """Of this process and of those that it has waited for; a full machine does not lengthen it."""
    usages = [resource.getrusage(of) for of in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)


def long_hdf5(path, stored_s, rate_hz=RATE_HZ, duration_s=3600.0, channels=16):
    """A file that claims an hour of 16 channels, 22 GiB, of which one part is stored."""
    samples = int(duration_s * rate_hz)
    with h5py.File(path, "w") as file:
        signal = file.create_dataset(
            "acceleration", (samples, channels), "f8", chunks=(int(rate_hz), channels)
        )
        signal.attrs["units"] = "m/s2"
        file.attrs["sample_rate_hz"] = rate_hz
        for second in range(*stored_s):
            at = slice(int(second * rate_hz), int((second + 1) * rate_hz))
            signal[at] = np.tile(float(second) + np.arange(channels), (int(rate_hz), 1))
    return path


@pytest.mark.parametrize("seconds", [10, pytest.param(60, marks=pytest.mark.long)])
def test_a_minute_of_22_gib(seconds, tmp_path):
    end = 600 + seconds
    path = long_hdf5(tmp_path / "a.h5", (600, end))
    claimed = 16 * 3600 * 51200 * 8
    assert claimed > 21.9 * GIB
    begin = processor_s()
    part = read_recording(path, from_s=600.0, to_s=float(end))
    assert processor_s() - begin < 15.0
    assert part.sizes == {"channel": 16, "time": seconds * 51200}
    expected = np.repeat(np.arange(600.0, end), 51200)
    for channel, found in enumerate(part["signal"].values):
        np.testing.assert_array_equal(found, expected + channel)
    assert part.attrs["part_start_s"] == 600.0
    with pytest.raises(StorageError, match=f"incomplete: {seconds} of {seconds + 1} chunks"):
        read_recording(path, from_s=600.0, to_s=end + 1.0, channels=["acceleration 3"])


def long_wave(path, channels=16, seconds=3600):
    """An hour of 16 channels of 32-bit floats, of which the file holds no more than a second."""
    frames = seconds * int(RATE_HZ)
    size = frames * channels * 4
    head = b"RF64" + struct.pack("<I", 2**32 - 1) + b"WAVEds64"
    head += struct.pack("<IQQQI", 28, size + 80, size, frames, 0)
    rate = int(RATE_HZ)
    head += b"fmt " + struct.pack(
        "<IHHIIHH", 16, 3, channels, rate, rate * channels * 4, channels * 4, 32
    )
    head += b"data" + struct.pack("<I", 2**32 - 1)
    second = np.tile(np.arange(channels, dtype="<f4"), (rate, 1)) + 1.0
    with path.open("wb") as file:
        file.write(head)
        file.seek(630 * rate * channels * 4, 1)
        file.write(second.astype("<f4").tobytes())
        file.truncate(len(head) + size)
    return path


def test_a_minute_of_a_long_wave_file(tmp_path):
    path = long_wave(tmp_path / "a.wav")
    assert path.stat().st_size > 10 * GIB
    units = {"channel 3": "Pa"}
    with pytest.raises(StorageError, match="at once: give from_s and to_s, or channels"):
        read_recording(path, units=units)
    begin = processor_s()
    part = read_recording(path, from_s=600.0, to_s=660.0, channels=["channel 3"], units=units)
    assert processor_s() - begin < 15.0
    expected = np.where(np.arange(60 * 51200) // 51200 == 30, 3.0, 0.0)
    np.testing.assert_array_equal(part["signal"].values[0], expected)
    assert "source_sha256" not in part.attrs
    assert part.attrs["part_sha256"] == hashlib.sha256(expected.tobytes()).hexdigest()


BLOCKS = """
import resource, sys
from vibroacoustics.recordings import open_recording
units = {f"channel {number}": "Pa" for number in range(1, 17)}
blocks = open_recording(sys.argv[1], units=units)
total = 0.0
for first in range(600 * 51200, 660 * 51200, 15 * 51200):
    total += blocks.read(blocks.channels, first, first + 15 * 51200).sum()
status = open("/proc/self/status").read()  # ru_maxrss holds that of the process before, too
print(1024 * int(status.split("VmHWM:")[1].split()[0]))
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024)
print(blocks.samples, total)
"""


@pytest.mark.long
def test_blocks_take_little_memory(tmp_path):
    """Blocks of 16 channels and 15 s, 94 MiB, of 22 GiB in 64-bit floats."""
    path = long_wave(tmp_path / "a.wav")
    done = subprocess.run(
        [sys.executable, "-c", BLOCKS, str(path)], capture_output=True, text=True, check=True
    )
    own, reading, samples, total = done.stdout.split()
    assert int(samples) == 3600 * 51200
    assert float(total) == 51200.0 * sum(range(1, 17))
    assert int(own) < 600 * 2**20
    assert int(reading) < 600 * 2**20


def test_blocks_of_a_file(tmp_path):
    path = long_hdf5(tmp_path / "a.h5", (2, 5), 1000.0, 8.0, 3)
    blocks = open_recording(path, from_s=2.0, to_s=5.0, units={"acceleration 1": "g"})
    assert (blocks.samples, blocks.sample_rate_hz) == (3000, 1000.0)
    assert blocks.channels == ("acceleration 1", "acceleration 2", "acceleration 3")
    assert blocks.channel_units == ["m/s²"] * 3
    assert blocks.attributes["part_start_s"] == 2.0
    whole = long_hdf5(tmp_path / "whole.h5", (0, 8), 1000.0, 8.0, 3)
    assert "part_start_s" not in open_recording(whole).attributes
    with pytest.raises(StorageError, match="is incomplete: 3 of 8 chunks stored"):
        open_recording(path)
    two = blocks.read(["acceleration 3", "acceleration 1"], 999, 1002)
    np.testing.assert_allclose(
        two, [[4.0, 5.0, 5.0], [2.0 * 9.80665, 3.0 * 9.80665, 3.0 * 9.80665]]
    )
    assert blocks.read(["acceleration 2"], 0, 1).tolist() == [[3.0]]
    for wrong in ((0, 3001), (5, 5), (-1, 3)):
        with pytest.raises(ParameterError, match="must lie within 0 to 3000"):
            blocks.read(["acceleration 1"], *wrong)


def test_blocks_of_memory():
    recording = label_recording([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]], 10.0, ["a", "b"], ["Pa", "V"])
    blocks = LabelledBlocks(recording)
    assert blocks.read(["b"], 1, 3).tolist() == [[5.0, 6.0]]
    assert (blocks.samples, blocks.channels, blocks.channel_units) == (3, ("a", "b"), ("Pa", "V"))
