"""The elastic shell of a study: computed modes, or measured ones from a file."""

from .. import recordings
from ..machine.shell_structure import ShellStructure, ShellVariation
from ..study.study import Study
from ..study.uncertainty import MeasuredModes
from ..transfer.path import ShellPath, computed_path, measured_path
from ..transfer.shell_modes import SampledMode


def shell_path(study: Study) -> ShellPath | None:
    """The elastic shell of a study whose sources drive it; none without.

    Computed modes reach the highest frequency in every draw, measured ones as far as their file.
    """
    if not study.drives_shell:
        return None
    structure, shell = study.machine.table(ShellStructure), study.machine.shell
    if study.shell_modes is not None:
        return measured_path(_measured(study.shell_modes), structure, shell.radius_m)
    given = study.machine.table(ShellVariation).frequency_factor_ratio
    drawn = [own.lowest for own in study.ranges if own.field == "frequency_factor_ratio"]
    least = min([given, *drawn])
    return computed_path(shell, structure, study.radiation.maximum_frequency_hz, least)


def _measured(settings: MeasuredModes) -> tuple[SampledMode, ...]:
    """Modes of a universal file."""
    found = recordings.read_modes(settings.file, file_unit_m=settings.file_unit_m)
    rows = zip(found.frequency_hz, found.modal_mass_kg, found.shape, strict=True)
    return tuple(
        SampledMode(f"measured_{number:02d}", float(hertz), float(mass), found.nodes_m, shape)
        for number, (hertz, mass, shape) in enumerate(rows, 1)
    )
