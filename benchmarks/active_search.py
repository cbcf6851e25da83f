"""Active search of a study with key impacts beside random search: regret on ten seeds.

    OMP_NUM_THREADS=1 python benchmarks/active_search.py [--quick]

The nominal machine of `copeland_sources` at 2900 rpm with a second Oldham ring whose keys are
nearly dry (0.5 µm of oil) in slots of 25 µm. Stroke and driven inertia of the ring vary. The
optimum is the least mean of 32 starts among the nine best designs of a grid of 13 x 13 (four starts
each) and the designs that the searches recommend. Random search takes the best of 60 designs by one
run each.
"""

import time
from typing import NamedTuple

import numpy as np
from quick import ROOT, parser

import vibroacoustics as va
from vibroacoustics.design.active import Coding
from vibroacoustics.design.evaluation import evaluating
from vibroacoustics.design.search.active import search_active
from vibroacoustics.design.search.problem import SearchProblem

STUDY = ROOT / "pipelines" / "copeland_sources.toml"
CHANGES = {
    "operation.stopping": False,
    "operation.speed_rpm": [2900.0],
    "operation.supply_frequency_hz": [50.0],
    "radiation.maximum_frequency_hz": 2500.0,
    "machine.keys.oil_layer_um": 0.5,
    "machine.keys.clearance_um": 25.0,
    "design": {
        "option": "twin-oldham",
        "variables": {
            "options.twin-oldham.stroke_ratio": {"range": [0.3, 1.5]},
            "options.twin-oldham.driven_inertia_kg_m2": {"range": [1e-4, 8e-4]},
        },
        "objectives": {"level": {"figure": "level_dba"}},
        "tolerances": {"sources.keys.start": {"range": [1, 1_000_000]}},
        "search": {"method": "active"},
    },
}


class Size(NamedTuple):
    """Points of the grid along an axis, starts of each and of the best, seeds, runs, repeats."""

    grid: int = 13
    grid_starts: int = 4
    starts: int = 32
    seeds: int = 10
    runs: int = 60
    repeats: int = 8


QUICK = Size(2, 2, 2, 1, 9, 2)
QUICK_CHANGES = {"options.twin-oldham.driven_inertia_kg_m2": 2e-4, "sources.keys.start": 1}


def search_problem(quick: bool) -> SearchProblem:
    """Designs as shares of the ranges with the number of a run, to the level of the run."""
    if quick:
        from sources_study import SOURCES_STUDY, made_up_modes

        study = va.load_study(SOURCES_STUDY).replace(QUICK_CHANGES).replace(CHANGES)
        study = study.model_copy(update={"ranges": ()})
        problem = va.Problem(study, lambda study, *_: (made_up_modes(study), False))
    else:
        study = va.load_study(STUDY).replace(CHANGES).model_copy(update={"ranges": ()})
        problem = va.Problem(study)
    coding, evaluate = Coding(problem.space.variables), evaluating(problem)
    coded = coding.problem(evaluate)

    def level(rows):
        return evaluate(
            np.column_stack([coding.designs(coded.at_shares(rows[:, :-1])), rows[:, -1]])
        )

    return SearchProblem(np.zeros(2), np.ones(2), coded.integer, level)


def levels(problem, share, runs):
    """Levels of a design with the starts of some runs, dB(A)."""
    rows = np.column_stack([np.repeat(share[None], len(runs), axis=0), runs])
    return problem.evaluate(rows).objectives[:, 0]


def grid(problem, size):
    """Designs of a grid, and their means and variances over starts."""
    axis = np.linspace(0.0, 1.0, size.grid)
    shares = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    each = [
        levels(problem, share, 10_000 + size.grid_starts * n + np.arange(size.grid_starts))
        for n, share in enumerate(shares)
    ]
    return shares, np.mean(each, axis=1), np.var(each, axis=1, ddof=1)


def main() -> None:
    """Print scatter, span, and a row a seed."""
    quick = parser(__doc__).parse_args().quick
    size = QUICK if quick else Size()
    problem = search_problem(quick)
    shares, means, variances = grid(problem, size)
    scatter = np.sqrt(variances)
    print(f"{len(shares)} designs: {means.min():.2f} to {means.max():.2f} dB(A)")
    print(f"scatter over starts: {np.sqrt(variances.mean()):.2f} dB (root mean square), "
          f"{np.median(scatter):.2f} dB (median), {scatter.max():.2f} dB (largest)")  # fmt: skip
    rows, begin = [], time.process_time()
    for seed in range(size.seeds):
        runs = 100_000 * (seed + 1)

        def evaluate(designs, runs=runs):
            numbers = np.where(designs[:, -1] < 0, -1, runs + designs[:, -1])
            return problem.evaluate(np.column_stack([designs[:, :-1], numbers]))

        seeded = SearchProblem(problem.lower, problem.upper, problem.integer, evaluate)
        search = search_active(seeded, size.runs, size.repeats, 0.001, seed)
        repeats = search.searched.evaluation.objectives[search.promised][1:, 0].mean()
        designs = np.random.default_rng((23, seed)).random((size.runs, 2))
        singles = evaluate(np.column_stack([designs, 1000 + np.arange(size.runs)])).objectives[:, 0]
        random = designs[np.argmin(singles)]
        rows.append((len(search.searched.designs), repeats, search.best, random))
    took = time.process_time() - begin
    fresh = 5_000_000 + np.arange(size.starts)
    near = shares[np.argsort(means)[:9]]
    best = [levels(problem, row[2], fresh).mean() for row in rows]
    optimum = min(*best, *(levels(problem, share, fresh).mean() for share in near))
    print(f"optimum {optimum:.2f} dB(A); {took / size.seeds:.0f} s of processor time a seed")
    print("seed  runs  mean of 8  32 starts  random: 8  32 starts   regret, dB")
    for seed, (row, level) in enumerate(zip(rows, best, strict=True)):
        beside = levels(problem, row[3], 6_000_000 + np.arange(size.starts))
        each = (row[1], level, beside[:8].mean(), beside.mean())
        print(f"{seed:4d}  {row[0]:4d}" + "".join(f"{one - optimum:11.3f}" for one in each))


if __name__ == "__main__":
    main()
