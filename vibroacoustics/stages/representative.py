"""The representative sample: one machine for what has a phase, such as sound."""

from collections.abc import Mapping
from dataclasses import dataclass

import xarray as xr

from ..base.arrays import Array
from ..base.progress import no_progress
from ..base.registry import register
from ..levels.lines import line_pressure, noise_levels, with_order_levels
from ..levels.nominal import NominalSound
from ..levels.remainder import remaining
from ..levels.sample_levels import Deviating, with_discrepancy
from ..machine.cases import Cases
from ..machine.machine import Machine
from ..machine.source import CaseKey
from ..study.sampling import Sample
from ..study.study import Study
from ..transfer.contributions import Transmission
from ..transfer.labelled import housing_variables
from ..uncertainty.alternative_sounds import ComputedSamples
from ..uncertainty.evidence import PAIRS, Evidence
from ..uncertainty.prior_ensemble import PriorEnsemble
from ..uncertainty.representative import at_medians, nearest_row
from .chain import Chain
from .forces import PublishedCases, motion_of, with_published
from .sampled import deviating
from .stage import Given, Stage


@dataclass(frozen=True)
class Representative:
    """The weighted sample nearest to the medians of the source levels without an option.

    Attributes
    ----------
    number : in the ensemble
    pair : number of its discrepancy and unmodelled level
    sample : its values by table and field
    machine : with these values
    cases : speeds and options with them
    gain : factors of its discrepancy on the power of sources, of every case, shape (source,
        receiver, gain band)
    """

    number: int
    pair: int
    sample: Sample
    machine: Machine
    cases: Cases
    gain: Mapping[CaseKey, Array]


@register
class RepresentativeSample(Stage):
    """Lines with phase and noise of the representative sample, and its values.

    None with a measured baseline, whose levels the sound has.
    """

    name = "representative"
    reads = (
        Cases, PublishedCases, Transmission, NominalSound, PriorEnsemble, Evidence, ComputedSamples,
        "source_level*", "level_unmodelled*", "level_total", "sample_weight", "sampled_value",
        "order_level", "force_amplitude", "moment_amplitude", "foot_force_amplitude",
    )  # fmt: skip
    gives = (Representative, "representative_*")
    estimates = (
        "pressure_line", "force", "moment", "force_order", "moment_order", "velocity_order",
        "block_velocity_order", "spring_displacement", "foot_force_order", "shaft_speed",
        "shaft_acceleration",
    )  # fmt: skip

    def applies(self, study: Study) -> bool:
        return bool(study.ranges) and study.baseline is None

    def run(self, chain: Chain) -> Given:
        computed, ensemble = chain.get(ComputedSamples), chain[PriorEnsemble]
        if computed is None:
            return Given()
        row = nearest_row(chain.results)
        rows, pair = divmod(row, PAIRS)
        number = computed.numbers[rows]
        sample, _, cases, _ = deviating(with_published(chain), ensemble, number)
        gain = {key: of_case[pair] for key, of_case in sample.gain.items()}
        chosen = Representative(number, pair, ensemble.samples[number], sample.machine, cases, gain)
        lines, noise = _sound(chain, chosen, sample)
        value = chain.results["sampled_value"].isel(sample=row, drop=True)
        variables = noise.merge(value.rename("representative_value").to_dataset())
        return Given(variables, (chosen,), lines.merge(_motion(chain, chosen)))


def _motion(chain: Chain, chosen: Representative) -> xr.Dataset:
    """Forces and motion of the representative sample, at the median amplitudes."""
    study = chain.study.model_copy(update={"machine": chosen.machine})
    motion = motion_of(study, no_progress)[0]
    loads = at_medians(motion, chain.results, ("force_order", "moment_order"))
    motion = loads.assign(housing_variables(study, loads))
    names = [name for name in motion.data_vars if name in RepresentativeSample.estimates]
    return at_medians(motion[names], chain.results, ("foot_force_order",))


def _sound(
    chain: Chain, chosen: Representative, sample: Deviating
) -> tuple[xr.Dataset, xr.Dataset]:
    """Lines of the representative sample with its discrepancy, and its noise."""
    axes = chain[NominalSound].axes
    received = {
        key: with_discrepancy(of_case, chosen.gain[key]) for key, of_case in sample.received.items()
    }
    unmodelled = remaining(chain.study, axes, sample.machine, sample.unmodelled[chosen.pair])
    noise = noise_levels(axes, received, unmodelled).drop_vars(
        ["sources_band_level", "total_band_level"], errors="ignore"
    )
    lines = line_pressure(axes, received, chain.results["line"].values.tolist())
    names = {name: f"representative_{name}" for name in map(str, noise.data_vars)}
    return with_order_levels(lines, chain.results["order_level"]), noise.rename(names)
