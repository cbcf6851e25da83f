"""Sliders: the change of the level where all samples have one value of a parameter."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from ..base.arrays import Array
from ..base.errors import ParameterError, SolverError
from ..base.progress import stage
from ..base.registry import register
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.axes import LevelAxes
from ..levels.nominal import NominalSound
from ..machine.cases import Cases
from ..study.selection import at_speeds
from ..study.study import Study
from ..transfer.contributions import Transmission
from ..uncertainty.alternative_sounds import ComputedSamples
from ..uncertainty.cost import sliders_cost
from ..uncertainty.every_sample import in_every_sample
from ..uncertainty.evidence import Evidence
from ..uncertainty.prior_ensemble import PriorEnsemble
from ..uncertainty.sample_bands import SampleBands
from ..uncertainty.slider_variables import slider_variables
from ..uncertainty.sliders import Compute, Setting, candidates, chosen_sliders, spread_pairs, starts
from .chain import Chain
from .sampled import timed_sounds
from .stage import Given, Stage, Trial

_LEAST_SAMPLES: Final = 8
"""Random samples that a study wants at least, so that two of them are changed."""
_TIMED: Final = 6
"""Number of samples that are timed."""


@register
class Sliders(Stage):
    """Changes of the level by single parameters in the weighted samples."""

    name = "sliders"
    reads = (
        Cases, Transmission, NominalSound, PriorEnsemble, Evidence, ComputedSamples,
        "level_modelled_by_sample", "sample_weight", "sampled_value",
    )  # fmt: skip
    gives = ("slider_*",)

    def applies(self, study: Study) -> bool:
        enough = study.uncertainty.random_samples >= _LEAST_SAMPLES
        return bool(study.ranges) and enough and study.baseline is None and not study.coarsened

    def run(self, chain: Chain) -> Given:
        computed = chain.get(ComputedSamples)
        if computed is None:
            return Given()
        study, ensemble, results = chain.study, chain[PriorEnsemble], chain.results
        ranges = candidates(study.ranges, ensemble.modelled_db, ensemble.samples)
        receiver = list(chain[NominalSound].axes.receivers).index(study.catalogue_receiver)
        chosen = spread_pairs(results, study.uncertainty.random_samples)
        pairs = [(computed.numbers[row], pair) for row, pair in chosen]
        with stage(chain.progress, self.name):
            alone = _computing(chain, pairs, _axes(chain, [REFERENCE_OPTION]))
            sliders = chosen_sliders(ranges, len(pairs), receiver, alone)
            axes, seed = _axes(chain, list(study.options)), study.uncertainty.seed
            every = _computing(chain, pairs, axes)
            begin = starts(sliders, results)
            variables = slider_variables(sliders, begin, len(pairs), seed, every, axes.by_receiver)
        return Given(variables)

    def tried(self, chain: Chain, study: Study) -> Trial:
        cases = chain[Cases]
        alone = cases.some(key for key in cases.cases if key[1] == REFERENCE_OPTION)
        _, alone_s = timed_sounds(chain.having(alone), study, _TIMED)
        _, every_s = timed_sounds(chain, study, _TIMED)
        return Trial(chain, (sliders_cost(study, _TIMED, alone_s, every_s),))


def _axes(chain: Chain, options: Sequence[str]) -> LevelAxes:
    """Axes of some options at the speed nearest to that of the published level."""
    axes, published = chain[NominalSound].axes, chain.study.catalogue_speed_rpm
    speed = min(axes.speeds, key=lambda speed: abs(speed - published))
    return replace(axes, speeds=[speed], options=options)


def _computing(chain: Chain, pairs: Sequence[tuple[int, int]], axes: LevelAxes) -> Compute:
    """Third octaves of weighted samples with other values; `pairs` of sample and discrepancy."""
    options = {name: chain.study.options[name] for name in axes.options}
    study = at_speeds(chain.study, axes.speeds, options)
    cases = chain[Cases].some((speed, name) for speed in axes.speeds for name in options)
    few, ensemble = replace(chain, study=study).having(cases), chain[PriorEnsemble]
    bands = [SampleBands.of_pair(chain[Evidence], ensemble, pair, study, axes) for pair in pairs]

    def of_setting(setting: Setting) -> Array | None:
        number, changed = setting
        try:
            cases = few.at({**ensemble.samples[pairs[number][0]], **changed})[Cases]
            received = few[Transmission].received(cases)
        except (ParameterError, SolverError):
            return None
        machine = cases.cases[axes.speeds[0], REFERENCE_OPTION].machine
        return bands[number].of(received, machine)

    name = f"sliders {pairs} {axes.speeds} {axes.options}"
    return lambda batch: in_every_sample(batch, of_setting, None, lambda _: None, name, chain.study)
