"""Samples depend neither on the number of processes nor on the other options of a study."""

import os
import subprocess
import sys
import textwrap
from functools import cache

import numpy as np
import pytest
from sampled_chain import SampledChain
from sources_study import SOURCES_STUDY, made_up_modes
from support import ROOT

from vibroacoustics.base.vocabulary import REFERENCE_OPTION
from vibroacoustics.study.loading import load_study

SAMPLES = 4
SCRIPT = """
    import hashlib, os, sys
    import vibroacoustics.base.processes as processes
    from vibroacoustics.base.worker_process import can_fork
    from sampled_chain import SampledChain
    from sources_study import SOURCES_STUDY, made_up_modes
    from vibroacoustics.study.loading import load_study
    processes.processors = lambda: int(sys.argv[1])
    chain = SampledChain.of(load_study(SOURCES_STUDY), lambda one, *_: (made_up_modes(one), False))
    assert can_fork()
    forked = []
    fork = os.fork
    os.fork = lambda: forked.append(1) or fork()
    digest = hashlib.sha256()
    for sound in chain.sounds(chain.hypercube(4)):
        for one in sound.values():
            digest.update(one.mutual.tobytes() + one.part.tobytes() + one.band.tobytes())
    print(digest.hexdigest(), len(forked))
"""


def digest_with(processes: int) -> list[str]:
    """Hash of all sounds, and the number of copies that computed them."""
    folders = (str(ROOT), str(ROOT / "tests" / "helpers"))
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(SCRIPT), str(processes)],
        capture_output=True, text=True, check=True, timeout=300,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(folders)},
    )  # fmt: skip
    return done.stdout.split()


@pytest.mark.skipif(sys.platform != "linux", reason="processes are copied on Linux alone")
def test_samples_are_bit_equal_for_any_number_of_processes():
    alone, two, three = (digest_with(number) for number in (1, 2, 3))
    assert alone[0] == two[0] == three[0]
    assert [alone[1], two[1], three[1]] == ["0", "2", "3"]


@cache
def chain_with(*names: str) -> SampledChain:
    """The study with some of its options alone."""
    study = load_study(SOURCES_STUDY)
    options = {name: one for name, one in study.options.items() if not names or name in names}
    study = study.model_copy(update={"options": options})
    return SampledChain.of(study, lambda one, *_: (made_up_modes(one), False))


@pytest.mark.parametrize("name", list(load_study(SOURCES_STUDY).options))
def test_an_option_alone_sounds_as_among_all(name):
    samples = chain_with().hypercube(SAMPLES)
    among, alone = chain_with().sounds(samples), chain_with(REFERENCE_OPTION, name).sounds(samples)
    for all_cases, few in zip(among, alone, strict=True):
        for key, sound in few.items():
            for part in ("mutual", "part", "band", "alone"):
                expected = getattr(all_cases[key], part)
                np.testing.assert_allclose(
                    getattr(sound, part), expected, rtol=1e-9, atol=1e-12 * np.abs(expected).max()
                )
