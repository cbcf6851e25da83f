"""A recording of four times the cap goes through `orders` in blocks; other commands refuse it."""

import os
import subprocess
import sys
import zlib

import h5py
import numpy as np
import pytest
from support import command_here

from vibroacoustics import open_results
from vibroacoustics.base.constants import REFERENCE_PRESSURE_PA
from vibroacoustics.recordings.recorded import MAXIMUM_RECORDING_BYTES

RATE_HZ = 51200.0
CHUNK = 2**19
"""Samples, 10.24 s: 512 revolutions at 50 Hz, so that the chunks are all alike."""
MICROPHONES = 7
STEP = 2.0**-12
"""Of the numbers in the file, Pa and V."""
MOST_MEMORY_BYTES = 2e9


def write_recording(path, chunks):
    """Orders 1 and 2 of a speed that swings by 0.6 % on each microphone, and a tacho."""
    turns = np.arange(CHUNK) / CHUNK
    turns = 512.0 * turns + 0.5 * np.sin(2.0 * np.pi * turns)
    angle = 2.0 * np.pi * turns
    signals = [
        (1.0 + number) * np.cos(angle + 0.1 * number) + 0.25 * np.cos(2.0 * angle)
        for number in range(MICROPHONES)
    ]
    signals.append(np.where((turns + 1e-4) % 1.0 < 0.2, 5.0, 0.0))
    with h5py.File(path, "w") as file:
        file.attrs["sample_rate_hz"] = RATE_HZ
        for number, signal in enumerate(signals):
            name = f"microphone {number}" if number < MICROPHONES else "tacho"
            dataset = file.create_dataset(name, (chunks * CHUNK,), "i2", chunks=(CHUNK,))
            dataset.attrs["units"] = "Pa" if number < MICROPHONES else "V"
            dataset.attrs["scale_factor"] = STEP
            stored = np.rint(signal / STEP).astype("i2")
            for chunk in range(chunks):
                dataset[chunk * CHUNK : (chunk + 1) * CHUNK] = stored
    return path


def command(*arguments):
    """Exit code, what it says, and memory of the largest process of a command."""
    process = subprocess.Popen(
        [sys.executable, "-m", "vibroacoustics", *map(str, arguments)],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    said = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    print(f"{usage.ru_utime + usage.ru_stime:.0f} s, {usage.ru_maxrss * 1024 / 1e9:.2f} GB")
    return process.returncode, said, usage.ru_maxrss * 1024


@pytest.mark.long
def test_four_times_the_cap_in_blocks(tmp_path):
    """45 minutes of seven microphones and a tacho: 8 GiB, orders as they were made.

    The edges of the tacho lie up to a sample late, 0.35° of order 1. The blocks are of equal angle:
    a swing of 0.307 Hz lifts their mean by 0.307²/2 / 50 Hz, 2e-5 of the speed.
    """
    chunks = 4 * MAXIMUM_RECORDING_BYTES // (8 * (MICROPHONES + 1) * CHUNK)
    path = write_recording(tmp_path / "long.h5", chunks)
    code, said, memory = command(
        "orders", path, "--speed-channel", "tacho", "--out", tmp_path / "out"
    )
    assert code == 0, said
    assert memory < MOST_MEMORY_BYTES
    check_results(open_results(tmp_path / "out" / "orders.nc"), chunks)


def check_results(found, chunks):
    """Orders, speed and levels of the signal that was made."""
    assert found.sizes["block"] == pytest.approx(chunks * 512 / 3, abs=3)
    assert found["speed"].item() == pytest.approx(3000.0565, abs=0.01)
    size = 1.0 + np.arange(MICROPHONES)
    for order, made in ((1, size * np.exp(0.1j * np.arange(MICROPHONES))), (2, 0.25 + 0.0 * size)):
        ratio = found["channel_order"].sel(order=order).isel(speed=0).values / made
        print(order, np.max(np.abs(np.abs(ratio) - 1.0)), np.max(np.abs(np.angle(ratio))))
        np.testing.assert_allclose(np.abs(ratio), 1.0, rtol=1e-3)
        np.testing.assert_allclose(np.angle(ratio), 0.0, atol=np.radians(0.35 * order))
    pressure = np.sqrt(0.5 * (size**2 + 0.25**2))
    level = found["equivalent_level"].sel(weighting="Z")
    np.testing.assert_allclose(level, 20.0 * np.log10(pressure / REFERENCE_PRESSURE_PA), atol=0.01)


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("track", ["--bandwidth", "2", "--speed-channel", "microphone 0"]),
        ("map", ["--speed-channel", "microphone 0"]),
        ("export", []),
    ],
)
def test_what_does_not_go_in_blocks_says_so(tmp_path, name, options):
    """A file of 8 GiB of silence, packed: one line that names what helps."""
    path = tmp_path / "long.h5"
    silence = zlib.compress(bytes(8 * CHUNK))
    with h5py.File(path, "w") as file:
        file.attrs["sample_rate_hz"] = RATE_HZ
        packed = {"chunks": (CHUNK,), "compression": "gzip"}
        for number in range(2):
            channel = file.create_dataset(f"microphone {number}", (2**29,), "f8", **packed)
            channel.attrs["units"] = "Pa"
            for first in range(0, channel.size, CHUNK):
                channel.id.write_direct_chunk((first,), silence)
    out = tmp_path / ("part.nc" if name == "export" else "out")
    outcome = command_here(name, path, *options, "--out", out)
    assert outcome.returncode == 2
    (line,) = outcome.stderr.splitlines()
    assert "at most 2 GiB are read at once: give --from and --to, or --channels" in line
