"""The elastic shell of a machine with one set of values, and its answer to loads over time."""

from typing import Final

import numpy as np
from scipy import fft

from ..base.arrays import Array
from ..machine.machine import Machine
from ..machine.shell_structure import ShellStructure, ShellVariation
from .cavity.of_machine import gas_of
from .force_sound import PressurePerVelocity
from .frame import frame_on_shell
from .path import ShellPath
from .sound_path import BendingShell
from .transient import LOAD_SAMPLES, RESULT_SAMPLES
from .yoke import yoke_on_wall

LINES: Final = 1000
"""Frequencies at a time: all at once would need a gigabyte."""


def bending_shell(
    machine: Machine, path: ShellPath, modes: PressurePerVelocity, rigid: PressurePerVelocity
) -> BendingShell:
    """The shell with a machine's values.

    Parameters
    ----------
    machine : wall, variation, frame, gas in the shell, yoke
    path : modes and joints of the study
    modes, rigid : pressure per velocity of modes and rigid motions

    Raises
    ------
    ParameterError
        Frame or joints do not fit the shell.
    """
    structure, variation = machine.table(ShellStructure), machine.table(ShellVariation)
    shell = path.with_structure(structure)
    frame = frame_on_shell(machine, shell)
    loss = structure.loss_factor_ratio
    yoke = yoke_on_wall(machine, shell)
    gas = gas_of(machine, path)
    return BendingShell(shell, modes, rigid, loss, variation, frame, gas, yoke)


def pressure_over_time(shell: BendingShell, load: Array, load_rate_hz: float) -> Array:
    """Pressure of loads on the parts by Fourier transform of the event, Pa, (receiver, times).

    As `transient` does for the rigid machine: the event counts as one period, ends with rest that
    lasts until the shell has rung out, and has no lines above the highest frequency.

    Parameters
    ----------
    shell : with one set of values
    load : on the parts, shape (part, component, times), N and N m; the number of times is a
        multiple of LOAD_SAMPLES
    load_rate_hz : as of `transient`
    """
    times = load.shape[-1]
    highest_hz = load_rate_hz / (LOAD_SAMPLES * RESULT_SAMPLES)
    frequency = fft.rfftfreq(times, 1.0 / load_rate_hz)
    frequency = frequency[frequency <= highest_hz]
    spectrum = fft.rfft(load)[..., : frequency.size]
    pressure = [
        np.einsum(
            "rpcf,pcf->rf",
            shell.per_load(frequency[at : at + LINES]),
            spectrum[..., at : at + LINES],
        )
        for at in range(0, frequency.size, LINES)
    ]
    lines = np.concatenate(pressure, axis=1)
    return np.asarray(fft.irfft(lines, times // LOAD_SAMPLES) / LOAD_SAMPLES)
