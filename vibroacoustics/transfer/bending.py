"""The elastic shell of a machine with one set of values, and its answer to loads over time."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from scipy import fft

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.decibel import amplitude_of_level
from ..base.errors import ParameterError
from ..machine.cavities import GasPort
from ..machine.frame import PARTS, Part
from ..machine.machine import Machine
from ..machine.shell_structure import ShellStructure, ShellVariation
from ..machine.source import Shared
from ..machine.stator_yoke import STATOR_YOKE
from ..mechanics.ports import WRENCH, Port
from .cavity.of_machine import gas_of
from .cavity.response import DrivenGas
from .frame.of_machine import frame_on_shell
from .frame.on_shell import FrameOnShell, SoundPerForce
from .observers import Observers
from .path import ShellPath, pressure_per_load
from .transient import LOAD_SAMPLES, RESULT_SAMPLES
from .yoke import YokeOnWall, yoke_on_wall

LINES: Final = 1000
"""Frequencies at a time: all at once would need a gigabyte."""
_SAME_DECIMALS: Final = 9
"""Frequencies in Hz that agree so far are one: no resonance is so sharp."""


def rows_of(part: Part) -> slice:
    """Rows of a part's components among those of all parts."""
    first = len(WRENCH) * PARTS.index(part)
    return slice(first, first + len(WRENCH))


@dataclass(frozen=True)
class BendingShell:
    """The elastic shell with one set of values; responses are kept.

    Attributes
    ----------
    path : modes and joints of the nominal shell
    loss_factor_ratio : loss factor of the shell
    variation : differences of the real shell from the nominal one
    frame : forces of the parts on the shell; None where loads on parts act on the shell directly
    gas : spaces of gas in the shell, by the name of their table
    yoke : yoke of the stator, as a ring in the shell; None where the machine has none
    """

    path: ShellPath
    loss_factor_ratio: float
    variation: ShellVariation
    frame: FrameOnShell | None = None
    gas: Mapping[str, DrivenGas] = field(default_factory=dict)
    yoke: YokeOnWall | None = None
    _known: Shared = field(default_factory=Shared, repr=False)
    _of_parts: dict[tuple[Observers, float], ComplexArray] = field(default_factory=dict, repr=False)

    def response(
        self, observers: Observers, port: Port, frequency_hz: Array, lines: IndexArray
    ) -> ComplexArray:
        """Observed quantity per load on a port, shape (observer, component, line).

        Parameters
        ----------
        observers : observed quantities, per motion of the shell's modes
        port : port of the load, in the shell
        frequency_hz : frequencies, shape (frequency,), Hz; solutions for parts and gas are shared
        lines : indices of the loaded frequencies, shape (line,)
        """
        key = observers, port, frequency_hz.tobytes(), lines.tobytes()
        return self._known(key, lambda: self._response(observers, port, frequency_hz, lines))

    def _response(
        self, observers: Observers, port: Port, frequency_hz: Array, lines: IndexArray
    ) -> ComplexArray:
        if isinstance(port, Part):
            key = "parts", observers, frequency_hz.tobytes()
            parts = self._known(key, lambda: self._of_all_parts(observers, frequency_hz))
            return np.asarray(parts[:, rows_of(port)][..., lines])
        forces, frame = self.modal_forces(port, frequency_hz[lines]), self.frame_under(port)
        return self.of_modal_forces(observers, forces, frequency_hz, lines, frame)

    def modal_forces(self, port: Port, frequency_hz: Array) -> ComplexArray:
        """Generalised force of each mode per load on gas or yoke, (mode, component, frequency).

        Raises
        ------
        ParameterError
            The machine has no such port.
        """
        if isinstance(port, GasPort) and port.name in self.gas:
            state = port.density_kg_per_m3, port.sound_speed_m_per_s
            return self.gas[port.name].wall_forces(*state, frequency_hz)[:, None]
        if port == STATOR_YOKE and self.yoke is not None:
            return self.yoke.forces(frequency_hz)
        raise ParameterError(f"port {port.name}: the machine has none")

    def frame_under(self, port: Port) -> FrameOnShell | None:
        """The frame, where it answers a port's load; it leaves the fitted yoke as it is."""
        return None if port == STATOR_YOKE else self.frame

    def of_modal_forces(
        self,
        observers: Observers,
        forces: Array | ComplexArray,
        frequency_hz: Array,
        lines: IndexArray,
        frame: FrameOnShell | None,
    ) -> ComplexArray:
        """Observed quantity of forces on the modes, shape (observer, load, line).

        Parameters
        ----------
        observers : with the modes
        forces : at the lines, shape (mode, load, line or 1)
        frequency_hz : shape (frequency,)
        lines : indices of the loaded ones, shape (line,)
        frame : that answers the forces
        """
        if frame is not None:
            of_modes = self._through(frame, observers, frequency_hz).of_modes(lines)
            return np.asarray(np.einsum("omf,mlf->olf", of_modes, forces))
        return pressure_per_load(
            self.path,
            observers.of_modes(frequency_hz[lines]),
            frequency_hz[lines],
            self.loss_factor_ratio,
            self.variation,
            forces,
        )

    def _of_all_parts(self, observers: Observers, frequency_hz: Array) -> ComplexArray:
        """Response per load on the parts, shape (observer, part times component, frequency)."""
        if self.frame is None:
            forces, every = self.path.forces_of_parts(), np.arange(frequency_hz.size)
            return self.of_modal_forces(observers, forces, frequency_hz, every, None)
        names = np.round(frequency_hz, _SAME_DECIMALS).tolist()
        keys, responses = [(observers, name) for name in names], self._of_parts
        new = [number for number, key in enumerate(keys) if key not in responses]
        if 2 * len(new) > len(keys):  # all, as gas that acts at them asks for
            new = list(range(len(keys)))
        if new:  # noise shares its frequencies with lines
            of_loads = self._through(self.frame, observers, frequency_hz[new]).of_loads
            each = np.moveaxis(of_loads, -1, 0)
            responses.update(zip((keys[n] for n in new), each, strict=True))
        return np.stack([responses[key] for key in keys], axis=-1)

    def _through(
        self, frame: FrameOnShell, observers: Observers, frequency_hz: Array
    ) -> SoundPerForce:
        """Observe shell and frame together; kept, as gas and parts drive the same."""

        def sound() -> SoundPerForce:
            gain = amplitude_of_level(self.variation.mobility_change_db)
            shell_motions = observers.of_modes(frequency_hz), observers.rigid(frequency_hz)
            return frame.sound(*shell_motions, frequency_hz, gain)

        return self._known(("frame", observers, frequency_hz.tobytes()), sound)


