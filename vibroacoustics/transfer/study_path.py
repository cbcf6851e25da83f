"""The elastic shell of a study as a path: its modes computed, or measured."""

from typing import Final

from ..base.arrays import Array
from ..base.progress import Progress, no_progress
from ..machine.shell_structure import ShellStructure, ShellVariation
from ..study.study import Study
from .path import ShellPath, computed_path, measured_path
from .shell_modes.projection import projection_error
from .shell_modes.sampled import SampledMode

_FACTOR: Final = "frequency_factor_ratio"
"""Factor of the shell's variation: how natural frequencies differ in a sample."""


def computed_shell_path(study: Study) -> ShellPath:
    """Modes that reach the highest frequency in every sample."""
    machine = study.machine
    structure = machine.table(ShellStructure)
    factors = [item.lowest for item in study.ranges if item.field == _FACTOR]
    least = min([getattr(machine.table(ShellVariation), _FACTOR), *factors])
    walls = [end for pair in _ends(study, structure).values() for end in pair]
    highest = study.radiation.maximum_frequency_hz
    return computed_path(machine.shell, structure, highest, least, walls)


def projection_errors(
    study: Study, path: ShellPath, progress: Progress = no_progress
) -> dict[str, float]:
    """Largest relative error of a natural frequency by projection, by name of the sampled value.

    Over the modes up to the highest frequency, at both ends of the value's range, the other values
    nominal. Only values that change the shapes of modes are in it.
    """
    if path.wall is None:
        return {}
    highest, shell = study.radiation.maximum_frequency_hz, study.machine.shell
    every = _ends(study, path.structure).items()
    shaping = [
        entry for entry in every if entry[0].rpartition(".")[2] in path.structure.changes_shapes
    ]
    errors: dict[str, float] = {}
    for name, ends in shaping:
        progress("errors of projection", len(errors), len(shaping))
        errors[name] = max(projection_error(path.wall, shell, end, highest) for end in ends)
    progress("errors of projection", len(errors), len(shaping))
    return errors


def _ends(study: Study, structure: ShellStructure) -> dict[str, list[ShellStructure]]:
    """Walls at both ends of the range of each sampled value that modes change with."""
    return {
        item.name: [
            structure.model_copy(update={item.field: end}) for end in (item.lowest, item.highest)
        ]
        for item in study.ranges
        if item.field in structure.changes_modes
        and getattr(study.machine, item.table, None) is structure
    }


def measured_shell_path(
    study: Study, frequency_hz: Array, modal_mass_kg: Array, nodes_m: Array, shape: Array
) -> ShellPath:
    """Measured modes, as far as they reach.

    Parameters
    ----------
    study : with the shell's joints
    frequency_hz, modal_mass_kg : frequency and modal mass of the modes, shape (mode,)
    nodes_m : about the centre of mass, shape (node, 3)
    shape : displacements, shape (mode, node, 3)
    """
    modes = [
        SampledMode(f"measured_{number:02d}", float(hertz), float(mass), nodes_m, of_mode)
        for number, (hertz, mass, of_mode) in enumerate(
            zip(frequency_hz, modal_mass_kg, shape, strict=True), 1
        )
    ]
    machine = study.machine
    return measured_path(modes, machine.table(ShellStructure), machine.shell.cylinder.radius_m)
