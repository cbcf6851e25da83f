"""What a source does to the machine: on the rigid machine and on the parts in its shell."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from .moving_parts import Wrench

PARTS: Final = ("fixed_scroll", "bearing_housing", "orbiting_scroll", "lower_bearing", "stator")
"""Parts in the shell that sources load."""
FIXED_SCROLL, BEARING_HOUSING, ORBITING_SCROLL, LOWER_BEARING, STATOR = range(len(PARTS))
"""Their indices."""
PART_COMPONENTS: Final = 6
"""Force along x, y, z and moment about the centre of mass at rest, which lies on the axis."""
YOKE_ORDERS: Final = (0, 2, 3, 4, 5, 6)
"""Waves around the stator's yoke that press on the wall; one wave is a force on the stator."""


DISCHARGE_DOME: Final = "discharge_dome"
SUCTION_ANNULUS: Final = "suction_annulus"
"""Spaces of gas in the shell that a source may feed, as the machine's tables are named."""


@dataclass(frozen=True)
class GasFlow:
    """Volume flow into a space of gas in the shell.

    Attributes
    ----------
    into : name of the machine's table
    density_kg_per_m3, sound_speed_m_per_s : of the gas there
    volume_flow : complex peaks by order, or at lines, shape (order,), m³/s
    """

    into: str
    density_kg_per_m3: float
    sound_speed_m_per_s: float
    volume_flow: ComplexArray


@dataclass(frozen=True)
class Tone:
    """A line that is no order of the shaft.

    Attributes
    ----------
    name : what makes it
    frequency_hz : above zero
    rigid : force and moment on the rigid machine about its centre of mass, complex peaks, shape
        (6,), N and N m
    on_parts : on the parts in the shell, shape (part, component), N and N m
    figure : name of the reported figure of the largest force that it makes in a foot; none for none
    on_yoke : see `Loads`, shape (order around, 2), N/m
    """

    name: str
    frequency_hz: float
    rigid: ComplexArray
    on_parts: ComplexArray
    figure: str | None = None
    on_yoke: ComplexArray | None = None


@dataclass(frozen=True)
class Noise:
    """What does not repeat with the revolution.

    Attributes
    ----------
    on_parts : load on the parts per unit of each random force, shape (part, component, force)
    frequency_hz : shape (line,)
    density : of the random forces, shape (force, force, line), N²/Hz, N² m/Hz and N² m²/Hz
    """

    on_parts: Array
    frequency_hz: Array
    density: ComplexArray


