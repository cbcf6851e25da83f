"""Paths from the loads of every case to the receivers."""

from ..base.registry import register
from ..radiation.pressure import pressure_per_shell_velocity
from ..radiation.transfer_vectors import pressure_per_velocity
from ..study.study import Study
from ..transfer.force_sound import ForceSound
from ..transfer.observers import Observers
from ..transfer.path import ShellPath
from ..transfer.received import Transmission
from .chain import Chain
from .stage import Given, Stage, Trial, advanced


@register
class Paths(Stage):
    """Paths of the sound, with the nominal values."""

    name = "paths"
    reads = (ShellPath, ForceSound, "transfer_vector", "pattern_transfer_vector")
    gives = (Transmission,)

    def run(self, chain: Chain) -> Given:
        results, measured, shell = chain.results, chain.get(ForceSound), chain.get(ShellPath)
        rigid = measured or pressure_per_velocity(results["transfer_vector"])
        modes = None if shell is None else pressure_per_shell_velocity(results)
        return Given(products=(Transmission(chain.study, Observers(rigid, modes), shell),))

    def tried(self, chain: Chain, study: Study) -> Trial:
        return Trial(advanced(chain, self))
