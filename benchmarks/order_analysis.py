"""COT-60: from a tacho and four channels over 60 s to an order map, beside the open peer.

`python benchmarks/order_analysis.py [--rota-python PATH] [--rounds N] [--skip-rota] [--quick]`
prints a Markdown table. Run-up from 1200 to 6000 rpm with a swing of 30 rpm every 2 s, 51.2 kHz,
float64; pulses of the tacho, crank motion, angular resampling, order map to order 120 in Hann
blocks of 8 revolutions, half overlapping.

The tacho gives one pulse a revolution whose flank lasts 80 µs, four samples, and every sample of it
has white noise of 5 % of the pulse height. It crosses half the height with a jitter of 3.3 µs, 0.25
rad at order 120 and 6000 rpm: a spline through the pulses as they are loses 0.09 dB there over the
run-up. How much of that smoothing wins back depends on the shaft: from a swing like this one nearly
all; with SWING_PERIOD_S = 0.5 `tacho_motion` takes the pulses as they are. The other two methods
smooth over a fixed number of pulses, and the swing costs them more: see SWING_HZ = 0 as well.

This package reads the files in blocks of 1.3 s; its row "arrays" and the other methods hold all.
Each method runs in a process of its own, so that its peak memory is its own, and they take turns.
rota-order (GPL) is no part of this package and runs under another interpreter only: one that is
given, or a virtual environment that is made here with pip.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
import venv
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from quick import parser

SAMPLE_RATE_HZ = 51_200
DURATION_S, QUICK_DURATION_S = 60.0, 4.0
SPEED_HZ = (20.0, 100.0)
SWING_HZ = 0.5
"""Of the speed about the even run-up, peak."""
SWING_PERIOD_S = 2.0
MAXIMUM_ORDER = 120
REVOLUTIONS_IN_BLOCK = 8
BLOCK_SAMPLES = 2**16
AMPLITUDES = {1: 1.0, 2: 0.5, 4: 0.25, MAXIMUM_ORDER: 1.0}
TONES_HZ = (13_500.0, 20_000.0)
"""Above order 120 at every speed; alone in their channels, as large as order 1 in channel 0."""
TACHO_RISE_S = 80e-6
TACHO_NOISE = 0.05
"""Of the pulse height, standard deviation of each sample."""
DEAD_TIME_S = 5e-3
"""For scipy: about half the period at the highest speed; a crossing within it is noise."""
SMOOTHED_PULSES = 31
"""For scipy and rota-order; this package finds its own."""

Map = tuple[np.ndarray, np.ndarray]
"""Complex peak amplitude (channel, block, line) and order (line,)."""


def write_signals(folder: Path, duration_s: float) -> None:
    """Channels: orders of known amplitude, two tones above them, noise with orders."""
    generator = np.random.default_rng(60)
    time_s = np.arange(int(duration_s * SAMPLE_RATE_HZ)) / SAMPLE_RATE_HZ
    low, high = SPEED_HZ
    swing = 2.0 * np.pi / SWING_PERIOD_S * time_s
    speed_hz = low + (high - low) * time_s / duration_s + SWING_HZ * np.cos(swing)
    revolution = low * time_s + (high - low) / (2.0 * duration_s) * time_s**2
    revolution += SWING_HZ * SWING_PERIOD_S / (2.0 * np.pi) * np.sin(swing)
    orders = sum(
        peak * np.cos(2.0 * np.pi * order * revolution + order)
        for order, peak in AMPLITUDES.items()
    )
    tones = [np.cos(2.0 * np.pi * tone * time_s) for tone in TONES_HZ]
    noise = orders + 0.1 * generator.standard_normal(time_s.size)
    np.save(folder / "channels.npy", np.array([orders, *tones, noise]))
    since_pulse_s = (revolution % 1.0) / speed_hz
    pulse = np.clip(since_pulse_s / TACHO_RISE_S, 0.0, 1.0) * (revolution % 1.0 < 0.2)
    tacho = pulse + TACHO_NOISE * generator.standard_normal(time_s.size)
    np.save(folder / "tacho.npy", tacho)


def write_short(folder: Path) -> Path:
    """Short signals, with which the package compiles what it keeps for later runs."""
    folder.mkdir()
    write_signals(folder, QUICK_DURATION_S)
    return folder


def in_blocks(file: Path, samples: int) -> Iterator[np.ndarray]:
    """Blocks of the channels of a file; the mapping ends with the block, and its memory."""
    for first in range(0, samples, BLOCK_SAMPLES):
        yield np.array(np.load(file, mmap_mode="r")[:, first : first + BLOCK_SAMPLES])


def by_vibroacoustics(folder: Path) -> Map:
    """This package, which reads the recording in blocks."""
    from vibroacoustics.orders import order_map_of_blocks, pulse_times, tacho_motion

    tacho = np.load(folder / "tacho.npy", mmap_mode="r")
    samples = tacho.size
    motion = tacho_motion(pulse_times(tacho, SAMPLE_RATE_HZ)).motion
    del tacho
    blocks = in_blocks(folder / "channels.npy", samples)
    resolution = 1.5 / REVOLUTIONS_IN_BLOCK
    spectra = order_map_of_blocks(
        blocks, samples, SAMPLE_RATE_HZ, motion, MAXIMUM_ORDER, resolution
    )
    return spectra.amplitude, spectra.order


def by_vibroacoustics_arrays(channels: np.ndarray, tacho: np.ndarray) -> Map:
    """This package, with the whole recording and its signal over the angle in memory."""
    from vibroacoustics.orders import angular_resample, order_map, pulse_times, tacho_motion

    motion = tacho_motion(pulse_times(tacho, SAMPLE_RATE_HZ)).motion
    angular = angular_resample(channels, SAMPLE_RATE_HZ, motion, MAXIMUM_ORDER)
    spectra = order_map(angular, 1.5 / REVOLUTIONS_IN_BLOCK, "hann", 0.5)
    return spectra.amplitude, spectra.order


def smoothed_crossings(tacho: np.ndarray) -> np.ndarray:
    """Rising crossings of half the pulse, smoothed: a careful user's tacho."""
    from scipy.signal import savgol_filter

    above = tacho > 0.5
    rising = np.flatnonzero(above[1:] & ~above[:-1])
    rising = rising[np.diff(rising, prepend=-np.inf) > DEAD_TIME_S * SAMPLE_RATE_HZ]
    share = (0.5 - tacho[rising]) / (tacho[rising + 1] - tacho[rising])
    return np.asarray(savgol_filter((rising + share) / SAMPLE_RATE_HZ, SMOOTHED_PULSES, 3))