@dataclass(frozen=True)
class Loads:
    """Loads of one source in one case; what a source does not do is left out.

    Attributes
    ----------
    wrenches : on the rigid machine over uniform crank angles, by what makes them
    rigid : further wrench on it by order from zero, complex peaks, shape (6, order), N and N m
    on_shell : wrench by order on the shell round a suspended block, about the shell's centre of
        mass, as `rigid`, which then is on the block
    on_parts : on the parts in the shell by order, shape (part, component, order), N and N m
    on_yoke : line load outwards on the middle of the stator's yoke by order, parts with cos nθ and
        sin nθ of YOKE_ORDERS, complex peaks, shape (order around, 2, order), N/m
    tones : lines that are no orders
    noise : random loads
    flows : into spaces of gas by order; what the machine has no table of is silent
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
    rigid: ComplexArray | None = None
    on_shell: ComplexArray | None = None
    on_parts: ComplexArray | None = None
    on_yoke: ComplexArray | None = None
    tones: tuple[Tone, ...] = ()
    noise: tuple[Noise, ...] = ()
    flows: tuple[GasFlow, ...] = ()
    shaft_torque_n_m: ComplexArray | None = None
    figures: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Lines:
    """The lines of all sources in one case: orders from zero, then tones.

    Attributes
    ----------
    names : of the lines
    frequency_hz : shape (line,)
    rigid : wrench on the rigid machine by source but for what `wrenches` give, shape (6, line)
    on_parts : on the parts in the shell by source, shape (part, component, line)
    flows : into spaces of gas by source, at the lines
    on_yoke : around the stator's yoke, by source that loads it, shape (order around, 2, line), N/m
    on_shell : wrench on the shell round a suspended block, of the sources that have one
    """

    names: tuple[str, ...]
    frequency_hz: Array
    rigid: Mapping[str, ComplexArray]
    on_parts: Mapping[str, ComplexArray]
    flows: Mapping[str, tuple[GasFlow, ...]] = field(default_factory=dict)
    on_yoke: Mapping[str, ComplexArray] = field(default_factory=dict)
    on_shell: Mapping[str, ComplexArray] = field(default_factory=dict)


def lines_of(loads: Mapping[str, Loads], shaft_hz: float, highest: int) -> Lines:
    """Lay the loads of all sources on one axis of lines; every tone is a line of its own.

    Parameters
    ----------
    loads : by source
    shaft_hz : frequency of the first order
    highest : order
    """
    tones = [(source, tone) for source, given in loads.items() for tone in given.tones]
    orders, count = highest + 1, highest + 1 + len(tones)
    rigid, on_parts, flows = {}, {}, {}
    end = orders
    for source, given in loads.items():
        wrench = np.zeros((6, count), dtype=complex)
        parts = np.zeros((len(PARTS), PART_COMPONENTS, count), dtype=complex)
        if given.rigid is not None:
            held = min(orders, given.rigid.shape[-1])
            wrench[:, :held] = given.rigid[:, :held]
        if given.on_parts is not None:
            held = min(orders, given.on_parts.shape[-1])
            parts[..., :held] = given.on_parts[..., :held]
        begin, end = end, end + len(given.tones)
        if given.tones:
            wrench[:, begin:end] = np.stack([tone.rigid for tone in given.tones], axis=-1)
            parts[..., begin:end] = np.stack([tone.on_parts for tone in given.tones], axis=-1)
        rigid[source], on_parts[source] = wrench, parts
        flows[source] = tuple(_at_lines(flow, orders, count) for flow in given.flows)
    frequency = [*(shaft_hz * np.arange(orders)), *(tone.frequency_hz for _, tone in tones)]
    names = (
        *(f"order {order}" for order in range(orders)),
        *(f"{source}: {tone.name}" for source, tone in tones),
    )
    around, shells = _on_yoke(loads, orders), _on_shells(loads, orders, count)
    return Lines(names, np.array(frequency), rigid, on_parts, flows, around, shells)


def _at_lines(flow: GasFlow, orders: int, count: int) -> GasFlow:
    lines = np.zeros(count, dtype=complex)
    held = min(orders, flow.volume_flow.size)
    lines[:held] = flow.volume_flow[:held]
    return replace(flow, volume_flow=lines)


def _on_yoke(loads: Mapping[str, Loads], orders: int) -> dict[str, ComplexArray]:
    """Loads around the yoke of the sources that have some, orders first, then all tones."""
    tones = [(source, tone) for source, given in loads.items() for tone in given.tones]
    around: dict[str, ComplexArray] = {}
    for source, given in loads.items():
        if given.on_yoke is None and all(tone.on_yoke is None for tone in given.tones):
            continue
        of_source = np.zeros((len(YOKE_ORDERS), 2, orders + len(tones)), dtype=complex)
        if given.on_yoke is not None:
            held = min(orders, given.on_yoke.shape[-1])
            of_source[..., :held] = given.on_yoke[..., :held]
        for number, (maker, tone) in enumerate(tones, orders):
            if maker == source and tone.on_yoke is not None:
                of_source[..., number] = tone.on_yoke
        around[source] = of_source
    return around


def _on_shells(loads: Mapping[str, Loads], orders: int, count: int) -> dict[str, ComplexArray]:
    """Wrenches on the shell on the axis of all lines, (6, line)."""
    wrenches: dict[str, ComplexArray] = {}
    for source, given in loads.items():
        if given.on_shell is not None:
            held = min(orders, given.on_shell.shape[-1])
            wrenches[source] = np.zeros((6, count), dtype=complex)
            wrenches[source][:, :held] = given.on_shell[:, :held]
    return wrenches


def total_torque_n_m(loads: Iterable[Loads], highest: int) -> ComplexArray:
    """Torque that the shaft needs for all sources that say so, shape (highest order + 1,)."""
    total = np.zeros(highest + 1, dtype=complex)
    for source in loads:
        if source.shaft_torque_n_m is not None:
            total += source.shaft_torque_n_m
    return total
