"""The elastic shell of a study: computed modes, or measured ones from a file."""

from .. import recordings
from ..base.progress import stage
from ..base.registry import register
from ..study.study import Study
from ..transfer.path import ShellPath
from ..transfer.study_path import computed_shell_path, measured_shell_path
from .chain import Chain
from .stage import Given, Stage, Trial, timed


@register
class Shell(Stage):
    """Modes and joints of the shell, where a source drives it."""

    name = "shell"
    gives = (ShellPath,)

    def applies(self, study: Study) -> bool:
        return study.drives_shell

    def run(self, chain: Chain) -> Given:
        with stage(chain.progress, "modes of the shell"):
            return Given(products=(shell_path(chain.study),))

    def tried(self, chain: Chain, study: Study) -> Trial:
        return timed(chain, self)


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
