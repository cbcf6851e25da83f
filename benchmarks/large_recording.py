"""Processor time and memory of `orders` on 16 channels of 60 s at 51.2 kHz (197 MB).

    OMP_NUM_THREADS=1 python benchmarks/large_recording.py [--rounds N] [--quick]

Fifteen microphones and a tacho in an HDF5 file, at an even speed and in a run-up, of which each
channel has a second figure. The processes that read the file count. The package has its byte code,
as where it is installed: the first round writes it.
"""

import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
from quick import parser

SAMPLE_RATE_HZ = 51_200.0
DURATION_S, QUICK_DURATION_S = 60.0, 2.0
MICROPHONES, QUICK_MICROPHONES = 15, 1
SPEEDS_HZ = {"even speed": (48.7, 48.7), "run-up": (25.0, 50.0)}
"""First and last."""


def write_recording(file: Path, first_hz: float, last_hz: float, quick: bool = False) -> None:
    """Two orders in noise on every microphone, single precision."""
    rng = np.random.default_rng(0)
    duration_s = QUICK_DURATION_S if quick else DURATION_S
    time_s = np.arange(int(duration_s * SAMPLE_RATE_HZ)) / SAMPLE_RATE_HZ
    turned = first_hz * time_s + (last_hz - first_hz) * time_s**2 / (2.0 * duration_s)
    with h5py.File(file, "w") as stored:
        stored.attrs["sample_rate_hz"] = SAMPLE_RATE_HZ
        for number in range(QUICK_MICROPHONES if quick else MICROPHONES):
            sound = np.cos(2.0 * np.pi * turned + number) + 0.3 * np.cos(4.0 * np.pi * turned)
            sound += 0.2 * rng.standard_normal(time_s.size)
            channel = stored.create_dataset(f"microphone {number}", data=sound.astype("f4"))
            channel.attrs["units"] = "Pa"
        pulses = np.where(turned % 1.0 < 0.2, 5.0, 0.0)
        stored.create_dataset("tacho", data=pulses.astype("f4")).attrs["units"] = "V"


def measured(file: Path, out: Path) -> tuple[float, float]:
    """Seconds of the processors, and the largest resident memory of a process in MB."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "vibroacoustics", "orders", str(file)]
    command += ["--speed-channel", "tacho", "--out", str(out)]
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, after.ru_maxrss / 1e3


def main() -> None:
    """Print a line for each recording."""
    options = parser(__doc__)
    options.add_argument("--rounds", type=int, default=2, help="the first one is cold")
    chosen = options.parse_args()
    rounds = 1 if chosen.quick else chosen.rounds
    for name, speeds in [*SPEEDS_HZ.items()][: 1 if chosen.quick else None]:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "recording.h5"
            write_recording(file, *speeds, chosen.quick)
            for _ in range(rounds):
                seconds, memory_mb = measured(file, Path(folder) / "out")
                print(f"{name}: {seconds:.1f} s of processors, {memory_mb:.0f} MB", flush=True)


if __name__ == "__main__":
    main()
