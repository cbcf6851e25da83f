"""What a machine's own third octaves settle: 80 % intervals shrink, and hold the truth.

Level and third octaves of each synthetic machine are its own with noise of 2 dB. Weights come from
a second implementation, which is compared with the package's.
"""

from types import SimpleNamespace

import numpy as np
import pytest
from measured_spectra import (
    GRID_DB,
    MIDDLE_HZ,
    QUANTITIES,
    Inference,
    Machines,
    in_db,
    measured_columns,
    settled,
)
from sampled_chain import SampledChain
from sources_study import SOURCES_STUDY
from support import ROOT
from test_coverage import SPREAD_DB, made_up_sounds

from vibroacoustics.levels.agreement import LEVELS_DB, Prior, log_likelihood, log_weights
from vibroacoustics.levels.by_source import GAIN_BANDS
from vibroacoustics.levels.declared_level import published_of
from vibroacoustics.levels.remainder import unmodelled_bands
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.samples import with_sample
from vibroacoustics.uncertainty.discrepancy import Discrepancy
from vibroacoustics.uncertainty.evidence import with_gain

GAS = QUANTITIES.index("gas share")
LARGEST_RATIO = 0.6
COVERAGE = (0.75, 0.90)
NO_DEVIATION = {f"{name}_deviation_db": 0.0 for name in ("path", "source", "band", "added")}


class Worlds:
    """Discrepancies of true machines."""

    def __init__(self, settings, count):
        self.settings, self.count = settings, count

    def expected(self, number):
        """The discrepancies of the inference."""
        return Discrepancy.of(self.settings, self.count, number, True)

    def sampled(self, number):
        """One that the inference expects and does not have itself."""
        return self.expected(100_000 + number).some(np.array([0]))

    def scaled(self, gain_db):
        """Gains by source number, unmodelled noise with its bands."""

        def of_number(number):
            gain = np.ones((1, self.count, len(GAIN_BANDS)))
            for source, level_db in gain_db.items():
                gain[:, source] *= 10.0 ** (level_db / 10.0)
            return Discrepancy(gain, np.ones(1), self.sampled(number).unmodelled)

        return of_number


def made_up(count):
    """Mutual energies and unmodelled noise of made-up machines, and worlds of these."""
    rng, keys = np.random.default_rng(7), [(2900.0, "none")]
    sounds = made_up_sounds(keys, rng, count)
    mutual = np.array([sound[keys[0]].mutual[:, :, 0] for sound in sounds]) * 4e-10
    octaves = np.abs(np.log2(MIDDLE_HZ / 1600.0))
    noise = 10.0 ** (-rng.uniform(0.3, 0.6, (count, 1)) * octaves)
    noise *= 4e-10 / noise.sum(axis=1, keepdims=True)
    return mutual, noise, Worlds(load_study(SOURCES_STUDY).uncertainty, len(SPREAD_DB))


def within(share, count):
    """Whether a coverage is in `COVERAGE`, with three deviations of a binomial count."""
    spread = 3.0 * np.sqrt(0.8 * 0.2 / count)
    return COVERAGE[0] - spread <= share <= COVERAGE[1] + spread


def test_a_spectrum_settles_the_gas_share_of_made_up_machines():
    """One hundred machines, each inferred without its own sample, with discrepancy."""
    mutual, noise, worlds = made_up(100)
    sources, rng = list(SPREAD_DB), np.random.default_rng(8)
    inference = Inference(Machines.of(sources, mutual, noise, worlds.expected), measured_columns())
    truths = Machines.of(sources, mutual, noise, worlds.sampled)
    inside, widths, ratio, effective = settled(inference, truths, rng, leave_out=True)
    print(QUANTITIES, inside.round(2), widths.round(3), ratio.round(2), effective.round(1))
    assert ratio[GAS] <= LARGEST_RATIO
    assert within(inside[1, GAS], 100), inside


