"""Loads of a source: amplitudes at ports by line, and noise at ports."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TypeVar

import numpy as np

from ..base.arrays import Array, ComplexArray
from .moving_parts import Wrench
from .ports import BodyPort, Port

Amplitudes = TypeVar("Amplitudes", Array, ComplexArray)
PortLoads = Mapping[Port, ComplexArray]
"""Loads by port, (component, ...): complex peaks in the units of the port's components."""


@dataclass(frozen=True)
class Tone:
    """A line that is no order of the shaft.

    Attributes
    ----------
    name : name of the source
    frequency_hz : above zero
    loads : by port, shape (component,)
    figure : name of the reported figure of the largest force that it makes in a foot; none for none

    Examples
    --------
    >>> hum = va.Tone("hum", 100.0, {va.HOUSING: np.array([0, 0, 2.0, 0, 0, 0], complex)})
    >>> hum.frequency_hz
    100.0
    """

    name: str
    frequency_hz: float
    loads: PortLoads
    figure: str | None = None


@dataclass(frozen=True)
class Noise:
    """Random loads: what does not repeat with the revolution.

    Attributes
    ----------
    loads : load on each port per unit of each random force, shape (component, force)
    frequency_hz : evenly spaced, shape (line,)
    density : one-sided spectral density of the random forces, shape (force, force, line), such as
        N²/Hz

    Examples
    --------
    >>> up = np.eye(6)[:, 2:3]  # one force, along z
    >>> rumble = va.Noise({va.HOUSING: up}, np.arange(0.0, 1000.0, 5.0), np.ones((1, 1, 200)))
    >>> [port.name for port in rumble.loads]
    ['housing']
    """

    loads: Mapping[Port, Array]
    frequency_hz: Array
    density: ComplexArray


@dataclass(frozen=True)
class Loads:
    """Loads of one source in one case; loads that are zero may be absent.

    Attributes
    ----------
    wrenches : over uniform crank angles on the body with the mechanism, by what makes them
    lines : by port at orders from zero, shape (component, order)
    tones : lines that are no orders
    noise : random loads
    shaft_torque_n_m : that the shaft needs, mean and complex peaks by order, shape (order,)
    figures : to report, by name; the unit is the suffix of the name

    Examples
    --------
    >>> force = np.zeros((3, 64))
    >>> force[0] = np.cos(2.0 * np.pi * np.arange(64) / 64)  # N, along x, once a revolution
    >>> loads = va.Loads(wrenches={"imbalance": va.Wrench(force, np.zeros((3, 64)))})
    >>> list(loads.wrenches)
    ['imbalance']
    """

    wrenches: Mapping[str, Wrench] = field(default_factory=dict)
    lines: PortLoads = field(default_factory=dict)
    tones: tuple[Tone, ...] = ()
    noise: tuple[Noise, ...] = ()
    shaft_torque_n_m: ComplexArray | None = None
    figures: Mapping[str, float] = field(default_factory=dict)

    @property
    def ports(self) -> Iterator[Port]:
        """Ports of lines, tones and noise."""
        yield from self.lines
        for tone in self.tones:
            yield from tone.loads
        for noise in self.noise:
            yield from noise.loads


@dataclass(frozen=True)
class Lines:
    """The lines of all sources in one case: orders from zero, then tones.

    Attributes
    ----------
    names : names of the lines
    frequency_hz : shape (line,)
    loads : by source and port, shape (component, line)
    """

    names: tuple[str, ...]
    frequency_hz: Array
    loads: Mapping[str, PortLoads]


def lines_of(
    loads: Mapping[str, Loads],
    shaft_hz: float,
    highest: int,
    wrenches: Mapping[str, PortLoads] = MappingProxyType({}),
) -> Lines:
    """Lay the loads of all sources on one axis of lines; every tone is a line of its own.

    Parameters
    ----------
    loads : by source
    shaft_hz : frequency of the first order
    highest : order
    wrenches : spectra of the wrenches over crank angle by source and port, (component, order)
    """
    tones = [(source, tone) for source, load in loads.items() for tone in load.tones]
    orders = highest + 1
    count = orders + len(tones)
    laid: dict[str, dict[Port, ComplexArray]] = {}

    def at_lines(source: str, port: Port) -> ComplexArray:
        still = np.zeros((len(port.components), count), dtype=complex)
        return laid[source].setdefault(port, still)

    for source, load in loads.items():
        laid[source] = {}
        for port, amplitudes in (*wrenches.get(source, {}).items(), *load.lines.items()):
            held = amplitudes[:, :orders]
            at_lines(source, port)[:, : held.shape[1]] += held
    for number, (source, tone) in enumerate(tones, orders):
        for port, amplitudes in tone.loads.items():
            at_lines(source, port)[:, number] = amplitudes
    frequency = [*(shaft_hz * np.arange(orders)), *(tone.frequency_hz for _, tone in tones)]
    names = (
        *(f"order {order}" for order in range(orders)),
        *(f"{source}: {tone.name}" for source, tone in tones),
    )
    return Lines(names, np.array(frequency), laid)


def in_shell(loads: PortLoads) -> PortLoads:
    """Select the loads that act in the elastic shell, not on a rigid body."""
    return {port: load for port, load in loads.items() if not isinstance(port, BodyPort)}


def summed(loads: Iterable[Mapping[Port, Amplitudes]]) -> dict[Port, Amplitudes]:
    """Sum loads port by port."""
    total: dict[Port, Amplitudes] = {}
    for by_port in loads:
        for port, amplitudes in by_port.items():
            total[port] = total[port] + amplitudes if port in total else amplitudes
    return total


def total_torque_n_m(loads: Iterable[Loads], highest: int) -> ComplexArray:
    """Torque that the shaft needs for all sources that say so, shape (highest order + 1,)."""
    total = np.zeros(highest + 1, dtype=complex)
    for source in loads:
        if source.shaft_torque_n_m is not None:
            total += source.shaft_torque_n_m
    return total
