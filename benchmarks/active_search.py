"""Active search of a study with key impacts beside random search: regret on ten seeds.

    OMP_NUM_THREADS=1 python benchmarks/active_search.py

The nominal machine of `copeland_sources` at 2900 rpm with a second Oldham ring whose keys are
nearly dry (0.5 µm of oil) in slots of 25 µm. Stroke and driven inertia of the ring vary. The
optimum is the least mean of 32 starts among the nine best designs of a grid of 13 x 13 (four starts
each) and the designs that the searches recommend. Random search takes the best of 60 designs by one
run each.
"""

import time

import numpy as np

import vibroacoustics as va
from vibroacoustics.design.coding import Coding
from vibroacoustics.design.evaluation import evaluating
from vibroacoustics.design.search.active import search_active
from vibroacoustics.design.search.problem import SearchProblem

STUDY = "pipelines/copeland_sources.toml"
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
GRID, GRID_STARTS, STARTS, SEEDS = 13, 4, 32, 10


def search_problem() -> SearchProblem:
    """Designs as shares of the ranges with the number of a run, to the level of the run."""
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


def grid(problem):
    """Designs of a grid, and their means and variances over starts."""
    axis = np.linspace(0.0, 1.0, GRID)
    shares = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    each = [
        levels(problem, share, 10_000 + GRID_STARTS * n + np.arange(GRID_STARTS))
        for n, share in enumerate(shares)
    ]
    return shares, np.mean(each, axis=1), np.var(each, axis=1, ddof=1)


def main() -> None:
    """Print scatter, span, and a row a seed."""
    problem = search_problem()
    shares, means, variances = grid(problem)
    scatter = np.sqrt(variances)
    print(f"{len(shares)} designs: {means.min():.2f} to {means.max():.2f} dB(A)")
    print(f"scatter over starts: {np.sqrt(variances.mean()):.2f} dB (root mean square), "
          f"{np.median(scatter):.2f} dB (median), {scatter.max():.2f} dB (largest)")  # fmt: skip
    rows, begin = [], time.process_time()
    for seed in range(SEEDS):
        runs = 100_000 * (seed + 1)

        def evaluate(designs, runs=runs):
            numbers = np.where(designs[:, -1] < 0, -1, runs + designs[:, -1])
            return problem.evaluate(np.column_stack([designs[:, :-1], numbers]))

        seeded = SearchProblem(problem.lower, problem.upper, problem.integer, evaluate)
        search = search_active(seeded, 60, 8, 0.001, seed)
        repeats = search.searched.evaluation.objectives[search.promised][1:, 0].mean()
        designs = np.random.default_rng((23, seed)).random((60, 2))
        singles = evaluate(np.column_stack([designs, 1000 + np.arange(60)])).objectives[:, 0]
        random = designs[np.argmin(singles)]
        rows.append((len(search.searched.designs), repeats, search.best, random))
    took = time.process_time() - begin
    fresh = 5_000_000 + np.arange(STARTS)
    near = shares[np.argsort(means)[:9]]
    best = [levels(problem, row[2], fresh).mean() for row in rows]
    optimum = min(*best, *(levels(problem, share, fresh).mean() for share in near))
    print(f"optimum {optimum:.2f} dB(A); {took / SEEDS:.0f} s of processor time a seed")
    print("seed  runs  mean of 8  32 starts  random: 8  32 starts   regret, dB")
    for seed, (row, level) in enumerate(zip(rows, best, strict=True)):
        beside = levels(problem, row[3], 6_000_000 + np.arange(STARTS))
        each = (row[1], level, beside[:8].mean(), beside.mean())
        print(f"{seed:4d}  {row[0]:4d}" + "".join(f"{one - optimum:11.3f}" for one in each))


if __name__ == "__main__":
    main()
