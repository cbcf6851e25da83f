"""Settings of the analysis of a recording's orders."""

import math
from dataclasses import dataclass
from typing import Final, Literal, get_args

from ..base.allowed import check_range
from ..base.errors import ParameterError

BandMethod = Literal["sums", "filters"]
"""Third octaves as sums of the lines within a band, or through the filters of IEC 61260-1."""
DEFAULT_ORDERS: Final = (1.0, 2.0, 3.0, 4.0)
DEFAULT_MAXIMUM_ORDER: Final = 20.0
DEFAULT_RESOLUTION_ORDER: Final = 0.25
DEFAULT_COMB: Final = tuple(float(order) for order in range(1, 11))
"""Orders of a machine of which nothing is known."""
SPEEDS_RPM: Final = (0.1, 1e6)
"""Speeds of a shaft, from that of a hydro turbine that runs out to that of a dental drill."""
PULSES: Final = (0.001, 100_000.0)
"""Pulses of a tacho or encoder per revolution; no whole number behind a belt or gear."""
ORDERS: Final = (0.001, 10_000.0)
FIRST_ORDERS: Final = (1.0, 2.0)
"""Orders of an analysis that names none, beside the loudest: those of unbalance and alignment."""
COMB_ORDERS: Final = (0.01, 1000.0)
RESOLUTIONS: Final = (1e-4, 100.0)
"""Resolutions, orders."""
SPEED_STEPS_RPM: Final = (0.01, 1e6)
MAINS_HZ: Final = (10.0, 1000.0)
THRESHOLDS: Final = (-1e12, 1e12)
LEAST_BLOCKS: Final = 8
"""Blocks of a mean that has coherence and phase: of half-overlapping Hann blocks of noise, eight
exceed a coherence of 0.9 once in a million times, one always has 1."""
_LONGEST_S: Final = 1e9
"""Latest time in a recording: 30 years."""
LINE_TOLERANCE: Final = 0.1
"""Largest distance of the speed from a drawn line, relative."""
Edge = Literal["rising", "falling"]
"""Edge of a tacho's pulses that marks the angle."""
EDGES: Final[tuple[Edge, ...]] = get_args(Edge)
BAND_METHODS: Final[tuple[BandMethod, ...]] = get_args(BandMethod)


@dataclass(frozen=True)
class SpeedChannel:
    """A channel gives the speed: in rpm where that is its unit, else by pulses.

    Attributes
    ----------
    channel : channel of the tacho, or of the speed with the unit rpm
    pulses_per_revolution : pulses per revolution of the tacho, whole or not
    index_channel : with one pulse a revolution, at which the crank angle is zero
    threshold : level of the tacho that marks the angle, in its unit; None: from its pulses, whose
        height it follows
    edge : edge of the tacho's pulses, `rising` or `falling`; None: the rising one, but of pulses to
        both sides of a rest the steeper one

    Raises
    ------
    ParameterError
        The number of pulses or the threshold is out of range, or there is no such edge.

    Examples
    --------
    >>> va.SpeedChannel("tacho", pulses_per_revolution=60).index_channel is None
    True
    """

    channel: str
    pulses_per_revolution: float = 1
    index_channel: str | None = None
    """A channel with one pulse a revolution, at which the crank angle is zero."""
    threshold: float | None = None
    edge: Edge | None = None

    def __post_init__(self) -> None:
        check_range("pulses_per_revolution", self.pulses_per_revolution, *PULSES)
        if self.threshold is not None:
            check_range("threshold", self.threshold, *THRESHOLDS)
        if self.edge is not None and self.edge not in EDGES:
            raise ParameterError(f"edge = {self.edge!r}: must be one of {', '.join(EDGES)}")


@dataclass(frozen=True)
class NominalSpeed:
    """The speed is stated, and taken to be even.

    Attributes
    ----------
    speed_rpm : 0.1 to 1e6 rpm

    Raises
    ------
    ParameterError
        The speed is out of range.

    Examples
    --------
    >>> va.NominalSpeed(2900.0)
    NominalSpeed(speed_rpm=2900.0)
    """

    speed_rpm: float

    def __post_init__(self) -> None:
        check_range("speed_rpm", self.speed_rpm, *SPEEDS_RPM, "rpm")


@dataclass(frozen=True)
class TacholessSpeed:
    """The speed is found from the orders in a channel.

    Attributes
    ----------
    channel : name, or None for the recording's only channel
    minimum_rpm, maximum_rpm : limits within which the speed is looked for
    comb : rising orders that the machine is known to have; one or two may be silent
    mains_hz : nominal frequency of the mains, whose multiples are removed; None: nothing is

    Raises
    ------
    ParameterError
        A number is out of range, or the limits or the comb do not rise.

    Examples
    --------
    >>> va.TacholessSpeed("ring", 2000.0, 4000.0).maximum_rpm
    4000.0
    """

    channel: str | None
    """Channel; None: the recording's only channel."""
    minimum_rpm: float
    maximum_rpm: float
    comb: tuple[float, ...] = DEFAULT_COMB
    mains_hz: float | None = None

    def __post_init__(self) -> None:
        _check_comb(self.comb, self.mains_hz)
        check_range("minimum_rpm", self.minimum_rpm, *SPEEDS_RPM, "rpm")
        check_range("maximum_rpm", self.maximum_rpm, *SPEEDS_RPM, "rpm")
        if not self.minimum_rpm < self.maximum_rpm:
            raise ParameterError(
                f"minimum_rpm = {self.minimum_rpm:g} rpm: must be below maximum_rpm = "
                f"{self.maximum_rpm:g} rpm"
            )


