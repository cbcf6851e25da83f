"""Every number of every study in one file, and the comparison of two such files.

    python benchmarks/study_numbers.py run before.h5 [--study NAME …] [--full]
    python benchmarks/study_numbers.py compare before.h5 after.h5 [--tolerance 1e-9] [--reasons F]
    python benchmarks/study_numbers.py --quick

`run` computes each study of `pipelines/` in a process of its own with an empty cache. Studies that
take minutes are computed coarsely unless `--full` is given. `compare` lists each variable whose
largest difference, over the largest magnitude of the variable, exceeds the tolerance. A file of
reasons excuses differences; a reason that excuses nothing is reported:

    [[reason]]
    study = "kitchen"             # a pattern, as for file names
    variable = "room_level_*"
    within = 1e-3                 # of the largest magnitude; any difference where it is omitted
    because = "walls are fitted with free quality"

The name is not `numbers`: a script's folder is on Python's path, and numpy imports that module.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
import tomllib
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path
from typing import Any, Final

import h5py
import numpy as np
from quick import ROOT, parser

PIPELINES: Final = ROOT / "pipelines"
TINY: Final = ROOT / "tests" / "studies" / "tiny.toml"
MINUTES: Final = ("copeland_sources", "copeland_cabinet", "copeland_inverter", "kitchen")
"""Studies that take minutes at full resolution."""
UNLIKE: Final = np.inf
"""Difference of variables of different shape or text."""


@dataclass(frozen=True)
class Difference:
    """The largest difference of one variable of one study, over its largest magnitude."""

    study: str
    variable: str
    relative: float
    absolute: float
    unit: str

    def __str__(self) -> str:
        name = f"{self.study:24s} {self.variable:44s}"
        if self.relative == UNLIKE:
            return f"{name} missing, or of another shape or text"
        return f"{name} {self.relative:9.1e} {self.absolute:11.3e} {self.unit}"


@dataclass(frozen=True)
class Reason:
    """An expected difference: patterns of study and variable, the largest one, and why."""

    study: str
    variable: str
    because: str
    within: float = UNLIKE

    def excuses(self, difference: Difference) -> bool:
        """Whether study, variable and size are those of this reason."""
        named = fnmatch(difference.study, self.study) and fnmatch(
            difference.variable, self.variable
        )
        return named and difference.relative <= self.within


def compute(study: Path, coarsely: bool, file: Path, radiation: Any = None) -> None:
    """Run one study in this process and add its variables to the file as a group.

    Parameters
    ----------
    study : file of the study
    coarsely : whether it is made coarse
    file : HDF5 file
    radiation : argument of `run`; by default that of the study
    """
    import vibroacoustics as va
    from vibroacoustics.study.coarse import coarse

    start = time.process_time()
    loaded = va.load_study(study)
    given = {} if radiation is None else {"radiation": radiation}
    results = va.run(coarse(loaded) if coarsely else loaded, **given)
    with h5py.File(file, "a") as table:
        group = table.create_group(study.stem)
        group.attrs["processor_seconds"] = time.process_time() - start
        group.attrs["coarse"] = coarsely
        for name, variable in results.variables.items():
            text = variable.dtype.kind in "OUS"
            values = (
                np.asarray(variable.values.astype(str).tolist(), "O") if text else variable.values
            )
            stored = group.create_dataset(
                str(name), data=values, dtype=h5py.string_dtype() if text else None
            )
            stored.attrs["unit"] = str(variable.attrs.get("units", ""))


def run(file: Path, names: list[str], full: bool) -> int:
    """Compute the studies one after the other; the number of those that failed."""
    studies = [PIPELINES / f"{name}.toml" for name in names] or sorted(PIPELINES.glob("*.toml"))
    file.unlink(missing_ok=True)
    failed = 0
    for number, study in enumerate(studies, 1):
        coarsely = study.stem in MINUTES and not full
        print(
            f"{number}/{len(studies)} {study.stem}{' (coarse)' if coarsely else ''}",
            file=sys.stderr,
        )
        arguments = ["--compute", str(study), *(["--coarse"] if coarsely else [])]
        with tempfile.TemporaryDirectory() as cache:
            done = subprocess.run(
                [sys.executable, __file__, "run", str(file), *arguments],
                env=os.environ | {"XDG_CACHE_HOME": cache},
                check=False,
            )
        failed += done.returncode != 0
    return failed


def values_of(table: h5py.File) -> dict[tuple[str, str], tuple[Any, str]]:
    """Values and unit by study and variable."""
    return {
        (study, name): (stored[()], str(stored.attrs["unit"]))
        for study, group in table.items()
        for name, stored in group.items()
    }


def difference_of(first: Any, second: Any) -> tuple[float, float]:
    """Largest difference, relative to the largest magnitude and absolute.

    Not-a-number agrees with not-a-number at the same place only; equal infinities agree.
    """
    first, second = np.asarray(first), np.asarray(second)
    if first.shape != second.shape or first.dtype.kind != second.dtype.kind:
        return UNLIKE, UNLIKE
    if first.dtype.kind not in "biufc":
        return (0.0, 0.0) if np.array_equal(first, second) else (UNLIKE, UNLIKE)
    wide = np.result_type(first, second, np.float64)
    first, second = first.astype(wide), second.astype(wide)
    equal = (first == second) | (np.isnan(first) & np.isnan(second))
    if equal.all():
        return 0.0, 0.0
    if not (np.isfinite(first[~equal]).all() and np.isfinite(second[~equal]).all()):
        return UNLIKE, UNLIKE
    absolute = float(np.abs(first[~equal] - second[~equal]).max())
    finite = np.concatenate([first[np.isfinite(first)], second[np.isfinite(second)]])
    return absolute / float(np.abs(finite).max()), absolute


def compare(before: Path, after: Path, tolerance: float, reasons: list[Reason]) -> int:
    """Print what differs without a reason, and reasons that excuse nothing; their number."""
    with h5py.File(before) as first, h5py.File(after) as second:
        tables = values_of(first), values_of(second)
    missing = (np.empty(0), "")
    differences = []
    for study, variable in sorted(tables[0].keys() | tables[1].keys()):
        (old, unit), (new, _) = (table.get((study, variable), missing) for table in tables)
        relative, absolute = difference_of(old, new)
        if relative > tolerance:
            differences.append(Difference(study, variable, relative, absolute, unit))
    unexcused = [d for d in differences if not any(reason.excuses(d) for reason in reasons)]
    idle = [reason for reason in reasons if not any(reason.excuses(d) for d in differences)]
    for difference in unexcused:
        print(difference)
    for reason in idle:
        print(f"no difference of {reason.study}, {reason.variable}: {reason.because}")
    print(
        f"{len(tables[0])} and {len(tables[1])} variables: {len(differences)} differ by more than "
        f"{tolerance:g}, {len(unexcused)} without a reason"
    )
    return len(unexcused) + len(idle)


def quickly() -> int:
    """Compute a tiny study with made-up radiation twice, and compare the numbers; 0 if equal."""
    from support import made_up_radiation

    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / f"{number}.h5" for number in range(2)]
        for file in files:
            compute(TINY, False, file, made_up_radiation)
        return int(compare(*files, 0.0, []) > 0)


def main() -> int:
    """Run or compare; the exit code is 1 where something failed or differs without a reason."""
    options = parser(__doc__)
    verbs = options.add_subparsers(dest="verb")
    running = verbs.add_parser("run")
    running.add_argument("file", type=Path)
    running.add_argument("--study", nargs="+", default=[])
    running.add_argument("--full", action="store_true")
    running.add_argument("--compute", type=Path, help=argparse.SUPPRESS)
    running.add_argument("--coarse", action="store_true", help=argparse.SUPPRESS)
    comparing = verbs.add_parser("compare")
    comparing.add_argument("before", type=Path)
    comparing.add_argument("after", type=Path)
    comparing.add_argument("--tolerance", type=float, default=1e-9)
    comparing.add_argument("--reasons", type=Path)
    chosen = options.parse_args()
    if chosen.quick:
        return quickly()
    if chosen.verb is None:
        options.error("run or compare must be given")
    if chosen.verb == "compare":
        text = chosen.reasons.read_text() if chosen.reasons else ""
        reasons = [Reason(**entry) for entry in tomllib.loads(text).get("reason", [])]
        return int(compare(chosen.before, chosen.after, chosen.tolerance, reasons) > 0)
    if chosen.compute:
        compute(chosen.compute, chosen.coarse, chosen.file)
        return 0
    return int(run(chosen.file, chosen.study, chosen.full) > 0)


if __name__ == "__main__":
    sys.exit(main())
