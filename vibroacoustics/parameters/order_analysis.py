"""How a recording's orders are to be found."""

from dataclasses import dataclass


@dataclass(frozen=True)
class SpeedChannel:
    """A channel tells the speed: in rpm where that is its unit, else by pulses."""

    channel: str
    pulses_per_revolution: int = 1
    index_channel: str | None = None
    """A channel with one pulse a revolution, at which the crank angle is zero."""


@dataclass(frozen=True)
class NominalSpeed:
    """The speed is told, and taken to be even."""

    speed_rpm: float


@dataclass(frozen=True)
class TacholessSpeed:
    """The speed is found from the orders in a channel."""

    channel: str | None
    """None: the recording's only channel."""
    minimum_rpm: float
    maximum_rpm: float


@dataclass(frozen=True)
class OrderAnalysis:
    """Settings of one analysis."""

    speed: SpeedChannel | NominalSpeed | TacholessSpeed
    orders: tuple[float, ...] = (1.0, 2.0, 3.0, 4.0)
    maximum_order: float = 20.0
    """Of spectra and map."""
    resolution_order: float = 0.25
    """Coarsest noise bandwidth of a line, orders."""
    speed_step_rpm: float = 100.0
    """Of the operating points of a run-up."""
    with_map: bool = False
    """Keep the order map of every block."""
