"""Sound of one channel of a run-up, apart into orders and the residual."""

from typing import NamedTuple

import xarray as xr

from ...base.arrays import Array, ComplexArray
from ..titles import chosen


class RunUpSound(NamedTuple):
    """Orders as envelopes over the time, and the residual as samples.

    Attributes
    ----------
    channel, unit : channel and its unit
    start_s : time of the first sample and of the first envelope value, s
    sample_rate_hz : sample rate of the residual
    residual : signal without the orders, shape (sample,), in the unit
    order : shape (order,)
    envelope_rate_hz : values of an envelope a second
    envelope : complex peak, x = Re{X exp(j order angle)}, shape (order, value), in the unit
    shaft_hz : shaft frequency at the values of the envelopes, shape (value,)
    """

    channel: str
    unit: str
    start_s: float
    sample_rate_hz: float
    residual: Array
    order: Array
    envelope_rate_hz: float
    envelope: ComplexArray
    shaft_hz: Array


def shown_channel(orders: xr.Dataset, channel: str | None) -> str:
    """Name of the channel that is shown; by default the first of sound pressure, or the first."""
    pressures = orders["channel"].values[orders["channel_unit"].values == "Pa"]
    default = str(pressures[0]) if pressures.size else None
    return str(chosen(orders, "channel", channel or default))
