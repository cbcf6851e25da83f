"""Loudness and audibility of many designs: processor time a spectrum, and a front of four figures.

    OMP_NUM_THREADS=1 python benchmarks/hearing.py [--quick]

Loudness of random spectra alone, then 10⁵ counterweights of the printed Copeland at 7200 rpm and
four microphones, whose 1x line is a tone: level, loudness, audibility and added mass.
"""

import time

import numpy as np
from designs import STUDY, VARIABLES, WEIGHT
from quick import parser

import vibroacoustics as va
from vibroacoustics.design.search.front import nondominated
from vibroacoustics.sound.zwicker import core_loudness, total_loudness

DESIGNS = 100_000
SPECTRA = 20_000
OBJECTIVES = {
    "quiet": {"figure": "level_total_dba"},
    "loudness": {"figure": "loudness_sone"},
    "tone": {"figure": "audibility_db", "receivers": "worst"},
    "mass": {"figure": "added_mass_kg"},
}


def loudness_alone(spectra: int = SPECTRA) -> None:
    """Print the processor time of the loudness of a spectrum."""
    rng = np.random.default_rng(2)
    level_db = 40.0 + np.cumsum(rng.normal(0.0, 4.0, (spectra, 28)), axis=1)
    begin = time.process_time()
    total_loudness(core_loudness(level_db))
    took = (time.process_time() - begin) / spectra
    print(f"loudness of {spectra} spectra: {1e6 * took:.1f} µs a spectrum")


def front(count: int = DESIGNS) -> None:
    """Print what the front takes."""
    study = va.load_study(STUDY)
    study = study.replace({
        **{f"options.{name}": None for name in study.options if name != "none"},
        "scoring.published_table": None,
        "evidence": None,
        **WEIGHT,
        "operation.speed_rpm": [7200.0],
        "design": {"option": "weight", "variables": VARIABLES, "objectives": OBJECTIVES},
    })  # fmt: skip
    hertz = np.arange(25.0, study.radiation.maximum_frequency_hz + 1.0, 25.0)
    parts = np.random.default_rng(3).standard_normal((2, len(study.receivers), 6, 1))
    vectors = 0.002 * (parts[0] + 1j * parts[1]) * hertz
    begin = time.process_time()
    problem = va.Problem(study, va.given_radiation(vectors, hertz))
    designs = problem.space.sample("sobol", count)
    problem.evaluate(designs[:1])
    ready = time.process_time()
    objectives = problem.evaluate(designs).objectives
    judged = time.process_time()
    members = int(nondominated(objectives).sum())
    done = time.process_time()
    spectra = count * len(study.receivers)
    print(f"{count} designs x {len(study.receivers)} microphones: set up {ready - begin:.1f} s,")
    print(
        f"  computed {judged - ready:.1f} s, {1e6 * (judged - ready) / spectra:.1f} µs a spectrum,"
    )
    print(f"  front of {members} designs {done - judged:.1f} s")


if __name__ == "__main__":
    if parser(__doc__).parse_args().quick:
        loudness_alone(200)
        front(64)
    else:
        loudness_alone()
        front()
