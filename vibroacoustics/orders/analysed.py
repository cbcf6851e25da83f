"""The channels of a recording that are analysed: all but those of the speed."""

from collections.abc import Sequence

import xarray as xr

from ..base.errors import ParameterError
from ..study.order_analysis import SpeedChannel, SpeedSource


def speed_channels(speed: SpeedSource) -> list[str]:
    """Channels of a source of the speed that are no sound or vibration."""
    if not isinstance(speed, SpeedChannel):
        return []
    return [name for name in (speed.channel, speed.index_channel) if name is not None]


def analysed_channels(names: Sequence[str], speed: SpeedSource) -> list[str]:
    """Names of the channels that are analysed: all but those of the speed.

    Raises
    ------
    ParameterError
        There is none besides that of the speed.
    """
    of_speed = speed_channels(speed)
    others = [name for name in names if name not in of_speed]
    if not others:
        raise ParameterError("there is no channel besides that of the speed")
    return others


def channels_without_speed(signal: xr.DataArray, speed: SpeedSource) -> xr.DataArray:
    """The channels that are analysed, `analysed_channels`; where side by side, not copied."""
    names = [str(name) for name in signal["channel"].values]
    others = [names.index(name) for name in analysed_channels(names, speed)]
    if others[-1] - others[0] == len(others) - 1:
        return signal.isel(channel=slice(others[0], others[-1] + 1))
    return signal.isel(channel=others)
