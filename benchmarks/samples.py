"""Samples and effective samples a second, and their error against fine settings.

    .venv/bin/python benchmarks/samples.py [number of samples] [--quick]

The transfer vectors are read from the cache: run the study before. Fine settings have steps of
contact a fifth as long, four times the steps of leakage, and repeat ten times as closely.
"""

import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
from quick import ROOT, parser
from scipy.special import logsumexp

import vibroacoustics as va
from vibroacoustics.base.threads import processors
from vibroacoustics.levels.agreement import effective_samples
from vibroacoustics.levels.nominal import NominalSound
from vibroacoustics.machine.cases import Cases
from vibroacoustics.radiation.given import Radiation
from vibroacoustics.sources.oldham_keys import rattle
from vibroacoustics.sources.scroll_gas import leakage
from vibroacoustics.stages.chain import Chain
from vibroacoustics.stages.forces import with_published
from vibroacoustics.stages.radiation import transfer_vectors
from vibroacoustics.stages.sampled import sounds_of
from vibroacoustics.stages.stage import advanced, applying
from vibroacoustics.study.samples import batches_of_samples, with_sample
from vibroacoustics.transfer.contributions import Transmission
from vibroacoustics.uncertainty.evidence import Evidence

STUDY = ROOT / "pipelines" / "copeland_sources.toml"
QUICK_COUNT = 4
FINE = (
    (rattle, "LOADED_STEP_RATIO", lambda value: value / 5.0),
    (rattle, "REPEATED", lambda value: value / 10.0),
    (leakage, "STEPS", lambda value: 4 * value),
)
OTHER_START = ((rattle, "SETTLING_REVOLUTIONS", lambda value: value + 3),)
"""Impacts that are kept are then others of the same motion."""


def main(count: int, quick: bool) -> None:
    """Print the rates at the published level and for all cases, and differences of levels."""
    if quick:
        from sources_study import SOURCES_STUDY, made_up_modes

        study, count = va.load_study(SOURCES_STUDY), QUICK_COUNT
        others = {f"options.{name}": None for name in study.options if name != "none"}
        study = study.replace({**others, "operation.stopping": False})
        chain = chain_of(study, lambda study, *_: (made_up_modes(study), False))
    else:
        study = va.load_study(STUDY)
        chain = chain_of(study, transfer_vectors)
    samples = next(batches_of_samples(study))[:count]
    print(f"{processors()} processors, {count} samples at the published level, {count // 4} of all")
    published = at_published(chain)
    seconds, levels, processor_s = timed(published, samples)
    print(f"at the published level: {count / seconds:.1f} samples a second, ", end="")
    print(f"{1e3 * processor_s / count:.0f} ms of processor time each")
    share = effective_share(published, samples)
    print(f"  effective: {share * count / seconds:.1f} a second, {100.0 * share:.0f} % of them")
    some = samples[: count // 4]
    seconds, all_levels, processor_s = timed(chain, some)
    print(f"all cases: {len(some) / seconds:.2f} samples a second, ", end="")
    print(f"{1e3 * processor_s / len(some):.0f} ms of processor time each")
    with changed(*FINE):
        fine, all_fine = levels_of(published, samples), levels_of(chain, some)
    print_differences(
        "from fine settings, published level", levels - fine, lost(published, samples)
    )
    impacts = lost(chain, some)
    print_differences("from fine settings, all cases", all_levels - all_fine, impacts)
    with changed(*OTHER_START):
        other = levels_of(chain, some)
    print_differences("own scatter, all cases", all_levels - other, impacts)


def chain_of(study: va.Study, radiation: Radiation) -> Chain:
    """All stages before the samples, at the receiver of the published level."""
    chain = Chain(study, radiation)
    for stage in applying(study):
        chain = advanced(chain, stage)
        if stage.name == "levels":
            break
    return with_published(chain)


def at_published(chain: Chain) -> Chain:
    """The chain at the published level alone, as samples are weighted."""
    nominal = chain[NominalSound].weighing()
    rows = [chain[NominalSound].axes.receivers.index(name) for name in nominal.axes.receivers]
    return chain.having(chain[Cases].some(nominal.sound), chain[Transmission].to(rows), nominal)


def timed(chain: Chain, samples: list) -> tuple[float, np.ndarray, float]:
    """Seconds, levels and processor time of samples, those of workers too."""
    start, before = time.perf_counter(), sum(os.times()[:4])
    levels = levels_of(chain, samples)
    return time.perf_counter() - start, levels, sum(os.times()[:4]) - before


def levels_of(chain: Chain, samples: list) -> np.ndarray:
    """A-weighted levels of all sources, shape (sample, case), dB."""
    receiver = chain[NominalSound].axes.receivers.index(chain.study.catalogue_receiver)
    sounds = sounds_of(chain, samples, lambda _: None)
    square = [[each.total[0, receiver] for each in sound.values()] for sound in sounds]
    return 10.0 * np.log10(np.array(square) / 4e-10)


def lost(chain: Chain, samples: list) -> np.ndarray:
    """Whether a key loses contact, shape (sample, case)."""
    return np.array(
        [
            [has_impacts(loads) for loads in chain.at(sample)[Cases].loads.values()]
            for sample in samples
        ]
    )


def has_impacts(loads: dict[str, va.Loads]) -> bool:
    """Whether any ring's keys meet a face anew."""
    figures = loads["keys"].figures.items()
    return any(value > 0.0 for name, value in figures if name.endswith("impacts_per_revolution"))


def effective_share(chain: Chain, samples: list) -> float:
    """Effective over all samples, with the published level and the first prior."""
    evidence = Evidence(chain[NominalSound])
    published = evidence.published._replace(priors=evidence.published.priors[:1])
    sounds = sounds_of(chain, samples, lambda _: None)
    machine = chain.study.machine
    weights = [
        logsumexp(
            evidence.log_weights(sound, with_sample(machine, machine, sample), number, published)
        )
        for number, (sound, sample) in enumerate(zip(sounds, samples, strict=True))
    ]
    return effective_samples(np.exp(np.array(weights) - max(weights))) / len(samples)


def print_differences(name: str, difference_db: np.ndarray, impacts: np.ndarray) -> None:
    """Root mean squares and the largest, without and with impacts."""
    for words, chosen in (("no key loses contact", ~impacts), ("impacts", impacts)):
        values = difference_db[chosen & np.isfinite(difference_db)]
        if values.size:
            rms, most = np.sqrt(np.mean(values**2)), np.abs(values).max()
            print(f"{name}, {words}: {values.size} levels, rms {rms:.4f} dB, largest {most:.3f} dB")


@contextmanager
def changed(*constants: tuple[object, str, Callable]) -> Iterator[None]:
    """Constants of modules with other values."""
    before = [getattr(module, name) for module, name, _ in constants]
    for (module, name, change), value in zip(constants, before, strict=True):
        setattr(module, name, change(value))
    try:
        yield
    finally:
        for (module, name, _), value in zip(constants, before, strict=True):
            setattr(module, name, value)


if __name__ == "__main__":
    options = parser(__doc__)
    options.add_argument("count", type=int, nargs="?", default=100)
    chosen = options.parse_args()
    main(chosen.count, chosen.quick)