def by_scipy(channels: np.ndarray, tacho: np.ndarray) -> Map:
    """What a careful user writes with scipy: upsample, spline, filter over the angle, decimate."""
    from scipy.interpolate import CubicSpline
    from scipy.signal import resample_poly
    from scipy.signal.windows import hann

    times = smoothed_crossings(tacho)
    coarse, dense = 480, 6  # 2880 a revolution hold half the sample rate at 20 rev/s
    grid = np.arange((times.size - 1) * coarse * dense) / (coarse * dense)
    at = CubicSpline(np.arange(times.size), times)(grid) * SAMPLE_RATE_HZ
    length = REVOLUTIONS_IN_BLOCK * coarse
    window = hann(length, sym=False)
    lines = MAXIMUM_ORDER * REVOLUTIONS_IN_BLOCK + 1
    spectra = []
    for channel in channels:
        upsampled = resample_poly(channel, 2, 1, window=("kaiser", 10.0))
        fine = CubicSpline(np.arange(upsampled.size), upsampled)(2.0 * at)
        signal = resample_poly(fine, 1, dense, window=("kaiser", 10.0))
        blocks = np.lib.stride_tricks.sliding_window_view(signal, length)[:: length // 2]
        spectra.append(2.0 / window.sum() * np.fft.rfft(blocks * window)[:, :lines])
    return np.array(spectra), np.arange(lines) / REVOLUTIONS_IN_BLOCK


def by_rota(channels: np.ndarray, tacho: np.ndarray) -> Map:
    """rota-order; runs under the interpreter that has it."""
    import rota

    rpm = rota.speed.tacho_to_rpm(tacho, SAMPLE_RATE_HZ, smooth=SMOOTHED_PULSES)
    spectra = rota.maps.rpm_order_map(
        channels.T,
        SAMPLE_RATE_HZ,
        rpm,
        order_resolution=1.0 / REVOLUTIONS_IN_BLOCK,
        max_order=MAXIMUM_ORDER,
        overlap=0.5,
        window="hann",
        amplitude="peak",
    )
    return np.moveaxis(spectra.values, (2, 1, 0), (0, 1, 2)), spectra.axis


ARRAYS = "vibroacoustics, arrays"
OF_ARRAYS: dict[str, Callable[[np.ndarray, np.ndarray], Map]] = {
    ARRAYS: by_vibroacoustics_arrays,
    "scipy": by_scipy,
    "rota-order": by_rota,
}


def accuracy(amplitude: np.ndarray, order: np.ndarray) -> dict[str, float]:
    """Errors in dB; blocks at the ends, where a filter may have met no samples, are left out."""
    power = np.abs(amplitude[:, 4:-4]) ** 2
    result = {}
    for wanted, peak in AMPLITUDES.items():
        line = np.argmin(np.abs(order - wanted))
        result[str(wanted)] = 10.0 * np.log10(np.mean(power[0, :, line]) / peak**2)
    result["alias"] = 10.0 * np.log10(np.max(power[1 : 1 + len(TONES_HZ)]))
    return result


def work(method: str, folder: Path) -> None:
    """Process of one method: a run, its seconds and those of the processors for each line read,
    then the accuracy."""
    run = partial(by_vibroacoustics, folder)
    if method in OF_ARRAYS:
        files = (np.load(folder / name) for name in ("channels.npy", "tacho.npy"))
        run = partial(OF_ARRAYS[method], *files)
    spectra: Map | None = None
    for _ in sys.stdin:
        spectra = None
        start, start_cpu = time.perf_counter(), time.process_time()
        spectra = run()
        print(time.perf_counter() - start, time.process_time() - start_cpu, flush=True)
    peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
    assert spectra is not None
    print(json.dumps(accuracy(*spectra) | {"peak_mb": peak_mb}))


def rota_environment(folder: Path) -> str:
    """Interpreter of a new virtual environment with rota-order.

    Raises
    ------
    SystemExit
        It cannot be installed; the exit code is 2.
    """
    venv.create(folder, with_pip=True)
    python = str(folder / "bin" / "python")
    command = [python, "-m", "pip", "install", "--quiet", "rota-order"]
    if subprocess.run(command, check=False, stderr=subprocess.DEVNULL).returncode:
        print(
            "order_analysis.py: rota-order: cannot be installed; use --skip-rota", file=sys.stderr
        )
        raise SystemExit(2)
    return python


def compare(pythons: dict[str, str], folder: Path, rounds: int) -> dict[str, Any]:
    """Seconds of each run, the first one cold, (run, clock or processors), accuracy, by method."""
    workers = {
        method: subprocess.Popen(
            [python, __file__, "--work", method, "--folder", str(folder)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        for method, python in pythons.items()
    }
    seconds: dict[str, list[list[float]]] = {method: [] for method in workers}
    for _ in range(rounds + 1):
        for method, worker in workers.items():
            worker.stdin.write("run\n")
            worker.stdin.flush()
            seconds[method].append([float(word) for word in worker.stdout.readline().split()])
    return {
        method: (np.array(seconds[method]), json.loads(worker.communicate()[0]))
        for method, worker in workers.items()
    }


def main() -> None:
    """Print the table."""
    made = parser(__doc__)
    made.add_argument("--rota-python", help="interpreter of an environment with rota-order")
    made.add_argument("--skip-rota", action="store_true")
    made.add_argument("--rounds", type=int, default=3)
    made.add_argument("--work", choices=["vibroacoustics", *OF_ARRAYS], help=argparse.SUPPRESS)
    made.add_argument("--folder", type=Path, help=argparse.SUPPRESS)
    options = made.parse_args()
    if options.work:
        return work(options.work, options.folder)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_signals(folder, QUICK_DURATION_S if options.quick else DURATION_S)
        pythons = {"vibroacoustics": sys.executable}
        if not options.quick:
            pythons |= {ARRAYS: sys.executable, "scipy": sys.executable}
        if not (options.skip_rota or options.quick):
            pythons["rota-order"] = options.rota_python or rota_environment(folder / "venv")
        compare({"vibroacoustics": sys.executable}, write_short(folder / "short"), 0)
        load = os.getloadavg()[0]
        results = compare(pythons, folder, 1 if options.quick else options.rounds)
    print(f"{os.cpu_count()} processors; load before {load:.1f}, after {os.getloadavg()[0]:.1f}\n")
    print(table(results))
    return None


def table(results: dict[str, Any]) -> str:
    """Markdown: medians without the cold run, and their ratios to this package's."""
    rows = [
        "| method | median s | ratio | CPU s | ratio | runs s | cold s | peak MB "
        "| order 1, 2, 4 dB | order 120 dB | alias dB |",
        "|---" * 11 + "|",
    ]
    ours = np.median(results["vibroacoustics"][0][1:], axis=0)
    for method, (seconds, found) in results.items():
        wall, processors = np.median(seconds[1:], axis=0)
        cells = [
            method,
            f"{wall:.2f}",
            f"{wall / ours[0]:.1f}",
            f"{processors:.2f}",
            f"{processors / ours[1]:.1f}",
            ", ".join(f"{value:.2f}" for value in seconds[1:, 0]),
            f"{seconds[0, 0]:.2f}",
            f"{found['peak_mb']:.0f}",
            ", ".join(f"{found[order]:+.4f}" for order in ("1", "2", "4")),
            f"{found[str(MAXIMUM_ORDER)]:+.4f}",
            f"{found['alias']:.1f}",
        ]
        rows.append(f"| {' | '.join(cells)} |")
    return "\n".join(rows)


if __name__ == "__main__":
    main()
