"""Motion of shaft, housing and block, and what the feet pass on."""

from ..registry import register
from ..vocabulary import Coordinate, Variable

for _thing in (
    Coordinate("dof", ("dof",), "", "degree of freedom of the housing at its centre of mass"),
    Coordinate("foot", ("foot",), "", "mounting foot"),
    Coordinate(
        "foot_position", ("foot", "axis"), "m", "foot position from the centre of mass at rest"
    ),
    Coordinate("mode", ("mode",), "", "rigid-body mode on the mounts"),
    Coordinate("body", ("body",), "", "rigid body of the machine"),
    Coordinate("mount_frequency", ("mount_frequency",), "Hz", "frequency of the mounts' response"),
    Variable("shaft_speed", ("speed", "option", "crank_angle"), "rad s-1", "speed of the shaft"),
    Variable(
        "shaft_acceleration",
        ("speed", "option", "crank_angle"),
        "rad s-2",
        "angular acceleration of the shaft",
    ),
    Variable("supply_frequency", ("speed",), "Hz", "frequency of the motor's supply"),
    Variable(
        "velocity_order",
        ("speed", "option", "source", "dof", "order"),
        "m s-1",
        "velocity of the housing",
        complex_peak=True,
    ),
    Variable(
        "block_velocity_order",
        ("speed", "option", "source", "dof", "order"),
        "m s-1",
        "velocity of the block on its springs in the shell",
        complex_peak=True,
    ),
    Variable(
        "foot_force_order",
        ("speed", "option", "source", "foot", "axis", "order"),
        "N",
        "force into the foot",
        complex_peak=True,
    ),
    Variable(
        "foot_force_amplitude",
        ("speed", "option", "foot", "order"),
        "N",
        "force into the foot, semi-major axis, peak",
    ),
    Variable("natural_frequency", ("mode",), "Hz", "natural frequency on the mounts"),
    Coordinate("shell_mode", ("shell_mode",), "", "elastic mode of the shell, with its frame"),
    Coordinate("gas_mode", ("gas_mode",), "", "mode of a space of gas in the shell"),
    Variable(
        "shell_frequency",
        ("shell_mode",),
        "Hz",
        "natural frequency of the shell, with the parts in it where there is a frame",
    ),
    Variable("gas_frequency", ("gas_mode",), "Hz", "natural frequency of gas in rigid walls"),
    Variable("mode_shape", ("mode", "body", "dof"), "kg-1/2", "mass-normalised shape of the mode"),
    Variable(
        "mount_transmissibility",
        ("axis", "mount_frequency"),
        "1",
        "sum of foot forces per force at the centre of mass",
        complex_peak=True,
    ),
):
    register(_thing)