def bending_shell(machine: Machine, path: ShellPath) -> BendingShell:
    """Make the shell with a machine's values."""
    structure, variation = machine.table(ShellStructure), machine.table(ShellVariation)
    shell = path.with_structure(structure)
    frame = frame_on_shell(machine, shell)
    yoke, gas = yoke_on_wall(machine, shell), gas_of(machine, path)
    return BendingShell(shell, structure.loss_factor_ratio, variation, frame, gas, yoke)


def pressure_over_time(
    shell: BendingShell, observers: Observers, loads: Mapping[Port, Array], load_rate_hz: float
) -> Array:
    """Pressure of loads in the shell by Fourier transform of the event, Pa, (receiver, times).

    The rigid machine is treated so by `transient`: the event counts as one period, ends with rest
    that lasts until the vibration of the shell has decayed, and has no lines above the highest
    frequency.

    Parameters
    ----------
    shell : with one set of values
    observers : microphones
    loads : by port, shape (component, times); the number of times is a multiple of LOAD_SAMPLES
    load_rate_hz : see `transient`
    """
    times = next(iter(loads.values())).shape[-1]
    highest_hz = load_rate_hz / (LOAD_SAMPLES * RESULT_SAMPLES)
    frequency = fft.rfftfreq(times, 1.0 / load_rate_hz)
    frequency = frequency[frequency <= highest_hz]
    spectra = {port: fft.rfft(load)[:, : frequency.size] for port, load in loads.items()}

    def pressure(first: int) -> ComplexArray:
        block = slice(first, first + LINES)
        some = frequency[block]
        every = np.arange(some.size)
        parts = [
            np.einsum(
                "rcf,cf->rf", shell.response(observers, port, some, every), spectrum[:, block]
            )
            for port, spectrum in spectra.items()
        ]
        return np.asarray(sum(parts))

    lines = np.concatenate([pressure(first) for first in range(0, frequency.size, LINES)], axis=1)
    return np.asarray(fft.irfft(lines, times // LOAD_SAMPLES) / LOAD_SAMPLES)
