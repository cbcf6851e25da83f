"""Level, shares and changes with one input changed, beside ensembles made with that input."""

from dataclasses import dataclass

import numpy as np
import pytest
from sampled_chain import of_few_ranges
from sources_study import NO_DISCREPANCY, SOURCES_STUDY
from test_sample_evidence import sound_at

from vibroacoustics.base.quantiles import weighted_quantiles
from vibroacoustics.base.vocabulary import REFERENCE_OPTION
from vibroacoustics.levels.agreement import LEVELS_DB
from vibroacoustics.levels.axes import LevelAxes
from vibroacoustics.levels.by_source import GAIN_BANDS, gain_band_number
from vibroacoustics.levels.nominal import NominalSound
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.regimes import density_ratios
from vibroacoustics.study.sampling import latin_hypercubes
from vibroacoustics.uncertainty.alternative_sounds import ComputedSamples, modelled_energy
from vibroacoustics.uncertainty.alternative_variables import alternative_variables
from vibroacoustics.uncertainty.alternatives import alternatives_of
from vibroacoustics.uncertainty.discrepancy import Discrepancy
from vibroacoustics.uncertainty.evidence import Evidence
from vibroacoustics.uncertainty.prior_ensemble import PriorEnsemble, Weighted

SQUARE = 4e-10 * 10.0**5.6
LOW, HIGH = (int(gain_band_number(np.array(hertz))) for hertz in (500.0, 2000.0))
SECOND = "second"
STARVED = "keys starved of oil, layer up to 10 µm"
FULL = "slots full of oil, layer from 20 µm"


def study_of(**changes):
    """A study of two options whose only unknown is the oil layer on the keys."""
    study = of_few_ranges(load_study(SOURCES_STUDY), {"keys.oil_layer_m"})
    options = {REFERENCE_OPTION: study.options[REFERENCE_OPTION]}
    options[SECOND] = options[REFERENCE_OPTION]
    study = study.model_copy(update={"options": options})
    settings = study.uncertainty.model_copy(update={"random_samples": 200, **changes})
    return study.model_copy(update={"uncertainty": settings})


def energies(sample):
    """Energies of gas and keys, and what the second option adds to the keys: less with oil."""
    micron = sample["keys", "oil_layer_m"] * 1e6
    return 0.3 * SQUARE, 1.5 * SQUARE / micron, 3.0 * SQUARE / micron


@dataclass
class Run:
    """The prior ensemble of a study, all of whose samples are computed with all options."""

    study: object

    def __post_init__(self):
        self.samples = next(latin_hypercubes(self.study.ranges, self.study.uncertainty))
        study, speed = self.study, self.study.catalogue_speed_rpm
        axes = LevelAxes(
            [speed], list(study.options), ["gas", "keys"], [study.catalogue_receiver], ()
        )
        self.evidence = Evidence(NominalSound(study, axes, {}, {}))
        sounds = [
            {study.catalogue_case: sound_at(*energies(sample)[:2])} for sample in self.samples
        ]
        machines = [study.machine] * len(sounds)
        log_weight = [
            np.logaddexp.reduce(
                self.evidence.log_weights(sound, study.machine, n, self.evidence.published),
                axis=(1, 2),
            )
            for n, sound in enumerate(sounds)
        ]
        batch = Weighted(sounds, machines, np.zeros(len(sounds)), np.array(log_weight).T)
        self.ensemble = PriorEnsemble(self.samples, batch, len(sounds))

    def alternatives(self, before=None, wanted=None):
        """Variables by reweighting the samples that go on."""
        before = np.ones(len(self.samples)) if before is None else before
        numbers, counts = self.ensemble.chosen(1)
        mutual = [self._mutual(energies(self.samples[number])) for number in numbers]
        force = [np.array([[10.0, 5.0]])] * len(numbers)
        computed = ComputedSamples(
            tuple(numbers.tolist()), tuple(counts.tolist()), tuple(mutual), tuple(force)
        )
        return alternative_variables(self.evidence, self.ensemble, before, computed)

    @staticmethod
    def _mutual(of_sample):
        gas, keys, added = of_sample
        both = [sound_at(gas, keys).mutual, sound_at(gas, keys, added).mutual]
        return np.stack(both)[None, :, :, :, 0]

    def every_cell(self, published=None, discrepancy=True):
        """Mean share of the gas, medians of level and change over all cells, without pairs.

        Sums over samples, discrepancies and levels of unmodelled noise, written out anew.
        """
        published = published or self.evidence.published
        noise = self.evidence.unmodelled(self.study.machine)
        density = np.exp(published.priors[0].log_density)
        weight, share, level, change = [], [], [], []
        for number, sample in enumerate(self.samples):
            gas, keys, added = energies(sample)
            of_sample = Discrepancy.of(self.study.uncertainty, 2, number)
            loud_gas, loud_keys = of_sample.gain[:, 0, LOW] * gas, of_sample.gain[:, 1, HIGH] * keys
            more = of_sample.gain[:, 1, HIGH] * of_sample.added * added
            rest = 10.0 ** (LEVELS_DB / 10.0)[None, :, None] * noise
            bands = np.zeros((len(gas * of_sample.added), LEVELS_DB.size, len(GAIN_BANDS))) + rest
            bands[:, :, LOW] += loud_gas[:, None]
            bands[:, :, HIGH] += loud_keys[:, None]
            likelihood = sum(datum.log_likelihood(bands) for datum in published.data)
            total = bands.sum(axis=2)
            weight.append(density * np.exp(likelihood))
            share.append(loud_gas[:, None] / total)
            level.append(10.0 * np.log10(total / 4e-10))
            change.append(10.0 * np.log10(1.0 + more[:, None] / total))
        weight = np.ravel(weight)
        medians = [
            weighted_quantiles(np.ravel(each), weight, (0.1, 0.5, 0.9)) for each in (level, change)
        ]
        return np.average(np.ravel(share), weights=weight), *medians


