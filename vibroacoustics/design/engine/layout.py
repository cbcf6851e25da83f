"""Layout of the loads of designs at one speed: lines, ports in the shell, random loads."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...base.arrays import Array
from ...mechanics.loads import Noise
from ...mechanics.ports import Port

Matrix = tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class RandomLoad:
    """Ports and frequencies of random loads of one source.

    Attributes
    ----------
    source : number of the source
    frequency_hz : evenly spaced frequencies
    loads : ports, each with the load on its components per unit of each random force
    """

    source: int
    frequency_hz: tuple[float, ...]
    loads: tuple[tuple[Port, Matrix], ...]

    @classmethod
    def of(cls, source: int, noise: Noise) -> "RandomLoad":
        """Take the ports and frequencies of random loads."""
        loads = ((port, tuple(map(tuple, load.tolist()))) for port, load in noise.loads.items())
        return cls(source, tuple(noise.frequency_hz.tolist()), tuple(loads))

    @property
    def shape(self) -> tuple[int, int, int]:
        """Shape of the density (line, force, force)."""
        forces = len(self.loads[0][1][0])
        return len(self.frequency_hz), forces, forces


@dataclass(frozen=True)
class Layout:
    """Lines of one speed and the loads in the shell at that speed.

    Attributes
    ----------
    frequency_hz, order : frequencies, Hz, and orders of the lines above 0 Hz; order 0 for
        tones that are none
    ports : ports in the shell
    random : random loads
    """

    frequency_hz: tuple[float, ...]
    order: tuple[int, ...]
    ports: tuple[Port, ...]
    random: tuple[RandomLoad, ...]

    @property
    def of_ports(self) -> "Layout":
        """Return the layout without the frequencies of the lines."""
        return Layout((), (), self.ports, self.random)

    @cached_property
    def hertz(self) -> Array:
        """Frequencies of the lines, shape (line,), Hz."""
        return np.array(self.frequency_hz)

    @property
    def components(self) -> Mapping[Port, slice]:
        """Rows of the components of each port."""
        rows: dict[Port, slice] = {}
        first = 0
        for port in self.ports:
            rows[port] = slice(first, first + len(port.components))
            first += len(port.components)
        return rows
