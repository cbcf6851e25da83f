"""The elastic shell of a study as a path: its modes computed, or measured."""

from ..base.arrays import Array
from ..machine.shell_structure import ShellStructure, ShellVariation
from ..study.study import Study
from .path import ShellPath, computed_path, measured_path
from .shell_modes import SampledMode

_DRAWN = "frequency_factor_ratio"
"""Of the shell's variation: how natural frequencies differ in a draw."""


def computed_shell_path(study: Study) -> ShellPath:
    """Modes that reach the highest frequency in every draw."""
    machine = study.machine
    given = getattr(machine.table(ShellVariation), _DRAWN)
    drawn = [limits.lowest for limits in study.ranges if limits.field == _DRAWN]
    return computed_path(
        machine.shell,
        machine.table(ShellStructure),
        study.radiation.maximum_frequency_hz,
        min([given, *drawn]),
    )


def measured_shell_path(
    study: Study, frequency_hz: Array, modal_mass_kg: Array, nodes_m: Array, shape: Array
) -> ShellPath:
    """Measured modes, as far as they reach.

    Parameters
    ----------
    study : with the shell's joints
    frequency_hz, modal_mass_kg : of the modes, shape (mode,)
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
    return measured_path(modes, machine.table(ShellStructure), machine.shell.radius_m)
