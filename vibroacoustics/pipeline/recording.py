"""Order analysis of a recording: speed, crank angle, orders, levels."""

from typing import Final

import xarray as xr

from .. import orders
from ..base.errors import VibroacousticsError
from ..base.progress import Progress, no_progress
from ..base.vocabulary import check, label_coordinates
from ..levels.recorded import channel_levels
from ..orders import recorded as of_recording
from ..orders.recorded_speed import channels_without_speed, recorded_speed
from ..results import provenance
from ..study.order_analysis import OrderAnalysis

_STAGES: Final = 4


def analyse_orders(
    recording: xr.Dataset, settings: OrderAnalysis, progress: Progress = no_progress
) -> xr.Dataset:
    """Orders and levels of every channel of a recording.

    Parameters
    ----------
    recording : from `read_recording` or `label_recording`
    settings : where the speed comes from, and which orders are wanted
    progress : called with the advance

    Raises
    ------
    ParameterError, SolverError
        The speed cannot be found, or an order cannot be told at the resolution.

    Examples
    --------
    >>> time = np.arange(8192) / 1024.0
    >>> signal = 3.0 * np.cos(2.0 * np.pi * 50.0 * time)
    >>> recording = va.label_recording([signal], 1024.0, ["ring"], ["m/s²"])
    >>> settings = va.OrderAnalysis(va.NominalSpeed(3000.0), orders=(1.0,), maximum_order=4.0)
    >>> orders = va.analyse_orders(recording, settings)
    >>> abs(orders["channel_order"]).sel(channel="ring", order=1.0).round(3).values
    array([3.])
    """
    try:
        return _analyse(recording, settings, progress)
    except VibroacousticsError as error:
        raise type(error)(f"{provenance.recording_name(recording)}: {error}") from None


def _analyse(recording: xr.Dataset, settings: OrderAnalysis, progress: Progress) -> xr.Dataset:
    progress("orders", 0, _STAGES)
    speed = recorded_speed(recording, settings.speed)
    signal = channels_without_speed(recording["signal"], settings.speed)
    rate_hz = float(recording.attrs["sample_rate_hz"])
    progress("orders", 1, _STAGES)
    angular = of_recording.resampled(signal, rate_hz, speed.motion, settings)
    progress("orders", 2, _STAGES)
    spectra = orders.order_map(angular, settings.resolution_order, of_recording.WINDOW)
    results = of_recording.recorded_orders(signal, angular, spectra, settings)
    results = results.merge(of_recording.synchronous_average(signal, angular))
    results = results.merge(of_recording.fault_times(speed.faults))
    progress("orders", 3, _STAGES)
    results = results.merge(channel_levels(signal, rate_hz))
    progress("orders", 4, _STAGES)
    results.attrs = {
        **provenance.recording_attributes(recording, settings),
        **speed.attributes(),
        **of_recording.resolution(spectra),
    }
    return check(label_coordinates(results))
