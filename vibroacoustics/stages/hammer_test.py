"""The hammer test of the shell that a study names, against which samples are held."""

from ..base.errors import ParameterError
from ..base.registry import register
from ..measured.shell_functions import read_shell_mobilities
from ..study.study import Study
from ..transfer.path import ShellPath
from ..uncertainty.hammer_test import HammerTest
from .chain import Chain
from .stage import Given, Stage


@register
class HammerTests(Stage):
    """Measured mobilities of the shell's wall, with their natural frequencies and loss factors."""

    name = "hammer-test"
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
