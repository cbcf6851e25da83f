"""Plans of six sweeps beside what the sweeps take: processor time, memory and disk.

    OMP_NUM_THREADS=1 python benchmarks/sweep_plans.py [NAME …] [--quick]

Each sweep is the command `sweep` in a process of its own; the radiation of its base study is cached
before. Time is the processor time of all processes after the plan, divided by their number. Memory
is the largest of the process that plans.
"""

import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Final, NamedTuple

import psutil
from quick import parser

STUDIES: Final = Path(__file__).parents[1] / "docs" / "gallery" / "studies"
MEMORY_UNIT_BYTES: Final = 1024
WEIGHT: Final = """
[options.weight]
kind = "counterweight"
mass_g = 50.0
radius_mm = 20.0
angle_deg = 180.0
height_mm = 0.0
"""
LEVEL_AND_FOOT: Final = """
[design.objectives.quiet]
figure = "level_dba"
[design.objectives.foot]
figure = "foot_force_n"
order = 1
"""


class Sweep(NamedTuple):
    """The study that a sweep extends, what it adds, and its local workers."""

    base: str
    text: str
    workers: int = 0


SWEEPS: Final = {
    "counterweights": Sweep("copeland", f"""{WEIGHT}
[design]
option = "weight"
sampling = "latin-hypercube"
samples = 2_000_000
[design.variables]
options.weight.mass_g = {{ range = [1, 100] }}
options.weight.radius_mm = {{ range = [5, 40] }}
options.weight.angle_deg = {{ range = [-180, 180] }}
options.weight.height_mm = {{ range = [-100, 100] }}
{LEVEL_AND_FOOT}"""),
    "mounts": Sweep("copeland", f"""{WEIGHT}
[design]
option = "weight"
sampling = "latin-hypercube"
samples = 100_000
[design.variables]
options.weight.mass_g = {{ range = [1, 100] }}
machine.mounts.vertical_stiffness_n_per_mm = {{ range = [5, 50] }}
machine.mounts.lateral_stiffness_n_per_mm = {{ range = [5, 50] }}
machine.mounts.loss_factor_ratio = {{ range = [0.02, 0.3] }}
{LEVEL_AND_FOOT}"""),
    "tolerances": Sweep("copeland", f"""{WEIGHT}
[design]
option = "weight"
tolerance_samples = 256
[design.variables]
options.weight.mass_g = {{ range = [1, 100], points = 200 }}
options.weight.angle_deg = {{ range = [-180, 180], points = 200 }}
[design.tolerances]
options.weight.mass_g = {{ ratio = 0.03 }}
options.weight.angle_deg = {{ plus_minus = 5.0 }}
{LEVEL_AND_FOOT}"""),
    "loads and paths": Sweep("sources", f"""
[design]
option = "damping"
[design.variables]
machine.structure.loss_factor_ratio = {{ range = [0.003, 0.03], points = 30 }}
machine.keys.clearance_um = {{ range = [8.0, 40.0], points = 40 }}
{LEVEL_AND_FOOT}"""),
    "runs": Sweep("sources", f"""
[design]
option = "damping"
[design.variables]
machine.keys.clearance_um = {{ range = [8.0, 40.0], points = 6 }}
machine.opening.port_diameter_mm = {{ range = [8.0, 16.0], points = 4 }}
[design.objectives.moment]
figure = "residual_moment_nm"
{LEVEL_AND_FOOT}"""),
    "runs by two workers": Sweep("sources", f"""
[design]
option = "damping"
[design.variables]
machine.keys.clearance_um = {{ range = [8.0, 40.0], points = 16 }}
machine.opening.port_diameter_mm = {{ range = [8.0, 16.0], points = 6 }}
[design.objectives.moment]
figure = "residual_moment_nm"
{LEVEL_AND_FOOT}""", 2),
}  # fmt: skip
QUICK: Final = Sweep(
    "../../../tests/studies/tiny",
    f"""{WEIGHT}
[operation]
maximum_order = 3
[radiation]
maximum_frequency_hz = 200.0
[design]
option = "weight"
sampling = "latin-hypercube"
samples = 64
[design.variables]
options.weight.mass_g = {{ range = [1, 100] }}
{LEVEL_AND_FOOT}""",
)
PLAN: Final = re.compile(
    r"about (?P<time>[\d.e+]+) (?P<unit>s|min|h) after the start, "
    r"(?P<memory>[\d.e+]+) MB of memory, "
    r"(?P<disk>[\d.e+]+) MB on disk"
)
SECONDS: Final = {"s": 1.0, "min": 60.0, "h": 3600.0}


class Taken(NamedTuple):
    """Figures of a sweep: processor time, s, memory and disk, MB."""

    seconds: float
    memory_mb: float
    disk_mb: float


def taken(words: list[str], folder: Path) -> tuple[Taken, Taken]:
    """Run a sweep whose results are in a folder; return its plan and what it took."""
    process = subprocess.Popen(
        [sys.executable, "-m", "vibroacoustics", *words, "--out", str(folder)],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    lines = process.stderr or []
    for line in lines:
        if plan := PLAN.search(line):
            before_s = sum(psutil.Process(process.pid).cpu_times()[:4])
            begin = time.perf_counter()
            print(line.strip())
            break
    others = list(lines)
    _, status, usage = os.wait4(process.pid, 0)
    if status or plan is None:
        raise SystemExit("".join(others))
    planned = Taken(
        float(plan["time"]) * SECONDS[plan["unit"]], float(plan["memory"]), float(plan["disk"])
    )
    print(f"  by the clock {time.perf_counter() - begin:.1f} s, load {os.getloadavg()[0]:.1f}")
    disk = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
    seconds = usage.ru_utime + usage.ru_stime - before_s
    return planned, Taken(seconds, usage.ru_maxrss * MEMORY_UNIT_BYTES / 1e6, disk / 1e6)


def planned_and_taken(sweep: Sweep, folder: Path) -> tuple[Taken, Taken]:
    """Return plan and figures of a sweep; its time is that of one process."""
    study = folder / "study.toml"
    study.write_text(f'extends = "{STUDIES / sweep.base}.toml"\n{sweep.text}')
    words = [sys.executable, "-m", "vibroacoustics", "radiation", str(study)]
    subprocess.run([*words, "--out", str(folder / "radiation")], check=True, capture_output=True)
    workers = ["--workers", str(sweep.workers)]
    plan, figures = taken(["sweep", str(study), *workers], folder / "sweep")
    return plan, figures._replace(seconds=figures.seconds / max(sweep.workers, 1))


def main(sweeps: dict[str, Sweep]) -> None:
    """Print plan, what was taken, and their ratio."""
    for name, sweep in sweeps.items():
        with tempfile.TemporaryDirectory() as folder:
            plan, taken = planned_and_taken(sweep, Path(folder))
        print(name)
        for unit, expected, measured in zip(("s", "MB", "MB on disk"), plan, taken, strict=True):
            print(f"  {expected:10.3g} {measured:10.3g} {unit:12} {expected / measured - 1.0:+.0%}")


if __name__ == "__main__":
    options = parser(__doc__)
    options.add_argument("name", nargs="*", choices=[*SWEEPS, []], metavar="NAME")
    chosen = options.parse_args()
    main(
        {"quick": QUICK} if chosen.quick else {name: SWEEPS[name] for name in chosen.name or SWEEPS}
    )
