"""Designs by linear algebra beside the plain pipeline, in one run.

    OMP_NUM_THREADS=1 python benchmarks/designs.py [--quick]

The printed Copeland with four microphones and 40 orders, radiation made up: 10⁵ counterweights on
free mounts at 8 speeds, 10⁷ cases (designs x speeds) of counterweights on the mounts as given, and
designs of both through the pipeline, with the largest difference.
"""

import resource
import time
from pathlib import Path

import numpy as np
from quick import parser

import vibroacoustics as va
from vibroacoustics.design.problem import Problem
from vibroacoustics.radiation.given import Radiation
from vibroacoustics.study.study import Study

STUDY = Path(__file__).parents[1] / "pipelines" / "copeland_thesis.toml"
WEIGHT = {
    "options.weight": {
        "kind": "counterweight", "mass_g": 50.0, "radius_mm": 20.0, "angle_deg": 180.0,
        "height_mm": 0.0,
    },
}  # fmt: skip
VARIABLES = {
    "options.weight.mass_g": {"range": [1, 100]},
    "options.weight.radius_mm": {"range": [5, 40]},
    "options.weight.angle_deg": {"range": [-180, 180]},
    "options.weight.height_mm": {"range": [-100, 100]},
}
MOUNTS = {
    "machine.mounts.vertical_stiffness_n_per_mm": {"range": [5, 50]},
    "machine.mounts.lateral_stiffness_n_per_mm": {"range": [5, 50]},
    "machine.mounts.loss_factor_ratio": {"range": [0.02, 0.3]},
    "machine.mounts.pitch_mm": {"range": [150, 250]},
}
PIPELINE_DESIGNS = 5
COUNTS, QUICK_COUNTS = (100_000, 1_250_000), (200, 400)
"""Designs on free and on fixed mounts."""


def study_of(speeds: list[float], variables: dict[str, dict[str, list[float]]]) -> Study:
    """The study with a design table."""
    study = va.load_study(STUDY)
    others = {f"options.{name}": None for name in study.options if name != "none"}
    return study.replace({
        **others,
        "scoring.published_table": None,
        "evidence": None,
        **WEIGHT,
        "operation.speed_rpm": speeds,
        "design": {
            "option": "weight",
            "variables": variables,
            "objectives": {"quiet": {"figure": "level_dba"}},
        },
    })  # fmt: skip


def made_up(study: Study) -> Radiation:
    """Transfer vectors that grow with frequency."""
    frequency = np.arange(25.0, study.radiation.maximum_frequency_hz + 1.0, 25.0)
    size = np.random.default_rng(3).standard_normal((2, len(study.receivers), 6, 1))
    return va.given_radiation(0.01 * (size[0] + 1j * size[1]) * frequency, frequency)


def measured(name: str, study: Study, count: int, by_pipeline: int = PIPELINE_DESIGNS) -> None:
    """Print what so many designs take, by the engine and by the pipeline."""
    radiation = made_up(study)
    begin = time.process_time()
    problem = Problem(study, radiation)
    designs = problem.space.sample("latin-hypercube", count)
    problem.evaluate(designs[:1])
    ready = time.process_time()
    judged = problem.evaluate(designs)
    done = time.process_time()
    print(f"{name}: {count} designs x {len(study.operation.speed_rpm)} speeds")
    print(f"  set up {ready - begin:.1f} s, computed {done - ready:.1f} s,", end=" ")
    cases = count * len(study.operation.speed_rpm)
    print(f"{1e6 * (done - ready) / cases:.2f} µs a design x speed")
    beside_pipeline(problem, study, designs[:by_pipeline], judged.values, radiation)


def beside_pipeline(
    problem: Problem, study: Study, designs: np.ndarray, values: np.ndarray, radiation: Radiation
) -> None:
    """Print what the first of them take through the pipeline, and the largest difference."""
    begin, worst = time.process_time(), 0.0
    for design, (quiet, *_) in zip(designs, values, strict=False):
        results = va.run(study.replace(problem.space.written(design)), radiation=radiation)
        level = results["level_modelled"].sel(option="weight", weighting="A").values
        mean = 10.0 * np.log10(np.mean(10.0 ** (level / 10.0), axis=1))
        worst = max(worst, abs(float(mean.max()) - quiet))
    cases = len(designs) * len(study.operation.speed_rpm)
    took = (time.process_time() - begin) / cases
    print(f"  pipeline {1e3 * took:.1f} ms a design x speed, largest difference {worst:.1e} dB")


if __name__ == "__main__":
    quick = parser(__doc__).parse_args().quick
    speeds = [float(speed) for speed in range(2000, 3600, 1000 if quick else 200)]
    free, fixed = QUICK_COUNTS if quick else COUNTS
    by_pipeline = 1 if quick else PIPELINE_DESIGNS
    measured("free mounts", study_of(speeds, VARIABLES | MOUNTS), free, by_pipeline)
    measured("fixed mounts", study_of(speeds, VARIABLES), fixed, by_pipeline)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
    print(f"largest memory {peak:.2f} GB")
