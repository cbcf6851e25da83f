"""Time that boundary elements (bempp-cl) need per frequency for the body `cylinder`.

Runs in the environment of tests/oracles/boundary_elements, without the mesh's symmetry, which a
real shell does not have: six rigid motions, ten microphones, assembly and solution. Takes the
coarsest mesh that stays within `MEAN_DB` and `MICROPHONE_DB` of the finest results on file.

    NUMBA_NUM_THREADS=2 OMP_NUM_THREADS=2 python benchmarks/boundary_elements.py
"""

import csv
import statistics
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Final

import numpy as np
from quick import parser, require

require(("bempp_cl",))
ORACLE: Final = Path(__file__).parents[1] / "tests" / "oracles" / "boundary_elements"
sys.path.insert(0, str(ORACLE))

import run

BODY: Final = replace(run.CYLINDER, rim=0.35)
"""Coarse meshes need less refinement at the rims."""
SIZES_M: Final = (0.06, 0.05, 0.04, 0.03, 0.025, 0.02)
SAMPLED_HZ: Final = (48.0, 500.0, 2000.0)
FREQUENCIES_HZ: Final = np.arange(25.0, 2001.0, 25.0)
MEAN_DB: Final = 0.1
MICROPHONE_DB: Final = 0.3


def results_on_file(names: list[str]) -> run.ComplexArray:
    """Pressures of the body `cylinder`, (frequency, pattern, microphone)."""
    pressure = np.zeros((len(run.FREQUENCIES_HZ), len(names), len(run.MICROPHONES)), dtype=complex)
    with (ORACLE / "results.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            frequency_hz = float(row["frequency_hz"])
            wanted = row["body"] == BODY.name and row["pattern"] in names
            if wanted and frequency_hz in run.FREQUENCIES_HZ:
                place = run.FREQUENCIES_HZ.index(frequency_hz), names.index(row["pattern"])
                value = complex(float(row["pressure_real_pa"]), float(row["pressure_imaginary_pa"]))
                pressure[place][int(row["microphone"]) - 1] = value
    return pressure


def coarsest_mesh(rigid_only: bool, quick: bool) -> run.Mesh:
    """Coarsest mesh that is accurate enough at all frequencies up to 2 kHz; quickly, any."""
    if quick:
        return run.mesh(BODY, SIZES_M[0])
    motions = run.patterns(BODY)
    names = [name for name in motions if not rigid_only or name in run.rigid_motions()]
    reference = results_on_file(names)
    for size_m in SIZES_M:
        shape = run.mesh(BODY, size_m)
        radiation = run.Radiation(shape)
        pressure = np.array(
            [radiation.pressures([motions[name] for name in names], f) for f in run.FREQUENCIES_HZ]
        )
        mean = float(np.abs(run.mean_difference_db(pressure, reference)).max())
        largest = float(run.largest_difference_db(pressure, reference).max())
        print(
            f"{size_m * 1e3:g} mm, {len(shape.vertices)} vertices, {len(shape.triangles)} "
            f"triangles: mean {mean:.3f} dB, one microphone {largest:.3f} dB",
            flush=True,
        )
        if mean <= MEAN_DB and largest <= MICROPHONE_DB:
            return shape
    raise SystemExit("no mesh is accurate enough")


def main() -> None:
    """Choose the mesh, time the sampled frequencies and extrapolate to all of them."""
    options = parser(__doc__)
    options.add_argument("--repeats", type=int, default=3)
    options.add_argument("--all-patterns", action="store_true", help="also beam and oval accurate")
    options.add_argument("--quadrature", type=int, default=run.QUADRATURE_ORDER, help="order")
    arguments = options.parse_args()
    run.QUADRATURE_ORDER = arguments.quadrature
    repeats = 1 if arguments.quick else arguments.repeats
    shape = coarsest_mesh(rigid_only=not arguments.all_patterns, quick=arguments.quick)
    motions = list(run.rigid_motions().values())
    for by_sectors in (False, True):
        radiation = run.Radiation(shape, by_sectors)
        radiation.pressures(motions, SAMPLED_HZ[0])  # compiles
        medians = []
        for frequency_hz in SAMPLED_HZ:
            seconds = []
            for _ in range(repeats):
                start = time.perf_counter()
                radiation.pressures(motions, frequency_hz)
                seconds.append(time.perf_counter() - start)
            medians.append(statistics.median(seconds))
        total = float(np.interp(FREQUENCIES_HZ, SAMPLED_HZ, medians).sum())
        print("with" if by_sectors else "without", "the symmetry of the mesh:")
        for frequency_hz, median in zip(SAMPLED_HZ, medians, strict=True):
            print(f"  {frequency_hz:g} Hz: {median:.2f} s")
        print(f"  {len(FREQUENCIES_HZ)} frequencies to 2 kHz, from these: {total:.0f} s")


if __name__ == "__main__":
    main()
