"""Orders of a recording tracked over time."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from .. import orders as analysis
from ..base.errors import ParameterError, VibroacousticsError
from ..base.vocabulary import check, label_coordinates, stamp
from ..orders.recorded_speed import (
    SpeedSource,
    channels_without_speed,
    recorded_speed,
)
from ..results import provenance


def track_orders(
    recording: xr.Dataset,
    speed: SpeedSource,
    orders: Sequence[float],
    bandwidth_hz: float,
    poles: int = 2,
) -> xr.Dataset:
    """Complex envelope of each order over the time of a recording, all orders together.

    A Vold-Kalman filter of the second generation (Vold, Mains and Blough 1997, SAE 972007). It
    tells orders apart that lie close or cross, and follows them up to the ends of the recording.

    Parameters
    ----------
    recording : from `read_recording` or `label_recording`
    speed : where the speed comes from: `SpeedChannel`, `NominalSpeed` or `TacholessSpeed`
    orders : what to track, multiples of the shaft's speed, whole or not
    bandwidth_hz : full width at -3 dB of what passes around each order; below the distance of
        orders that stay side by side, and up to √s where two cross with s Hz/s
    poles : 1, 2 or 3; each steepens the filter by 40 dB a decade

    Returns
    -------
    `tracked_order` (channel, track_time, order), complex peak in the channel's unit, with
    `track_speed` (track_time), rpm; attribute `noise_gain`: the largest factor by which noise
    within the bandwidth grows because orders are close

    Raises
    ------
    ParameterError
        The speed cannot be found, or the bandwidth does not fit recording or orders.
    SolverError
        Two orders are too close for too long.

    Examples
    --------
    >>> time = np.arange(4096) / 1024.0
    >>> swelling = (1.0 + time) * np.cos(2.0 * np.pi * 50.0 * time)
    >>> recording = va.label_recording([swelling], 1024.0, ["ring"], ["m/s²"])
    >>> tracked = va.track_orders(recording, va.NominalSpeed(3000.0), [1.0], bandwidth_hz=2.0)
    >>> at_2_s = tracked["tracked_order"].sel(channel="ring", order=1.0).sel(
    ...     track_time=2.0, method="nearest")
    >>> round(abs(at_2_s.item()), 2)
    3.0
    """
    try:
        return _track(recording, speed, orders, bandwidth_hz, poles)
    except VibroacousticsError as error:
        raise type(error)(f"{provenance.recording_name(recording)}: {error}") from None


def _track(
    recording: xr.Dataset,
    speed: SpeedSource,
    orders: Sequence[float],
    bandwidth_hz: float,
    poles: int,
) -> xr.Dataset:
    numbers = [float(order) for order in orders]
    if not numbers or min(numbers) <= 0.0 or len(set(numbers)) < len(numbers):
        raise ParameterError(f"orders = {numbers}: must be numbers above 0, each once")
    of_shaft = recorded_speed(recording, speed)
    signal = channels_without_speed(recording["signal"], speed)
    tracked = analysis.vold_kalman(
        signal.values,
        float(recording.attrs["sample_rate_hz"]),
        [analysis.Track(of_shaft.motion, order) for order in numbers],
        bandwidth_hz,
        poles,
    )
    coords = {"channel": signal["channel"], "track_time": tracked.time_s, "order": numbers}
    rpm = 60.0 * of_shaft.motion.frequency_hz(tracked.time_s)
    result = xr.Dataset(
        {"tracked_order": stamp("tracked_order", np.swapaxes(tracked.envelope, 1, 2), coords)},
        coords={"track_speed": ("track_time", rpm), "channel_unit": signal["channel_unit"]},
    )
    settings = {"bandwidth_hz": bandwidth_hz, "poles": poles, "noise_gain": tracked.noise_gain}
    result.attrs = {
        **provenance.of_recording(recording, "tracked orders"),
        **of_shaft.attributes(),
        **settings,
    }
    return check(label_coordinates(result))
