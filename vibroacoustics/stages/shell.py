"""The elastic shell of a study: modes, natural frequencies with frame and gas, hammer test."""

from .. import recordings
from ..base.errors import ParameterError
from ..base.progress import stage
from ..base.registry import register
from ..machine.cases import Cases
from ..measured.shell_functions import read_shell_mobilities
from ..study.study import Study
from ..transfer.natural_frequencies import natural_variables
from ..transfer.path import ShellPath
from ..transfer.study_path import computed_shell_path, measured_shell_path
from ..uncertainty.hammer_test import HammerTest
from .chain import Chain
from .stage import Given, Stage


@register
class Shell(Stage):
    """Modes and joints of the shell, where a source drives it."""

    name = "shell"
    is_tried = True
    gives = (ShellPath,)

    def applies(self, study: Study) -> bool:
        return study.drives_shell

    def run(self, chain: Chain) -> Given:
        with stage(chain.progress, "modes of the shell"):
            return Given(products=(shell_path(chain.study),))


def shell_path(study: Study) -> ShellPath | None:
    """Compute or read the elastic shell of a study whose sources drive it; None without."""
    settings = study.shell_modes
    if not study.drives_shell:
        return None
    if settings is None:
        return computed_shell_path(study)
    modes = recordings.read_modes(settings.file, file_unit_m=settings.file_unit_m)
    return measured_shell_path(
        study, modes.frequency_hz, modes.modal_mass_kg, modes.nodes_m, modes.shape
    )


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


@register
class HammerTests(Stage):
    """Measured mobilities of the shell's wall, with their natural frequencies and loss factors."""

    name = "hammer-test"
    is_tried = True
    reads = (ShellPath,)
    gives = (HammerTest,)

    def applies(self, study: Study) -> bool:
        return study.measured is not None and study.measured.shell is not None

    def run(self, chain: Chain) -> Given:
        return Given(products=(hammer_test(chain.study, chain.get(ShellPath)),))


def hammer_test(study: Study, path: ShellPath | None) -> HammerTest:
    """Read the hammer test that a study names.

    Raises
    ------
    ParameterError
        The study names none, nothing to compare is sampled, or a file does not fit.
    StorageError
        A file cannot be read.
    """
    settings = None if study.measured is None else study.measured.shell
    if settings is None:
        raise ParameterError("measured.shell: the study has no such table")
    mobilities = read_shell_mobilities(settings, study.radiation.maximum_frequency_hz)
    return HammerTest.of(study, path, settings, mobilities)