@pytest.fixture(scope="module")
def run():
    return Run(study_of())


@pytest.fixture(scope="module")
def variables(run):
    return run.alternatives()


def compared(row, run, published=None):
    """A reweighted row beside a full run, in standard errors of both (of 200 samples or less)."""
    share, level, change = run.every_cell(published)
    sizes = [float(row[f"alternative_{name}effective"]) for name in ("", "change_")]
    error = np.sqrt(1.0 / sizes[0] + 1.0 / run.ensemble.effective)
    of_changes = np.sqrt(1.0 / sizes[1] + 1.0 / run.ensemble.effective)
    width = np.diff(level[[0, 2]]).item(), np.diff(change[[0, 2]]).item()
    of_share = row["alternative_share"].sel(energy_part="gas")
    off_level = row["alternative_level"].item() - level[1]
    of_second = row["alternative_change"].sel(alternative_quantity="level_total", option=SECOND)
    off_change = of_second.item() - change[1]
    # A median has 0.489 of the width of the interval between 10 and 90 % as its error; a share
    # from 0 to 1 has a deviation below 0.5.
    return np.array(
        [
            (of_share.item() - share) / (0.5 * error),
            off_level / (0.489 * width[0] * error),
            off_change / (0.489 * width[1] * of_changes),
        ]
    )


def narrowed(run, name):
    """The study of an alternative, run with samples of its own."""
    study = next(one.study for one in alternatives_of(run.study) if one.name == name)
    settings = study.uncertainty.model_copy(update={"seed": 11})
    return Run(study.model_copy(update={"uncertainty": settings}))


@pytest.mark.parametrize("name", [STARVED, FULL])
def test_a_regime_is_that_of_a_full_run_with_its_range(run, variables, name):
    row = variables.sel(alternative=name)
    full = narrowed(run, name)
    off = np.abs(compared(row, full)).max()
    assert off < 3.0
    other = FULL if name == STARVED else STARVED
    assert np.abs(compared(variables.sel(alternative=other), full)).max() > off + 1.5


@pytest.mark.parametrize("name", ["level alone", "other prior", "no discrepancy"])
def test_other_evidence_is_that_of_a_full_run_with_it(run, variables, name):
    """Data left out, the second prior of unmodelled noise, and no discrepancy."""
    row = variables.sel(alternative=name)
    (alternative,) = (one for one in alternatives_of(run.study) if one.name == name)
    assert np.abs(compared(row, narrowed(run, name), alternative.published)).max() < 3.0


def test_the_level_left_out_is_a_datum_of_any_deviation(run, variables):
    row = variables.sel(alternative="without the level")
    published = run.evidence.published
    share, level, _ = run.every_cell(published._replace(data=published.data[1:]))
    error = 1.0 / np.sqrt(row["alternative_effective"].item())
    assert row["alternative_share"].sel(energy_part="gas").item() == pytest.approx(
        share, abs=1.5 * error
    )
    assert row["alternative_level"].item() == pytest.approx(level[1], abs=3.0 * error * 10.0)
    width, with_level = np.diff(level[[0, 2]]), np.diff(run.every_cell()[1][[0, 2]])
    assert width > 2.0 * with_level