def test_weights_are_those_of_the_package():
    """With the same sample and data, for every discrepancy and unmodelled level."""
    study = load_study(SOURCES_STUDY)
    mutual, noise, worlds = made_up(3)
    number, columns = 1, measured_columns()
    third_db = in_db(np.random.default_rng(1).uniform(1.0, 9.0, len(GAIN_BANDS)) * 4e-5)
    band_hz = [GAIN_BANDS[column].nominal_hz for column in columns.tolist()]
    spectrum = SimpleNamespace(
        microphone="front_1m", speed_rpm=2900.0, operating_point=None, deviation_db=2.0,
        band_hz=tuple(band_hz), level_dba=tuple(third_db[columns].tolist()),
    )  # fmt: skip
    spectrum.within = lambda _: spectrum
    study = study.model_copy(update={"evidence": SimpleNamespace(spectrum=spectrum)})
    published = published_of(study)
    flat = Prior("flat", "", lambda level: np.where(np.isin(level, GRID_DB), 1.0, 0.0))
    of_sample = worlds.expected(number)
    modelled = with_gain(mutual[number], of_sample.gain)
    unmodelled = of_sample.unmodelled * noise[number]
    found = log_weights(modelled, unmodelled, published.data[:1], flat)
    found = found + log_likelihood(modelled, unmodelled, published.spectrum.data)
    machines = Machines.of(list(SPREAD_DB), mutual, noise, worlds.expected)
    log_weight = Inference(machines, columns).log_weights(published.level_dba, third_db)[number]
    found = found[:, np.isin(LEVELS_DB, GRID_DB)]
    expected = log_weight - log_weight.max()  # in single precision
    np.testing.assert_allclose(found - found.max(), expected, rtol=1e-4, atol=1e-3)


@pytest.mark.long
@pytest.mark.filterwarnings("ignore:.* have no solution:UserWarning")
def test_a_spectrum_settles_the_gas_share_of_the_inner_sources():
    """Two hundred fresh machines a row, with gas, keys and motor at the published point."""
    study = load_study(ROOT / "pipelines" / "copeland_sources.toml")
    others = {f"options.{name}": None for name in study.options if name != "none"}
    chain = SampledChain.of(study.replace({**others, "operation.stopping": False}))
    sources, settings = list(chain.axes.sources), chain.study.uncertainty
    worlds, gas = Worlds(settings, len(sources)), sources.index("gas")
    prior, fresh = (bands_of(chain, *which) for which in ((1000, 6), (200, 11)))
    scale_db = np.median(in_db(prior[0].sum(axis=(1, 2, 3))))
    relative = [
        (mutual, noise * 10.0 ** ((scale_db - 56.0) / 10.0)) for mutual, noise in (prior, fresh)
    ]
    every = dict.fromkeys(range(len(sources)), -8.0)
    rows = {
        "from the model": worlds.scaled({}),
        "with discrepancy": worlds.sampled,
        "gas -10 dB": worlds.scaled({gas: -10.0}),
        "all -8 dB": worlds.scaled(every),
    }
    inference = Inference(Machines.of(sources, *relative[0], worlds.expected), measured_columns())
    found = {}
    for name, world in rows.items():
        truths = Machines.of(sources, *relative[1], world)
        found[name] = settled(inference, truths, np.random.default_rng(4))
        print(name, len(truths.gas), *(part.round(2).tolist() for part in found[name]))
    without = Worlds(settings.model_copy(update=NO_DEVIATION), len(sources))
    inference = Inference(
        Machines.of(sources, *relative[0], lambda n: without.expected(n).some(np.array([0]))),
        measured_columns(),
    )
    truths = Machines.of(sources, *relative[1], without.sampled)
    zero = settled(inference, truths, np.random.default_rng(4))
    print("no discrepancy", *(part.round(2).tolist() for part in zero))
    for name, (inside, _, ratio, _) in found.items():
        assert ratio[GAS] <= LARGEST_RATIO, name
        assert within(inside[1, GAS], 200), (name, inside)


def bands_of(chain, count, seed):
    """Mutual energies and unmodelled noise of samples that have a solution, Pa²."""
    study, samples = chain.study, chain.hypercube(count, seed)
    mutual = np.array(
        [
            sound[study.catalogue_case].mutual[:, :, 0]
            for sound in chain._sounds(samples, [study.catalogue_case])
        ]
    )
    noise = np.array(
        [
            unmodelled_bands(study, with_sample(study.machine, study.machine, sample))
            for sample in samples
        ]
    )
    solved = np.isfinite(mutual).all(axis=(1, 2, 3))
    return mutual[solved], noise[solved]
