"""Sliders: the change of the level by single parameters of the representative sample."""

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
from ..study.sampling import Sample
from ..study.selection import at_speeds
from ..study.study import Study
from ..transfer.contributions import Transmission
from ..uncertainty.cost import sliders_cost
from ..uncertainty.every_sample import in_every_sample
from ..uncertainty.evidence import Evidence
from ..uncertainty.prior_ensemble import PriorEnsemble
from ..uncertainty.sample_bands import SampleBands
from ..uncertainty.slider_variables import slider_variables
from ..uncertainty.sliders import Compute, candidates, chosen_sliders
from .chain import Chain
from .representative import Representative
from .sampled import timed_sounds
from .stage import Given, Stage, Trial

_TIMED: Final = 6
"""Number of samples that are timed."""


@register
class Sliders(Stage):
    """Changes of the level by single parameters of the representative sample."""

    name = "sliders"
    reads = (Cases, Transmission, NominalSound, PriorEnsemble, Evidence, Representative)
    gives = ("slider_*",)

    def applies(self, study: Study) -> bool:
        return bool(study.ranges) and study.baseline is None and not study.coarsened

    def run(self, chain: Chain) -> Given:
        chosen = chain.get(Representative)
        if chosen is None:
            return Given()
        study, ensemble = chain.study, chain[PriorEnsemble]
        ranges = candidates(study.ranges, ensemble.modelled_db, ensemble.samples)
        receiver = list(chain[NominalSound].axes.receivers).index(study.catalogue_receiver)
        with stage(chain.progress, self.name):
            alone = _computing(chain, chosen, _axes(chain, [REFERENCE_OPTION]))
            sliders = chosen_sliders(ranges, chosen.sample, receiver, alone)
            axes = _axes(chain, list(study.options))
            every = _computing(chain, chosen, axes)
            results = slider_variables(sliders, study.uncertainty.seed, every, axes.by_receiver)
        return Given(results)

    def tried(self, chain: Chain, study: Study) -> Trial:
        cases = chain[Cases]
        alone = cases.some(key for key in cases.cases if key[1] == REFERENCE_OPTION)
        _, alone_s = timed_sounds(chain.having(alone), study, _TIMED)
        _, every_s = timed_sounds(chain, study, _TIMED)
        return Trial(chain, (sliders_cost(_TIMED, alone_s, every_s),))


def _axes(chain: Chain, options: Sequence[str]) -> LevelAxes:
    """Axes of some options at the speed nearest to that of the published level."""
    axes, published = chain[NominalSound].axes, chain.study.catalogue_speed_rpm
    speed = min(axes.speeds, key=lambda speed: abs(speed - published))
    return replace(axes, speeds=[speed], options=options)


def _computing(chain: Chain, chosen: Representative, axes: LevelAxes) -> Compute:
    """Third octaves of the representative sample with other values."""
    nominal, pair = _at_sample(chain, chosen, axes), (chosen.number, chosen.pair)
    bands = SampleBands.of_pair(chain[Evidence], chain[PriorEnsemble], pair, nominal.study, axes)

    def of_sample(changed: Sample) -> Array | None:
        try:
            cases = nominal.at({**chosen.sample, **changed})[Cases]
            received = nominal[Transmission].received(cases)
        except (ParameterError, SolverError):
            return None
        return bands.of(received, cases.cases[axes.speeds[0], REFERENCE_OPTION].machine)

    name = f"sliders {axes.speeds} {axes.options}"
    return lambda batch: in_every_sample(batch, of_sample, None, lambda _: None, name, chain.study)


def _at_sample(chain: Chain, chosen: Representative, axes: LevelAxes) -> Chain:
    """The chain whose nominal values are those of the representative sample."""
    options = {name: chain.study.options[name] for name in axes.options}
    cases = chosen.cases.some((speed, name) for speed in axes.speeds for name in options)
    study = at_speeds(chain.study, axes.speeds, options)
    study = study.model_copy(update={"machine": chosen.machine})
    return replace(chain, study=study).having(cases)
