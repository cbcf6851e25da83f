"""Load ports: where a source acts on a machine, and along which components."""

from dataclasses import dataclass
from typing import Final

from ..base.parameters import Parameters

WRENCH: Final = ("fx", "fy", "fz", "mx", "my", "mz")
"""Force and moment about the centre of mass, N and N m."""


@dataclass(frozen=True)
class Port:
    """A place where sources load a machine.

    Attributes
    ----------
    name : name of the position
    components : components of a load; components of one name are one direction of a transfer path
    tables : tables of the machine that its response reads, beside its mounts

    Examples
    --------
    >>> va.HOUSING.name, va.HOUSING.components
    ('housing', ('fx', 'fy', 'fz', 'mx', 'my', 'mz'))
    """

    name: str
    components: tuple[str, ...] = WRENCH
    tables: tuple[type[Parameters], ...] = ()


@dataclass(frozen=True)
class BodyPort(Port):
    """A rigid body of the machine on its mounts, loaded by a wrench about its centre of mass.

    Examples
    --------
    >>> up = np.zeros((6, 2), complex)
    >>> up[2, 1] = 3.0  # N, along z, once a revolution
    >>> [port.name for port in va.Loads(lines={va.BLOCK: up}).ports]
    ['block']
    """


HOUSING: Final = BodyPort("housing")
"""The body on the mounts, which every machine has: the machine, or the shell round a block."""
