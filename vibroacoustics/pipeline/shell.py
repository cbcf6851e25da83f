"""The elastic shell of a study: computed modes, or measured ones from a file."""

from .. import recordings
from ..study.study import Study
from ..transfer.path import ShellPath
from ..transfer.study_path import computed_shell_path, measured_shell_path


def shell_path(study: Study) -> ShellPath | None:
    """The elastic shell of a study whose sources drive it; none without."""
    if not study.drives_shell:
        return None
    if study.shell_modes is None:
        return computed_shell_path(study)
    settings = study.shell_modes
    modes = recordings.read_modes(settings.file, file_unit_m=settings.file_unit_m)
    return measured_shell_path(
        study, modes.frequency_hz, modes.modal_mass_kg, modes.nodes_m, modes.shape
    )
