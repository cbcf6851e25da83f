"""Paths from the loads of every case to the receivers."""

from collections.abc import Mapping
from dataclasses import dataclass

import xarray as xr

from ..base.registry import register
from ..machine.source import CaseKey
from ..radiation.pressure import pressure_per_shell_velocity, wrench_pressure
from ..radiation.transfer_vectors import pressure_per_velocity
from ..study.study import Study
from ..transfer.force_sound import ForceSound
from ..transfer.path import ShellPath
from ..transfer.received import (
    BySource,
    Transmission,
    by_case_and_source,
    wrench_pressure_by_motion,
)
from .chain import Cases, Chain
from .forces import Motion, at_published_speed
from .stage import Given, Stage, Trial, advanced


@dataclass(frozen=True)
class PublishedCases(Cases):
    """The case of the published level, where it is none of the study's; else empty."""


@register
class Paths(Stage):
    """Paths of the sound, with the nominal values."""

    name = "paths"
    reads = (Cases, ShellPath, ForceSound, "velocity_order", "transfer_vector")
    gives = (Transmission, PublishedCases)

    def run(self, chain: Chain) -> Given:
        study, nominal = chain.study, Motion(chain.results, chain[Cases])
        published = _published(study, nominal)
        sound = chain.get(ForceSound)
        if sound is not None:
            pressure = {**_measured(published, sound), **_measured(nominal, sound)}
            transmission = Transmission(study, sound, None, None, pressure)
        else:
            shell, vectors = chain.get(ShellPath), chain.results["transfer_vector"]
            transmission = Transmission(
                study,
                pressure_per_velocity(vectors),
                None if shell is None else pressure_per_shell_velocity(chain.results),
                shell,
                {**_computed(published, vectors), **_computed(nominal, vectors)},
            )
        cases = published.cases
        kept = PublishedCases(cases.cases, cases.loads, cases.source_of_wrench)
        return Given(products=(transmission, kept))

    def tried(self, chain: Chain, study: Study) -> Trial:
        return Trial(advanced(chain, self))


def _published(study: Study, nominal: Motion) -> Motion:
    """Compute the case of the published level under its key, where the study has it not."""
    key = study.catalogue_case
    if key in nominal.cases.cases:
        return Motion(nominal.results, Cases({}, {}, nominal.cases.source_of_wrench))
    motion = at_published_speed(study)
    (case,), (loads,) = motion.cases.cases.values(), motion.cases.loads.values()
    cases = Cases({key: case}, {key: loads}, motion.cases.source_of_wrench)
    return Motion(motion.results, cases)


def _measured(motion: Motion, sound: ForceSound) -> dict[CaseKey, BySource]:
    of = motion.cases
    by_motion = wrench_pressure_by_motion(motion.results, of.cases, of.source_of_wrench, sound)
    return {
        key: {source: values.sum(axis=1) for source, values in by_source.items()}
        for key, by_source in by_motion.items()
    }


def _computed(motion: Motion, vectors: xr.DataArray) -> Mapping[CaseKey, BySource]:
    """Pressure of the wrenches of every case; that of the published level keeps its own key."""
    of = motion.cases
    if not of.cases:
        return {}
    results = motion.results.assign(transfer_vector=vectors)
    pressure = wrench_pressure(results, "transfer_vector")
    by_case = by_case_and_source(pressure, of.source_of_wrench)
    return dict(zip(of.cases, by_case.values(), strict=True))


def with_published(chain: Chain) -> Chain:
    """Return the chain with the case of the published level among its cases."""
    published, nominal = chain[PublishedCases], chain[Cases]
    both = Cases(
        {**published.cases, **nominal.cases},
        {**published.loads, **nominal.loads},
        nominal.source_of_wrench,
    )
    return chain.having(both)
