"""Load path from the loads of all sources in one case to what is observed of the machine."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ..base.arrays import Array, ComplexArray, IndexArray
from ..machine.source import Shared
from ..mechanics.loads import Noise, PortLoads
from ..mechanics.ports import BodyPort, Port
from .bending import BendingShell
from .force_sound import of_body
from .machine import MachineOnMounts
from .observers import Observers


@dataclass(frozen=True)
class LoadPath:
    """Paths from ports to observers, with one set of values; responses are kept.

    Attributes
    ----------
    body : the machine on its mounts
    shell : the elastic shell; none where it is rigid, and loads in it are not observed
    """

    body: MachineOnMounts
    shell: BendingShell | None = None
    _known: Shared = field(default_factory=Shared, repr=False)

    def response(
        self,
        observers: Observers,
        ports: Sequence[Port],
        frequency_hz: Array,
        lines: IndexArray | None = None,
    ) -> ComplexArray:
        """Observed quantity per load, shape (observer, component of the ports, line).

        Parameters
        ----------
        observers : observers of the machine
        ports : where it is loaded
        frequency_hz : shape (frequency,)
        lines : indices of frequencies that are loaded; all where they are not given
        """
        columns = np.arange(frequency_hz.size) if lines is None else lines
        each = [self._of_port(observers, port, frequency_hz, columns) for port in ports]
        return np.concatenate(each, axis=1)

    def _of_port(
        self, observers: Observers, port: Port, frequency_hz: Array, lines: IndexArray
    ) -> ComplexArray:
        if isinstance(port, BodyPort):
            key = observers, port, frequency_hz.tobytes()

            def every() -> ComplexArray:
                by_motion = self.by_motion(observers, port, frequency_hz)
                return np.asarray(np.einsum("omf,mcf->ocf", *by_motion))

            return np.asarray(self._known(key, every)[..., lines])
        if self.shell is None or observers.modes is None:
            observed = len(observers.rigid(frequency_hz[:1]))
            return np.zeros((observed, len(port.components), lines.size), dtype=complex)
        return self.shell.response(observers, port, frequency_hz, lines)

    def by_motion(
        self, observers: Observers, port: BodyPort, frequency_hz: Array
    ) -> tuple[ComplexArray, ComplexArray]:
        """Observed quantity per velocity of the body on the feet, and its velocity per load.

        Returns
        -------
        shapes (observer, motion, frequency) and (motion, component, frequency)
        """
        loads = np.broadcast_to(np.eye(6, dtype=complex)[:, None], (6, frequency_hz.size, 6))
        velocity = self.body.response(loads, frequency_hz, port).velocity
        return of_body(observers.rigid, self.body)(frequency_hz), np.moveaxis(velocity, -1, 0)

    def observed(self, observers: Observers, loads: PortLoads, frequency_hz: Array) -> ComplexArray:
        """Observe loads together, complex peaks, shape (observer or 1 where none acts, line).

        Parameters
        ----------
        observers : observers of the machine
        loads : by port, shape (component, line)
        frequency_hz : shape (line,)
        """
        total = np.zeros((1, frequency_hz.size), dtype=complex)
        for port, amplitudes in loads.items():
            lines = np.flatnonzero(amplitudes.any(axis=0))
            if lines.size:
                response = self._of_port(observers, port, frequency_hz, lines)
                part = np.zeros((len(response), frequency_hz.size), dtype=complex)
                part[:, lines] = np.einsum("ocf,cf->of", response, amplitudes[:, lines])
                total = total + part
        return total

    def noise_power(self, observers: Observers, noise: Noise) -> Array:
        """Mean square of what a random load makes, (observer, frequency), such as Pa²."""
        frequency = noise.frequency_hz
        if not noise.density.any():  # keys that do not strike
            return np.zeros((len(observers.rigid(frequency[:1])), frequency.size))
        per_load = self.response(observers, [*noise.loads], frequency)
        loads = np.concatenate([*noise.loads.values()])
        per_force = np.einsum("ocf,ci->oif", per_load, loads, optimize=True)
        density = np.einsum(
            "oif,ijf,ojf->of", per_force.conj(), noise.density, per_force, optimize=True
        ).real
        return np.asarray(density * (frequency[1] - frequency[0]))
