"""The elastic shell of a study: computed modes, or measured ones from a file."""

import time

from .. import recordings
from ..base.progress import stage
from ..base.registry import register
from ..radiation.cost import about
from ..study.study import Study
from ..transfer.path import ShellPath
from ..transfer.study_path import computed_shell_path, measured_shell_path
from .chain import Chain
from .stage import Given, Stage, Trial, advanced


@register
class Shell(Stage):
    """Modes and joints of the shell, where a source drives it."""

    name = "shell"
    gives = (ShellPath,)

    def applies(self, study: Study) -> bool:
        return study.drives_shell

    def run(self, chain: Chain) -> Given:
        with stage(chain.progress, "modes of the shell"):
            return Given(products=(_path(chain.study),))

    def tried(self, chain: Chain, study: Study) -> Trial:
        start = time.process_time()
        after = advanced(chain, self)
        return Trial(after, (about(self.name, time.process_time() - start, "measured"),))


def shell_path(study: Study) -> ShellPath | None:
    """Compute or read the elastic shell of a study whose sources drive it; None without."""
    return _path(study) if study.drives_shell else None


def _path(study: Study) -> ShellPath:
    if study.shell_modes is None:
        return computed_shell_path(study)
    settings = study.shell_modes
    modes = recordings.read_modes(settings.file, file_unit_m=settings.file_unit_m)
    return measured_shell_path(
        study, modes.frequency_hz, modes.modal_mass_kg, modes.nodes_m, modes.shape
    )
