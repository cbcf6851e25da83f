"""Time, memory and disk of a study at many speeds, its radiation from the cache.

    python benchmarks/many_speeds.py [--study FILE] [--speeds 2 200 1000] [--quick]

Each number of speeds from 2000 to 3700 rpm runs in a process of its own. The first run of a study
fills the cache, which takes minutes; its time does not count.
"""

import argparse
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Final

from quick import ROOT, parser

STUDY: Final = ROOT / "pipelines" / "copeland_thesis.toml"
QUICK: Final = ROOT / "tests" / "studies" / "tiny.toml"
QUICK_RADIATION: Final = "maximum_order = 3\n[radiation]\nmaximum_frequency_hz = 200.0\n"
LOWEST_RPM: Final = 2000.0
HIGHEST_RPM: Final = 3700.0


def text_of(study: Path, speeds: int) -> str:
    """A study that extends another, at so many speeds."""
    step = (HIGHEST_RPM - LOWEST_RPM) / (speeds - 1)
    table = f"{{ start = {LOWEST_RPM}, stop = {HIGHEST_RPM}, step = {step!r} }}"
    return f'extends = "{study.resolve()}"\n[operation]\nspeed_rpm = {table}\n'


def measure(file: Path, folder: Path) -> str:
    """Run the study in this process: one line of the table."""
    from vibroacoustics import pipeline
    from vibroacoustics.results import storage
    from vibroacoustics.study import loading

    study = loading.load_study(file)
    pipeline.radiate(study)
    start = time.perf_counter()
    results = pipeline.run(study)
    computed = time.perf_counter()
    path = storage.write_results(results, folder / "results.nc")
    written = time.perf_counter()
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
    return (
        f"{len(study.operation.speed_rpm):6d} {computed - start:10.1f} {written - computed:10.1f} "
        f"{peak:10.0f} {path.stat().st_size / 1e6:10.0f}"
    )


def main() -> None:
    """Print a line for each number of speeds."""
    options = parser(__doc__)
    options.add_argument("--study", type=Path, default=STUDY)
    options.add_argument("--speeds", type=int, nargs="+", default=[2, 200, 1000])
    options.add_argument("--measure", type=Path, help=argparse.SUPPRESS)
    given = options.parse_args()
    if given.measure:
        print(measure(given.measure, given.measure.parent))
        return
    print("speeds  compute, s   write, s   peak, MB   disk, MB", flush=True)
    if given.quick:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "few.toml"
            file.write_text(text_of(QUICK, 2) + QUICK_RADIATION, encoding="utf-8")
            print(measure(file, Path(folder)))
        return
    for speeds in given.speeds:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "many.toml"
            file.write_text(text_of(given.study, speeds), encoding="utf-8")
            subprocess.run([sys.executable, __file__, "--measure", str(file)], check=True)


if __name__ == "__main__":
    main()
