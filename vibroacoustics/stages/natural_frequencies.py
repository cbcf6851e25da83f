"""Natural frequencies of the shell with its frame, and of the gas in it."""

from ..base.progress import stage
from ..base.registry import register
from ..machine.cases import Cases
from ..study.study import Study
from ..transfer.natural_frequencies import natural_variables
from ..transfer.path import ShellPath
from .chain import Chain
from .stage import Given, Stage


@register
class NaturalFrequencies(Stage):
    """Natural frequencies without loss, up to the highest frequency."""

    name = "natural-frequencies"
    reads = (Cases, ShellPath)
    gives = ("shell_frequency", "gas_frequency")

    def applies(self, study: Study) -> bool:
        return study.drives_shell

    def run(self, chain: Chain) -> Given:
        study, of_any_case = chain.study, next(iter(chain[Cases].loads.values()))
        with stage(chain.progress, self.name.replace("-", " ")):
            highest_hz = study.radiation.maximum_frequency_hz
            return Given(
                natural_variables(study.machine, chain[ShellPath], of_any_case, highest_hz)
            )
