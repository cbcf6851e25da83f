"""The run-down from each speed after the machine is switched off."""

from ..base.progress import stage
from ..base.registry import register
from ..stopping.labelled import stopping_variables
from ..study.study import Study
from ..transfer import on_mounts
from ..transfer.path import ShellPath
from .chain import Chain
from .representative import Representative
from .stage import Given, Stage, Trial, timed


@register
class Stopping(Stage):
    """Forces, foot forces and sound while the machine runs down, without a balancer.

    The machine is that of the representative sample, where there are samples.
    """

    name = "stopping"
    reads = (ShellPath, Representative, "transfer_vector", "pattern_transfer_vector")
    gives = ("stopping_*",)

    def applies(self, study: Study) -> bool:
        return study.operation.stopping

    def run(self, chain: Chain) -> Given:
        chosen, path = chain.get(Representative), chain.get(ShellPath)
        machine = chain.study.machine if chosen is None else chosen.machine
        with stage(chain.progress, "switching off"):
            mounted, results = on_mounts(machine), chain.results
            return Given(stopping_variables(chain.study, machine, mounted, results, path))

    def tried(self, chain: Chain, study: Study) -> Trial:
        return timed(chain, self, len(study.operation.speed_rpm))