@dataclass(frozen=True)
class SpeedLine:
    """The speed is found from the orders in a channel, within 10 % of a line drawn by hand.

    Attributes
    ----------
    channel : name, or None for the recording's only channel
    points : time, s from the first sample, and speed, rpm, of at least two points; times rise
    comb, mains_hz : see `TacholessSpeed`

    Raises
    ------
    ParameterError
        There is one point, times do not rise from zero or above, a speed is out of range; or
        comb and mains as of `TacholessSpeed`.

    Examples
    --------
    >>> va.SpeedLine("ring", ((0.0, 1200.0), (20.0, 3600.0))).points[1]
    (20.0, 3600.0)
    """

    channel: str | None
    points: tuple[tuple[float, float], ...]
    comb: tuple[float, ...] = DEFAULT_COMB
    mains_hz: float | None = None

    def __post_init__(self) -> None:
        if len(self.points) < 2:
            raise ParameterError("points = 1: at least two of a time and a speed are needed")
        last_s = -math.inf
        for time_s, speed_rpm in self.points:
            check_range("points", time_s, 0.0, _LONGEST_S, "s")
            if not last_s < time_s:
                raise ParameterError(f"points = {time_s:g} s: times must rise from point to point")
            check_range("points", speed_rpm, *SPEEDS_RPM, "rpm")
            last_s = time_s
        _check_comb(self.comb, self.mains_hz)


SpeedSource = SpeedChannel | NominalSpeed | TacholessSpeed | SpeedLine


@dataclass(frozen=True)
class OrderAnalysis:
    """Settings of one analysis.

    Attributes
    ----------
    speed : where the speed comes from
    orders : wanted, rising; None: of 1 to 4 those that the sample rate holds; empty: 1, 2 and
        the loudest of each channel, at most six
    maximum_order : maximum order of spectra and map; default: 20, or the highest that the sample
        rate holds
    resolution_order : coarsest noise bandwidth of a line, orders; default: 0.25, or what a short
        recording allows
    speed_step_rpm : speed step of the operating points of a run-up
    with_map : whether the order map of every block is kept; None: of a run-up where it takes at
        most 128 MiB
    bands : third octaves of sound pressure as "sums" of the lines within a band, or through the
        "filters" of IEC 61260-1, whose skirts let in what lies beside the band

    is_fit : whether all orders are fitted to the recording at once, for a few revolutions

    Raises
    ------
    ParameterError
        A number is out of range, the orders do not rise, or `bands` is neither.

    Examples
    --------
    >>> va.OrderAnalysis(va.NominalSpeed(2900.0), orders=(1.0, 2.0)).speed_step_rpm
    100.0
    """

    speed: SpeedSource
    orders: tuple[float, ...] | None = None
    maximum_order: float | None = None
    """Maximum order of spectra and map."""
    resolution_order: float | None = None
    """Coarsest noise bandwidth of a line, orders."""
    speed_step_rpm: float = 100.0
    """Step of the operating points of a run-up."""
    with_map: bool | None = False
    """Keep the order map of every block; None: that of a run-up, up to 128 MiB."""
    bands: BandMethod = "sums"
    is_fit: bool = False

    def __post_init__(self) -> None:
        if self.orders is not None and (self.orders or self.is_fit):
            _check_rising("orders", self.orders, *ORDERS)
        if self.maximum_order is not None:
            check_range("maximum_order", self.maximum_order, *ORDERS)
        if self.resolution_order is not None:
            check_range("resolution_order", self.resolution_order, *RESOLUTIONS)
        check_range("speed_step_rpm", self.speed_step_rpm, *SPEED_STEPS_RPM, "rpm")
        if self.bands not in BAND_METHODS:
            raise ParameterError(f"bands = {self.bands!r}: must be one of sums, filters")

    @property
    def maximum_or_default(self) -> float:
        """Maximum order, 20 where none is stated."""
        return self.maximum_order or DEFAULT_MAXIMUM_ORDER

    @property
    def resolution_or_default(self) -> float:
        """Coarsest resolution, 0.25 orders where none is stated."""
        return self.resolution_order or DEFAULT_RESOLUTION_ORDER


def default_orders(highest: float) -> tuple[float, ...]:
    """Orders of 1 to 4 up to the highest that a sample rate holds."""
    return tuple(order for order in DEFAULT_ORDERS if order <= highest)


def _check_comb(comb: tuple[float, ...], mains_hz: float | None) -> None:
    _check_rising("comb", comb, *COMB_ORDERS)
    if mains_hz is not None:
        check_range("mains_hz", mains_hz, *MAINS_HZ, "Hz")


def _check_rising(name: str, orders: tuple[float, ...], lowest: float, highest: float) -> None:
    for order in orders:
        check_range(name, order, lowest, highest)
    if not orders or sorted(set(orders)) != list(orders):
        raise ParameterError(f"{name} = {orders}: must be at least one order, and rise")
