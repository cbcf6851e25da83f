"""Shell x sources: many designs from few loads and few radiations, and runs of some of them.

    OMP_NUM_THREADS=1 python benchmarks/loads_and_paths.py [DIRECT] [--quick]

The calibrated Copeland at one speed with nominal values, four microphones. First the front of
level, loudness, audibility and mass of 10⁵ designs: 40 shells (thickness, loss factor) times 25
clearances of the keys times 100 counterweights. Then 50 shells times 200 sources (port of the
discharge, clearance of the keys), 10⁴ designs, and the largest difference to DIRECT runs of the
stages up to the levels, 50 where not given. There the cache of transfer vectors is not read: what
is counted is computed.
"""

import os
import time

import numpy as np
from designs import WEIGHT
from hearing import OBJECTIVES
from quick import ROOT, parser
from sources_study import SOURCES_STUDY, made_up_modes

import vibroacoustics as va
from vibroacoustics.design.search.front import nondominated
from vibroacoustics.design.sweep_values import listed_grid
from vibroacoustics.levels.nominal import NominalSound
from vibroacoustics.pipeline.study import chain_with
from vibroacoustics.results.storage import without_cache
from vibroacoustics.stages.radiation import transfer_vectors

STUDY = ROOT / "pipelines" / "copeland_sources.toml"
SHELL = {
    "machine.structure.thickness_mm": {"range": [2.5, 4.0], "points": 10},
    "machine.structure.loss_factor_ratio": {"list": [0.003, 0.006, 0.01, 0.02, 0.03]},
}
SOURCES = {
    "machine.opening.port_diameter_mm": {"range": [8.0, 16.0], "points": 20},
    "machine.keys.clearance_um": {"range": [8.0, 40.0], "points": 10},
}
FRONT = {
    "machine.structure.thickness_mm": {"range": [2.5, 4.0], "points": 2},
    "machine.structure.loss_factor_ratio": {"range": [0.003, 0.03], "points": 20},
    "machine.keys.clearance_um": {"range": [8.0, 40.0], "points": 25},
    "options.weight.mass_g": {"range": [1, 100], "points": 10},
    "options.weight.angle_deg": {"range": [-180, 162], "points": 10},
}
QUICK = {"machine.keys.clearance_um": {"range": [8.0, 40.0], "points": 2}}
OUT = {"scoring.published_table": None, "evidence": None, "operation.point": None}
PUBLISHED_DBA = 66.0
"""Louder than the model with nominal values, which leaves no unmodelled noise of 56 dB(A)."""


def study_of(variables: dict, objectives: dict, option: str = "none", file=STUDY):
    """The study at one speed with a counterweight and a table of designs."""
    study = va.load_study(file)
    others = {f"options.{name}": None for name in study.options if name != "none"}
    return study.replace({
        **others,
        **(OUT if file == STUDY else {}),
        "operation.speed_rpm": [2900.0],
        "operation.supply_frequency_hz": [50.0],
        **({} if option == "none" else WEIGHT),
        "design": {"option": option, "variables": variables, "objectives": objectives},
    })  # fmt: skip


def nominal(study):
    """The study without uncertainty; other values still can be put in."""
    bare = study.model_copy(update={"ranges": ()})
    return bare.remember(*study._read)


class Counted:
    """Radiation that counts how often it is computed; quickly, it is made up."""

    def __init__(self, quick: bool) -> None:
        self.number, self.seconds, self._quick = 0, 0.0, quick

    def __call__(self, study, progress, motions=()):
        begin = time.process_time()
        with without_cache():
            made_up = (made_up_modes(study), False) if self._quick else None
            result = made_up or transfer_vectors(study, progress, motions)
        self.number += 1
        self.seconds += time.process_time() - begin
        return result


def front() -> None:
    """Print what a front takes whose loads and paths are known."""
    study = study_of(FRONT, OBJECTIVES, "weight")
    study = study.replace({"machine.overall_noise.level_dba": PUBLISHED_DBA})
    problem = va.Problem(nominal(study))
    listing = listed_grid(problem.space.axes(), ())
    designs = listing.designs(np.arange(listing.count))
    begin = time.process_time()
    problem.evaluate(designs)
    first = time.process_time() - begin
    problem.engine.of_option("weight")._groups.clear()  # all but loads and paths
    begin, wall = time.process_time(), time.perf_counter()
    objectives = problem.evaluate(designs).objectives
    members = int(nondominated(objectives).sum())
    end, end_wall = time.process_time(), time.perf_counter()
    print(f"{len(designs)} designs, with loads and paths: {first:.0f} s of processor time")
    print(f"  loads and paths known: {end - begin:.1f} s, front of {members}")
    print(f"  clock {end_wall - wall:.1f} s, load {os.getloadavg()[0]:.1f}")


def grid(direct: int, quick: bool) -> None:
    """Print what designs of shell and sources take, and how they differ from runs."""
    variables, file = (QUICK, SOURCES_STUDY) if quick else (SHELL | SOURCES, STUDY)
    study = study_of(variables, {"quiet": {"figure": "level_dba"}}, file=file)
    radiation = Counted(quick)
    problem = va.Problem(nominal(study), radiation)
    listing = listed_grid(problem.space.axes(), ())
    designs = listing.designs(np.arange(listing.count))
    begin, wall = time.process_time(), time.perf_counter()
    engine = problem.engine.of_option("none")
    for key, route in problem.engine.routes("none").items():
        print(key, "linear" if route.linear else "not linear:", route.reason)
    ready, ready_wall = time.process_time(), time.perf_counter()
    print(f"routes: {ready - begin:.0f} s of processor time, {ready_wall - wall:.0f} s")
    judged = problem.evaluate(designs)
    end, end_wall = time.process_time(), time.perf_counter()
    print(
        f"{len(designs)} designs: {end - ready:.0f} s of processor time, "
        f"{end_wall - ready_wall:.0f} s; {radiation.number} radiations in "
        f"{radiation.seconds:.0f} s, {engine.contraction.loads.computed} loads"
    )
    again = time.process_time()
    problem.evaluate(designs)
    print(f"again, loads and paths known: {time.process_time() - again:.1f} s")
    levels = judged.values[:, 0]
    print(f"failed {len(judged.failed)}, from {levels.min():.2f} to {levels.max():.2f} dB(A)")
    rows = np.random.default_rng(1).choice(len(designs), direct, replace=False)
    difference = [abs(levels[row] - run(problem, designs[row])) for row in rows]
    print(f"largest difference to {direct} runs: {max(difference, default=0.0):.2e} dB")


def run(problem, design) -> float:
    """Level of a design by the stages of a run, mean over microphones, dB(A)."""
    changed = problem.study.replace(problem.space.written(design))
    level = chain_with(changed, NominalSound, radiation=problem.radiation).results["level_modelled"]
    at = level.sel(weighting="A", option="none").values.ravel()
    return float(10.0 * np.log10(np.mean(10.0 ** (0.1 * at))))


if __name__ == "__main__":
    options = parser(__doc__)
    options.add_argument("direct", type=int, nargs="?", default=50)
    chosen = options.parse_args()
    if not chosen.quick:
        front()
    grid(1 if chosen.quick else chosen.direct, chosen.quick)
