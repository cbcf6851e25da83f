"""Paths from the loads of every case to the receivers."""

from dataclasses import dataclass

from ..base.registry import register
from ..radiation.pressure import pressure_per_shell_velocity
from ..radiation.transfer_vectors import pressure_per_velocity
from ..study.study import Study
from ..transfer.force_sound import ForceSound
from ..transfer.observers import Observers
from ..transfer.path import ShellPath
from ..transfer.received import Transmission
from .chain import Cases, Chain
from .forces import at_published_speed
from .stage import Given, Stage, Trial, advanced


@dataclass(frozen=True)
class PublishedCases(Cases):
    """The case of the published level, where it is none of the study's; else empty."""


@register
class Paths(Stage):
    """Paths of the sound, with the nominal values."""

    name = "paths"
    reads = (Cases, ShellPath, ForceSound, "transfer_vector", "pattern_transfer_vector")
    gives = (Transmission, PublishedCases)

    def run(self, chain: Chain) -> Given:
        published = _published(chain.study, chain[Cases])
        wrenches = {**published.wrenches, **chain[Cases].wrenches}
        sound, shell = chain.get(ForceSound), chain.get(ShellPath)
        if sound is not None:
            microphones, shell = Observers(sound), None
        else:
            microphones = Observers(
                pressure_per_velocity(chain.results["transfer_vector"]),
                None if shell is None else pressure_per_shell_velocity(chain.results),
            )
        transmission = Transmission(chain.study, microphones, shell, wrenches)
        return Given(products=(transmission, published))

    def tried(self, chain: Chain, study: Study) -> Trial:
        return Trial(advanced(chain, self))


def _published(study: Study, nominal: Cases) -> PublishedCases:
    """Compute the case of the published level under its key, where the study has it not."""
    key = study.catalogue_case
    if key in nominal.cases:
        return PublishedCases({}, {}, {})
    cases = at_published_speed(study).cases
    (case,), (loads,) = cases.cases.values(), cases.loads.values()
    (wrenches,) = cases.wrenches.values()
    return PublishedCases({key: case}, {key: loads}, {key: wrenches})


def with_published(chain: Chain) -> Chain:
    """Return the chain with the case of the published level among its cases."""
    published, nominal = chain[PublishedCases], chain[Cases]
    both = Cases(
        {**published.cases, **nominal.cases},
        {**published.loads, **nominal.loads},
        {**published.wrenches, **nominal.wrenches},
    )
    return chain.having(both)
