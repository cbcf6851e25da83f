"""Time of a set of six transfer vectors at ten microphones, 80 frequencies to 2 kHz, free field.

The body, the microphones and the accuracy (0.1 dB in the mean, 0.3 dB at each microphone within
20 dB of the loudest) are those of `boundary_elements.py`, the other side of the ratio:

    python benchmarks/transfer_vectors.py --boundary-elements PYTHON_OF_THAT_ENVIRONMENT [--quick]
"""

import csv
import statistics
import subprocess
import time
from pathlib import Path
from typing import Final

import numpy as np
from quick import parser

from vibroacoustics.base.revolution import capped_cylinder
from vibroacoustics.base.vocabulary import RIGID_BODY_DOFS
from vibroacoustics.radiation.bodies import turned
from vibroacoustics.radiation.machine_side import MachineSide, near_fields
from vibroacoustics.radiation.patterns import rigid_body
from vibroacoustics.radiation.scene import Scene
from vibroacoustics.radiation.task import Microphones

FOLDER: Final = Path(__file__).parent
RESULTS: Final = FOLDER.parent / "tests" / "oracles" / "boundary_elements" / "results.csv"
SPACING_M: Final = (0.016, 0.014, 0.012, 0.006)
"""Around the coarsest that is accurate enough, and the default."""
MAXIMUM_HZ: Final = 2000.0
TABLE_HZ: Final = np.arange(25.0, MAXIMUM_HZ + 1.0, 25.0)
REFERENCE_HZ: Final = np.array([48.0, 117.0, 250.0, 500.0, 1000.0, 1500.0, 2000.0])


def reference() -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Microphones (microphone, 3) and pressures (microphone, frequency) by motion."""
    with RESULTS.open(encoding="utf-8") as file:
        rows = [
            row
            for row in csv.DictReader(line for line in file if not line.startswith("#"))
            if row["body"] == "cylinder" and float(row["frequency_hz"]) in REFERENCE_HZ
        ]
    places = {int(row["microphone"]): [float(row[f"{axis}_m"]) for axis in "xyz"] for row in rows}
    pressure = {name: np.zeros((10, REFERENCE_HZ.size), dtype=complex) for name in RIGID_BODY_DOFS}
    for row in rows:
        if row["pattern"] in pressure:
            column = int(np.flatnonzero(float(row["frequency_hz"]) == REFERENCE_HZ)[0])
            value = complex(float(row["pressure_real_pa"]), float(row["pressure_imaginary_pa"]))
            pressure[row["pattern"]][int(row["microphone"]) - 1, column] = value
    return np.array([places[number] for number in sorted(places)]), pressure


def transfer_vectors(
    spacing_m: float, frequency_hz: np.ndarray, points: np.ndarray, maximum_hz: float = MAXIMUM_HZ
) -> np.ndarray:
    """Pressures (microphone, dof, frequency)."""
    body = turned(capped_cylinder(0.0825, -0.19, 0.227))
    patterns = [rigid_body(dof) for dof in RIGID_BODY_DOFS]
    alone = Scene(body, (), ())
    near = near_fields(alone, spacing_m, maximum_hz)
    side = MachineSide(alone, near, patterns, frequency_hz, [Microphones(points)])
    return side.closed[0].pressure


def main() -> None:
    options = parser(__doc__)
    options.add_argument("--repeats", type=int, default=3)
    options.add_argument("--boundary-elements", metavar="PYTHON")
    arguments = options.parse_args()
    points, pressure = reference()
    if arguments.quick:
        hertz = REFERENCE_HZ[:2]
        found = np.abs(transfer_vectors(0.04, hertz, points, hertz.max()))
        power = (found[:, 0] ** 2).mean(axis=0) / (np.abs(pressure["tx"][:, :2]) ** 2).mean(axis=0)
        print(f"40 mm, {hertz} Hz: tx within {np.abs(10.0 * np.log10(power)).max():.2f} dB")
        return
    transfer_vectors(SPACING_M[0], TABLE_HZ[:2], points)  # compile
    for spacing_m in SPACING_M:
        seconds = []
        for _ in range(arguments.repeats):
            begin = time.perf_counter()
            transfer_vectors(spacing_m, TABLE_HZ, points)
            seconds.append(time.perf_counter() - begin)
        found = transfer_vectors(spacing_m, REFERENCE_HZ, points)
        mean = single = 0.0
        for name in ("tx", "tz", "ry"):
            ours, theirs = found[:, RIGID_BODY_DOFS.index(name)], pressure[name]
            power = (np.abs(ours) ** 2).mean(axis=0) / (np.abs(theirs) ** 2).mean(axis=0)
            mean = max(mean, float(np.abs(10.0 * np.log10(power)).max()))
            loud = np.abs(theirs) > 0.1 * np.abs(theirs).max(axis=0)
            gap = 20.0 * np.log10(np.abs(ours[loud] / theirs[loud]))
            single = max(single, float(np.abs(gap).max()))
        print(
            f"{1e3 * spacing_m:g} mm: median {statistics.median(seconds):.2f} s; against boundary "
            f"elements {mean:.3f} dB in the mean, {single:.3f} dB at a microphone",
            flush=True,
        )
    if arguments.boundary_elements:
        script = FOLDER / "boundary_elements.py"
        subprocess.run([arguments.boundary_elements, str(script)], check=True)


if __name__ == "__main__":
    main()
