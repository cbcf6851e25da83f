"""From the loads of all sources in one case to sound pressure at the receivers."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.decibel import amplitude_of_level
from ..machine.shell_structure import ShellVariation
from ..machine.source import Shared
from ..mechanics.loads import GasFlow, Lines, Noise
from .cavity.response import DrivenGas
from .force_sound import PressurePerVelocity, of_body
from .frame import FrameOnShell, SoundPerForce
from .machine import MachineOnMounts
from .path import ShellPath, pressure_per_load
from .yoke import YokeOnWall

_SAME_DECIMALS: Final = 9
"""Frequencies in Hz that agree so far are one: no resonance is so sharp."""


@dataclass(frozen=True)
class BendingShell:
    """The elastic shell with one set of values.

    Attributes
    ----------
    path : modes and joints
    pressure_per_velocity : of the modes
    rigid : pressure per velocity of the six rigid motions
    loss_factor_ratio : of the shell
    variation : how the real shell differs
    frame : what the parts do to the shell; none where they hand their loads on as they are
    gas : spaces of gas in the shell, by the name of their table
    yoke : the stator's, as a ring in the shell; none where the machine has none
    """

    path: ShellPath
    pressure_per_velocity: PressurePerVelocity
    rigid: PressurePerVelocity
    loss_factor_ratio: float
    variation: ShellVariation
    frame: FrameOnShell | None = None
    gas: Mapping[str, DrivenGas] = field(default_factory=dict)
    yoke: YokeOnWall | None = None
    _known: Shared = field(default_factory=Shared, repr=False)
    _loads: dict[float, ComplexArray] = field(default_factory=dict, repr=False)

    def per_load(self, frequency_hz: Array) -> ComplexArray:
        """Pressure per load on a part, (receiver, part, component, frequency).

        Kept, as cases share their frequencies.
        """
        key = "load", frequency_hz.tobytes()
        return self._known(key, lambda: self._per_load(frequency_hz))

    def of_gas(self, flow: GasFlow, frequency_hz: Array) -> ComplexArray:
        """Pressure of a space of gas in the shell on its wall, shape (receiver, frequency)."""
        gas = self.gas.get(flow.into)
        if gas is None:
            return np.zeros((1, frequency_hz.size), dtype=complex)
        state = flow.density_kg_per_m3, flow.sound_speed_m_per_s
        flows = np.flatnonzero(flow.volume_flow)  # at the tones there is none

        def per_flow() -> ComplexArray:
            forces = gas.wall_forces(*state, frequency_hz[flows])
            return self.per_modal_force(forces, frequency_hz, flows)

        key = (flow.into, *state, frequency_hz.tobytes(), flows.tobytes())
        some = self._known(key, per_flow) * flow.volume_flow[flows]
        pressure = np.zeros((len(some), frequency_hz.size), dtype=complex)
        pressure[:, flows] = some
        return pressure

    def per_modal_force(
        self, forces: ComplexArray, frequency_hz: Array, some: IndexArray | None = None
    ) -> ComplexArray:
        """Pressure of forces on the modes, shape (receiver, some).

        Parameters
        ----------
        forces : at some of the frequencies, shape (mode, some)
        frequency_hz : shape (frequency,)
        some : numbers of these; all where it is not given
        """
        at = np.arange(frequency_hz.size) if some is None else some
        if self.frame:
            of_modes = self._through(self.frame, frequency_hz).of_modes(at)
            return np.asarray(np.einsum("rmf,mf->rf", of_modes, forces))
        every = np.zeros((len(forces), 1, 1, frequency_hz.size), dtype=complex)
        every[:, 0, 0, at] = forces
        return np.asarray(self._of_modes(every, frequency_hz)[:, 0, 0, at])

    def _per_load(self, frequency_hz: Array) -> ComplexArray:
        if self.frame is None:
            return self._of_modes(self.path.forces_of_parts(), frequency_hz)
        names = np.round(frequency_hz, _SAME_DECIMALS).tolist()
        new = [number for number, name in enumerate(names) if name not in self._loads]
        if 2 * len(new) > len(names):  # all, as gas that acts at them asks for
            new = list(range(len(names)))
        if new:  # noise shares its frequencies with lines
            of_loads = self._through(self.frame, frequency_hz[new]).of_loads
            each = np.moveaxis(of_loads, -1, 0)
            self._loads.update(zip((names[n] for n in new), each, strict=True))
        return np.stack([self._loads[name] for name in names], axis=-1)

    def _through(self, frame: FrameOnShell, frequency_hz: Array) -> SoundPerForce:
        """Of shell and frame together; kept, as gas and parts drive the same."""

        def sound() -> SoundPerForce:
            gain = amplitude_of_level(self.variation.mobility_change_db)
            modes, rigid = self.pressure_per_velocity(frequency_hz), self.rigid(frequency_hz)
            return frame.sound(modes, rigid, frequency_hz, gain)

        return self._known(("frame", frequency_hz.tobytes()), sound)

    def _of_modes(self, forces: Array | ComplexArray, frequency_hz: Array) -> ComplexArray:
        """Of generalised forces, as `pressure_per_load`."""
        return pressure_per_load(
            self.path,
            self.pressure_per_velocity(frequency_hz),
            frequency_hz,
            self.loss_factor_ratio,
            self.variation,
            forces,
        )

    def per_yoke_load(self, frequency_hz: Array) -> ComplexArray:
        """Pressure per line load around the yoke, (receiver, order around, 2, frequency).

        None at frequency zero.
        """
        if self.yoke is None:
            raise ValueError("a load around the yoke needs a machine with one")
        moves = frequency_hz > 0.0
        frequency = np.where(moves, frequency_hz, 1.0)
        return np.asarray(self._of_modes(self.yoke.forces(frequency), frequency) * moves)


@dataclass(frozen=True)
class SoundPath:
    """All ways from loads to the receivers, with one set of values.

    Attributes
    ----------
    rigid : pressure per velocity of the six rigid motions
    shell : the elastic shell; none where it is rigid
    """

    rigid: PressurePerVelocity
    shell: BendingShell | None

    def pressure(self, body: MachineOnMounts, lines: Lines) -> Mapping[str, ComplexArray]:
        """Pressure at the lines by source, complex peaks, shape (receiver, line), Pa.

        What the sources' wrenches over crank angle do is not in it.
        """
        return {source: self._of_source(body, lines, source) for source in lines.rigid}

    def _of_source(self, body: MachineOnMounts, lines: Lines, source: str) -> ComplexArray:
        frequency, wrench, parts = lines.frequency_hz, lines.rigid[source], lines.on_parts[source]
        pressure: ComplexArray = np.zeros((1, frequency.size), dtype=complex)
        on_shell = lines.on_shell.get(source, np.zeros_like(wrench))
        loaded = np.flatnonzero(wrench.any(axis=0) | on_shell.any(axis=0))
        if loaded.size:
            response = body.response(wrench.T[loaded], frequency[loaded], on_shell.T[loaded])
            vectors = of_body(self.rigid, body)(frequency)
            pressure = np.zeros((len(vectors), frequency.size), dtype=complex)
            pressure[:, loaded] = np.einsum("rdf,fd->rf", vectors[..., loaded], response.velocity)
        if self.shell is not None and parts.any():
            per_load = self.shell.per_load(frequency)
            pressure = pressure + np.einsum("rpcf,pcf->rf", per_load, parts, optimize=True)
        if self.shell is not None:
            for flow in lines.flows.get(source, ()):
                pressure = np.asarray(pressure + self.shell.of_gas(flow, frequency))
        if self.shell is not None and source in lines.on_yoke:
            around = self.shell.per_yoke_load(frequency)
            pressure = pressure + np.einsum("rnof,nof->rf", around, lines.on_yoke[source])
        return pressure

    def noise_power(self, noise: Noise) -> Array:
        """Mean square of the pressure that a random load makes, (receiver, frequency), Pa²."""
        if self.shell is None:
            raise ValueError("a random load on a part needs an elastic shell")
        frequency = noise.frequency_hz
        if not noise.density.any():  # keys that do not strike
            return np.zeros((len(self.rigid(frequency[:1])), frequency.size))
        per_load = self.shell.per_load(frequency)
        per_force = np.einsum("rpcf,pci->rif", per_load, noise.on_parts, optimize=True)
        density = np.einsum(
            "rif,ijf,rjf->rf", per_force.conj(), noise.density, per_force, optimize=True
        ).real
        return np.asarray(density * (frequency[1] - frequency[0]))
