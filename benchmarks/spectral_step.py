"""Time and memory of a k-Wave step: stock (NumPy backend) against the fused engine.

`python benchmarks/spectral_step.py [side ...] [--quick]` prints a Markdown table; the sides default
to 96 and 128 nodes. Stock and fused steps take turns in one run, with the pulse on; medians.
"""

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from quick import parser, require

require(("kwave",))

from vibroacoustics.base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from vibroacoustics.radiation import kwave
from vibroacoustics.radiation.room_grid import RoomGrid
from vibroacoustics.radiation.spectral_layout import half_shape
from vibroacoustics.radiation.spectral_step import SpectralStep, step_bytes

ROUNDS = 5
FUSED_STEPS_A_ROUND = 4
THREADS = 2
BOX_NODES, QUICK_BOX_NODES = slice(35, 75), slice(20, 28)
QUICK_SIDE = 48
VALUES_MOVED = 8 + 12 + 3 + 1.5
"""Real numbers a node and step: pressure (read thrice, written once, updated twice), velocities and
parts of three axes (read and written), footprints, k-space corrections."""


def seconds(work: Callable[[], object]) -> float:
    """Duration of one call."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def copy_bandwidth(threads: int = THREADS) -> float:
    """Bytes read and written each second by copying with all threads, the best of several."""
    source = [np.ones(2**26, dtype=np.uint8) for _ in range(threads)]
    target = [part.copy() for part in source]
    with ThreadPoolExecutor(threads) as pool:

        def copy_all() -> None:
            list(pool.map(np.copyto, target, source))

        return 2 * 2**26 * threads / min(seconds(copy_all) for _ in range(9))


def transform_seconds(engine: SpectralStep) -> float:
    """Time of a step's transforms alone, on work arrays in the cache."""
    total = 0.0
    for field in engine._fields:
        for planes in field.slabs:
            slab = field._work[0][planes.stop - planes.start]
            total += 2 * seconds(slab.to_position) + 2 * seconds(slab.to_wavenumber)
    return total / THREADS


def compare(side: int, dtype: type, bandwidth: float) -> str:
    """One row of the table."""
    box = QUICK_BOX_NODES if side == QUICK_SIDE else BOX_NODES
    middle = (side // 2, side // 2, side // 2)
    grid = RoomGrid(np.full(3, 0.03), np.zeros(3), (side,) * 3, (middle,), np.ones(1), (box,) * 3)
    source = kwave.pressure_source(grid, np.sin(np.arange(200) / 3.0))
    fused = SpectralStep(
        kwave.axis_operators(grid),
        grid.time_step_s,
        SPEED_OF_SOUND_M_PER_S,
        AIR_DENSITY_KG_PER_M3,
        source,
        dtype,
        THREADS,
    )
    stock = kwave.build_simulation(grid, source, 1000, dtype=dtype)
    stock_s, fused_s, steps_done = [], [], 0
    for _ in range(ROUNDS):
        stock_s.append(seconds(stock.step))
        fused_s += [seconds(fused.step) for _ in range(FUSED_STEPS_A_ROUND)]
        steps_done += FUSED_STEPS_A_ROUND
    record = np.median([seconds(lambda: fused.pressure(grid.block)) for _ in range(5)])
    share = np.median([transform_seconds(fused) for _ in range(3)]) / np.median(fused_s)
    values = VALUES_MOVED * 2 * np.prod(half_shape(grid.shape)) * np.dtype(dtype).itemsize
    while stock.t < steps_done:
        stock.step()
    difference = np.abs(fused.pressure() - stock.p).max() / np.abs(stock.p).max()
    fused.close()
    stock_ms, fused_ms = 1e3 * np.median(stock_s), 1e3 * np.median(fused_s)
    return (
        f"| {side}³ {np.dtype(dtype).name} | {stock_ms:.0f} ({1e3 * min(stock_s):.0f}) "
        f"| {fused_ms:.1f} ({1e3 * min(fused_s):.1f}) | {stock_ms / fused_ms:.1f} "
        f"| {100 * share:.0f} % | {1e3 * values / bandwidth:.1f} | {1e3 * record:.1f} "
        f"| {step_bytes(grid.shape, dtype) / 1e6:.0f} | {difference:.1e} |"
    )


def main(sides: list[int]) -> None:
    """Print the table."""
    bandwidth = copy_bandwidth()
    print(f"{THREADS} threads; copying moves {bandwidth / 1e9:.1f} GB/s; median (minimum), ms\n")
    print(
        "| grid | stock | fused | ratio | transforms | bandwidth floor | read box | MB "
        "| largest difference |"
    )
    print("|---|---|---|---|---|---|---|---|---|")
    for side in sides:
        for dtype in (np.float32, np.float64):
            print(compare(side, dtype, bandwidth), flush=True)


if __name__ == "__main__":
    options = parser(__doc__)
    options.add_argument("side", type=int, nargs="*", default=[96, 128])
    chosen = options.parse_args()
    main([QUICK_SIDE] if chosen.quick else chosen.side)