def test_names_and_order_of_the_alternatives(run):
    names = [alternative.name for alternative in alternatives_of(run.study)]
    assert names == [
        "level alone", "without the level", "no discrepancy",
        "keys nearly dry, oil layer up to 2 µm", STARVED, FULL,
        "other prior",
    ]  # fmt: skip
    exact = study_of(**{name.partition(".")[2]: value for name, value in NO_DISCREPANCY.items()})
    assert "no discrepancy" not in [one.name for one in alternatives_of(exact)]
    noise = run.study.machine.overall_noise.model_copy(update={"spectral_share": None})
    machine = run.study.machine.model_copy(update={"overall_noise": noise})
    less = run.study.model_copy(update={"machine": machine})
    assert "level alone" not in [one.name for one in alternatives_of(less)]


def test_shares_add_up_and_intervals_hold_their_values(variables):
    share = variables["alternative_share"].values
    np.testing.assert_allclose(share.sum(axis=1), 1.0)
    for name in ("level", "share", "change"):
        low, value, high = (
            variables[f"alternative_{name}{end}"] for end in ("_10_percent", "", "_90_percent")
        )
        assert (low <= value + 1e-12).all()
        assert (value <= high + 1e-12).all()


def test_forces_change_as_the_samples_and_are_measurable(variables):
    force = variables.sel(alternative_quantity="foot_force", option=SECOND)
    np.testing.assert_allclose(force["alternative_change"], 20.0 * np.log10(0.5))
    np.testing.assert_allclose(force["alternative_decrease"], 1.0)
    np.testing.assert_allclose(force["alternative_increase"], 0.0)
    total = variables.sel(alternative_quantity="level_total", option=SECOND)
    chance = total["alternative_increase"].squeeze("speed")
    dry, full = (chance.sel(alternative=name).item() for name in (STARVED, FULL))
    assert dry > full + 0.2


def test_weights_before_the_data_count(run):
    """Samples without weight before the data have none with any alternative."""
    micron = np.array([sample["keys", "oil_layer_m"] for sample in run.samples]) * 1e6
    thick = run.alternatives(before=(micron > 10.0).astype(float))
    size = thick["alternative_effective"].sel(alternative=STARVED)
    assert size.item() == 0.0
    assert np.isnan(thick["alternative_level"].sel(alternative=STARVED))
    assert thick["alternative_effective"].sel(alternative="level alone").item() > 10.0


def test_ratios_of_densities_are_those_of_the_samples():
    """A narrow range is sampled evenly, a wide one evenly over its logarithm."""
    study = study_of()
    (limits,) = study.ranges
    narrow = limits.model_copy(update={"lowest": 1e-6, "highest": 2e-6})
    key = (limits.table, limits.field)
    samples = [{key: value} for value in (0.9e-6, 1e-6, 2e-6, 2.1e-6)]
    ratio = density_ratios((limits,), (narrow,), samples)
    assert ratio[[0, 3]].tolist() == [0.0, 0.0]
    assert ratio[1:3] == pytest.approx(np.log(200.0) * np.array([1.0, 2.0]))
    hypercube = next(latin_hypercubes((limits,), study.uncertainty))
    assert density_ratios((limits,), (narrow,), hypercube).mean() == pytest.approx(1.0, abs=0.05)
    whole = narrow.model_copy(update={"integer": True, "lowest": 1.0, "highest": 4.0})
    fewer = whole.model_copy(update={"highest": 2.0})
    assert density_ratios((whole,), (fewer,), [{key: 2}, {key: 3}]).tolist() == [2.0, 0.0]


def test_energy_with_discrepancies_is_that_of_each_source_with_its_gain():
    """What an option adds deviates besides; interference scales as pressures."""
    mutual = np.zeros((1, 2, 2, 2, len(GAIN_BANDS)))
    mutual[0, :, 0, 0, LOW], mutual[0, :, 1, 1, LOW] = 4.0, [1.0, 3.0]
    mutual[0, :, 0, 1, LOW] = mutual[0, :, 1, 0, LOW] = -0.5
    gain = np.full((1, 2, len(GAIN_BANDS)), 4.0)
    gain[:, 1] = 9.0
    even = np.ones((1, len(GAIN_BANDS)))
    energy = modelled_energy(Discrepancy(gain, np.array([2.0]), even), mutual, 0)
    factor = 9.0 * (1.0 + 1.0 * 2.0 / 3.0)  # two of three are added, twice as loud
    expected = [16.0 + 9.0 - 2.0 * 0.5 * 6.0, 16.0 + 3.0 * factor - np.sqrt(4.0 * factor)]
    np.testing.assert_allclose(energy[0, 0], expected)
